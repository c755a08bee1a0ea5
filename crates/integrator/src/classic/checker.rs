//! Which of its two colours a checker shows.

use super::naive_unit;
use super::vectors::dot;
use lancer_kernel::lanes::{Lanes, Mask, Real, Vectors};
use lancer_math::Vector;

/// The smallest double not below sin(k / 2), for k = 1, 2, 3: from there on
/// trunc(2 |asin s|) is at least k.
const SINES: [f64; 3] = [0.479_425_538_604_203, 0.841_470_984_807_896_6, 0.997_494_986_604_054_4];

/// The largest double not above cos(k / 2), for k = 1 to 6: up to there
/// trunc(2 acos c) is at least k.
const COSINES: [f64; 6] = [
    0.877_582_561_890_372_6,
    0.540_302_305_868_139_7,
    0.070_737_201_667_702_9,
    -0.416_146_836_547_142_4,
    -0.801_143_615_546_933_8,
    -0.989_992_496_600_445_5,
];

/// Which points of a sphere, with those normals, show the second colour.
///
/// The original's cells are trunc(2 |asin z|), plus 1 below the equator, and
/// trunc(2 acos x) of the normal turned into the equator's plane; odd sums show
/// the second colour. Comparing with sines and cosines of the cells' borders
/// decides the same without the system's `asin` and `acos`.
#[inline(always)]
pub(super) fn on_sphere<L: Lanes>(lanes: L, normals: &Vectors<L::Real>) -> L::Mask {
    let size = normals.z.abs();
    let mut odd = normals.z.lt(lanes.splat(0.0)).bits();
    for border in SINES {
        odd ^= size.ge(lanes.splat(border)).bits();
    }
    let (x, y) = (normals.x, normals.y);
    let on_equator = x / y.mul_add(y, x * x).sqrt();
    for border in COSINES {
        odd ^= on_equator.le(lanes.splat(border)).bits();
    }
    lanes.mask(odd)
}

/// The directions along which cells are counted on a plane.
pub(super) fn axes_on_plane(normal: Vector) -> [Vector; 2] {
    let first = if normal == Vector::x() || normal == -Vector::x() {
        normal.cross(&Vector::y())
    } else {
        normal.cross(&Vector::x())
    };
    let first = naive_unit(first);
    [first, normal.cross(&first)]
}

/// Which points, at those offsets from a plane's origin, show the second colour.
#[inline(always)]
pub(super) fn on_plane<L: Lanes>(
    lanes: L,
    offsets: &Vectors<L::Real>,
    axes: &[Vector; 2],
) -> L::Mask {
    let [first, second] = axes;
    let first = odd_cells(lanes, dot(offsets, &Vectors::splat(lanes, first)));
    let second = odd_cells(lanes, dot(offsets, &Vectors::splat(lanes, second)));
    lanes.mask(first ^ second)
}

/// Whether trunc|i|, plus 1 where i is negative, is odd, as bits.
///
/// The original truncates to a 32-bit whole number, which on its machine gave
/// -2^31, an even number, for all that does not fit.
#[inline(always)]
fn odd_cells<L: Lanes>(lanes: L, i: L::Real) -> u32 {
    let size = i.abs();
    let even_below = (size * 0.5).floor() * 2.0;
    // Without rounding: both have the same unit.
    let odd = (size - even_below).ge(lanes.splat(1.0)) & size.lt(lanes.splat(2_147_483_648.0));
    odd.bits() ^ i.lt(lanes.splat(0.0)).bits()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lancer_kernel::lanes::One;

    #[test]
    fn borders_are_where_the_sines_and_cosines_are() {
        for (k, border) in (1_u8..).zip(SINES) {
            let sine = libm::sin(f64::from(k) / 2.0);
            assert!((border - sine).abs() <= f64::EPSILON, "sin {k}/2");
        }
        for (k, border) in (1_u8..).zip(COSINES) {
            let cosine = libm::cos(f64::from(k) / 2.0);
            assert!((border - cosine).abs() <= f64::EPSILON, "cos {k}/2");
        }
    }

    #[test]
    fn cells_are_those_of_the_arcs() {
        let mut state = 7_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        for case in 0..100_000 {
            let normal = naive_unit(Vector::new(next(), next(), next()));
            let latitude = (2.0 * libm::asin(normal.z).abs()) as i32 + i32::from(normal.z < 0.0);
            let turned = naive_unit(Vector::new(normal.x, normal.y, 0.0));
            let longitude = (2.0 * libm::acos(turned.x)) as i32;
            let second = on_sphere(One, &normal.into()).any();
            assert_eq!(second, (latitude + longitude) % 2 == 1, "case {case}");
        }
    }

    #[test]
    fn cells_of_a_plane_alternate_and_do_not_overflow() {
        let axes = axes_on_plane(Vector::z());
        for (i, j) in [(0.5, 0.5), (3.2, -7.9), (-0.1, -0.1), (-2.5, 4.5)] {
            let at =
                |i: f64, j: f64| on_plane(One, &(axes[0] * i + axes[1] * j).into(), &axes).any();
            assert_ne!(at(i, j), at(i + 1.0, j), "{i} {j}");
            assert_ne!(at(i, j), at(i, j - 1.0), "{i} {j}");
            assert_eq!(at(i, j), at(i + 1.0, j + 1.0), "{i} {j}");
        }
        for far in [1e10, 1e100, f64::INFINITY, f64::NAN] {
            assert_eq!(odd_cells(One, far), 0);
        }
    }
}
