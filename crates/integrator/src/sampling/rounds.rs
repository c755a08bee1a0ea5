//! Round after round, until the end.

use super::control::Control;
use super::finish::{Accuracy, Forecast};
use super::first::Where;
use super::plan::{Plan, SMOOTH_SAMPLES, Tally, class, plan};
use super::refine::{Found, Spread, refine};
use super::smooth::{Neighbours, analyse};
use super::table::Table;
use super::tile::{Pixel, Tile};
use super::{Sampling, Strategy, Why};
use crate::numbers::mixed;
use crate::{RayCounts, Rgb, Sampler, TILE_SIDE};
use lancer_film::{PixelQuality, Window};
use lancer_kernel::lanes::Width;
use rayon::prelude::*;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// How many tiles a piece of work has: neighbours, whose samples are seen together.
const PIECE: usize = 4;
/// Over how many tiles sums are made, the same for any number of threads.
const PART: usize = 64;
/// More samples no pixel gets.
const MOST: u32 = 1 << 20;
/// The error that is come to first; from there to the one asked for in steps of a half, so that
/// what there is at any time is about the best for its samples.
const FIRST_TARGET: f64 = 1.0 / 64.0;
/// What is predicted must be so much less than what was asked for: a prediction is right in the
/// mean, and so every other time too low.
const MARGIN: f64 = 0.95;
/// From which part of the squared error asked for on what may be missed is looked for.
const MISSED: f64 = 0.25;

/// What a picture is sampled with.
pub(crate) struct Job<'a> {
    pub(crate) sampler: &'a dyn Sampler,
    pub(crate) window: Window,
    pub(crate) sampling: &'a Sampling,
    /// 2^stops.
    pub(crate) exposure: f64,
    pub(crate) lanes: Width,
    pub(crate) begun: Instant,
    pub(crate) cancel: Option<&'a AtomicBool>,
    /// Is told how many samples there are and how many there may be in the end.
    pub(crate) progress: Option<&'a crate::Progress<'a>>,
}

/// The picture in tiles, row by row.
pub(crate) struct Sampled {
    picture: Picture,
    pub(crate) accuracy: Accuracy,
    pub(crate) counts: RayCounts,
}

impl Sampled {
    /// Each tile's window, values, and what is known of them.
    pub(crate) fn tiles(&self) -> Vec<(Window, Vec<Rgb>, Vec<PixelQuality>)> {
        let Picture { tiles, table, exposure, first, .. } = &self.picture;
        let of = |tile: &Tile| (tile.window, tile.values(), tile.quality(table, *exposure, *first));
        tiles.par_iter().map(of).collect()
    }
}

/// All that is known so far.
struct Picture {
    tiles: Vec<Tile>,
    /// How many tiles there are in a row.
    across: usize,
    table: Table,
    exposure: f64,
    /// The samples of pixels that are not refined.
    first: u32,
    samples: u64,
    counts: RayCounts,
    /// The squared error of what may have been missed between samples.
    missed: f64,
}

/// Samples a window of the frame.
pub(crate) fn sample(job: &Job<'_>) -> Sampled {
    let Sampling { samples, error, time, stop_at, strategy, .. } = *job.sampling;
    let deadline = time.and_then(|time| job.begun.checked_add(time));
    let control = Control::new(deadline, job.cancel, stop_at);
    let mut picture = Picture::new(job);
    let asked = match (samples, error, time, stop_at) {
        (None, None, None, None) => Some(Sampling::ERROR),
        _ => error,
    };
    let (why, forecast) = match (samples, strategy) {
        (Some(1), _) => (picture.centres(job, &control), None),
        (None, Strategy::Edges) => picture.edges(job, &control, asked),
        _ => (picture.evenly(job, &control, samples, asked), None),
    };
    let (at, stopped) = control.state();
    let unseen = picture.unseen();
    let accuracy = Accuracy {
        predicted: picture.predicted(&picture.tally()),
        samples: picture.samples,
        unseen,
        stopped: stopped.unwrap_or(why),
        at,
        forecast,
        exposure: job.exposure,
    };
    let counts = picture.counts;
    Sampled { picture, accuracy, counts }
}

impl Picture {
    fn new(job: &Job<'_>) -> Self {
        let tiles = job.window.strips(TILE_SIDE, TILE_SIDE).map(Tile::new).collect();
        Self {
            tiles,
            across: job.window.width.div_ceil(TILE_SIDE) as usize,
            table: Table::new(),
            exposure: job.exposure,
            first: 1,
            samples: 0,
            counts: RayCounts::default(),
            missed: 0.0,
        }
    }

    fn pixels(&self) -> f64 {
        self.tiles.iter().map(|tile| tile.pixels() as f64).sum()
    }

