//! Numbers of about 32 decimal digits: the exact sum of two doubles of which
//! the second is the rounding error of the first.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A double-double number (Joldes, Muller and Popescu, *Tight and rigorous error
/// bounds for basic building blocks of double-word arithmetic*, 2017). Each
/// operation is right to within some 2^-102 of its result, as long as no part of
/// it leaves the range of a double.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dd {
    high: f64,
    low: f64,
}

/// The rounded sum and what was lost in it, exactly.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// The same where |a| is not less than |b|.
fn quick_two_sum(a: f64, b: f64) -> Dd {
    let high = a + b;
    Dd { high, low: b - (high - a) }
}

/// Two halves of 26 bits each.
fn split(a: f64) -> (f64, f64) {
    let shifted = a * 134_217_729.0;
    let high = shifted - (shifted - a);
    (high, a - high)
}

/// The rounded product and what was lost in it, exactly. Not by `mul_add`, which
/// is a slow call where the processor is not asked for it.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a1, a0), (b1, b0)) = (split(a), split(b));
    (product, ((a1 * b1 - product) + a1 * b0 + a0 * b1) + a0 * b0)
}

impl Dd {
    pub(crate) const ZERO: Self = Self { high: 0.0, low: 0.0 };
    pub(crate) const ONE: Self = Self { high: 1.0, low: 0.0 };

    /// No number: a bound above all others, only to be compared.
    pub(crate) const INFINITY: Self = Self { high: f64::INFINITY, low: 0.0 };

    /// The nearest double.
    pub(crate) fn round(self) -> f64 {
        self.high
    }

    pub(crate) fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }

    pub(crate) fn is_zero(self) -> bool {
        self.high == 0.0
    }

    pub(crate) fn is_negative(self) -> bool {
        self.high < 0.0
    }

    pub(crate) fn is_positive(self) -> bool {
        self.high > 0.0
    }

    pub(crate) fn abs(self) -> Self {
        if self.is_negative() { -self } else { self }
    }

    pub(crate) fn square(self) -> Self {
        self * self
    }

    pub(crate) fn half(self) -> Self {
        Self { high: 0.5 * self.high, low: 0.5 * self.low }
    }

    pub(crate) fn twice(self) -> Self {
        Self { high: 2.0 * self.high, low: 2.0 * self.low }
    }

    /// The square root; 0 where it has none.
    pub(crate) fn sqrt(self) -> Self {
        if !self.is_positive() {
            return Self::ZERO;
        }
        // Each Newton step doubles the number of right digits.
        let first = Self::from(self.high.sqrt());
        let second = first + (self - first.square()) / first.twice();
        second + (self - second.square()) / second.twice()
    }

    pub(crate) fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
}

impl From<f64> for Dd {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl PartialOrd for Dd {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.high.partial_cmp(&other.high) {
            Some(Ordering::Equal) => self.low.partial_cmp(&other.low),
            order => order,
        }
    }
}

impl Neg for Dd {
    type Output = Self;

    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for Dd {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, lost) = two_sum(self.high, other.high);
        let (low, lost_too) = two_sum(self.low, other.low);
        let sum = quick_two_sum(high, lost + low);
        quick_two_sum(sum.high, lost_too + sum.low)
    }
}

impl Sub for Dd {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Dd {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (high, lost) = two_product(self.high, other.high);
        quick_two_sum(high, lost + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Dd {
    type Output = Self;

    /// Long division with two digits of 53 bits.
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        quick_two_sum(first, rest.high / other.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastrand::Rng;

    /// An integer of up to 100 bits, exactly.
    fn exact(n: i128) -> Dd {
        let high = n as f64;
        quick_two_sum(high, (n - high as i128) as f64)
    }

    /// How far off, in units of 2^-104 of the value.
    fn off(found: Dd, expected: Dd) -> f64 {
        let unit = libm::scalbn(expected.high.abs(), -104);
        (found - expected).abs().high / unit
    }

    /// Integers are added and multiplied without a rounding by the machine, and
    /// a division and a root undo what a multiplication did.
    #[test]
    fn agrees_with_integers() {
        for case in 0..10_000 {
            let mut rng = Rng::with_seed(case);
            let mut integer = |bits: u32| {
                let size = rng.u64(..) >> (64 - rng.u32(1..=bits));
                if rng.bool() { -i128::from(size) } else { i128::from(size) }
            };
            let (a, b) = (integer(50) * integer(49) + 1, integer(50) * integer(49) + 1);
            assert!(off(exact(a) + exact(b), exact(a + b)) <= 4.0 || a + b == 0, "case {case}");
            assert!(off(exact(a) - exact(b), exact(a - b)) <= 4.0 || a == b, "case {case}");
            let (a, b) = (integer(53) | 1, integer(47) | 1);
            assert_eq!(exact(a) * exact(b), exact(a * b), "case {case}");
            assert!(off(exact(a * b) / exact(b), exact(a)) <= 8.0, "case {case}");
            let long = exact(a * b);
            assert!(off(long.square().sqrt(), long.abs()) <= 16.0, "case {case}");
            assert!(off(long / exact(a + 2) * exact(a + 2), long) <= 16.0, "case {case}");
        }
    }

    #[test]
    fn a_third_of_it_is_no_double() {
        let third = Dd::ONE / Dd::from(3.0);
        assert_eq!(third.high, 1.0 / 3.0);
        assert_ne!(third.low, 0.0);
        assert!(off(third + third + third, Dd::ONE) <= 4.0);
        assert!(Dd::from(1.0) < third + third + third + third);
    }
}
