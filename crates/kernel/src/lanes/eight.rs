use super::{One, Wide};
use fearless_simd::{
    Level, Select, Simd, SimdBase, SimdFloat, SimdMask, f32x8, f64x8, mask32x8, mask64x8, u32x8,
};
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Sub};

/// Eight numbers at once, however many a register holds: for what comes in eights
/// by itself, as the children of a node and the triangles of a leaf do.
///
/// Singles are for bounds alone, never for what is found; of their `min` and `max`
/// it is open which zero comes out.
pub trait Eight: Copy {
    /// Eight singles.
    type Singles: Singles;
    /// Eight doubles.
    type Doubles: Doubles;

    /// Whether a fused multiply-add is an instruction; else it takes a function's time.
    fn fuses(self) -> bool;
    /// Writes those numbers first whose bits are set, in their order, and anything behind.
    fn pack(self, from: &[u32; 8], bits: u32, to: &mut [u32; 8]);
    /// The same single eight times.
    fn single(self, x: f32) -> Self::Singles;
    /// These singles.
    fn singles(self, from: &[f32; 8]) -> Self::Singles;
    /// The same double eight times.
    fn double(self, x: f64) -> Self::Doubles;
    /// These doubles.
    fn doubles(self, from: &[f64; 8]) -> Self::Doubles;
    /// These singles as doubles.
    fn widened(self, from: &[f32; 8]) -> Self::Doubles;
}

/// Eight singles.
pub trait Singles: Copy {
    /// `self` times `a` plus `b`, rounded once or twice, as the machine has it: only for
    /// bounds with room for either.
    #[must_use]
    fn near_mul_add(self, a: Self, b: Self) -> Self;
    /// The smaller ones. Neither may be NaN.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// The larger ones. Neither may be NaN.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// Which are less or equal, the lowest bit for the first.
    fn le(self, other: Self) -> u32;
    /// Writes them out.
    fn store(self, to: &mut [f32; 8]);
}

/// Eight doubles.
pub trait Doubles:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Eight answers.
    type Answers: Answers;

    /// `self` times `a` plus `b`, rounded once.
    #[must_use]
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// The smaller ones, and `self` where they cannot be compared.
    #[must_use]
    fn least(self, other: Self) -> Self;
    /// The larger ones, and `self` where they cannot be compared.
    #[must_use]
    fn most(self, other: Self) -> Self;
    /// Writes them out.
    fn store(self, to: &mut [f64; 8]);
    /// Which are less; not where either is NaN.
    fn lt(self, other: Self) -> Self::Answers;
    /// Which are greater; not where either is NaN.
    fn gt(self, other: Self) -> Self::Answers;

    /// Which are less or equal; not where either is NaN.
    fn le(self, other: Self) -> Self::Answers;
    /// Which are greater or equal; not where either is NaN.
    fn ge(self, other: Self) -> Self::Answers;
}

/// Eight answers.
pub trait Answers: Copy + BitAnd<Output = Self> + BitOr<Output = Self> {
    /// As bits, the lowest one that of the first.
    fn bits(self) -> u32;
}

impl<S: Simd> Eight for Wide<S> {
    type Singles = Wide<f32x8<S>>;
    type Doubles = Wide<f64x8<S>>;

