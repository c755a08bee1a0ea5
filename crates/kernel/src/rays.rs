use crate::lanes::{Lanes, MOST, Mask, Real, Vectors, larger, smaller};
use crate::near::ordinary;
use lancer_math::{Ray, Vector};

/// A ray for each lane.
#[derive(Debug, Clone, Copy)]
pub struct Rays<L: Lanes> {
    /// Where they start.
    pub origin: Vectors<L::Real>,
    /// Which way they go; of any length.
    pub direction: Vectors<L::Real>,
    pub(crate) lanes: L,
}

/// The directions of rays, times a power of two where their squares would be out of
/// range, with what every ball asks of them computed once.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tame<R> {
    pub(crate) direction: Vectors<R>,
    /// That power of two.
    pub(crate) unit: R,
    pub(crate) squared: R,
}

impl<L: Lanes> Rays<L> {
    /// These rays.
    #[inline(always)]
    pub fn new(lanes: L, origin: Vectors<L::Real>, direction: Vectors<L::Real>) -> Self {
        Self { origin, direction, lanes }
    }

    #[inline(always)]
    pub(crate) fn tame(&self) -> Tame<L::Real> {
        let lanes = self.lanes;
        let largest = self.direction.amax();
        let is_tame = largest.ge(lanes.splat(1e-100)) & largest.le(lanes.splat(1e100));
        let (direction, unit) = if (!is_tame).any() {
            tamed(lanes, &self.direction)
        } else {
            (self.direction, lanes.splat(1.0))
        };
        Tame { direction, unit, squared: direction.norm_squared() }
    }

    /// The same ray in each lane.
    #[inline(always)]
    pub fn splat(lanes: L, ray: &Ray) -> Self {
        let direction = Vectors::splat(lanes, &ray.direction);
        Self::new(lanes, Vectors::splat_point(lanes, &ray.origin), direction)
    }

    /// The ray of a lane.
    #[inline(always)]
    pub fn lane(&self, k: usize) -> Ray {
        Ray::new(self.origin.lane(k).into(), self.direction.lane(k))
    }
}

#[cold]
#[inline(never)]
fn tamed<L: Lanes>(lanes: L, direction: &Vectors<L::Real>) -> (Vectors<L::Real>, L::Real) {
    let tamed: [(Vector, f64); MOST] =
        std::array::from_fn(|k| ordinary(&direction.lane(k.min(L::WIDTH - 1))));
    let [x, y, z] = [0, 1, 2].map(|axis| tamed.map(|(direction, _)| direction[axis]));
    (Vectors::load(lanes, [&x, &y, &z]), lanes.load(&tamed.map(|(_, unit)| unit)))
}

/// Two places on each ray where it crosses a surface, the nearer one first; not a
/// number where there is none.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pairs<R> {
    pub(crate) near: R,
    pub(crate) far: R,
}

impl<R: Real> Pairs<R> {
    #[inline(always)]
    pub(crate) fn sorted(a: R, b: R) -> Self {
        Self { near: smaller(a, b), far: larger(a, b) }
    }

    /// The first one ahead; behind or not a number where there is none.
    #[inline(always)]
    pub(crate) fn ahead(&self, zero: R) -> R {
        self.near.gt(zero).select(self.near, self.far)
    }
}
