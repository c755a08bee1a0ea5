//! What a test has seen: figures to print, and what went wrong.

use super::case::{Case, Entry};
use super::class::Class;
use super::figure::Crossing;
use super::id::Id;
use lancer_kernel::Hit;
use lancer_math::Ray;

/// Of so many failures each is told; the others are counted.
const TOLD: usize = 5;

/// What is counted of the rays of one class.
#[derive(Debug, Default, Clone)]
pub(crate) struct Count {
    pub(crate) rays: u64,
    pub(crate) hits: u64,
    pub(crate) in_band: u64,
    pub(crate) misses: u64,
    pub(crate) false_hits: u64,
    pub(crate) self_hits: u64,
    /// Points, normals, inconsistent answers.
    pub(crate) other: u64,
    pub(crate) disagreements: u64,
    pub(crate) judged: u64,
    pub(crate) overruled: u64,
    /// The largest error of the distance where |cos| is at least 0.1, in units in the
    /// last place of the lengths along the ray.
    pub(crate) ulps: f64,
    /// The largest error of any distance, in units of its bound.
    pub(crate) of_bound: f64,
    /// The largest distance of a point from its surface, in units of the bound that comes
    /// with it.
    pub(crate) point: f64,
    /// The largest share of the size of the scene seen from a ray by which one would have
    /// had to be moved aside to be answered rightly.
    pub(crate) widest: f64,
    /// The largest bound that came with a point, as a share of that size.
    pub(crate) error: f64,
    /// The largest error of a normal.
    pub(crate) normal: f64,
}

/// What went wrong.
#[derive(Debug, Clone)]
pub struct Failure {
    /// The ray with which it did, if with one.
    pub id: Option<Id>,
    /// In which way, and all about the ray and what it exactly meets.
    pub what: String,
}

/// What a soak has seen: a count for each class of rays.
#[derive(Debug, Default, Clone)]
pub(crate) struct Tally {
    counts: [Count; Class::ALL.len()],
    /// Which ray it is that is being judged.
    at: Option<Id>,
    class: usize,
    pub(crate) told: Vec<Failure>,
}

/// In which way an answer is wrong.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Wrong {
    Miss,
    False,
    SelfHit,
    Other,
    Disagreement,
    Overruled,
}

fn raise(largest: &mut f64, value: f64) {
    *largest = largest.max(value);
}

impl Count {
    pub(crate) const fn failures(&self) -> u64 {
        let wrong = self.misses + self.false_hits + self.self_hits + self.other;
        wrong + self.disagreements + self.overruled
    }

    fn add(&mut self, other: &Self) {
        for (sum, more) in [
            (&mut self.rays, other.rays),
            (&mut self.hits, other.hits),
            (&mut self.in_band, other.in_band),
            (&mut self.misses, other.misses),
            (&mut self.false_hits, other.false_hits),
            (&mut self.self_hits, other.self_hits),
            (&mut self.other, other.other),
            (&mut self.disagreements, other.disagreements),
            (&mut self.judged, other.judged),
            (&mut self.overruled, other.overruled),
        ] {
            *sum += more;
        }
        for (largest, value) in [
            (&mut self.ulps, other.ulps),
            (&mut self.of_bound, other.of_bound),
            (&mut self.point, other.point),
            (&mut self.widest, other.widest),
            (&mut self.error, other.error),
            (&mut self.normal, other.normal),
        ] {
            raise(largest, value);
        }
    }
}

impl Tally {
    /// Begins with a ray.
    pub(crate) fn begin(&mut self, id: Id, class: Class, is_hit: bool) {
        self.at = Some(id);
        self.class = class as usize;
        let count = self.count();
        count.rays += 1;
        count.hits += u64::from(is_hit);
    }

    /// Where there is nothing but that.
    pub(crate) fn of_failure(failure: Failure) -> Self {
        let mut tally = Self { told: vec![failure], ..Self::default() };
        tally.count().other = 1;
        tally
    }

    /// So far, of the class of the last ray.
    pub(crate) fn failures(&self) -> u64 {
        self.counts[self.class].failures()
    }

    fn count(&mut self) -> &mut Count {
        &mut self.counts[self.class]
    }

    pub(crate) fn counts(&self) -> impl Iterator<Item = (Class, &Count)> {
        Class::ALL.into_iter().zip(&self.counts)
    }

    pub(crate) fn total(&self) -> Count {
        self.counts.iter().fold(Count::default(), |mut sum, count| {
            sum.add(count);
            sum
        })
    }

    /// That of the rays that come after these.
    #[must_use]
    pub(crate) fn and(mut self, other: Self) -> Self {
        for (sum, more) in self.counts.iter_mut().zip(&other.counts) {
            sum.add(more);
        }
        let room = TOLD.saturating_sub(self.told.len());
        self.told.extend(other.told.into_iter().take(room));
        self
    }

    /// The ray may be answered in two ways.
    pub(crate) fn in_band(&mut self) {
        self.count().in_band += 1;
    }

    /// It was held against the oracle.
    pub(crate) fn judged(&mut self) {
        self.count().judged += 1;
    }

    /// It was answered in another way than it exactly is.
    pub(crate) fn widen(&mut self, e: &Entry) {
        raise(&mut self.count().widest, e.crossing.margin);
    }

    pub(crate) fn distance(&mut self, ulps: f64, of_bound: f64) {
        let count = self.count();
        raise(&mut count.ulps, ulps);
        raise(&mut count.of_bound, of_bound);
    }

    pub(crate) fn contact(&mut self, point: f64, normal: f64, error: f64) {
        let count = self.count();
        raise(&mut count.point, point);
        // Otherwise it is one of those that turn within the error of the point.
        raise(&mut count.normal, if normal <= 1e-9 { normal } else { 0.0 });
        raise(&mut count.error, error);
    }

    pub(crate) fn complain(&mut self, case: &Case, ray: &Ray, wrong: Wrong, what: String) {
        let count = self.count();
        *match wrong {
            Wrong::Miss => &mut count.misses,
            Wrong::False => &mut count.false_hits,
            Wrong::SelfHit => &mut count.self_hits,
            Wrong::Other => &mut count.other,
            Wrong::Disagreement => &mut count.disagreements,
            Wrong::Overruled => &mut count.overruled,
        } += 1;
        if self.told.len() < TOLD {
            let what = format!("{what}\n{}", describe(case, ray));
            self.told.push(Failure { id: self.at, what });
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
        self.complain(case, ray, Wrong::Miss, what);
    }
}

/// A ray, what it exactly meets, and the shapes.
pub(crate) fn describe(case: &Case, ray: &Ray) -> String {
    let exactly = case.crossings(ray).into_iter().map(|e| {
        let Crossing { t, part, is_there, margin, slack } = e.crossing;
        let (high, low) = (t.round(), (t - t.round().into()).round());
        let what = if is_there { "crosses" } else { "nearly crosses" };
        format!(
            "\n    {what} part {part} of item {} at {high:e} + {low:e}, |cos| {:e}, \
             margin {margin:e}, slack {slack:e}",
            e.item, e.cosine
        )
    });
    let exactly: String = exactly.collect();
    let items = (0..case.item_count()).map(|i| format!("\n    {i}: {}", case.describe(i)));
    let items: String = items.collect();
    format!("  {ray:?}{exactly}{items}")
}
