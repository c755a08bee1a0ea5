//! Which shapes can hide a light, and whether they do.

use super::lanes::{Vectors, lanes_of};
use super::plane::Half;
use crate::World;
use lancer_math::{Point, Ray, Vector};
use wide::f64x4;

/// The ways from a point to up to four lights.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ways {
    /// The point.
    pub(super) origin: Point,
    /// To the light itself for lamps, unit vectors for suns.
    pub(super) vectors: Vectors,
    /// The squares of the vectors' lengths.
    pub(super) lengths_squared: f64x4,
    /// The squares of the distances to the lights; infinite for suns.
    pub(super) reaches: f64x4,
}

/// What may hide up to four lights. Spheres and custom shapes always may;
/// planes only if they are listed here.
#[derive(Debug, Clone)]
pub(super) struct Occluders {
    /// Lights that are hidden from everywhere, as bits.
    hidden: u32,
    /// The planes that may hide one of the lights from a point whose
    /// coordinates are all at most `proven_within` in size.
    planes: Vec<Half>,
    proven_within: f64,
}

impl Occluders {
    /// The ray to a sun has the same direction everywhere, and a plane is hit
    /// if that goes against its normal, wherever the ray starts: by the
    /// original's rule a hit may lie behind the origin. So a plane hides a sun
    /// from everywhere or from nowhere.
    pub(super) fn of_suns(towards: &[Vector], world: &World) -> Self {
        let hidden =
            |towards: &Vector| world.planes.iter().any(|plane| towards.dot(&plane.normal) < 0.0);
        let suns = towards.iter().enumerate();
        Self {
            hidden: suns.fold(0, |bits, (k, towards)| bits | u32::from(hidden(towards)) << k),
            planes: Vec::new(),
            proven_within: f64::INFINITY,
        }
    }

    /// Leaves out the planes that hide none of the lamps.
    pub(super) fn of_lamps(lamps: &[Vector], world: &World) -> Self {
        let mut proven_within = f64::INFINITY;
        let mut planes = world.planes.clone();
        planes.retain(|plane| {
            let within = lamps.iter().map(|lamp| never_hides(plane, lamp));
            match within.collect::<Option<Vec<_>>>() {
                None => true,
                Some(within) => {
                    proven_within = within.into_iter().fold(proven_within, f64::min);
                    false
                }
            }
        });
        Self { hidden: 0, planes, proven_within }
    }

    /// Which of the lights that are `asked` for are hidden, as bits; other bits
    /// mean nothing.
    ///
    /// The original asks for the nearest hit along the ray to the light and
    /// whether it is nearer than the light; any hit that is nearer answers the
    /// same. Nothing is divided, so the lengths of the ways need not be known.
    #[inline]
    pub(super) fn hidden(&self, world: &World, ways: &Ways, asked: u32) -> u32 {
        let mut hidden = self.hidden;
        if asked & !hidden == 0 {
            return hidden;
        }
        for sphere in &world.spheres {
            hidden |= sphere.hides(ways, asked);
        }
        let near = ways.origin.iter().all(|c| c.abs() <= self.proven_within);
        let planes = if near { &self.planes } else { &world.planes };
        if !planes.is_empty() {
            for k in lanes_of(asked & !hidden) {
                let way = ways.vectors.lane(k);
                let hides = planes.iter().any(|plane| plane.hides_lamp(&ways.origin, &way));
                hidden |= u32::from(hides) << k;
            }
        }
        if !world.customs.is_empty() {
            hidden |= hidden_by_customs(world, ways, asked & !hidden);
        }
        hidden
    }
}

/// Whether the plane hides a lamp from no point whose coordinates are at most
/// so large: it does not if the lamp is on its lit side.
///
/// Let h > 0 be the lamp's height over the plane and a that of the shaded
/// point. The ray to the lamp goes against the normal only if a > h; then it
/// meets the plane beyond the lamp, since a > a - h. In floating-point numbers
/// with unit roundoff u that holds as long as h is more than the sum of the
/// rounding errors: the heights err by at most 4 u (|point| + |lamp| + |origin|)
/// each, the slope of the way by another 5 u (|point| + |lamp|). Together that
/// is less than 64 u (|point| + |lamp| + |origin|), which bounds how large
/// |point| may be.
fn never_hides(plane: &Half, lamp: &Vector) -> Option<f64> {
    let height = lamp.dot(&plane.normal) - plane.offset;
    let size = lamp.norm() + plane.origin.coords.norm();
    // A point with coordinates up to c is at most 2 c from the origin.
    let within = (height / (32.0 * f64::EPSILON) - size) / 2.0;
    (within > size).then_some(within)
}

#[cold]
fn hidden_by_customs(world: &World, ways: &Ways, asked: u32) -> u32 {
    let lengths = ways.lengths_squared.sqrt().to_array();
    let reaches = ways.reaches.to_array();
    let hidden = |k: usize| {
        let ray = Ray::new(ways.origin, ways.vectors.lane(k) / lengths[k]);
        let mut distances = world.customs.iter().filter_map(|custom| custom.nearest(&ray));
        distances.any(|distance| distance * distance < reaches[k])
    };
    lanes_of(asked).fold(0, |bits, k| bits | u32::from(hidden(k)) << k)
}
