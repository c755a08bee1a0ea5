//! What pixels that look alike have been off.

use super::tile::{Half, Pixel};

/// Counts of samples of a half are told apart by their power of 2.
pub(super) const LEVELS: usize = 21;
/// Scatters are told apart by factors of 2, from 2^-30 to 1; twice, since those of pixels without
/// scatter are that of their neighbours.
const STEPS: usize = 31;
/// And by how near something else was met, where a half itself has no scatter.
const NEARNESSES: usize = 4;
const SCATTERS: usize = (1 + NEARNESSES) * STEPS;
/// Squared errors likewise; the first one is none at all.
const SIZES: usize = 42;

/// For each number of samples and scatter within a half, what the difference of the
/// halves has told.
#[derive(Default)]
pub(super) struct Table {
    fall: Fall,
    /// A row of cells for each number of samples, as far as there are any.
    rows: [Option<Vec<Cell>>; LEVELS],
}

/// How much squared errors have fallen where numbers of samples were doubled: sums over pixels, in the
/// units of cells.
#[derive(Default, Clone, Copy)]
struct Fall {
    pixels: u64,
    /// Doublings, each as often as the squared error before them.
    doublings: u128,
    before: u128,
    after: u128,
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

    fn add(&mut self, other: &Self) {
        self.count += other.count;
        self.sum += other.sum;
        for (size, other) in self.sizes.iter_mut().zip(other.sizes) {
            *size += other;
        }
    }
}

/// Up to which step pixels look flat: differences of about three steps of 8 bits.
const FLAT: usize = 17;
/// For how many of a flat cell's own pixels all flat ones of as many samples count.
///
/// What looks flat seldom is far off: where two samples of a distant checker fall on one colour. In
/// cells with a pixel or two such a pixel would be judged by itself alone, and believed. Those
/// that look as flat with other scatters tell how often that is.
const OF_ALL_FLAT: f64 = 16.0;

/// From so many pixels the fall of errors is told.
const ENOUGH: u64 = 200;
/// Independent samples: 1. Evenly spread ones along an edge: 1.5.
const SLOWEST: f64 = 1.0;
const FASTEST: f64 = 1.5;

const UNIT: f64 = 1_152_921_504_606_846_976.0; // 2^60

/// The share of pixels that an interval is made for: a little more than 95 in 100, since those
/// that look certain by chance are not refined any more (`cargo xtask calibrate` tells what comes
/// of it).
const SHARE: f64 = 0.975;

/// Where a half belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place(usize);

/// The place of a half of a pixel.
pub(super) fn place(half: &Half, pixel: &Pixel, exposure: f64) -> Place {
    let level = half.count.max(1).ilog2() as usize;
    let variance = half.variance(exposure);
    let scatter = if half.count > 1 && variance > 0.0 {
        step(variance)
    } else {
        STEPS * (1 + usize::from(pixel.nearness)) + step(f64::from(pixel.contrast))
    };
    Place(level.min(LEVELS - 1) * SCATTERS + scatter)
}

/// How many times 2^-30 must be doubled, at most 30 times, not to be less.
fn step(x: f64) -> usize {
    if x > 0.0 { (exponent(x) + STEPS as i32 - 1).clamp(0, STEPS as i32 - 1) as usize } else { 0 }
}

/// The power of 2 that a positive number is less than, but not half of; of subnormal numbers, some
/// low one.
pub(super) fn exponent(x: f64) -> i32 {
    (x.to_bits() >> 52) as i32 - 1022
}

impl Place {
    /// As a number for all.
    const fn number(self) -> u16 {
        self.0 as u16
    }

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
            size(step % STEPS) / 2.0
        } else {
            size(step % STEPS) / ((n + 1.0) * (n + 1.0))
        }
    }
}

impl Table {
    fn cell(&self, place: Place) -> &Cell {
        let row = self.rows[place.0 / SCATTERS].as_ref();
        row.map_or(&Cell::EMPTY, |row| &row[place.0 % SCATTERS])
    }

