//! What a soak has seen, in words and tables.

use super::class::Class;
use super::figure::BAND;
use super::kind::Kind;
use super::tally::{Count, Tally};
use std::fmt::Write;

/// Points are known better than this, as a share of the size of the scene seen
/// from a ray: less so in groups that are stretched.
const COARSEST: f64 = 1e-9;

/// Of rays that were not made to be difficult, fewer may be answered in two ways.
const EASY_IN_BAND: f64 = 1e-3;

/// What a soak of one kind of shape has seen.
#[derive(Debug, Clone)]
pub struct Report {
    kind: Kind,
    tally: Tally,
}

impl Report {
    pub(crate) const fn new(kind: Kind, tally: Tally) -> Self {
        Self { kind, tally }
    }

    /// Together with what comes after it.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self { kind: self.kind, tally: self.tally.and(other.tally) }
    }

    /// How many answers were wrong.
    #[must_use]
    pub fn failures(&self) -> u64 {
        self.tally.total().failures()
    }

    /// All that is wrong, each with the id of a ray if it is that of a ray.
    #[must_use]
    pub fn problems(&self) -> Vec<String> {
        let told = self.tally.told.iter().map(|failure| match failure.id {
            Some(id) => format!("{id}: {}", failure.what),
            None => failure.what.clone(),
        });
        let mut problems: Vec<_> = told.collect();
        let total = self.tally.total();
        if total.failures() > 0 {
            problems.push(format!("{}: {} failures", self.kind.name(), total.failures()));
        }
        if total.error >= COARSEST {
            let error = total.error;
            problems.push(format!("points are told to be off by {error:e} of the scene"));
        }
        if total.widest > self.kind.widest() {
            let ulps = total.widest / f64::EPSILON;
            problems.push(format!("other answers are found up to {ulps:.1} ulp off"));
        }
        let easy = self.tally.counts().filter(|(class, _)| class.is_easy());
        let (rays, in_band) =
            easy.fold((0, 0), |(rays, n), (_, count)| (rays + count.rays, n + count.in_band));
        if in_band as f64 > EASY_IN_BAND * rays as f64 {
            problems.push(format!("{in_band} of {rays} easy rays may be answered in two ways"));
        }
        problems
    }

    /// How many rays were asked, those that left hits included.
    #[must_use]
    pub fn rays(&self) -> u64 {
        self.tally.total().rays
    }

    /// How many rays the oracle judged.
    #[must_use]
    pub fn judged(&self) -> u64 {
        self.tally.total().judged
    }

    /// The heads of the columns.
    #[must_use]
    pub fn head() -> String {
        let names = [
            "shape",
            "rays",
            "hits",
            "in the band",
            "misses",
            "false hits",
            "self-hits",
            "other",
            "disagreements",
            "judged by the oracle",
            "overruled",
            "distance (ulp)",
            "distance (bound)",
            "point (bound)",
            "widest (ulp)",
        ];
        let line = "|---".repeat(names.len());
        format!("| {} |\n{line}|\n", names.join(" | "))
    }

    /// A line for the whole, and below it one for each class of rays if wanted.
    #[must_use]
    pub fn rows(&self, by_class: bool) -> String {
        let mut rows = row(self.kind.name(), &self.tally.total());
        if by_class {
            for (class, count) in self.tally.counts().filter(|(_, count)| count.rays > 0) {
                rows += &row(&format!("{}, {}", self.kind.name(), class.name()), count);
            }
        }
        rows
    }

    /// The same for each class of rays, of several reports together.
    #[must_use]
    pub fn rows_of_classes(reports: &[Self]) -> String {
        let all = reports.iter().map(|report| report.tally.clone());
        let all = all.fold(Tally::default(), Tally::and);
        let rows = all.counts().map(|(class, count): (Class, _)| row(class.name(), count));
        rows.collect::<String>() + &row("all", &all.total())
    }
}

fn row(name: &str, c: &Count) -> String {
    let mut row = format!("| {name} |");
    let whole = [
        c.rays,
        c.hits,
        c.in_band,
        c.misses,
        c.false_hits,
        c.self_hits,
        c.other,
        c.disagreements,
        c.judged,
        c.overruled,
    ];
    for n in whole {
        _ = write!(row, " {n} |");
    }
    let widest = c.widest / f64::EPSILON;
    _ = writeln!(row, " {:.2} | {:.2} | {:.2} | {widest:.2} |", c.ulps, c.of_bound, c.point);
    row
}

/// The width of the band in which a ray may be answered in two ways, in units in the last
/// place of the size of the scene seen from it.
#[must_use]
pub fn band_in_ulps() -> f64 {
    BAND / f64::EPSILON
}
