//! Opaque surfaces: where rays meet them, what light falls there, and what a
//! mirror throws back.

use super::buffers::Buffers;
use super::places::Places;
use super::units::units;
use super::{Batch, ball_around, dot};
use crate::enclose::extent;
use crate::rows::Triples;
use crate::whitted::signature::{self, Meeting, Signing, Spot, Way};
use lancer_kernel::lanes::{Lanes, Mask, Real, Vectors, lanes_of, larger};
use lancer_kernel::{ListedShape, Rays};
use lancer_math::{Bounds, Point, Vector};
use lancer_scene::Pattern;

/// A ball that holds all points from which a batch of rays leaves.
pub(super) struct Around {
    pub(super) centre: Point,
    pub(super) radius: f64,
    /// The normal on the side that all rays see; none where they do not see the same.
    pub(super) side: Option<Vector>,
    /// The item, if it is seen from its outside alone.
    pub(super) outside: Option<u32>,
}

impl Around {
    /// Around points, from each of which a ray leaves by twice its error and no
    /// more than the largest one.
    fn new(bounds: &Bounds, error: f64, side: Option<Vector>) -> Self {
        let (centre, radius) = ball_around(bounds);
        let radius = (radius + 4.0 * error) * (1.0 + 1e-9);
        Self { centre, radius, side, outside: None }
    }
}

