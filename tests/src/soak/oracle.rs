//! Crossings to hundreds of bits, which decide whether those in double-double
//! numbers are right.

use super::case::{Case, Entry};
use super::dd::Dd;
use lancer_math::{Point, Ray};
use lancer_oracle::{Line, Number, Passage, Space, passages};
use lancer_scene::{Geometry, Mesh};
use std::sync::Arc;

/// Right to so many bits; double-double numbers have about 100.
const BITS: usize = 128;

/// A decision by less than this, as a share of the size of the scene seen from a ray,
/// cannot always be had in double-double numbers: it is a thirtieth of the band.
const UNDECIDED: f64 = 1e-15;

/// Distances from the surface agree to this, as a share of that size: a thousandth of
/// a rounding of the kernel's.
const AGREES: f64 = 1e-19;

/// Where the shapes of a scene stand, exactly.
#[derive(Debug)]
pub(crate) struct Oracle {
    spaces: Vec<Space>,
}

impl Oracle {
    pub(crate) fn new(case: &Case) -> Self {
        let space = |item| Space::world().inside(case.placement(item));
        Self { spaces: (0..case.item_count()).map(space).collect() }
    }

    /// Where it sees the ray cross other things of some items than these: what is wrong.
    pub(crate) fn contradiction(
        &self,
        case: &Case,
        ray: &Ray,
        entries: &[Entry],
        items: impl IntoIterator<Item = u32>,
    ) -> Option<String> {
        let line = Line::from(ray);
        items.into_iter().find_map(|item| {
            let own: Vec<&Entry> = entries.iter().filter(|e| e.item == item).collect();
            let found = exactly(case, item, &self.spaces[item as usize], &line, ray);
            differ(&own, &found).map(|what| format!("item {item}, says the oracle: {what}"))
        })
    }
}

/// The crossings of an item where that changes sides.
fn exactly(case: &Case, item: u32, space: &Space, line: &Line, ray: &Ray) -> Vec<Number> {
    let geometry = &case.subject(item).shape.geometry;
    let found = match geometry {
        Geometry::Mesh(mesh) => {
            let placement = case.placement(item);
            let direction = placement.local_vector(&ray.direction);
            let own = Ray::new(placement.local_point(&ray.origin), direction);
            let Some(part) = near_triangles(mesh, &own) else { return Vec::new() };
            passages(&Geometry::Mesh(Arc::new(part)), space, line, BITS)
        }
        other => passages(other, space, line, BITS),
    };
    let passes = found.into_iter().filter(|(_, passage)| *passage != Passage::Touches);
    passes.map(|(t, _)| t).collect()
}

/// The triangles of a mesh that a line may come near to: all of them would take
/// too long.
fn near_triangles(mesh: &Mesh, ray: &Ray) -> Option<Mesh> {
    let direction = ray.direction / ray.direction.norm();
    let is_near = |corners: &[Point; 3]| {
        let middle = (corners[0].coords + corners[1].coords + corners[2].coords) / 3.0;
        let reach = corners.iter().map(|c| (c.coords - middle).norm()).fold(0.0, f64::max);
        let to_middle = middle - ray.origin.coords;
        let aside = (to_middle - direction * to_middle.dot(&direction)).norm();
        let scale = to_middle.norm() + middle.norm() + ray.origin.coords.norm();
        aside <= 1.01 * reach + 1e-9 * scale
    };
    let all = (0..mesh.triangle_count()).map(|triangle| mesh.corners(triangle));
    let near: Vec<[f64; 3]> = all.filter(is_near).flatten().map(|c| [c.x, c.y, c.z]).collect();
    let count = near.len() as u32;
    let triangles = (0..count / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    (count > 0).then(|| Mesh::new(near, triangles).expect("triangles of a mesh"))
}

/// To the digits of two doubles.
fn long(number: &Number) -> Dd {
    let high = number.to_f64();
    Dd::from(high) + Dd::from((number - &Number::from(high)).to_f64())
}

fn differ(own: &[&Entry], found: &[Number]) -> Option<String> {
    if own.iter().any(|e| e.crossing.margin < UNDECIDED) {
        return None;
    }
    let there: Vec<&&Entry> = own.iter().filter(|e| e.crossing.is_there).collect();
    let places: Vec<Dd> = found.iter().map(long).collect();
    if there.len() != places.len() {
        return Some(format!("{} crossings, not {}", places.len(), there.len()));
    }
    there.iter().zip(&places).find_map(|(e, t)| {
        let off = (e.crossing.t - *t).abs().round() * e.line.length * e.local_cosine;
        let reach = e.line.scale + e.line.growth * t.round().abs() * e.line.length;
        let agrees = off <= AGREES * reach || e.crossing.slack > 0.0;
        (!agrees)
            .then(|| format!("crossed at {:e}, {:e} of the scene beside", t.round(), off / reach))
    })
}
