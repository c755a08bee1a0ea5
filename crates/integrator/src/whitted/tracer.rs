use super::fresnel::{Refraction, mirrored_by_sheet, reflect, refract};
use super::lights::{Lights, Seen};
use super::media::{Media, medium, transmittance};
use super::record::{Notes, Record};
use super::signature::{self, MIRRORED, ONWARD, Recorded, Signed, Signing, Spot, Unsigned, Way};
use super::stops::Stop;
use super::view::View;
use crate::engine::in_parts;
use crate::{
    MOST_SAMPLES, Plan, RayCounts, RayFate, RayKind, RayTree, Rgb, Sample, Sampler, Stream, Tracer,
};
use lancer_film::{LayerPixel, Window};
use lancer_kernel::{KernelSettings, LEAN, Prepared, SurfacePoint};
use lancer_math::{Ray, Vector};
use lancer_scene::Scene;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Red, green and blue while they are summed up.
pub(super) type Rgb64 = [f64; 3];

/// Column and row of a pixel.
pub(super) type Place = (u32, u32);

/// What rays are followed for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Task {
    pub(super) pixel: Place,
    /// The numbers of the sample.
    pub(super) stream: Stream,
}

impl Task {
    /// A pixel that is seen at its centre.
    pub(super) fn of_pixel(pixel: Place) -> Self {
        Self { pixel, stream: Stream::new(0, pixel, 0, 0) }
    }

    /// A sample.
    pub(super) const fn of_sample(sample: &Sample) -> Self {
        Self { pixel: sample.pixel, stream: sample.stream }
    }
}

