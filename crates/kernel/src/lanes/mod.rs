//! Several doubles at once: one text of a kernel for every width.
//!
//! A kernel is written once, generic over [`Lanes`], and [`dispatch`] runs it
//! with as many lanes as the processor has: eight doubles with AVX-512, four with
//! AVX2, two with NEON or SSE2, or one. A lane computes what it would alone:
//! additions, products, quotients, roots and fused products are rounded once
//! each, and fused only where [`Real::mul_add`] is written. So the bits of a
//! result do not depend on the width.
//!
//! This is the one place that knows `fearless_simd`. What it leaves open is kept
//! out: its `mul_add` (not fused on old processors), `min` and `max` (zeros and
//! what is not a number); compare and [`select`](Mask::select) instead.
//!
//! Whatever a kernel calls must be `#[inline(always)]`, down to the last closure:
//! only what is inlined into the function that `dispatch` calls is compiled for
//! the instructions that the processor has.
//!
//! ```
//! use lancer_kernel::lanes::{Lanes, Mask, Real, Width, Work, dispatch};
//!
//! /// Adds up the square roots of numbers that are not negative.
//! struct Roots<'a>(&'a [f64]);
//!
//! impl Work for Roots<'_> {
//!     type Output = f64;
//!
//!     #[inline(always)]
//!     fn run<L: Lanes>(self, lanes: L) -> f64 {
//!         let mut sum = 0.0;
//!         for chunk in self.0.chunks(L::WIDTH) {
//!             let x = lanes.load_part(chunk, 0.0);
//!             let root = x.ge(lanes.splat(0.0)).select(x.sqrt(), lanes.splat(0.0));
//!             // In order, so that the sum is the same for every width.
//!             for k in 0..L::WIDTH {
//!                 sum += root.lane(k);
//!             }
//!         }
//!         sum
//!     }
//! }
//!
//! for width in Width::available() {
//!     assert_eq!(dispatch(width, Roots(&[4.0, -1.0, 9.0, 0.25, 1.0])), 6.5);
//! }
//! ```

mod eight;
mod one;
#[cfg(test)]
mod tests;
mod vectors;
mod wide;

pub use eight::{Answers, Array, Doubles, Eight, Singles};
use fearless_simd::Level;
pub use one::One;
use std::fmt::Debug;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
pub use vectors::{Vectors, larger, smaller};
pub use wide::Wide;

/// How many lanes there are, and the proof that the processor has them.
pub trait Lanes: Eight + Debug + Send + Sync + 'static {
    /// How many doubles are computed with at once.
    const WIDTH: usize;
    /// So many doubles.
    type Real: Real<Mask = Self::Mask>;
    /// So many answers.
    type Mask: Mask<Real = Self::Real>;

    /// The same in each lane.
    fn splat(self, x: f64) -> Self::Real;

    /// The first ones of a slice.
    ///
    /// # Panics
    /// Where there are fewer.
    fn load(self, from: &[f64]) -> Self::Real;

    /// The numbers of a slice, and `rest` in the lanes that it does not fill.
    #[inline(always)]
    fn load_part(self, from: &[f64], rest: f64) -> Self::Real {
        let mut all = [rest; MOST];
        let count = from.len().min(Self::WIDTH);
        all[..count].copy_from_slice(&from[..count]);
        self.load(&all)
    }

    /// The answers of the bits, the lowest one for the first lane.
    fn mask(self, bits: u32) -> Self::Mask;

    /// Yes in the first `count` lanes, or in all where there are no more.
    #[inline(always)]
    fn first(self, count: usize) -> Self::Mask {
        self.mask((1 << count.min(Self::WIDTH)) - 1)
    }

    /// Runs `work`, and what is inlined into it, with the processor's
    /// instructions. [`dispatch`] does; another function that is not inlined
    /// needs it again.
    fn vectorize<R>(self, work: impl FnOnce() -> R) -> R;
}

/// More lanes there are never.
pub const MOST: usize = 8;

/// A double for each lane.
pub trait Real:
    Copy
    + Debug
    + Add<Output = Self>
    + Add<f64, Output = Self>
    + Sub<Output = Self>
    + Sub<f64, Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// So many answers.
    type Mask: Mask<Real = Self>;

    /// self * a + b, rounded once.
    #[must_use]
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Without the sign.
    #[must_use]
    fn abs(self) -> Self;
    /// The largest whole number not above.
    #[must_use]
    fn floor(self) -> Self;
    /// With the sign of another.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;
    /// 2 to the power of these whole numbers from -1022 to 1023.
    #[must_use]
    fn exp2_of_whole(self) -> Self;

    /// Whether less; not if either is NaN, and likewise below.
    fn lt(self, other: Self) -> Self::Mask;
    /// Whether less or equal.
    fn le(self, other: Self) -> Self::Mask;
    /// Whether greater.
    fn gt(self, other: Self) -> Self::Mask;
    /// Whether greater or equal.
    fn ge(self, other: Self) -> Self::Mask;
    /// Whether equal; zeros are.
    fn eq(self, other: Self) -> Self::Mask;

    /// The double of a lane.
    fn lane(&self, k: usize) -> f64;

    /// Writes all to the beginning of a slice.
    ///
    /// # Panics
    /// Where there is no room.
    fn store(self, to: &mut [f64]);

    /// Writes those of the mask to the beginning of a slice, without gaps, and says
    /// how many there are; what is behind them, as far as the lanes reach, is
    /// overwritten with no matter what.
    ///
    /// # Panics
    /// Where there is no room for all.
    fn store_packed(self, mask: Self::Mask, to: &mut [f64]) -> usize;
}

