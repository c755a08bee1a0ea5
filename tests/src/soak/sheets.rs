//! Surfaces with edges: pieces of planes, and sides of cones without lids.

use super::cone::{Side, Within};
use super::dd::Dd;
use super::figure::{Crossing, Figure, NEAR};
use super::space::{Line, Long};

/// How far a plane reaches.
#[derive(Debug)]
pub(crate) enum Outline {
    Endless,
    Circle(Dd),
    /// Points on the edges with unit vectors across them, outward in the plane.
    Polygon(Vec<(Long, Long)>),
}

/// A plane, or a piece of one.
#[derive(Debug)]
pub(crate) struct Flat {
    pub(crate) point: Long,
    /// Of unit length.
    pub(crate) normal: Long,
    pub(crate) outline: Outline,
}

impl Flat {
    /// The inside of a convex polygon, with its corners anticlockwise seen from the
    /// side to which the normal points.
    pub(crate) fn polygon(corners: &[Long]) -> Self {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).unit();
        let next = corners.iter().cycle().skip(1);
        let edges = corners.iter().zip(next).map(|(&from, &to)| {
            let outward = (to - from).cross(normal).unit();
            (from, outward)
        });
        Self { point: corners[0], normal, outline: Outline::Polygon(edges.collect()) }
    }

    /// How far a point of the plane is beyond each edge; negative inside.
    pub(crate) fn beyond(&self, point: Long) -> Vec<f64> {
        match &self.outline {
            Outline::Endless => vec![f64::NEG_INFINITY],
            Outline::Circle(radius) => vec![((point - self.point).norm() - *radius).round()],
            Outline::Polygon(edges) => {
                edges.iter().map(|(on, outward)| (point - *on).dot(*outward).round()).collect()
            }
        }
    }

    /// Where the line meets the plane, and |cos| there; `None` where it does not.
    pub(crate) fn meets(&self, line: &Line) -> Option<(Dd, f64)> {
        let speed = self.normal.dot(line.direction);
        let t = self.normal.dot(self.point - line.origin) / speed;
        (!speed.is_zero()).then(|| (t, line.cosine(self.normal)))
    }
}

impl Figure for Flat {
    fn crossings(&self, line: &Line, found: &mut Vec<Crossing>) {
        let Some((t, cosine)) = self.meets(line) else {
            let off = self.side(0, line.origin).round().abs() / line.scale;
            if matches!(self.outline, Outline::Endless) {
                // It may meet the plane very far away.
                found.push(Crossing::new(Dd::INFINITY, 0, false, 0.0));
            } else if off < NEAR {
                let t = line.nearest_to(self.point);
                found.push(Crossing::new(t, 0, false, off));
            }
            return;
        };
        // Moving the ray moves the crossing by 1 / |cos| of that.
        let beyond = self.beyond(line.at(t)).into_iter().fold(f64::NEG_INFINITY, f64::max);
        let margin = match self.outline {
            Outline::Endless => cosine,
            _ => beyond.abs() * cosine / line.scale,
        };
        if beyond <= 0.0 || margin < NEAR {
            found.push(Crossing::new(t, 0, beyond <= 0.0, margin));
        }
    }

    fn side(&self, _: usize, point: Long) -> Dd {
        (point - self.point).dot(self.normal)
    }

    fn off(&self, point: Long) -> f64 {
        let aside = self.side(0, point).round().abs();
        self.beyond(point).into_iter().fold(aside, f64::max)
    }

    fn normal(&self, _: usize, _: Long) -> Long {
        self.normal
    }

    fn is_closed(&self) -> bool {
        false
    }
}

/// A cylinder, cone or frustum without lids.
#[derive(Debug)]
pub(crate) struct Tube(pub(crate) Side);

impl Figure for Tube {
    fn crossings(&self, line: &Line, found: &mut Vec<Crossing>) {
        let side = &self.0;
        let (ends, depth) = match side.within(line) {
            Within::Never(nearest) => ([nearest; 2], side.distance(line.at(nearest)).round().abs()),
            Within::Between(from, to) if from.is_finite() && to.is_finite() => {
                let depth = side.distance(line.at((from + to).half()));
                ([from, to], depth.round().abs())
            }
            Within::Between(from, to) if from.is_finite() || to.is_finite() => {
                ([from, to], f64::INFINITY)
            }
            // Parallel to a cylinder's axis, and perhaps in its surface.
            Within::Between(..) => {
                let beside = line.nearest_to(side.middle());
                ([beside; 2], side.distance(line.at(beside)).round().abs())
            }
        };
        let crosses = ends[0] < ends[1];
        for t in ends.into_iter().filter(|t| t.is_finite()) {
            let point = line.at(t);
            let along = side.along(point);
            let short_of_end = (along.min(Dd::ONE - along) * side.height()).round();
            let to_edge = short_of_end.abs() * line.cosine(side.normal(point));
            let margin = to_edge.min(depth) / line.scale;
            let is_there = crosses && short_of_end >= 0.0;
            // Whether it fails in one way or in two, it is there only if it has none.
            let misses = if crosses { to_edge } else { depth } / line.scale;
            if is_there {
                found.push(Crossing::new(t, 0, true, margin));
            } else if misses < NEAR {
                found.push(Crossing::new(t, 0, false, misses));
            }
        }
    }

    fn side(&self, _: usize, point: Long) -> Dd {
        self.0.distance(point)
    }

    fn off(&self, point: Long) -> f64 {
        let along = self.0.along(point);
        let beyond = -along.min(Dd::ONE - along) * self.0.height();
        self.0.distance(point).round().abs().max(beyond.round())
    }

    fn normal(&self, _: usize, point: Long) -> Long {
        self.0.normal(point)
    }

    fn is_closed(&self) -> bool {
        false
    }
}
