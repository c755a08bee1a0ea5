use crate::{Point, Vector};

/// A half-line: where it starts and which way it goes.
///
/// The direction is a unit vector wherever a distance along the ray is meant
/// as a length; nothing here enforces that, because reflecting a direction
/// keeps its length only up to rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where the ray starts.
    pub origin: Point,
    /// Which way it goes.
    pub direction: Vector,
}

impl Ray {
    /// A ray from `origin` along `direction`, both taken as they are.
    #[must_use]
    pub const fn new(origin: Point, direction: Vector) -> Self {
        Self { origin, direction }
    }

    /// The point `distance` directions away from the origin; behind it where
    /// `distance` is negative.
    #[inline]
    #[must_use]
    pub fn at(&self, distance: f64) -> Point {
        self.origin + self.direction * distance
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walks_forwards_and_backwards() {
        let ray = Ray::new(Point::new(1.0, 2.0, 3.0), Vector::new(0.0, -2.0, 0.5));
        assert_eq!(ray.at(0.0), ray.origin);
        assert_eq!(ray.at(2.0), Point::new(1.0, -2.0, 4.0));
        assert_eq!(ray.at(-2.0), Point::new(1.0, 6.0, 2.0));
    }
}
