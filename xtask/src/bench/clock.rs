//! Times of repeated runs, and what is said of them.

use crate::Failure;
use std::time::Instant;

/// Times of runs of the same work, in seconds, in the order of the runs.
#[derive(Debug, Clone, Default)]
pub(crate) struct Samples(Vec<f64>);

impl Samples {
    pub(crate) fn push(&mut self, seconds: f64) {
        self.0.push(seconds);
    }

    pub(crate) fn median(&self) -> f64 {
        median(self.0.clone())
    }

    /// The least, which other work on the machine disturbs least.
    pub(crate) fn least(&self) -> f64 {
        self.0.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The median of how many times longer this took than something else, run
    /// by run: both were slowed down alike by what else the machine did.
    pub(crate) fn times(&self, other: &Self) -> f64 {
        median(self.0.iter().zip(&other.0).map(|(this, other)| this / other).collect())
    }

    /// The median in milliseconds.
    pub(crate) fn milliseconds(&self) -> String {
        number(self.median() * 1e3)
    }

    /// How many of `count` things are done in a second, in millions.
    pub(crate) fn millions(&self, count: usize) -> String {
        number(count as f64 / self.median() / 1e6)
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => values[n / 2],
        n => f64::midpoint(values[n / 2 - 1], values[n / 2]),
    }
}

/// How long `work` takes, in seconds, and what comes of it.
pub(crate) fn seconds<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let begun = Instant::now();
    let made = std::hint::black_box(work());
    (begun.elapsed().as_secs_f64(), made)
}

/// Runs all of `works` in turn, `runs` times, after a round that does not
/// count; `run` says how long one took, in seconds.
pub(crate) fn in_turn<W>(
    runs: usize,
    works: &[W],
    mut run: impl FnMut(&W) -> Result<f64, Failure>,
) -> Result<Vec<Samples>, Failure> {
    let mut samples = vec![Samples::default(); works.len()];
    for round in 0..=runs {
        for (work, samples) in works.iter().zip(&mut samples) {
            let seconds = run(work)?;
            if round > 0 {
                samples.push(seconds);
            }
        }
    }
    Ok(samples)
}

/// Three digits that matter, or all before the point.
pub(crate) fn number(value: f64) -> String {
    match value.abs() {
        size if size < 10.0 => format!("{value:.2}"),
        size if size < 100.0 => format!("{value:.1}"),
        _ => format!("{value:.0}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_are_in_the_middle() {
        assert_eq!(Samples(vec![3.0, 1.0, 2.0]).median(), 2.0);
        assert_eq!(Samples(vec![4.0, 1.0, 2.0, 3.0]).median(), 2.5);
        assert!(Samples::default().median().is_nan());
    }

    #[test]
    fn ratios_are_of_pairs() {
        let (a, b) = (Samples(vec![2.0, 40.0, 6.0]), Samples(vec![1.0, 10.0, 2.0]));
        assert_eq!(a.times(&b), 3.0);
    }

    #[test]
    fn the_first_round_does_not_count() {
        let mut calls = 0.0;
        let samples = in_turn(2, &[(), ()], |()| {
            calls += 1.0;
            Ok(calls)
        });
        let samples = samples.expect("nothing fails");
        assert_eq!(samples.iter().map(Samples::median).collect::<Vec<_>>(), [4.0, 5.0]);
    }
}
