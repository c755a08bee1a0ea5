//! Convex bodies: what is within all of some surfaces. A line is within each on
//! one stretch, and within the body on what all the stretches share.

use super::cone::{Side, Within};
use super::dd::Dd;
use super::figure::{BAND, Crossing, Figure, NEAR, WAVER};
use super::space::{Line, Long};
use lancer_math::Point;

/// One of the surfaces.
#[derive(Debug)]
pub(crate) enum Face {
    /// A plane: a point on it and the unit normal, which points outward.
    Flat(Long, Long),
    /// A sphere.
    Ball(Long, Dd),
    /// A cylinder or a cone.
    Round(Side),
}

impl Face {
    pub(crate) fn plane(point: Long, normal: Long) -> Self {
        Self::Flat(point, normal.unit())
    }

    fn within(&self, line: &Line) -> Within {
        match self {
            Self::Flat(point, normal) => {
                let (speed, height) =
                    (normal.dot(line.direction), normal.dot(*point - line.origin));
                if speed.is_positive() {
                    Within::Between(-Dd::INFINITY, height / speed)
                } else if speed.is_negative() {
                    Within::Between(height / speed, Dd::INFINITY)
                } else {
                    // Whether it is outside throughout, `distance` says.
                    Within::Between(-Dd::INFINITY, Dd::INFINITY)
                }
            }
            Self::Ball(centre, radius) => {
                let middle = line.nearest_to(*centre);
                let aside = line.at(middle) - *centre;
                let below = radius.square() - aside.dot(aside);
                if below.is_negative() {
                    return Within::Never(middle);
                }
                let half = (below / line.direction.dot(line.direction)).sqrt();
                Within::Between(middle - half, middle + half)
            }
            Self::Round(side) => side.within(line),
        }
    }

    /// By how much t may be off where the line is off by its roundings. The face that
    /// is `met` needs it in its tip only; elsewhere it is judged by itself.
    fn waver(&self, line: &Line, t: Dd, met: bool) -> f64 {
        let tip = match self {
            Self::Round(side) => side.tip_cosine(line, t),
            _ => None,
        };
        let cosine = match tip {
            Some(cosine) => cosine,
            None if met => return 0.0,
            None => line.cosine(self.normal(line.at(t))),
        };
        WAVER * line.scale / (cosine * line.length)
    }

    fn distance(&self, point: Long) -> Dd {
        match self {
            Self::Flat(on, normal) => (point - *on).dot(*normal),
            Self::Ball(centre, radius) => (point - *centre).norm() - *radius,
            Self::Round(side) => side.distance(point),
        }
    }

    fn normal(&self, point: Long) -> Long {
        match self {
            Self::Flat(_, normal) => *normal,
            Self::Ball(centre, _) => (point - *centre).unit(),
            Self::Round(side) => side.normal(point),
        }
    }
}

/// What is within all of its faces; it has an end everywhere.
#[derive(Debug)]
pub(crate) struct Convex {
    faces: Vec<Face>,
    /// A ball around it.
    centre: Long,
    reach: f64,
}

impl Convex {
    pub(crate) fn new(faces: Vec<Face>, (centre, reach): (Point, f64)) -> Self {
        Self { faces, centre: Long::from(centre), reach }
    }

    /// The face that is farthest inward of a point, how far the point is outside
    /// of it, and how fast that grows along a line.
    fn outmost(&self, line: &Line, t: Dd) -> (f64, f64) {
        let point = line.at(t);
        let distances = self.faces.iter().map(|face| (face, face.distance(point)));
        let (face, distance) = distances
            .max_by(|(_, a), (_, b)| a.partial_cmp(b).expect("no NaN"))
            .expect("it has faces");
        (distance.round(), face.normal(point).dot(line.direction).round())
    }

