//! More samples for pixels that need them.

use super::Strategy;
use super::table::Table;
use super::tile::{Standing, Tile};
use crate::numbers::Stream;
use crate::{MOST_SAMPLES, RayCounts, Sample, Sampler, Seen};

/// Where the samples of a set are.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spread {
    pub(super) strategy: Strategy,
    pub(super) seed: u64,
}

impl Spread {
    /// The sample with that index, of so many, of the set of a pixel to which the stream belongs.
    fn sample(&self, pixel: (u32, u32), set: Stream, index: u32, of: u32) -> Sample {
        match self.strategy {
            Strategy::Edges | Strategy::Sobol => Sample::new(pixel, set.at(index)),
            Strategy::Random => Sample::new(pixel, set.apart(index)),
            Strategy::Stratified => {
                let (stream, [columns, rows]) = (set.apart(index), grid(of));
                let [u, v] = stream.pair(0);
                let (column, row) = (f64::from(index % columns), f64::from(index / columns));
                let across = (column + u) / f64::from(columns);
                let down = (row + v) / f64::from(rows);
                let place = [f64::from(pixel.0) + across, f64::from(pixel.1) + down];
                Sample { pixel, place, stream }
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

/// Samples that wait to be seen together, and whose they are.
struct Batch {
    samples: Vec<Sample>,
    /// The tile, the place of the pixel among its refined ones, and the half.
    owners: Vec<(usize, usize, usize)>,
}

impl Batch {
    fn see(&mut self, tiles: &mut [Tile], sampler: &dyn Sampler, found: &mut Found) {
        let mut seen = [Seen::default(); MOST_SAMPLES];
        let seen = &mut seen[..self.samples.len()];
        sampler.see(&self.samples, seen, &mut found.counts);
        for (seen, &(tile, pixel, half)) in seen.iter().zip(&self.owners) {
            let tile = &mut tiles[tile];
            let pixel = &mut tile.refined[pixel];
            pixel.add(half, seen, tile.signature[usize::from(pixel.index)]);
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
    let mut batch = Batch { samples: Vec::new(), owners: Vec::new() };
    let mut changed = Vec::new();
    for at in 0..tiles.len() {
        for which in 0..tiles[at].refined.len() {
            let tile = &mut tiles[at];
            let wanted = wanted(tile, which);
            if wanted <= tile.standing[which].count {
                continue;
            }
            changed.push((at, which));
            let place = tile.pixel(usize::from(tile.refined[which].index));
            let pixel = &mut tile.refined[which];
            if !spread.goes_on() {
                pixel.halves = Default::default();
            }
            let pixel = *pixel;
            for (half, wanted) in [wanted.div_ceil(2), wanted / 2].into_iter().enumerate() {
                let set = Stream::new(spread.seed, place, u32::from(pixel.set) + half as u32, 0);
                for index in pixel.halves[half].count..wanted {
                    batch.samples.push(spread.sample(place, set, index, wanted));
                    batch.owners.push((at, which, half));
                    if batch.samples.len() == MOST_SAMPLES {
                        batch.see(tiles, sampler, found);
                    }
                }
            }
        }
    }
    batch.see(tiles, sampler, found);
    for (tile, which) in changed {
        let tile = &mut tiles[tile];
        let pixel = &tile.refined[which];
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
            for index in 0..of {
                let set = Stream::new(3, (5, 9), 1, 0);
                let [x, y] = spread.sample((5, 9), set, index, of).place;
                let cell = [(x - 5.0) * f64::from(columns), (y - 9.0) * f64::from(rows)];
                assert_eq!(cell.map(|at| at as u32), [index % columns, index / columns]);
            }
        }
    }
}
