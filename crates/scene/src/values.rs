//! Numbers that carry their range in their type.

use crate::OutOfRange;
use lancer_math::{Point, Vector};

/// Writes three coordinates as a user reads them.
fn triple(c: [f64; 3]) -> String {
    format!("({}, {}, {})", c[0], c[1], c[2])
}

fn all_finite(c: [f64; 3]) -> bool {
    c.iter().all(|c| c.is_finite())
}

/// A point whose coordinates are finite, in scene lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Position(Point);

impl Position {
    /// The point (x, y, z).
    ///
    /// # Errors
    /// Where a coordinate is NaN or infinite.
    pub fn new(xyz: [f64; 3]) -> Result<Self, OutOfRange> {
        if all_finite(xyz) {
            Ok(Self(Point::from(xyz)))
        } else {
            Err(OutOfRange::new(triple(xyz), "finite coordinates"))
        }
    }

    /// The point itself.
    #[must_use]
    pub const fn get(self) -> Point {
        self.0
    }
}

/// A finite vector other than zero, of any length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction(Vector);

impl Direction {
    /// The vector (x, y, z), kept as it is: it is not made a unit vector.
    ///
    /// # Errors
    /// Where a component is NaN or infinite, or all are zero.
    pub fn new(xyz: [f64; 3]) -> Result<Self, OutOfRange> {
        if !all_finite(xyz) {
            Err(OutOfRange::new(triple(xyz), "finite components"))
        } else if xyz == [0.0; 3] {
            Err(OutOfRange::new(triple(xyz), "a vector other than zero"))
        } else {
            Ok(Self(Vector::from(xyz)))
        }
    }

    /// The vector itself.
    #[must_use]
    pub const fn get(self) -> Vector {
        self.0
    }
}

/// A finite length greater than 0, in scene lengths.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Length(f64);

impl Length {
    /// # Errors
    /// Where `value` is NaN, infinite, zero or negative.
    pub fn new(value: f64) -> Result<Self, OutOfRange> {
        if value > 0.0 && value.is_finite() {
            Ok(Self(value))
        } else if value.is_finite() {
            Err(OutOfRange::new(value, "a number greater than 0"))
        } else {
            Err(OutOfRange::new(value, "a finite number greater than 0"))
        }
    }

    /// The length itself.
    #[must_use]
    pub const fn get(self) -> f64 {
        self.0
    }
}

/// The fraction of light that a surface mirrors, in [0, 1].
///
/// Single precision, as the original program computes with it.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Gloss(f32);

impl Gloss {
    /// No mirroring at all.
    pub const MATTE: Self = Self(0.0);

    /// Rounds `value` to single precision.
    ///
    /// # Errors
    /// Where `value` is not in [0, 1].
    pub fn new(value: f64) -> Result<Self, OutOfRange> {
        if (0.0..=1.0).contains(&value) {
            // `+ 0.0` turns -0 into 0, so that equal scenes have equal dumps.
            Ok(Self(value as f32 + 0.0))
        } else {
            Err(OutOfRange::new(value, "a number from 0 to 1"))
        }
    }

    /// The fraction itself.
    #[must_use]
    pub const fn get(self) -> f32 {
        self.0
    }
}

/// How strong a light is: finite and at least 0.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Brightness(f64);

impl Brightness {
    /// # Errors
    /// Where `value` is NaN, infinite or negative.
    pub fn new(value: f64) -> Result<Self, OutOfRange> {
        if value >= 0.0 && value.is_finite() {
            Ok(Self(value + 0.0))
        } else if value.is_finite() {
            Err(OutOfRange::new(value, "a number of at least 0"))
        } else {
            Err(OutOfRange::new(value, "a finite number of at least 0"))
        }
    }

    /// The value itself. A white surface that a light of brightness 1 strikes
    /// squarely shows display white.
    #[must_use]
    pub const fn get(self) -> f64 {
        self.0
    }
}

/// A number of pixels along one side of a picture: from 1 to 2^31 - 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct PixelCount(u32);

impl PixelCount {
    /// The most pixels along one side: what picture formats and the original
    /// program can count.
    pub const MAX: u32 = i32::MAX as u32;

    /// # Errors
    /// Where `value` is zero or above [`Self::MAX`].
    pub fn new(value: u32) -> Result<Self, OutOfRange> {
        if (1..=Self::MAX).contains(&value) {
            Ok(Self(value))
        } else {
            Err(OutOfRange::new(value, "a whole number from 1 to 2147483647"))
        }
    }

    /// The number itself.
    #[must_use]
    pub const fn get(self) -> u32 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BAD: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

    #[test]
    fn nothing_that_is_not_a_number_gets_in() {
        for bad in BAD {
            assert!(Length::new(bad).is_err());
            assert!(Gloss::new(bad).is_err());
            assert!(Brightness::new(bad).is_err());
            for axis in 0..3 {
                let mut xyz = [1.0; 3];
                xyz[axis] = bad;
                assert!(Position::new(xyz).is_err());
                assert!(Direction::new(xyz).is_err());
            }
        }
    }

    #[test]
    fn ranges_end_where_they_say() {
        assert!(Length::new(0.0).is_err());
        assert!(Length::new(-0.0).is_err());
        assert!(Length::new(5e-324).is_ok());
        assert!(Gloss::new(0.0).is_ok() && Gloss::new(1.0).is_ok());
        assert!(Gloss::new(-1e-9).is_err() && Gloss::new(1.000_000_001).is_err());
        assert!(Brightness::new(0.0).is_ok());
        assert!(Brightness::new(-5e-324).is_err());
        assert!(Direction::new([0.0, -0.0, 0.0]).is_err());
        assert!(Direction::new([1e-200, 0.0, 0.0]).is_ok());
        assert!(PixelCount::new(0).is_err());
        assert!(PixelCount::new(1).is_ok());
        assert!(PixelCount::new(u32::MAX).is_err());
    }
}
