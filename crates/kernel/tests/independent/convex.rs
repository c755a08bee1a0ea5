//! Convex bodies: what is within all of some surfaces. A line is within each on
//! one stretch, and within the body on what all the stretches share.

use crate::cone::{Side, Within};
use crate::dd::Dd;
use crate::figure::{BAND, Crossing, Figure};
use crate::space::{Line, Long};

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
                let (speed, height) = (normal.dot(line.direction), normal.dot(*point - line.origin));
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
}

impl Convex {
    pub(crate) fn new(faces: Vec<Face>) -> Self {
        Self { faces }
    }
}

impl Figure for Convex {
    fn crossings(&self, line: &Line, found: &mut Vec<Crossing>) {
        let (mut from, mut to) = (-Dd::INFINITY, Dd::INFINITY);
        let (mut first, mut last) = (0, 0);
        for (part, face) in self.faces.iter().enumerate() {
            let (enters, leaves) = match face.within(line) {
                Within::Never(nearest) => (nearest, nearest),
                Within::Between(enters, leaves) => (enters, leaves),
            };
            if enters > from {
                (from, first) = (enters, part);
            }
            if leaves < to {
                (to, last) = (leaves, part);
            }
        }
        assert!(from.is_finite() && to.is_finite(), "no line stays within: {line:?}");
        let middle = (from + to).half();
        let at = line.at(middle);
        let distances: Vec<f64> = self.faces.iter().map(|f| f.distance(at).round()).collect();
        if from < to && distances.iter().all(|d| *d < 0.0) {
            // The stretch between two planes is as deep in the middle as half the
            // way there times the smaller cosine, which is within a factor of two
            // of what it takes to push the line out.
            let depth = -distances.iter().fold(f64::NEG_INFINITY, |a, &b| a.max(b));
            found.push(Crossing::new(from, first, true, depth / line.scale));
            found.push(Crossing::new(to, last, true, depth / line.scale));
            return;
        }
        // In the middle of the gap the line is outside of both surfaces between
        // which it slips through; the nearer one says how far it must be moved,
        // unless it is farther from a third.
        let between = distances[first].min(distances[last]).max(0.0);
        let others = distances.iter().enumerate().filter(|(part, _)| ![first, last].contains(part));
        let aside = others.fold(between, |a, (_, &b)| a.max(b)) / line.scale;
        if aside < BAND {
            let outside = distances.iter().enumerate().filter(|(_, d)| **d / line.scale > -BAND);
            found.extend(outside.map(|(part, _)| Crossing::new(middle, part, false, aside)));
        }
    }

    fn side(&self, part: usize, point: Long) -> Dd {
        self.faces[part].distance(point)
    }

    fn normal(&self, part: usize, point: Long) -> Long {
        self.faces[part].normal(point)
    }

    fn is_closed(&self) -> bool {
        true
    }
}
