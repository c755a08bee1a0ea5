//! The first sample of each pixel.

use super::tile::Tile;
use crate::numbers::Stream;
use crate::{MOST_SAMPLES, RayCounts, Sample, Sampler, Seen};

/// Where in its pixel the first sample is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Where {
    /// Anywhere: the first sample of the first set.
    Anywhere,
    /// At the centre.
    Centre,
}

/// The sample with that index in a set of a pixel.
fn first(pixel: (u32, u32), seed: u64, place: Where) -> Sample {
    let stream = Stream::new(seed, pixel, 0, 0);
    match place {
        Where::Anywhere => Sample::new(pixel, stream),
        Where::Centre => Sample::at_centre(pixel, stream),
    }
}

impl Tile {
    /// Sees the first sample of each of its pixels.
    pub(super) fn see_first(
        &mut self,
        sampler: &dyn Sampler,
        (seed, place): (u64, Where),
        counts: &mut RayCounts,
    ) {
        let mut seen = [Seen::default(); MOST_SAMPLES];
        let samples: Vec<Sample> =
            (0..self.pixels()).map(|k| first(self.pixel(k), seed, place)).collect();
        sampler.see(&samples, &mut seen[..samples.len()], counts);
        for (to, sample) in self.place.iter_mut().zip(&samples) {
            let ((x, y), [u, v]) = (sample.pixel, sample.place);
            *to = [(u - f64::from(x)) as f32, (v - f64::from(y)) as f32];
        }
        self.is_seen = true;
        for (k, seen) in seen[..samples.len()].iter().enumerate() {
            self.colour[k] = seen.radiance;
            self.signature[k] = seen.signature as u32;
        }
    }
}
