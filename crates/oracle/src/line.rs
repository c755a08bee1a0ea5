//! Lines, and the spaces that they are seen from.

use crate::{Number, Triple};
use lancer_math::{Placement, Point, Ray, Vector};

/// A line with a place for each number t: origin + t direction. Nothing is
/// assumed of the direction's length, so t is a length only where it is 1.
#[derive(Clone, Debug)]
pub struct Line {
    /// Where t is 0.
    pub origin: Triple,
    /// What t is counted in.
    pub direction: Triple,
}

impl Line {
    /// The place of `t`.
    #[must_use]
    pub fn at(&self, t: &Number) -> Triple {
        &self.origin + &self.direction.times(t)
    }
}

impl From<&Ray> for Line {
    fn from(ray: &Ray) -> Self {
        Self { origin: ray.origin.into(), direction: ray.direction.into() }
    }
}

/// How a shape's own space lies in the world: matrix times local plus offset.
///
/// Division would leave the exact numbers, so the way back does without: it
/// leads to the local space stretched by [`stretch`](Self::stretch), the size of
/// the determinant, and shapes are stretched likewise. A line's t means the same
/// in all of them.
#[derive(Clone, Debug)]
pub struct Space {
    columns: [Triple; 3],
    offset: Triple,
    /// Rows of the inverse matrix, stretched.
    inverse: [Triple; 3],
    stretch: Number,
}

impl Space {
    /// The world itself.
    #[must_use]
    pub fn world() -> Self {
        let [x, y, z] = [Vector::x(), Vector::y(), Vector::z()].map(Triple::from);
        Self::new([x, y, z], Triple::zero())
    }

    fn new(columns: [Triple; 3], offset: Triple) -> Self {
        let [a, b, c] = &columns;
        // Cramer's rule.
        let inverse = [b.cross(c), c.cross(a), a.cross(b)];
        let determinant = a.dot(&inverse[0]);
        let inverse = if determinant.signum() < 0 { inverse.map(|row| -&row) } else { inverse };
        Self { columns, offset, inverse, stretch: determinant.abs() }
    }

    /// The space that `placement` puts into this one.
    #[must_use]
    pub fn inside(&self, placement: &Placement) -> Self {
        let axes = [Vector::x(), Vector::y(), Vector::z()];
        let columns = axes.map(|axis| self.vector(&placement.vector(&axis).into()));
        let offset = placement.point(&Point::origin()).into();
        Self::new(columns, &self.vector(&offset) + &self.offset)
    }

    /// How much larger the space of [`line`](Self::line) is than the shape's own.
    #[must_use]
    pub fn stretch(&self) -> &Number {
        &self.stretch
    }

    /// The displacement in the world of a local one.
    #[must_use]
    pub fn vector(&self, local: &Triple) -> Triple {
        let [x, y, z] = &local.0;
        let [a, b, c] = &self.columns;
        &(&a.times(x) + &b.times(y)) + &c.times(z)
    }

    fn stretched(&self, v: &Triple) -> Triple {
        Triple(self.inverse.each_ref().map(|row| row.dot(v)))
    }

    /// A point of the world in the stretched local space.
    #[must_use]
    pub fn local_point(&self, p: &Triple) -> Triple {
        self.stretched(&(p - &self.offset))
    }

    /// A line of the world in the stretched local space.
    #[must_use]
    pub fn line(&self, line: &Line) -> Line {
        Line { origin: self.local_point(&line.origin), direction: self.stretched(&line.direction) }
    }

    /// The direction in the world, of any length, of a local normal.
    #[must_use]
    pub fn normal(&self, local: &Triple) -> Triple {
        let [x, y, z] = &local.0;
        let [a, b, c] = &self.inverse;
        &(&a.times(x) + &b.times(y)) + &c.times(z)
    }

    /// The local normal, of any length, of a direction in the world.
    #[must_use]
    pub fn local_normal(&self, n: &Triple) -> Triple {
        Triple(self.columns.each_ref().map(|column| column.dot(n)))
    }

    /// A length of the shape's own space, stretched.
    #[must_use]
    pub fn length(&self, length: f64) -> Number {
        Number::from(length) * &self.stretch
    }

    /// A point of the shape's own space, stretched.
    #[must_use]
    pub fn point(&self, point: impl Into<Triple>) -> Triple {
        point.into().times(&self.stretch)
    }
}
