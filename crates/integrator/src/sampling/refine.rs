//! More samples for pixels that need them.

use super::Strategy;
use super::table::Table;
use super::tile::{Standing, Tile};
use crate::numbers::Stream;
use crate::{MOST_SAMPLES, RayCounts, Sample, Sampler, Seen};
use std::ops::Range;

/// Where the samples of a set are.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spread {
    pub(super) strategy: Strategy,
    pub(super) seed: u64,
}

impl Spread {
    /// Has `take` take the samples with those indices, the last of them the last of all, of the
    /// set of a pixel to which the stream belongs.
    #[inline]
    fn samples(
        &self,
        pixel: (u32, u32),
        set: Stream,
        indices: Range<u32>,
        mut take: impl FnMut(Sample),
    ) {
        let of = indices.end;
        match self.strategy {
            Strategy::Edges | Strategy::Sobol => {
                for (index, place) in indices.clone().zip(set.places(indices)) {
                    take(Sample::within(pixel, place, set.at(index)));
                }
            }
            Strategy::Random => {
                indices.for_each(|index| take(Sample::new(pixel, set.apart(index))));
            }
            Strategy::Stratified => {
                let [columns, rows] = grid(of);
                for index in indices {
                    let stream = set.apart(index);
                    let [u, v] = stream.pair(0);
                    let (column, row) = (f64::from(index % columns), f64::from(index / columns));
                    let across = (column + u) / f64::from(columns);
                    let down = (row + v) / f64::from(rows);
                    take(Sample::within(pixel, [across, down], stream));
                }
            }
        }
    }

    /// Whether a set goes on where it is doubled; else it is drawn afresh.
    pub(super) const fn goes_on(&self) -> bool {
        !matches!(self.strategy, Strategy::Stratified)
    }
}

/// The columns and rows of a grid of so many cells, as near to a square as can be.
fn grid(cells: u32) -> [u32; 2] {
    let mut rows = cells.max(1).isqrt();
    while !cells.is_multiple_of(rows) {
        rows -= 1;
    }
    [cells / rows, rows]
}

/// What a thread has found out in a round.
#[derive(Default)]
pub(super) struct Found {
    pub(super) counts: RayCounts,
    pub(super) samples: u64,
    pub(super) table: Table,
}

/// Where a sample belongs: the tile, the place of the pixel among its refined ones, and the half.
type Owner = (usize, usize, usize);

/// Samples that wait to be seen together.
struct Batch {
    samples: Vec<Sample>,
    /// Whose they are, one after the other, and how many each has.
    owners: Vec<(Owner, usize)>,
}

impl Batch {
    fn add(&mut self, sample: Sample, owner: Owner) {
        self.samples.push(sample);
        match self.owners.last_mut() {
            Some((last, count)) if *last == owner => *count += 1,
            _ => self.owners.push((owner, 1)),
        }
    }

    fn see(&mut self, tiles: &mut [Tile], sampler: &dyn Sampler, found: &mut Found) {
        let mut seen = [Seen::default(); MOST_SAMPLES];
        let seen = &mut seen[..self.samples.len()];
        sampler.see(&self.samples, seen, &mut found.counts);
        let mut rest = &*seen;
        for &((tile, pixel, half), count) in &self.owners {
            let tile = &mut tiles[tile];
            let pixel = &mut tile.refined[pixel];
            let first = tile.signature[usize::from(pixel.index)];
            let (own, others) = rest.split_at(count);
            pixel.add(half, own, first);
            rest = others;
        }
        found.samples += self.samples.len() as u64;
        self.samples.clear();
        self.owners.clear();
    }
}

/// Gives each refined pixel of some tiles the number of samples that `wanted` says for its place
/// among them, in its two halves.
pub(super) fn refine(
    tiles: &mut [Tile],
    (sampler, spread): (&dyn Sampler, &Spread),
    exposure: f64,
    wanted: impl Fn(&Tile, usize) -> u32,
    found: &mut Found,
) {
    let mut batch = Batch { samples: Vec::with_capacity(MOST_SAMPLES), owners: Vec::new() };
    let mut changed = Vec::new();
    for at in 0..tiles.len() {
        for which in 0..tiles[at].refined.len() {
            let tile = &mut tiles[at];
            let wanted = wanted(tile, which);
            if wanted <= tile.standing[which].count {
                continue;
            }
            let known = &tile.refined[which];
            let before = (known.count() >= 2).then(|| (known.count(), known.observed(exposure)));
            changed.push((at, which, before));
            let place = tile.pixel(usize::from(tile.refined[which].index));
            let pixel = &mut tile.refined[which];
            if !spread.goes_on() {
                pixel.halves = Default::default();
            }
            let pixel = *pixel;
            for (half, wanted) in [wanted.div_ceil(2), wanted / 2].into_iter().enumerate() {
                let set = Stream::new(spread.seed, place, u32::from(pixel.set) + half as u32, 0);
                let owner = (at, which, half);
                spread.samples(place, set, pixel.halves[half].count..wanted, |sample| {
                    batch.add(sample, owner);
                    if batch.samples.len() == MOST_SAMPLES {
                        batch.see(tiles, sampler, found);
                    }
                });
            }
        }
    }
    batch.see(tiles, sampler, found);
    for (tile, which, before) in changed {
        let tile = &mut tiles[tile];
        let pixel = &tile.refined[which];
        if let Some((count, observed)) = before
            && let times = pixel.count() / count
            && times.is_power_of_two()
            && times * count == pixel.count()
        {
            found.table.falls(observed, pixel, times.ilog2(), exposure);
        }
        let (places, count) = (found.table.take(pixel, exposure), pixel.count());
        tile.standing[which] = Standing { places, count };
        if pixel.is_mixed {
            tile.is_mixed.put(usize::from(pixel.index));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_have_all_cells() {
        for (cells, sides) in [(1, [1, 1]), (2, [2, 1]), (8, [4, 2]), (9, [3, 3]), (7, [7, 1])] {
            assert_eq!(grid(cells), sides);
        }
    }

    #[test]
    fn each_cell_has_its_sample() {
        let spread = Spread { strategy: Strategy::Stratified, seed: 3 };
        for of in [1, 2, 6, 16] {
            let [columns, rows] = grid(of);
            let mut indices = 0..of;
            spread.samples((5, 9), Stream::new(3, (5, 9), 1, 0), 0..of, |sample| {
                let index = indices.next().expect("no more than asked for");
                let [x, y] = sample.place;
                let cell = [(x - 5.0) * f64::from(columns), (y - 9.0) * f64::from(rows)];
                assert_eq!(cell.map(|at| at as u32), [index % columns, index / columns]);
            });
            assert!(indices.is_empty());
        }
    }
}
