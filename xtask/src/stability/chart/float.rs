//! Single and double precision by one name.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// What the forms need of a number. Functions that systems differ in are rounded from those of
/// the `libm` crate.
pub(super) trait Float:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    const ZERO: Self;

    /// The nearest number.
    fn of(value: f64) -> Self;

    /// The number itself.
    fn get(self) -> f64;

    fn sqrt(self) -> Self;

    /// self * factor + term, rounded once.
    fn mul_add(self, factor: Self, term: Self) -> Self;

    fn abs(self) -> Self {
        if self < Self::ZERO { -self } else { self }
    }

    fn cbrt(self) -> Self {
        Self::of(libm::cbrt(self.get()))
    }

    fn cos(self) -> Self {
        Self::of(libm::cos(self.get()))
    }

    fn acos(self) -> Self {
        Self::of(libm::acos(self.get()))
    }
}

macro_rules! float {
    ($float:ty) => {
        impl Float for $float {
            const ZERO: Self = 0.0;

            fn of(value: f64) -> Self {
                value as Self
            }

            fn get(self) -> f64 {
                f64::from(self)
            }

            fn sqrt(self) -> Self {
                self.sqrt()
            }

            fn mul_add(self, factor: Self, term: Self) -> Self {
                self.mul_add(factor, term)
            }
        }
    };
}

float!(f32);
float!(f64);

pub(super) type Triple<F> = [F; 3];

pub(super) fn triple<F: Float>(v: [f64; 3]) -> Triple<F> {
    v.map(F::of)
}

pub(super) fn dot<F: Float>(a: Triple<F>, b: Triple<F>) -> F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn minus<F: Float>(a: Triple<F>, b: Triple<F>) -> Triple<F> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// origin + t direction.
pub(super) fn along<F: Float>(origin: Triple<F>, t: F, direction: Triple<F>) -> Triple<F> {
    std::array::from_fn(|i| origin[i] + t * direction[i])
}

pub(super) fn cross<F: Float>(a: Triple<F>, b: Triple<F>) -> Triple<F> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
