//! The curved side of cylinders, cones and frustums: the points whose distance
//! from the axis is a linear function of where they are along it.

use crate::dd::Dd;
use crate::space::{Line, Long};

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
        }
    }

    pub(crate) fn height(&self) -> Dd {
        self.height
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

    pub(crate) fn normal(&self, point: Long) -> Long {
        let out = self.radial(point).unit().times(self.height * self.height);
        (out - self.axis.times(self.widening)).times(Dd::ONE / (self.height * self.slant))
    }

    /// Where radial^2 - radius^2 is not positive and the radius is not negative.
    pub(crate) fn within(&self, line: &Line) -> Within {
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
        let mut roots = Vec::with_capacity(2);
        if !a.is_zero() {
            roots.push(larger / a);
        }
        if !larger.is_zero() {
            roots.push(c / larger);
        }
        // Of the two cones that meet at the tip only one is meant.
        roots.retain(|&t| t.is_finite() && !(radius + radius_speed * t).is_negative());
        roots.sort_by(|x, y| x.partial_cmp(y).expect("both are finite"));
        match roots[..] {
            [from, to] => Within::Between(from, to),
            [only] if (a * only + b).is_negative() => Within::Between(only, Dd::INFINITY),
            [only] => Within::Between(-Dd::INFINITY, only),
            _ if self.widening.is_zero() && a.is_zero() && !c.is_positive() => {
                Within::Between(-Dd::INFINITY, Dd::INFINITY)
            }
            _ if self.widening.is_zero() => Within::Never(line.nearest_to(self.base)),
            _ => Within::Never(line.nearest_to(self.tip())),
        }
    }

    fn tip(&self) -> Long {
        self.base - self.axis.times(self.radius / self.widening)
    }
}
