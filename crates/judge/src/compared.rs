//! Time against error: which settings are beaten by none, and which spends time best.

/// What a picture took and how far from the true one it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// What was asked for, as it is written on a command line.
    pub setting: String,
    /// Wall time of the rendering, in seconds.
    pub seconds: f64,
    /// Its error, as [`Picture::error`](crate::Picture::error) defines it.
    pub error: f64,
    /// What the program itself said that the error is.
    pub predicted: Option<f64>,
    /// How many samples it took, in all.
    pub samples: Option<u64>,
}

impl Point {
    /// A point of which no more is known.
    #[must_use]
    pub fn new(setting: impl Into<String>, seconds: f64, error: f64) -> Self {
        Self { setting: setting.into(), seconds, error, predicted: None, samples: None }
    }

    /// Whether it can be drawn on logarithmic axes.
    fn is_ordinary(&self) -> bool {
        let is_ordinary = |v: f64| v > 0.0 && v < f64::INFINITY;
        is_ordinary(self.seconds) && is_ordinary(self.error)
    }
}

/// What one way of sampling, or another program, reaches with its settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its name.
    pub name: String,
    /// Whether it is another program: then it stands on the chart, but nothing is
    /// recommended of it.
    pub is_peer: bool,
    /// In the order of its settings.
    pub points: Vec<Point>,
}

impl Series {
    /// One of our own.
    #[must_use]
    pub fn new(name: impl Into<String>, points: Vec<Point>) -> Self {
        Self { name: name.into(), is_peer: false, points }
    }

    /// That of another program.
    #[must_use]
    pub fn peer(name: impl Into<String>, points: Vec<Point>) -> Self {
        Self { is_peer: true, ..Self::new(name, points) }
    }
}

/// A point of a [`Comparison`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Which series.
    pub series: usize,
    /// Which of its points.
    pub point: usize,
}

/// Several series beside one another.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    series: Vec<Series>,
}

impl Comparison {
    /// Points without time or error, or with an infinite one, are left out.
    #[must_use]
    pub fn new(mut series: Vec<Series>) -> Self {
        for series in &mut series {
            series.points.retain(Point::is_ordinary);
        }
        Self { series }
    }

    /// All of them.
    #[must_use]
    pub fn series(&self) -> &[Series] {
        &self.series
    }

    /// The point at a place that this comparison has given.
    ///
    /// # Panics
    /// Where the place is another comparison's.
    #[must_use]
    pub fn point(&self, place: Place) -> &Point {
        &self.series[place.series].points[place.point]
    }

    /// Points, series by series.
    pub(crate) fn places(&self) -> impl Iterator<Item = Place> {
        let of = |(series, it): (usize, &Series)| {
            (0..it.points.len()).map(move |point| Place { series, point })
        };
        self.series.iter().enumerate().flat_map(of)
    }

    fn of_own(&self, place: &Place) -> bool {
        !self.series[place.series].is_peer
    }

    /// Our own points than which none is both faster and nearer to the truth, the fastest
    /// first (Pareto's front).
    #[must_use]
    pub fn front(&self) -> Vec<Place> {
        let mut places: Vec<_> = self.places().filter(|place| self.of_own(place)).collect();
        let key = |place: &Place| (self.point(*place).seconds, self.point(*place).error);
        places.sort_by(|a, b| {
            let ((a, a_error), (b, b_error)) = (key(a), key(b));
            a.total_cmp(&b).then(a_error.total_cmp(&b_error))
        });
        let mut least = f64::INFINITY;
        places.retain(|place| {
            let error = self.point(*place).error;
            let is_better = error < least;
            least = least.min(error);
            is_better
        });
        places
    }

    /// The point of the front that is furthest below the straight way from its fastest to its most
    /// exact one, on logarithmic axes: before it time buys more than on the whole way, beyond it
    /// less. Where none is below, it is the end with the smaller product of time and error.
    #[must_use]
    pub fn knee(&self) -> Option<Place> {
        let front = self.front();
        let at = |place: Place| {
            let point = self.point(place);
            [point.seconds, point.error].map(libm::log10)
        };
        let (first, last) = (*front.first()?, *front.last()?);
        let ([fast, poor], [slow, good]) = (at(first), at(last));
        let below = |place: &Place| {
            let [time, error] = at(*place);
            let part = (time - fast) / (slow - fast);
            poor + part * (good - poor) - error
        };
        let between = front.iter().filter(|place| ![first, last].contains(place));
        let knee = between.max_by(|a, b| below(a).total_cmp(&below(b)));
        match knee.filter(|place| below(place) > 0.0) {
            Some(place) => Some(*place),
            None if fast + poor < slow + good => Some(first),
            None => Some(last),
        }
    }

    /// What is recommended, in a sentence or two.
    #[must_use]
    pub fn advice(&self) -> Option<String> {
        let (front, knee) = (self.front(), self.knee()?);
        let point = self.point(knee);
        let what = format!(
            "At the knee: {} ({}), with an error of {} in {}.",
            point.setting,
            self.series[knee.series].name,
            error(point.error),
            time(point.seconds),
        );
        let is_first = front.first() == Some(&knee);
        let is_last = front.last() == Some(&knee);
        let why = match (is_first, is_last) {
            (true, true) => "No other of these is better in either respect",
            (false, true) => "That is the most exact one of these, and up to it time is well spent",
            (true, false) => {
                "That is the fastest one of these, and from there on the error falls more slowly \
                 than time grows"
            }
            (false, false) => "Up to it time buys more than on the whole, beyond it less",
        };
        Some(format!("{what} {why}."))
    }

