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
        let strength = light.brightness().get() * exposure * PI;
        let mut intensity = |point: &Point, falloff: Falloff| {
            let factor = match falloff {
                Falloff::Square => 1.0,
                Falloff::None => {
                    omissions.add(
                        &place,
                        "all light falls off with the square of the distance; it is as strong as \
                         it should be at the distance of the camera's target",
                        "let it fall off",
                    );
                    (target - point).norm_squared()
                }
            };
            rgb("intensity", [strength; 3], factor)
        };
        text += &match light {
            Light::Lamp { point, falloff, .. } => {
                let point = point.get();
                let at = joined(&[point.x, point.y, point.z], ", ");
                let intensity = intensity(&point, *falloff);
                format!(
                    "<emitter type=\"point\"><point name=\"position\" value=\"{at}\"/>{intensity}</emitter>\n"
                )
            }
            Light::Spot { point, axis, beam, falloff, .. } => {
                let intensity = intensity(&point.get(), *falloff);
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
                let irradiance = rgb("irradiance", [strength; 3], 1.0);
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
