use crate::{
    Cone, Cuboid, CustomShape, Direction, Disc, InvalidField, Length, Mesh, Plane, Position,
    Rectangle, Sphere, Surface, Tetrahedron, Torus, Triangle,
};
use std::sync::Arc;

/// A shape with its surface.
#[derive(Debug, Clone)]
pub struct Shape {
    /// Where its points are.
    pub geometry: Geometry,
    /// What it looks like.
    pub surface: Surface,
}

/// Where the points of a shape are.
#[derive(Debug, Clone)]
pub enum Geometry {
    /// The points at one distance from a centre.
    Sphere(Sphere),
    /// An infinite plane.
    Plane(Plane),
    /// The inside of a circle.
    Disc(Disc),
    /// A rectangle or parallelogram.
    Rectangle(Rectangle),
    /// A triangle.
    Triangle(Triangle),
    /// A box with sides along the axes.
    Cuboid(Cuboid),
    /// A tetrahedron.
    Tetrahedron(Tetrahedron),
    /// A cylinder, cone or frustum.
    Cone(Cone),
    /// A ring.
    Torus(Torus),
    /// Triangles from a file; flat unless the mesh has normals.
    Mesh(Arc<Mesh>),
    /// A shape that the user has written.
    Custom(Arc<dyn CustomShape>),
}

impl Geometry {
    /// What it is called in dumps and messages.
    #[must_use]
    pub fn kind(&self) -> &str {
        match self {
            Self::Sphere(_) => "sphere",
            Self::Plane(_) => "plane",
            Self::Disc(_) => "disc",
            Self::Rectangle(_) => "rectangle",
            Self::Triangle(_) => "triangle",
            Self::Cuboid(_) => "box",
            Self::Tetrahedron(_) => "tetrahedron",
            Self::Cone(cone) if cone.base_radius() == cone.top_radius() => "cylinder",
            Self::Cone(cone) if cone.base_radius() == 0.0 || cone.top_radius() == 0.0 => "cone",
            Self::Cone(_) => "frustum",
            Self::Torus(_) => "torus",
            Self::Mesh(_) => "mesh",
            Self::Custom(custom) => custom.name(),
        }
    }

    /// Whether it has an inside, so that a medium can fill it.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        match self {
            Self::Sphere(_)
            | Self::Plane(_)
            | Self::Cuboid(_)
            | Self::Tetrahedron(_)
            | Self::Torus(_) => true,
            Self::Cone(cone) => !cone.open,
            Self::Mesh(mesh) => mesh.is_closed(),
            Self::Disc(_) | Self::Rectangle(_) | Self::Triangle(_) | Self::Custom(_) => false,
        }
    }
}

/// A surface as the constructors of shapes take it: a [`Surface`], or one whose
/// range check has not been looked at yet.
pub trait IntoSurface {
    /// The surface, or what is wrong with it.
    ///
    /// # Errors
    /// Where the surface had a value out of range.
    fn into_surface(self) -> Result<Surface, InvalidField>;
}

impl IntoSurface for Surface {
    fn into_surface(self) -> Result<Surface, InvalidField> {
        Ok(self)
    }
}

impl IntoSurface for Result<Surface, InvalidField> {
    fn into_surface(self) -> Result<Surface, InvalidField> {
        self
    }
}

fn position(field: &str, xyz: [f64; 3]) -> Result<Position, InvalidField> {
    Position::new(xyz).map_err(|e| e.in_field(field))
}

fn direction(field: &str, xyz: [f64; 3]) -> Result<Direction, InvalidField> {
    Direction::new(xyz).map_err(|e| e.in_field(field))
}

fn length(field: &str, value: f64) -> Result<Length, InvalidField> {
    Length::new(value).map_err(|e| e.in_field(field))
}

/// Constructors. All fail where a number is not finite or the surface is
/// invalid; what else each refuses is said there.
impl Shape {
    fn of(geometry: Geometry, surface: impl IntoSurface) -> Result<Self, InvalidField> {
        Ok(Self { geometry, surface: surface.into_surface()? })
    }

    /// A sphere.
    ///
    /// # Errors
    /// Where `radius` is not positive.
    pub fn sphere(
        centre: [f64; 3],
        radius: f64,
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let (centre, radius) = (position("centre", centre)?, length("radius", radius)?);
        Self::of(Geometry::Sphere(Sphere { centre, radius }), surface)
    }

    /// An infinite plane through `origin`.
    ///
    /// # Errors
    /// Where `normal` is zero.
    pub fn plane(
        origin: [f64; 3],
        normal: [f64; 3],
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let (origin, normal) = (position("origin", origin)?, direction("normal", normal)?);
        Self::of(Geometry::Plane(Plane { origin, normal }), surface)
    }

    /// The inside of a circle.
    ///
    /// # Errors
    /// Where `normal` is zero or `radius` is not positive.
    pub fn disc(
        centre: [f64; 3],
        normal: [f64; 3],
        radius: f64,
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let (centre, normal) = (position("centre", centre)?, direction("normal", normal)?);
        let radius = length("radius", radius)?;
        Self::of(Geometry::Disc(Disc { centre, normal, radius }), surface)
    }

