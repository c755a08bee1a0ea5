//! Boxes and tetrahedra, as what several half-spaces have in common: a line is in
//! each of them from or up to some place, and the order of places is exact.

use crate::crossing::{Found, Local, ratio, sine};
use crate::{Line, Number, Passage, Place, Space, Triple};
use lancer_math::Vector;
use lancer_scene::{Cuboid, Tetrahedron};

/// A point of a face and the normal out of it.
struct Face {
    point: Triple,
    normal: Triple,
}

/// The faces at the smallest coordinates (x, y, z), then those at the largest.
fn faces_of_cuboid(cuboid: &Cuboid, space: &Space) -> Vec<Face> {
    let (min, max) = (space.point(cuboid.min()), space.point(cuboid.max()));
    let axes = [Vector::x(), Vector::y(), Vector::z()];
    let low = axes.map(|axis| Face { point: min.clone(), normal: (-axis).into() });
    let high = axes.map(|axis| Face { point: max.clone(), normal: axis.into() });
    low.into_iter().chain(high).collect()
}

/// The face opposite to each corner.
fn faces_of_tetrahedron(solid: &Tetrahedron, space: &Space) -> Vec<Face> {
    let corners = solid.corners().map(|corner| space.point(corner));
    (0..4)
        .map(|k| {
            let [a, b, c] = [1, 2, 3].map(|i| &corners[(k + i) % 4]);
            let normal = (b - a).cross(&(c - a));
            // Away from the corner that is not in it.
            let outward = normal.dot(&(&corners[k] - a)).signum() < 0;
            Face { point: a.clone(), normal: if outward { normal } else { -&normal } }
        })
        .collect()
}

/// The square of the largest extent.
fn size_squared(points: impl Iterator<Item = Triple> + Clone) -> Number {
    let pairs = points.clone().flat_map(|p| points.clone().map(move |q| (&p - &q).norm_squared()));
    pairs.max().unwrap_or_else(Number::zero)
}

pub(super) fn meet_cuboid(cuboid: &Cuboid, space: &Space, line: &Line, bits: usize) -> Found {
    let extent = &space.point(cuboid.max()) - &space.point(cuboid.min());
    meet(&faces_of_cuboid(cuboid, space), &extent.norm_squared(), line, bits)
}

pub(super) fn meet_tetrahedron(
    solid: &Tetrahedron,
    space: &Space,
    line: &Line,
    bits: usize,
) -> Found {
    let size = size_squared(solid.corners().into_iter().map(|corner| space.point(corner)));
    meet(&faces_of_tetrahedron(solid, space), &size, line, bits)
}

/// A face that the line passes at n / d, with d above 0.
struct Passed {
    face: usize,
    n: Number,
    d: Number,
}

fn meet(faces: &[Face], size_squared: &Number, line: &Line, bits: usize) -> Found {
    let (mut entry, mut exit): (Option<Passed>, Option<Passed>) = (None, None);
    // The smallest distance from a face that the line is parallel to.
    let mut beside = f64::INFINITY;
    let mut outside = false;
    for (face, Face { point, normal }) in faces.iter().enumerate() {
        let n = normal.dot(&(point - &line.origin));
        let d = normal.dot(&line.direction);
        let later = |a: &Passed, n: &Number, d: &Number| (&a.n * d).cmp(&(n * &a.d));
        match d.signum() {
            0 => {
                outside |= n.signum() < 0;
                let scale = normal.norm_squared() * size_squared;
                beside = beside.min(ratio(&n.squared(), &scale).sqrt());
            }
            1 => {
                if exit.as_ref().is_none_or(|e| later(e, &n, &d).is_gt()) {
                    exit = Some(Passed { face, n, d });
                }
            }
            _ => {
                let (n, d) = (-n, -d);
                if entry.as_ref().is_none_or(|e| later(e, &n, &d).is_lt()) {
                    entry = Some(Passed { face, n, d });
                }
            }
        }
    }
    let (Some(entry), Some(exit)) = (entry, exit) else {
        return Found::nothing(beside);
    };
    // How much of the line is inside: exit less entry, times both denominators.
    let inside = &exit.n * &entry.d - &entry.n * &exit.d;
    let both = &entry.d * &exit.d;
    let length_squared = line.direction.norm_squared() * inside.squared();
    let chord = ratio(&length_squared, &(both.squared() * size_squared)).sqrt();
    let tilt = |passed: &Passed| sine(&faces[passed.face].normal, &line.direction);
    let margin = beside.min(chord * tilt(&entry).min(tilt(&exit)));
    if outside || inside.signum() < 0 {
        return Found::nothing(margin);
    }
    let crossing = |passed: &Passed, passage: Passage| {
        let place = &line.origin.times(&passed.d) + &line.direction.times(&passed.n);
        let away = faces.iter().enumerate().filter(|(k, _)| *k != passed.face).map(|(_, other)| {
            let depth = other.normal.dot(&(&place - &other.point.times(&passed.d)));
            let scale = passed.d.squared() * other.normal.norm_squared() * size_squared;
            ratio(&depth.squared(), &scale).sqrt()
        });
        Local {
            t: passed.n.over(&passed.d, bits),
            normal: faces[passed.face].normal.clone(),
            shading_normal: None,
            passage,
            face: passed.face,
            seam: away.fold(f64::INFINITY, f64::min),
        }
    };
    let list = if inside.is_zero() {
        vec![crossing(&entry, Passage::Touches)]
    } else {
        vec![crossing(&entry, Passage::Enters), crossing(&exit, Passage::Leaves)]
    };
    Found { list, margin }
}

fn place(faces: &[Face], p: &Triple) -> Place {
    let heights = faces.iter().map(|face| face.normal.dot(&(p - &face.point)).signum());
    match heights.max() {
        Some(-1) => Place::Inside,
        Some(0) => Place::Border,
        _ => Place::Outside,
    }
}

pub(super) fn place_cuboid(cuboid: &Cuboid, space: &Space, p: &Triple) -> Place {
    place(&faces_of_cuboid(cuboid, space), p)
}

pub(super) fn place_tetrahedron(solid: &Tetrahedron, space: &Space, p: &Triple) -> Place {
    place(&faces_of_tetrahedron(solid, space), p)
}