/// An answer for each lane.
pub trait Mask:
    Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// So many doubles.
    type Real;

    /// The answers as bits, the lowest one that of the first lane.
    fn bits(self) -> u32;
    /// Whether one is yes.
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
    /// The doubles of the one where the answer is yes, of the other where it is no.
    fn select(self, yes: Self::Real, no: Self::Real) -> Self::Real;
}

/// What [`dispatch`] runs.
pub trait Work {
    /// What comes of it.
    type Output;

    /// Does it. To be marked `#[inline(always)]`.
    fn run<L: Lanes>(self, lanes: L) -> Self::Output;
}

/// How many lanes are used, of those that this processor has.
#[derive(Debug, Clone, Copy)]
pub struct Width(Kind);

#[derive(Debug, Clone, Copy)]
enum Kind {
    Scalar,
    Portable(Level),
    #[cfg(target_arch = "x86_64")]
    Avx2(fearless_simd::x86::Avx2),
    #[cfg(target_arch = "x86_64")]
    Avx512(fearless_simd::x86::Avx512),
}

/// There are no such lanes here.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there are no lanes `{name}` on this processor; there are {}", .available.join(", "))]
pub struct NoSuchLanes {
    /// What was asked for.
    pub name: String,
    /// What there is.
    pub available: Vec<&'static str>,
}

impl Width {
    /// One lane.
    pub const SCALAR: Self = Self(Kind::Scalar);

    /// The widest.
    #[must_use]
    pub fn best() -> Self {
        Self::available().pop().unwrap_or(Self::SCALAR)
    }

    /// All, the widest last.
    #[must_use]
    pub fn available() -> Vec<Self> {
        let narrow = [Self::SCALAR, Self(Kind::Portable(Level::baseline()))];
        narrow.into_iter().chain(wider(Level::new())).collect()
    }

    /// Those of a name: `scalar`, `portable` (two lanes of the instructions that every
    /// processor of this kind has), `avx2`, `avx512`.
    ///
    /// # Errors
    /// Where this processor has none of that name.
    pub fn by_name(name: &str) -> Result<Self, NoSuchLanes> {
        let all = Self::available();
        all.iter().copied().find(|width| width.name() == name).ok_or_else(|| NoSuchLanes {
            name: name.to_owned(),
            available: all.iter().map(Self::name).collect(),
        })
    }

    /// What the environment variable `LANCER_LANES` names, or the widest.
    ///
    /// # Errors
    /// Where this processor has none of that name.
    pub fn from_environment() -> Result<Self, NoSuchLanes> {
        match std::env::var_os("LANCER_LANES") {
            None => Ok(Self::best()),
            Some(name) => Self::by_name(&name.to_string_lossy()),
        }
    }

    /// By which it is chosen.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self.0 {
            Kind::Scalar => "scalar",
            Kind::Portable(_) => "portable",
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2(_) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Kind::Avx512(_) => "avx512",
        }
    }
}

/// Those that not every processor of this kind has.
#[cfg(target_arch = "x86_64")]
fn wider(level: Level) -> impl Iterator<Item = Width> {
    let avx2 = level.as_avx2().map(|avx2| Width(Kind::Avx2(avx2)));
    avx2.into_iter().chain(level.as_avx512().map(|avx512| Width(Kind::Avx512(avx512))))
}

#[cfg(not(target_arch = "x86_64"))]
fn wider(_: Level) -> impl Iterator<Item = Width> {
    std::iter::empty()
}

impl Default for Width {
    fn default() -> Self {
        Self::best()
    }
}

/// Runs `work` with that many lanes: once for a whole batch, since what is called
/// here is not inlined into the caller.
#[inline]
pub fn dispatch<W: Work>(width: Width, work: W) -> W::Output {
    match width.0 {
        Kind::Scalar => work.run(One),
        #[cfg(target_arch = "x86_64")]
        Kind::Avx2(avx2) => Wide(avx2).vectorize(
            #[inline(always)]
            || work.run(Wide(avx2)),
        ),
        #[cfg(target_arch = "x86_64")]
        Kind::Avx512(avx512) => Wide(avx512).vectorize(
            #[inline(always)]
            || work.run(Wide(avx512)),
        ),
        Kind::Portable(level) => portable(level, work),
    }
}

#[cfg(target_arch = "x86_64")]
fn portable<W: Work>(level: Level, work: W) -> W::Output {
    match level.as_sse2() {
        Some(sse2) => Wide(sse2).vectorize(
            #[inline(always)]
            || work.run(Wide(sse2)),
        ),
        None => work.run(One),
    }
}

#[cfg(target_arch = "aarch64")]
fn portable<W: Work>(level: Level, work: W) -> W::Output {
    match level.as_neon() {
        Some(neon) => Wide(neon).vectorize(
            #[inline(always)]
            || work.run(Wide(neon)),
        ),
        None => work.run(One),
    }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
fn portable<W: Work>(_: Level, work: W) -> W::Output {
    work.run(One)
}

/// The lanes whose bits are set.
#[inline(always)]
pub fn lanes_of(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(
        #[inline(always)]
        move || {
            let lane = (bits != 0).then(|| bits.trailing_zeros() as usize);
            bits &= bits.wrapping_sub(1);
            lane
        },
    )
}