pub(super) fn times(a: Rgb64, b: Rgb64) -> Rgb64 {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

fn scaled(a: Rgb64, factor: f64) -> Rgb64 {
    a.map(|a| a * factor)
}

/// After so many surfaces a ray is given up even where it matters.
pub(super) const DEEPEST: u32 = 10_000;

/// After so many rays a pixel is given up even where the others matter: between
/// perfect mirrors, glass splits rays without end.
pub(super) const MOST_RAYS: u32 = 20_000;

/// The engine made ready for a scene.
pub(super) struct WhittedTracer {
    pub(super) view: View,
    pub(super) prepared: Prepared,
    pub(super) lights: Lights,
    pub(super) background: Rgb64,
    pub(super) cutoff: f64,
    pub(super) kernel: KernelSettings,
    /// The solids that the eye is in.
    around_eye: Media,
}

/// A ray that is still to be followed.
struct Pending {
    ray: Ray,
    /// How much of what it sees is in the pixel.
    share: Rgb64,
    media: Media,
    /// How many surfaces came before.
    depth: u32,
    /// Which ray of the pixel it is.
    number: u32,
    kind: Kind,
    way: Way,
}

impl Pending {
    /// The share of the component that it matters most for.
    fn size(&self) -> f64 {
        self.share[0].max(self.share[1]).max(self.share[2])
    }
}

/// The largest share comes first; of equal ones the earlier ray, so that the
/// order, and with it the rounding of the sum, is always the same.
impl Ord for Pending {
    fn cmp(&self, other: &Self) -> Ordering {
        self.size().total_cmp(&other.size()).then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for Pending {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Pending {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Pending {}

/// A pixel or sample while it is summed up.
struct Sum<'a, N> {
    radiance: Rgb64,
    signature: u64,
    /// Rays to follow.
    pending: BinaryHeap<Pending>,
    /// What their shares add up to.
    left: f64,
    /// How many rays there have been.
    rays: u32,
    /// What the shares of those that were given up add up to.
    given_up: f64,
    counts: &'a mut RayCounts,
    task: Task,
    notes: &'a mut N,
}

impl WhittedTracer {
    pub(super) fn new(scene: &Scene, cutoff: f64, plan: &Plan) -> Self {
        let view = View::new(&scene.camera);
        let prepared = Prepared::without(scene, &plan.kernel, &plan.absent);
        let around_eye =
            view.eye().map_or_else(Media::default, |eye| Media::new(prepared.solids_at(&eye)));
        Self {
            view,
            lights: Lights::new(scene, plan),
            background: scene.background.get(),
            cutoff,
            kernel: plan.kernel,
            prepared,
            around_eye,
        }
    }

    /// What begins in a medium is followed alone.
    fn begins_in_air(&self) -> bool {
        match self.view.eye() {
            Some(_) => self.around_eye.is_empty(),
            None => !self.prepared.has_transparent(),
        }
    }

    /// The ray of a place of the picture and the solids that it starts in.
    fn primary(&self, at: [f64; 2], stream: Stream) -> (Ray, Media) {
        let ray = self.view.ray_of_sample(at, stream);
        let media = match self.view.eye() {
            Some(_) => self.around_eye.clone(),
            None => Media::new(self.prepared.solids_at(&ray.origin)),
        };
        (ray, media)
    }

    /// What is seen at a place, followed alone, and its signature.
    fn alone<S: Signing>(
        &self,
        at: [f64; 2],
        task: Task,
        counts: &mut RayCounts,
        notes: &mut S::Notes,
    ) -> (Rgb, u64) {
        let (ray, media) = self.primary(at, task.stream);
        notes.note(|record| record.sent(0, RayKind::Primary, &ray, [1.0; 3], &media));
        let (depth, number, kind, way) = (0, 0, Kind::Primary, Way::EYE);
        let first = Pending { ray, share: [1.0; 3], media, depth, number, kind, way };
        let (radiance, signature) = self.sum::<S>(first, ([0.0; 3], 0), task, (counts, notes));
        let radiance = radiance.map(|v| v as f32);
        if radiance.iter().all(|v| v.is_finite()) {
            return (radiance, signature);
        }
        counts.troubles.not_finite.at(task.pixel);
        ([0.0; 3], signature)
    }

    /// All rays of a pixel, followed alone at its centre.
    pub(super) fn explain(&self, scene: &Scene, pixel: Place) -> RayTree {
        let mut record = Record::default();
        let (task, mut counts) = (Task::of_pixel(pixel), RayCounts::default());
        let at = centre(pixel.0, pixel.1);
        let (radiance, _) = self.alone::<Recorded>(at, task, &mut counts, &mut record);
        let rays = record.finish(scene, &self.prepared);
        RayTree { pixel: [pixel.0, pixel.1], radiance, rays }
    }

    /// The radiance and signature of a pixel that are known but for what its only ray sees,
    /// which has left the last of so many mirrors.
    pub(super) fn go_on<S: Signing<Notes = ()>>(
        &self,
        (ray, share, depth, kind): (Ray, Rgb64, u32, Kind),
        (way, known): (Way, (Rgb64, u64)),
        task: Task,
        counts: &mut RayCounts,
    ) -> (Rgb64, u64) {
        let (media, number) = (Media::default(), depth);
        let next = Pending { ray, share, media, depth, number, kind, way };
        self.sum::<S>(next, known, task, (counts, &mut ()))
    }

    fn sum<S: Signing>(
        &self,
        first: Pending,
        (radiance, signature): (Rgb64, u64),
        task: Task,
        (counts, notes): (&mut RayCounts, &mut S::Notes),
    ) -> (Rgb64, u64) {
        let mut sum = Sum {
            radiance,
            signature,
            pending: BinaryHeap::new(),
            left: 0.0,
            rays: first.number,
            given_up: 0.0,
            counts,
            task,
            notes,
        };
        self.follow::<S>(first, &mut sum);
        // The largest shares first, and until all that are left together are small
        // enough: no fewer rays could do. If none of those left would have seen
        // anything brighter than display white, the pixel is off by the cutoff at
        // most.
        while sum.left > self.cutoff
            && sum.rays < MOST_RAYS
            && let Some(next) = sum.pending.pop()
        {
            sum.left -= next.size();
            self.follow::<S>(next, &mut sum);
        }
        // Without rays nothing is left, whatever rounding has made of the sum.
        let left = if sum.pending.is_empty() { 0.0 } else { sum.left };
        if left + sum.given_up > self.cutoff {
            sum.counts.troubles.given_up.at(task.pixel);
        }
        if left > self.cutoff {
            sum.notes.note(Record::gives_up_the_rest);
        }
        (sum.radiance, sum.signature)
    }

    fn follow<S: Signing>(&self, pending: Pending, sum: &mut Sum<'_, S::Notes>) {
        let Pending { ray, share, media, depth, number, kind, way } = pending;
        match kind {
            Kind::Primary => sum.counts.primary += 1,
            Kind::Reflected => sum.counts.reflected += 1,
            Kind::Transmitted => sum.counts.transmitted += 1,
        }
        sum.notes.note(|record| record.follows(number));
        let here = medium(media.top(&self.prepared), &self.prepared);
        let Some(hit) = self.prepared.nearest(&ray, f64::INFINITY) else {
            let share = times(share, transmittance(&here, f64::INFINITY));
            if S::SIGNED {
                sum.sign(way.meets(None).at(0.0, 0));
            }
            sum.notes.note(|record| record.sees(share, self.background));
            return sum.add(share, self.background);
        };
        let share = times(share, transmittance(&here, hit.t));
        sum.notes.note(|record| record.meets(share, hit.t));
        if LEAN || !self.prepared.surface(hit.item).is_transparent() {
            let point = self.prepared.expand(&ray, &hit);
            let at = Pending { ray, share, media, depth, number, kind, way };
            return self.opaque::<S>(&point, 0.0, at, sum);
        }
        let stop = Stop::at(&self.prepared, &ray, &hit);
        let at = Pending { ray, share, media, depth, number, kind, way };
        match stop.opaque() {
            Some(point) => self.opaque::<S>(point, stop.thickness(), at, sum),
            None => self.transparent::<S>(&stop, at, sum),
        }
    }

    /// A surface that lets nothing through.
    fn opaque<S: Signing>(
        &self,
        point: &SurfacePoint<'_>,
        more: f64,
        at: Pending,
        sum: &mut Sum<'_, S::Notes>,
    ) {
        let seen = Seen::new(&at.ray, point, more, &at.media);
        let gloss = point.surface.gloss.get();
        let spot = self.shown::<S>(&seen, (at.share, 1.0 - gloss), at.way, sum);
        if S::SIGNED {
            sum.sign(at.way.meets(Some(point.item)).at(spot.lit, spot.piece));
        }
        if gloss > 0.0 {
            let mirrored = seen.leave(reflect(at.ray.direction, seen.shading, seen.facet));
            let next = (mirrored, scaled(at.share, gloss), at.media);
            sum.push(next, at.depth, (Kind::Reflected, at.way.then(MIRRORED)));
        }
    }

    /// Surfaces that let light through, at one place.
    fn transparent<S: Signing>(&self, stop: &Stop<'_>, at: Pending, sum: &mut Sum<'_, S::Notes>) {
        let Pending { ray, mut share, media, depth, mut way, .. } = at;
        let here = medium(media.top(&self.prepared), &self.prepared);
        let more = stop.thickness();
        let mirror = |seen: &Seen<'_>| seen.leave(reflect(ray.direction, seen.shading, seen.facet));
        let mut last = None;
        for (point, cosine) in stop.sheets() {
            let seen = Seen::new(&ray, point, more, &media);
            let parts = Parts::new(point);
            let mirrored =
                mirrored_by_sheet(cosine, here.ior.get(), point.surface.medium.ior.get());
            let spot = self.shown::<S>(&seen, (share, parts.matte), way, sum);
            if S::SIGNED {
                sum.sign(way.meets(Some(point.item)).at(spot.lit, spot.piece));
            }
            let back = scaled(share, parts.gloss + parts.clear * mirrored);
            let next = (mirror(&seen), back, media.clone());
            sum.push(next, depth, (Kind::Reflected, way.then(MIRRORED)));
            way = way.then(ONWARD);
            share = scaled(share, parts.clear * (1.0 - mirrored));
            last = Some(*point);
        }
        let mut beyond = media.clone();
        let border = stop.border(&self.prepared, &mut beyond);
        let surface = border.as_ref().and_then(|border| {
            if !border.makes_sense {
                sum.counts.troubles.media.at(sum.task.pixel);
            }
            border.surface.map(|(point, _)| (border, point))
        });
        let Some((border, point)) = surface else {
            // Nothing bends it here.
            let onward = match last {
                Some(sheet) => sheet.leave_by(ray.direction, more),
                None => stop.straight_on(ray.direction, &beyond, more),
            };
            // It is as if nothing had been there.
            return sum.push((onward, share, beyond), depth, (Kind::Transmitted, way));
        };
        let seen = Seen::new(&ray, point, more, &media);
        let parts = Parts::new(point);
        let n1 = medium(border.before, &self.prepared).ior.get();
        let n2 = medium(border.after, &self.prepared).ior.get();
        let mut spot = self.shown::<S>(&seen, (share, parts.matte), way, sum);
        let (reflected, transmitted) =
            ((Kind::Reflected, way.then(MIRRORED)), (Kind::Transmitted, way.then(ONWARD)));
        match seen.refract(ray.direction, n1, n2) {
            Refraction::Total => {
                spot.lit += signature::TOTAL;
                let back = scaled(share, parts.gloss + parts.clear);
                sum.push((mirror(&seen), back, media.clone()), depth, reflected);
            }
            Refraction::Part { mirrored, direction } => {
                let back = scaled(share, parts.gloss + parts.clear * mirrored);
                sum.push((mirror(&seen), back, media.clone()), depth, reflected);
                let through = scaled(share, parts.clear * (1.0 - mirrored));
                let onward = point.leave_by(direction, more);
                sum.push((onward, through, beyond), depth, transmitted);
            }
        }
        if S::SIGNED {
            sum.sign(way.meets(Some(point.item)).at(spot.lit, spot.piece));
        }
    }

    /// Adds a surface's emission and what lights make of its matte part, and says where on it
    /// that is.
    fn shown<S: Signing>(
        &self,
        seen: &Seen<'_>,
        (share, matte): (Rgb64, f64),
        way: Way,
        sum: &mut Sum<'_, S::Notes>,
    ) -> Spot {
        let mut spot = match S::SIGNED {
            true => Spot::new(&self.prepared, seen.point, seen.from_behind),
            false => Spot::default(),
        };
        let emission = seen.point.surface.emission.get();
        sum.add(share, emission);
        let matte = scaled(share, matte);
        sum.notes.note(|record| record.surface(seen, share, matte));
        let share = times(matte, seen.point.albedo);
        if share != [0.0; 3] {
            let to = (&mut spot, &mut *sum.counts, &mut *sum.notes);
            let light = self.lights.gather::<S>(&self.prepared, seen, to, (&sum.task, way));
            sum.add(share, light);
        }
        spot
    }
}

/// How the light that falls on a surface is shared out.
struct Parts {
    gloss: f64,
    clear: f64,
    matte: f64,
}

impl Parts {
    fn new(point: &SurfacePoint<'_>) -> Self {
        let (gloss, clear) = (point.surface.gloss.get(), point.surface.transparency.get());
        Self { gloss, clear: (1.0 - gloss) * clear, matte: (1.0 - gloss) * (1.0 - clear) }
    }
}

impl<'a> Seen<'a> {
    fn new(ray: &Ray, point: &'a SurfacePoint<'a>, more: f64, media: &'a Media) -> Self {
        let from_behind = ray.direction.dot(&point.normal) > 0.0;
        let side = |normal: Vector| if from_behind { -normal } else { normal };
        let (facet, shading) = (side(point.normal), side(point.shading));
        Self { point, more, from_behind, facet, shading, media }
    }

    /// The ray from here in that direction, past all that is crossed together.
    pub(super) fn leave(&self, direction: Vector) -> Ray {
        self.point.leave_by(direction, self.more)
    }

    /// What becomes of a ray: by the normal to shade with, unless the ray comes
    /// from behind it or would not go to the other side of the surface.
    fn refract(&self, direction: Vector, n1: f64, n2: f64) -> Refraction {
        if direction.dot(&self.shading) < 0.0 {
            let refraction = refract(direction, self.shading, n1, n2);
            match refraction {
                Refraction::Part { direction, .. } if direction.dot(&self.facet) >= 0.0 => {}
                _ => return refraction,
            }
        }
        refract(direction, self.facet, n1, n2)
    }
}

/// What a ray comes from.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Primary,
    Reflected,
    Transmitted,
}

impl Kind {
    /// As others are told of it.
    const fn name(self) -> RayKind {
        match self {
            Self::Primary => RayKind::Primary,
            Self::Reflected => RayKind::Reflected,
            Self::Transmitted => RayKind::Transmitted,
        }
    }
}

impl<N: Notes> Sum<'_, N> {
    fn add(&mut self, share: Rgb64, radiance: Rgb64) {
        for i in 0..3 {
            // Nothing of something infinite is nothing.
            if share[i] != 0.0 && radiance[i] != 0.0 {
                self.radiance[i] += share[i] * radiance[i];
            }
        }
    }

    fn sign(&mut self, ray: u64) {
        self.signature = self.signature.wrapping_add(ray);
    }

    /// Keeps a ray to be followed, unless it does not matter at all.
    fn push(
        &mut self,
        (ray, share, media): (Ray, Rgb64, Media),
        depth: u32,
        (kind, way): (Kind, Way),
    ) {
        self.rays += 1;
        let number = self.rays;
        self.notes.note(|record| record.sent(number, kind.name(), &ray, share, &media));
        let pending = Pending { ray, share, media, depth: depth + 1, number, kind, way };
        let size = pending.size();
        if size == 0.0 {
            return;
        }
        if !share.iter().all(|share| share.is_finite()) {
            // It is found where colours are looked at.
            self.radiance = [f64::NAN; 3];
            self.notes.note(|record| record.ends(number, RayFate::NotFinite));
            return;
        }
        if depth >= DEEPEST {
            self.given_up += size;
            self.notes.note(|record| record.ends(number, RayFate::GivenUp));
            return;
        }
        self.left += size;
        self.pending.push(pending);
    }
}

/// The place of a pixel's centre.
fn centre(x: u32, y: u32) -> [f64; 2] {
    [f64::from(x) + 0.5, f64::from(y) + 0.5]
}

impl Sampler for WhittedTracer {
    fn see(&self, samples: &[Sample], seen: &mut [crate::Seen], counts: &mut RayCounts) {
        if self.begins_in_air() {
            let parts = samples.chunks(MOST_SAMPLES).zip(seen.chunks_mut(MOST_SAMPLES));
            return parts.for_each(|(samples, seen)| self.samples(samples, seen, counts));
        }
        for (sample, seen) in samples.iter().zip(seen) {
            *seen = self.see_alone(sample, counts);
        }
    }

    fn see_alone(&self, sample: &Sample, counts: &mut RayCounts) -> crate::Seen {
        let (radiance, signature) =
            self.alone::<Signed>(sample.place, Task::of_sample(sample), counts, &mut ());
        crate::Seen { radiance, signature }
    }
}

impl Tracer for WhittedTracer {
    fn pixel(&self, x: u32, y: u32, counts: &mut RayCounts) -> Rgb {
        self.alone::<Unsigned>(centre(x, y), Task::of_pixel((x, y)), counts, &mut ()).0
    }

    fn sampler(&self) -> Option<&dyn Sampler> {
        Some(self)
    }

    fn tile(&self, tile: Window, pixels: &mut [Rgb], counts: &mut RayCounts) {
        if self.begins_in_air() {
            return in_parts(tile, pixels, |tile, pixels| self.pixels(tile, pixels, counts));
        }
        for (pixel, index) in pixels.iter_mut().zip(0..) {
            let (x, y) = (tile.x + index % tile.width, tile.y + index / tile.width);
            *pixel = self.pixel(x, y, counts);
        }
    }

    fn first_hit(&self, x: u32, y: u32) -> Option<LayerPixel> {
        // Through the middle of a lens.
        let [at_x, at_y] = centre(x, y);
        let ray = self.view.ray(at_x, at_y);
        let Some(hit) = self.prepared.nearest(&ray, f64::INFINITY) else {
            return Some(LayerPixel::MISS);
        };
        let point = self.prepared.expand(&ray, &hit);
        let nothing = Media::default();
        let seen = Seen::new(&ray, &point, 0.0, &nothing);
        Some(LayerPixel {
            axis_depth: (hit.t * ray.direction.dot(&self.view.axis())) as f32,
            ray_depth: hit.t as f32,
            normal: [0, 1, 2].map(|i| seen.shading[i] as f32),
            albedo: point.albedo.map(|share| share as f32),
            shape: point.shape + 1,
            instance: point.item + 1,
        })
    }
}
