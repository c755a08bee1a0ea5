//! Round after round, until the end.

use super::control::Control;
use super::finish::{Accuracy, Forecast};
use super::first::Where;
use super::plan::{Class, POWER, Plan, SMOOTH_SAMPLES, Tally, class, plan};
use super::refine::{Found, Spread, refine};
use super::smooth::{Analysis, Neighbours, analyse};
use super::table::{Expected, Table};
use super::tile::{Pixel, Tile};
use super::{Sampling, Strategy, Why};
use crate::numbers::mixed;
use crate::{Progress, RayCounts, Sampler, TILE_SIDE};
use lancer_film::{Film, LightMeter, Quality, Window, exposure_factor};
use lancer_kernel::lanes::Width;
use rayon::prelude::*;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// How many tiles a piece of work has: neighbours, whose samples are seen together.
const PIECE: usize = 4;
/// In how many parts sums are made, the same for any number of threads.
const PARTS: usize = 8;
/// Where no error is asked for, this is come to first, and from there on always half of it, so
/// that what there is at any time is about the best for its samples.
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
    /// The exposure in stops. Where it is not given, it is that which a [`LightMeter`] finds
    /// for the first samples, which are one at the centre of each pixel then, and all.
    pub(crate) stops: Option<f64>,
    pub(crate) lanes: Width,
    pub(crate) begun: Instant,
    pub(crate) cancel: Option<&'a AtomicBool>,
    /// Is told how many samples there are and how many there may be in the end.
    pub(crate) progress: Option<&'a Progress<'a>>,
    /// Is told how long it may take, once.
    pub(crate) forecast: Option<&'a (dyn Fn(Forecast) + Sync)>,
}

/// The picture in tiles, row by row.
pub(crate) struct Sampled {
    picture: Picture,
    pub(crate) accuracy: Accuracy,
    pub(crate) counts: RayCounts,
    pub(crate) stops: f64,
}

impl Sampled {
    /// Writes the values, and what is known of them if that is wanted, on all threads.
    pub(crate) fn put(&self, film: &mut Film, quality: Option<&mut Quality>) {
        let Picture { tiles, across, table, .. } = &self.picture;
        let width = film.window().width;
        let rows: Vec<_> = film.strips_mut::<ROWS>(width).zip(tiles.chunks(*across)).collect();
        rows.into_par_iter().for_each(|(mut strip, tiles)| {
            tiles.iter().for_each(|tile| strip.put(tile.window, &tile.values()));
        });
        if let Some(quality) = quality {
            let (expected, largest) = (table.expected(), table.largest());
            let rows: Vec<_> =
                quality.strips_mut::<ROWS>(width).zip(tiles.chunks(*across)).collect();
            rows.into_par_iter().for_each(|(mut strip, tiles)| {
                for tile in tiles {
                    strip.put(tile.window, &tile.quality(&expected, &largest));
                }
            });
        }
    }
}

/// The height of tiles.
const ROWS: usize = TILE_SIDE as usize;

/// All that is known so far.
pub(super) struct Picture {
    pub(super) tiles: Vec<Tile>,
    /// How many tiles there are in a row.
    pub(super) across: usize,
    table: Table,
    stops: f64,
    exposure: f64,
    samples: u64,
    counts: RayCounts,
    /// The squared error of what may have been missed between samples.
    pub(super) missed: f64,
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
    let unseen = picture.tiles.iter().map(Tile::unseen).sum();
    let accuracy = Accuracy {
        predicted: picture.predicted(),
        samples: picture.samples,
        unseen,
        stopped: stopped.unwrap_or(why),
        at,
        forecast,
        exposure: picture.exposure,
    };
    let (counts, stops) = (picture.counts, picture.stops);
    Sampled { picture, accuracy, counts, stops }
}

impl Picture {
    fn new(job: &Job<'_>) -> Self {
        // Made by all threads, since memory takes its time to be had.
        let windows: Vec<_> = job.window.strips(TILE_SIDE, TILE_SIDE).collect();
        let tiles = windows.into_par_iter().map(Tile::new).collect();
        let stops = job.stops.unwrap_or(0.0);
        Self {
            tiles,
            across: job.window.width.div_ceil(TILE_SIDE) as usize,
            table: Table::default(),
            stops,
            exposure: exposure_factor(stops),
            samples: 0,
            counts: RayCounts::default(),
            missed: 0.0,
        }
    }

    fn pixels(&self) -> f64 {
        self.tiles.iter().map(|tile| tile.pixels() as f64).sum()
    }

