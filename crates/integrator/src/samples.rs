//! Samples of a picture, and what is seen there.

use crate::numbers::Stream;
use crate::{RayCounts, Rgb};

/// How many samples are seen together, at most.
pub const MOST_SAMPLES: usize = crate::rows::BATCH;

/// A place of the picture to be seen, and the numbers for whatever else is left to chance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Column and row of the pixel that it is for.
    pub pixel: (u32, u32),
    /// Where in the picture, in pixels from its top left corner.
    pub place: [f64; 2],
    /// Numbers for the lens, lamps and so on.
    pub stream: Stream,
}

impl Sample {
    /// The sample of a pixel with those numbers.
    #[must_use]
    pub fn new(pixel: (u32, u32), stream: Stream) -> Self {
        Self::within(pixel, stream.pair(0), stream)
    }

    /// The sample at the pixel's centre.
    #[must_use]
    pub fn at_centre(pixel: (u32, u32), stream: Stream) -> Self {
        Self::within(pixel, [0.5, 0.5], stream)
    }

    /// The sample at that place within the pixel.
    pub(crate) fn within(pixel: (u32, u32), [u, v]: [f64; 2], stream: Stream) -> Self {
        Self { pixel, place: [f64::from(pixel.0) + u, f64::from(pixel.1) + v], stream }
    }
}

/// What a sample sees.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Seen {
    /// The radiance; black where it is not finite, which is counted as a trouble.
    pub radiance: Rgb,
    /// A hash of what was met on the way: the item and the part of it with a border of
    /// its own, the cell of a checker, which lights are hidden, and the same down the tree
    /// of mirrored and transmitted rays. Between samples of the same signature radiance is
    /// smooth, but for rays that are too weak to be followed.
    pub signature: u64,
}

/// A tracer that sees any place of the picture.
///
/// What a sample sees depends on the sample alone: not on others that are seen together
/// with it, nor on the thread.
pub trait Sampler: Sync {
    /// What the samples see, at most [`MOST_SAMPLES`] of them; `seen` has a place for each.
    /// Samples of the same or neighbouring pixels together are seen fastest.
    fn see(&self, samples: &[Sample], seen: &mut [Seen], counts: &mut RayCounts);

    /// What one sample sees, followed alone; the same, to the bit.
    fn see_alone(&self, sample: &Sample, counts: &mut RayCounts) -> Seen;
}
