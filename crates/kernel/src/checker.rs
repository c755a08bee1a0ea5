//! Cells of a checker along one coordinate, and of two together.
//!
//! A line of pixels may lie exactly on a border, where rounding would tell at random on
//! which side of it each is. So what is no farther below a border than the error of its
//! point belongs to the cell above it, from whichever side it is seen and wherever the scene is,
//! as long as its points are known to a millionth of a cell.

use crate::lanes::{Lanes, Mask, Real, Vectors};
use crate::primitive::{Cell, Square};

const LARGEST: f64 = 4_503_599_627_370_496.0; // 2^52

/// The error of a point along a surface, in error bounds of its distance from it: as much
/// as where a ray grazes it at a slope of 1 in 16, and more than is ever seen.
const ALONG: f64 = 16.0;

/// Never more than a millionth of a cell: beyond, borders are as rough as points are.
const MOST_SLACK: f64 = 1.0 / 1_048_576.0;

/// How far below a border coordinates belong to the cell above it, in cells of that
/// length, by the error bound of their point.
#[inline]
pub(crate) fn slack(error: f64, length: f64) -> f64 {
    let slack = error * (ALONG / length);
    if slack < MOST_SLACK { slack } else { MOST_SLACK }
}

/// The same of cells that are so many degrees wide, around a circle of that radius. No
/// more than 2^-18 degrees, less than what [`on_globe`] leaves open.
#[inline]
pub(crate) fn slack_around(error: f64, radius: f64, angle: f64) -> f64 {
    const MOST: f64 = 1.0 / 262_144.0;
    let degrees = (error * (ALONG / radius)).to_degrees();
    let degrees = if degrees < MOST { degrees } else { MOST };
    degrees / angle
}

/// The same as [`slack`] in lanes, to the bit.
#[inline(always)]
pub(crate) fn slacks<L: Lanes>(lanes: L, error: L::Real, length: f64) -> L::Real {
    let slack = error * (ALONG / length);
    let most = lanes.splat(MOST_SLACK);
    slack.lt(most).select(slack, most)
}

/// The cell of x: floor(x), or one more where x is no farther than `slack` below that.
/// `None` where x is so large that doubles have no fractions, or not a number.
#[inline]
fn step(x: f64, slack: f64) -> Option<f64> {
    let below = libm::floor(x);
    let above = below + 1.0;
    (x.abs() <= LARGEST).then_some(if above - x <= slack { above } else { below })
}

/// The cell at two coordinates, each in cells, with what is how far below a border on it.
#[inline]
pub(crate) fn square([i, j]: [f64; 2], [along_i, along_j]: [f64; 2]) -> Square {
    let (Some(i), Some(j)) = (step(i, along_i), step(j, along_j)) else {
        return Square { cell: Cell::Mixed, index: [0.0; 2] };
    };
    // The remainders are exact.
    let [odd_i, odd_j] = [i, j].map(|index| index % 2.0 != 0.0);
    let cell = if odd_i == odd_j { Cell::First } else { Cell::Second };
    Square { cell, index: [i, j] }
}

/// The cells of a checker that points are in.
#[derive(Debug, Clone, Copy)]
pub struct LaneCells<M: Mask> {
    /// Where the colour is the checker's own.
    pub second: M,
    /// As [`SurfacePoint::cell`](crate::SurfacePoint::cell).
    pub index: [M::Real; 2],
    /// Where that is certain; one by one it must be found out elsewhere.
    pub certain: M,
}

/// The cells at two coordinates, each in cells, with what is how far below a border on it:
/// certain where neither is mixed.
#[inline(always)]
pub(crate) fn cells<L: Lanes>(
    lanes: L,
    i: L::Real,
    j: L::Real,
    slack: L::Real,
) -> LaneCells<L::Mask> {
    let largest = lanes.splat(LARGEST);
    let certain = i.abs().le(largest) & j.abs().le(largest);
    let index = [steps(i, slack), steps(j, slack)];
    let [i, j] = [odd(index[0]), odd(index[1])];
    LaneCells { second: (i & !j) | (j & !i), index, certain }
}

/// The cells of the meridians and parallels of a ball at unit normals: certain
/// but within 1e-5 degrees of a border.
///
/// Angles are found to within 2e-8 radians (Abramowitz and Stegun, *Handbook of
/// Mathematical Functions*, 4.4.49), and 1e-5 degrees is eight times as much.
#[inline(always)]
pub(crate) fn on_globe<L: Lanes>(
    lanes: L,
    normal: &Vectors<L::Real>,
    angle: f64,
) -> LaneCells<L::Mask> {
    const NEAR: f64 = 1e-5;
    let across = normal.x.mul_add(normal.x, normal.y * normal.y).sqrt();
    let longitude = about_turn(lanes, normal.y, normal.x);
    let latitude = about_turn(lanes, normal.z, across);
    let half_turn = lanes.splat(180.0);
    let latitude = latitude.gt(half_turn).select(latitude - 360.0, latitude);
    let per_degree = lanes.splat(1.0 / angle);
    let (i, j) = (longitude * per_degree, latitude * per_degree);
    let slack = lanes.splat(NEAR / angle);
    let inside = |x: L::Real| {
        let fraction = x - x.floor();
        fraction.gt(slack) & fraction.lt(lanes.splat(1.0) - slack)
    };
    // Where a turn begins there is a border, whole number or not.
    let begun = longitude.gt(lanes.splat(NEAR)) & longitude.lt(lanes.splat(360.0 - NEAR));
    let found = cells(lanes, i, j, lanes.splat(0.0));
    LaneCells { certain: found.certain & inside(i) & inside(j) & begun, ..found }
}

