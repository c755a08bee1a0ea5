use super::{Lanes, Mask, Real};
use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask};
use std::fmt;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// As many lanes as the registers of these instructions hold.
#[derive(Debug, Clone, Copy)]
pub struct Wide<S>(pub(super) S);

/// A register of doubles.
#[derive(Clone, Copy)]
pub struct Reals<S: Simd>(S::f64s);

/// A register of answers.
#[derive(Clone, Copy)]
pub struct Answers<S: Simd>(S::mask64s);

impl<S: Simd> Lanes for Wide<S> {
    const WIDTH: usize = <S::f64s as SimdBase<S>>::LEN;
    type Real = Reals<S>;
    type Mask = Answers<S>;

    #[inline(always)]
    fn splat(self, x: f64) -> Reals<S> {
        Reals(S::f64s::splat(self.0, x))
    }

    #[inline(always)]
    fn load(self, from: &[f64]) -> Reals<S> {
        Reals(S::f64s::from_slice(self.0, &from[..Self::WIDTH]))
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> Answers<S> {
        let lanes = (1 << Self::WIDTH) - 1;
        Answers(S::mask64s::from_bitmask(self.0, u64::from(bits) & lanes))
    }

    #[inline(always)]
    fn vectorize<R>(self, work: impl FnOnce() -> R) -> R {
        self.0.vectorize(work)
    }
}

impl<S: Simd> Real for Reals<S> {
    type Mask = Answers<S>;

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self(self.0.mul_add_precise(a.0, b.0))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }

    #[inline(always)]
    fn floor(self) -> Self {
        Self(self.0.floor())
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(self.0.copysign(sign.0))
    }

    #[inline(always)]
    fn exp2_of_whole(self) -> Self {
        let bits = (self.0 + 6_755_399_441_055_744.0).to_bits();
        let simd = fearless_simd::ExtractToken::token(&self.0);
        let one = <<S::f64s as SimdFloat<S>>::Bits as SimdBase<S>>::splat(simd, 1023);
        Self(<S::f64s as SimdFloat<S>>::from_bits((bits + one) << 52))
    }

    #[inline(always)]
    fn lt(self, other: Self) -> Answers<S> {
        Answers(self.0.simd_lt(other.0))
    }

    #[inline(always)]
    fn le(self, other: Self) -> Answers<S> {
        Answers(self.0.simd_le(other.0))
    }

    #[inline(always)]
    fn gt(self, other: Self) -> Answers<S> {
        Answers(self.0.simd_gt(other.0))
    }

    #[inline(always)]
    fn ge(self, other: Self) -> Answers<S> {
        Answers(self.0.simd_ge(other.0))
    }

    #[inline(always)]
    fn eq(self, other: Self) -> Answers<S> {
        Answers(self.0.simd_eq(other.0))
    }

    #[inline(always)]
    fn lane(&self, k: usize) -> f64 {
        self.0.as_slice()[k]
    }

    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        self.0.store_slice(&mut to[..Wide::<S>::WIDTH]);
    }

    #[inline(always)]
    fn store_packed(self, mask: Answers<S>, to: &mut [f64]) -> usize {
        self.0.compress(mask.0).store_slice(&mut to[..Wide::<S>::WIDTH]);
        mask.bits().count_ones() as usize
    }
}

impl<S: Simd> Mask for Answers<S> {
    type Real = Reals<S>;

    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.to_bitmask() as u32
    }

    #[inline(always)]
    fn select(self, yes: Reals<S>, no: Reals<S>) -> Reals<S> {
        Reals(self.0.select(yes.0, no.0))
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<S: Simd> $trait for Reals<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $operator other.0)
            }
        }

        impl<S: Simd> $trait<f64> for Reals<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                Self(self.0 $operator other)
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<S: Simd> Neg for Reals<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: Simd> BitAnd for Answers<S> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl<S: Simd> BitOr for Answers<S> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl<S: Simd> Not for Answers<S> {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

impl<S: Simd> fmt::Debug for Reals<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.0.as_slice()).finish()
    }
}

impl<S: Simd> fmt::Debug for Answers<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:b}", self.bits())
    }
}
