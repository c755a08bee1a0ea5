use super::rgb;
use crate::omission::Omissions;
use crate::text::{Number, angled_point};
use lancer_math::unit;
use lancer_scene::{Beam, Falloff, Light};

/// Light falls off as 2 / (1 + (d / NEAR)^2), which is 2 NEAR^2 / d^2 but for a fraction of
/// (NEAR / d)^2.
const NEAR: f64 = 1e-5;

/// A ball is a disc of so many points a side.
const POINTS: u32 = 17;

/// How far away a sun's plane is.
const FAR: f64 = 1e6;

pub(super) fn light(
    light: &Light,
    exposure: f64,
    place: &str,
    omissions: &mut Omissions,
) -> String {
    let brightness = light.brightness().get() * exposure;
    let ball = light.radius().map_or_else(String::new, |radius| {
        omissions.add(
            place,
            &format!(
                "shadows of a ball of light are those of {POINTS} x {POINTS} points of a disc that \
                 faces what is lit"
            ),
            "",
        );
        let wide = Number(2.0 * radius.get());
        format!(
            " area_light <{wide}, 0, 0>, <0, {wide}, 0>, {POINTS}, {POINTS} adaptive 1 circular orient"
        )
    });
    match light {
        Light::Lamp { point, falloff, .. } => {
            let (colour, fade) = faded(brightness, *falloff);
            format!("light_source {{ {}, {colour}{fade}{ball} }}\n", angled_point(&point.get()))
        }
        Light::Spot { point, axis, beam, falloff, .. } => {
            let (colour, fade) = faded(brightness, *falloff);
            let point = point.get();
            let ahead = unit(axis.get()).unwrap_or_else(lancer_math::Vector::z);
            let cone = cone(beam, place, omissions);
            let aim = if cone.is_empty() {
                String::new()
            } else {
                format!("{cone} point_at {}", angled_point(&(point + ahead)))
            };
            format!("light_source {{ {}, {colour}{aim}{fade}{ball} }}\n", angled_point(&point))
        }
        Light::Sun { direction, .. } => {
            let travels = unit(direction.get()).unwrap_or_else(lancer_math::Vector::z);
            let from = (travels * -FAR).into();
            let colour = rgb([brightness; 3], 1.0);
            format!("light_source {{ {}, {colour} parallel point_at 0 }}\n", angled_point(&from))
        }
    }
}

/// The colour and how it fades.
fn faded(brightness: f64, falloff: Falloff) -> (String, String) {
    match falloff {
        Falloff::None => (rgb([brightness; 3], 1.0), String::new()),
        Falloff::Square => (
            rgb([brightness / (2.0 * NEAR * NEAR); 3], 1.0),
            format!(" fade_distance {} fade_power 2", Number(NEAR)),
        ),
    }
}

/// Between the angles it fades as it should, a smooth step of the cosine. Nothing where it
/// shines all around.
fn cone(beam: &Beam, place: &str, omissions: &mut Omissions) -> String {
    let (inner, outer) = (beam.inner().get(), beam.outer().get());
    if inner == 180.0 {
        return String::new();
    }
    if outer > 90.0 {
        omissions.add(
            place,
            "a spot shines at most 90 degrees from its axis, and not beyond",
            "give it an outer angle of at most 90",
        );
    }
    format!(" spotlight radius {} falloff {} tightness 0", Number(inner), Number(outer))
}
