use super::node::{Space, power_below};
use lancer_math::{Bounds, Ray, Vector};

/// A ray made ready to be held against boxes in singles, so that no box that it
/// goes through is lost.
///
/// The origin is moved, in doubles, to where the ray enters the box around all
/// (or to its beginning, where that is inside), and into the hierarchy's space.
/// From there on everything is at most a few units away. A face at f is met at
/// (f - origin) * inverse, computed as f * inverse + offset (Ize, *Robust BVH Ray
/// Traversal*, JCGT 2(2), 2013, has the difference first, which takes longer).
/// What can have been lost before is at most `error` below in the origin; what is
/// lost here is at most [`MARGIN`] of f and the origin. By both the offset makes what the
/// ray enters nearer, and what it leaves farther. So no interval is too short; that
/// it begins before 0 does no harm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Query {
    pub(super) inverse: [f32; 3],
    /// For the faces where the ray goes in, and for those where it comes out.
    pub(super) offset: [[f32; 3]; 2],
    /// Whether it goes to lower coordinates: 1 if so.
    pub(super) side: [u8; 3],
    /// Where in t the moved origin is.
    start: f64,
    /// How much of what boxes count in is in one t.
    unit: f64,
}

/// Eight halves of a unit in the last place of a single: more than the roundings of
/// the inverse, the product, the offset and the sum together, the first two of which
/// are relative to f, the third to the origin, the last to both, whether product
/// and sum are fused or not.
const MARGIN: f64 = 1.0 / 2_097_152.0;

/// A component below this times the largest one, or as small, moves the ray over
/// the whole box by less than an error does.
const STANDING: f64 = 1.0 / (1u64 << 60) as f64;

/// Sixteen halves of a unit in the last place of a double: more than the
/// roundings where the origin is moved, and where the t of a hit is computed.
const LOST: f64 = 8.0 * f64::EPSILON;

impl Query {
    /// Nothing where the ray is not in the box for any t from `from` to `to`, or is
    /// no ray. All boxes are larger by `margin` on all sides.
    #[inline(always)]
    pub(super) fn new(
        space: &Space,
        bounds: &Bounds,
        ray: &Ray,
        margin: f64,
        (from, to): (f64, f64),
    ) -> Option<Self> {
        let d = ray.direction;
        let inverse = d.map(
            #[inline(always)]
            |c| 1.0 / c,
        );
        let (start, _) = stretch_in(bounds, ray, &inverse, margin, (from, to))?;
        let from_centre = ray.origin - space.centre;
        let step = d * start;
        let far = from_centre.abs() + step.abs();
        let longest = d.amax();
        if !(longest > 0.0 && from_centre.iter().chain(d.iter()).all(|c| c.is_finite())) {
            return None;
        }
        let Some(power) = power_below(longest).filter(|_| space.scale != 0.0) else {
            return Some(Self::ALL);
        };
        let origin = (from_centre + step) * space.scale;
        let error = far * (space.scale * LOST);
        let error = error.add_scalar(LOST + margin * space.scale);
        if !(error.x <= 1.0 && error.y <= 1.0 && error.z <= 1.0) {
            return Some(Self::ALL);
        }
        let mut query = Self {
            inverse: [0.0; 3],
            offset: [[0.0; 3]; 2],
            side: [0; 3],
            start,
            unit: power * space.scale,
        };
        for axis in 0..3 {
            query.side[axis] = u8::from(d[axis].is_sign_negative());
            let along = inverse[axis];
            let size = along.abs() * power;
            let size = if size < 1.0 / STANDING { size } else { 1.0 / STANDING };
            let o = origin[axis];
            let slack = (error[axis] + (1.0 + o.abs()) * MARGIN) * size;
            let inverse = size.copysign(along);
            let offset = o * inverse;
            query.inverse[axis] = inverse as f32;
            query.offset[0][axis] = (-offset - slack) as f32;
            query.offset[1][axis] = (slack - offset) as f32;
        }
        Some(query)
    }

    /// What goes through every box: for rays whose numbers leave the range of what
    /// is computed here.
    const ALL: Self = Self {
        inverse: [1.0; 3],
        offset: [[-4.0; 3], [4.0; 3]],
        side: [0; 3],
        start: 0.0,
        unit: f64::INFINITY,
    };

    /// How far that t is, rounded up, as boxes count it.
    #[inline(always)]
    pub(super) fn reach(&self, t: f64) -> f32 {
        let reach = ((t - self.start) * self.unit) as f32;
        // Comparisons, so that what is not a number is 0.
        if reach > 0.0 { reach.next_up() } else { f32::MIN_POSITIVE }
    }
}

/// From where to where the ray is in the box made larger by `margin`, if it is so between
/// `from` and `to`: rounded outward, and in a larger box never a shorter stretch.
///
/// Along an axis in which the ray does not move, it is between the sides
/// everywhere or nowhere; exactly on one, infinity times 0 is not a number
/// and, as it is compared here, does not narrow the interval.
#[inline(always)]
pub(crate) fn stretch_in(
    bounds: &Bounds,
    ray: &Ray,
    inverse: &Vector,
    margin: f64,
    (from, to): (f64, f64),
) -> Option<(f64, f64)> {
    let (mut near, mut far) = (from, to);
    for axis in 0..3 {
        let inverse = inverse[axis];
        let low = (bounds.min[axis] - margin - ray.origin[axis]) * inverse;
        let high = (bounds.max[axis] + margin - ray.origin[axis]) * inverse;
        // By the bit: 1 / -0 is minus infinity.
        let (enter, leave) = if inverse.is_sign_negative() { (high, low) } else { (low, high) };
        // Outward: away from where the ray is.
        let enter = enter * (1.0 - LOST.copysign(enter));
        let leave = leave * (1.0 + LOST.copysign(leave));
        near = if enter > near { enter } else { near };
        far = if leave < far { leave } else { far };
    }
    (near <= far).then_some((near, far))
}
