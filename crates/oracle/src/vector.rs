//! Triples of exact numbers.

use crate::Number;
use lancer_math::{Point, Vector};
use std::ops::{Add, Neg, Sub};

/// A point, displacement or direction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Triple(pub [Number; 3]);

impl Triple {
    /// 0 in each coordinate.
    #[must_use]
    pub fn zero() -> Self {
        Self([Number::zero(), Number::zero(), Number::zero()])
    }

    /// Whether each coordinate is 0.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.iter().all(Number::is_zero)
    }

    /// The scalar product.
    #[must_use]
    pub fn dot(&self, other: &Self) -> Number {
        let [a, b, c] = &self.0;
        let [x, y, z] = &other.0;
        a * x + b * y + c * z
    }

    /// The vector product.
    #[must_use]
    pub fn cross(&self, other: &Self) -> Self {
        let [a, b, c] = &self.0;
        let [x, y, z] = &other.0;
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    /// Each coordinate times `factor`.
    #[must_use]
    pub fn times(&self, factor: &Number) -> Self {
        Self(self.0.each_ref().map(|c| c * factor))
    }

    /// The square of its length.
    #[must_use]
    pub fn norm_squared(&self) -> Number {
        self.dot(self)
    }

    /// Its length.
    #[must_use]
    pub fn norm(&self, bits: usize) -> Number {
        self.norm_squared().root(bits)
    }

    /// The vector of length 1 in its direction.
    ///
    /// # Panics
    /// Where it is zero.
    #[must_use]
    pub fn unit(&self, bits: usize) -> Self {
        let norm = self.norm(bits + 8);
        Self(self.0.each_ref().map(|c| c.over(&norm, bits)))
    }

    /// Each coordinate over `divisor`.
    ///
    /// # Panics
    /// Where `divisor` is 0.
    #[must_use]
    pub fn over(&self, divisor: &Number, bits: usize) -> Self {
        Self(self.0.each_ref().map(|c| c.over(divisor, bits)))
    }

    /// Each coordinate with so many bits.
    #[must_use]
    pub fn rounded(&self, bits: usize) -> Self {
        Self(self.0.each_ref().map(|c| c.rounded(bits)))
    }

    /// The nearest doubles.
    #[must_use]
    pub fn to_f64(&self) -> [f64; 3] {
        self.0.each_ref().map(Number::to_f64)
    }
}

impl From<[f64; 3]> for Triple {
    fn from(xyz: [f64; 3]) -> Self {
        Self(xyz.map(Number::from))
    }
}

impl From<Vector> for Triple {
    fn from(v: Vector) -> Self {
        Self::from([v.x, v.y, v.z])
    }
}

impl From<Point> for Triple {
    fn from(p: Point) -> Self {
        Self::from([p.x, p.y, p.z])
    }
}

impl Add for &Triple {
    type Output = Triple;
    fn add(self, other: Self) -> Triple {
        let [a, b, c] = &self.0;
        let [x, y, z] = &other.0;
        Triple([a + x, b + y, c + z])
    }
}

impl Sub for &Triple {
    type Output = Triple;
    fn sub(self, other: Self) -> Triple {
        let [a, b, c] = &self.0;
        let [x, y, z] = &other.0;
        Triple([a - x, b - y, c - z])
    }
}

impl Neg for &Triple {
    type Output = Triple;
    fn neg(self) -> Triple {
        Triple(self.0.each_ref().map(|c| -c))
    }
}
