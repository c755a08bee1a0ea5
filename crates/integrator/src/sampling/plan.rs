//! Which pixels to refine next.

use super::table::exponent;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// By which power of the number of samples the squared error falls, about, as long as that is not
/// known: along an edge through evenly spread samples by 1.5, where they are independent by 1.
pub(super) const POWER: f64 = 1.35;

/// Pixels with about the same expected error and the same number of samples.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Class {
    pub(super) pixels: u64,
    /// The sum of their expected squared errors.
    pub(super) error: f64,
}

impl Class {
    pub(super) fn take(&mut self, error: f64) {
        self.pixels += 1;
        self.error += error;
    }
}

/// Pixels by class: of smooth ones, and of refined ones by the number of samples.
pub(super) struct Tally {
    classes: Vec<Class>,
}

/// Powers of 2 of the number of samples, and what has none: smooth pixels first.
const LEVELS: usize = super::table::LEVELS + 1;
/// Squared errors are told apart by factors of the square root of 2, down to 2^-40.
const SIZES: usize = 82;

/// Those bits of a double that are its fraction.
const FRACTION: u64 = (1 << 52) - 1;

/// How many samples a smooth pixel gets that is refined.
pub(super) const SMOOTH_SAMPLES: u32 = 8;
/// By how much its squared error falls then.
const SMOOTH_FACTOR: f64 = 1.0 / 16.0;

/// The class of a pixel with so many samples, 0 for smooth ones, by its expected squared error.
pub(super) fn class(samples: u32, error: f64) -> usize {
    let level = if samples == 0 { 0 } else { samples.ilog2() as usize + 1 };
    let size = if error > 0.0 {
        let is_upper = error.to_bits() & FRACTION >= std::f64::consts::SQRT_2.to_bits() & FRACTION;
        (2 * (exponent(error) + 39) + i32::from(is_upper) + 2).clamp(0, SIZES as i32 - 1) as usize
    } else {
        0
    };
    level.min(LEVELS - 1) * SIZES + size
}

impl Tally {
    pub(super) fn new() -> Self {
        Self { classes: vec![Class::default(); LEVELS * SIZES] }
    }

    pub(super) fn take(&mut self, samples: u32, error: f64) {
        self.classes[class(samples, error)].take(error);
    }

    /// Takes in several pixels of a class.
    pub(super) fn add_to(&mut self, class: usize, more: &Class) {
        self.classes[class].pixels += more.pixels;
        self.classes[class].error += more.error;
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (class, other) in other.classes.iter().enumerate() {
            self.add_to(class, other);
        }
    }

    /// The sum of all expected squared errors.
    pub(super) fn error(&self) -> f64 {
        self.classes.iter().map(|class| class.error).sum()
    }
}

/// What to do with the pixels of each class.
pub(super) struct Plan {
    steps: Vec<Step>,
    /// How many samples it takes until the target, further rounds included.
    pub(super) to_come: f64,
}

/// How often the numbers of samples of a class are doubled, and for which part of it once more.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Step {
    doublings: u32,
    part: f64,
}

/// In one round, so many at most: estimates become better from round to round.
const MOST_DOUBLINGS: u32 = 2;

/// A class on its way.
struct Candidate {
    class: usize,
    doublings: u32,
    samples: f64,
    pixels: f64,
    error: f64,
    /// What refining it takes away, and how many samples that takes.
    gain: f64,
    cost: f64,
    /// By which power of the number of samples the squared error falls.
    power: f64,
}

impl Candidate {
    fn new(
        class: usize,
        doublings: u32,
        (samples, pixels, error): (f64, f64, f64),
        power: f64,
    ) -> Self {
        let (cost, factor) = if samples == 0.0 {
            (f64::from(SMOOTH_SAMPLES), SMOOTH_FACTOR)
        } else {
            (samples, libm::exp2(-power))
        };
        let (gain, cost) = (error * (1.0 - factor), cost * pixels);
        Self { class, doublings, samples, pixels, error, gain, cost, power }
    }

