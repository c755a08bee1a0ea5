use super::fresnel::{Refraction, mirrored_by_sheet, reflect, refract};
use super::lights::{Lights, Seen};
use super::media::{Media, medium, transmittance};
use super::stops::Stop;
use super::view::View;
use crate::{RayCounts, Rgb, Tracer};
use lancer_film::LayerPixel;
use lancer_kernel::{Prepared, SurfacePoint};
use lancer_math::{Ray, Vector};
use lancer_scene::Scene;

/// Red, green and blue while they are summed up.
pub(super) type Rgb64 = [f64; 3];

/// Column and row of a pixel.
pub(super) type Place = (u32, u32);

pub(super) fn times(a: Rgb64, b: Rgb64) -> Rgb64 {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

fn scaled(a: Rgb64, factor: f64) -> Rgb64 {
    a.map(|a| a * factor)
}

/// After so many surfaces a ray is given up even where it matters.
pub(super) const DEEPEST: u32 = 10_000;

/// A ray whose share of the pixel is this part of what may still be left out
/// is left out. Smaller parts leave out more rays before the sum is used up.
const DROPPED_PART: f64 = 0.125;

/// The engine made ready for a scene.
pub(super) struct WhittedTracer {
    view: View,
    prepared: Prepared,
    lights: Lights,
    background: Rgb64,
    cutoff: f64,
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
}

/// A pixel while it is summed up.
struct Sum<'a> {
    radiance: Rgb64,
    /// Rays to follow. What they see is added up, so their order changes nothing
    /// but the rounding, and it is always the same.
    pending: Vec<Pending>,
    /// How much may still be left out.
    slack: f64,
    counts: &'a mut RayCounts,
    place: Place,
}

impl WhittedTracer {
    pub(super) fn new(scene: &Scene, cutoff: f64) -> Self {
        let view = View::new(&scene.camera);
        let prepared = Prepared::new(scene);
        let around_eye = view.eye().map_or_else(Media::default, |eye| {
            Media::new(prepared.solids_at(&eye))
        });
        Self {
            view,
            lights: Lights::new(scene),
            background: scene.background.get(),
            cutoff,
            prepared,
            around_eye,
        }
    }

    /// The ray of a pixel's centre and the solids that it starts in.
    fn primary(&self, x: u32, y: u32) -> (Ray, Media) {
        let ray = self.view.ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let media = match self.view.eye() {
            Some(_) => self.around_eye.clone(),
            None => Media::new(self.prepared.solids_at(&ray.origin)),
        };
        (ray, media)
    }

    fn radiance(&self, x: u32, y: u32, counts: &mut RayCounts) -> Rgb64 {
        let (ray, media) = self.primary(x, y);
        counts.primary += 1;
        let mut sum = Sum {
            radiance: [0.0; 3],
            pending: vec![Pending { ray, share: [1.0; 3], media, depth: 0 }],
            slack: self.cutoff,
            counts,
            place: (x, y),
        };
        while let Some(next) = sum.pending.pop() {
            self.follow(next, &mut sum);
        }
        sum.radiance
    }

    fn follow(&self, pending: Pending, sum: &mut Sum<'_>) {
        let Pending { ray, share, media, depth } = pending;
        let here = medium(media.top(&self.prepared), &self.prepared);
        let Some(hit) = self.prepared.nearest(&ray, f64::INFINITY) else {
            let share = times(share, transmittance(&here, f64::INFINITY));
            return sum.add(share, self.background);
        };
        let share = times(share, transmittance(&here, hit.t));
        if !self.prepared.surface(hit.item).is_transparent() {
            let point = self.prepared.expand(&ray, &hit);
            return self.opaque(&ray, &point, Pending { ray, share, media, depth }, sum);
        }
        let stop = Stop::at(&self.prepared, &ray, &hit);
        match stop.opaque() {
            Some(point) => self.opaque(&ray, point, Pending { ray, share, media, depth }, sum),
            None => self.transparent(&stop, Pending { ray, share, media, depth }, sum),
        }
    }

    /// A surface that lets nothing through.
    fn opaque(&self, ray: &Ray, point: &SurfacePoint<'_>, at: Pending, sum: &mut Sum<'_>) {
        let seen = Seen::new(ray, point, &at.media);
        let gloss = point.surface.gloss.get();
        sum.add(at.share, point.surface.emission.get());
        self.matte(&seen, scaled(at.share, 1.0 - gloss), sum);
        if gloss > 0.0 {
            let mirrored = point.leave(reflect(ray.direction, seen.shading, seen.facet));
            sum.push(mirrored, scaled(at.share, gloss), at.media, at.depth, Kind::Reflected);
        }
    }

