//! Meshes: each triangle by itself.

use super::flat::facet;
use crate::crossing::Found;
use crate::{Line, Number, Place, Space, Triple};
use lancer_scene::Mesh;

pub(super) fn meet(mesh: &Mesh, space: &Space, line: &Line, bits: usize) -> Found {
    let mut all = Found::nothing(f64::INFINITY);
    for triangle in 0..mesh.triangle_count() {
        let corners = mesh.corners(triangle).map(|corner| space.point(corner));
        let (found, parts) = facet(&corners, line, bits);
        all.margin = all.margin.min(found.margin);
        for mut local in found.list {
            local.face = triangle;
            local.shading_normal = smooth(mesh, triangle, &parts, &local.normal, bits);
            all.list.push(local);
        }
    }
    all.list.sort_by(|a, b| a.t.cmp(&b.t));
    all
}

/// The mean of the normals at the corners, each made a unit vector, by the parts
/// that the corners have in the place.
fn smooth(
    mesh: &Mesh,
    triangle: usize,
    parts: &[Number; 3],
    flat: &Triple,
    bits: usize,
) -> Option<Triple> {
    let normals = mesh.corner_normals(triangle)?;
    let mut sum = Triple::zero();
    for (normal, part) in normals.into_iter().zip(parts) {
        let normal: Triple = normal.into();
        let normal = if normal.is_zero() { flat.clone() } else { normal };
        sum = &sum + &normal.unit(bits).times(&part.abs());
    }
    (!sum.is_zero()).then_some(sum)
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
        for triangle in 0..mesh.triangle_count() {
            let corners = mesh.corners(triangle).map(|corner| space.point(corner));
            let (found, parts) = facet(&corners, &line, 64);
            for local in &found.list {
                if local.t.is_zero() {
                    return None;
                }
                if local.t.signum() > 0 {
                    clean &= parts.iter().all(|part| !part.is_zero());
                    sum += if local.passage == crate::Passage::Leaves { 1 } else { -1 };
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
