//! What many pictures say together.

use crate::bench::page::Table;
use std::fmt;

/// How many of how many.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Share {
    pub(super) count: u64,
    pub(super) of: u64,
}

impl Share {
    pub(super) fn add(&mut self, is_one: bool) {
        self.count += u64::from(is_one);
        self.of += 1;
    }

    fn of_all(answers: impl Iterator<Item = bool>) -> Self {
        let mut share = Self::default();
        answers.for_each(|answer| share.add(answer));
        share
    }

    fn pooled(shares: impl Iterator<Item = Self>) -> Self {
        shares.fold(Self::default(), |sum, share| Self {
            count: sum.count + share.count,
            of: sum.of + share.of,
        })
    }

    fn percent(self) -> f64 {
        100.0 * self.count as f64 / self.of as f64
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.of {
            0 => write!(f, "none"),
            of => write!(f, "{} of {of} ({:.1} %)", self.count, self.percent()),
        }
    }
}

/// A picture, and how good it is.
#[derive(Debug, Clone)]
pub(super) struct Run {
    pub(super) scene: String,
    /// The error that was asked for.
    pub(super) asked: f64,
    /// What the program says that it is.
    pub(super) predicted: f64,
    /// What it is.
    pub(super) truth: f64,
    /// What the reference is off by.
    pub(super) reference: f64,
    pub(super) samples_a_pixel: f64,
    /// Whether it took more samples than the fewest possible.
    pub(super) needed_more: bool,
    /// Pixels that took more than the fewest, and whose error is within their interval.
    pub(super) refined: Share,
    /// The same of pixels that are not smooth by the reference.
    pub(super) rough: Share,
    pub(super) seconds: f64,
    /// What it was foretold to take, in seconds.
    pub(super) forecast: Option<f64>,
}

/// A picture is not judged by a reference that is off by more than this part of the error
/// asked for: what is found would be the reference's.
const OF_ASKED: f64 = 0.3;

impl Run {
    fn is_judged(&self) -> bool {
        self.reference <= OF_ASKED * self.asked
    }
}

impl fmt::Display for Run {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "  asked {}: true / asked {:.2}, predicted / asked {:.2}, {:.1} samples a pixel, intervals {:.1} % \
             and {:.1} %, {:.0} ms{}",
            self.asked,
            self.truth / self.asked,
            self.predicted / self.asked,
            self.samples_a_pixel,
            self.refined.percent(),
            self.rough.percent(),
            1e3 * self.seconds,
            match self.forecast {
                Some(forecast) => format!(", foretold {:.0}", 1e3 * forecast),
                None => String::new(),
            },
        )
    }
}

/// Tables of all runs: what was promised, and each scene by level.
pub(super) fn report(runs: &[Run], levels: &[f64]) -> String {
    format!("{}\n{}", promises(runs), by_scene(runs, levels))
}

fn promises(all: &[Run]) -> Table {
    let runs: Vec<&Run> = all.iter().filter(|run| run.is_judged()).collect();
    let mut table = Table::new(&["of the pictures that are judged", "found", "wanted"]);
    let mut row = |what: &str, share: Share, wanted: &str| {
        table.row(vec![what.to_owned(), share.to_string(), wanted.to_owned()]);
    };
    row(
        "reference off by at most 0.3 of what was asked for: these are judged",
        Share::of_all(all.iter().map(Run::is_judged)),
        "",
    );
    row(
        "true error at most the one asked for",
        Share::of_all(runs.iter().map(|run| run.truth <= run.asked)),
        "95 %",
    );
    row(
        "true error at least half of it, where more than the fewest samples were needed",
        Share::of_all(
            runs.iter().filter(|r| r.needed_more).map(|run| run.truth >= 0.5 * run.asked),
        ),
        "80 %",
    );
    row(
        "pixels with more than the fewest samples: error within the 95 % interval",
        Share::pooled(runs.iter().map(|run| run.refined)),
        "93 to 98 %",
    );
    row(
        "pixels in which the reference finds differences of 1/255: the same",
        Share::pooled(runs.iter().map(|run| run.rough)),
        "",
    );
    row(
        "time within 25 % of its forecast, where there was one",
        Share::of_all(all.iter().filter_map(|run| {
            let ratio = run.seconds / run.forecast?;
            Some((0.75..=1.25).contains(&ratio))
        })),
        "80 %",
    );
    row(
        "reference off by at most a tenth of the true error",
        Share::of_all(runs.iter().map(|run| run.reference <= 0.1 * run.truth)),
        "",
    );
    table
}

