//! What is known of the pixels of a tile.

use super::plan::Class;
use crate::{Rgb, Seen, TILE_SIDE};
use lancer_film::Window;
use std::array;

/// How many pixels a tile has at most.
pub(super) const TILE: usize = (TILE_SIDE * TILE_SIDE) as usize;

/// The pixels of a tile, row by row; arrays are longer where it is smaller.
pub(super) struct Tile {
    pub(super) window: Window,
    /// Whether its pixels have their first samples.
    pub(super) is_seen: bool,
    /// What the first sample saw; where a pixel is smooth, the value that follows.
    pub(super) colour: [Rgb; TILE],
    /// The lower half of what the first sample has met.
    pub(super) signature: [u32; TILE],
    /// Where in the pixel the first sample is.
    pub(super) place: [[f32; 2]; TILE],
    /// The expected square of the error of those that are not refined.
    pub(super) error: [f32; TILE],
    /// The pixels that are refined.
    pub(super) is_refined: Set,
    /// Those in which something else was found than what the first sample met, or the first
    /// sample alone met what it met.
    pub(super) is_mixed: Set,
    /// Those in which there may be something that was found only between first samples, or by one of
    /// them alone.
    pub(super) is_thin: Set,
    /// Those of the mixed ones whose neighbours are refined for it.
    pub(super) is_followed: Set,
    /// Whether what is around its odd pixels has been looked through.
    pub(super) is_searched: bool,
    /// Those that are not refined by their classes, where that is known.
    pub(super) smooth: Option<Vec<(usize, Class)>>,
    /// So many samples its pixels should have at least, if any should.
    pub(super) least: Vec<u32>,
    /// The refined pixels, in the order in which that was found necessary.
    pub(super) refined: Vec<Pixel>,
    /// Where each of them stands: what is looked at in each round.
    pub(super) standing: Vec<Standing>,
    /// Those among them that are odd.
    pub(super) odd: Vec<u16>,
}

/// How many samples a refined pixel has, and the places of its halves in the table.
#[derive(Debug, Clone, Copy)]
pub(super) struct Standing {
    pub(super) places: [u16; 2],
    pub(super) count: u32,
}

/// A pixel that gets more than one sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pixel {
    /// Its place in the tile.
    pub(super) index: u8,
    /// The first of the two sets of samples that its halves are.
    pub(super) set: u8,
    /// Whether one of its samples has met something else than its first one.
    pub(super) is_mixed: bool,
    /// Whether its first sample alone met what it met, among its neighbours.
    pub(super) is_odd: bool,
    /// The variance among its first sample and those of its neighbours, of exposed values.
    pub(super) contrast: f32,
    /// How near a neighbour's first sample is that has met something else, from 0 to 3.
    pub(super) nearness: u8,
    /// How many samples, the first one not among them unless it counts, met what it met.
    pub(super) same: u32,
    /// What sums are relative to.
    pub(super) shift: Rgb,
    pub(super) halves: [Half; 2],
}

/// Samples that are independent of those of the other half.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Half {
    pub(super) count: u32,
    pub(super) sum: [f64; 3],
    /// The sum of squares over components.
    pub(super) squares: f64,
}

impl Tile {
    pub(super) fn new(window: Window) -> Self {
        Self {
            window,
            is_seen: false,
            colour: [[0.0; 3]; TILE],
            signature: [0; TILE],
            place: [[0.0; 2]; TILE],
            // Nothing is known.
            error: [1.0; TILE],
            is_refined: Set::default(),
            is_mixed: Set::default(),
            is_thin: Set::default(),
            is_followed: Set::default(),
            is_searched: false,
            smooth: None,
            least: Vec::new(),
            refined: Vec::new(),
            standing: Vec::new(),
            odd: Vec::new(),
        }
    }

    pub(super) fn pixels(&self) -> usize {
        self.window.pixels() as usize
    }

    /// Column and row of a pixel in the frame.
    pub(super) fn pixel(&self, index: usize) -> (u32, u32) {
        let index = index as u32;
        (self.window.x + index % self.window.width, self.window.y + index / self.window.width)
    }

    /// Has a pixel refined from now on.
    pub(super) fn refine(&mut self, pixel: Pixel) {
        let index = usize::from(pixel.index);
        self.is_refined.put(index);
        self.smooth = None;
        if pixel.is_odd {
            self.is_mixed.put(index);
            self.odd.push(self.refined.len() as u16);
        }
        if pixel.is_thin() {
            self.is_thin.put(index);
        }
        self.standing.push(Standing { places: [0; 2], count: pixel.count() });
        self.refined.push(pixel);
    }
}

/// Some pixels of a tile.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Set([u64; TILE / 64]);

impl Set {
    pub(super) fn has(&self, index: usize) -> bool {
        self.0[index / 64] >> (index % 64) & 1 == 1
    }

    pub(super) fn put(&mut self, index: usize) {
        self.0[index / 64] |= 1 << (index % 64);
    }

    /// Those that are in both.
    pub(super) fn and(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] & other.0[k]))
    }

    /// Those that are not in the other one.
    pub(super) fn without(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] & !other.0[k]))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0 == [0; TILE / 64]
    }
}