    #[inline(always)]
    fn fuses(self) -> bool {
        match self.0.level() {
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) | Level::Avx512(_) => true,
            #[cfg(target_arch = "aarch64")]
            Level::Neon(_) => true,
            _ => false,
        }
    }

    #[inline(always)]
    fn pack(self, from: &[u32; 8], bits: u32, to: &mut [u32; 8]) {
        let mask = mask32x8::from_bitmask(self.0, u64::from(bits));
        u32x8::from_slice(self.0, from).compress(mask).store_slice(to);
    }

    #[inline(always)]
    fn single(self, x: f32) -> Self::Singles {
        Wide(f32x8::splat(self.0, x))
    }

    #[inline(always)]
    fn singles(self, from: &[f32; 8]) -> Self::Singles {
        Wide(f32x8::from_slice(self.0, from))
    }

    #[inline(always)]
    fn double(self, x: f64) -> Self::Doubles {
        Wide(f64x8::splat(self.0, x))
    }

    #[inline(always)]
    fn doubles(self, from: &[f64; 8]) -> Self::Doubles {
        Wide(f64x8::from_slice(self.0, from))
    }

    #[inline(always)]
    fn widened(self, from: &[f32; 8]) -> Self::Doubles {
        let singles = f32x8::from_slice(self.0, from);
        Wide(self.0.widen_f32x16(self.0.combine_f32x8(singles, singles)).0)
    }
}

impl<S: Simd> Singles for Wide<f32x8<S>> {
    #[inline(always)]
    #[expect(clippy::disallowed_methods, reason = "what is asked for")]
    fn near_mul_add(self, a: Self, b: Self) -> Self {
        Self(self.0.mul_add(a.0, b.0))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        self.0.simd_le(other.0).to_bitmask() as u32
    }

    #[inline(always)]
    fn store(self, to: &mut [f32; 8]) {
        self.0.store_slice(to);
    }
}

impl<S: Simd> Doubles for Wide<f64x8<S>> {
    type Answers = Wide<mask64x8<S>>;

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self(self.0.mul_add_precise(a.0, b.0))
    }

    #[inline(always)]
    fn least(self, other: Self) -> Self {
        Self(other.0.simd_lt(self.0).select(other.0, self.0))
    }

    #[inline(always)]
    fn most(self, other: Self) -> Self {
        Self(other.0.simd_gt(self.0).select(other.0, self.0))
    }

    #[inline(always)]
    fn store(self, to: &mut [f64; 8]) {
        self.0.store_slice(to);
    }

    #[inline(always)]
    fn lt(self, other: Self) -> Self::Answers {
        Wide(self.0.simd_lt(other.0))
    }

    #[inline(always)]
    fn gt(self, other: Self) -> Self::Answers {
        Wide(self.0.simd_gt(other.0))
    }

    #[inline(always)]
    fn le(self, other: Self) -> Self::Answers {
        Wide(self.0.simd_le(other.0))
    }

    #[inline(always)]
    fn ge(self, other: Self) -> Self::Answers {
        Wide(self.0.simd_ge(other.0))
    }
}

impl<S: Simd> Answers for Wide<mask64x8<S>> {
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.to_bitmask() as u32
    }
}

impl<S: Simd> BitAnd for Wide<mask64x8<S>> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl<S: Simd> BitOr for Wide<mask64x8<S>> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $operator:tt, $($eight:ident),*) => {$(
        impl<S: Simd> $trait for Wide<$eight<S>> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $operator other.0)
            }
        }
    )*};
}

operator!(Add, add, +, f64x8);
operator!(Sub, sub, -, f64x8);
operator!(Mul, mul, *, f64x8);
operator!(Div, div, /, f64x8);

impl<S: Simd> Neg for Wide<f64x8<S>> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// Eight numbers, or answers, one by one.
#[derive(Debug, Clone, Copy)]
pub struct Array<T>([T; 8]);

impl<T: Copy> Array<T> {
    #[inline(always)]
    fn with<U: Copy, R>(self, other: Array<U>, each: impl Fn(T, U) -> R) -> Array<R> {
        let [a, b, c, d, e, f, g, h] = self.0;
        let [i, j, k, l, m, n, o, p] = other.0;
        Array([
            each(a, i),
            each(b, j),
            each(c, k),
            each(d, l),
            each(e, m),
            each(f, n),
            each(g, o),
            each(h, p),
        ])
    }
}

impl Array<bool> {
    #[inline(always)]
    fn as_bits(self) -> u32 {
        self.0.iter().rev().fold(
            0,
            #[inline(always)]
            |bits, &answer| bits << 1 | u32::from(answer),
        )
    }
}

