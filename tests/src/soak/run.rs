//! All cases of a soak, on all threads; what is found does not depend on their
//! number.

use super::case::Case;
use super::class::Class;
use super::id::{Id, mix};
use super::judge::{Asked, is_close, judge};
use super::kind::Kind;
use super::oracle::Oracle;
use super::paths::{Asking, Paths};
use super::report::Report;
use super::tally::{Failure, Tally, Wrong, describe};
use fastrand::Rng;
use rayon::prelude::*;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// How many rays each scene is asked, but for the last one.
const RAYS: u64 = 1000;

/// The oracle is asked about one of so many rays that nothing is special about.
const SEEDED: u64 = 1000;

/// Asks the rays of those numbers, a thousand for each scene of that kind; those that leave
/// their hits come on top. What is wrong is told at once, too.
///
/// # Panics
/// Where the first one is not the first of a scene.
#[must_use]
pub fn soak(kind: Kind, seed: u64, rays: Range<u64>, tell: impl Fn(&Failure) + Sync) -> Report {
    assert!(rays.start.is_multiple_of(RAYS), "{} is within a scene", rays.start);
    let cases = (rays.start / RAYS..rays.end.div_ceil(RAYS)).into_par_iter();
    let tally = cases
        .map(|case| {
            let id = Id { kind, seed, case, ray: 0, is_left: false };
            let count = RAYS.min(rays.end - case * RAYS);
            let tally = catch_unwind(AssertUnwindSafe(|| Run::new(id).all(count)));
            let tally = tally.unwrap_or_else(|panic| {
                let text = panic.downcast_ref::<String>().map(String::as_str);
                let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
                let what = format!("panicked: {}", text.unwrap_or("without a word"));
                // Asking the last one again asks all.
                let id = Id { ray: count - 1, ..id };
                Tally::of_failure(Failure { id: Some(id), what })
            });
            tally.told.iter().for_each(&tell);
            tally
        })
        .reduce(Tally::default, Tally::and);
    Report::new(kind, tally)
}

/// Asks the scene of one ray again, and says what is to be said of that ray.
#[must_use]
pub fn replay(id: Id) -> String {
    let mut run = Run::new(id);
    let tally = run.all(id.ray + 1);
    let of_ray = tally.told.iter().filter(|failure| failure.id == Some(id));
    let failures: Vec<_> = of_ray.map(|failure| failure.what.as_str()).collect();
    let story = run.story.unwrap_or_else(|| "there is no such ray".to_owned());
    match failures.len() {
        0 => format!("{story}\nnothing is wrong with it"),
        _ => format!("{story}\n{}", failures.join("\n")),
    }
}

/// One scene.
struct Run {
    id: Id,
    case: Case,
    paths: Paths,
    oracle: Oracle,
    tally: Tally,
    /// What is to be told of the ray of `id`.
    story: Option<String>,
}

/// A ray on its way.
struct Flight {
    id: Id,
    class: Class,
    asked: Asked,
    rng: Rng,
}

impl Run {
    fn new(id: Id) -> Self {
        let case = Case::new(id.kind, id.case_seed(), id.case);
        let (paths, oracle) = (Paths::new(&case), Oracle::new(&case));
        Self { id, case, paths, oracle, tally: Tally::default(), story: None }
    }

    fn all(&mut self, count: u64) -> Tally {
        let made = (0..count).map(|ray| {
            let id = Id { ray, is_left: false, ..self.id };
            // Its own seed for each ray, whatever the ones before it have used.
            let mut rng = Rng::with_seed(id.ray_seed());
            let (ray, class) = self.case.ray(&mut rng, ray);
            Flight { id, class, asked: Asked { ray, left: None }, rng }
        });
        let made = made.collect();
        let leaving = self.judge(made);
        self.judge(leaving);
        std::mem::take(&mut self.tally)
    }

    /// Returned are the rays that leave the hits of these.
    fn judge(&mut self, flights: Vec<Flight>) -> Vec<Flight> {
        let asking = |flight: &Flight| Asking {
            ray: flight.asked.ray,
            outside: flight.asked.left.and_then(|left| left.outside()),
        };
        let asking: Vec<_> = flights.iter().map(asking).collect();
        let mut differ = Vec::new();
        let hits = self.paths.ask(&self.case, &asking, &mut differ);
        differ.sort_by_key(|differ| differ.ray);
        let mut differ = differ.into_iter().peekable();
        let mut leaving = Vec::new();
        for (i, (mut flight, hit)) in flights.into_iter().zip(hits).enumerate() {
            let (case, tally) = (&self.case, &mut self.tally);
            let ray = flight.asked.ray;
            tally.begin(flight.id, flight.class, hit.is_some());
            let before = tally.failures();
            let entries = case.crossings(&ray);
            while let Some(differs) = differ.next_if(|differs| differs.ray == i) {
                tally.complain(case, &ray, Wrong::Disagreement, differs.what);
            }
            let next = judge(case, &flight.asked, (hit, &entries), &mut flight.rng, tally);
            let failed = tally.failures() > before;
            let is_chosen = mix(flight.id.ray_seed()).is_multiple_of(SEEDED);
            if failed || is_chosen || is_close(&entries) {
                tally.judged();
                // Where there is a decision to judge, not what the ray passes by far.
                let all = failed || is_chosen;
                let items = (0..case.item_count()).filter(|&i| all || !case.is_clear_of(i, &ray));
                if let Some(what) = self.oracle.contradiction(case, &ray, &entries, items) {
                    tally.complain(case, &ray, Wrong::Overruled, what);
                }
            }
            if flight.id == self.id {
                let found = format!("{}: {hit:?}\n", flight.class.name());
                self.story = Some(found + &describe(case, &ray));
            }
            leaving.extend(next.map(|asked| {
                let id = Id { is_left: true, ..flight.id };
                Flight { id, class: Class::Leaving, asked, rng: flight.rng }
            }));
        }
        leaving
    }
}
