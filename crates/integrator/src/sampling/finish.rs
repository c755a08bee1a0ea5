//! What comes of all samples.

use super::Why;
use super::control::StopAt;
use super::table::Expected;
use super::tile::Tile;
use crate::Rgb;
use lancer_film::PixelQuality;
use std::time::Duration;

/// What is known of a sampled picture as a whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// The error that is expected, in exposed linear units.
    pub predicted: f64,
    /// How many samples there are.
    pub samples: u64,
    /// Pixels that have none, since it stopped before: they are black.
    pub unseen: u64,
    /// Why there are no more.
    pub stopped: Why,
    /// Where in their sequence it stopped.
    pub at: StopAt,
    /// How long rendering would take, where that was foretold, and when.
    pub forecast: Option<Forecast>,
    /// The exposure, 2^stops, that the error is measured with.
    pub exposure: f64,
}

/// How long rendering was foretold to take in all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Forecast {
    /// From its beginning to its end.
    pub all: Duration,
    /// How much of that was over when it was foretold.
    pub made_after: Duration,
}

/// For a smooth pixel: what an error with a normal distribution does not exceed in 95 of 100.
const NORMAL: f32 = 1.96;

impl Tile {
    /// The values of its pixels.
    pub(super) fn values(&self) -> Vec<Rgb> {
        let mut values = self.colour[..self.pixels()].to_vec();
        for pixel in &self.refined {
            if pixel.count() > 0 {
                values[usize::from(pixel.index)] = pixel.value().map(|v| v as f32);
            }
        }
        values
    }

    /// What is known of them.
    pub(super) fn quality(&self, expected: &Expected, largest: &Expected) -> Vec<PixelQuality> {
        let first = u32::from(self.is_seen);
        let smooth = self.error[..self.pixels()].iter().map(|error| {
            let error = error.sqrt();
            PixelQuality { error, interval: NORMAL * error, samples: first }
        });
        let mut quality: Vec<PixelQuality> = smooth.collect();
        for (pixel, standing) in self.refined.iter().zip(&self.standing) {
            if pixel.count() > 1 {
                quality[usize::from(pixel.index)] = PixelQuality {
                    error: expected.error(standing.places).sqrt() as f32,
                    interval: largest.error(standing.places).sqrt() as f32,
                    samples: standing.count,
                };
            }
        }
        quality
    }
}
