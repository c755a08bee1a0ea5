//! The arithmetic that the engines of the original share with their plain
//! transcription.

use lancer_kernel::lanes::{Lanes, Real, Vectors};

/// The sum of the products, from the first coordinate to the last, each sum fused:
/// the other way round than [`Vectors::dot`].
#[inline(always)]
pub(super) fn dot<R: Real>(a: &Vectors<R>, b: &Vectors<R>) -> R {
    a.z.mul_add(b.z, a.y.mul_add(b.y, a.x * b.x))
}

/// So many steps from a point in a direction.
#[inline(always)]
pub(super) fn after<R: Real>(point: &Vectors<R>, steps: R, direction: &Vectors<R>) -> Vectors<R> {
    direction.mul_add(steps, *point)
}

/// Made as long as 1: times the inverse of the length. Not a unit vector for
/// zero and for what is too small or too large to be squared.
#[inline(always)]
pub(super) fn unit<L: Lanes>(lanes: L, v: &Vectors<L::Real>) -> Vectors<L::Real> {
    *v * (lanes.splat(1.0) / dot(v, v).sqrt())
}

/// The direction in which a mirror with that unit normal sends another.
#[inline(always)]
pub(super) fn mirrored<R: Real>(direction: &Vectors<R>, normal: &Vectors<R>) -> Vectors<R> {
    after(direction, dot(direction, normal) * -2.0, normal)
}