    /// Surfaces that let light through, at one place.
    fn transparent(&self, stop: &Stop<'_>, at: Pending, sum: &mut Sum<'_>) {
        let Pending { ray, mut share, media, depth } = at;
        let here = medium(media.top(&self.prepared), &self.prepared);
        let more = stop.thickness();
        let mirror = |seen: &Seen<'_>| {
            seen.point.leave_by(reflect(ray.direction, seen.shading, seen.facet), more)
        };
        let mut last = None;
        for (point, cosine) in stop.sheets() {
            let seen = Seen::new(&ray, point, &media);
            let parts = Parts::new(point);
            let mirrored = mirrored_by_sheet(cosine, here.ior.get(), point.surface.medium.ior.get());
            sum.add(share, point.surface.emission.get());
            self.matte(&seen, scaled(share, parts.matte), sum);
            let back = scaled(share, parts.gloss + parts.clear * mirrored);
            sum.push(mirror(&seen), back, media.clone(), depth, Kind::Reflected);
            share = scaled(share, parts.clear * (1.0 - mirrored));
            last = Some(*point);
        }
        let mut beyond = media.clone();
        let border = stop.border(&self.prepared, &mut beyond);
        let surface = border.as_ref().and_then(|border| {
            if !border.makes_sense {
                sum.counts.troubles.media.at(sum.place);
            }
            border.surface.map(|(point, _)| (border, point))
        });
        let Some((border, point)) = surface else {
            // Nothing bends it here.
            if let Some(point) = last.or_else(|| stop.any()) {
                let onward = point.leave_by(ray.direction, more);
                sum.push(onward, share, beyond, depth, Kind::Transmitted);
            }
            return;
        };
        let seen = Seen::new(&ray, point, &media);
        let parts = Parts::new(point);
        let n1 = medium(border.before, &self.prepared).ior.get();
        let n2 = medium(border.after, &self.prepared).ior.get();
        sum.add(share, point.surface.emission.get());
        self.matte(&seen, scaled(share, parts.matte), sum);
        match refract(ray.direction, seen.refracting(&ray), n1, n2) {
            Refraction::Total => {
                let back = scaled(share, parts.gloss + parts.clear);
                sum.push(mirror(&seen), back, media.clone(), depth, Kind::Reflected);
            }
            Refraction::Part { mirrored, direction } => {
                let back = scaled(share, parts.gloss + parts.clear * mirrored);
                sum.push(mirror(&seen), back, media.clone(), depth, Kind::Reflected);
                let through = scaled(share, parts.clear * (1.0 - mirrored));
                let onward = point.leave_by(direction, more);
                sum.push(onward, through, beyond, depth, Kind::Transmitted);
            }
        }
    }

    /// Adds what lights make of a surface's matte part.
    fn matte(&self, seen: &Seen<'_>, share: Rgb64, sum: &mut Sum<'_>) {
        let share = times(share, seen.point.albedo);
        if share != [0.0; 3] {
            let light = self.lights.gather(&self.prepared, seen, sum.counts, sum.place);
            sum.add(share, light);
        }
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
    fn new(ray: &Ray, point: &'a SurfacePoint<'a>, media: &'a Media) -> Self {
        let from_behind = ray.direction.dot(&point.normal) > 0.0;
        let side = |normal: Vector| if from_behind { -normal } else { normal };
        Self { point, facet: side(point.normal), shading: side(point.shading), media }
    }

    /// The normal to bend a ray at: that to shade with, unless the ray comes from
    /// behind it.
    fn refracting(&self, ray: &Ray) -> Vector {
        if ray.direction.dot(&self.shading) < 0.0 { self.shading } else { self.facet }
    }
}

/// What a ray comes from.
#[derive(Clone, Copy)]
enum Kind {
    Reflected,
    Transmitted,
}

impl Sum<'_> {
    fn add(&mut self, share: Rgb64, radiance: Rgb64) {
        for i in 0..3 {
            // Nothing of something infinite is nothing.
            if share[i] != 0.0 && radiance[i] != 0.0 {
                self.radiance[i] += share[i] * radiance[i];
            }
        }
    }

    /// Keeps a ray to be followed, unless it matters too little.
    ///
    /// The shares of all rays of a pixel that are left out add up to the cutoff
    /// at most. So if none of them would have seen anything brighter than
    /// display white, the pixel is off by the cutoff at most.
    fn push(&mut self, ray: Ray, share: Rgb64, media: Media, depth: u32, kind: Kind) {
        let size = share[0].max(share[1]).max(share[2]);
        if size <= self.slack * DROPPED_PART {
            self.slack -= size;
            return;
        }
        if depth >= DEEPEST {
            self.counts.troubles.depth.at(self.place);
            return;
        }
        match kind {
            Kind::Reflected => self.counts.reflected += 1,
            Kind::Transmitted => self.counts.transmitted += 1,
        }
        self.pending.push(Pending { ray, share, media, depth: depth + 1 });
    }
}

impl Tracer for WhittedTracer {
    fn pixel(&self, x: u32, y: u32, counts: &mut RayCounts) -> Rgb {
        let radiance = self.radiance(x, y, counts);
        let pixel = radiance.map(|v| v as f32);
        if pixel.iter().all(|v| v.is_finite()) {
            return pixel;
        }
        counts.troubles.not_finite.at((x, y));
        [0.0; 3]
    }

    fn first_hit(&self, x: u32, y: u32) -> Option<LayerPixel> {
        let (ray, _) = self.primary(x, y);
        let Some(hit) = self.prepared.nearest(&ray, f64::INFINITY) else {
            return Some(LayerPixel::MISS);
        };
        let point = self.prepared.expand(&ray, &hit);
        let nothing = Media::default();
        let seen = Seen::new(&ray, &point, &nothing);
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
