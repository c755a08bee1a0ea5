//! What encloses the points and directions of a range of rays.

use crate::rows::Triples;
use lancer_kernel::lanes::{Lanes, MOST, Mask, Real, Vectors, smaller};
use lancer_math::{Bounds, Vector};
use std::ops::Range;

/// The larger one; the second where one is not a number.
#[inline(always)]
pub(crate) fn max<R: Real>(a: R, b: R) -> R {
    a.gt(b).select(a, b)
}

/// The sum, or another fold, of the lanes.
#[inline(always)]
pub(crate) fn fold<L: Lanes>(_: L, register: L::Real, fold: fn(f64, f64) -> f64) -> f64 {
    let mut each = [0.0; MOST];
    register.store(&mut each);
    let mut all = each[0];
    for x in &each[1..L::WIDTH] {
        all = fold(all, *x);
    }
    all
}

#[inline(always)]
fn fold_each<L: Lanes>(lanes: L, v: &Vectors<L::Real>, f: fn(f64, f64) -> f64) -> Vector {
    Vector::new(fold(lanes, v.x, f), fold(lanes, v.y, f), fold(lanes, v.z, f))
}

/// Calls `each` with registers that hold all of a range, some perhaps twice.
#[inline(always)]
fn each_register<L: Lanes>(
    lanes: L,
    from: &Triples,
    range: Range<usize>,
    mut each: impl FnMut(Vectors<L::Real>),
) {
    if range.len() < L::WIDTH {
        let v = from.load(lanes, range.start);
        let first = Vectors::splat(lanes, &v.lane(0));
        each(Vectors::select(lanes.first(range.len()), v, first));
        return;
    }
    let last = range.end - L::WIDTH;
    let mut i = range.start;
    while i < last {
        each(from.load(lanes, i));
        i += L::WIDTH;
    }
    each(from.load(lanes, last));
}

/// A box around points, of which those that are not numbers are left out: from them
/// nothing is met.
#[inline(always)]
pub(crate) fn extent<L: Lanes>(lanes: L, points: &Triples, range: Range<usize>) -> Bounds {
    let big = lanes.splat(f64::INFINITY);
    let mut least = Vectors { x: big, y: big, z: big };
    let mut most = -least;
    each_register(
        lanes,
        points,
        range,
        #[inline(always)]
        |p| {
            least = Vectors {
                x: smaller(p.x, least.x),
                y: smaller(p.y, least.y),
                z: smaller(p.z, least.z),
            };
            most = Vectors { x: max(p.x, most.x), y: max(p.y, most.y), z: max(p.z, most.z) };
        },
    );
    Bounds {
        min: fold_each(lanes, &least, f64::min).into(),
        max: fold_each(lanes, &most, f64::max).into(),
    }
}

/// An axis amid unit vectors, and the least cosine between it and one of them. Those
/// that are not numbers are left out of the latter: along them nothing is met. Where
/// they cancel, the axis is no number.
#[inline(always)]
pub(crate) fn cone<L: Lanes>(lanes: L, directions: &Triples, range: Range<usize>) -> (Vector, f64) {
    let mut sum = Vectors::splat(lanes, &Vector::zeros());
    each_register(
        lanes,
        directions,
        range.clone(),
        #[inline(always)]
        |d| sum = sum + d,
    );
    let sum = fold_each(lanes, &sum, |a, b| a + b);
    let axis = sum / sum.norm();
    let axes = Vectors::splat(lanes, &axis);
    let mut cosine = lanes.splat(1.0);
    each_register(
        lanes,
        directions,
        range,
        #[inline(always)]
        |d| cosine = smaller(d.dot(&axes), cosine),
    );
    (axis, fold(lanes, cosine, f64::min))
}
