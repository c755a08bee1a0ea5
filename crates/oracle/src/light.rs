//! The light that falls on a matte surface.

use crate::crossing::ratio;
use crate::optics::{fresnel, sheet};
use crate::stops::{medium, top, way};
use crate::tracer::Rgb;
use crate::{Line, Number, Triple, World};
use lancer_scene::{Beam, Falloff, Light, Medium, Scene, Shadows};

/// A point that is lit, with the unit normals of the surface there on the side that
/// is seen.
pub(crate) struct Lit<'a> {
    pub(crate) point: &'a Triple,
    pub(crate) facet: &'a Triple,
    pub(crate) shading: &'a Triple,
}

/// The radiance that a white matte surface shows there, and how sure that is.
pub(crate) fn light(scene: &Scene, world: &World<'_>, lit: &Lit<'_>) -> (Rgb, f64) {
    let (mut sum, mut margin) = (Rgb::black(), f64::INFINITY);
    for light in &scene.lights {
        let (from_one, sure) = from(light, scene.shadows, world, lit);
        sum = sum.plus(&from_one);
        margin = margin.min(sure);
    }
    (sum, margin)
}

fn from(light: &Light, shadows: Shadows, world: &World<'_>, lit: &Lit<'_>) -> (Rgb, f64) {
    let bits = world.bits();
    if light.radius().is_some() {
        // What comes from a ball is not known here.
        return (Rgb::black(), 0.0);
    }
    let (way_there, is_sun) = match light {
        Light::Lamp { point, .. } | Light::Spot { point, .. } => {
            (&Triple::from(point.get()) - lit.point, false)
        }
        Light::Sun { direction, .. } => (-&Triple::from(direction.get()), true),
    };
    if way_there.is_zero() {
        return (Rgb::black(), 0.0);
    }
    let distance = way_there.norm(bits);
    let direction = way_there.over(&distance, bits);
    let (above, along) = (direction.dot(lit.facet), direction.dot(lit.shading));
    // Where the light grazes, rounding decides about the shadow.
    let mut margin = above.to_f64().abs().min(along.to_f64().abs());
    if above.signum() <= 0 || along.signum() <= 0 {
        return (Rgb::black(), margin);
    }
    let mut strength = Number::from(light.brightness().get()) * &along;
    match light {
        Light::Lamp { falloff, .. } | Light::Spot { falloff, .. }
            if *falloff == Falloff::Square =>
        {
            strength = strength.over(&distance.squared(), bits);
        }
        _ => {}
    }
    if let Light::Spot { axis, beam, .. } = light {
        let cosine = -Triple::from(axis.get()).unit(bits).dot(&direction);
        strength = strength * share_of_beam(beam, &cosine, &mut margin, bits);
    }
    if strength.is_zero() {
        return (Rgb::black(), margin);
    }
    let line = Line { origin: lit.point.clone(), direction };
    let end = (!is_sun).then_some(&distance);
    let (left, sure) = passes(world, &line, end, shadows);
    (left.times(&strength).rounded(bits), margin.min(sure))
}

/// What of the light goes along a line up to `end`.
fn passes(world: &World<'_>, line: &Line, end: Option<&Number>, shadows: Shadows) -> (Rgb, f64) {
    let bits = world.bits();
    let way = way(world, line, end, false);
    let mut left = Rgb::white();
    let mut from = Number::zero();
    for stop in &way.stops {
        if stop.opaque(world).is_some() || shadows == Shadows::Opaque {
            return (Rgb::black(), way.margin);
        }
        let here = medium(world, top(world, &stop.before));
        left = left.filtered(&transmittance(&here, Some(&(&stop.t - &from)), bits));
        from = stop.t.clone();
        for hit in stop.sheets(world) {
            let surface = world.items()[hit.item].surface();
            let cosine = hit.crossing.normal.dot(&line.direction).abs();
            let mirrored = sheet(&cosine, here.ior.get(), surface.medium.ior.get(), bits);
            let clear = passing(surface.gloss.get(), surface.transparency.get());
            left = left.times(&(clear * (Number::one() - mirrored))).rounded(bits);
        }
        if let Some((item, crossing)) = stop.border(world) {
            let surface = world.items()[item].surface();
            let behind = medium(world, top(world, &stop.after));
            let (a, b) = (here.ior.get(), behind.ior.get());
            let cosine = crossing.normal.dot(&line.direction).abs();
            // The angle counts as that in the thinner medium.
            let mirrored = fresnel(&cosine, a.min(b), a.max(b), bits);
            let clear = passing(surface.gloss.get(), surface.transparency.get());
            left = left.times(&(clear * (Number::one() - mirrored))).rounded(bits);
        }
    }
    let here = medium(world, top(world, &way.last));
    let length = end.map(|end| end - &from);
    (left.filtered(&transmittance(&here, length.as_ref(), bits)), way.margin)
}

/// The fraction of light that is neither mirrored by gloss nor matte.
fn passing(gloss: f64, transparency: f64) -> Number {
    (Number::one() - Number::from(gloss)) * Number::from(transparency)
}

/// What a medium leaves of light after a length (Beer and Lambert); `None` for an
/// infinite one.
pub(crate) fn transmittance(medium: &Medium, length: Option<&Number>, bits: usize) -> Rgb {
    Rgb(medium.absorption.get().map(|absorption| match length {
        _ if absorption == 0.0 => Number::one(),
        None => Number::zero(),
        Some(length) => (-&(Number::from(absorption) * length)).rounded(bits).exp(bits),
    }))
}

/// Full light up to the inner angle, none from the outer one on, a smooth step of
/// the cosine between.
fn share_of_beam(beam: &Beam, cosine: &Number, margin: &mut f64, bits: usize) -> Number {
    let cosine_of = |degrees: f64| Number::from(degrees).sin_cos_degrees(bits).1;
    let (inner, outer) = (cosine_of(beam.inner().get()), cosine_of(beam.outer().get()));
    if inner == outer {
        // The light ends at once.
        *margin = margin.min(ratio(&(cosine - &inner), &Number::one()));
    }
    if *cosine >= inner {
        return Number::one();
    }
    if *cosine <= outer {
        return Number::zero();
    }
    let s = (cosine - &outer).over(&(inner - outer), bits);
    s.squared() * (Number::from(3) - &s - &s)
}
