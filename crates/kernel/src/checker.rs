//! Cells of a checker along one coordinate, and of two together.

use crate::lanes::{Lanes, Mask, Real};
use crate::primitive::Cell;

const LARGEST: f64 = 4_503_599_627_370_496.0; // 2^52

/// Whether floor(x) is odd; `None` where x is so large that doubles have no
/// fractions, or not a number.
#[inline]
fn odd(x: f64) -> Option<bool> {
    // The remainder is exact.
    (x.abs() <= LARGEST).then(|| libm::floor(x) % 2.0 != 0.0)
}

/// The cell at two coordinates, each in cells.
#[inline]
pub(crate) fn cell(i: f64, j: f64) -> Cell {
    match (odd(i), odd(j)) {
        (Some(i), Some(j)) if i == j => Cell::First,
        (Some(_), Some(_)) => Cell::Second,
        _ => Cell::Mixed,
    }
}

/// In which lanes two coordinates, each in cells, are in a cell of the second
/// kind; `None` where one of them is mixed.
#[inline(always)]
pub(crate) fn second<L: Lanes>(lanes: L, i: L::Real, j: L::Real) -> Option<L::Mask> {
    let largest = lanes.splat(LARGEST);
    let is_told = i.abs().le(largest) & j.abs().le(largest);
    if (!is_told).any() {
        return None;
    }
    let [i, j] = [odd_lanes(i), odd_lanes(j)];
    Some((i & !j) | (j & !i))
}

/// Whether floor(x) is odd.
#[inline(always)]
fn odd_lanes<R: Real>(x: R) -> R::Mask {
    let half = x.floor() * 0.5;
    !half.floor().eq(half)
}

/// The angle of (x, y) around the origin in degrees, from 0 up to below 360; 0
/// at the origin itself.
#[inline]
pub(crate) fn turn(x: f64, y: f64) -> f64 {
    let degrees = libm::atan2(y, x).to_degrees();
    let degrees = if degrees < 0.0 { degrees + 360.0 } else { degrees };
    // Just below the x axis the sum rounds up to a full turn.
    if degrees < 360.0 { degrees } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parity_is_that_of_floor() {
        let last = 4_503_599_627_370_495.0;
        for (x, expected) in [
            (-1.5, Some(false)),
            (-1.0, Some(true)),
            (-0.5, Some(true)),
            (-0.0, Some(false)),
            (0.5, Some(false)),
            (1.0, Some(true)),
            (2_147_483_648.5, Some(false)),
            (4_294_967_297.5, Some(true)),
            (last, Some(true)),
            (-last, Some(true)),
            (9_007_199_254_740_994.0, None),
            (f64::INFINITY, None),
            (f64::NAN, None),
        ] {
            assert_eq!(odd(x), expected, "{x}");
        }
        assert_eq!(cell(0.5, 0.5), Cell::First);
        assert_eq!(cell(-0.5, 0.5), Cell::Second);
        assert_eq!(cell(-0.5, 1.5), Cell::First);
        assert_eq!(cell(1e300, 0.0), Cell::Mixed);
    }

    #[test]
    fn a_full_turn_has_no_end() {
        assert_eq!(turn(1.0, 0.0), 0.0);
        assert_eq!(turn(0.0, 1.0), 90.0);
        assert_eq!(turn(-1.0, 0.0), 180.0);
        assert_eq!(turn(0.0, -1.0), 270.0);
        assert!(turn(1.0, -1e-300) < 360.0);
        assert!(turn(1.0, -1e-10) < 360.0);
        assert_eq!(turn(0.0, 0.0), 0.0);
    }
}