impl Half {
    fn add(&mut self, seen: &[Seen], shift: Rgb) {
        let (mut sum, mut squares) = (self.sum, self.squares);
        let shift = shift.map(f64::from);
        for seen in seen {
            let more: [f64; 3] = array::from_fn(|i| f64::from(seen.radiance[i]) - shift[i]);
            for (sum, more) in sum.iter_mut().zip(more) {
                *sum += more;
            }
            squares += more.iter().map(|more| more * more).sum::<f64>();
        }
        self.count += seen.len() as u32;
        (self.sum, self.squares) = (sum, squares);
    }

    /// The variance of a sample, mean of the components, of exposed values; 0 where there
    /// are not two.
    pub(super) fn variance(&self, exposure: f64) -> f64 {
        if self.count < 2 {
            return 0.0;
        }
        let n = f64::from(self.count);
        let sum = self.sum.iter().map(|sum| sum * sum).sum::<f64>();
        let variance = (self.squares - sum / n) / (3.0 * (n - 1.0));
        (variance * exposure * exposure).max(0.0)
    }

    fn mean(&self, shift: Rgb) -> [f64; 3] {
        let n = f64::from(self.count);
        [0, 1, 2].map(|i| f64::from(shift[i]) + self.sum[i] / n)
    }
}

impl Pixel {
    /// One without samples.
    pub(super) fn new(index: usize, set: u8, first: Rgb, contrast: f32) -> Self {
        Self {
            index: index as u8,
            set,
            is_mixed: false,
            is_odd: false,
            contrast,
            nearness: 0,
            same: 0,
            shift: first,
            halves: [Half::default(); 2],
        }
    }

    /// Whether neighbours' first samples did not show that there is an edge.
    pub(super) const fn is_thin(&self) -> bool {
        self.set != 0
    }

    pub(super) fn count(&self) -> u32 {
        self.halves[0].count + self.halves[1].count
    }

    /// Takes in samples of one half; `first` is the signature of the first sample.
    pub(super) fn add(&mut self, half: usize, seen: &[Seen], first: u32) {
        self.halves[half].add(seen, self.shift);
        let same = seen.iter().filter(|seen| seen.signature as u32 == first).count();
        self.same += same as u32;
        self.is_mixed |= same < seen.len();
    }

    /// The mean of all samples.
    pub(super) fn value(&self) -> [f64; 3] {
        let n = f64::from(self.count());
        let [a, b] = &self.halves;
        [0, 1, 2].map(|i| f64::from(self.shift[i]) + (a.sum[i] + b.sum[i]) / n)
    }

    /// The expected square of the error of the mean of both halves, as far as their difference
    /// tells: mean over components of what is exposed and clipped.
    pub(super) fn observed(&self, exposure: f64) -> f64 {
        let [a, b] = self.halves.each_ref().map(|half| half.mean(self.shift));
        let [n, m] = self.halves.map(|half| f64::from(half.count));
        let shown = |v: f64| (v * exposure).clamp(0.0, 1.0);
        let squares = (0..3).map(|i| shown(a[i]) - shown(b[i])).map(|d| d * d).sum::<f64>();
        // The variance of a mean of n is v / n if that of one is v, so the difference has
        // v (1 / n + 1 / m), and the mean of both v / (n + m).
        squares / 3.0 * (n * m / ((n + m) * (n + m)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(v: f32) -> Seen {
        Seen { radiance: [v; 3], signature: u64::from(v > 0.5) }
    }

    #[test]
    fn o3_means_are_exact_for_many_samples_and_variances_of_bright_ones() {
        let mut pixel = Pixel::new(0, 0, [0.0; 3], 0.0);
        for k in 0..1 << 22 {
            pixel.add(k % 2, &[seen(0.1)], 0);
        }
        let right = f64::from(0.1_f32);
        assert!((pixel.value()[1] / right - 1.0).abs() < 1e-9);
        // A mean of 1e4 with a deviation of about 1e-3, which singles hold so roughly.
        let mut pixel = Pixel::new(0, 0, [1e4; 3], 0.0);
        let step = 1e4_f32.next_up() - 1e4;
        for k in 0..1000 {
            pixel.add(0, &[seen(if k % 2 == 0 { 1e4 } else { 1e4_f32.next_up() })], 0);
        }
        let right = f64::from(step) * f64::from(step) / 4.0 * (1000.0 / 999.0);
        assert!((pixel.halves[0].variance(1.0) / right - 1.0).abs() < 1e-6);
    }

    #[test]
    fn half_the_difference_of_halves_tells_the_error_of_both() {
        let mut pixel = Pixel::new(0, 0, [0.25; 3], 0.0);
        pixel.add(0, &[seen(0.25)], 0);
        pixel.add(1, &[seen(0.75)], 0);
        assert_eq!((pixel.value(), pixel.observed(1.0)), ([0.5; 3], 0.0625));
        // Beyond white there is no difference.
        assert_eq!(pixel.observed(10.0), 0.0);
        assert!(pixel.is_mixed && pixel.same == 1);
    }
}