    /// By how many times less time than each peer's fastest picture of an error our own fastest
    /// picture of at most that error took: the peer's name, its setting, and the ratio. Points of
    /// peers that nothing of ours is as exact as are left out.
    #[must_use]
    pub fn times_faster(&self) -> Vec<(&str, &Point, f64)> {
        let front = self.front();
        let peers = self.places().filter(|place| !self.of_own(place));
        peers
            .filter_map(|place| {
                let peer = self.point(place);
                let own = front.iter().find(|own| self.point(**own).error <= peer.error)?;
                let times = peer.seconds / self.point(*own).seconds;
                Some((self.series[place.series].name.as_str(), peer, times))
            })
            .collect()
    }
}

/// A time as people read it: to three digits, in the unit that fits.
#[must_use]
pub fn time(seconds: f64) -> String {
    match seconds {
        s if s < 1e-3 => format!("{} us", digits(1e6 * s)),
        s if s < 1.0 => format!("{} ms", digits(1e3 * s)),
        s => format!("{} s", digits(s)),
    }
}

/// An error to two digits.
#[must_use]
pub fn error(error: f64) -> String {
    // What is rounded up to the next power of ten has one digit less.
    let rounded: f64 = format!("{error:.1e}").parse().unwrap_or(error);
    let places = (1.0 - libm::floor(libm::log10(rounded))).clamp(0.0, 12.0) as usize;
    format!("{rounded:.places$}")
}

fn digits(number: f64) -> String {
    match number {
        n if n < 9.995 => format!("{n:.2}"),
        n if n < 99.95 => format!("{n:.1}"),
        n => format!("{n:.0}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(points: &[(f64, f64)]) -> Vec<Point> {
        let point = |(i, (seconds, error)): (usize, &(f64, f64))| {
            Point::new(i.to_string(), *seconds, *error)
        };
        points.iter().enumerate().map(point).collect()
    }

    fn front(comparison: &Comparison) -> Vec<(usize, usize)> {
        comparison.front().iter().map(|place| (place.series, place.point)).collect()
    }

    #[test]
    fn on_the_front_is_what_none_beats() {
        let comparison = Comparison::new(vec![
            Series::new("a", series(&[(1.0, 0.1), (2.0, 0.05), (4.0, 0.06), (8.0, 0.01)])),
            Series::new("b", series(&[(1.0, 0.09), (2.0, 0.05), (9.0, 0.01), (0.5, 0.5)])),
            Series::peer("c", series(&[(0.1, 0.001)])),
        ]);
        // Of two that are the same, one is enough; what another program reaches is not ours.
        assert_eq!(front(&comparison), [(1, 3), (1, 0), (0, 1), (0, 3)]);
        assert_eq!(front(&Comparison::new(vec![])), []);
    }

    #[test]
    fn points_that_cannot_be_drawn_are_left_out() {
        let bad = [(0.0, 0.1), (1.0, 0.0), (f64::NAN, 0.1), (1.0, f64::INFINITY), (-1.0, 0.1)];
        let comparison = Comparison::new(vec![Series::new("a", series(&bad))]);
        assert!(comparison.front().is_empty() && comparison.knee().is_none());
        assert_eq!(comparison.advice(), None);
    }

    #[test]
    fn at_the_knee_the_gain_ends() {
        let knee = |points: &[(f64, f64)]| {
            let comparison = Comparison::new(vec![Series::new("a", series(points))]);
            let knee = comparison.knee().expect("there is one");
            (knee.point, comparison.advice().expect("there is one"))
        };
        let (point, words) = knee(&[(1.0, 0.4), (2.0, 0.1), (4.0, 0.04), (64.0, 0.03)]);
        assert_eq!(point, 2);
        assert_eq!(
            words,
            "At the knee: 2 (a), with an error of 0.040 in 4.00 s. Up to it time buys more than on \
             the whole, beyond it less."
        );
        // In other units it is the same one.
        let (point, _) = knee(&[(1e-3, 40.0), (2e-3, 10.0), (4e-3, 4.0), (64e-3, 3.0)]);
        assert_eq!(point, 2);
        // Where the way bends to the other side, it is an end.
        let (point, words) = knee(&[(1.0, 0.4), (2.0, 0.3), (4.0, 0.01)]);
        assert!(point == 2 && words.contains("most exact one"), "{words}");
        let (point, words) = knee(&[(1.0, 0.4), (4.0, 0.38), (8.0, 0.2)]);
        assert!(point == 0 && words.contains("fastest one"), "{words}");
        let (_, words) = knee(&[(1.0, 0.4)]);
        assert!(words.contains("No other"), "{words}");
    }

    #[test]
    fn peers_are_compared_at_their_own_error() {
        let comparison = Comparison::new(vec![
            Series::new("a", series(&[(1.0, 0.1), (2.0, 0.01), (9.0, 0.02)])),
            Series::peer("POV-Ray", series(&[(50.0, 0.05), (60.0, 0.2), (70.0, 0.001)])),
        ]);
        let times: Vec<_> = comparison.times_faster().iter().map(|t| (t.0, t.2)).collect();
        assert_eq!(times, [("POV-Ray", 25.0), ("POV-Ray", 60.0)]);
    }

    #[test]
    fn times_and_errors_are_short() {
        for (seconds, text) in
            [(1.234e-4, "123 us"), (0.0271, "27.1 ms"), (0.9999, "1000 ms"), (46.87, "46.9 s")]
        {
            assert_eq!(time(seconds), text);
        }
        for (value, text) in
            [(0.00434, "0.0043"), (0.0996, "0.10"), (0.0005, "0.00050"), (12.0, "12")]
        {
            assert_eq!(error(value), text);
        }
    }
}
