use super::dot;
use lancer_kernel::lanes::{Lanes, MOST, Mask, Real, Vectors};
use lancer_math::{Vector, unit};

/// As [`unit`], or the other vector where there is no direction.
#[inline(always)]
pub(in crate::whitted) fn units<L: Lanes>(
    lanes: L,
    v: &Vectors<L::Real>,
    other: &Vectors<L::Real>,
) -> Vectors<L::Real> {
    let largest = v.amax();
    let is_ordinary = largest.ge(lanes.splat(1e-100)) & largest.le(lanes.splat(1e100));
    if (!is_ordinary).any() {
        return strange_units(lanes, v, other);
    }
    let length = dot(v, v).sqrt();
    Vectors { x: v.x / length, y: v.y / length, z: v.z / length }
}

#[cold]
#[inline(never)]
fn strange_units<L: Lanes>(
    lanes: L,
    v: &Vectors<L::Real>,
    other: &Vectors<L::Real>,
) -> Vectors<L::Real> {
    let all: [Vector; MOST] = std::array::from_fn(|k| {
        let k = k.min(L::WIDTH - 1);
        unit(v.lane(k)).unwrap_or_else(|| other.lane(k))
    });
    let [x, y, z] = [0, 1, 2].map(|axis| all.map(|v| v[axis]));
    Vectors::load(lanes, [&x, &y, &z])
}
