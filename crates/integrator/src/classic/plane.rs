use super::checker;
use super::eye::Nearest;
use super::lanes::{LANES, Vectors, each, lanes_of};
use super::naive_unit;
use lancer_math::{Point, Ray, Vector};
use wide::f64x4;

/// A plane made ready for its light and colour.
#[derive(Debug, Clone, Copy)]
pub(super) struct Half {
    pub(super) origin: Point,
    pub(super) normal: Vector,
    /// `origin . normal`
    pub(super) offset: f64,
    /// The axes of its checker.
    axes: [Vector; 2],
}

impl Half {
    pub(super) fn new(plane: &lancer_scene::Plane) -> Self {
        let origin = plane.origin.get();
        let normal = naive_unit(plane.normal.get());
        Self {
            origin,
            normal,
            offset: origin.coords.dot(&normal),
            axes: checker::axes_on_plane(normal),
        }
    }

    /// Whether the way from `point` to a lamp, of that length and direction,
    /// meets the plane before the lamp, without dividing.
    #[inline]
    pub(super) fn hides_lamp(&self, point: &Point, way: &Vector) -> bool {
        let slope = way.dot(&self.normal);
        (point.coords.dot(&self.normal) - self.offset).abs() < -slope
    }

    pub(super) fn facing(&self, eye: &Point) -> Facing {
        let to_plane = self.offset - eye.coords.dot(&self.normal);
        Facing { normal: self.normal, to_plane: f64x4::splat(to_plane) }
    }

    pub(super) fn shows_second_colour(&self, point: &Point) -> bool {
        checker::on_plane(point - self.origin, &self.axes)
    }
}

/// More than one, by more than three products can be rounded down.
const ROUNDED_UP: f64 = 1.0 + 8.0 * f64::EPSILON;

/// Up to four planes, made ready for intersection.
#[derive(Debug, Clone)]
pub(super) struct Halves {
    /// Zero in lanes without a plane: nothing hits those.
    normals: Vectors,
    offsets: f64x4,
}

impl Halves {
    pub(super) fn pack(planes: &[Half]) -> Vec<Self> {
        planes
            .chunks(LANES)
            .map(|chunk| Self {
                normals: Vectors::each(|k| {
                    chunk.get(k).map_or_else(Vector::zeros, |plane| plane.normal)
                }),
                offsets: each(|k| chunk.get(k).map_or(0.0, |plane| plane.offset)),
            })
            .collect()
    }

    /// The distances to the intersections, as the original has them: only for
    /// rays that go against the normal, and then even where they are behind
    /// the ray's origin. Calls `hit` with the lane and the distance of all
    /// those whose square is below `bound`, and perhaps of others.
    #[inline]
    pub(super) fn distances(&self, ray: &Ray, bound: f64, mut hit: impl FnMut(usize, f64)) {
        let slope = self.normals.dot(&ray.direction);
        let height = self.normals.dot(&ray.origin.coords);
        let to_plane = self.offsets - height;
        // Those that are near for sure or by rounding, without dividing (the
        // smallest normal number is for products that underflow): not
        // those whose square is at least `bound`. NaN counts as near, and the
        // caller compares the distance itself.
        let far =
            (to_plane * to_plane).simd_gt(slope * slope * (bound * ROUNDED_UP) + f64::MIN_POSITIVE);
        let bits = slope.simd_lt(f64x4::ZERO).to_bitmask() & !far.to_bitmask();
        if bits != 0 {
            let distance = (to_plane / slope).to_array();
            for k in lanes_of(bits) {
                hit(k, distance[k]);
            }
        }
    }
}

/// A plane as it is seen from the eye.
#[derive(Debug, Clone)]
pub(super) struct Facing {
    normal: Vector,
    to_plane: f64x4,
}

impl Facing {
    /// As [`Halves::distances`] of one plane and four rays.
    #[inline(always)]
    pub(super) fn meet(&self, directions: &Vectors, index: f64x4, nearest: &mut Nearest) {
        let slope = directions.dot(&self.normal);
        let hits = slope.simd_lt(f64x4::ZERO);
        if hits.any() {
            nearest.consider(index, self.to_plane / slope, hits);
        }
    }
}
