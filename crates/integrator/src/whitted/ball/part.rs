//! The part of a ball above a horizon that cuts it, projected onto the horizon's plane.
//!
//! It lies between the circle of the horizon and the ellipse of the ball's rim. Chords
//! in the direction to the ball's centre, each as far aside as the ball's sine times a
//! number from -1 to 1, cut it into strips whose area has a closed form, as Peters and
//! Dachsbacher cut it into sectors (*Sampling Projected Spherical Caps in Real Time*, 2019).
//! So a point of it is drawn by the area before its chord, which Newton's method finds, and
//! evenly along the chord.
//!
//! For a small ball, the part is as long as its sine, squared, and as wide as its sine. So
//! lengths are counted from the circle, in units of the squared sine, and areas in units of its
//! cube: no number is the difference of much larger ones.

/// The part of a ball that is above the horizon.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    /// How far the centre is above the horizon, over the radius; between -1 and 1.
    height: f64,
    /// Of half the angle that the ball fills.
    sine: f64,
    cosine: f64,
    /// Of the angle between the normal and the way to the centre.
    sine_of_way: f64,
    /// How far aside the rim meets the horizon.
    end_of_rim: f64,
    /// The area on one side of the middle, up to there and in all.
    area_to_end: f64,
    area: f64,
}

/// A chord, from the circle inward.
struct Chord {
    from: f64,
    to: f64,
    /// How far from the middle of the horizon it is where it meets the circle.
    circle: f64,
}

/// An area this small, of all there is, is not told from zero.
const SLIGHT: f64 = 1e-15;

impl Part {
    pub(super) fn new(height: f64, sine: f64, cosine: f64) -> Self {
        let cosine_of_way = sine * height;
        let sine_of_way = ((1.0 - cosine_of_way) * (1.0 + cosine_of_way)).sqrt();
        let rim = ((1.0 - height) * (1.0 + height)).sqrt() / sine_of_way;
        // Of a ball that fills half of all directions, with its centre in the normal, the
        // rim is the horizon.
        let end_of_rim = if rim < 1.0 { rim } else { 1.0 };
        let mut part =
            Self { height, sine, cosine, sine_of_way, end_of_rim, area_to_end: 0.0, area: 0.0 };
        part.area_to_end = part.area_from_circle(end_of_rim);
        part.area = part.area_up_to(part.end());
        part
    }

    pub(super) fn sine_of_way(&self) -> f64 {
        self.sine_of_way
    }

    /// A direction of length 1 in it: ahead, aside, and upward.
    pub(super) fn direction(&self, [u, v]: [f64; 2]) -> [f64; 3] {
        let side = 2.0 * u - 1.0;
        let aside = self.chord_before(side.abs());
        let Chord { from, to, circle } = self.chord(aside);
        let inward = from + v * (to - from);
        let upward = self.sine * (inward * (2.0 * circle - inward * self.sine * self.sine)).sqrt();
        let aside = if side < 0.0 { -aside } else { aside };
        [circle - inward * self.sine * self.sine, aside * self.sine, upward]
    }

    /// How far aside chords go.
    fn end(&self) -> f64 {
        if self.height > 0.0 { 1.0 } else { self.end_of_rim }
    }

    fn chord(&self, aside: f64) -> Chord {
        let Self { height, sine, cosine, sine_of_way, end_of_rim, .. } = *self;
        let circle = ((1.0 - sine * aside) * (1.0 + sine * aside)).sqrt();
        let half_squared = (1.0 - aside) * (1.0 + aside);
        // The middle of the ellipse.
        let middle =
            (half_squared + cosine * cosine * height * height) / (circle + sine_of_way * cosine);
        let half = height * half_squared.sqrt();
        let from = if aside > end_of_rim { middle - half } else { 0.0 };
        let from = from.max(0.0);
        Chord { from, to: (middle + half).max(from), circle }
    }

    /// The area between the middle and a chord that is so far aside.
    fn area_up_to(&self, aside: f64) -> f64 {
        if aside <= self.end_of_rim {
            return self.area_from_circle(aside);
        }
        let beyond = segment(aside) - segment(self.end_of_rim);
        self.area_to_end + self.height * beyond
    }

    /// The same of chords that begin at the circle.
    fn area_from_circle(&self, aside: f64) -> f64 {
        let Self { height, sine, cosine, sine_of_way, .. } = *self;
        let least = (1.0 + cosine * cosine * height * height) / (1.0 + sine_of_way * cosine);
        aside * (least - aside * aside * below_line(sine * aside)) + 0.5 * height * segment(aside)
    }

    /// The chord up to which there is that share of the area.
    fn chord_before(&self, share: f64) -> f64 {
        let wanted = share * self.area;
        let (mut low, mut high) = (0.0, self.end());
        let mut aside = share * high;
        // Halving alone would be done by then.
        for _ in 0..60 {
            let missing = wanted - self.area_up_to(aside);
            if missing.abs() <= SLIGHT * self.area {
                break;
            }
            if missing > 0.0 {
                low = aside;
            } else {
                high = aside;
            }
            let Chord { from, to, .. } = self.chord(aside);
            let next = aside + missing / (to - from);
            aside = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        aside
    }
}

/// Twice the integral of sqrt(1 - s^2) from 0.
fn segment(s: f64) -> f64 {
    s * ((1.0 - s) * (1.0 + s)).sqrt() + libm::asin(s)
}

/// (x - the integral of sqrt(1 - s^2) from 0 to x) / x^3.
fn below_line(x: f64) -> f64 {
    let square = x * x;
    if square < 0.04 {
        // The binomial series: each term of sqrt(1 - s^2) is (2 n - 3) / (2 n) times s^2
        // times the one before.
        let (mut sum, mut term) = (0.0, 0.5);
        for n in 1..12 {
            let n = f64::from(n);
            sum += term / (2.0 * n + 1.0);
            term *= square * (2.0 * n - 1.0) / (2.0 * n + 2.0);
        }
        return sum;
    }
    (x - 0.5 * segment(x)) / (square * x)
}

#[cfg(test)]
impl Part {
    /// The projected solid angle, over pi times the squared sine.
    pub(super) fn mean_cosine(&self) -> f64 {
        2.0 * self.area * self.sine / std::f64::consts::PI
    }
}