    /// Takes in a pixel whose halves have come to new numbers of samples; gives their
    /// places.
    pub(super) fn take(&mut self, pixel: &Pixel, exposure: f64) -> [u16; 2] {
        let observed = pixel.observed(exposure);
        // At most 1.
        let whole = u128::from((observed * UNIT) as u64);
        let size = if observed > 0.0 {
            (exponent(observed) + SIZES as i32 - 1).clamp(1, SIZES as i32 - 1) as usize
        } else {
            0
        };
        pixel.halves.each_ref().map(|half| {
            let place = place(half, pixel, exposure);
            let row = &mut self.rows[place.0 / SCATTERS];
            let row = row.get_or_insert_with(|| vec![Cell::EMPTY; SCATTERS]);
            let cell = &mut row[place.0 % SCATTERS];
            cell.count += 1;
            cell.sum += whole;
            cell.sizes[size] += 1;
            place.number()
        })
    }

    /// Takes in that a pixel of which that squared error was observed has had its number of
    /// samples doubled, so often.
    pub(super) fn falls(&mut self, before: f64, pixel: &Pixel, doublings: u32, exposure: f64) {
        let whole = |observed: f64| u128::from((observed * UNIT) as u64);
        let before = whole(before);
        self.fall.pixels += 1;
        self.fall.doublings += u128::from(doublings) * before;
        self.fall.before += before;
        self.fall.after += whole(pixel.observed(exposure));
    }

    /// By which power of the number of samples the squared error falls: what is seen of it, if that
    /// is of enough pixels, or else `usual`.
    pub(super) fn power(&self, usual: f64) -> f64 {
        let Fall { pixels, doublings, before, after } = self.fall;
        if pixels < ENOUGH || after == 0 || after >= before {
            return usual;
        }
        let doublings = doublings as f64 / before as f64;
        (libm::log2(before as f64 / after as f64) / doublings).clamp(SLOWEST, FASTEST)
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.fall.pixels += other.fall.pixels;
        self.fall.doublings += other.fall.doublings;
        self.fall.before += other.fall.before;
        self.fall.after += other.fall.after;
        for (row, other) in self.rows.iter_mut().zip(&other.rows) {
            let Some(other) = other else { continue };
            let row = row.get_or_insert_with(|| vec![Cell::EMPTY; SCATTERS]);
            row.iter_mut().zip(other).for_each(|(cell, other)| cell.add(other));
        }
    }

    /// What all flat pixels of a number of samples have been off: of those whose halves have
    /// some scatter, and of those without.
    fn flat(&self, level: usize) -> [Cell; 2] {
        let mut all = [Cell::EMPTY; 2];
        for (scatter, cell) in self.rows[level].iter().flatten().enumerate() {
            if scatter % STEPS <= FLAT {
                all[usize::from(scatter >= STEPS)].add(cell);
            }
        }
        all
    }

    /// For each place, what its own pixels have been off, and all flat ones if it is flat.
    fn by_place<T>(&self, tell: impl Fn(Place, &Cell, Option<&Cell>) -> T) -> Vec<T> {
        let last = self.rows.iter().rposition(Option::is_some);
        let levels = 0..last.map_or(0, |last| last + 1);
        let of_level = |level| {
            let flat = self.flat(level);
            let tell = &tell;
            (0..SCATTERS).map(move |scatter| {
                let place = Place(level * SCATTERS + scatter);
                let all = &flat[usize::from(scatter >= STEPS)];
                let is_flat = scatter % STEPS <= FLAT && all.count > 0;
                tell(place, self.cell(place), is_flat.then_some(all))
            })
        };
        levels.flat_map(of_level).collect()
    }

    /// The expected squared errors by the places of halves.
    pub(super) fn expected(&self) -> Expected {
        Expected(self.by_place(expected))
    }

    /// Of the squared errors by the places of halves, what 95 of 100 do not exceed.
    pub(super) fn largest(&self) -> Expected {
        Expected(self.by_place(largest))
    }
}

/// The expected squared error of a pixel with a half at that place.
fn expected(place: Place, own: &Cell, flat: Option<&Cell>) -> f64 {
    let (mean, weight) = match flat {
        Some(flat) => (flat.sum as f64 / UNIT / flat.count as f64, OF_ALL_FLAT),
        None => (place.guess(), 1.0),
    };
    (own.sum as f64 / UNIT + weight * mean) / (own.count as f64 + weight)
}

