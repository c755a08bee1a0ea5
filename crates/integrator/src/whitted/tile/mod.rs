//! The rays of a tile's pixels, or of samples, in stages, several at once: from the eye,
//! then from mirror to mirror until nothing that matters is left.
//!
//! At each depth all rays of the batch are met with the shapes, sorted by what they
//! met, and shaded item by item; what a mirror throws back is the next depth. A
//! pixel has one ray at most at a time, so its sums have the order that they have
//! when the pixel is followed alone, and the same bits; and likewise a sample. A ray that meets a transparent
//! surface is followed alone from there on.

mod ball;
mod buffers;
mod light;
mod places;
mod shade;
mod units;

pub(super) use units::units;

use super::signature::{MIRRORED, Signing, Way};
use super::tracer::{DEEPEST, Kind, WhittedTracer};
use crate::enclose::{cone, extent};
use crate::rows::Triples;
use crate::{RayCounts, Rgb, Sample, Seen};
use buffers::{Buffers, Bundle, Signatures};
use lancer_film::Window;
use lancer_kernel::lanes::{Lanes, Mask, Real, Vectors, Work, dispatch};
use lancer_kernel::{Candidates, LEAN, Rays};
use lancer_math::{Bounds, Point, Vector};
use places::{Pixels, Places, Samples};
use std::cell::Cell;

thread_local! {
    static BUFFERS: Cell<Option<Box<Buffers>>> = const { Cell::new(None) };
}

/// Places to be seen.
struct Batch<'a, P> {
    tracer: &'a WhittedTracer,
    places: P,
    counts: &'a mut RayCounts,
    buffers: &'a mut Buffers,
}

impl WhittedTracer {
    /// The colours of the pixels of a tile, which is no larger than
    /// [`TILE_SIDE`](crate::TILE_SIDE) squared.
    pub(super) fn pixels(&self, window: Window, colours: &mut [Rgb], counts: &mut RayCounts) {
        self.stages(Pixels { window, colours }, counts);
    }

    /// What samples see, which are no more than [`MOST_SAMPLES`](crate::MOST_SAMPLES).
    pub(super) fn samples(&self, samples: &[Sample], seen: &mut [Seen], counts: &mut RayCounts) {
        self.stages(Samples { samples, seen }, counts);
    }

    fn stages(&self, places: impl Places, counts: &mut RayCounts) {
        // Taken, since a shape of the user's own may render a picture to answer.
        let mut buffers = BUFFERS.take().unwrap_or_else(Buffers::new);
        let batch = Batch { tracer: self, places, counts, buffers: &mut buffers };
        dispatch(self.kernel.lanes, batch);
        BUFFERS.set(Some(buffers));
    }
}

impl<P: Places> Work for Batch<'_, P> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self, lanes: L) {
        let among = self.begin(lanes);
        let mut among = if self.culls_tiles() { among } else { Candidates::ALL };
        let mut kind = Kind::Primary;
        let mut depth = 0;
        let mut way = Way::EYE;
        while self.buffers.rays.count > 0 {
            if self.meet(lanes, &among, depth) {
                self.buffers.all_alike();
            } else {
                self.buffers.sort();
            }
            self.buffers.next.count = 0;
            self.shade_all(lanes, (depth, kind, way));
            std::mem::swap(&mut self.buffers.rays, &mut self.buffers.next);
            self.buffers.rays.pad();
            if self.culls_tiles() && self.buffers.rays.count > 0 {
                among = self.ahead(lanes);
            }
            kind = Kind::Reflected;
            depth += 1;
            way = way.then(MIRRORED);
        }
        self.end();
    }
}

