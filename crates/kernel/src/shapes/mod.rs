//! One file for each kind of shape: where a ray crosses it. What several need is
//! in `exact`, `frame`, `clip` and `edges`.

mod clip;
mod cone;
mod cuboid;
mod custom;
mod edges;
mod exact;
mod flat;
mod frame;
mod mesh;
mod plane;
mod sphere;
#[cfg(test)]
mod testing;
mod tetrahedron;
mod torus;
mod triangle;

use crate::KernelSettings;
use crate::primitive::Primitive;
use lancer_scene::Geometry;

/// The shape made ready.
pub(crate) fn primitive(geometry: &Geometry, settings: &KernelSettings) -> Box<dyn Primitive> {
    match geometry {
        Geometry::Sphere(sphere) => Box::new(sphere::Ball::new(sphere)),
        Geometry::Plane(plane) => Box::new(plane::HalfSpace::new(plane)),
        Geometry::Disc(disc) => Box::new(flat::Round::new(disc)),
        Geometry::Rectangle(rectangle) => Box::new(flat::Sheet::new(rectangle)),
        Geometry::Triangle(triangle) => Box::new(triangle::Facet::new(triangle)),
        Geometry::Cuboid(cuboid) => Box::new(cuboid::Slabs::new(cuboid)),
        Geometry::Tetrahedron(solid) => Box::new(tetrahedron::Faces::new(solid)),
        Geometry::Cone(cone) => Box::new(cone::Barrel::new(cone)),
        Geometry::Torus(torus) => Box::new(torus::Ring::new(torus)),
        Geometry::Mesh(mesh) => Box::new(mesh::Facets::new(mesh, settings)),
        Geometry::Custom(custom) => Box::new(custom::Own::new(custom)),
    }
}
