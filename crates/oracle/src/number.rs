//! Numbers that lose nothing.

use dashu_float::round::mode::HalfEven;
use dashu_float::{Context, FBig, Repr};
use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// A whole number times a power of two, of any size.
///
/// Sums, differences and products are exact, so every `f64`, and every
/// polynomial in `f64`s, is one of these without error. What has no exact value
/// of this kind (quotients, roots, angles) is asked for with a number of bits,
/// and is right to within half a unit of the last of them.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Number(FBig<HalfEven>);

impl Number {
    /// 0.
    #[must_use]
    pub fn zero() -> Self {
        Self(FBig::ZERO)
    }

    /// 1.
    #[must_use]
    pub fn one() -> Self {
        Self(FBig::ONE)
    }

    fn kept(value: FBig<HalfEven>) -> Self {
        Self(value.with_precision(0).value())
    }

    fn repr(&self) -> &Repr<2> {
        self.0.repr()
    }

    /// 2 to a power.
    #[must_use]
    pub fn power_of_two(exponent: i32) -> Self {
        Self(FBig::from_parts(1.into(), exponent as isize).with_precision(0).value())
    }

    /// -1, 0 or 1, as its sign is.
    #[must_use]
    pub fn signum(&self) -> i32 {
        match self.cmp(&Self::zero()) {
            Ordering::Less => -1,
            Ordering::Equal => 0,
            Ordering::Greater => 1,
        }
    }

    /// Whether it is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.signum() == 0
    }

    /// Its distance from 0.
    #[must_use]
    pub fn abs(&self) -> Self {
        if self.signum() < 0 { -self } else { self.clone() }
    }

    /// Its square.
    #[must_use]
    pub fn squared(&self) -> Self {
        self * self
    }

    /// The nearest number with so many bits.
    #[must_use]
    pub fn rounded(&self, bits: usize) -> Self {
        Self::kept(self.0.clone().with_precision(bits).value())
    }

    /// The quotient by `divisor`.
    ///
    /// # Panics
    /// Where `divisor` is 0.
    #[must_use]
    pub fn over(&self, divisor: &Self, bits: usize) -> Self {
        assert!(!divisor.is_zero(), "a quotient by 0 is asked for");
        let quotient = Context::<HalfEven>::new(bits).div(self.repr(), divisor.repr());
        Self::kept(quotient.expect("the divisor is not 0").value())
    }

    /// The square root.
    ///
    /// # Panics
    /// Where the number is negative.
    #[must_use]
    pub fn root(&self, bits: usize) -> Self {
        let root = Context::<HalfEven>::new(bits).sqrt(self.repr());
        Self::kept(root.expect("a square root of what is not negative").value())
    }

    /// The exponential function.
    ///
    /// # Panics
    /// Where it has no value that a memory could hold.
    #[must_use]
    pub fn exp(&self, bits: usize) -> Self {
        let value = Context::<HalfEven>::new(bits).exp(self.repr(), None);
        Self::kept(value.expect("an exponential of moderate size").value())
    }

    /// The sine and cosine of that many degrees.
    ///
    /// # Panics
    /// Never: there is no degree without them.
    #[must_use]
    pub fn sin_cos_degrees(&self, bits: usize) -> (Self, Self) {
        let (sine, cosine) = Context::<HalfEven>::new(bits).sin_cos_unit(self.repr(), 360, None);
        let value = |v: Result<_, _>| match v {
            Ok(rounded) => dashu_float::round::Rounded::<FBig<HalfEven>>::value(rounded),
            Err::<_, dashu_float::FpError>(e) => panic!("no sine or cosine: {e:?}"),
        };
        (Self::kept(value(sine)), Self::kept(value(cosine)))
    }

    /// The power of a number above 0.
    ///
    /// # Panics
    /// Where the number is not above 0.
    #[must_use]
    pub fn power(&self, exponent: &Self, bits: usize) -> Self {
        let value = Context::<HalfEven>::new(bits).powf(self.repr(), exponent.repr(), None);
        Self::kept(value.expect("a power of a number above 0").value())
    }

    /// The angle of the place (`x`, this) in degrees, from -180 to 180; 0 where
    /// both are 0.
    #[must_use]
    pub fn turn(&self, x: &Self, bits: usize) -> Self {
        let angle = Context::<HalfEven>::new(bits).atan2_unit(self.repr(), x.repr(), 360, None);
        angle.map_or_else(|_| Self::zero(), |angle| Self::kept(angle.value()))
    }

    /// The largest whole number that is not above it.
    #[must_use]
    pub fn floor(&self) -> Self {
        Self::kept(self.0.floor())
    }

    /// The nearest double.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }

    /// The logarithm to base 2 of its distance from 0, to within 1; `None` for 0.
    #[must_use]
    pub fn magnitude(&self) -> Option<isize> {
        (!self.is_zero()).then(|| self.repr().exponent() + self.repr().digits() as isize)
    }
}

impl From<f64> for Number {
    /// # Panics
    /// Where `value` is NaN or infinite.
    fn from(value: f64) -> Self {
        // A zero has one sign here.
        let value = FBig::try_from(value + 0.0).expect("a finite number");
        Self::kept(value)
    }
}

impl From<i32> for Number {
    fn from(value: i32) -> Self {
        Self::from(f64::from(value))
    }
}

impl fmt::Debug for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.to_f64())
    }
}

macro_rules! operator {
    ($operator:ident, $method:ident, $symbol:tt) => {
        impl $operator for &Number {
            type Output = Number;
            fn $method(self, other: Self) -> Number {
                Number(&self.0 $symbol &other.0)
            }
        }
        impl $operator<&Number> for Number {
            type Output = Number;
            fn $method(self, other: &Number) -> Number {
                Number(self.0 $symbol &other.0)
            }
        }
        impl $operator<Number> for &Number {
            type Output = Number;
            fn $method(self, other: Number) -> Number {
                Number(&self.0 $symbol other.0)
            }
        }
        impl $operator for Number {
            type Output = Number;
            fn $method(self, other: Self) -> Number {
                Number(self.0 $symbol other.0)
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);

impl Neg for &Number {
    type Output = Number;
    fn neg(self) -> Number {
        Number(-&self.0)
    }
}

impl Neg for Number {
    type Output = Number;
    fn neg(self) -> Number {
        Number(-self.0)
    }
}
