use super::{Lanes, Mask, Real};
use lancer_math::{Point, Vector};
use std::ops::{Add, Mul, Neg, Sub};

/// A vector or a point for each lane.
#[derive(Debug, Clone, Copy)]
pub struct Vectors<R> {
    /// The first coordinates.
    pub x: R,
    /// The second ones.
    pub y: R,
    /// The third ones.
    pub z: R,
}

impl<R: Real> Vectors<R> {
    /// The same vector in each lane.
    #[inline(always)]
    pub fn splat<L: Lanes<Real = R>>(lanes: L, v: &Vector) -> Self {
        Self { x: lanes.splat(v.x), y: lanes.splat(v.y), z: lanes.splat(v.z) }
    }

    /// The same point in each lane.
    #[inline(always)]
    pub fn splat_point<L: Lanes<Real = R>>(lanes: L, p: &Point) -> Self {
        Self::splat(lanes, &p.coords)
    }

    /// The first ones of three slices of coordinates.
    ///
    /// # Panics
    /// Where one is shorter than the lanes are many.
    #[inline(always)]
    pub fn load<L: Lanes<Real = R>>(lanes: L, [x, y, z]: [&[f64]; 3]) -> Self {
        Self { x: lanes.load(x), y: lanes.load(y), z: lanes.load(z) }
    }

    /// Writes all to the beginnings of three slices.
    ///
    /// # Panics
    /// Where there is no room.
    #[inline(always)]
    pub fn store(self, [x, y, z]: [&mut [f64]; 3]) {
        self.x.store(x);
        self.y.store(y);
        self.z.store(z);
    }

    /// The vector of a lane.
    #[inline(always)]
    pub fn lane(&self, k: usize) -> Vector {
        Vector::new(self.x.lane(k), self.y.lane(k), self.z.lane(k))
    }

    /// x x' + (y y' + z z'), in that order and each sum fused.
    #[inline(always)]
    pub fn dot(&self, other: &Self) -> R {
        self.x.mul_add(other.x, self.y.mul_add(other.y, self.z * other.z))
    }

    /// The dot product with itself.
    #[inline(always)]
    pub fn norm_squared(&self) -> R {
        self.dot(self)
    }

    /// The root of the dot product with itself.
    #[inline(always)]
    pub fn norm(&self) -> R {
        self.norm_squared().sqrt()
    }

    /// self * by + other, each coordinate fused.
    #[inline(always)]
    #[must_use]
    pub fn mul_add(self, by: R, other: Self) -> Self {
        Self {
            x: self.x.mul_add(by, other.x),
            y: self.y.mul_add(by, other.y),
            z: self.z.mul_add(by, other.z),
        }
    }

    /// The size of the largest coordinate; not a number where one is not.
    #[inline(always)]
    pub fn amax(&self) -> R {
        larger(larger(self.x.abs(), self.y.abs()), self.z.abs())
    }

    /// Those of the one where the answer is yes, of the other where it is no.
    #[inline(always)]
    #[must_use]
    pub fn select(mask: R::Mask, yes: Self, no: Self) -> Self {
        Self {
            x: mask.select(yes.x, no.x),
            y: mask.select(yes.y, no.y),
            z: mask.select(yes.z, no.z),
        }
    }
}

/// The larger one; not a number where one is not.
#[inline(always)]
pub fn larger<R: Real>(a: R, b: R) -> R {
    // Of b not a number the comparison is false; of a, it must be a.
    let is_number = a.eq(a);
    (a.gt(b) | !is_number).select(a, b)
}

/// The smaller one; the second where one is not a number.
#[inline(always)]
pub fn smaller<R: Real>(a: R, b: R) -> R {
    a.lt(b).select(a, b)
}

impl From<Vector> for Vectors<f64> {
    #[inline(always)]
    fn from(v: Vector) -> Self {
        Self { x: v.x, y: v.y, z: v.z }
    }
}

impl From<Vectors<f64>> for Vector {
    #[inline(always)]
    fn from(v: Vectors<f64>) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl<R: Real> Add for Vectors<R> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<R: Real> Sub for Vectors<R> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<R: Real> Mul<R> for Vectors<R> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, by: R) -> Self {
        Self { x: self.x * by, y: self.y * by, z: self.z * by }
    }
}

impl<R: Real> Neg for Vectors<R> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}
