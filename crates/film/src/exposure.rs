//! How much light a picture is shown with, in stops: one more doubles what is
//! shown of the same radiance.

use crate::Film;
use std::ops::AddAssign;
use std::sync::LazyLock;

/// The most stops, up or down, that a film may be shown with. No radiance that
/// a film can hold needs more than 150.
pub const MOST_STOPS: f64 = 1000.0;

/// How many steps of a [`LightMeter`] there are in a stop; so few that each is a
/// short decimal number.
const STEPS: i32 = 64;

/// One pixel in so many may be over-exposed by a [`LightMeter`].
const ONE_IN: u64 = 100;

/// 2^`stops`, what radiance is multiplied by; exact for whole stops.
#[must_use]
pub fn exposure_factor(stops: f64) -> f64 {
    libm::exp2(stops)
}

/// Finds the exposure that shows a picture when nobody has chosen one.
///
/// It is shown the pixels of the whole frame, for a crop too, so that it is shown as
/// a part of the whole. Where several threads each show a meter a part of them,
/// the meters are added up. Neither order nor parts matter.
///
/// The rule: of the pixels that are lit (their largest component, as
/// [`Film::peak`](crate::Film::peak) gives it, is above 0 and finite), take the value
/// that 99 of 100 do not exceed; make that display white, or up to 1/64 stop
/// less. So one bright pixel upsets nothing. In a picture of fewer than 100 lit
/// pixels none is over-exposed. Where no pixel is lit, it is 0 stops.
///
/// The result is a multiple of 1/64, the largest for which 2^stops times that
/// value is at most 1. Its decimal digits are exact, so that a reader who gives
/// back the number that was printed gets the same picture.
///
/// The smaller a value, the more steps of 1/64 stop it takes, so it is enough to count
/// the pixels by their steps. Where more pixels than may be over-exposed in the whole
/// frame are brighter than a pixel, its own steps do not matter.
#[derive(Debug, Clone)]
pub struct LightMeter {
    /// The lit pixels of each number of steps, from [`FEWEST`] on.
    counts: Vec<u64>,
    /// Other lit pixels, which are so dark that their steps do not matter.
    dark: u64,
    /// How many pixels may be over-exposed, at most.
    most: u64,
    /// As few steps as can be, up to which more than `most` have been counted; all, as
    /// long as these are not.
    last: usize,
    /// How many have been counted up to there.
    counted: u64,
    /// What is no brighter takes more steps than that.
    floor: f32,
}

/// The steps of the largest numbers: none reaches 2^128.
const FEWEST: i32 = -128 * STEPS;
/// The steps of the smallest number, 2^-149.
const MOST: i32 = 149 * STEPS;

impl LightMeter {
    /// One that has seen no pixel yet, of a frame of at most so many. If it is shown
    /// more than that, what is forgotten may matter.
    #[must_use]
    pub fn new(pixels: u64) -> Self {
        Self {
            counts: vec![0; (MOST - FEWEST + 1) as usize],
            dark: 0,
            most: pixels / ONE_IN,
            last: 0,
            counted: 0,
            floor: 0.0,
        }
    }

    /// Takes in these pixels.
    pub fn see(&mut self, pixels: &[[f32; 3]]) {
        if Film::peak(pixels) <= self.floor {
            self.dark += pixels.iter().map(|pixel| u64::from(peak(pixel) > 0.0)).sum::<u64>();
            return;
        }
        let steps = Steps::table();
        for pixel in pixels {
            let peak = peak(pixel);
            // Above 0 and finite: the bits of such numbers are ordered as they are.
            if peak.to_bits().wrapping_sub(1) >= f32::INFINITY.to_bits() - 1 {
                continue;
            }
            if peak <= self.floor {
                self.dark += 1;
                continue;
            }
            let index = (steps.of(peak) - FEWEST) as usize;
            self.counts[index] += 1;
            if index <= self.last || self.counted <= self.most {
                self.counted += 1;
                self.last = self.last.max(index);
            }
        }
        self.forget_the_dark();
    }

    /// Raises the floor as far as there are enough pixels above it.
    fn forget_the_dark(&mut self) {
        let before = self.last;
        while self.counted.saturating_sub(self.counts[self.last]) > self.most {
            self.counted -= self.counts[self.last];
            self.last -= 1;
        }
        if self.last != before {
            let steps = f64::from(self.last as i32 + FEWEST + 1);
            // Less by more than the power is rounded.
            let floor = exposure_factor(-steps / f64::from(STEPS)) * (1.0 - 1e-6);
            self.floor = (floor as f32).next_down();
        }
    }