impl<P: Places> Batch<'_, P> {
    /// The rays of the group, which all met that item.
    #[inline(always)]
    pub(super) fn shade<L: Lanes>(&mut self, lanes: L, item: u32, depth: u32, way: Way) {
        let tracer = self.tracer;
        let surface = tracer.prepared.surface(item);
        let (gloss, emission) = (surface.gloss.get(), surface.emission.get());
        let around = match tracer.prepared.shape_in_lanes(item) {
            Some(shape) => self.points(lanes, item, &shape),
            None => self.expand(item),
        };
        if emission != [0.0; 3] {
            let Buffers { group, radiance, .. } = &mut *self.buffers;
            for k in 0..group.count {
                super::add(radiance, group.pixel[k], group.share(k), emission);
            }
        }
        if gloss < 1.0 || !self.tracer.kernel.culling.full_mirrors {
            self.gather(lanes, 1.0 - gloss, (item, way), &around);
        }
        if P::Signing::SIGNED {
            self.sign(way.meets(Some(item)));
        }
        if gloss > 0.0 {
            self.mirror(lanes, gloss, depth, around.outside);
        }
    }

    /// Adds where the rays of the group met their item.
    #[inline(always)]
    fn sign(&mut self, meeting: Meeting) {
        let Buffers { group, sights, signatures, .. } = &mut *self.buffers;
        let spots = sights.lit.iter().zip(&sights.piece);
        for (&pixel, (&lit, &piece)) in group.pixel[..group.count].iter().zip(spots) {
            super::sign(signatures, pixel, meeting.at(lit, piece));
        }
    }

    /// Points, normals and colours of an item that is met in lanes.
    #[inline(always)]
    fn points<L: Lanes>(&mut self, lanes: L, item: u32, shape: &ListedShape<'_>) -> Around {
        let culling = &self.tracer.kernel.culling;
        let prepared = &self.tracer.prepared;
        let pattern = prepared.surface(item).pattern;
        let [first, second] =
            prepared.albedos(item).map(|albedo| Vectors::splat(lanes, &Vector::from(albedo)));
        let Buffers { group, sights, .. } = &mut *self.buffers;
        sights.is_smooth = false;
        if P::Signing::SIGNED {
            sights.piece[..group.count].fill(0);
        }
        let mut largest = lanes.splat(0.0);
        let (mut behind, mut before) = (lanes.mask(0), lanes.mask(0));
        for at in (0..group.count).step_by(L::WIDTH) {
            let (origin, direction) =
                (group.origin.load(lanes, at), group.direction.load(lanes, at));
            let rays = Rays::new(lanes, origin, direction);
            let t = lanes.load(&group.t[at..]);
            let points = shape.points(&rays, t);
            let from_behind = dot(&direction, &points.normal).gt(lanes.splat(0.0));
            let facet = Vectors::select(from_behind, -points.normal, points.normal);
            behind = behind | from_behind;
            before = before | !from_behind;
            let point = points.point;
            largest = larger(points.error, largest);
            sights.point.store(lanes, at, &point);
            points.error.store(&mut sights.error[at..]);
            sights.facet.store(lanes, at, &facet);
            if P::Signing::SIGNED {
                let lit = from_behind.select(lanes.splat(signature::BEHIND), lanes.splat(0.0));
                lit.store(&mut sights.lit[at..]);
            }

            let Pattern::Checker(checker) = pattern else {
                sights.albedo.store(lanes, at, &first);
                continue;
            };
            let cells = shape.cells(lanes, &points, &checker);
            let albedo = Vectors::select(cells.second, second, first);
            sights.albedo.store(lanes, at, &albedo);
            if P::Signing::SIGNED {
                signature::in_cell(lanes.load(&sights.lit[at..]), cells.index)
                    .store(&mut sights.lit[at..]);
            }
            let asked = lanes.first(group.count - at) & !cells.certain;
            for k in lanes_of(asked.bits()) {
                let seen = prepared.expand(&group.ray(at + k), &group.hit(at + k));
                (0..3).for_each(|i| sights.albedo.0[i][at + k] = seen.albedo[i]);
                if P::Signing::SIGNED {
                    let from_behind = from_behind.bits() >> k & 1 == 1;
                    sights.lit[at + k] = Spot::new(prepared, &seen, from_behind).lit;
                }
            }
        }
        let bounds = extent(lanes, &sights.point, 0..group.count);
        let error = (0..L::WIDTH).map(|k| largest.lane(k)).fold(0.0, f64::max);
        let one_side = behind.any() != before.any();
        let side = one_side.then(|| sights.facet.load(lanes, 0).lane(0));
        let outside = (!behind.any() && culling.shadow_candidates).then_some(item);
        Around { outside, ..Around::new(&bounds, error, side) }
    }

    /// The same of any other item, one by one.
    #[inline(never)]
    fn expand(&mut self, item: u32) -> Around {
        let prepared = &self.tracer.prepared;
        let Buffers { group, sights, .. } = &mut *self.buffers;
        sights.is_smooth = true;
        let put = |to: &mut Triples, k: usize, v: &Vector| {
            (0..3).for_each(|axis| to.0[axis][k] = v[axis]);
        };
        let mut bounds = Bounds::EMPTY;
        let mut error = 0.0_f64;
        debug_assert!(group.item[..group.count].iter().all(|met| *met == f64::from(item)));
        // The last register is filled.
        for k in 0..group.count + lancer_kernel::lanes::MOST - 1 {
            let ray = group.ray(k);
            let seen = prepared.expand(&ray, &group.hit(k));
            let from_behind = ray.direction.dot(&seen.normal) > 0.0;
            let side = |normal: Vector| if from_behind { -normal } else { normal };
            put(&mut sights.point, k, &seen.point.coords);
            put(&mut sights.facet, k, &side(seen.normal));
            put(&mut sights.shading, k, &side(seen.shading));
            put(&mut sights.albedo, k, &Vector::from(seen.albedo));
            sights.error[k] = seen.error;
            if P::Signing::SIGNED {
                let spot = Spot::new(prepared, &seen, from_behind);
                (sights.lit[k], sights.piece[k]) = (spot.lit, spot.piece);
            }
            bounds = bounds.with(seen.point);
            error = error.max(seen.error);
        }
        Around::new(&bounds, error, None)
    }

    /// What a mirror of that gloss throws back.
    #[inline(always)]
    fn mirror<L: Lanes>(&mut self, lanes: L, gloss: f64, depth: u32, outside: Option<u32>) {
        let outside = outside.map_or(-1.0, f64::from);
        for at in (0..self.buffers.group.count).step_by(L::WIDTH) {
            let Buffers { group, sights, .. } = &*self.buffers;
            let direction = group.direction.load(lanes, at);
            let facet = sights.facet.load(lanes, at);
            let normal = if sights.is_smooth { sights.shading.load(lanes, at) } else { facet };
            let mirrored = direction - normal * (dot(&direction, &normal) * 2.0);
            let height = dot(&mirrored, &facet);
            let is_below = height.lt(lanes.splat(0.0));
            let above = mirrored - facet * (height * 2.0);
            let mirrored = Vectors::select(is_below, above, mirrored);
            let mirrored = units(lanes, &mirrored, &facet);
            let away = leaving(lanes, &mirrored, &facet, lanes.load(&sights.error[at..]));
            let origin = sights.point.load(lanes, at) + facet * away;
            // Rounding may send a ray that touches to the other side.
            let is_inside = away.lt(lanes.splat(0.0));
            let outside = is_inside.select(lanes.splat(-1.0), lanes.splat(outside));
            let share = group.share.load(lanes, at) * lanes.splat(gloss);
            let asked = lanes.first(group.count - at);
            self.push(lanes, (origin, mirrored), &share, asked, (at, depth, outside));
        }
    }
}

/// How far along the normal rays of those directions start from their points, as
/// [`lancer_kernel::SurfacePoint::leave`] has it.
#[inline(always)]
fn leaving<L: Lanes>(
    lanes: L,
    direction: &Vectors<L::Real>,
    normal: &Vectors<L::Real>,
    error: L::Real,
) -> L::Real {
    let away = error * 2.0;
    dot(direction, normal).lt(lanes.splat(0.0)).select(-away, away)
}
