//! How many samples each pixel gets, and what is known of the error that is left.
//!
//! *The true picture* is, for each pixel, the mean over its square of the engine's
//! radiance. *The error* of a picture is the root of the mean square, over pixels and
//! components, of what it is off from the true one, both in exposed linear units (1 is
//! display white) and clipped to what is from 0 to 1; that of a pixel is the same over its
//! components.
//!
//! [`Strategy::Edges`], the usual one, works in rounds:
//!
//! 1. One sample in each pixel, anywhere in it (`first.rs`).
//! 2. Where it has the signature of its eight neighbours, a pixel is smooth: its value is
//!    that sample put to the centre along the slope that a plane through all nine has, and
//!    the residuals of that fit tell the error (`smooth.rs`).
//! 3. Other pixels are refined: two sets of samples that are independent of one another,
//!    *halves*, double in number again and again (`refine.rs`). Half the difference of their
//!    means has the variance of the error of both together, whatever the samples see.
//!    What pixels with the same scatter within one half have been off, by that measure, is
//!    added up in a table (`table.rs`); a pixel's error is read from it for either half. So
//!    one half judges the other, and a pixel that looks certain by chance is believed no
//!    more than others that look so.
//! 4. Each round refines the pixels that take most from the error for a sample, as many as
//!    the error asked for needs (`plan.rs`), and pixels beside those in which another
//!    signature was found, so that what is thinner than a pixel is followed along (`contours.rs`).
//!
//! Whether and how often a pixel is refined does not depend on the samples of which its value is
//! made, or hardly: a pixel that alone among its neighbours saw something starts
//! afresh (Kirk and Arvo, *Unbiased sampling techniques for image synthesis*, 1991).

mod contours;
mod control;
mod finish;
mod first;
mod plan;
mod refine;
mod rounds;
mod smooth;
mod table;
mod tile;

pub use control::{StopAt, Why};
pub use finish::{Accuracy, Forecast};
pub(crate) use rounds::{Job, sample};

use std::time::Duration;

/// What is asked of a picture that is sampled.
///
/// Where several ends are given, the first one counts; where none is, it is
/// [`Sampling::ERROR`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sampling {
    /// Where samples go.
    pub strategy: Strategy,
    /// Chooses another draw of the same numbers.
    pub seed: u64,
    /// So many samples in each pixel, whatever they see; a single one is at the centre.
    pub samples: Option<u32>,
    /// Until the predicted error is at most this, in exposed linear units.
    pub error: Option<f64>,
    /// Until so much time has passed since rendering began. It is looked at between pieces
    /// of work of a few thousand samples.
    pub time: Option<Duration>,
    /// Until that place in the sequence of samples, which an earlier picture of the same
    /// scene with the same settings told.
    pub stop_at: Option<StopAt>,
}

impl Sampling {
    /// The error that is usually asked for.
    pub const ERROR: f64 = 0.0005;

    /// More samples no pixel gets.
    pub const MOST: u32 = 1 << 20;
}

/// Where samples go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum Strategy {
    /// One in each pixel, and more where neighbours see other things.
    #[default]
    Edges,
    /// As many in each pixel, by Sobol's sequence, scrambled.
    Sobol,
    /// As many in each pixel, one anywhere in each cell of a grid.
    Stratified,
    /// As many in each pixel, anywhere.
    Random,
}

impl Strategy {
    /// All of them, the usual one first.
    pub const ALL: &'static [Self] = &[Self::Edges, Self::Sobol, Self::Stratified, Self::Random];

    /// The name by which users choose it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Edges => "edges",
            Self::Sobol => "sobol",
            Self::Stratified => "stratified",
            Self::Random => "random",
        }
    }

    /// The strategy of that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|strategy| strategy.name() == name)
    }
}
