//! The true picture by brute force.
//!
//! Each pixel is cut into n x n equal squares, and in each a sample falls on a place chosen at
//! random: nothing is looked at before it is decided where the samples go, and none is left out.
//! That is done twice, with other random numbers, and the half of the two pictures'
//! difference is the standard error of their mean. n grows, each time from the start, until
//! that is as small as was asked for.

use crate::picture::{Exposed, Picture, exposed};
use lancer_film::Size;
use lancer_integrator::{MOST_SAMPLES, RayCounts, Sample, Sampler, Seen, Stream};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// How a reference is made.
#[derive(Clone, Copy)]
pub struct ReferenceSettings<'a> {
    /// Its pixels.
    pub size: Size,
    /// The factor that exposes it.
    pub factor: f64,
    /// It is good enough with this error at most.
    pub error: f64,
    /// Is asked how many samples for each pixel it may be made anew with, before it is.
    pub affords: &'a (dyn Fn() -> u32 + Sync),
    /// Another seed gives another draw.
    pub seed: u64,
    /// Where this becomes true there is none.
    pub cancel: Option<&'a AtomicBool>,
}

impl ReferenceSettings<'_> {
    /// How many samples each pixel has at first.
    pub const FEWEST_SAMPLES: u32 = 2 * FEWEST * FEWEST;
}

/// What a picture is held against.
#[derive(Debug, Clone)]
pub struct Reference {
    /// The picture.
    pub picture: Picture,
    /// Its own standard error, as errors are defined ([`Picture::error`]): by the
    /// differences of two independent halves.
    pub error: f64,
    /// How many samples each pixel has.
    pub samples: u32,
    /// By how much the samples of each pixel differ in the channel in which they differ most,
    /// exposed and clipped each.
    pub spreads: Vec<f32>,
}

/// n at first. What is found by so many samples twice is not overlooked by both, or is so small
/// that it does not matter.
const FEWEST: u32 = 16;

/// Makes a reference of what the sampler sees, on the threads of the pool that it is called in.
/// `None` where that was cancelled.
#[must_use]
pub fn reference(sampler: &dyn Sampler, settings: &ReferenceSettings<'_>) -> Option<Reference> {
    // n, and how n^-power the error is: along an edge that of n x n samples is as n^-1.5, and
    // what has nothing to do with the place in the pixel as n^-1.
    let (mut side, mut power) = (FEWEST, 1.5);
    loop {
        let found = halves(sampler, settings, side)?;
        if found.error <= settings.error {
            return Some(found);
        }
        // A bit more than seems to be needed, so that it is not done all over for nothing.
        let missing = 1.1 * found.error / settings.error;
        let times = libm::pow(missing, 1.0 / power).clamp(LEAST_GROWTH, 8.0);
        let wanted = libm::ceil(f64::from(side) * times) as u32;
        // As many as may be, if that is less, unless it is hardly worth it.
        let next = wanted.min(((settings.affords)() / 2).isqrt()).min(MOST);
        if f64::from(next) < LEAST_GROWTH * f64::from(side) {
            return Some(found);
        }
        side = next;
        // What stays behind the first hope is more like noise.
        power = 1.0;
    }
}

/// By less n does not grow.
const LEAST_GROWTH: f64 = 1.2;

/// n in the end: twice its square is a number of samples.
const MOST: u32 = 46_340;

/// The mean of two pictures with side x side samples for each pixel, and what they say.
fn halves(sampler: &dyn Sampler, settings: &ReferenceSettings<'_>, side: u32) -> Option<Reference> {
    let Size { width, height } = settings.size;
    let rows: Vec<Vec<Found>> = (0..height)
        .into_par_iter()
        .map(|y| {
            let is_cancelled = settings.cancel.is_some_and(|c| c.load(Ordering::Relaxed));
            (!is_cancelled).then(|| row(sampler, settings, y, side))
        })
        .collect::<Option<_>>()?;
    let found: Vec<Found> = rows.into_iter().flatten().collect();
    let share = 1.0 / (f64::from(side) * f64::from(side));
    let squares = |found: &Found| {
        let [a, b] = found.sums.map(|sum| exposed(sum.map(|v| v * share), settings.factor));
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>()
    };
    let square: f64 = found.iter().map(squares).sum();
    let means = found.iter().map(|found| {
        let [a, b] = found.sums;
        std::array::from_fn(|i| 0.5 * share * (a[i] + b[i]))
    });
    Some(Reference {
        picture: Picture::new(settings.size, means, settings.factor)?,
        error: 0.5 * (square / (3.0 * f64::from(width) * f64::from(height))).sqrt(),
        samples: 2 * side * side,
        spreads: found.iter().map(Found::spread).collect(),
    })
}

