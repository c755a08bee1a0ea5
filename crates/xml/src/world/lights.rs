//! What shines.

use super::{Out, direction, position, warn_empty};
use crate::Diagnostic;
use crate::element::Reader;
use crate::schema::{self, Element};
use lancer_scene::{Beam, Brightness, Degrees, Falloff, Length, Light, Shadows};

pub(super) fn shadows(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Shadows> {
    let words = [("tinted", Shadows::Tinted), ("opaque", Shadows::Opaque)];
    reader.keyword("shadows", &words, out)
}

/// All lights; those with mistakes are left out.
pub(super) fn lights(parent: &Reader<'_, '_>, out: Out<'_>) -> Vec<Light> {
    let mut lights = Vec::new();
    let mut empty = true;
    for (node, element) in parent.children() {
        empty = false;
        let reader = Reader::new(node, element, out);
        lights.extend(light(&reader, element, out));
    }
    if empty {
        warn_empty(parent, "nothing shines: surfaces will be black unless they emit light", out);
    }
    lights
}

fn light(reader: &Reader<'_, '_>, element: &'static Element, out: Out<'_>) -> Option<Light> {
    let brightness = reader.number("brightness", Brightness::new, out);
    if std::ptr::eq(element, &schema::SUN) {
        let direction = direction(reader, &schema::POINT, out);
        return Some(Light::Sun { direction: direction?, brightness: brightness? });
    }
    let words = [("square", Falloff::Square), ("none", Falloff::None)];
    let falloff = reader.keyword("falloff", &words, out).unwrap_or_default();
    let radius = reader.number("radius", Length::or_none, out).flatten();
    let point = position(reader, &schema::POINT, out);
    if std::ptr::eq(element, &schema::SPOT) {
        let axis = direction(reader, &schema::AXIS, out);
        let beam = beam(reader, out);
        Some(Light::Spot {
            point: point?,
            radius,
            axis: axis?,
            beam: beam?,
            brightness: brightness?,
            falloff,
        })
    } else {
        Some(Light::Lamp { point: point?, radius, brightness: brightness?, falloff })
    }
}

fn beam(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Beam> {
    let inner = reader.number("inner", Degrees::from_axis, out);
    let outer = reader.number("outer", Degrees::from_axis, out);
    let (inner, outer) = (inner?.get(), outer?.get());
    let beam = Beam::new(inner, outer).ok();
    if beam.is_none() {
        out.push(
            Diagnostic::error(
                reader.span_of("inner"),
                format!("`inner` of <spot> is {inner}, and `outer` {outer}"),
                "expected an angle of at most the outer one",
            )
            .related(reader.span_of("outer"), "the outer angle")
            .help(
                "between the two angles the light fades: from full inside to none outside"
                    .to_owned(),
            ),
        );
    }
    beam
}
