use super::{Lanes, Mask, Real};
use std::ops::{BitAnd, BitOr, Not};

/// One lane: what every other width is compared with.
#[derive(Debug, Clone, Copy)]
pub struct One;

/// The answer of one lane.
#[derive(Debug, Clone, Copy)]
pub struct Bit(bool);

impl Lanes for One {
    const WIDTH: usize = 1;
    type Real = f64;
    type Mask = Bit;

    #[inline(always)]
    fn splat(self, x: f64) -> f64 {
        x
    }

    #[inline(always)]
    fn load(self, from: &[f64]) -> f64 {
        from[0]
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> Bit {
        Bit(bits & 1 != 0)
    }

    #[inline(always)]
    fn vectorize<R>(self, work: impl FnOnce() -> R) -> R {
        work()
    }
}

impl Real for f64 {
    type Mask = Bit;

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self::mul_add(self, a, b)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }

    #[inline(always)]
    fn floor(self) -> Self {
        libm::floor(self)
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self::copysign(self, sign)
    }

    #[inline(always)]
    fn exp2_of_whole(self) -> Self {
        // 1.5 * 2^52: adding it puts a whole number into the lowest bits.
        let shifted = self + 6_755_399_441_055_744.0;
        Self::from_bits(shifted.to_bits().wrapping_add(1023) << 52)
    }

    #[inline(always)]
    fn lt(self, other: Self) -> Bit {
        Bit(self < other)
    }

    #[inline(always)]
    fn le(self, other: Self) -> Bit {
        Bit(self <= other)
    }

    #[inline(always)]
    fn gt(self, other: Self) -> Bit {
        Bit(self > other)
    }

    #[inline(always)]
    fn ge(self, other: Self) -> Bit {
        Bit(self >= other)
    }

    #[inline(always)]
    fn eq(self, other: Self) -> Bit {
        Bit(self == other)
    }

    #[inline(always)]
    fn lane(&self, _: usize) -> f64 {
        *self
    }

    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        to[0] = self;
    }

    #[inline(always)]
    fn store_packed(self, mask: Bit, to: &mut [f64]) -> usize {
        to[0] = self;
        usize::from(mask.0)
    }
}

impl Mask for Bit {
    type Real = f64;

    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self.0)
    }

    #[inline(always)]
    fn select(self, yes: f64, no: f64) -> f64 {
        if self.0 { yes } else { no }
    }
}

impl BitAnd for Bit {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl BitOr for Bit {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl Not for Bit {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}
