use lancer_kernel::lanes::{Lanes, Real};
use lancer_math::Vector;

/// A vector for each lane; with one lane ([`f64`]) just a vector.
///
/// What is computed with them is the arithmetic that the engines of the original
/// share with their plain transcription: sums of products are fused, from the
/// first coordinate to the last.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vectors<R> {
    pub(super) x: R,
    pub(super) y: R,
    pub(super) z: R,
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

impl<R: Real> Vectors<R> {
    /// The same one in each lane.
    #[inline(always)]
    pub(super) fn splat<L: Lanes<Real = R>>(lanes: L, v: &Vector) -> Self {
        Self { x: lanes.splat(v.x), y: lanes.splat(v.y), z: lanes.splat(v.z) }
    }

    #[inline(always)]
    pub(super) fn lane(&self, k: usize) -> Vector {
        Vector::new(self.x.lane(k), self.y.lane(k), self.z.lane(k))
    }

    #[inline(always)]
    pub(super) fn dot(&self, other: &Self) -> R {
        self.z.mul_add(other.z, self.y.mul_add(other.y, self.x * other.x))
    }

    #[inline(always)]
    pub(super) fn norm_squared(&self) -> R {
        self.dot(self)
    }

    #[inline(always)]
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }

    #[inline(always)]
    pub(super) fn minus(&self, other: &Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }

    /// So many steps farther in a direction.
    #[inline(always)]
    pub(super) fn after(&self, steps: R, direction: &Self) -> Self {
        Self {
            x: direction.x.mul_add(steps, self.x),
            y: direction.y.mul_add(steps, self.y),
            z: direction.z.mul_add(steps, self.z),
        }
    }

    /// Made as long as 1: times the inverse of the length. Not a unit vector for
    /// zero and for what is too small or too large to be squared.
    #[inline(always)]
    pub(super) fn unit<L: Lanes<Real = R>>(&self, lanes: L) -> Self {
        let inverse = lanes.splat(1.0) / self.norm_squared().sqrt();
        Self { x: self.x * inverse, y: self.y * inverse, z: self.z * inverse }
    }

    /// The direction in which a mirror with that unit normal sends these.
    #[inline(always)]
    pub(super) fn mirrored(&self, normal: &Self) -> Self {
        self.after(self.dot(normal) * -2.0, normal)
    }
}
