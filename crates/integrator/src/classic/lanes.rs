//! Four of a kind side by side.
//!
//! Every 64-bit machine computes on two doubles at once; each lane gives
//! exactly what it would give alone, so this changes no bit.

use lancer_math::{Point, Vector};
use wide::f64x4;

/// How many lanes there are.
pub(super) const LANES: usize = 4;

/// A vector for each lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vectors {
    pub(super) x: f64x4,
    pub(super) y: f64x4,
    pub(super) z: f64x4,
}

/// What `f` gives for each lane.
pub(super) fn each(f: impl FnMut(usize) -> f64) -> f64x4 {
    f64x4::from(std::array::from_fn::<f64, LANES, _>(f))
}

/// The lanes whose bits are set.
pub(super) fn lanes_of(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        lane
    })
}

impl Vectors {
    pub(super) fn each(mut f: impl FnMut(usize) -> Vector) -> Self {
        let vectors: [Vector; LANES] = std::array::from_fn(&mut f);
        Self { x: each(|k| vectors[k].x), y: each(|k| vectors[k].y), z: each(|k| vectors[k].z) }
    }

    pub(super) fn lane(&self, k: usize) -> Vector {
        Vector::new(self.x.to_array()[k], self.y.to_array()[k], self.z.to_array()[k])
    }

    /// Made as long as 1, as `naive_unit` does it.
    #[inline(always)]
    pub(super) fn naive_unit(&self) -> Self {
        let length = self.norm_squared().sqrt();
        Self { x: self.x / length, y: self.y / length, z: self.z / length }
    }

    /// The vectors from `point` to these.
    #[inline(always)]
    pub(super) fn minus(&self, point: &Point) -> Self {
        Self { x: self.x - point.x, y: self.y - point.y, z: self.z - point.z }
    }

    #[inline(always)]
    pub(super) fn dot(&self, v: &Vector) -> f64x4 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }

    #[inline(always)]
    pub(super) fn norm_squared(&self) -> f64x4 {
        self.x * self.x + self.y * self.y + self.z * self.z
    }
}
