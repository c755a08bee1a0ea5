//! What a test has seen: figures to print, and what went wrong.

use super::case::{Case, Entry};
use super::figure::Crossing;
use super::judge::Asked;
use lancer_kernel::Hit;
use lancer_math::Ray;
use std::fmt;

/// Of so many failures each is told; the others are counted.
const TOLD: usize = 5;

#[derive(Debug, Default)]
pub(crate) struct Tally {
    rays: u64,
    leaving: u64,
    hits: u64,
    easy: u64,
    in_band: u64,
    easy_in_band: u64,
    relative: f64,
    relative_placed: f64,
    roundings: f64,
    roundings_placed: f64,
    widest: f64,
    point: f64,
    normal: f64,
    error: f64,
    /// Which case and ray it is that is being judged.
    pub(crate) at: String,
    told: Vec<String>,
    failures: u64,
}

fn raise(largest: &mut f64, value: f64) {
    *largest = largest.max(value);
}

impl Tally {
    pub(crate) fn count(&mut self, asked: &Asked, is_hit: bool) {
        self.rays += u64::from(asked.left.is_none());
        self.leaving += u64::from(asked.left.is_some());
        self.easy += u64::from(asked.is_easy);
        self.hits += u64::from(is_hit && asked.left.is_none());
    }

    /// The ray may be answered in two ways.
    pub(crate) fn in_band(&mut self, is_easy: bool) {
        self.in_band += 1;
        self.easy_in_band += u64::from(is_easy);
    }

    /// It was answered in another way than it exactly is.
    pub(crate) fn widen(&mut self, e: &Entry) {
        raise(&mut self.widest, e.crossing.margin);
    }

    pub(crate) fn distance(
        &mut self,
        case: &Case,
        e: &Entry,
        hit: &Hit,
        counts: bool,
        rounding: f64,
    ) {
        let off = ((e.crossing.t - hit.t.into()).abs().round() - e.crossing.slack).max(0.0);
        let is_placed = !case.frame(hit.item).is_identity;
        if counts {
            let relative = if is_placed { &mut self.relative_placed } else { &mut self.relative };
            raise(relative, off / hit.t);
        }
        let roundings = if is_placed { &mut self.roundings_placed } else { &mut self.roundings };
        raise(roundings, off * e.local_cosine * e.line.length / rounding);
    }

    pub(crate) fn contact(&mut self, point: f64, normal: f64, error: f64) {
        raise(&mut self.point, point);
        // Otherwise it is one of those that turn within the error of the point.
        raise(&mut self.normal, if normal <= 1e-9 { normal } else { 0.0 });
        raise(&mut self.error, error);
    }

    pub(crate) fn complain(&mut self, case: &Case, ray: &Ray, what: String) {
        self.failures += 1;
        if self.told.len() < TOLD {
            let exactly = case.crossings(ray).into_iter().map(|e| {
                let Crossing { t, part, is_there, margin, slack } = e.crossing;
                let (high, low) = (t.round(), (t - t.round().into()).round());
                let what = if is_there { "crosses" } else { "nearly crosses" };
                format!(
                    "{what} part {part} of item {} at {high:e} + {low:e}, |cos| {:e}, \
                     margin {margin:e}, slack {slack:e}",
                    e.item, e.cosine
                )
            });
            let exactly = exactly.collect::<Vec<_>>().join("\n    ");
            let items = (0..case.item_count()).map(|i| case.describe(i));
            let items = items.collect::<Vec<_>>().join("\n    ");
            self.told.push(format!("{}: {what}\n  {ray:?}\n    {exactly}\n    {items}", self.at));
        }
    }

    pub(crate) fn fail(
        &mut self,
        case: &Case,
        ray: &Ray,
        e: &Entry,
        what: &str,
        hit: Option<&Hit>,
    ) {
        let c = &e.crossing;
        let what = format!(
            "{what} ({hit:?}) the crossing of item {} at t = {:e} + {:e}, |cos| {:e}, margin {:e}",
            e.item,
            c.t.round(),
            (c.t - c.t.round().into()).round(),
            e.cosine,
            c.margin
        );
        self.complain(case, ray, what);
    }

    pub(crate) fn fail_at(
        &mut self,
        case: &Case,
        ray: &Ray,
        first: Option<&Entry>,
        what: &str,
        hit: &Hit,
    ) {
        match first {
            Some(e) => self.fail(case, ray, e, &format!("{what}: {hit:?}, but"), None),
            None => self.complain(case, ray, format!("{what}: {hit:?}")),
        }
    }

    /// Fails where something went wrong, or where too much was let pass.
    pub(crate) fn finish(&self) {
        println!("{self}");
        let told = self.told.join("\n\n");
        assert_eq!(self.failures, 0, "of {} rays failed\n\n{told}\n", self.rays + self.leaving);
        assert!(self.error < 1e-11, "points are told to be off by {:e} of the scene", self.error);
        let share = self.easy_in_band as f64 / self.easy as f64;
        assert!(share < 1e-3, "{share} of the easy rays may be answered in two ways");
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} rays, {} hits, {} leaving; in the band {}, {} of {} easy ones; \
             t off by {:.1e}, placed by {:.1e}; \
             {:.1} roundings, placed {:.1}; other answers up to margin {:.1e}; \
             point {:.2} of its error, normal off by {:.1e}, error {:.1e} of the scene",
            self.rays,
            self.hits,
            self.leaving,
            self.in_band,
            self.easy_in_band,
            self.easy,
            self.relative,
            self.relative_placed,
            self.roundings,
            self.roundings_placed,
            self.widest,
            self.point,
            self.normal,
            self.error
        )
    }
}