    /// Pixels without a sample.
    fn unseen(&self) -> u64 {
        let unseen = |tile: &Tile| {
            if !tile.place.is_empty() {
                return 0;
            }
            let seen = tile.refined.iter().filter(|pixel| pixel.count() > 0).count();
            (tile.pixels() - seen) as u64
        };
        self.tiles.iter().map(unseen).sum()
    }

    /// Has `work` done to all tiles in one round.
    fn round(&mut self, control: &Control<'_>, work: impl Fn(&mut Found, &mut [Tile]) + Sync) {
        let pieces = self.tiles.chunks_mut(PIECE);
        let found = control.round(pieces, work, Found::new);
        for found in found {
            self.counts += found.counts;
            self.samples += found.samples;
            self.table.add(&found.table);
        }
    }

    fn first_samples(&mut self, job: &Job<'_>, control: &Control<'_>, place: Where) {
        self.round(control, |found, tiles| {
            for tile in tiles {
                tile.see_first(job.sampler, (job.sampling.seed, place), &mut found.counts);
                found.samples += tile.pixels() as u64;
            }
        });
    }

    /// Looks at the first samples, and gives the pixels that are not smooth by tile.
    fn look(&mut self, job: &Job<'_>) -> Vec<Vec<Pixel>> {
        let (tiles, across) = (&self.tiles, self.across);
        let found: Vec<_> = (0..tiles.len())
            .into_par_iter()
            .map(|index| {
                (!tiles[index].place.is_empty())
                    .then(|| analyse(&Neighbours { tiles, across, index }, job.exposure, job.lanes))
            })
            .collect();
        let put = |(tile, found): (&mut Tile, Option<super::smooth::Analysis>)| {
            found.map_or_else(Vec::new, |found| {
                tile.colour = found.colour;
                tile.error = found.error;
                found.edges
            })
        };
        self.tiles.iter_mut().zip(found).map(put).collect()
    }

    /// One sample at the centre of each pixel.
    fn centres(&mut self, job: &Job<'_>, control: &Control<'_>) -> Why {
        self.first_samples(job, control, Where::Centre);
        // The samples are the values.
        let colours: Vec<_> = self.tiles.iter().map(|tile| tile.colour.clone()).collect();
        let edges = self.look(job);
        drop(edges);
        for (tile, colour) in self.tiles.iter_mut().zip(colours) {
            tile.colour = colour;
        }
        Why::Samples
    }

    /// As many samples in each pixel.
    fn evenly(
        &mut self,
        job: &Job<'_>,
        control: &Control<'_>,
        samples: Option<u32>,
        asked: Option<f64>,
    ) -> Why {
        let spread = Spread { strategy: job.sampling.strategy, seed: job.sampling.seed };
        for tile in &mut self.tiles {
            for index in 0..tile.pixels() {
                tile.refine(Pixel::new(index, 0, [0.0; 3], 1.0));
            }
        }
        let most = samples.unwrap_or(MOST);
        let mut wanted = if asked.is_none() && samples.is_some() { most } else { 2 };
        loop {
            self.round(control, |found, tiles| {
                refine(tiles, (job.sampler, &spread), job.exposure, |_, _| wanted, found);
            });
            if let Some(progress) = job.progress {
                progress(self.samples, self.samples);
            }
            if let (_, Some(why)) = control.state() {
                return why;
            }
            if asked.is_some_and(|asked| self.predicted(&self.tally()) <= asked * MARGIN) {
                return Why::Error;
            }
            if wanted >= most {
                return if samples.is_some() { Why::Samples } else { Why::MostSamples };
            }
            wanted = (2 * wanted).min(most);
        }
    }