/// What is known of a pixel.
#[derive(Debug, Clone, Copy)]
struct Found {
    /// The sums of radiance of both halves.
    sums: [Exposed; 2],
    least: [f32; 3],
    most: [f32; 3],
}

impl Found {
    const NOTHING: Self = Self { sums: [[0.0; 3]; 2], least: [1.0; 3], most: [0.0; 3] };

    fn take(&mut self, half: usize, radiance: [f32; 3], factor: f64) {
        for (i, value) in radiance.into_iter().enumerate() {
            self.sums[half][i] += f64::from(value);
            let shown = (f64::from(value) * factor).clamp(0.0, 1.0) as f32;
            self.least[i] = self.least[i].min(shown);
            self.most[i] = self.most[i].max(shown);
        }
    }

    fn spread(&self) -> f32 {
        let spreads = self.most.iter().zip(self.least).map(|(most, least)| most - least);
        spreads.fold(0.0, f32::max)
    }
}

/// The pixels of a row.
fn row(sampler: &dyn Sampler, settings: &ReferenceSettings<'_>, y: u32, side: u32) -> Vec<Found> {
    let mut row = vec![Found::NOTHING; settings.size.width as usize];
    let mut batch = Batch::new(sampler, settings.factor);
    for x in 0..settings.size.width {
        for half in 0..2 {
            let mut random = Random::new(settings.seed, half, (x, y));
            for index in 0..side * side {
                let (column, line) = (index % side, index / side);
                let [u, v] = random.pair();
                let within = |square: u32, part: f64| (f64::from(square) + part) / f64::from(side);
                // Neighbouring samples have neighbouring numbers for lens and lamps: those of
                // Sobol's sequence are spread evenly within each row of squares, too.
                let stream = Stream::new(settings.seed, (x, y), half, index);
                batch.add(
                    &mut row,
                    Sample {
                        pixel: (x, y),
                        place: [f64::from(x) + within(column, u), f64::from(y) + within(line, v)],
                        stream,
                    },
                    half,
                );
            }
        }
    }
    batch.see(&mut row);
    row
}

/// Samples that are to be seen together.
struct Batch<'a> {
    sampler: &'a dyn Sampler,
    factor: f64,
    samples: Vec<Sample>,
    halves: Vec<u32>,
    seen: Vec<Seen>,
}

impl<'a> Batch<'a> {
    fn new(sampler: &'a dyn Sampler, factor: f64) -> Self {
        Self {
            sampler,
            factor,
            samples: Vec::with_capacity(MOST_SAMPLES),
            halves: Vec::with_capacity(MOST_SAMPLES),
            seen: vec![Seen::default(); MOST_SAMPLES],
        }
    }

    fn add(&mut self, row: &mut [Found], sample: Sample, half: u32) {
        self.samples.push(sample);
        self.halves.push(half);
        if self.samples.len() == MOST_SAMPLES {
            self.see(row);
        }
    }

    fn see(&mut self, row: &mut [Found]) {
        let seen = &mut self.seen[..self.samples.len()];
        self.sampler.see(&self.samples, seen, &mut RayCounts::default());
        for ((sample, half), seen) in self.samples.iter().zip(&self.halves).zip(seen) {
            row[sample.pixel.0 as usize].take(*half as usize, seen.radiance, self.factor);
        }
        self.samples.clear();
        self.halves.clear();
    }
}

/// Random numbers of its own, so that a fault in those of the pictures shows: the upper bits
/// of a linear congruential generator with Knuth's multiplier (*TAOCP* 2, 3.3.4).
struct Random(u64);

impl Random {
    fn new(seed: u64, half: u32, (x, y): (u32, u32)) -> Self {
        let mut random = Self(seed ^ 0x6a09_e667_f3bc_c908);
        for part in [half, x, y] {
            random.0 = random.0.wrapping_add(u64::from(part)).wrapping_mul(MULTIPLIER);
            random.0 ^= random.0 >> 29;
        }
        random
    }

    /// At least 0 and below 1.
    fn pair(&mut self) -> [f64; 2] {
        [(); 2].map(|()| {
            self.0 = self.0.wrapping_mul(MULTIPLIER).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        })
    }
}

const MULTIPLIER: u64 = 6_364_136_223_846_793_005;

#[cfg(test)]
mod tests;
