//! The geometry, lighting and engine of the original program, kept exactly:
//! its answers are the fixed point that every correction and speed-up is
//! measured from, and that includes the answers that are wrong.

pub(crate) mod camera;
mod checker;
pub(crate) mod engine;
mod eye;
mod lanes;
pub(crate) mod lighting;
mod occluders;
mod plane;
mod sphere;
pub(crate) mod world;

use lancer_math::Vector;
use lancer_scene::{Geometry, Scene};

/// The original's normalisation: components divided by the root of the sum of
/// their squares. NaN for zero and for what is too small or too large to be
/// squared, unlike [`lancer_math::unit`].
#[inline]
fn naive_unit(v: Vector) -> Vector {
    v / v.norm()
}

/// What looks wrong in this scene because the original computes it so.
pub(crate) fn warnings(scene: &Scene) -> Vec<String> {
    let mut warnings = Vec::new();
    let camera = &scene.camera;
    let axis = camera.target().get() - camera.origin().get();
    if !camera::horizontal(naive_unit(axis)).iter().all(|c| c.is_finite()) {
        warnings.push(
            "the camera looks straight up or down, for which this engine has no horizontal \
             direction: the picture will be black; move the target sideways a little"
                .to_owned(),
        );
    }
    for (i, shape) in scene.shapes.iter().enumerate() {
        if let Geometry::Plane(plane) = &shape.geometry
            && !naive_unit(plane.normal.get()).iter().all(|c| c.is_finite())
        {
            warnings.push(format!(
                "the normal of shape {} is too long or too short for this engine to square: the \
                 plane will look black; scale the normal to about 1",
                i + 1
            ));
        }
    }
    warnings
}
