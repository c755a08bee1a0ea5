//! Points of a ball lamp, drawn so that each tells equally much of its light.

use super::Ball;
use super::part::Part;
use crate::disc::in_disc;
use lancer_math::Vector;

impl Ball {
    /// From the surface's point to a point of the lamp that is seen from there, for two
    /// numbers from 0 to 1 that are evenly distributed; none where it is behind the facet.
    ///
    /// Directions are distributed as their projected solid angle is, among those that are
    /// above the horizon of the normal. So the light that arrives is the mean of what it
    /// would be with nothing hidden, times 1 or 0 as the point is seen or hidden: without
    /// noise where all or nothing is seen.
    pub(in crate::whitted) fn point(&self, numbers: [f64; 2]) -> Option<Vector> {
        let way = self.any_point(numbers);
        (self.is_before_facet() || way.dot(&self.facet) > 0.0).then_some(way)
    }

    /// The same whatever the facet hides.
    pub(super) fn any_point(&self, numbers: [f64; 2]) -> Vector {
        if self.is_inside() {
            self.around(numbers)
        } else if self.along >= self.radius {
            self.whole(numbers)
        } else {
            self.cut(numbers)
        }
    }

    /// From inside all directions are equal, and a point of the horizon's disc stands for
    /// what is above it (Malley's method).
    fn around(&self, numbers: [f64; 2]) -> Vector {
        let [x, y] = in_disc(numbers);
        let height = (1.0 - x * x - y * y).max(0.0).sqrt();
        let (ahead, aside, _) = self.frame();
        let direction = ahead * x + aside * y + self.normal * height;
        let along = self.way.dot(&direction);
        // That of the tangent, squared and negative: positive inside.
        let power = (self.radius - self.distance) * (self.radius + self.distance);
        let root = (along * along + power).sqrt();
        direction * if along > 0.0 { along + root } else { power / (root - along) }
    }

    /// A ball that is wholly above the horizon is, projected onto the horizon's plane, an
    /// ellipse.
    ///
    /// Its point for a point (p, q) of a disc is `sine cosine p` beyond its centre, and
    /// `sine q` aside. The direction above it is found as what it has more along
    /// the middle than the rim of the ball, `more`, a root of a quadratic equation without
    /// cancellation, and what it has across.
    fn whole(&self, numbers: [f64; 2]) -> Vector {
        let [p, q] = in_disc(numbers);
        let (ahead, aside, sine_of_way) = self.frame();
        let cosine_of_way = self.along / self.distance;
        let (sine, tangent) = (self.radius / self.distance, self.tangent());
        let depth = sine * sine * (1.0 - p * p - q * q).max(0.0);
        // The height of the ellipse's point in the plane of the rim; not below the horizon.
        let rim = (tangent * cosine_of_way - sine * p * sine_of_way).max(0.0);
        let by = rim + (rim * rim + depth).sqrt();
        // Where both are zero the ball touches the horizon there, at its rim.
        let per = if by > 0.0 { depth / by } else { 0.0 };
        let (more, across) = (per * cosine_of_way, sine * p - per * sine_of_way);
        let downward = ahead * cosine_of_way - self.normal * sine_of_way;
        let direction =
            self.way * ((tangent + more) / self.distance) + downward * across + aside * (sine * q);
        direction * self.nearest(tangent + more, (more * (2.0 * tangent + more)).sqrt())
    }

    /// A ball that the horizon cuts; see [`Part`].
    fn cut(&self, numbers: [f64; 2]) -> Vector {
        let (ahead, aside, _) = self.frame();
        let (sine, height) = (self.radius / self.distance, self.along / self.radius);
        let part = Part::new(height, sine, self.tangent());
        let [x, y, z] = part.direction(numbers);
        let (cosine_of_way, sine_of_way) = (sine * height, part.sine_of_way());
        let middle = x * sine_of_way + z * cosine_of_way;
        let across = x * cosine_of_way - z * sine_of_way;
        // The squared sine of the angle to the rim, without cancellation.
        let half = ((sine - y) * (sine + y)).max(0.0).sqrt();
        let inside = ((half - across) * (half + across)).max(0.0);
        let direction = ahead * x + aside * y + self.normal * z;
        direction * self.nearest(middle, inside.sqrt())
    }

    /// How far the ball is in a direction of length 1 of which `middle` is along the way
    /// to its centre, where it is `half` its own chord over its distance.
    fn nearest(&self, middle: f64, half: f64) -> f64 {
        let Self { radius, distance, .. } = *self;
        (distance - radius) * ((distance + radius) / distance) / (middle + half)
    }

    /// Two directions in the horizon's plane, of length 1, the first one to where the
    /// centre is above; and the sine of the angle between the normal and the way to it.
    pub(super) fn frame(&self) -> (Vector, Vector, f64) {
        let Self { normal, way, along, distance, .. } = *self;
        let flat = way - normal * along;
        // Once more, since there may be little left but roundings.
        let flat = flat - normal * flat.dot(&normal);
        let length = flat.norm();
        let ahead = if length > 0.0 { flat / length } else { across(&normal) };
        (ahead, normal.cross(&ahead), length / distance)
    }
}

/// A direction of length 1 across that of length 1.
fn across(normal: &Vector) -> Vector {
    let axis = if normal.x.abs() <= normal.y.abs().min(normal.z.abs()) {
        Vector::x()
    } else if normal.y.abs() <= normal.z.abs() {
        Vector::y()
    } else {
        Vector::z()
    };
    let across = normal.cross(&axis);
    across / across.norm()
}