    /// Samples where they are needed.
    fn edges(
        &mut self,
        job: &Job<'_>,
        control: &Control<'_>,
        asked: Option<f64>,
    ) -> (Why, Option<Forecast>) {
        self.first_samples(job, control, Where::Anywhere);
        let edges = self.look(job);
        for (tile, edges) in self.tiles.iter_mut().zip(edges) {
            for mut edge in edges {
                if !edge.is_odd {
                    // Its first sample had no part in the decision.
                    let (index, colour) = (usize::from(edge.index), edge.shift);
                    let signature = u64::from(tile.signature[index]);
                    edge.add(
                        0,
                        &crate::Seen { radiance: colour, signature },
                        tile.signature[index],
                    );
                }
                tile.refine(edge);
            }
        }
        let spread = Spread { strategy: Strategy::Edges, seed: job.sampling.seed };
        // Each has a sample in either half before anything is decided.
        self.refine_to(job, control, &spread, |_, _| 2);
        let asked = asked.unwrap_or(0.0);
        let mut target = asked.max(FIRST_TARGET);
        let mut forecast = None;
        loop {
            if let (_, Some(why)) = control.state() {
                return (why, forecast);
            }
            self.follow_contours();
            self.refine_to(job, control, &spread, |_, pixel| pixel.count().max(2));
            self.keep_up(job, control, &spread);
            let tally = self.tally();
            let pixels = self.pixels();
            let allowed = |target: f64| target * MARGIN * target * MARGIN * pixels;
            if forecast.is_none() && target < FIRST_TARGET && asked > 0.0 {
                forecast = self.forecast(job, &tally, allowed(asked));
            }
            if tally.error() + self.missed <= allowed(target) {
                if target <= asked {
                    return (Why::Error, forecast);
                }
                target = asked.max(target / 2.0);
                continue;
            }
            if self.missed > MISSED * allowed(target) && self.look_around() {
                continue;
            }
            let Some(plan) = plan(&tally, (allowed(target) - self.missed).max(0.0), MOST) else {
                return (Why::MostSamples, forecast);
            };
            if let Some(progress) = job.progress {
                progress(self.samples, self.samples + plan.to_come as u64);
            }
            let before = self.samples;
            self.carry_out(job, control, &spread, &plan);
            if self.samples == before && control.state().1.is_none() {
                // A part of a few pixels may be none of them.
                self.carry_out(job, control, &spread, &plan.of_all());
            }
        }
    }

    fn refine_to(
        &mut self,
        job: &Job<'_>,
        control: &Control<'_>,
        spread: &Spread,
        wanted: impl Fn(&Tile, &Pixel) -> u32 + Sync,
    ) {
        let sees = (job.sampler, spread);
        let is_wanted = |tile: &Tile| tile.refined.iter().any(|p| wanted(tile, p) > p.count());
        if self.tiles.par_iter().any(is_wanted) {
            self.round(control, |found, tiles| {
                refine(tiles, sees, job.exposure, &wanted, found);
            });
        }
    }

    /// Refines what the plan says.
    fn carry_out(&mut self, job: &Job<'_>, control: &Control<'_>, spread: &Spread, plan: &Plan) {
        let (table, exposure) = (self.table.clone(), self.exposure);
        self.tiles.par_iter_mut().for_each(|tile| tile.promote(plan));
        self.refine_to(job, control, spread, |tile, pixel| {
            let count = pixel.count();
            if count == 0 {
                return SMOOTH_SAMPLES;
            }
            let class = class(count, table.error(pixel, exposure));
            plan.samples(class, count, tile.chance(usize::from(pixel.index)))
        });
    }

    /// Gives pixels beside what was found between samples as many samples as that has. There a
    /// pixel that seems empty may be one in which the same thin thing was not met yet: so
    /// whether it goes on depends on the others, and it is right in the mean.
    fn keep_up(&mut self, job: &Job<'_>, control: &Control<'_>, spread: &Spread) {
        let (tiles, across) = (&self.tiles, self.across);
        let ahead: Vec<Vec<(usize, usize, u32)>> = (0..tiles.len())
            .into_par_iter()
            .map(|index| {
                let around = Neighbours { tiles, across, index };
                let leaders = tiles[index].refined.iter().filter(|p| p.is_mixed && p.is_thin());
                let beside = leaders.flat_map(|pixel| {
                    let count = pixel.count();
                    let beside = around.beside(usize::from(pixel.index));
                    beside.map(move |(tile, k)| (tile, k, count))
                });
                beside.collect()
            })
            .collect();
        if ahead.iter().all(Vec::is_empty) {
            return;
        }
        let mut least = vec![Vec::new(); self.tiles.len()];
        for (tile, k, count) in ahead.into_iter().flatten() {
            let least = &mut least[tile];
            if least.is_empty() {
                least.resize(self.tiles[tile].pixels(), 0);
            }
            least[k] = count.max(least[k]);
        }
        for (tile, least) in self.tiles.iter_mut().zip(least) {
            tile.least = least;
        }
        self.refine_to(job, control, spread, |tile, pixel| {
            let least = tile.least.get(usize::from(pixel.index)).copied().unwrap_or(0);
            if pixel.is_thin() { pixel.count().max(least) } else { pixel.count() }
        });
    }

    /// Adds up what is expected of all pixels.
    fn tally(&self) -> Tally {
        let parts: Vec<Tally> = self
            .tiles
            .par_chunks(PART)
            .map(|tiles| {
                let mut tally = Tally::new();
                for tile in tiles {
                    for (index, error) in tile.error.iter().enumerate() {
                        if !tile.is_refined.has(index) {
                            tally.take(0, f64::from(*error));
                        }
                    }
                    for pixel in &tile.refined {
                        match pixel.count() {
                            0 => tally.take(0, f64::from(tile.error[usize::from(pixel.index)])),
                            count => tally.take(count, self.table.error(pixel, self.exposure)),
                        }
                    }
                }
                tally
            })
            .collect();
        let mut all = Tally::new();
        parts.iter().for_each(|part| all.add(part));
        all
    }

