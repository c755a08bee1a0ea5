//! How much light a picture is shown with, in stops: one more doubles what is
//! shown of the same radiance.

/// The most stops, up or down, that a film may be shown with. No radiance that
/// a film can hold needs more than 150.
pub const MOST_STOPS: f64 = 1000.0;

/// How many steps of [`auto_stops`] there are in a stop; so few that each is a
/// short decimal number.
const STEPS: f64 = 64.0;

/// One pixel in so many may be over-exposed by [`auto_stops`].
const ONE_IN: usize = 100;

/// 2^`stops`, what radiance is multiplied by; exact for whole stops.
#[must_use]
pub fn exposure_factor(stops: f64) -> f64 {
    libm::exp2(stops)
}

/// The exposure that shows a picture when nobody has chosen one, in stops.
///
/// `brightest_components` has a number for each pixel of the whole frame, for a
/// crop too, so that it is shown as a part of the whole: the largest component
/// of the pixel, as [`Film::peak`](crate::Film::peak) of it gives. They are put
/// in another order; that in which they come does not matter.
///
/// The rule: of the pixels that are lit (above 0, and finite), take the value
/// that 99 of 100 do not exceed; make that display white, or up to 1/64 stop
/// less. So one bright pixel upsets nothing. In a picture of fewer than 100 lit
/// pixels none is over-exposed. Where no pixel is lit, it is 0 stops.
///
/// The result is a multiple of 1/64, the largest for which 2^stops times that
/// value is at most 1. Its decimal digits are exact, so that a reader who gives
/// back the number that was printed gets the same picture.
#[must_use]
pub fn auto_stops(brightest_components: &mut [f32]) -> f64 {
    let Some(white) = white(brightest_components) else { return 0.0 };
    let fits = |steps: f64| white * exposure_factor(steps / STEPS) <= 1.0;
    // The logarithm's last digit may be on the wrong side of a step.
    let mut steps = (-libm::log2(white) * STEPS).floor();
    while !fits(steps) {
        steps -= 1.0;
    }
    while fits(steps + 1.0) {
        steps += 1.0;
    }
    // Adding 0 makes 0 of -0.
    steps / STEPS + 0.0
}

/// The smallest lit value that 99 of 100 lit values do not exceed.
fn white(values: &mut [f32]) -> Option<f64> {
    let mut lit = 0;
    for index in 0..values.len() {
        if values[index] > 0.0 && values[index].is_finite() {
            values.swap(lit, index);
            lit += 1;
        }
    }
    let last = (lit - lit / ONE_IN).checked_sub(1)?;
    let (_, white, _) = values[..lit].select_nth_unstable_by(last, f32::total_cmp);
    Some(f64::from(*white))
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
            assert_eq!(auto_stops(&mut values), expected, "case {case}");
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
            let stops = auto_stops(&mut [p]);
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
            let stops = auto_stops(&mut [libm::exp2(f64::from(e)) as f32]);
            assert_eq!(stops, f64::from(-e));
        }
        assert_eq!(auto_stops(&mut [1.0]).to_bits(), 0, "and not -0");
    }

    #[test]
    fn one_bright_pixel_changes_nothing() {
        let picture: Vec<f32> = (0..10_000_u16).map(|i| f32::from(i % 97) * 0.03).collect();
        let expected = auto_stops(&mut picture.clone());
        for bright in [1e30, f32::MAX, f32::INFINITY, f32::NAN] {
            for place in [0, 5000, 9999] {
                let mut picture = picture.clone();
                picture[place] = bright;
                assert_eq!(auto_stops(&mut picture), expected, "{bright} at {place}");
            }
        }
        // A hundredth of them is too few to count, one more is not.
        let mut picture = vec![0.25_f32; 1000];
        picture[..10].fill(16.0);
        assert_eq!(auto_stops(&mut picture.clone()), 2.0);
        picture[..11].fill(16.0);
        assert_eq!(auto_stops(&mut picture), -4.0);
    }

    #[test]
    fn what_is_dark_or_no_number_does_not_count() {
        let mut picture = vec![0.0, f32::NAN, -1.0, f32::INFINITY, 0.5, f32::NEG_INFINITY, -0.0];
        picture.extend([0.0; 500]);
        assert_eq!(auto_stops(&mut picture), 1.0);
    }

    #[test]
    fn twice_the_light_is_one_stop_less() {
        for case in 0..100 {
            let values = numbers(case, 300, -20.0, 20.0);
            let stops = auto_stops(&mut values.clone());
            for doublings in [1, 2, 17, -1, -40] {
                let factor = libm::exp2(f64::from(doublings)) as f32;
                let mut scaled: Vec<f32> = values.iter().map(|v| v * factor).collect();
                assert_eq!(auto_stops(&mut scaled), stops - f64::from(doublings), "case {case}");
            }
        }
    }

    #[test]
    fn the_order_does_not_matter() {
        for case in 0..50 {
            let mut values = numbers(case, 777, -6.0, 6.0);
            values[case as usize] = f32::NAN;
            let expected = auto_stops(&mut values.clone());
            for turn in [1, 100, 500] {
                let mut other = values.clone();
                other.rotate_left(turn);
                other[..300].reverse();
                assert_eq!(auto_stops(&mut other), expected, "case {case}");
                // What is left behind is the same picture.
                assert_eq!(auto_stops(&mut other), expected, "case {case}");
            }
        }
    }

    #[test]
    fn small_and_black_pictures() {
        assert_eq!(auto_stops(&mut []), 0.0);
        assert_eq!(auto_stops(&mut [0.0; 5]), 0.0);
        assert_eq!(auto_stops(&mut [f32::NAN, f32::INFINITY]), 0.0);
        assert_eq!(auto_stops(&mut [4.0]), -2.0);
        assert_eq!(auto_stops(&mut [4.0, 1.0]), -2.0, "the brighter one");
        assert_eq!(auto_stops(&mut [0.0, 1.0]), 0.0);
        assert_eq!(auto_stops(&mut [3.0]), -1.59375, "-log2(3) is -1.58496");
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
