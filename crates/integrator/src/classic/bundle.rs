//! What encloses some points or rays, and which shapes it can have to do with.
//!
//! All bounds leave out only what no ray can meet *as computed*: they are wider
//! than the exact ones by far more than rounding errors of the computation add
//! up to.

use super::lights::Light;
use super::world::{Candidates, World};
use crate::enclose::{cone, extent, max};
use crate::rows::Triples;
use lancer_kernel::lanes::{Lanes, Mask, Real, Vectors, lanes_of, smaller};
use lancer_math::{Bounds, Vector};
use std::ops::Range;

/// A ball around points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Around {
    centre: Vector,
    radius: f64,
    /// No coordinate of a point is larger.
    pub(super) largest: f64,
}

/// A cone of unit vectors around an axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cone {
    axis: Vector,
    cosine: f64,
    sine: f64,
}

/// More than all relative errors of a sum of products and a root of it together,
/// where terms cancel: the root of 2^-52 is 2^-26.
const SLACK: f64 = 1.0 / 4_194_304.0; // 2^-22

impl Around {
    /// Of one point alone.
    pub(super) fn point(centre: Vector) -> Self {
        Self { centre, radius: 0.0, largest: centre.amax() }
    }

    #[inline(always)]
    pub(super) fn new<L: Lanes>(lanes: L, points: &Triples, range: Range<usize>) -> Self {
        let Bounds { min: least, max: most } = extent(lanes, points, range);
        let (least, most) = (least.coords, most.coords);
        let half = most * 0.5 - least * 0.5;
        Self {
            centre: least * 0.5 + most * 0.5,
            radius: half.norm() * (1.0 + SLACK) + least.amax().max(most.amax()) * SLACK * SLACK,
            largest: least.amax().max(most.amax()),
        }
    }

    /// Writes the spheres that may stand between these points and a light.
    ///
    /// Of the stretches from the points to a lamp none is farther from the one
    /// that begins at the ball's centre than the ball's radius. So a sphere that
    /// is farther from that one than both radii hides the lamp from none of the
    /// points, nor has one of them inside.
    #[inline(always)]
    pub(super) fn suspects<L: Lanes>(
        &self,
        lanes: L,
        world: &World,
        light: &Light,
        suspects: &mut Vec<u32>,
    ) {
        let way = if light.is_lamp { light.place - self.centre } else { light.place };
        let length_squared = way.norm_squared();
        let reach_squared = if light.is_lamp { length_squared } else { 0.0 };
        let way = Vectors::splat(lanes, &way);
        let centre = Vectors::splat(lanes, &self.centre);
        let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
        let places = &world.places;
        for i in (0..places.count).step_by(L::WIDTH) {
            let v = Vectors {
                x: lanes.load(&places.x[i..]),
                y: lanes.load(&places.y[i..]),
                z: lanes.load(&places.z[i..]),
            };
            let v = v - centre;
            let step = v.dot(&way) / lanes.splat(length_squared);
            let step = max(step, zero);
            let step = if light.is_lamp { smaller(step, one) } else { step };
            let away = v - way * step;
            let reach = lanes.load(&places.radius[i..]) + self.radius;
            let size = v.norm_squared() + reach_squared;
            let bound = reach * reach + (reach * reach + size) * (4.0 * SLACK);
            // Not NaN, nor the lanes behind the last sphere.
            let too_far = away.norm_squared().gt(bound) | reach.lt(zero);
            for k in lanes_of((!too_far).bits() & lanes.first(places.count - i).bits()) {
                suspects.push((i + k) as u32);
            }
        }
    }
}

impl Cone {
    /// Around some unit vectors.
    #[inline(always)]
    pub(super) fn new<L: Lanes>(lanes: L, directions: &Triples, range: Range<usize>) -> Self {
        let (axis, least_cosine) = cone(lanes, directions, range);
        Self::around(axis, least_cosine)
    }

    /// Around unit vectors and all that are between them.
    #[inline(always)]
    pub(super) fn of_corners(corners: [Vector; 4]) -> Self {
        let sum = corners[0] + corners[1] + corners[2] + corners[3];
        let axis = sum / sum.norm();
        let mut cosine = 1.0;
        for corner in corners {
            cosine = smaller(corner.dot(&axis), cosine);
        }
        Self::around(axis, cosine)
    }

