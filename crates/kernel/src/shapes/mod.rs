//! One file for each kind of shape: where a ray crosses it. What several need is
//! in `exact`, `frame`, `clip` and `edges`.

mod clip;
mod cone;
mod cuboid;
mod custom;
mod edges;
pub(crate) mod exact;
mod flat;
mod frame;
pub(crate) mod mesh;
pub(crate) mod plane;
pub(crate) mod sphere;
#[cfg(test)]
mod testing;
mod tetrahedron;
mod torus;
mod triangle;

use crate::KernelSettings;
use crate::lean::not_lean;
use crate::primitive::Primitive;
use lancer_scene::Geometry;
use std::sync::Arc;

/// The shape made ready.
pub(crate) fn primitive(geometry: &Geometry, settings: &KernelSettings) -> Arc<dyn Primitive> {
    if !matches!(geometry, Geometry::Sphere(_) | Geometry::Plane(_)) {
        not_lean();
    }
    match geometry {
        Geometry::Sphere(sphere) => Arc::new(sphere::Ball::new(sphere)),
        Geometry::Plane(plane) => Arc::new(plane::HalfSpace::new(plane)),
        Geometry::Disc(disc) => Arc::new(flat::Round::new(disc)),
        Geometry::Rectangle(rectangle) => Arc::new(flat::Sheet::new(rectangle)),
        Geometry::Triangle(triangle) => Arc::new(triangle::Facet::new(triangle)),
        Geometry::Cuboid(cuboid) => Arc::new(cuboid::Slabs::new(cuboid)),
        Geometry::Tetrahedron(solid) => Arc::new(tetrahedron::Faces::new(solid)),
        Geometry::Cone(cone) => Arc::new(cone::Barrel::new(cone)),
        Geometry::Torus(torus) => Arc::new(torus::Ring::new(torus)),
        Geometry::Mesh(mesh) => Arc::new(mesh::Facets::new(mesh, settings)),
        Geometry::Custom(custom) => Arc::new(custom::Own::new(custom)),
    }
}
