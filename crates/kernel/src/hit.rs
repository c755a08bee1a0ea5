use lancer_math::{Placement, Point, Ray, Vector, unit};
use lancer_scene::Surface;

/// What a ray met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// How many directions away from the ray's origin.
    pub t: f64,
    /// The number of the item.
    pub item: u32,
    /// Which part of the shape; the shape knows what the number means.
    pub part: u32,
}

/// A point of a surface with what shading needs, in the world.
#[derive(Debug, Clone, Copy)]
pub struct SurfacePoint<'a> {
    /// Where it is.
    pub point: Point,
    /// A ray that starts farther than this from `point`, along the normal,
    /// starts off the surface: on the side that it was moved to.
    pub error: f64,
    /// The unit normal: outward where the shape is closed, else as it was
    /// described.
    pub normal: Vector,
    /// The unit normal to shade with; another one on smooth meshes alone, and
    /// always on the same side.
    pub shading: Vector,
    /// What the shape looks like.
    pub surface: &'a Surface,
    /// The shares of red, green and blue light that are thrown back here.
    pub albedo: [f64; 3],
    /// In which cell of a checker it is, counted along the shape's two coordinates; zeros
    /// where it has none or doubles do not tell cells apart.
    pub cell: [f64; 2],
    /// The number of the shape in the description.
    pub shape: u32,
    /// The number of the item.
    pub item: u32,
    /// Which part of the shape, as [`Hit::part`].
    pub part: u32,
}

impl SurfacePoint<'_> {
    /// The ray from here in that direction: it starts off the surface, on the
    /// side to which it goes, by twice the bound on the point's error, so
    /// that it does not meet the surface here again and misses nothing that is
    /// farther from it than three such bounds (pbr-book, 4th edition, 6.8.6).
    #[must_use]
    pub fn leave(&self, direction: Vector) -> Ray {
        self.leave_by(direction, 0.0)
    }

    /// The same, `more` farther off.
    #[must_use]
    pub fn leave_by(&self, direction: Vector, more: f64) -> Ray {
        let away = 2.0 * self.error + more;
        let away = if direction.dot(&self.normal) < 0.0 { -away } else { away };
        Ray::new(self.point + self.normal * away, direction)
    }

    /// From the shape's own space to the world.
    pub(crate) fn place(&mut self, placement: &Placement) {
        let point = placement.point(&self.point);
        self.error = placement.error_of(&self.point, &point, self.error);
        self.point = point;
        // Of a normal that has no direction any more the old one is as good.
        self.normal = unit(placement.normal(&self.normal)).unwrap_or(self.normal);
        self.shading = unit(placement.normal(&self.shading)).unwrap_or(self.normal);
    }
}
