//! Meshes: each triangle by itself. A mesh that is closed but faces inwards is
//! turned, so that its normals point outward.

use super::flat::facet;
use crate::crossing::Found;
use crate::{Line, Number, Passage, Place, Space, Triple};
use lancer_scene::Mesh;

pub(super) fn meet(mesh: &Mesh, space: &Space, line: &Line, bits: usize) -> Found {
    let mut all = Found::nothing(f64::INFINITY);
    let turned = mesh.is_closed() && mesh.signed_volume() < 0.0;
    let sketch = Sketch::new(line, space);
    for triangle in 0..mesh.triangle_count() {
        if let Some(margin) = sketch.missed(mesh, triangle) {
            all.margin = all.margin.min(margin);
            continue;
        }
        let corners = mesh.corners(triangle).map(|corner| space.point(corner));
        let (found, parts) = facet(&corners, line, bits);
        all.margin = all.margin.min(found.margin);
        for mut local in found.list {
            local.face = triangle;
            let flat = local.normal.clone();
            if turned {
                local.normal = -&local.normal;
                local.passage = Passage::through(&local.normal, &line.direction);
            }
            local.shading_normal = smooth(mesh, triangle, &parts, &flat, &local.normal, bits);
            all.list.push(local);
        }
    }
    all.list.sort_by(|a, b| a.t.cmp(&b.t));
    all
}

/// The line in doubles, to pass over triangles that it misses by far: most of a
/// large mesh. What it does not miss by far is left to exact numbers.
struct Sketch {
    origin: [f64; 3],
    direction: [f64; 3],
    stretch: f64,
    length: f64,
}

impl Sketch {
    /// A miss by less than this share of the triangle's size is not passed over.
    const FAR: f64 = 1e-6;

    fn new(line: &Line, space: &Space) -> Self {
        let direction = line.direction.to_f64();
        Self {
            origin: line.origin.to_f64(),
            direction,
            stretch: space.stretch().to_f64(),
            length: dot(direction, direction).sqrt(),
        }
    }

    /// The margin by which a triangle is missed, if that is certain.
    fn missed(&self, mesh: &Mesh, triangle: usize) -> Option<f64> {
        let corners = mesh.corners(triangle).map(|p| [p.x, p.y, p.z].map(|c| c * self.stretch));
        let [a, b, c] = corners.map(|corner| minus(corner, self.origin));
        let sides = [minus(b, c), minus(c, a), minus(a, b)];
        let volumes = [(b, c), (c, a), (a, b)].map(|(p, q)| dot(self.direction, cross(p, q)));
        let largest = |points: [[f64; 3]; 3]| {
            points.into_iter().flatten().fold(0.0, |most: f64, c| most.max(c.abs()))
        };
        let far = largest([a, b, c]);
        // Coordinates are off by less than 2^-50 of the largest of them, and a
        // volume is a sum of 6 products of them; this is wider by far.
        let numbers = largest([self.origin, corners[0], corners[1]]).max(largest(corners));
        let slack = self.length * far * numbers.max(far) * 1e-13;
        let longest = sides.map(|side| dot(side, side)).into_iter().fold(0.0, f64::max);
        let scale = self.length * longest;
        let (mut least, mut above, mut below) = (f64::INFINITY, false, false);
        for volume in volumes {
            above |= volume > slack;
            below |= volume < -slack;
            least = least.min(volume.abs() - slack);
        }
        let margin = least / scale;
        // Not for NaN either.
        (above && below && margin > Self::FAR).then_some(margin)
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The mean of the normals at the corners, each made a unit vector, by the parts
/// that the corners have in the place; on the side of `facet`, the triangle's normal.
/// A corner's normal that is zero stands for `flat`, that by the order of corners.
fn smooth(
    mesh: &Mesh,
    triangle: usize,
    parts: &[Number; 3],
    flat: &Triple,
    facet: &Triple,
    bits: usize,
) -> Option<Triple> {
    let normals = mesh.corner_normals(triangle)?;
    let mut sum = Triple::zero();
    for (normal, part) in normals.into_iter().zip(parts) {
        let normal: Triple = normal.into();
        let normal = if normal.is_zero() { flat.clone() } else { normal };
        sum = &sum + &normal.unit(bits).times(&part.abs());
    }
    match sum.dot(facet).signum() {
        0 => None,
        1 => Some(sum),
        _ => Some(-&sum),
    }
}

/// How often the triangles of a mesh go around a point, by the solid angles that
/// they cover as seen from it, counted along a line that meets no edge: each
/// triangle that it leaves through counts one, each that it enters through minus
/// one. `None` for a point on the mesh.
fn winding(mesh: &Mesh, space: &Space, p: &Triple) -> Option<i32> {
    // Any direction will do that does not happen to meet an edge.
    for attempt in 0..64 {
        let k = f64::from(attempt);
        let direction = Triple::from([1.0 + k * 0.37, 0.618 - k * 0.11, 0.271 + k * 0.173]);
        let line = Line { origin: p.clone(), direction };
        let mut sum = 0;
        let mut clean = true;
        let sketch = Sketch::new(&line, space);
        for triangle in 0..mesh.triangle_count() {
            if sketch.missed(mesh, triangle).is_some() {
                continue;
            }
            let corners = mesh.corners(triangle).map(|corner| space.point(corner));
            let (found, parts) = facet(&corners, &line, 64);
            for local in &found.list {
                if local.t.is_zero() {
                    return None;
                }
                if local.t.signum() > 0 {
                    clean &= parts.iter().all(|part| !part.is_zero());
                    sum += if local.passage == Passage::Leaves { 1 } else { -1 };
                }
            }
            clean &= found.margin > 0.0;
        }
        if clean {
            return Some(sum);
        }
    }
    None
}

pub(super) fn place(mesh: &Mesh, space: &Space, p: &Triple) -> Place {
    match winding(mesh, space, p) {
        None => Place::Border,
        Some(0) => Place::Outside,
        Some(_) => Place::Inside,
    }
}
