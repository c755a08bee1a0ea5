//! The ring: zeros of its implicit function, a quartic along a line, and its
//! exact distance.

use super::dd::Dd;
use super::figure::{Crossing, Figure};
use super::quartic::{turning_points, zero_between};
use super::space::{Line, Long};

#[derive(Debug)]
pub(crate) struct Ring {
    pub(crate) centre: Long,
    /// Of unit length.
    pub(crate) axis: Long,
    pub(crate) ring: Dd,
    pub(crate) tube: Dd,
}

impl Ring {
    /// From the nearest point of the circle within the tube to the point.
    fn beyond_circle(&self, point: Long) -> Long {
        let from = point - self.centre;
        let outward = from - self.axis.times(from.dot(self.axis));
        from - outward.unit().times(self.ring)
    }

    fn distance(&self, point: Long) -> Dd {
        let from = point - self.centre;
        let height = from.dot(self.axis);
        // The square may come out below zero on the axis; its root is then 0.
        let out = (from - self.axis.times(height)).norm() - self.ring;
        (out.square() + height.square()).sqrt() - self.tube
    }
}

impl Figure for Ring {
    fn crossings(&self, line: &Line, found: &mut Vec<Crossing>) {
        // From where the line is nearest to the centre, by lengths.
        let length = line.direction.norm();
        let direction = line.direction.times(Dd::ONE / length);
        let nearest = line.nearest_to(self.centre);
        let from = line.at(nearest) - self.centre;
        let reach = self.ring + self.tube;
        if from.norm() > reach.twice() {
            return;
        }
        // (|p|^2 + ring^2 - tube^2)^2 - 4 ring^2 (|p|^2 - (p . axis)^2), as
        // (x^2 + 2 b x + c)^2 - 4 ring^2 (x^2 + 2 b x + d - (h + s x)^2).
        let (b, squared) = (from.dot(direction), from.dot(from));
        let (h, s) = (from.dot(self.axis), direction.dot(self.axis));
        let c = squared + self.ring.square() - self.tube.square();
        let four = self.ring.square().twice().twice();
        let quartic = [
            c.square() - four * (squared - h.square()),
            (b * c).twice().twice() - four * (b - h * s).twice(),
            (b.square().twice() + c).twice() - four * (Dd::ONE - s.square()),
            b.twice().twice(),
            Dd::ONE,
        ];
        // Where it comes near the surface without crossing it, or leaves it again at
        // once, the function turns: there the distance says by how much.
        let points = turning_points(&quartic, (-reach.twice(), reach.twice()));
        let last = points.len() - 1;
        let place = |x: Dd| nearest + x / length;
        let clear = |i: usize| match i {
            0 => f64::INFINITY,
            _ if i == last => f64::INFINITY,
            _ => self.distance(line.at(place(points[i]))).round().abs() / line.scale,
        };
        let clearances: Vec<f64> = (0..points.len()).map(clear).collect();
        for i in 0..last {
            let margin = clearances[i].min(clearances[i + 1]);
            if let Some(x) = zero_between(&quartic, (points[i], points[i + 1])) {
                found.push(Crossing::new(place(x), 0, true, margin));
            } else if clearances[i] < super::figure::NEAR {
                found.push(Crossing::new(place(points[i]), 0, false, clearances[i]));
            }
        }
    }

    fn side(&self, _: usize, point: Long) -> Dd {
        self.distance(point)
    }

    fn off(&self, point: Long) -> f64 {
        self.distance(point).round().abs()
    }

    fn normal(&self, _: usize, point: Long) -> Long {
        self.beyond_circle(point).unit()
    }

    fn is_closed(&self) -> bool {
        true
    }
}