    #[inline(always)]
    fn around(axis: Vector, least_cosine: f64) -> Self {
        let cosine = least_cosine - SLACK * SLACK;
        Self { axis, cosine, sine: (1.0 - cosine * cosine).sqrt() }
    }

    /// Bounds on the products of a unit vector with those of the cone.
    fn products(&self, unit: &Vector) -> [f64; 2] {
        let along = unit.dot(&self.axis);
        let across = (1.0 - along * along).max(0.0).sqrt();
        let (middle, spread) = (along * self.cosine, across * self.sine);
        [
            if along < -self.cosine { -1.0 } else { middle - spread } - SLACK,
            if along > self.cosine { 1.0 } else { middle + spread } + SLACK,
        ]
    }

    /// The largest product of those of the cone with the unit vector along `way`.
    pub(super) fn largest_cosine(&self, way: &Vector) -> f64 {
        if self.cosine > 0.0 { self.products(&(way / way.norm()))[1] } else { 1.0 }
    }

    /// Writes the spheres and planes that rays from these points in directions of
    /// the cone may meet first.
    #[inline(always)]
    pub(super) fn candidates<L: Lanes>(
        &self,
        lanes: L,
        world: &World,
        from: &Around,
        candidates: &mut Candidates,
    ) {
        candidates.spheres.clear();
        candidates.planes.clear();
        // Wider than a half-space, or not a number.
        if !(self.cosine > 0.0 && from.radius.is_finite()) {
            candidates.spheres.extend_from_slice(&world.everything().spheres);
            candidates.planes.extend_from_slice(&world.everything().planes);
            return;
        }
        self.spheres(lanes, world, from, &mut candidates.spheres);
        self.planes(world, from, &mut candidates.planes);
    }

    /// A sphere is left out if it is farther than both radii from the cone of
    /// rays from the ball's centre. How far it is from that cone's surface is a
    /// product with the surface's unit normal, so it is at least that far.
    #[inline(always)]
    fn spheres<L: Lanes>(&self, lanes: L, world: &World, from: &Around, found: &mut Vec<u32>) {
        let places = &world.places;
        let (centre, axis) =
            (Vectors::splat(lanes, &from.centre), Vectors::splat(lanes, &self.axis));
        for i in (0..places.count).step_by(L::WIDTH) {
            let v = Vectors {
                x: lanes.load(&places.x[i..]),
                y: lanes.load(&places.y[i..]),
                z: lanes.load(&places.z[i..]),
            };
            let v = v - centre;
            let along = v.dot(&axis);
            let squared = v.norm_squared();
            let across = max(squared - along * along, lanes.splat(0.0)).sqrt();
            let distance = across * self.cosine - along * self.sine;
            let reach = lanes.load(&places.radius[i..]) + from.radius;
            let bound = reach + (reach + squared.sqrt()) * SLACK;
            for k in lanes_of((!distance.gt(bound)).bits() & lanes.first(places.count - i).bits()) {
                found.push((i + k) as u32);
            }
        }
    }

    /// A plane is left out if no ray goes against its normal, or if all of them
    /// meet another one nearer.
    #[inline(always)]
    fn planes(&self, world: &World, from: &Around, found: &mut Vec<u32>) {
        let mut least_far = f64::INFINITY;
        let mut near = [0.0; 16];
        for (i, plane) in (0..).zip(&world.planes) {
            let [least, most] = self.products(&plane.normal);
            if least > 0.0 {
                continue;
            }
            let height = plane.offset - plane.normal.dot(&from.centre);
            let size = plane.offset.abs() + from.centre.norm() + from.radius;
            let spread = from.radius + size * SLACK;
            if most < 0.0 {
                least_far = least_far.min((height.abs() + spread) / -most);
            }
            if let Some(near) = near.get_mut(found.len()) {
                *near = (height.abs() - spread) / -least;
            }
            found.push(i);
        }
        // Where squares of distances may underflow, the first of the planes wins.
        let bound = (least_far * (1.0 + SLACK)).max(1e-140);
        let mut k = 0;
        found.retain(
            #[inline(always)]
            |_| {
                let farther = near.get(k).is_some_and(|near| *near > bound);
                k += 1;
                !farther
            },
        );
    }
}