    fn predicted(&self, tally: &Tally) -> f64 {
        ((tally.error() + self.missed) / self.pixels()).sqrt()
    }

    /// Pixels beside one in which a second signature was found are refined, too, so that
    /// what is thinner than a pixel is followed along. What was found alone is counted as
    /// many times as it would have been missed.
    fn follow_contours(&mut self) {
        let mut beside = Vec::new();
        let mut missed = 0.0;
        for (index, tile) in self.tiles.iter().enumerate() {
            let around = Neighbours { tiles: &self.tiles, across: self.across, index };
            for pixel in &tile.refined {
                let k = usize::from(pixel.index);
                let is_new = tile.is_mixed.has(k) && !tile.is_followed.has(k);
                if !is_new && !pixel.is_odd {
                    continue;
                }
                let mut is_alone = true;
                for (other, k) in around.beside(k) {
                    is_alone &= !self.tiles[other].is_mixed.has(k);
                    if !self.tiles[other].is_refined.has(k) {
                        beside.push((other, k, pixel.contrast));
                    }
                }
                if pixel.is_odd && is_alone {
                    missed += pixel.missed();
                }
            }
        }
        for tile in &mut self.tiles {
            tile.is_followed = tile.is_mixed;
        }
        for (tile, k, contrast) in beside {
            let tile = &mut self.tiles[tile];
            if !tile.is_refined.has(k) {
                tile.refine(Pixel::new(k, 2, tile.colour[k], contrast));
            }
        }
        self.missed = missed;
    }

    /// Has all pixels refined that are near one that was found alone; whether there are any.
    fn look_around(&mut self) -> bool {
        let mut near = vec![false; self.tiles.len()];
        for index in 0..self.tiles.len() {
            if !self.tiles[index].refined.iter().any(|pixel| pixel.is_odd) {
                continue;
            }
            let side = TILE_SIDE as isize;
            let around = Neighbours { tiles: &self.tiles, across: self.across, index };
            for (x, y) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx * side, dy * side))) {
                if let Some((tile, _)) = around.find(x, y) {
                    near[tile] = true;
                }
            }
        }
        let mut is_new = false;
        for (tile, _) in self.tiles.iter_mut().zip(near).filter(|(_, near)| *near) {
            let contrast = tile.refined.iter().filter(|pixel| pixel.is_odd);
            let contrast = contrast.map(|pixel| pixel.contrast).fold(0.0, f32::max);
            for k in 0..tile.pixels() {
                if !tile.is_refined.has(k) {
                    is_new = true;
                    tile.refine(Pixel::new(k, 2, tile.colour[k], contrast));
                }
            }
        }
        is_new
    }

    /// How long it would take until the sum of squared errors is that.
    fn forecast(&self, job: &Job<'_>, tally: &Tally, target: f64) -> Option<Forecast> {
        let made_after = job.begun.elapsed();
        let to_come = plan(tally, target, MOST).map_or(0.0, |plan| plan.to_come);
        let more = made_after.as_secs_f64() * to_come / (self.samples as f64).max(1.0);
        let more = std::time::Duration::try_from_secs_f64(more).ok()?;
        Some(Forecast { all: made_after.checked_add(more)?, made_after })
    }
}

impl Tile {
    /// A number from 0 to 1 for each pixel, as if by chance.
    fn chance(&self, index: usize) -> f64 {
        let (x, y) = self.pixel(index);
        let bits = mixed(u64::from(x) << 32 | u64::from(y)) >> 11;
        bits as f64 / 9_007_199_254_740_992.0
    }

    /// Has smooth pixels refined from now on whose error matters.
    fn promote(&mut self, plan: &Plan) {
        for index in 0..self.pixels() {
            if self.is_refined.has(index) {
                continue;
            }
            let error = f64::from(self.error[index]);
            if plan.samples(class(0, error), 0, self.chance(index)) > 0 {
                self.refine(Pixel::new(index, 2, self.colour[index], self.error[index]));
            }
        }
    }
}

impl Pixel {
    /// The squared error of what was missed, for each pixel of which a single sample has
    /// found what few would: of 1 / p such pixels one is found, where p is the part of the pixel
    /// that shows it (Horvitz and Thompson, 1952).
    fn missed(&self) -> f64 {
        let n = f64::from(self.count());
        let part = (f64::from(self.same) + 0.5) / (n + 1.0);
        // The contrast is a quarter of the squared difference.
        part * (1.0 - part) * 4.0 * f64::from(self.contrast)
    }
}
