use crate::crossing::{Crossing, Crossings};
use lancer_math::{Bounds, Point, Ray, Vector};
use lancer_scene::Checker;

/// A point of a surface where a ray crosses it, in the shape's own space.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Contact {
    /// Where it is: put back onto the surface, so that it is nearer to it than
    /// origin + t * direction, whose error grows with t.
    pub(crate) point: Point,
    /// No coordinate of `point` is farther than this from the exact surface.
    pub(crate) error: f64,
    /// The unit normal: outward where the shape is closed.
    pub(crate) normal: Vector,
    /// The unit normal to shade with: another one on smooth meshes alone.
    pub(crate) shading: Vector,
}

/// Which of the two colours of a checker a point shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Cell {
    /// The surface's own.
    First,
    /// The checker's.
    Second,
    /// So far out that doubles do not tell cells apart: the mean of both.
    Mixed,
}

/// The cell of a checker that a point is in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Square {
    pub(crate) cell: Cell,
    /// Which one it is, counted along the shape's two coordinates; zeros where that is not
    /// known.
    pub(crate) index: [f64; 2],
}

/// A shape made ready to be met by rays. All of it is in the shape's own space;
/// ray directions may have any length, and `t` counts directions.
///
/// There is no smallest and no largest distance, and comparisons are written
/// so that what is not a number is no hit.
pub(crate) trait Primitive: std::fmt::Debug + Send + Sync {
    /// All crossings of the ray's line, where no line can have more than four:
    /// of meshes and of shapes of the user's own, which have a `nearest` and an
    /// `each` of their own, none. Of a closed shape they come in pairs, and where
    /// the line only touches it, there is a pair or none.
    fn crossings(&self, ray: &Ray) -> Crossings;

    /// The nearest crossing with 0 < t < `t_max`.
    #[inline]
    fn nearest(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        self.crossings(ray).iter().find(|crossing| crossing.t > 0.0).filter(|c| c.t < t_max)
    }

    /// Whether there is a crossing with 0 < t < `t_max`.
    #[inline]
    fn any(&self, ray: &Ray, t_max: f64) -> bool {
        self.nearest(ray, t_max).is_some()
    }

    /// The nearest crossing with 0 < t < `t_max` of each ray.
    fn nearest_each(&self, rays: &[Ray], t_max: f64, nearest: &mut [Option<Crossing>]) {
        for (ray, nearest) in rays.iter().zip(nearest) {
            *nearest = self.nearest(ray, t_max);
        }
    }

    /// Whether each ray has a crossing with 0 < t < `t_max`.
    fn any_each(&self, rays: &[Ray], t_max: f64, any: &mut [bool]) {
        for (ray, any) in rays.iter().zip(any) {
            *any = self.any(ray, t_max);
        }
    }

    /// Calls `found` with each crossing with `from` < t < `to`, in any order.
    fn each(&self, ray: &Ray, from: f64, to: f64, found: &mut dyn FnMut(Crossing)) {
        self.crossings(ray).iter().filter(|c| c.t > from && c.t < to).for_each(found);
    }

    /// The point of a crossing that this shape has reported for this ray.
    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact;

    /// The cell of a checker at a contact, by the shape's own two coordinates.
    fn square(&self, contact: &Contact, part: u32, checker: &Checker) -> Square;

    /// A box around it, rounded outward; `None` where it has no end.
    fn bounds(&self) -> Option<Bounds>;

    /// Whether `point` is inside; never where the shape has no inside.
    fn contains(&self, _point: &Point) -> bool {
        false
    }

    /// Its volume, for which a bound serves; infinite where it has no end, nothing
    /// where it has no inside.
    fn volume(&self) -> f64 {
        0.0
    }
}
