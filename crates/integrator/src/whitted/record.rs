//! What is written down of the rays of a pixel, where somebody asks for it.

use super::lights::Seen;
use super::media::{Media, medium};
use super::tracer::{Rgb64, times};
use crate::{
    InMedium, LightAnswer, LightFate, MetSurface, NamedShape, RayFate, RayKind, ShadowRay,
    TracedRay,
};
use lancer_kernel::{Prepared, Which};
use lancer_math::{Ray, unit};
use lancer_scene::{Group, Pattern, Placed, Scene, Shadows, Shape};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Somebody who may want to have notes of what happens, or not.
pub(super) trait Notes {
    /// Writes something down, if so. Else nothing is computed for it.
    fn note(&mut self, write: impl FnOnce(&mut Record));
}

impl Notes for () {
    #[inline(always)]
    fn note(&mut self, _: impl FnOnce(&mut Record)) {}
}

impl Notes for Record {
    fn note(&mut self, write: impl FnOnce(&mut Record)) {
        write(self);
    }
}

/// The rays of a pixel so far.
#[derive(Debug, Default)]
pub(super) struct Record {
    /// By their numbers, also those that do not matter at all.
    rays: Vec<Sent>,
    /// The number of the one that is followed now.
    now: usize,
    /// What a light of radiance 1 adds to the pixel on the surface that was met last.
    matte: Rgb64,
}

#[derive(Debug)]
struct Sent {
    parent: usize,
    kind: RayKind,
    fate: RayFate,
    depth: u32,
    ray: Ray,
    share: Rgb64,
    left: Rgb64,
    media: Media,
    distance: Option<f64>,
    surfaces: Vec<Met>,
    background: Option<Rgb64>,
}

/// A surface, and what lights give there; shapes are items.
#[derive(Debug)]
struct Met {
    item: u32,
    point: [f64; 3],
    normal: [f64; 3],
    from_behind: bool,
    albedo: Rgb64,
    cell: Option<[f64; 2]>,
    glow: Rgb64,
    lights: Vec<Lit>,
}

#[derive(Debug)]
struct Lit {
    light: usize,
    answer: Answer,
    contribution: Rgb64,
    shadow: Option<ShadowRay>,
}

#[derive(Debug)]
enum Answer {
    Arrives(Rgb64),
    Hidden(u32),
    Absorbed,
    Behind,
    Elsewhere,
}

/// What a radiance adds of which there is that share; nothing of something infinite is nothing.
fn added(share: Rgb64, radiance: Rgb64) -> Rgb64 {
    [0, 1, 2].map(|i| if share[i] == 0.0 { 0.0 } else { share[i] * radiance[i] })
}

impl Record {
    /// The ray of that number, which follows those before, leaves from what the present one met.
    pub(super) fn sent(
        &mut self,
        number: u32,
        kind: RayKind,
        ray: &Ray,
        share: Rgb64,
        media: &Media,
    ) {
        let depth = if number == 0 { 0 } else { self.rays[self.now].depth + 1 };
        self.rays.push(Sent {
            parent: self.now,
            kind,
            fate: RayFate::CutOff,
            depth,
            ray: *ray,
            share,
            left: share,
            media: media.clone(),
            distance: None,
            surfaces: Vec::new(),
            background: None,
        });
    }

    /// The ray of that number is not followed.
    pub(super) fn ends(&mut self, number: u32, fate: RayFate) {
        self.rays[number as usize].fate = fate;
    }

    /// There are too many rays: those that have not been followed never will be.
    pub(super) fn gives_up_the_rest(&mut self) {
        let rest = self.rays.iter_mut().filter(|sent| sent.fate == RayFate::CutOff);
        rest.for_each(|sent| sent.fate = RayFate::GivenUp);
    }

    /// The ray of that number is followed now.
    pub(super) fn follows(&mut self, number: u32) {
        self.now = number as usize;
        self.rays[self.now].fate = RayFate::Followed;
    }

    /// It sees the background.
    pub(super) fn sees(&mut self, left: Rgb64, background: Rgb64) {
        let sent = &mut self.rays[self.now];
        (sent.left, sent.background) = (left, Some(added(left, background)));
    }

    /// It meets something.
    pub(super) fn meets(&mut self, left: Rgb64, distance: f64) {
        let sent = &mut self.rays[self.now];
        (sent.left, sent.distance) = (left, Some(distance));
    }

    /// A surface there, of which the pixel has one share, and another of its matte part.
    pub(super) fn surface(&mut self, seen: &Seen<'_>, share: Rgb64, matte: Rgb64) {
        let point = seen.point;
        self.matte = times(matte, point.albedo);
        self.rays[self.now].surfaces.push(Met {
            item: point.item,
            point: point.point.coords.into(),
            normal: seen.shading.into(),
            from_behind: seen.from_behind,
            albedo: point.albedo,
            cell: match point.surface.pattern {
                Pattern::Solid => None,
                Pattern::Checker(_) => Some(point.cell),
            },
            glow: added(share, point.surface.emission.get()),
            lights: Vec::new(),
        });
    }

    fn lit(&mut self, light: usize, answer: Answer, radiance: Rgb64, shadow: Option<ShadowRay>) {
        let contribution = added(self.matte, radiance);
        if let Some(met) = self.rays[self.now].surfaces.last_mut() {
            met.lights.push(Lit { light: light + 1, answer, contribution, shadow });
        }
    }

    /// A light, counted from 0, gives nothing to that surface: it is behind it, or shines elsewhere.
    pub(super) fn no_light(&mut self, light: usize, shines_elsewhere: bool) {
        let answer = if shines_elsewhere { Answer::Elsewhere } else { Answer::Behind };
        self.lit(light, answer, [0.0; 3], None);
    }

