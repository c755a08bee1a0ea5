//! One file for each kind of shape: where a ray crosses it.

mod sphere;

use crate::primitive::Primitive;
use lancer_scene::Geometry;

/// The shape made ready.
pub(crate) fn primitive(geometry: &Geometry) -> Box<dyn Primitive> {
    match geometry {
        Geometry::Sphere(sphere) => Box::new(sphere::Ball::new(sphere)),
        _ => todo!("the other shapes"),
    }
}