    fn after(&self) -> Self {
        let samples =
            if self.samples == 0.0 { f64::from(SMOOTH_SAMPLES) } else { 2.0 * self.samples };
        let left = (samples, self.pixels, self.error - self.gain);
        Self::new(self.class, self.doublings + 1, left, self.power)
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let rate = |c: &Self| c.gain / c.cost;
        rate(self).total_cmp(&rate(other)).then(other.class.cmp(&self.class))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

/// The fewest samples by which the sum of squared errors falls to `target`, as far as is
/// known: those first that take away most for a sample. `None` where nothing can be done.
pub(super) fn plan(tally: &Tally, target: f64, power: f64, most_samples: u32) -> Option<Plan> {
    let mut heap = BinaryHeap::new();
    for (at, class) in tally.classes.iter().enumerate() {
        let level = at / SIZES;
        let samples = if level == 0 { 0.0 } else { libm::exp2(level as f64 - 1.0) };
        if class.pixels > 0 && class.error > 0.0 {
            let now = (samples, class.pixels as f64, class.error);
            heap.push(Candidate::new(at, 0, now, power));
        }
    }
    let mut plan = Plan { steps: vec![Step::default(); tally.classes.len()], to_come: 0.0 };
    let mut left = tally.error();
    while left > target
        && let Some(best) = heap.pop()
    {
        if 2.0 * best.samples > f64::from(most_samples) {
            continue;
        }
        // Only as many of them as are needed.
        let part = ((left - target) / best.gain).min(1.0);
        left -= part * best.gain;
        plan.to_come += part * best.cost;
        if best.doublings < MOST_DOUBLINGS {
            let step = &mut plan.steps[best.class];
            if part < 1.0 {
                step.part = part;
            } else {
                step.doublings += 1;
            }
        }
        heap.push(best.after());
    }
    (plan.to_come > 0.0).then_some(plan)
}

impl Plan {
    /// Whether smooth pixels are among those to be refined.
    pub(super) fn promotes(&self) -> bool {
        self.steps[..SIZES].iter().any(|step| *step != Step::default())
    }

    /// The same, but where only a part of a class was to be refined, all of it.
    pub(super) fn of_all(mut self) -> Self {
        for step in &mut self.steps {
            if step.part > 0.0 {
                step.part = 1.0;
            }
        }
        self
    }

    /// How many samples a pixel of that class should have; `chance`, a number from 0 to 1 of
    /// its own, tells whether it is among those of which only a part is needed.
    pub(super) fn samples(&self, class: usize, samples: u32, chance: impl Fn() -> f64) -> u32 {
        let Step { doublings, part } = self.steps[class];
        let is_among = part > 0.0 && chance() < part;
        let doublings = doublings + u32::from(is_among);
        match (samples, doublings) {
            (_, 0) => samples,
            (0, _) => SMOOTH_SAMPLES,
            _ => samples << doublings,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_takes_most_away_for_a_sample_comes_first_and_no_more_than_is_needed() {
        let mut tally = Tally::new();
        for _ in 0..100 {
            tally.take(4, 0.01);
            tally.take(4, 0.0001);
        }
        let plan = plan(&tally, 0.8, POWER, 1 << 16).expect("there is something to do");
        let [large, small] = [0.01, 0.0001].map(|error| class(4, error));
        assert_eq!(plan.samples(small, 4, || 0.0), 4);
        // 1.01 to 0.8 by what takes 0.58 of 1.0 away: a part of it.
        assert_eq!((plan.samples(large, 4, || 0.0), plan.samples(large, 4, || 0.99)), (8, 4));
        assert!((100.0..200.0).contains(&plan.to_come), "{}", plan.to_come);
        assert!(super::plan(&tally, 1.1, POWER, 1 << 16).is_none());
        assert!(super::plan(&tally, 0.8, POWER, 4).is_none());
    }

    #[test]
    fn sums_do_not_depend_on_parts() {
        let mut all = Tally::new();
        let mut parts = [Tally::new(), Tally::new()];
        for k in 0..1000_u32 {
            let error = f64::from(k) * 1e-5;
            all.take(k % 9, error);
            parts[(k % 2) as usize].take(k % 9, error);
        }
        let [mut first, second] = parts;
        first.add(&second);
        assert!((first.error() - all.error()).abs() < 1e-12);
        assert!(all.classes.iter().zip(&first.classes).all(|(a, b)| a.pixels == b.pixels));
    }
}