impl<P: Places> Batch<'_, P> {
    /// The rays of the places, and what they may meet.
    #[inline(always)]
    fn begin<L: Lanes>(&mut self, lanes: L) -> Candidates {
        let view = &self.tracer.view;
        let Buffers { rays, radiance, signatures, .. } = &mut *self.buffers;
        rays.count = self.places.count();
        let has_lens = view.has_lens();
        let [left, top, right, bottom] = if has_lens {
            self.places.through_lens(view, rays);
            [0.0; 4]
        } else {
            self.places.rays(lanes, view, rays)
        };
        for k in 0..rays.count {
            rays.pixel[k] = k as u16;
        }
        rays.share.0.iter_mut().for_each(|share| share[..rays.count].fill(1.0));
        radiance.0.iter_mut().for_each(|radiance| radiance[..rays.count].fill(0.0));
        if P::Signing::SIGNED {
            signatures[..rays.count].fill(0);
        }
        rays.pad();

        if has_lens {
            return self.ahead(lanes);
        }
        let Some(eye) = view.eye() else { return Candidates::ALL };
        let corners = [(left, top), (right, top), (left, bottom), (right, bottom)]
            .map(|(x, y)| view.ray(x, y).direction);
        let Some(axis) = lancer_math::unit(corners.iter().sum::<Vector>()) else {
            return Candidates::ALL;
        };
        let cosine = corners.iter().map(|corner| corner.dot(&axis)).fold(1.0, f64::min);
        let prepared = &self.tracer.prepared;
        prepared.candidates_in_cone(&eye, 0.0, &axis, cosine).in_front(prepared, &eye, &corners)
    }

    fn culls_tiles(&self) -> bool {
        self.tracer.kernel.culling.tile_candidates
    }

    /// What rays of a lens and mirrored ones may meet.
    #[inline(always)]
    fn ahead<L: Lanes>(&self, lanes: L) -> Candidates {
        let rays = &self.buffers.rays;
        let origins = extent(lanes, &rays.origin, 0..rays.count);
        let (axis, cosine) = cone(lanes, &rays.direction, 0..rays.count);
        let (centre, radius) = ball_around(&origins);
        self.tracer.prepared.candidates_in_cone(&centre, radius, &axis, cosine)
    }

    /// What the rays meet, and whether it is the same for all.
    #[inline(always)]
    fn meet<L: Lanes>(&mut self, lanes: L, among: &Candidates, depth: u32) -> bool {
        let rays = &mut self.buffers.rays;
        let mut is_another = lanes.mask(0);
        for at in (0..rays.count).step_by(L::WIDTH) {
            let asked = lanes.first(rays.count - at);
            let register =
                Rays::new(lanes, rays.origin.load(lanes, at), rays.direction.load(lanes, at));
            let outside = (depth > 0 && self.tracer.kernel.culling.tile_candidates)
                .then(|| lanes.load(&rays.outside[at..]));
            let prepared = &self.tracer.prepared;
            let hits = prepared.nearest_in_lanes(&register, f64::INFINITY, asked, (among, outside));
            hits.t.store(&mut rays.t[at..]);
            hits.item.store(&mut rays.item[at..]);
            hits.part.store(&mut rays.part[at..]);
            is_another = is_another | (asked & !hits.item.eq(lanes.splat(rays.item[0])));
        }
        rays.pad();
        !is_another.any()
    }

    /// Shades all rays, those that met the same item together.
    #[inline(always)]
    fn shade_all<L: Lanes>(&mut self, lanes: L, (depth, kind, way): (u32, Kind, Way)) {
        let mut begin = 0;
        for index in 0..self.buffers.items.len() {
            let (item, count) = self.buffers.items[index];
            let end = begin + usize::from(count);
            let is_all = count as usize == self.buffers.rays.count;
            let Buffers { rays, group, order, .. } = &mut *self.buffers;
            if is_all {
                std::mem::swap(rays, group);
            } else {
                group.gather(rays, &order[begin..end]);
            }
            if item < 0.0 {
                self.miss(kind, way);
            } else if !LEAN && self.tracer.prepared.surface(item as u32).is_transparent() {
                self.follow_alone(depth, kind, way);
            } else {
                self.count(kind);
                self.shade(lanes, item as u32, depth, way);
            }
            begin = end;
        }
    }

    fn count(&mut self, kind: Kind) {
        let count = self.buffers.group.count as u64;
        match kind {
            Kind::Primary => self.counts.primary += count,
            Kind::Reflected => self.counts.reflected += count,
            Kind::Transmitted => self.counts.transmitted += count,
        }
    }

    /// Rays that see the background.
    fn miss(&mut self, kind: Kind, way: Way) {
        self.count(kind);
        if P::Signing::SIGNED {
            let ray = way.meets(None).at(0.0, 0);
            let Buffers { group, signatures, .. } = &mut *self.buffers;
            group.pixel[..group.count].iter().for_each(|pixel| sign(signatures, *pixel, ray));
        }
        let Buffers { group, radiance, .. } = &mut *self.buffers;
        for k in 0..group.count {
            add(radiance, group.pixel[k], group.share(k), self.tracer.background);
        }
    }

    /// Rays whose pixels are followed alone from here on.
    fn follow_alone(&mut self, depth: u32, kind: Kind, way: Way) {
        let Buffers { group, radiance, signatures, .. } = &mut *self.buffers;
        for k in 0..group.count {
            let pixel = group.pixel[k];
            let signature = &mut signatures[usize::from(pixel)];
            let sum = [0, 1, 2].map(|i| radiance.0[i][usize::from(pixel)]);
            let (sum, signed) = self.tracer.go_on::<P::Signing>(
                (group.ray(k), group.share(k), depth, kind),
                (way, (sum, *signature)),
                self.places.task(pixel),
                self.counts,
            );
            *signature = signed;
            (0..3).for_each(|i| radiance.0[i][usize::from(pixel)] = sum[i]);
        }
    }

    /// Keeps what mirrors throw back, unless it does not matter.
    #[inline(always)]
    fn push<L: Lanes>(
        &mut self,
        lanes: L,
        (origin, direction): (Vectors<L::Real>, Vectors<L::Real>),
        share: &Vectors<L::Real>,
        asked: L::Mask,
        (at, depth, outside): (usize, u32, L::Real),
    ) {
        let zero = lanes.splat(0.0);
        let largest = share.amax();
        let is_finite = largest.lt(lanes.splat(f64::INFINITY));
        if (asked & !is_finite).any() {
            self.spoil((asked & !is_finite).bits(), at);
        }
        let asked = asked & is_finite & !largest.eq(zero);
        let matters = asked & largest.gt(lanes.splat(self.tracer.cutoff));
        if depth >= DEEPEST {
            self.give_up(matters.bits(), at);
            return;
        }
        let Buffers { group, next, .. } = &mut *self.buffers;
        let Bundle { count, origin: to, direction: way, share: part, pixel, outside: out, .. } =
            &mut **next;
        outside.store_packed(matters, &mut out[*count..]);
        to.pack(lanes, *count, &origin, matters);
        way.pack(lanes, *count, &direction, matters);
        part.pack(lanes, *count, share, matters);
        for k in lancer_kernel::lanes::lanes_of(matters.bits()) {
            pixel[*count] = group.pixel[at + k];
            *count += 1;
        }
    }

    /// Pixels of which nothing can be known any more.
    #[cold]
    fn spoil(&mut self, bits: u32, at: usize) {
        for k in lancer_kernel::lanes::lanes_of(bits) {
            let pixel = usize::from(self.buffers.group.pixel[at + k]);
            self.buffers.radiance.0.iter_mut().for_each(|radiance| radiance[pixel] = f64::NAN);
        }
    }

    #[cold]
    fn give_up(&mut self, bits: u32, at: usize) {
        for k in lancer_kernel::lanes::lanes_of(bits) {
            let pixel = self.places.pixel(self.buffers.group.pixel[at + k]);
            self.counts.troubles.given_up.at(pixel);
        }
    }

    /// What the places see.
    fn end(&mut self) {
        let Buffers { radiance, signatures, .. } = &*self.buffers;
        let [red, green, blue] = &radiance.0;
        let colours = red.iter().zip(green).zip(blue);
        let colours = colours.map(
            #[inline(always)]
            |((red, green), blue)| [*red as f32, *green as f32, *blue as f32],
        );
        self.places.keep(colours.zip(signatures.iter().copied()), self.counts);
    }
}

/// Adds to the signature of a place what a ray adds.
#[inline(always)]
fn sign(signatures: &mut Signatures, pixel: u16, ray: u64) {
    let signature = &mut signatures[usize::from(pixel)];
    *signature = signature.wrapping_add(ray);
}

/// Adds to a pixel what is seen with a share.
#[inline(always)]
fn add(radiance: &mut Triples, pixel: u16, share: [f64; 3], seen: [f64; 3]) {
    for i in 0..3 {
        // Nothing of something infinite is nothing.
        if share[i] != 0.0 && seen[i] != 0.0 {
            radiance.0[i][usize::from(pixel)] += share[i] * seen[i];
        }
    }
}

/// A ball around a box.
fn ball_around(bounds: &Bounds) -> (Point, f64) {
    let centre = bounds.centre();
    let half = (bounds.max - centre).norm().max((bounds.min - centre).norm());
    (centre, half * (1.0 + 1e-9))
}

/// x x' + y y' + z z' in that order, as one ray alone has it.
#[inline(always)]
fn dot<R: Real>(a: &Vectors<R>, b: &Vectors<R>) -> R {
    a.x * b.x + a.y * b.y + a.z * b.z
}