impl Eight for One {
    type Singles = Array<f32>;
    type Doubles = Array<f64>;

    #[inline(always)]
    fn fuses(self) -> bool {
        false
    }

    #[inline(always)]
    fn pack(self, from: &[u32; 8], bits: u32, to: &mut [u32; 8]) {
        for (to, lane) in to.iter_mut().zip(super::lanes_of(bits)) {
            *to = from[lane & 7];
        }
    }

    #[inline(always)]
    fn single(self, x: f32) -> Array<f32> {
        Array([x; 8])
    }

    #[inline(always)]
    fn singles(self, from: &[f32; 8]) -> Array<f32> {
        Array(*from)
    }

    #[inline(always)]
    fn double(self, x: f64) -> Array<f64> {
        Array([x; 8])
    }

    #[inline(always)]
    fn doubles(self, from: &[f64; 8]) -> Array<f64> {
        Array(*from)
    }

    #[inline(always)]
    fn widened(self, from: &[f32; 8]) -> Array<f64> {
        Array(from.map(f64::from))
    }
}

macro_rules! one_by_one {
    ($name:ident, $trait:ident for $number:ty, $($method:ident -> $result:ty, $each:expr;)*) => {
        impl $trait for Array<$number> {
            $(
                #[inline(always)]
                fn $method(self, other: Self) -> $result {
                    self.with(other, #[inline(always)] $each)
                }
            )*
            one_by_one!(@rest $name);
        }
    };
    (@rest operator) => { type Output = Self; };
    (@rest doubles) => {
        type Answers = Array<bool>;

        #[inline(always)]
        fn mul_add(self, a: Self, b: Self) -> Self {
            Self(std::array::from_fn(
                #[inline(always)]
                |i| self.0[i].mul_add(a.0[i], b.0[i]),
            ))
        }

        #[inline(always)]
        fn store(self, to: &mut [f64; 8]) {
            *to = self.0;
        }
    };
}

one_by_one!(operator, Add for f64, add -> Self, |a, b| a + b;);
one_by_one!(operator, Sub for f64, sub -> Self, |a, b| a - b;);
one_by_one!(operator, Mul for f64, mul -> Self, |a, b| a * b;);
one_by_one!(operator, Div for f64, div -> Self, |a, b| a / b;);
one_by_one!(operator, BitAnd for bool, bitand -> Self, |a, b| a & b;);
one_by_one!(operator, BitOr for bool, bitor -> Self, |a, b| a | b;);

impl Neg for Array<f64> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(
            #[inline(always)]
            |a| -a,
        ))
    }
}
one_by_one!(doubles, Doubles for f64,
    least -> Self, |a, b| if b < a { b } else { a };
    most -> Self, |a, b| if b > a { b } else { a };
    lt -> Array<bool>, |a, b| a < b;
    le -> Array<bool>, |a, b| a <= b;
    gt -> Array<bool>, |a, b| a > b;
    ge -> Array<bool>, |a, b| a >= b;
);

impl Singles for Array<f32> {
    #[inline(always)]
    fn near_mul_add(self, a: Self, b: Self) -> Self {
        Self(std::array::from_fn(
            #[inline(always)]
            |i| self.0[i] * a.0[i] + b.0[i],
        ))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.with(
            other,
            #[inline(always)]
            |a, b| if a < b { a } else { b },
        )
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.with(
            other,
            #[inline(always)]
            |a, b| if a > b { a } else { b },
        )
    }

    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        self.with(
            other,
            #[inline(always)]
            |a, b| a <= b,
        )
        .as_bits()
    }

    #[inline(always)]
    fn store(self, to: &mut [f32; 8]) {
        *to = self.0;
    }
}

impl Answers for Array<bool> {
    #[inline(always)]
    fn bits(self) -> u32 {
        self.as_bits()
    }
}
