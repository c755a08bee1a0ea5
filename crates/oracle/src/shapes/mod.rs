//! Where a line meets each kind of shape, in the shape's own stretched space.

mod cone;
mod flat;
mod mesh;
mod polyhedron;
mod sphere;
mod torus;

use crate::crossing::Found;
use crate::{Crossing, Crossings, Line, Number, Passage, Place, Space, Triple};
use lancer_scene::Geometry;

/// All places where `line` meets the boundary of a shape that stands in `space`,
/// whose t is right to so many bits.
///
/// The numbers of the line, the shape and its placement are taken as exact. A
/// line that lies in a flat surface does not meet it. A line without a direction
/// meets nothing.
///
/// # Panics
/// For [`Geometry::Custom`], of which nothing is known.
#[must_use]
pub fn crossings(geometry: &Geometry, space: &Space, line: &Line, bits: usize) -> Crossings {
    if line.direction.is_zero() {
        return Crossings { list: vec![], margin: 0.0 };
    }
    let local = space.line(line);
    let found = meet(geometry, space, &local, bits);
    let outside = |normal: &Triple| {
        let normal = space.normal(&normal.rounded(2 * bits));
        normal.rounded(2 * bits).unit(bits)
    };
    let list = found.list.into_iter().map(|local| {
        let normal = outside(&local.normal);
        let shading_normal = local.shading_normal.map_or_else(|| normal.clone(), |n| outside(&n));
        Crossing {
            point: line.at(&local.t).rounded(bits),
            t: local.t,
            normal,
            shading_normal,
            passage: local.passage,
            face: local.face,
            seam: local.seam,
        }
    });
    Crossings { list: list.collect(), margin: found.margin }
}

/// The same, but only where on the line those places are and which way it passes there,
/// which is had sooner.
///
/// # Panics
/// For [`Geometry::Custom`], of which nothing is known.
#[must_use]
pub fn passages(
    geometry: &Geometry,
    space: &Space,
    line: &Line,
    bits: usize,
) -> Vec<(Number, Passage)> {
    if line.direction.is_zero() {
        return vec![];
    }
    let local = space.line(line);
    let list = match geometry {
        Geometry::Torus(torus) => torus::list(torus, space, &local, bits),
        other => meet(other, space, &local, bits).list,
    };
    list.into_iter().map(|local| (local.t, local.passage)).collect()
}

fn meet(geometry: &Geometry, space: &Space, local: &Line, bits: usize) -> Found {
    match geometry {
        Geometry::Sphere(sphere) => sphere::meet(sphere, space, local, bits),
        Geometry::Plane(plane) => flat::meet_plane(plane, space, local, bits),
        Geometry::Disc(disc) => flat::meet_disc(disc, space, local, bits),
        Geometry::Rectangle(rectangle) => flat::meet_rectangle(rectangle, space, local, bits),
        Geometry::Triangle(triangle) => flat::meet_triangle(triangle, space, local, bits),
        Geometry::Cuboid(cuboid) => polyhedron::meet_cuboid(cuboid, space, local, bits),
        Geometry::Tetrahedron(solid) => polyhedron::meet_tetrahedron(solid, space, local, bits),
        Geometry::Cone(cone) => cone::meet(cone, space, local, bits),
        Geometry::Torus(torus) => torus::meet(torus, space, local, bits),
        Geometry::Mesh(mesh) => mesh::meet(mesh, space, local, bits),
        Geometry::Custom(custom) => panic!("{} is the user's own shape", custom.name()),
    }
}

/// Where a point is with respect to a shape with an inside; `None` for one
/// without, of which nothing is inside.
///
/// # Panics
/// For [`Geometry::Custom`], of which nothing is known.
#[must_use]
pub fn inside(geometry: &Geometry, space: &Space, point: &Triple) -> Option<Place> {
    let p = space.local_point(point);
    match geometry {
        Geometry::Sphere(sphere) => Some(sphere::place(sphere, space, &p)),
        Geometry::Plane(plane) => Some(flat::place(plane, space, &p)),
        Geometry::Cuboid(cuboid) => Some(polyhedron::place_cuboid(cuboid, space, &p)),
        Geometry::Tetrahedron(solid) => Some(polyhedron::place_tetrahedron(solid, space, &p)),
        Geometry::Cone(cone) => (!cone.open).then(|| cone::place(cone, space, &p)),
        Geometry::Torus(torus) => Some(torus::place(torus, space, &p)),
        Geometry::Mesh(mesh) => mesh.is_closed().then(|| mesh::place(mesh, space, &p)),
        Geometry::Disc(_) | Geometry::Rectangle(_) | Geometry::Triangle(_) => None,
        Geometry::Custom(custom) => panic!("{} is the user's own shape", custom.name()),
    }
}
