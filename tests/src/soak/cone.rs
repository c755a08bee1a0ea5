//! The curved side of cylinders, cones and frustums: the points whose distance
//! from the axis is a linear function of where they are along it.

use super::dd::Dd;
use super::figure::WAVER;
use super::space::{Line, Long};
use lancer_math::Vector;

#[derive(Debug)]
pub(crate) struct Side {
    base: Long,
    /// From the base to the top.
    axis: Long,
    axis_squared: Dd,
    height: Dd,
    radius: Dd,
    /// How much larger the radius at the top is.
    widening: Dd,
    /// The length of a straight line on it, from end to end.
    slant: Dd,
    /// A unit vector across the axis.
    across: Long,
}

/// Where a line is within the side, which has no ends here.
pub(crate) enum Within {
    /// Nowhere; at this t it comes nearest.
    Never(Dd),
    /// Between these, which may be infinite. Where there is no crossing at all,
    /// both are.
    Between(Dd, Dd),
}

impl Side {
    pub(crate) fn new(base: Long, top: Long, [base_radius, top_radius]: [f64; 2]) -> Self {
        let axis = top - base;
        let axis_squared = axis.dot(axis);
        let widening = Dd::from(top_radius) - Dd::from(base_radius);
        Self {
            base,
            axis,
            axis_squared,
            height: axis_squared.sqrt(),
            radius: Dd::from(base_radius),
            widening,
            slant: (axis_squared + widening.square()).sqrt(),
            across: axis.cross(Long::from(Vector::ith(axis.round().iamin(), 1.0))).unit(),
        }
    }

    pub(crate) fn height(&self) -> Dd {
        self.height
    }

    pub(crate) fn middle(&self) -> Long {
        self.base + self.axis.times(Dd::ONE.half())
    }

    /// How far along the axis: 0 at the base, 1 at the top.
    pub(crate) fn along(&self, point: Long) -> Dd {
        (point - self.base).dot(self.axis) / self.axis_squared
    }

    /// From the axis to the point, at a right angle.
    fn radial(&self, point: Long) -> Long {
        point - self.base - self.axis.times(self.along(point))
    }

    fn radius_at(&self, along: Dd) -> Dd {
        self.radius + self.widening * along
    }

    /// The distance, positive outside.
    pub(crate) fn distance(&self, point: Long) -> Dd {
        let beyond = self.radial(point).norm() - self.radius_at(self.along(point));
        beyond * self.height / self.slant
    }

    /// The unit vector away from the axis; on the axis, but for roundings, any is as good.
    fn outward(&self, point: Long) -> Long {
        let radial = self.radial(point);
        let is_apart = radial.norm().round() > 1e-22 * self.slant.round();
        if is_apart { radial.unit() } else { self.across }
    }

    pub(crate) fn normal(&self, point: Long) -> Long {
        let out = self.outward(point).times(self.height * self.height);
        (out - self.axis.times(self.widening)).times(Dd::ONE / (self.height * self.slant))
    }

    /// Where radial^2 - radius^2 is not positive and the radius is not negative.
    pub(crate) fn within(&self, line: &Line) -> Within {
        match self.roots(line) {
            Within::Between(from, to) => {
                Within::Between(self.polished(line, from), self.polished(line, to))
            }
            never @ Within::Never(_) => never,
        }
    }

    /// Closer to the side, by two steps of Newton's method for the distance: the quadratic
    /// of a flat cone has lost digits that this still has.
    fn polished(&self, line: &Line, t: Dd) -> Dd {
        let step = |t: Dd| {
            let point = line.at(t);
            let speed = self.normal(point).dot(line.direction);
            let next = t - self.distance(point) / speed;
            // Where it turns, or in the tip, it may lead anywhere.
            let by = (next - t).abs().round() * line.length;
            if by <= 1e-12 * line.scale { next } else { t }
        };
        if t.is_finite() { step(step(t)) } else { t }
    }

    fn roots(&self, line: &Line) -> Within {
        let from = line.origin - self.base;
        let axial = from.dot(self.axis) / self.axis_squared;
        let axial_speed = line.direction.dot(self.axis) / self.axis_squared;
        let (radius, radius_speed) = (self.radius_at(axial), self.widening * axial_speed);
        let out = from - self.axis.times(axial);
        let out_speed = line.direction - self.axis.times(axial_speed);
        // a t^2 + 2 b t + c.
        let a = out_speed.dot(out_speed) - radius_speed.square();
        let b = out.dot(out_speed) - radius * radius_speed;
        let c = out.dot(out) - radius.square();
        let below = b.square() - a * c;
        if below.is_negative() && a.is_positive() {
            return Within::Never(-b / a);
        }
        let root = below.sqrt();
        let larger = if b.is_negative() { root - b } else { -(root + b) };
        if a.is_positive() {
            // Of the two cones that meet at the tip only one is meant.
            if (radius - radius_speed * b / a).is_negative() {
                return Within::Never(line.nearest_to(self.tip()));
            }
            let (t, other) = (larger / a, if larger.is_zero() { -b / a } else { c / larger });
            return Within::Between(t.min(other), if other > t { other } else { t });
        }
        if radius_speed.is_zero() {
            // Along the axis of a cylinder: all of it or nothing, as `distance` says.
            return Within::Between(-Dd::INFINITY, Dd::INFINITY);
        }
        // Steeper than the side, or along it: from there on inwards to no end.
        let widens = radius_speed.is_positive();
        let (near, far) = (c / larger, larger / a);
        let t = match (a.is_zero() || !far.is_finite(), widens) {
            (true, _) => near,
            (false, true) if far > near => far,
            (false, false) if far < near => far,
            _ => near,
        };
        if widens { Within::Between(t, Dd::INFINITY) } else { Within::Between(-Dd::INFINITY, t) }
    }

    /// Where a line crosses the side in its tip, which has no normal: the least |cos|
    /// of those around it.
    pub(crate) fn tip_cosine(&self, line: &Line, t: Dd) -> Option<f64> {
        if self.widening.is_zero() {
            return None;
        }
        let tip = self.tip();
        let from_tip = (line.at(t) - tip).norm().round();
        let cosine = |way: Long| line.cosine(self.normal(tip + way));
        (from_tip <= 100.0 * WAVER * line.scale)
            .then(|| cosine(line.direction).min(cosine(-line.direction)))
    }

    fn tip(&self) -> Long {
        self.base - self.axis.times(self.radius / self.widening)
    }
}