/// A row for each scene: what is true over what was asked for, and the rest for all levels
/// together.
fn by_scene(runs: &[Run], levels: &[f64]) -> Table {
    let mut head = vec!["scene: true / asked".to_owned()];
    head.extend(levels.iter().map(|level| format!("at {level}")));
    head.extend(
        ["predicted / true", "within intervals, %", "reference off by", "time / forecast"]
            .map(str::to_owned),
    );
    let head: Vec<_> = head.iter().map(String::as_str).collect();
    let mut table = Table::new(&head);
    let mut names: Vec<_> = runs.iter().map(|run| run.scene.as_str()).collect();
    names.dedup();
    for name in names {
        let own: Vec<_> = runs.iter().filter(|run| run.scene == name).collect();
        let mut row = vec![name.to_owned()];
        row.extend(levels.iter().map(|level| {
            let run = own.iter().find(|run| run.asked == *level);
            run.map_or_else(String::new, |run| {
                // Those that cannot be worse are not to be blamed for being better.
                let mark = match run.is_judged() {
                    false => "~",
                    true if run.needed_more => "",
                    true => "*",
                };
                format!("{:.2}{mark}", run.truth / run.asked)
            })
        }));
        let judged = || own.iter().filter(|run| run.is_judged());
        row.push(range(judged().map(|run| run.predicted / run.truth)));
        let within = Share::pooled(judged().map(|run| run.refined));
        row.push(if within.of == 0 { "-".to_owned() } else { format!("{:.1}", within.percent()) });
        row.push(own.first().map_or_else(String::new, |run| format!("{:.1e}", run.reference)));
        row.push(range(own.iter().filter_map(|run| Some(run.seconds / run.forecast?))));
        table.row(row);
    }
    table
}

/// The least and the most of them.
fn range(numbers: impl Iterator<Item = f64>) -> String {
    let (least, most) =
        numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), n| (l.min(n), m.max(n)));
    if least <= most { format!("{least:.2} to {most:.2}") } else { "-".to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(scene: &str, asked: f64, truth: f64, needed_more: bool) -> Run {
        Run {
            scene: scene.to_owned(),
            asked,
            predicted: asked,
            truth,
            reference: 0.0001,
            samples_a_pixel: 2.5,
            needed_more,
            refined: Share { count: 95, of: 100 },
            rough: Share { count: 9, of: 10 },
            seconds: 0.2,
            forecast: needed_more.then_some(0.25),
        }
    }

    #[test]
    fn promises_are_counted() {
        let runs = [
            run("a.xml", 0.004, 0.0038, true),
            run("a.xml", 0.002, 0.0021, true),
            run("b.xml", 0.004, 0.0005, false),
            run("b.xml", 0.002, 0.0005, true),
            // Not judged.
            Run { reference: 0.002, ..run("c.xml", 0.004, 0.008, true) },
        ];
        let text = report(&runs, &[0.004, 0.002]);
        for row in [
            " 4 of 5 (80.0 %) |",
            "| true error at most the one asked for ",
            " 3 of 4 (75.0 %) |",
            " 2 of 3 (66.7 %) |",
            " 380 of 400 (95.0 %) |",
            " 36 of 40 (90.0 %) |",
            " 4 of 4 (100.0 %) |",
        ] {
            assert!(text.contains(row), "{row} is not in\n{text}");
        }
        let rows: Vec<_> = text.lines().filter(|line| line.contains(".xml")).collect();
        let cells = |row: &str| row.split('|').map(|c| c.trim().to_owned()).collect::<Vec<_>>();
        assert_eq!(
            cells(rows[0])[1..8],
            ["a.xml", "0.95", "1.05", "0.95 to 1.05", "95.0", "1.0e-4", "0.80 to 0.80"]
        );
        assert_eq!(cells(rows[1])[2..4], ["0.12*", "0.25"]);
        assert_eq!(cells(rows[2])[2..6], ["2.00~", "", "-", "-"]);
    }
}
