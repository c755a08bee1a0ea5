use super::{matrix, rgb};
use crate::frame::{Frame, View};
use crate::omission::Omissions;
use crate::text::{Number, joined};
use lancer_math::{Point, unit};
use lancer_scene::{Beam, Falloff, Light, Scene};
use std::f64::consts::PI;
use std::fmt::Write;

pub(super) fn lights(
    scene: &Scene,
    view: &View,
    exposure: f64,
    omissions: &mut Omissions,
) -> String {
    let mut text = String::new();
    if !scene.background.is_none() {
        omissions.add(
            "background",
            "it lights surfaces too, where it is seen from them",
            "leave it out, or enclose the scene",
        );
        let radiance = rgb("radiance", scene.background.get(), exposure);
        let _ = writeln!(text, "<emitter type=\"constant\">{radiance}</emitter>");
    }
    let target = view.origin + view.axis * view.distance;
    for (i, light) in scene.lights.iter().enumerate() {
        let place = format!("light {}", i + 1);
        let falls_off = match light {
            Light::Lamp { falloff, .. } | Light::Spot { falloff, .. } => {
                *falloff == Falloff::Square
            }
            Light::Sun { .. } => true,
        };
        if !falls_off {
            omissions.add(
                &place,
                "all light falls off with the square of the distance; it is as strong as it should \
                 be at the distance of the camera's target",
                "let it fall off",
            );
        }
        let whole = light.brightness().get() * exposure * PI;
        let strength = |point: &Point, falloff: Falloff| match falloff {
            Falloff::Square => whole,
            Falloff::None => whole * (target - point).norm_squared(),
        };
        text += &match light {
            Light::Lamp { point, radius: Some(radius), falloff, .. } => {
                let (point, radius) = (point.get(), radius.get());
                let at = joined(&[point.x, point.y, point.z], ", ");
                // As bright from afar as the point.
                let strength = strength(&point, *falloff) / (PI * radius * radius);
                omissions.add(&place, "a ball of light is seen itself", "");
                format!(
                    "<shape type=\"sphere\"><point name=\"center\" value=\"{at}\"/>\
                     <float name=\"radius\" value=\"{}\"/><emitter type=\"area\">{}</emitter>\
                     <bsdf type=\"diffuse\">{}</bsdf></shape>\n",
                    Number(radius),
                    rgb("radiance", [strength; 3], 1.0),
                    rgb("reflectance", [0.0; 3], 1.0)
                )
            }
            Light::Lamp { point, radius: None, falloff, .. } => {
                let point = point.get();
                let at = joined(&[point.x, point.y, point.z], ", ");
                let intensity = rgb("intensity", [strength(&point, *falloff); 3], 1.0);
                format!(
                    "<emitter type=\"point\"><point name=\"position\" value=\"{at}\"/>{intensity}</emitter>\n"
                )
            }
            Light::Spot { point, axis, beam, falloff, radius, .. } => {
                let intensity = rgb("intensity", [strength(&point.get(), *falloff); 3], 1.0);
                if radius.is_some() {
                    omissions.add(
                        &place,
                        "a spot shines from a point, and its shadows are hard",
                        "",
                    );
                }
                let Frame { axes, origin } = Frame::around(axis.get(), point.get());
                let cone = cone(beam, &place, omissions);
                format!(
                    "<emitter type=\"spot\">{}{intensity}{cone}</emitter>\n",
                    matrix(&axes, &origin)
                )
            }
            Light::Sun { direction, .. } => {
                let travels = unit(direction.get()).unwrap_or_else(lancer_math::Vector::z);
                let way = joined(&[travels.x, travels.y, travels.z], ", ");
                let irradiance = rgb("irradiance", [whole; 3], 1.0);
                format!(
                    "<emitter type=\"directional\"><vector name=\"direction\" value=\"{way}\"/>{irradiance}</emitter>\n"
                )
            }
        };
    }
    text
}

fn cone(beam: &Beam, place: &str, omissions: &mut Omissions) -> String {
    let (inner, outer) = (beam.inner().get(), beam.outer().get());
    if inner < outer {
        omissions.add(
            place,
            "between its angles a spot fades evenly with the angle, and not by a smooth step of its \
             cosine",
            "give both angles the same value",
        );
    }
    format!(
        "<float name=\"cutoff_angle\" value=\"{}\"/><float name=\"beam_width\" value=\"{}\"/>",
        Number(outer),
        Number(inner)
    )
}