/// About the angle of (x, y) in degrees from 0 to 360, to within 2e-8 radians; NaN at
/// the origin.
#[inline(always)]
fn about_turn<L: Lanes>(lanes: L, y: L::Real, x: L::Real) -> L::Real {
    const TERMS: [f64; 8] = [
        -0.333_331_452_8,
        0.199_935_508_5,
        -0.142_088_994_4,
        0.106_562_639_3,
        -0.075_289_640_0,
        0.042_909_613_8,
        -0.016_165_736_7,
        0.002_866_225_7,
    ];
    let zero = lanes.splat(0.0);
    let (a, b) = (x.abs(), y.abs());
    let is_steep = b.gt(a);
    let ratio = is_steep.select(a, b) / is_steep.select(b, a);
    let square = ratio * ratio;
    let mut sum = lanes.splat(TERMS[7]);
    for term in TERMS[..7].iter().rev() {
        sum = sum.mul_add(square, lanes.splat(*term));
    }
    let degrees = sum.mul_add(square, lanes.splat(1.0)) * ratio * 1.0_f64.to_degrees();
    let degrees = is_steep.select(-degrees + 90.0, degrees);
    let degrees = x.lt(zero).select(-degrees + 180.0, degrees);
    y.lt(zero).select(-degrees + 360.0, degrees)
}

/// The same as [`step`] in lanes, where that is certain.
#[inline(always)]
fn steps<R: Real>(x: R, slack: R) -> R {
    let below = x.floor();
    let above = below + 1.0;
    (above - x).le(slack).select(above, below)
}

/// Which of these whole numbers are odd.
#[inline(always)]
fn odd<R: Real>(index: R) -> R::Mask {
    let half = index * 0.5;
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
    use crate::lanes::One;
    use lancer_math::Vector;

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
            assert_eq!(step(x, 0.0).map(|index| index % 2.0 != 0.0), expected, "{x}");
        }
        let cell = |i, j| square([i, j], [0.0; 2]).cell;
        assert_eq!(cell(0.5, 0.5), Cell::First);
        assert_eq!(cell(-0.5, 0.5), Cell::Second);
        assert_eq!(cell(-0.5, 1.5), Cell::First);
        assert_eq!(cell(1e300, 0.0), Cell::Mixed);
    }

    #[test]
    fn what_is_hardly_below_a_border_is_on_it() {
        let slack = slack(f64::EPSILON, 1.0);
        assert_eq!(slack, 16.0 * f64::EPSILON);
        for border in [-3.0, -1.0, 0.0, 1.0, 2.0, 7.0] {
            let of = |x: f64| {
                let lane = steps::<<One as Lanes>::Real>(One.splat(x), One.splat(slack));
                assert_eq!(step(x, slack), Some(lane), "{x}");
                assert_eq!(odd(lane).any(), lane % 2.0 != 0.0);
                lane
            };
            for off in [0.0, 1e-16, 1e-15, 3e-15] {
                assert_eq!(of(border - off), border, "{border} - {off}");
                assert_eq!(of(border + off), border, "{border} + {off}");
            }
            assert_eq!(of(border - 1e-14), border - 1.0, "{border}");
        }
        // Neither too long nor no number at all.
        assert_eq!(super::slack(1.0, 1.0), MOST_SLACK);
        assert_eq!(super::slack(f64::NAN, 1.0), MOST_SLACK);
        assert_eq!(super::slack(0.0, 5e-324), MOST_SLACK);
    }

    #[test]
    fn what_is_certain_on_a_globe_is_right() {
        let mut rng = fastrand::Rng::with_seed(4);
        let mut uncertain = 0;
        for case in 0..200_000 {
            let mut next = || 2.0 * rng.f64() - 1.0;
            let v = Vector::new(next(), next(), next());
            // Also near and on the borders at the poles and at the beginning of a turn.
            let v = match case % 8 {
                0 => Vector::new(v.x, v.y * 1e-8, v.z),
                1 => Vector::new(v.x * 1e-9, v.y * 1e-9, v.z),
                2 => Vector::new(v.x, 0.0, v.z),
                _ => v,
            };
            let n = v / v.norm();
            let angle = [90.0 / std::f64::consts::PI, 10.0, 0.37, 50.0, 180.0][case % 5];
            let latitude = libm::atan2(n.z, libm::hypot(n.x, n.y)).to_degrees();
            let expected = square([turn(n.x, n.y) / angle, latitude / angle], [0.0; 2]);
            let found = on_globe(One, &Vectors::splat(One, &n), angle);
            if found.certain.any() {
                assert_eq!(found.second.any(), expected.cell == Cell::Second, "{n:?} {angle}");
                assert_eq!(found.index, expected.index, "{n:?} {angle}");
            } else {
                uncertain += 1;
            }
        }
        assert!(uncertain < 100_000, "{uncertain}");
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
