//! Logarithmic axes.

/// What an axis measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Measure {
    /// Seconds.
    Time,
    /// A plain number.
    Number,
}

/// A logarithmic axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    pub(crate) title: String,
    measure: Measure,
    /// The least and the largest value on it.
    range: [f64; 2],
}

impl Axis {
    /// An axis that all of the values are on, with some room around them; between 1 and 2
    /// decades where there are none.
    pub(crate) fn over(
        title: impl Into<String>,
        measure: Measure,
        values: impl Iterator<Item = f64>,
    ) -> Self {
        let (least, most) =
            values.fold((f64::INFINITY, 0.0_f64), |(least, most), v| (least.min(v), most.max(v)));
        let [least, most] = if least <= most { [least, most] } else { [1.0, 10.0] };
        let range = [below(least / 1.15), above(most * 1.15)];
        Self { title: title.into(), measure, range }
    }

    /// Where a value is on it: 0 is its beginning and 1 its end; others are brought to these.
    pub(crate) fn part(&self, value: f64) -> f64 {
        let [least, most] = self.range.map(libm::log10);
        ((libm::log10(value) - least) / (most - least)).clamp(0.0, 1.0)
    }

    /// The values with a line across, and the words beside those that have some.
    pub(crate) fn ticks(&self) -> Vec<(f64, Option<String>)> {
        let [least, most] = self.range;
        let decades = libm::log10(most / least);
        let named: &[u32] = match decades {
            d if d <= 2.2 => &[1, 2, 5],
            d if d <= 3.2 => &[1, 3],
            _ => &[1],
        };
        let first = libm::floor(libm::log10(least)) as i32;
        let last = libm::ceil(libm::log10(most)) as i32;
        let all = (first..=last).flat_map(|power| (1..10).map(move |digit| (digit, power)));
        let on_axis = all.filter_map(|(digit, power)| {
            let value = decimal(digit, power);
            let slack = 1e-9 * value;
            let is_on = least - slack <= value && value <= most + slack;
            let words = named.contains(&digit).then(|| self.words(value));
            is_on.then_some((value, words))
        });
        on_axis.collect()
    }

    fn words(&self, value: f64) -> String {
        let short = |value: f64| {
            let rounded = libm::rint(value * 1e6) / 1e6;
            rounded.to_string()
        };
        match (self.measure, value) {
            (Measure::Number, v) if v < 1e-6 => format!("{v:e}"),
            (Measure::Number, v) => short(v),
            (Measure::Time, s) if s < 0.9999e-3 => format!("{} us", short(1e6 * s)),
            (Measure::Time, s) if s < 0.9999 => format!("{} ms", short(1e3 * s)),
            (Measure::Time, s) => format!("{} s", short(s)),
        }
    }
}

/// digit * 10^power, rounded once.
fn decimal(digit: u32, power: i32) -> f64 {
    // Both are texts that are numbers.
    format!("{digit}e{power}").parse().unwrap_or(f64::NAN)
}

/// The numbers that axes begin and end with.
const ENDS: [u32; 4] = [1, 2, 5, 10];

/// The largest of those that is at most the value.
fn below(value: f64) -> f64 {
    let power = libm::floor(libm::log10(value)) as i32;
    let ends = ENDS.map(|digit| decimal(digit, power));
    ends.into_iter().rev().find(|end| *end <= value).unwrap_or(ends[0])
}

/// The least of those that is at least the value.
fn above(value: f64) -> f64 {
    let power = libm::floor(libm::log10(value)) as i32;
    let ends = ENDS.map(|digit| decimal(digit, power));
    ends.into_iter().find(|end| *end >= value).unwrap_or(ends[3])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(measure: Measure, values: &[f64]) -> Axis {
        Axis::over("", measure, values.iter().copied())
    }

    fn words(axis: &Axis) -> String {
        axis.ticks().into_iter().filter_map(|(_, words)| words).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn ranges_have_round_ends() {
        assert_eq!(axis(Measure::Number, &[0.0004, 0.0043]).range, [0.0002, 0.005]);
        assert_eq!(axis(Measure::Number, &[1.0]).range, [0.5, 2.0]);
        assert_eq!(axis(Measure::Number, &[0.95]).range, [0.5, 2.0]);
        assert_eq!(axis(Measure::Number, &[]).range, [0.5, 20.0]);
    }

    #[test]
    fn ticks_are_named_in_their_unit() {
        assert_eq!(
            words(&axis(Measure::Number, &[0.0004, 0.004])),
            "0.0002 0.0005 0.001 0.002 0.005"
        );
        assert_eq!(words(&axis(Measure::Time, &[0.4, 1.5])), "200 ms 500 ms 1 s 2 s");
        assert_eq!(
            words(&axis(Measure::Time, &[0.003, 0.9])),
            "3 ms 10 ms 30 ms 100 ms 300 ms 1 s"
        );
        assert_eq!(
            words(&axis(Measure::Time, &[2e-6, 9.0])),
            "1 us 10 us 100 us 1 ms 10 ms 100 ms 1 s 10 s"
        );
        assert_eq!(words(&axis(Measure::Number, &[1.2e-8, 1.9e-8])), "1e-8 2e-8 5e-8");
    }

    #[test]
    fn parts_are_logarithmic() {
        let axis = axis(Measure::Number, &[2.0, 80.0]);
        assert_eq!(axis.range, [1.0, 100.0]);
        let parts = [1.0, 10.0, 100.0, 1e9, 0.0].map(|value| axis.part(value));
        assert_eq!(parts, [0.0, 0.5, 1.0, 1.0, 0.0]);
    }
}