    /// The exposure for all pixels that it has seen, in stops.
    #[must_use]
    pub fn stops(&self) -> f64 {
        let over_exposed = (self.counts.iter().sum::<u64>() + self.dark) / ONE_IN;
        let mut brighter = 0;
        let white = self.counts.iter().position(|count| {
            brighter += count;
            brighter > over_exposed
        });
        white.map_or(0.0, |index| f64::from(index as i32 + FEWEST) / f64::from(STEPS))
    }
}

/// As [`Film::peak`] has it.
#[inline]
fn peak(pixel: &[f32; 3]) -> f32 {
    pixel.iter().fold(0.0, |peak, v| if *v > peak { *v } else { peak })
}

impl AddAssign<&Self> for LightMeter {
    /// Both are of the same frame.
    fn add_assign(&mut self, other: &Self) {
        for (count, more) in self.counts.iter_mut().zip(&other.counts) {
            *count += more;
        }
        self.dark += other.dark;
    }
}

/// How many steps each number takes, the most that leave it at 1 or below. They are
/// read off a list of the 64 thresholds between 1 and 2, which are those of every
/// octave.
struct Steps {
    /// The largest numbers that take so many steps down to be at most 1.
    thresholds: [f64; STEPS as usize + 1],
    /// Of each interval between 1 and 2, so narrow that there is at most one
    /// threshold in it, the steps down of its lower end.
    lowest: [u8; 1 << FRACTION],
    /// The same, and the last fraction, as bits of single precision, that takes no more.
    intervals: [(u8, u32); 1 << FRACTION],
}

/// How many bits of a number's fraction choose its interval.
const FRACTION: u32 = 7;