    /// A rectangle, or a parallelogram, from a corner and the sides there.
    ///
    /// # Errors
    /// Where a side is zero, or the sides are parallel.
    pub fn rectangle(
        corner: [f64; 3],
        [first, second]: [[f64; 3]; 2],
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let corner = position("corner", corner)?;
        let sides = [direction("sides[0]", first)?, direction("sides[1]", second)?];
        let rectangle = Rectangle::new(corner, sides).map_err(|e| e.in_field("sides[1]"))?;
        Self::of(Geometry::Rectangle(rectangle), surface)
    }

    /// A triangle.
    ///
    /// # Errors
    /// Where the corners are on a line.
    pub fn triangle(
        corners: [[f64; 3]; 3],
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let [a, b, c] = corners.map(|corner| position("corners", corner));
        let triangle = Triangle::new([a?, b?, c?]).map_err(|e| e.in_field("corners"))?;
        Self::of(Geometry::Triangle(triangle), surface)
    }

    /// A box with sides along the axes, from two opposite corners.
    ///
    /// # Errors
    /// Where they agree in a coordinate.
    pub fn cuboid(
        from: [f64; 3],
        to: [f64; 3],
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let cuboid = Cuboid::new(position("from", from)?, position("to", to)?);
        Self::of(Geometry::Cuboid(cuboid.map_err(|e| e.in_field("to"))?), surface)
    }

    /// A cube with sides along the axes, from its middle and the length of a
    /// side.
    ///
    /// # Errors
    /// Where `side` is not positive, or lost in the rounding of the corners.
    pub fn cube(
        centre: [f64; 3],
        side: f64,
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let half = length("side", side)?.get() / 2.0;
        let (from, to) = (centre.map(|c| c - half), centre.map(|c| c + half));
        let cuboid = Cuboid::new(position("centre", from)?, position("centre", to)?);
        Self::of(Geometry::Cuboid(cuboid.map_err(|e| e.in_field("side"))?), surface)
    }

    /// A tetrahedron.
    ///
    /// # Errors
    /// Where the corners are in a plane.
    pub fn tetrahedron(
        corners: [[f64; 3]; 4],
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let [a, b, c, d] = corners.map(|corner| position("corners", corner));
        let solid = Tetrahedron::new([a?, b?, c?, d?]).map_err(|e| e.in_field("corners"))?;
        Self::of(Geometry::Tetrahedron(solid), surface)
    }

    /// A cylinder with lids.
    ///
    /// # Errors
    /// Where `radius` is not positive or the ends are the same point.
    pub fn cylinder(
        base: [f64; 3],
        top: [f64; 3],
        radius: f64,
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let radius = length("radius", radius)?.get();
        Self::frustum((base, radius), (top, radius), surface)
    }

    /// A cone with a lid at its base.
    ///
    /// # Errors
    /// Where `radius` is not positive or the base is the apex.
    pub fn cone(
        base: [f64; 3],
        apex: [f64; 3],
        radius: f64,
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let radius = length("radius", radius)?.get();
        Self::frustum((base, radius), (apex, 0.0), surface)
    }

    /// A cone that is cut off, with lids: two ends and the radii there.
    ///
    /// # Errors
    /// Where a radius is negative, both are 0, or the ends are the same point.
    pub fn frustum(
        (base, base_radius): ([f64; 3], f64),
        (top, top_radius): ([f64; 3], f64),
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let base = (position("base", base)?, base_radius);
        let top = (position("top", top)?, top_radius);
        Self::of(Geometry::Cone(Cone::new(base, top, false)?), surface)
    }

    /// A ring around `centre`: a tube of radius `tube` around a circle of radius
    /// `ring`.
    ///
    /// # Errors
    /// Where `axis` is zero, a radius is not positive, or the tube is wider
    /// than the ring.
    pub fn torus(
        centre: [f64; 3],
        axis: [f64; 3],
        [ring, tube]: [f64; 2],
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let (centre, axis) = (position("centre", centre)?, direction("axis", axis)?);
        let (ring, tube) = (length("ring", ring)?, length("tube", tube)?);
        let torus = Torus::new(centre, axis, ring, tube).map_err(|e| e.in_field("tube"))?;
        Self::of(Geometry::Torus(torus), surface)
    }

    /// A mesh, which several shapes may share.
    ///
    /// # Errors
    /// Where the surface is invalid.
    pub fn mesh(mesh: Arc<Mesh>, surface: impl IntoSurface) -> Result<Self, InvalidField> {
        Self::of(Geometry::Mesh(mesh), surface)
    }

    /// A shape of the user's own.
    ///
    /// # Errors
    /// Where the surface is invalid.
    pub fn custom(
        shape: impl CustomShape + 'static,
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        Self::of(Geometry::Custom(Arc::new(shape)), surface)
    }

    /// The same shape without lids, where it is a cylinder, cone or frustum.
    #[must_use]
    pub fn without_lids(mut self) -> Self {
        if let Geometry::Cone(cone) = &mut self.geometry {
            cone.open = true;
        }
        self
    }
}