    /// Has `work` done to all tiles in one round.
    fn round(&mut self, control: &Control<'_>, work: impl Fn(&mut Found, &mut [Tile]) + Sync) {
        let found = control.round(self.tiles.chunks_mut(PIECE), work, Found::default);
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

    /// Looks at the first samples of tiles that were reached.
    fn look(&self, lanes: Width) -> Vec<Option<Analysis>> {
        let look = |index: usize| {
            let around = Neighbours { tiles: &self.tiles, across: self.across, index };
            self.tiles[index].is_seen.then(|| analyse(&around, self.exposure, lanes))
        };
        (0..self.tiles.len()).into_par_iter().map(look).collect()
    }

    /// One sample at the centre of each pixel.
    fn centres(&mut self, job: &Job<'_>, control: &Control<'_>) -> Why {
        self.first_samples(job, control, Where::Centre);
        if job.stops.is_none() {
            let mut meter = LightMeter::new(job.window.pixels());
            self.tiles.iter().for_each(|tile| meter.see(&tile.colour[..tile.pixels()]));
            self.stops = meter.stops();
            self.exposure = exposure_factor(self.stops);
        }
        // The samples stay the values, and are not put to where they are already.
        let found = self.look(job.lanes);
        self.tiles.par_iter_mut().zip(found).for_each(|(tile, found)| {
            if let Some(found) = found {
                tile.error = found.error;
            }
        });
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
        let most = samples.unwrap_or(Sampling::MOST);
        // What is drawn afresh each time is drawn once, unless an error is asked for.
        let mut wanted = if asked.is_none() && !spread.goes_on() { most } else { 2.min(most) };
        loop {
            self.refine_to(job, control, &spread, |_, _| wanted);
            if let Some(progress) = job.progress {
                progress(self.samples, self.samples);
            }
            if let (_, Some(why)) = control.state() {
                return why;
            }
            if asked.is_some_and(|asked| self.predicted() <= asked * MARGIN) {
                return Why::Error;
            }
            if wanted >= most {
                return if samples.is_some() { Why::Samples } else { Why::MostSamples };
            }
            wanted = wanted.saturating_mul(2).min(most);
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
        let found = self.look(job.lanes);
        self.tiles.par_iter_mut().zip(found).for_each(|(tile, found)| {
            if let Some(found) = found {
                tile.take(found);
            }
        });
        self.mark_thin_ones();
        let spread = Spread { strategy: Strategy::Edges, seed: job.sampling.seed };
        let pixels = self.pixels();
        let allowed = |target: f64| target * MARGIN * target * MARGIN * pixels;
        let mut target = asked.unwrap_or(FIRST_TARGET);
        let mut forecast = None;
        loop {
            // Contours to their ends; and each pixel has a sample in either half before anything
            // is decided.
            loop {
                let is_longer = self.follow_contours();
                self.refine_to(job, control, &spread, |tile, k| tile.standing[k].count.max(2));
                if self.lead_thin_ones() {
                    self.refine_to(job, control, &spread, Tile::least);
                }
                if !is_longer || control.state().1.is_some() {
                    break;
                }
            }
            if let (_, Some(why)) = control.state() {
                return (why, forecast);
            }
            let expected = self.table.expected();
            let tally = self.tally(&expected);
            if tally.error() + self.missed <= allowed(target) {
                if asked.is_some() {
                    return (Why::Error, forecast);
                }
                target /= 2.0;
                if target == 0.0 {
                    return (Why::MostSamples, forecast);
                }
                continue;
            }
            if self.missed > MISSED * allowed(target) && self.look_around() {
                continue;
            }
            let left = (allowed(target) - self.missed).max(0.0);
            let power = self.table.power(POWER);
            let Some(plan) = plan(&tally, left, power, Sampling::MOST) else {
                return (Why::MostSamples, forecast);
            };
            if let Some(progress) = job.progress {
                progress(self.samples, self.samples + plan.to_come as u64);
            }
            if asked.is_some() && forecast.is_none() && self.is_under_way(plan.to_come) {
                forecast = self.foretell(job, plan.to_come);
            }
            let before = self.samples;
            self.carry_out(job, control, (&spread, &expected), &plan);
            if self.samples == before && control.state().1.is_none() {
                // A part of a few pixels may be none of them.
                self.carry_out(job, control, (&spread, &expected), &plan.of_all());
            }
        }
    }

    /// Gives each refined pixel the number of samples that `wanted` says for it, if any needs
    /// more.
    fn refine_to(
        &mut self,
        job: &Job<'_>,
        control: &Control<'_>,
        spread: &Spread,
        wanted: impl Fn(&Tile, usize) -> u32 + Sync,
    ) {
        let needs =
            |tile: &Tile| (0..tile.refined.len()).any(|k| wanted(tile, k) > tile.standing[k].count);
        if self.tiles.par_iter().any(needs) {
            let (sees, exposure) = ((job.sampler, spread), self.exposure);
            self.round(control, |found, tiles| refine(tiles, sees, exposure, &wanted, found));
        }
    }

    /// Refines what the plan says.
    fn carry_out(
        &mut self,
        job: &Job<'_>,
        control: &Control<'_>,
        (spread, expected): (&Spread, &Expected),
        plan: &Plan,
    ) {
        self.tiles.par_iter_mut().for_each(|tile| tile.promote(plan));
        self.refine_to(job, control, spread, |tile, k| {
            let standing = tile.standing[k];
            if standing.count == 0 {
                return SMOOTH_SAMPLES;
            }
            let class = class(standing.count, expected.error(standing.places));
            plan.samples(class, standing.count, || tile.chance(usize::from(tile.refined[k].index)))
        });
    }

    /// Adds up what is expected of all pixels.
    fn tally(&mut self, expected: &Expected) -> Tally {
        let part = self.tiles.len().div_ceil(PARTS).max(1);
        let parts: Vec<Tally> = self
            .tiles
            .par_chunks_mut(part)
            .map(|tiles| {
                let mut tally = Tally::new();
                tiles.iter_mut().for_each(|tile| tile.tally(expected, &mut tally));
                tally
            })
            .collect();
        let mut all = Tally::new();
        parts.iter().for_each(|part| all.add(part));
        all
    }

    fn predicted(&mut self) -> f64 {
        let expected = self.table.expected();
        let tally = self.tally(&expected);
        ((tally.error() + self.missed) / self.pixels()).sqrt()
    }

    /// Whether so much has been done that what is to come can be foretold: estimates become better
    /// with what they are made of.
    fn is_under_way(&self, to_come: f64) -> bool {
        const PART: f64 = 1.0 / 3.0;
        self.samples as f64 > PART * to_come
    }

    /// How long it would take with so many samples more.
    fn foretell(&self, job: &Job<'_>, to_come: f64) -> Option<Forecast> {
        let made_after = job.begun.elapsed();
        let more = made_after.as_secs_f64() * to_come / (self.samples as f64).max(1.0);
        let more = Duration::try_from_secs_f64(more).ok()?;
        let forecast = Forecast { all: made_after.checked_add(more)?, made_after };
        if let Some(tell) = job.forecast {
            tell(forecast);
        }
        Some(forecast)
    }
}

impl Tile {
    /// How many pixels have no sample.
    fn unseen(&self) -> u64 {
        if self.is_seen {
            return 0;
        }
        let seen = self.standing.iter().filter(|standing| standing.count > 0).count();
        (self.pixels() - seen) as u64
    }

    /// Takes in what was found by looking at first samples.
    fn take(&mut self, found: Analysis) {
        (self.colour, self.error) = (found.colour, found.error);
        self.refined.reserve(found.edges.len());
        self.standing.reserve(found.edges.len());
        for mut edge in found.edges {
            if !edge.is_odd {
                // Its first sample had no part in the decision.
                let signature = self.signature[usize::from(edge.index)];
                let seen = crate::Seen { radiance: edge.shift, signature: u64::from(signature) };
                edge.add(0, &[seen], signature);
            }
            self.refine(edge);
        }
    }

    fn tally(&mut self, expected: &Expected, tally: &mut Tally) {
        if self.smooth.is_none() {
            let mut smooth: Vec<(usize, Class)> = Vec::new();
            for (index, error) in self.error[..self.pixels()].iter().enumerate() {
                if self.is_refined.has(index) {
                    continue;
                }
                let error = f64::from(*error);
                let class = class(0, error);
                match smooth.iter_mut().find(|(other, _)| *other == class) {
                    Some((_, known)) => known.take(error),
                    None => smooth.push((class, Class { pixels: 1, error })),
                }
            }
            self.smooth = Some(smooth);
        }
        self.smooth.iter().flatten().for_each(|(class, of)| tally.add_to(*class, of));
        for (pixel, standing) in self.refined.iter().zip(&self.standing) {
            if standing.count < 2 {
                tally.take(0, f64::from(self.error[usize::from(pixel.index)]));
            } else {
                tally.take(standing.count, expected.error(standing.places));
            }
        }
    }

    /// A number from 0 to 1 for each pixel, as if by chance.
    fn chance(&self, index: usize) -> f64 {
        let (x, y) = self.pixel(index);
        let bits = mixed(u64::from(x) << 32 | u64::from(y)) >> 11;
        bits as f64 / 9_007_199_254_740_992.0
    }

    /// Has smooth pixels refined from now on whose error matters.
    fn promote(&mut self, plan: &Plan) {
        if !plan.promotes() {
            return;
        }
        for index in 0..self.pixels() {
            if self.is_refined.has(index) {
                continue;
            }
            let class = class(0, f64::from(self.error[index]));
            if plan.samples(class, 0, || self.chance(index)) > 0 {
                self.refine(Pixel::new(index, 2, self.colour[index], self.error[index]));
            }
        }
    }
}