impl Steps {
    /// The table. It is made when it is first asked for.
    fn table() -> &'static Self {
        static TABLE: LazyLock<Steps> = LazyLock::new(Steps::new);
        &TABLE
    }

    fn new() -> Self {
        let thresholds = std::array::from_fn(|down| {
            let factor = exposure_factor(-(down as f64) / f64::from(STEPS));
            // By halving the numbers from 1, which fits, to 2, which does not; but the
            // last threshold is beyond all of them.
            let (mut fits, mut too_large) = (1_f64.to_bits(), 2_f64.to_bits());
            while too_large - fits > 1 {
                let middle = fits.midpoint(too_large);
                if f64::from_bits(middle) * factor <= 1.0 {
                    fits = middle;
                } else {
                    too_large = middle;
                }
            }
            f64::from_bits(fits)
        });
        let lowest = std::array::from_fn(|interval| {
            let start = 1.0 + interval as f64 / f64::from(1 << FRACTION);
            thresholds.partition_point(|threshold| *threshold < start) as u8
        });
        let intervals = lowest.map(|down: u8| {
            let threshold: f64 = thresholds[usize::from(down)];
            let nearest = threshold as f32;
            let below = if f64::from(nearest) > threshold { nearest.next_down() } else { nearest };
            // The last threshold is at the end of the octave.
            let last = if below < 2.0 { below.to_bits() & ((1 << 23) - 1) } else { u32::MAX };
            (down, last)
        });
        Self { thresholds, lowest, intervals }
    }

    /// The steps of a number that is above 0 and finite.
    #[inline]
    fn of(&self, peak: f32) -> i32 {
        let bits = peak.to_bits();
        if bits >= f32::MIN_POSITIVE.to_bits() {
            let (down, last) = self.intervals[(bits >> (23 - FRACTION)) as usize % (1 << FRACTION)];
            let further = bits & ((1 << 23) - 1) > last;
            return STEPS * (127 - (bits >> 23) as i32) - i32::from(down) - i32::from(further);
        }
        // All that are above 0 are normal as doubles.
        let bits = f64::from(peak).to_bits();
        let exponent = (bits >> 52) as i32 - 1023;
        let fraction = f64::from_bits(bits & ((1 << 52) - 1) | 1_f64.to_bits());
        let down = self.lowest[(bits >> (52 - FRACTION)) as usize % (1 << FRACTION)];
        let further = fraction > self.thresholds[usize::from(down)];
        -STEPS * exponent - i32::from(down) - i32::from(further)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `count` numbers that have all magnitudes from 2^-low to 2^high.
    fn numbers(seed: u64, count: usize, low: f64, high: f64) -> Vec<f32> {
        let mut state = seed;
        let mut random = || {
            // Knuth's multiplier and increment.
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..count).map(|_| libm::exp2(low + (high - low) * random()) as f32).collect()
    }

    /// The stops for pixels with these largest components.
    fn auto_stops(values: &[f32]) -> f64 {
        let mut meter = LightMeter::new(values.len() as u64);
        meter.see(&values.iter().map(|v| [0.0, *v, v / 2.0]).collect::<Vec<_>>());
        meter.stops()
    }

    /// The rule by its words: sorts, counts, and tries one step after the other.
    fn stops_by_its_words(values: &[f32]) -> f64 {
        let mut lit: Vec<f32> =
            values.iter().copied().filter(|v| *v > 0.0 && *v < f32::INFINITY).collect();
        lit.sort_by(f32::total_cmp);
        let Some(white) = lit.iter().copied().find(|p| {
            let not_above = lit.iter().filter(|v| *v <= p).count();
            not_above * 100 >= lit.len() * 99
        }) else {
            return 0.0;
        };
        let mut step = 200 * 64;
        while f64::from(white) * libm::exp2(f64::from(step) / 64.0) > 1.0 {
            step -= 1;
        }
        f64::from(step) / 64.0
    }

    #[test]
    fn the_rule_is_what_its_words_say() {
        for case in 0..200 {
            let count = [1, 2, 3, 50, 99, 100, 101, 199, 200, 201, 1000][case as usize % 11];
            let mut values = match case % 3 {
                0 => numbers(case, count, -8.0, 8.0),
                1 => numbers(case, count, -149.0, 128.0),
                _ => numbers(case, count, -0.01, 0.01),
            };
            if case % 2 == 0 {
                for (index, bad) in [0.0, -3.0, f32::NAN, f32::INFINITY].into_iter().enumerate() {
                    values.insert(index * 7 % values.len(), bad);
                }
            }
            let expected = stops_by_its_words(&values);
            assert_eq!(auto_stops(&values), expected, "case {case}");
        }
    }

    #[test]
    fn white_is_reached_to_a_64th_of_a_stop() {
        let step = 1.0 / 64.0;
        for (case, p) in numbers(7, 20_000, -149.0, 128.0)
            .into_iter()
            .chain([1.0, f32::MAX, f32::MIN_POSITIVE, f32::from_bits(1), 1e-38, 1e38])
            .chain((-149..=127).map(|e| libm::exp2(f64::from(e)) as f32))
            .enumerate()
        {
            let stops = auto_stops(&[p]);
            assert!(exposure_factor(stops) * f64::from(p) <= 1.0, "case {case}: {p}");
            assert!(exposure_factor(stops + step) * f64::from(p) > 1.0, "case {case}: {p}");
            assert_eq!(stops * 64.0, (stops * 64.0).round(), "case {case}: {p}");
            let printed: f64 = stops.to_string().parse().expect("a number");
            assert_eq!(printed.to_bits(), stops.to_bits(), "case {case}: {p}");
        }
    }

    #[test]
    fn powers_of_two_are_shown_at_white() {
        for e in -149..=127_i32 {
            let stops = auto_stops(&[libm::exp2(f64::from(e)) as f32]);
            assert_eq!(stops, f64::from(-e));
        }
        assert_eq!(auto_stops(&[1.0]).to_bits(), 0, "and not -0");
    }

    #[test]
    fn one_bright_pixel_changes_nothing() {
        let picture: Vec<f32> = (0..10_000_u16).map(|i| f32::from(i % 97) * 0.03).collect();
        let expected = auto_stops(&picture);
        for bright in [1e30, f32::MAX, f32::INFINITY, f32::NAN] {
            for place in [0, 5000, 9999] {
                let mut picture = picture.clone();
                picture[place] = bright;
                assert_eq!(auto_stops(&picture), expected, "{bright} at {place}");
            }
        }
        // A hundredth of them is too few to count, one more is not.
        let mut picture = vec![0.25_f32; 1000];
        picture[..10].fill(16.0);
        assert_eq!(auto_stops(&picture), 2.0);
        picture[..11].fill(16.0);
        assert_eq!(auto_stops(&picture), -4.0);
    }

    #[test]
    fn what_is_dark_or_no_number_does_not_count() {
        let mut picture = vec![0.0, f32::NAN, -1.0, f32::INFINITY, 0.5, f32::NEG_INFINITY, -0.0];
        picture.extend([0.0; 500]);
        assert_eq!(auto_stops(&picture), 1.0);
    }

    #[test]
    fn twice_the_light_is_one_stop_less() {
        for case in 0..100 {
            let values = numbers(case, 300, -20.0, 20.0);
            let stops = auto_stops(&values);
            for doublings in [1, 2, 17, -1, -40] {
                let factor = libm::exp2(f64::from(doublings)) as f32;
                let scaled: Vec<f32> = values.iter().map(|v| v * factor).collect();
                assert_eq!(auto_stops(&scaled), stops - f64::from(doublings), "case {case}");
            }
        }
    }

    #[test]
    fn the_order_does_not_matter() {
        for case in 0..50 {
            let mut values = numbers(case, 777, -6.0, 6.0);
            values[case as usize] = f32::NAN;
            let expected = auto_stops(&values);
            for turn in [1, 100, 500] {
                let mut other = values.clone();
                other.rotate_left(turn);
                other[..300].reverse();
                assert_eq!(auto_stops(&other), expected, "case {case}");
            }
        }
    }

    #[test]
    fn meters_add_up() {
        for case in 0..50 {
            let values: Vec<_> =
                numbers(case, 1000, -6.0, 6.0).into_iter().map(|v| [v, 0.1, 0.0]).collect();
            let mut whole = LightMeter::new(1000);
            whole.see(&values);
            let mut sum = LightMeter::new(1000);
            for part in values.chunks(1 + case as usize * 20) {
                let mut meter = LightMeter::new(1000);
                meter.see(part);
                sum += &meter;
            }
            assert_eq!(sum.stops(), whole.stops(), "case {case}");
            assert_eq!(sum.counts, whole.counts, "case {case}");
        }
    }

    /// Pixels that are taken in bit by bit, by several meters, so that most are found to be
    /// too dark to matter; against a meter that forgets nothing.
    #[test]
    fn what_is_forgotten_does_not_matter() {
        let mut forgotten = 0;
        for case in 0..60 {
            let (low, high) =
                [(-6.0, 6.0), (-149.0, -140.0), (-0.1, 0.1), (-149.0, 128.0)][case % 4];
            let mut values = numbers(case as u64, 20_000, low, high);
            match case % 3 {
                0 => values.sort_by(f32::total_cmp),
                1 => values.sort_by(|a, b| b.total_cmp(a)),
                _ => {}
            }
            values[case * 7] = [0.0, f32::NAN, f32::INFINITY, -1.0][case / 2 % 4];
            let values: Vec<_> = values.into_iter().map(|v| [0.0, v / 3.0, v]).collect();
            let mut all = LightMeter::new(u64::MAX);
            all.see(&values);
            let mut meters = [LightMeter::new(20_000), LightMeter::new(20_000)];
            for (k, part) in values.chunks(1 + case * 10).enumerate() {
                // Either may also be shown more after it was added to.
                if k == 30 {
                    let [first, second] = &mut meters;
                    *first += second;
                    *second = LightMeter::new(20_000);
                }
                meters[k % 2].see(part);
            }
            let [first, second] = &mut meters;
            *first += second;
            assert_eq!(first.stops(), all.stops(), "case {case}");
            assert_eq!(all.dark, 0);
            forgotten += first.dark;
        }
        assert!(forgotten > 200_000, "{forgotten}");
    }

    /// On either side of each step, against the definition.
    #[test]
    fn steps_change_exactly_where_the_rule_says() {
        let steps = Steps::table();
        let fits = |v: f32, steps: i32| {
            f64::from(v) * exposure_factor(f64::from(steps) / f64::from(STEPS)) <= 1.0
        };
        for step in FEWEST..=MOST {
            let near = libm::exp2(f64::from(-step) / f64::from(STEPS)) as f32;
            for bits in near.to_bits().saturating_sub(2)..=near.to_bits() + 2 {
                let v = f32::from_bits(bits);
                if v > 0.0 && v.is_finite() {
                    let found = steps.of(v);
                    assert!(fits(v, found) && !fits(v, found + 1), "{v:e} takes {found} steps");
                }
            }
        }
    }

    #[test]
    fn small_and_black_pictures() {
        assert_eq!(auto_stops(&[]), 0.0);
        assert_eq!(auto_stops(&[0.0; 5]), 0.0);
        assert_eq!(auto_stops(&[f32::NAN, f32::INFINITY]), 0.0);
        assert_eq!(auto_stops(&[4.0]), -2.0);
        assert_eq!(auto_stops(&[4.0, 1.0]), -2.0, "the brighter one");
        assert_eq!(auto_stops(&[0.0, 1.0]), 0.0);
        assert_eq!(auto_stops(&[3.0]), -1.59375, "-log2(3) is -1.58496");
    }

    #[test]
    fn whole_stops_are_exact() {
        for stops in -1000..=1000_i32 {
            let exact = f64::from_bits(((1023 + stops) as u64) << 52);
            assert_eq!(exposure_factor(f64::from(stops)), exact, "{stops}");
        }
        assert!(exposure_factor(MOST_STOPS).is_finite());
        assert!(exposure_factor(-MOST_STOPS).is_normal());
    }
}
