use crate::{CustomShape, Direction, InvalidField, Length, OutOfRange, Position, Surface};
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
    /// A shape that the user has written.
    Custom(Arc<dyn CustomShape>),
}

/// A sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Its centre.
    pub centre: Position,
    /// Its radius.
    pub radius: Length,
}

/// An infinite plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// A point on it, where a checker begins.
    pub origin: Position,
    /// Its normal, of any length.
    pub normal: Direction,
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

impl IntoSurface for Result<Surface, OutOfRange> {
    fn into_surface(self) -> Result<Surface, InvalidField> {
        self.map_err(|e| e.in_field("gloss"))
    }
}

impl Shape {
    /// A sphere.
    ///
    /// # Errors
    /// Where a number is not finite, `radius` is not positive, or the surface
    /// is invalid.
    pub fn sphere(
        centre: [f64; 3],
        radius: f64,
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let centre = Position::new(centre).map_err(|e| e.in_field("centre"))?;
        let radius = Length::new(radius).map_err(|e| e.in_field("radius"))?;
        let surface = surface.into_surface()?;
        Ok(Self { geometry: Geometry::Sphere(Sphere { centre, radius }), surface })
    }

    /// An infinite plane through `origin`.
    ///
    /// # Errors
    /// Where a number is not finite, `normal` is zero, or the surface is
    /// invalid.
    pub fn plane(
        origin: [f64; 3],
        normal: [f64; 3],
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let origin = Position::new(origin).map_err(|e| e.in_field("origin"))?;
        let normal = Direction::new(normal).map_err(|e| e.in_field("normal"))?;
        let surface = surface.into_surface()?;
        Ok(Self { geometry: Geometry::Plane(Plane { origin, normal }), surface })
    }

    /// A shape of the user's own.
    ///
    /// # Errors
    /// Where the surface is invalid.
    pub fn custom(
        shape: impl CustomShape + 'static,
        surface: impl IntoSurface,
    ) -> Result<Self, InvalidField> {
        let surface = surface.into_surface()?;
        Ok(Self { geometry: Geometry::Custom(Arc::new(shape)), surface })
    }
}