fn largest(place: Place, own: &Cell, flat: Option<&Cell>) -> f64 {
    let of_all =
        |size: usize| flat.map_or(0.0, |f| OF_ALL_FLAT * f64::from(f.sizes[size]) / f.count as f64);
    let count = own.count as f64 + if flat.is_some() { OF_ALL_FLAT } else { 0.0 };
    let wanted = count * SHARE;
    let mut below = 0.0;
    for (size, &of_own) in own.sizes.iter().enumerate() {
        let here = f64::from(of_own) + of_all(size);
        let next = below + here;
        if next >= wanted && here > 0.0 {
            if size == 0 {
                break;
            }
            // Evenly within a factor of 2.
            let top = libm::exp2(size as f64 - (SIZES - 1) as f64);
            return top * (0.5 + 0.5 * (wanted - below) / here);
        }
        below = next;
    }
    // None or hardly any was off: then no less than twice the deviation.
    4.0 * expected(place, own, flat)
}

/// Squared errors of pixels by the places of their halves.
pub(super) struct Expected(Vec<f64>);

impl Expected {
    /// That of a pixel whose halves have those places.
    pub(super) fn error(&self, places: [u16; 2]) -> f64 {
        // Each half is judged by what the others of others were, so both are.
        let [a, b] = places.map(|place| self.0[usize::from(place)]);
        (a + b) / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Seen, Stream};
    use fastrand::Rng;

    fn seen(value: f64) -> Seen {
        Seen { radiance: [value as f32; 3], signature: 0 }
    }

    /// Pixels with four samples, and then with sixteen, of what `value` draws.
    fn power(mut value: impl FnMut(Stream, u32) -> f64) -> f64 {
        let mut table = Table::default();
        for k in 0..2000 {
            let mut pixel = Pixel::new(0, 0, [0.0; 3], 0.0);
            let mut take = |pixel: &mut Pixel, indices: std::ops::Range<u32>| {
                for half in 0..2 {
                    let set = Stream::new(7, (k, 0), half, 0);
                    indices.clone().for_each(|i| {
                        pixel.add(half as usize, &[seen(value(set.at(i), k))], 0);
                    });
                }
            };
            take(&mut pixel, 0..2);
            let before = pixel.observed(1.0);
            take(&mut pixel, 2..8);
            table.falls(before, &pixel, 2, 1.0);
        }
        table.power(0.0)
    }

    #[test]
    fn the_fall_of_errors_is_that_of_what_is_sampled() {
        let mut rng = Rng::with_seed(3);
        let noise = power(|_, _| rng.f64());
        assert!((1.0..1.1).contains(&noise), "{noise}");
        // Slanted edges through the middle of the pixel.
        let edges = power(|stream, k| {
            let [u, v] = stream.pair(0);
            let slope = f64::from(k % 97) / 97.0;
            f64::from(u - 0.5 < slope * (v - 0.5))
        });
        assert!((1.3..=1.5).contains(&edges), "{edges}");
        assert_eq!(Table::default().power(1.35), 1.35);
    }

    /// One that is alone with its look is judged by all that look flat.
    #[test]
    fn what_looks_flat_is_judged_by_all_that_does() {
        let mut table = Table::default();
        let mut pixel = |contrast: f32, [a, b]: [f64; 2]| {
            let mut pixel = Pixel::new(0, 0, [0.0; 3], contrast);
            pixel.add(0, &[seen(a)], 0);
            pixel.add(1, &[seen(b)], 0);
            table.take(&pixel, 1.0)
        };
        for k in 0..400 {
            // One of a hundred was far off.
            pixel(1e-6, [0.0, if k % 100 == 0 { 0.8 } else { 0.0 }]);
        }
        let alone = pixel(1e-9, [0.0; 2]);
        let steep = pixel(0.3, [0.0; 2]);
        let expected = table.expected();
        // A hundredth of 0.8 squared over 4, for 16 of 18.
        let right = 0.01 * 0.16 * 16.0 / 18.0;
        assert!((expected.error(alone) / right - 1.0).abs() < 0.02, "{}", expected.error(alone));
        assert!((expected.error(steep) - 0.5 / 2.0 / 3.0).abs() < 0.05);
        assert!(table.largest().error(alone) > 2.0 * right);
    }
}
