use super::eye::Nearest;
use super::lanes::{LANES, Vectors, each, lanes_of};
use super::naive_unit;
use super::occluders::Ways;
use lancer_math::{Point, Ray, Vector};
use wide::f64x4;

/// Up to four spheres, made ready for intersection.
#[derive(Debug, Clone)]
pub(super) struct Balls {
    centres: Vectors,
    /// Minus infinity in lanes without a sphere: nothing hits those.
    radii_squared: f64x4,
}

impl Balls {
    pub(super) fn pack(spheres: &[lancer_scene::Sphere]) -> Vec<Self> {
        spheres
            .chunks(LANES)
            .map(|chunk| Self {
                centres: Vectors::each(|k| {
                    chunk.get(k).map_or_else(Vector::zeros, |s| s.centre.get().coords)
                }),
                radii_squared: each(|k| {
                    chunk.get(k).map_or(f64::NEG_INFINITY, |s| s.radius.get() * s.radius.get())
                }),
            })
            .collect()
    }

    /// The distances to the nearer intersections, as the original has them:
    /// never where the centre is behind the ray's origin, and otherwise even
    /// where the intersection is behind it (an origin inside the sphere).
    /// Calls `hit` with the lane and the distance of each.
    #[inline]
    pub(super) fn distances(&self, ray: &Ray, mut hit: impl FnMut(usize, f64)) {
        let to_centre = self.centres.minus(&ray.origin);
        let along = to_centre.dot(&ray.direction);
        let under_root = self.radii_squared - (to_centre.norm_squared() - along * along);
        // Not for NaN either.
        let hits = along.simd_ge(f64x4::ZERO) & under_root.simd_ge(f64x4::ZERO);
        let bits = hits.to_bitmask();
        if bits != 0 {
            let distances = (along - under_root.sqrt()).to_array();
            for k in lanes_of(bits) {
                hit(k, distances[k]);
            }
        }
    }
}

/// A sphere made ready for shadows and light.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    centre: Point,
    radius_squared: f64,
}

impl Ball {
    pub(super) fn new(sphere: &lancer_scene::Sphere) -> Self {
        let radius = sphere.radius.get();
        Self { centre: sphere.centre.get(), radius_squared: radius * radius }
    }

    pub(super) fn normal(&self, point: &Point) -> Vector {
        naive_unit(point - self.centre)
    }

    pub(super) fn ahead_of(&self, eye: &Point) -> Ahead {
        let to_centre = self.centre - eye;
        Ahead {
            to_centre,
            square: f64x4::splat(to_centre.norm_squared()),
            radius_squared: f64x4::splat(self.radius_squared),
        }
    }

    /// Which of the ways `asked` for meet the sphere before the light, as bits;
    /// other bits mean nothing.
    ///
    /// From the same quadratic as [`Balls::distances`], but without a unit
    /// direction: the distance is along - root over the way's length.
    #[inline(always)]
    pub(super) fn hides(&self, ways: &Ways, asked: u32) -> u32 {
        let to_centre = self.centre - ways.origin;
        let tangent_squared = to_centre.norm_squared() - self.radius_squared;
        let along = ways.vectors.dot(&to_centre);
        let under_root = along * along - ways.lengths_squared * tangent_squared;
        let meets = along.simd_ge(f64x4::ZERO) & under_root.simd_ge(f64x4::ZERO);
        if meets.to_bitmask() & asked == 0 {
            return 0;
        }
        let before = (along - under_root.sqrt()).abs().simd_lt(ways.reaches);
        (meets & before).to_bitmask()
    }
}

/// A sphere as it is seen from the eye.
#[derive(Debug, Clone)]
pub(super) struct Ahead {
    to_centre: Vector,
    square: f64x4,
    radius_squared: f64x4,
}

impl Ahead {
    /// As [`Balls::distances`] of one sphere and four rays.
    #[inline(always)]
    pub(super) fn meet(&self, directions: &Vectors, index: f64x4, nearest: &mut Nearest) {
        let along = directions.dot(&self.to_centre);
        let under_root = self.radius_squared - (self.square - along * along);
        let hits = along.simd_ge(f64x4::ZERO) & under_root.simd_ge(f64x4::ZERO);
        if hits.any() {
            nearest.consider(index, along - under_root.sqrt(), hits);
        }
    }
}
