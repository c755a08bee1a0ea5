//! What encloses some points or rays, and which shapes it can have to do with.
//!
//! All bounds leave out only what no ray can meet *as computed*: they are wider
//! than the exact ones by far more than rounding errors of the computation add
//! up to.

use super::lights::Light;
use super::rows::Triples;
use super::vectors::Vectors;
use super::world::{Candidates, World};
use lancer_kernel::lanes::{Lanes, MOST, Mask, Real, lanes_of};
use lancer_math::Vector;
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

/// The sum, or another fold, of the lanes that count.
#[inline(always)]
fn fold<R: Real>(register: R, fold: fn(f64, f64) -> f64, width: usize) -> f64 {
    let mut each = [0.0; MOST];
    register.store(&mut each);
    let mut all = each[0];
    for x in &each[1..width] {
        all = fold(all, *x);
    }
    all
}

#[inline(always)]
fn min<R: Real>(a: R, b: R) -> R {
    a.lt(b).select(a, b)
}

#[inline(always)]
fn max<R: Real>(a: R, b: R) -> R {
    a.gt(b).select(a, b)
}

/// The lanes from `i` on that are before `end`.
#[inline(always)]
pub(super) fn valid<L: Lanes>(i: usize, end: usize) -> u32 {
    let all = (1 << L::WIDTH) - 1;
    if i + L::WIDTH <= end { all } else { all & ((1 << (end - i)) - 1) }
}

impl Around {
    /// Points that are not numbers are left out: from them nothing is met.
    #[inline(always)]
    pub(super) fn new<L: Lanes>(lanes: L, points: &Triples, range: Range<usize>) -> Self {
        let (big, small) = (lanes.splat(f64::INFINITY), lanes.splat(f64::NEG_INFINITY));
        let mut least = Vectors { x: big, y: big, z: big };
        let mut most = Vectors { x: small, y: small, z: small };
        for i in range.clone().step_by(L::WIDTH) {
            let p = points.load(lanes, i);
            let valid = lanes.mask(valid::<L>(i, range.end));
            least.x = valid.select(min(p.x, least.x), least.x);
            least.y = valid.select(min(p.y, least.y), least.y);
            least.z = valid.select(min(p.z, least.z), least.z);
            most.x = valid.select(max(p.x, most.x), most.x);
            most.y = valid.select(max(p.y, most.y), most.y);
            most.z = valid.select(max(p.z, most.z), most.z);
        }
        let width = L::WIDTH;
        let least = [least.x, least.y, least.z].map(
            #[inline(always)]
            |least| fold(least, f64::min, width),
        );
        let most = [most.x, most.y, most.z].map(
            #[inline(always)]
            |most| fold(most, f64::max, width),
        );
        let middle = |k: usize| 0.5 * least[k] + 0.5 * most[k];
        let centre = Vector::new(middle(0), middle(1), middle(2));
        let mut squared = lanes.splat(0.0);
        let centres = Vectors::splat(lanes, &centre);
        for i in range.clone().step_by(L::WIDTH) {
            let valid = lanes.mask(valid::<L>(i, range.end));
            let far = points.load(lanes, i).minus(&centres).norm_squared();
            squared = valid.select(max(far, squared), squared);
        }
        let radius = fold(squared, f64::max, width).sqrt() * (1.0 + SLACK);
        let mut largest = 0.0_f64;
        for side in least.into_iter().chain(most) {
            largest = largest.max(side.abs());
        }
        // All of them NaN: `min` and `max` above have left infinities.
        Self { centre, radius, largest }
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
            let v = v.minus(&centre);
            let step = v.dot(&way) / lanes.splat(length_squared);
            let step = max(step, zero);
            let step = if light.is_lamp { min(step, one) } else { step };
            let away = v.minus(&Vectors { x: way.x * step, y: way.y * step, z: way.z * step });
            let reach = lanes.load(&places.radius[i..]) + self.radius;
            let size = v.norm_squared() + reach_squared;
            let bound = reach * reach + (reach * reach + size) * (4.0 * SLACK);
            // Not NaN, nor the lanes behind the last sphere.
            let too_far = away.norm_squared().gt(bound) | reach.lt(zero);
            for k in lanes_of((!too_far).bits() & valid::<L>(i, places.count)) {
                suspects.push((i + k) as u32);
            }
        }
    }
}

impl Cone {
    /// Vectors that are not numbers are left out: along them nothing is met.
    #[inline(always)]
    pub(super) fn new<L: Lanes>(lanes: L, directions: &Triples, range: Range<usize>) -> Self {
        let zero = lanes.splat(0.0);
        let mut sum = Vectors { x: zero, y: zero, z: zero };
        for i in range.clone().step_by(L::WIDTH) {
            let d = directions.load(lanes, i);
            let valid = lanes.mask(valid::<L>(i, range.end));
            let more = sum.plus(&d);
            sum.x = valid.select(more.x, sum.x);
            sum.y = valid.select(more.y, sum.y);
            sum.z = valid.select(more.z, sum.z);
        }
        let add = |a: f64, b: f64| a + b;
        let sum = Vector::new(
            fold(sum.x, add, L::WIDTH),
            fold(sum.y, add, L::WIDTH),
            fold(sum.z, add, L::WIDTH),
        );
        let axis = sum / sum.norm();
        let axes = Vectors::splat(lanes, &axis);
        let mut cosine = lanes.splat(1.0);
        for i in range.clone().step_by(L::WIDTH) {
            let valid = lanes.mask(valid::<L>(i, range.end));
            cosine = valid.select(min(directions.load(lanes, i).dot(&axes), cosine), cosine);
        }
        let cosine = fold(cosine, f64::min, L::WIDTH) - SLACK * SLACK;
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
            let v = v.minus(&centre);
            let along = v.dot(&axis);
            let squared = v.norm_squared();
            let across = max(squared - along * along, lanes.splat(0.0)).sqrt();
            let distance = across * self.cosine - along * self.sine;
            let reach = lanes.load(&places.radius[i..]) + from.radius;
            let bound = reach + (reach + squared.sqrt()) * SLACK;
            for k in lanes_of((!distance.gt(bound)).bits() & valid::<L>(i, places.count)) {
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