    /// How near a line comes to the body that it misses, and where.
    ///
    /// The distance from the body's faces is a convex function along the line, so
    /// it lies above its tangents: where those at both ends of a stretch meet, it
    /// is evaluated next, until it is found or can no longer be of interest.
    fn clearance(&self, line: &Line) -> (Dd, f64) {
        let middle = line.nearest_to(self.centre);
        let half = Dd::from(4.0 * self.reach / line.length);
        let (mut low, mut high) = (middle - half, middle + half);
        let (mut at_low, mut at_high) = (self.outmost(line, low), self.outmost(line, high));
        for _ in 0..200 {
            if at_low.1 >= 0.0 {
                return (low, at_low.0);
            }
            if at_high.1 <= 0.0 {
                return (high, at_high.0);
            }
            let width = (high - low).round();
            let to = (at_low.0 - at_high.0 + at_high.1 * width) / (at_high.1 - at_low.1);
            let bound = at_low.0 + at_low.1 * to;
            // So near an end its tangent would be the old one again.
            let inside = to.clamp(1e-3 * width, (1.0 - 1e-3) * width);
            let t = low + Dd::from(inside);
            let (distance, slope) = self.outmost(line, t);
            if bound > NEAR * line.scale || distance - bound < 1e-3 * BAND * line.scale {
                return (t, distance.max(0.0));
            }
            if slope < 0.0 {
                (low, at_low) = (t, (distance, slope));
            } else {
                (high, at_high) = (t, (distance, slope));
            }
        }
        (low, at_low.0.min(at_high.0).max(0.0))
    }
}

impl Figure for Convex {
    fn crossings(&self, line: &Line, found: &mut Vec<Crossing>) {
        let (mut from, mut to) = (-Dd::INFINITY, Dd::INFINITY);
        let (mut first, mut last) = (0, 0);
        let stretches = self.faces.iter().map(|face| match face.within(line) {
            Within::Never(nearest) => (nearest, nearest),
            Within::Between(enters, leaves) => (enters, leaves),
        });
        let stretches: Vec<_> = stretches.collect();
        for (part, &(enters, leaves)) in stretches.iter().enumerate() {
            if enters > from {
                (from, first) = (enters, part);
            }
            if leaves < to {
                (to, last) = (leaves, part);
            }
        }
        let depth = if from < to {
            assert!(from.is_finite() && to.is_finite(), "no line stays within: {line:?}");
            -self.outmost(line, (from + to).half()).0
        } else {
            0.0
        };
        // In the middle it is at least half as deep as it is anywhere.
        let is_crossed = depth > 0.0;
        if is_crossed {
            // Near an edge, and in a tip, a face that is crossed at a smaller angle may
            // come first.
            let (mut sooner, mut later) = (0.0_f64, 0.0_f64);
            for (part, &(enters, leaves)) in stretches.iter().enumerate() {
                let waver = |t: Dd, met: usize| self.faces[part].waver(line, t, part == met);
                if enters.is_finite() {
                    later = later.max((enters - from).round() + waver(enters, first));
                }
                if leaves.is_finite() {
                    sooner = sooner.max((to - leaves).round() + waver(leaves, last));
                }
            }
            let margin = depth / line.scale;
            found.push(Crossing { slack: later, ..Crossing::new(from, first, true, margin) });
            found.push(Crossing { slack: sooner, ..Crossing::new(to, last, true, margin) });
        }
        if depth < NEAR * line.scale {
            let (nearest, aside) =
                if is_crossed { ((from + to).half(), depth) } else { self.clearance(line) };
            // Around an edge, or along a face, it may be any of them that is found.
            if aside < NEAR * line.scale {
                let margin = aside / line.scale;
                let parts = 0..self.faces.len();
                found.extend(parts.map(|part| Crossing::new(nearest, part, false, margin)));
            }
        }
    }

    fn side(&self, part: usize, point: Long) -> Dd {
        self.faces[part].distance(point)
    }

    fn off(&self, point: Long) -> f64 {
        let distances = self.faces.iter().map(|face| face.distance(point).round());
        distances.fold(f64::NEG_INFINITY, f64::max).abs()
    }

    fn normal(&self, part: usize, point: Long) -> Long {
        self.faces[part].normal(point)
    }

    fn parts_near(&self, point: Long, within: f64) -> Vec<usize> {
        let near = |part: &usize| self.faces[*part].distance(point).round().abs() <= within;
        (0..self.faces.len()).filter(near).collect()
    }

    fn is_closed(&self) -> bool {
        true
    }
}
