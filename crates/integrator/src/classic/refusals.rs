//! What the original's engines have no notion of.

use lancer_scene::{Checker, Colour, Geometry, Light, Pattern, Projection, Scene, Surface};

/// What is in this scene that the original's engines cannot show: rather no
/// picture than one with things left out.
pub(crate) fn refusals(scene: &Scene) -> Vec<String> {
    let mut refusals = Vec::new();
    let camera = &scene.camera;
    if matches!(camera.projection, Projection::Orthographic(_)) {
        refusals.push("the camera is orthographic".to_owned());
    }
    let up = camera.up.get();
    if !(up.x == 0.0 && up.y == 0.0 && up.z > 0.0) || camera.roll.get() != 0.0 {
        refusals.push("the camera is turned about its axis".to_owned());
    }
    if camera.aperture.is_some() {
        refusals.push("the camera has a lens".to_owned());
    }
    if !scene.background.is_none() {
        refusals.push("there is a background".to_owned());
    }
    let spots = scene.lights.iter().filter(|light| matches!(light, Light::Spot { .. })).count();
    if spots > 0 {
        refusals.push(format!("there are spots among the lights ({spots})"));
    }
    let balls = scene.lights.iter().filter(|light| light.radius().is_some()).count();
    if balls > 0 {
        refusals.push(format!("there are lamps with a radius ({balls})"));
    }
    if !scene.groups.is_empty() {
        refusals.push(format!("there are groups ({})", scene.groups.len()));
    }
    for (i, shape) in scene.shapes.iter().enumerate() {
        match &shape.geometry {
            Geometry::Sphere(_) | Geometry::Plane(_) | Geometry::Custom(_) => {}
            other => refusals.push(format!("shape {} is a {}", i + 1, other.kind())),
        }
        if let Some(what) = unknown(&shape.surface) {
            refusals.push(format!("shape {} {what}", i + 1));
        }
    }
    // Nobody reads more.
    if refusals.len() > 10 {
        let more = refusals.len() - 9;
        refusals.truncate(9);
        refusals.push(format!("and {more} more"));
    }
    refusals
}

fn unknown(surface: &Surface) -> Option<&'static str> {
    let usual = Checker::new(Colour::WHITE);
    if surface.transparency.get() > 0.0 {
        Some("is transparent")
    } else if !surface.emission.is_none() {
        Some("emits light")
    } else if let Pattern::Checker(checker) = surface.pattern
        && (checker.length, checker.angle) != (usual.length, usual.angle)
    {
        Some("has a checker with cells of its own size")
    } else {
        None
    }
}
