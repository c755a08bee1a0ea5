//! The geometry, lighting and engine of the original program, kept exactly:
//! its answers are the fixed point that every correction and speed-up is
//! measured from, and that includes the answers that are wrong.

mod buffers;
mod bundle;
pub(crate) mod camera;
mod checker;
pub(crate) mod engine;
mod lights;
mod plane;
mod refusals;
mod sphere;
mod surfaces;
mod tile;
mod vectors;
pub(crate) mod world;

pub(crate) use refusals::refusals;

use crate::{About, Lint};
use lancer_math::Vector;
use lancer_scene::{Geometry, Light, Scene};

/// The original's normalisation: components divided by the root of the sum of
/// their squares. Not a unit vector for zero and for what is too small or too
/// large to be squared, unlike [`lancer_math::unit`].
#[inline]
fn naive_unit(v: Vector) -> Vector {
    v / v.norm()
}

/// Whether [`naive_unit`] gives a unit vector.
fn can_be_squared(v: Vector) -> bool {
    v.norm_squared().is_normal()
}

/// Coordinates and radii up to this, and down to its inverse, are far enough
/// from the ends of double precision for fourth powers, which shadows take.
const LARGEST: f64 = 1e70;

/// Sums of light up to this, times 255 and with as much glow on top, are finite
/// in single precision.
const LARGEST_SUM: f64 = 1e35;

/// What looks wrong in this scene because the original computes it so.
pub(crate) fn warnings(scene: &Scene) -> Vec<Lint> {
    let mut warnings = Vec::new();
    let mut warn = |about, message: String, label: &str, remedy: String| {
        warnings.push(Lint::new(about, message, label, remedy));
    };
    let to_about_1 = || "scale it to about 1".to_owned();
    let camera = &scene.camera;
    let axis = camera.target().get() - camera.origin().get();
    let can_look = can_be_squared(axis) && camera::horizontal(naive_unit(axis)).x.is_finite();
    if !can_look {
        warn(
            About::Camera,
            "the camera looks straight up or down, or its target is too near or too far to be \
             squared; for that this engine has no horizontal direction, and the picture will be black"
                .to_owned(),
            "without a horizontal direction",
            "move the target sideways a little".to_owned(),
        );
    }
    let total: f64 = scene.lights.iter().map(|light| light.brightness().get()).sum();
    if total > LARGEST_SUM {
        warn(
            About::Scene,
            format!(
                "the brightnesses add up to {total:e}, and colours times that are infinite, which \
                 makes the picture black"
            ),
            "too bright",
            format!("keep them below {LARGEST_SUM:e}"),
        );
    }
    let eye = camera.origin().get().coords.amax().max(camera.target().get().coords.amax());
    let mut sizes = vec![(About::Camera, eye)];
    for (i, light) in scene.lights.iter().enumerate() {
        match light {
            Light::Lamp { point, .. } | Light::Spot { point, .. } => {
                sizes.push((About::Light(i), point.get().coords.amax()));
            }
            Light::Sun { direction, .. } if !can_be_squared(direction.get()) => warn(
                About::Light(i),
                format!(
                    "the direction of light {} is too long or too short for this engine to square, and \
                     it will not shine",
                    i + 1
                ),
                "does not shine",
                to_about_1(),
            ),
            Light::Sun { .. } => {}
        }
    }
    for (i, shape) in scene.shapes.iter().enumerate() {
        match &shape.geometry {
            Geometry::Plane(plane) => {
                sizes.push((About::Shape(i), plane.origin.get().coords.amax()));
                if !can_be_squared(plane.normal.get()) {
                    warn(
                        About::Shape(i),
                        format!(
                            "the normal of shape {} is too long or too short for this engine to \
                             square, and the plane will not be seen",
                            i + 1
                        ),
                        "not seen",
                        to_about_1(),
                    );
                }
            }
            Geometry::Sphere(sphere) => {
                let radius = sphere.radius.get();
                let size = sphere.centre.get().coords.amax().max(radius).max(1.0 / radius);
                sizes.push((About::Shape(i), size));
            }
            // Custom shapes know their own sizes; others are refused.
            _ => {}
        }
    }
    if let Some((about, _)) = sizes.iter().find(|(_, size)| *size > LARGEST) {
        warn(
            *about,
            format!(
                "there are coordinates above {LARGEST:e} or radii outside of {:e} to {LARGEST:e}, for \
                 which this engine's squares leave the range of numbers",
                1.0 / LARGEST
            ),
            "out of range",
            "scale the scene".to_owned(),
        );
    }
    warnings
}
