//! Surfaces in one place, of which one is seen, as rounding has it.

use super::{About, Lint, MOST_COMPARED};
use lancer_kernel::figure;
use lancer_math::{Bounds, Vector, unit};
use lancer_scene::{Geometry, Scene, Shape};
use std::sync::Arc;

/// What is said of each.
const SEEN_BY_CHANCE: &str = "only one of them is seen, as rounding has it";

/// A flat face: its side of the plane n p = at.
struct Face {
    shape: usize,
    normal: Vector,
    at: f64,
    /// Its extent, where it has an end.
    bounds: Option<Bounds>,
}

/// Surfaces nearer to one another than this part of their coordinates are not told apart:
/// docs/stability.md has why.
pub(crate) const TOGETHER: f64 = 24.0 * f64::EPSILON;

/// Faces in one place, as far as those `near` one another are, that show the same side: which of them is
/// seen is as rounding has it.
pub(super) fn faces(scene: &Scene, near: f64, lints: &mut Vec<Lint>) {
    let mut faces = Vec::new();
    for (shape, it) in scene.shapes.iter().enumerate().take(MOST_COMPARED) {
        let bounds = figure::bounds(it);
        let mut add = |normal: Vector, at: f64, bounds| {
            faces.push(Face { shape, normal, at, bounds });
        };
        match &it.geometry {
            Geometry::Plane(plane) => {
                let Some(normal) = unit(plane.normal.get()) else { continue };
                add(normal, plane.origin.get().coords.dot(&normal), None);
            }
            Geometry::Cuboid(cuboid) => {
                for axis in 0..3 {
                    let (min, max) = (cuboid.min(), cuboid.max());
                    for (end, sign) in [(min, -1.0), (max, 1.0)] {
                        let mut normal = Vector::zeros();
                        normal[axis] = sign;
                        let (mut from, mut to) = (min, max);
                        (from[axis], to[axis]) = (end[axis], end[axis]);
                        let side = Bounds { min: from, max: to };
                        add(normal, sign * end[axis], Some(side));
                    }
                }
            }
            _ => {
                // Sheets lie in their boxes where those are flat, and are seen from both sides.
                let Some(bounds) = bounds else { continue };
                let sides = bounds.sides();
                let is_sheet = matches!(
                    it.geometry,
                    Geometry::Disc(_) | Geometry::Rectangle(_) | Geometry::Triangle(_)
                );
                let flat =
                    (0..3).find(|axis| is_sheet && sides[*axis] <= TOGETHER * bounds.reach());
                if let Some(axis) = flat {
                    for sign in [-1.0, 1.0] {
                        let mut normal = Vector::zeros();
                        normal[axis] = sign;
                        add(normal, sign * bounds.centre()[axis], Some(bounds));
                    }
                }
            }
        }
    }
    let mut told = Vec::new();
    for (k, a) in faces.iter().enumerate() {
        for b in &faces[k + 1..] {
            let pair = (a.shape, b.shape);
            let is_together = a.shape != b.shape
                && (a.at - b.at).abs() <= near
                && (a.normal - b.normal).amax() <= TOGETHER
                && overlap(a, b, near)
                && !told.contains(&pair);
            if !is_together {
                continue;
            }
            told.push(pair);
            let [one, other] = [a.shape, b.shape].map(|shape| {
                format!("shape {}, a {}", shape + 1, scene.shapes[shape].geometry.kind())
            });
            lints.push(Lint::new(
                About::Shape(b.shape),
                format!("{other}, and {one}, have a face in one place, seen from one side"),
                SEEN_BY_CHANCE,
                "move one of them a little off, or leave one out",
            ));
        }
    }
}

/// Shapes that stand twice in one place likewise, but for those of which faces are told of already.
pub(super) fn shapes(scene: &Scene, near: f64, lints: &mut Vec<Lint>) {
    let shapes = &scene.shapes[..scene.shapes.len().min(MOST_COMPARED)];
    for (number, shape) in shapes.iter().enumerate() {
        let first = shapes[..number].iter().position(|other| are_one(shape, other, near));
        let Some(first) = first else { continue };
        if lints
            .iter()
            .any(|lint| lint.about == About::Shape(number) && lint.label == SEEN_BY_CHANCE)
        {
            continue;
        }
        let kind = shape.geometry.kind();
        lints.push(Lint::new(
            About::Shape(number),
            format!(
                "shape {}, a {kind}, is where shape {} is, and as large",
                number + 1,
                first + 1
            ),
            SEEN_BY_CHANCE,
            "move one of them, or leave one out",
        ));
    }
}

/// Whether shapes have the same surface, but for rounding where they are spheres. Planes and boxes are
/// left to their faces.
fn are_one(a: &Shape, b: &Shape, near: f64) -> bool {
    match (&a.geometry, &b.geometry) {
        (Geometry::Sphere(a), Geometry::Sphere(b)) => {
            let apart = (a.centre.get() - b.centre.get()).amax();
            apart.max((a.radius.get() - b.radius.get()).abs()) <= near
        }
        (Geometry::Cone(a), Geometry::Cone(b)) => a == b,
        (Geometry::Torus(a), Geometry::Torus(b)) => a == b,
        (Geometry::Disc(a), Geometry::Disc(b)) => a == b,
        (Geometry::Rectangle(a), Geometry::Rectangle(b)) => a == b,
        (Geometry::Triangle(a), Geometry::Triangle(b)) => a == b,
        (Geometry::Tetrahedron(a), Geometry::Tetrahedron(b)) => a == b,
        (Geometry::Mesh(a), Geometry::Mesh(b)) => Arc::ptr_eq(a, b),
        _ => false,
    }
}

/// Whether two faces in one plane have more than an edge in common.
fn overlap(a: &Face, b: &Face, near: f64) -> bool {
    let (Some(one), Some(other)) = (&a.bounds, &b.bounds) else { return true };
    let wide = (0..3).filter(|&axis| {
        one.max[axis].min(other.max[axis]) - one.min[axis].max(other.min[axis]) > near
    });
    let apart = (0..3).any(|axis| {
        one.max[axis].min(other.max[axis]) - one.min[axis].max(other.min[axis]) < -near
    });
    !apart && wide.count() >= 2
}
