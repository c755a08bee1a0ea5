//! Vectors of long numbers, and where a group of shapes stands.

use super::dd::Dd;
use lancer_math::{Placement, Point, Ray, Vector};
use std::ops::{Add, Neg, Sub};

/// A vector, or a point as the vector to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Long(pub(crate) [Dd; 3]);

impl Long {
    pub(crate) fn times(self, factor: Dd) -> Self {
        Self(self.0.map(|c| c * factor))
    }

    pub(crate) fn dot(self, other: Self) -> Dd {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        a * x + b * y + c * z
    }

    pub(crate) fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    pub(crate) fn norm(self) -> Dd {
        self.dot(self).sqrt()
    }

    /// Of length 1; that of length 0 stays as it is.
    pub(crate) fn unit(self) -> Self {
        let norm = self.norm();
        if norm.is_zero() { self } else { self.times(Dd::ONE / norm) }
    }

    pub(crate) fn round(self) -> Vector {
        Vector::from(self.0.map(Dd::round))
    }
}

impl From<Vector> for Long {
    fn from(v: Vector) -> Self {
        Self([v.x, v.y, v.z].map(Dd::from))
    }
}

impl From<Point> for Long {
    fn from(p: Point) -> Self {
        Self::from(p.coords)
    }
}

impl Add for Long {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a + x, b + y, c + z])
    }
}

impl Neg for Long {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.map(|c| -c))
    }
}

impl Sub for Long {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

/// The exact inverse of the map that a [`Placement`] holds: what is asked is
/// where its very matrix puts a shape, so the inverse that it carries along,
/// whose last bits are others, is not used.
#[derive(Debug)]
pub(crate) struct Frame {
    inverse: [Long; 3],
    offset: Long,
    /// By how much the roundings of a local coordinate may grow on its way to
    /// the world and back; 1 where nothing is moved.
    pub(crate) growth: f64,
    pub(crate) is_identity: bool,
}

impl Frame {
    pub(crate) fn new(placement: &Placement) -> Self {
        let columns = [Vector::x(), Vector::y(), Vector::z()].map(|e| placement.vector(&e));
        let [a, b, c] = columns.map(Long::from);
        let by = Dd::ONE / a.dot(b.cross(c));
        let inverse = [b.cross(c).times(by), c.cross(a).times(by), a.cross(b).times(by)];
        let there_and_back = inverse.map(|row| {
            let row = row.round().abs();
            columns.iter().map(|column| row.dot(&column.abs())).sum::<f64>()
        });
        let is_identity = placement.is_identity();
        Self {
            inverse,
            offset: Long::from(placement.point(&Point::origin())),
            growth: if is_identity { 1.0 } else { there_and_back.into_iter().fold(1.0, f64::max) },
            is_identity,
        }
    }

    pub(crate) fn local_vector(&self, v: Long) -> Long {
        if self.is_identity { v } else { Long(self.inverse.map(|row| row.dot(v))) }
    }

    pub(crate) fn local_point(&self, p: Long) -> Long {
        if self.is_identity { p } else { self.local_vector(p - self.offset) }
    }

    /// The normal outside, of any length: the one by which the first-order
    /// change of a local distance is what moves outside make of it.
    pub(crate) fn normal(&self, n: Long) -> Long {
        if self.is_identity {
            return n;
        }
        let [a, b, c] = self.inverse;
        let [x, y, z] = n.0;
        a.times(x) + b.times(y) + c.times(z)
    }

    pub(crate) fn local(&self, ray: &Ray) -> (Long, Long) {
        let (origin, direction) = (Long::from(ray.origin), Long::from(ray.direction));
        (self.local_point(origin), self.local_vector(direction))
    }
}

/// A ray in the space of a shape.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Line {
    pub(crate) origin: Long,
    pub(crate) direction: Long,
    /// The length of the direction.
    pub(crate) length: f64,
    /// The size of what the ray's numbers are held against: the lengths by
    /// which their roundings count.
    pub(crate) scale: f64,
    /// How many times that the roundings of its direction count.
    pub(crate) growth: f64,
    /// How far its origin is from the middle of the shape, and the size of that.
    pub(crate) size: f64,
}

impl Line {
    pub(crate) fn at(&self, t: Dd) -> Long {
        self.origin + self.direction.times(t)
    }

    /// Where it comes nearest to a point.
    pub(crate) fn nearest_to(&self, point: Long) -> Dd {
        (point - self.origin).dot(self.direction) / self.direction.dot(self.direction)
    }

    /// |cos| of the angle to a unit normal.
    pub(crate) fn cosine(&self, normal: Long) -> f64 {
        (normal.dot(self.direction).round() / self.length).abs()
    }
}
