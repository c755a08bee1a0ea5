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
    /// Straight up.
    pub const Z: Self = Self(Vector::new(0.0, 0.0, 1.0));

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

    /// The same where there may be none at all, which 0 says.
    ///
    /// # Errors
    /// Where `value` is NaN, infinite or negative.
    pub fn or_none(value: f64) -> Result<Option<Self>, OutOfRange> {
        if value >= 0.0 && value.is_finite() {
            Ok((value > 0.0).then_some(Self(value)))
        } else if value.is_finite() {
            Err(OutOfRange::new(value, "a number of at least 0"))
        } else {
            Err(OutOfRange::new(value, "a finite number of at least 0"))
        }
    }

    /// The length itself.
    #[must_use]
    pub const fn get(self) -> f64 {
        self.0
    }
}

/// A number from 0 to 1: a share of the light.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct Fraction(f64);

impl Fraction {
    /// Nothing.
    pub const NONE: Self = Self(0.0);
    /// All.
    pub const ALL: Self = Self(1.0);

    /// # Errors
    /// Where `value` is not in [0, 1].
    pub fn new(value: f64) -> Result<Self, OutOfRange> {
        if (0.0..=1.0).contains(&value) {
            // `+ 0.0` turns -0 into 0, so that equal scenes have equal dumps.
            Ok(Self(value + 0.0))
        } else {
            Err(OutOfRange::new(value, "a number from 0 to 1"))
        }
    }

    /// The fraction itself.
    #[must_use]
    pub const fn get(self) -> f64 {
        self.0
    }
}

/// An index of refraction: the speed of light in empty space over that in the
/// medium; finite and above 0.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Ior(f64);

impl Ior {
    /// That of empty space, and of the air around a scene.
    pub const AIR: Self = Self(1.0);
    /// That of a transparent surface that does not say: ordinary glass.
    pub const GLASS: Self = Self(1.5);

    /// # Errors
    /// Where `value` is NaN, infinite, zero or negative.
    pub fn new(value: f64) -> Result<Self, OutOfRange> {
        Length::new(value).map(|length| Self(length.get()))
    }

    /// The index itself.
    #[must_use]
    pub const fn get(self) -> f64 {
        self.0
    }
}

/// Red, green and blue, each finite and at least 0, without an upper end: a
/// radiance (linear, 1 is what a white surface shows that a light of
/// brightness 1 strikes squarely), or an absorption for each unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spectrum([f64; 3]);

impl Spectrum {
    /// Nothing in any component.
    pub const NONE: Self = Self([0.0; 3]);

    /// # Errors
    /// Where a component is NaN, infinite or negative.
    pub fn new(rgb: [f64; 3]) -> Result<Self, OutOfRange> {
        if rgb.iter().all(|c| *c >= 0.0 && c.is_finite()) {
            Ok(Self(rgb.map(|c| c + 0.0)))
        } else {
            Err(OutOfRange::new(triple(rgb), "finite numbers of at least 0"))
        }
    }

    /// The components themselves.
    #[must_use]
    pub const fn get(self) -> [f64; 3] {
        self.0
    }

    /// Whether all components are 0.
    #[must_use]
    pub fn is_none(self) -> bool {
        self == Self::NONE
    }
}

/// An angle in degrees: finite.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct Degrees(f64);

impl Degrees {
    /// No turn.
    pub const ZERO: Self = Self(0.0);

    /// Any angle.
    ///
    /// # Errors
    /// Where `value` is NaN or infinite.
    pub fn new(value: f64) -> Result<Self, OutOfRange> {
        if value.is_finite() {
            Ok(Self(value + 0.0))
        } else {
            Err(OutOfRange::new(value, "a finite angle in degrees"))
        }
    }

    /// An angle of view.
    ///
    /// # Errors
    /// Where `value` is not above 0 and below 180.
    pub fn view(value: f64) -> Result<Self, OutOfRange> {
        if value > 0.0 && value < 180.0 {
            Ok(Self(value))
        } else {
            Err(OutOfRange::new(value, "an angle above 0 and below 180 degrees"))
        }
    }

    /// An angle between a direction and an axis.
    ///
    /// # Errors
    /// Where `value` is not from 0 to 180.
    pub fn from_axis(value: f64) -> Result<Self, OutOfRange> {
        if (0.0..=180.0).contains(&value) {
            Ok(Self(value + 0.0))
        } else {
            Err(OutOfRange::new(value, "an angle from 0 to 180 degrees"))
        }
    }

    /// The side of the cells of a checker around an axis.
    ///
    /// # Errors
    /// Where `value` does not divide 180 (to a millionth of a cell), so that
    /// colours would not alternate all around.
    pub fn dividing_180(value: f64) -> Result<Self, OutOfRange> {
        let cells = 180.0 / value;
        let whole = libm::rint(cells);
        if value > 0.0 && (1.0..=1e6).contains(&whole) && (cells - whole).abs() <= 1e-6 {
            // The nearest double to what was meant: 180 / 7 has no end.
            Ok(Self(180.0 / whole))
        } else {
            Err(OutOfRange::new(value, "an angle in degrees that divides 180"))
        }
    }

    /// The angle itself.
    #[must_use]
    pub const fn get(self) -> f64 {
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

    /// The value itself: the radiance that a white matte surface shows when it
    /// faces a lamp squarely from distance 1, or a sun squarely.
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
            assert!(Length::new(bad).is_err() && Length::or_none(bad).is_err());
            assert!(Fraction::new(bad).is_err());
            assert!(Ior::new(bad).is_err());
            assert!(Degrees::new(bad).is_err() && Degrees::view(bad).is_err());
            assert!(Degrees::from_axis(bad).is_err() && Degrees::dividing_180(bad).is_err());
            assert!(Spectrum::new([0.0, bad, 1.0]).is_err());
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
        assert_eq!(Length::or_none(-0.0), Ok(None));
        assert!(Length::or_none(5e-324).is_ok_and(|length| length.is_some()));
        assert!(Length::or_none(-5e-324).is_err());
        assert!(Fraction::new(0.0).is_ok() && Fraction::new(1.0).is_ok());
        assert!(Fraction::new(-1e-9).is_err() && Fraction::new(1.000_000_001).is_err());
        assert!(Ior::new(0.0).is_err() && Ior::new(0.75).is_ok());
        assert!(Spectrum::new([0.0, -1e-9, 0.0]).is_err() && Spectrum::new([1e30; 3]).is_ok());
        assert!(Degrees::view(0.0).is_err() && Degrees::view(180.0).is_err());
        assert!(Degrees::from_axis(180.0).is_ok() && Degrees::from_axis(-1.0).is_err());
        assert!(Degrees::dividing_180(30.0).is_ok() && Degrees::dividing_180(25.714_285_7).is_ok());
        for bad in [0.0, -30.0, 181.0, 50.0, 1e-9] {
            assert!(Degrees::dividing_180(bad).is_err(), "{bad}");
        }
        assert!(Brightness::new(0.0).is_ok());
        assert!(Brightness::new(-5e-324).is_err());
        assert!(Direction::new([0.0, -0.0, 0.0]).is_err());
        assert!(Direction::new([1e-200, 0.0, 0.0]).is_ok());
        assert!(PixelCount::new(0).is_err());
        assert!(PixelCount::new(1).is_ok());
        assert!(PixelCount::new(u32::MAX).is_err());
    }
}