    /// Something opaque hides it.
    pub(super) fn hidden(&mut self, light: usize, prepared: &Prepared, ray: &Ray, t_max: f64) {
        self.in_the_way(light, prepared, (ray, t_max), Which::Opaque);
    }

    fn in_the_way(
        &mut self,
        light: usize,
        prepared: &Prepared,
        (ray, t_max): (&Ray, f64),
        which: Which,
    ) {
        let first = prepared.all(ray, (0.0, t_max), which).first().copied();
        let end = first.map_or(t_max, |hit| hit.t);
        // What is only found by those who look for any is there all the same.
        let answer = first.map_or(Answer::Absorbed, |hit| Answer::Hidden(hit.item));
        self.lit(light, answer, [0.0; 3], shadow(ray, end));
    }

    /// Of its light that much arrives, from `t_max`, which would have been so strong.
    pub(super) fn light(
        &mut self,
        light: usize,
        (prepared, shadows): (&Prepared, Shadows),
        (ray, t_max): (&Ray, f64),
        (strength, arrives): (f64, Rgb64),
    ) {
        if arrives != [0.0; 3] {
            let radiance = added(arrives, [strength; 3]);
            self.lit(light, Answer::Arrives(arrives), radiance, shadow(ray, t_max));
        } else if shadows == Shadows::Opaque {
            self.in_the_way(light, prepared, (ray, t_max), Which::Transparent);
        } else {
            self.lit(light, Answer::Absorbed, [0.0; 3], shadow(ray, t_max));
        }
    }

    /// The rays that matter, with the names of shapes.
    pub(super) fn finish(self, scene: &Scene, prepared: &Prepared) -> Vec<TracedRay> {
        let names = Names { prepared, kinds: kinds(scene) };
        let mut places = vec![0; self.rays.len()];
        let mut rays: Vec<TracedRay> = Vec::new();
        for (number, sent) in self.rays.into_iter().enumerate() {
            if sent.share == [0.0; 3] {
                continue;
            }
            let place = rays.len();
            places[number] = place;
            let parent = (number > 0).then(|| places[sent.parent]);
            if let Some(parent) = parent {
                rays[parent].children.push(place);
            }
            rays.push(names.ray(sent, parent));
        }
        rays
    }
}

/// A ray to where a light, or what hides it, is.
fn shadow(ray: &Ray, t: f64) -> Option<ShadowRay> {
    let length = t * ray.direction.norm();
    Some(ShadowRay {
        origin: ray.origin.coords.into(),
        direction: unit(ray.direction)?.into(),
        length: length.is_finite().then_some(length),
    })
}

/// What shapes are called.
struct Names<'a> {
    prepared: &'a Prepared,
    /// The kind of each shape of the description.
    kinds: Vec<&'a str>,
}

impl Names<'_> {
    fn shape(&self, item: u32) -> NamedShape {
        let shape = self.prepared.shape(item);
        let kind = self.kinds.get(shape as usize).copied().unwrap_or("shape").to_owned();
        NamedShape { number: shape + 1, item: item + 1, kind }
    }

    fn ray(&self, sent: Sent, parent: Option<usize>) -> TracedRay {
        let solid = sent.media.top(self.prepared);
        let ior = medium(solid, self.prepared).ior.get();
        TracedRay {
            parent,
            children: Vec::new(),
            kind: sent.kind,
            fate: sent.fate,
            depth: sent.depth,
            origin: sent.ray.origin.coords.into(),
            direction: sent.ray.direction.into(),
            share: sent.share,
            left: sent.left,
            medium: InMedium { shape: solid.map(|item| self.shape(item)), ior },
            distance: sent.distance,
            surfaces: sent.surfaces.into_iter().map(|met| self.surface(met)).collect(),
            background: sent.background,
        }
    }

    fn surface(&self, met: Met) -> MetSurface {
        MetSurface {
            shape: self.shape(met.item),
            point: met.point,
            normal: met.normal,
            from_behind: met.from_behind,
            albedo: met.albedo,
            cell: met.cell,
            glow: met.glow,
            lights: met.lights.into_iter().map(|lit| self.light(lit)).collect(),
        }
    }

    fn light(&self, lit: Lit) -> LightAnswer {
        let fate = match lit.answer {
            Answer::Arrives(shares) => LightFate::Arrives(shares),
            Answer::Hidden(item) => LightFate::Hidden(self.shape(item)),
            Answer::Absorbed => LightFate::Absorbed,
            Answer::Behind => LightFate::Behind,
            Answer::Elsewhere => LightFate::Elsewhere,
        };
        let Lit { light, contribution, shadow, .. } = lit;
        LightAnswer { light, fate, contribution, shadow }
    }
}

/// The kinds of all shapes in the order in which the kernel numbers them: those of a group before
/// those of groups in it, and each group where it stands first.
fn kinds(scene: &Scene) -> Vec<&str> {
    fn walk<'a>(
        shapes: &'a [Shape],
        groups: &'a [Placed],
        seen: &mut BTreeSet<*const Group>,
        kinds: &mut Vec<&'a str>,
    ) {
        kinds.extend(shapes.iter().map(|shape| shape.geometry.kind()));
        for Placed { group, .. } in groups {
            if group.shape_count() > 0 && seen.insert(Arc::as_ptr(group)) {
                walk(group.shapes(), group.groups(), seen, kinds);
            }
        }
    }
    let mut kinds = Vec::new();
    walk(&scene.shapes, &scene.groups, &mut BTreeSet::new(), &mut kinds);
    kinds
}
