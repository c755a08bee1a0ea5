//! What pixels that look alike have been off.

use super::tile::{Half, Pixel};

/// Counts of samples of a half are told apart by their power of 2.
pub(super) const LEVELS: usize = 21;
/// Scatters are told apart by factors of 2, from 2^-30 to 1; twice, since those of pixels without
/// scatter are that of their neighbours.
const STEPS: usize = 31;
const SCATTERS: usize = 2 * STEPS;
/// Squared errors likewise; the first one is none at all.
const SIZES: usize = 42;

/// For each number of samples and scatter within a half, what the difference of the
/// halves has told.
#[derive(Clone)]
pub(super) struct Table {
    cells: Vec<Cell>,
}

#[derive(Clone, Copy)]
struct Cell {
    count: u64,
    /// The sum of squared errors, in units of 2^-60: whole, so that the order does not matter.
    sum: u128,
    sizes: [u32; SIZES],
}

impl Cell {
    const EMPTY: Self = Self { count: 0, sum: 0, sizes: [0; SIZES] };
}

const UNIT: f64 = 1_152_921_504_606_846_976.0; // 2^60

/// Where a half belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place(usize);

/// The place of a half of a pixel.
pub(super) fn place(half: &Half, contrast: f32, exposure: f64) -> Place {
    let level = half.count.max(1).ilog2() as usize;
    let variance = half.variance(exposure);
    let scatter = if half.count > 1 && variance > 0.0 {
        step(variance)
    } else {
        STEPS + step(f64::from(contrast))
    };
    Place(level.min(LEVELS - 1) * SCATTERS + scatter)
}

/// How many times 2^-30 must be doubled, at most 30 times, not to be less.
fn step(x: f64) -> usize {
    // The exponent of a double is exact, whatever the machine.
    let exponent = libm::frexp(x).1;
    if x > 0.0 { (exponent + STEPS as i32 - 1).clamp(0, STEPS as i32 - 1) as usize } else { 0 }
}

impl Place {
    fn samples(self) -> f64 {
        f64::from(1_u32 << (self.0 / SCATTERS))
    }

    /// What would be expected without having seen others: of scatter v in n samples v / 2n,
    /// as if the samples were independent; without any, as if one of n + 1 saw what its
    /// neighbours see.
    fn guess(self) -> f64 {
        let (n, step) = (self.samples(), self.0 % SCATTERS);
        let size = |step: usize| libm::exp2(step as f64 - (STEPS - 1) as f64);
        if step < STEPS {
            size(step) / (2.0 * n)
        } else if n == 1.0 {
            size(step - STEPS) / 2.0
        } else {
            size(step - STEPS) / ((n + 1.0) * (n + 1.0))
        }
    }
}

impl Table {
    pub(super) fn new() -> Self {
        Self { cells: vec![Cell::EMPTY; LEVELS * SCATTERS] }
    }

    /// Takes in a pixel whose halves have come to new numbers of samples.
    pub(super) fn take(&mut self, pixel: &Pixel, exposure: f64) {
        let observed = pixel.observed(exposure);
        let whole = (observed * UNIT) as u128;
        let size = if observed > 0.0 {
            (libm::frexp(observed).1 + SIZES as i32 - 1).clamp(1, SIZES as i32 - 1) as usize
        } else {
            0
        };
        for half in &pixel.halves {
            let cell = &mut self.cells[place(half, pixel.contrast, exposure).0];
            cell.count += 1;
            cell.sum += whole;
            cell.sizes[size] += 1;
        }
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (cell, other) in self.cells.iter_mut().zip(&other.cells) {
            cell.count += other.count;
            cell.sum += other.sum;
            for (size, other) in cell.sizes.iter_mut().zip(other.sizes) {
                *size += other;
            }
        }
    }

    /// The expected squared error of a pixel with a half at that place.
    fn expected(&self, place: Place) -> f64 {
        let cell = &self.cells[place.0];
        (cell.sum as f64 / UNIT + place.guess()) / (cell.count as f64 + 1.0)
    }

    /// The expected squared error of a pixel.
    pub(super) fn error(&self, pixel: &Pixel, exposure: f64) -> f64 {
        let [a, b] = pixel
            .halves
            .each_ref()
            .map(|half| self.expected(place(half, pixel.contrast, exposure)));
        (a + b) / 2.0
    }

    /// What the error of a pixel does not exceed in 95 of 100 like it.
    pub(super) fn interval(&self, pixel: &Pixel, exposure: f64) -> f64 {
        let squares = pixel.halves.each_ref().map(|half| {
            let place = place(half, pixel.contrast, exposure);
            self.quantile(place)
        });
        ((squares[0] + squares[1]) / 2.0).sqrt()
    }

    fn quantile(&self, place: Place) -> f64 {
        let cell = &self.cells[place.0];
        let wanted = cell.count as f64 * 0.95;
        let mut below = 0.0;
        for (size, &count) in cell.sizes.iter().enumerate() {
            let next = below + f64::from(count);
            if next >= wanted && count > 0 {
                if size == 0 {
                    break;
                }
                // Evenly within a factor of 2.
                let top = libm::exp2(size as f64 - (SIZES - 1) as f64);
                return top * (0.5 + 0.5 * (wanted - below) / f64::from(count));
            }
            below = next;
        }
        // None or hardly any was off: then no less than twice the deviation.
        4.0 * self.expected(place)
    }
}
