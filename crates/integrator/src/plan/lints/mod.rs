//! What is probably not meant: the usual reasons for pictures that are black, white or empty.

mod together;

pub(crate) use together::TOGETHER;

use super::{Facts, Plan, Reason};
use crate::Tracer;
use lancer_kernel::figure;
use lancer_math::{Point, Vector};
use lancer_scene::{Geometry, Light, Scene, Shape};

/// What a lint is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum About {
    /// All of it.
    Scene,
    /// The camera.
    Camera,
    /// The light of that number, from 0.
    Light(usize),
    /// The scene's own shape of that number, from 0.
    Shape(usize),
}

/// Something that is probably not meant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lint {
    /// Where.
    pub about: About,
    /// What, without a full stop.
    pub message: String,
    /// What to say at the place.
    pub label: String,
    /// What to do about it.
    pub remedy: String,
}

impl Lint {
    /// With all that it says.
    pub fn new(
        about: About,
        message: impl Into<String>,
        label: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self { about, message: message.into(), label: label.into(), remedy: remedy.into() }
    }
}

/// What is found without rendering, in the order of the description. `tracer` looks at a
/// grid of pixels.
#[must_use]
pub fn lints(scene: &Scene, facts: &Facts, plan: &Plan, tracer: &dyn Tracer) -> Vec<Lint> {
    let mut lints = Vec::new();
    dark(scene, facts, plan, &mut lints);
    let around_eye = around(scene, &scene.camera.origin().get());
    inside(scene, around_eye, &mut lints);
    unseen(scene, facts, tracer, &mut lints);
    enclosed(scene, around_eye, &mut lints);
    let near = TOGETHER * facts.reach.max(f64::MIN_POSITIVE);
    together::faces(scene, near, &mut lints);
    together::shapes(scene, near, &mut lints);
    lints.sort_by_key(|lint| lint.about);
    lints
}

fn dark(scene: &Scene, facts: &Facts, plan: &Plan, lints: &mut Vec<Lint>) {
    if facts.all_lights() == 0 && facts.glowing == 0 {
        let background = scene.background.get() != [0.0; 3];
        let what = if background { "all shapes are black" } else { "the picture is black" };
        lints.push(Lint::new(
            About::Scene,
            format!("there is no light, and nothing glows: {what}"),
            "no light",
            "add a <lamp>, a <sun> or a <spot> to <lights>, or an emission to a shape",
        ));
    }
    for dropped in &plan.dropped {
        let number = dropped.light + 1;
        let (message, remedy) = match dropped.why {
            Reason::Behind(plane) => (
                format!("light {number} lights nothing that is seen"),
                format!(
                    "shape {}, a plane, is between it and the camera: move the light to the \
                     camera's side, or let a rectangle stand for the plane",
                    plane + 1
                ),
            ),
            Reason::NoLight => (
                format!("light {number} gives no light"),
                "make its brightness more than 0, or take it away".to_owned(),
            ),
            Reason::Aside => (
                format!("light {number}, a spot, lights nothing that is seen"),
                "its beam meets no shape in view: turn its axis to one, or widen its angle"
                    .to_owned(),
            ),
            // That is as it should be.
            Reason::Dim => continue,
        };
        lints.push(Lint::new(About::Light(dropped.light), message, "this one", remedy));
    }
}

/// The first opaque shape that a point is inside of. Planes are none: they are seen from both sides.
fn around(scene: &Scene, point: &Point) -> Option<usize> {
    let is_around = |shape: &Shape| {
        !matches!(shape.geometry, Geometry::Plane(_))
            && !shape.surface.is_transparent()
            && figure::encloses(shape, point)
    };
    scene.shapes.iter().position(is_around)
}

/// Camera and lamps within opaque shapes.
fn inside(scene: &Scene, around_eye: Option<usize>, lints: &mut Vec<Lint>) {
    if let Some(shape) = around_eye {
        let kind = scene.shapes[shape].geometry.kind();
        lints.push(Lint::new(
            About::Camera,
            format!("the camera is inside of shape {}, a {kind}, which is opaque", shape + 1),
            "it sees the inside alone",
            "move the camera's origin out of it, or for a room let rectangles stand for its walls",
        ));
    }
    for (number, light) in scene.lights.iter().enumerate() {
        let (Light::Lamp { point, radius, .. } | Light::Spot { point, radius, .. }) = light else {
            continue;
        };
        let Some(shape) = around(scene, &point.get()) else { continue };
        let solid = &scene.shapes[shape];
        // In one room.
        if around_eye == Some(shape) {
            continue;
        }
        // A larger ball shines out of it.
        let is_within = radius.is_none_or(|radius| {
            let reach = Vector::repeat(radius.get());
            figure::bounds(solid).is_some_and(|bounds| {
                bounds.contains(&(point.get() - reach)) && bounds.contains(&(point.get() + reach))
            })
        });
        if is_within {
            lints.push(Lint::new(
                About::Light(number),
                format!(
                    "light {} is inside of shape {}, a {}, which is opaque: it lights nothing outside",
                    number + 1,
                    shape + 1,
                    solid.geometry.kind()
                ),
                "this one",
                "move the lamp out of it; if the shape is to look like a lamp, give it an emission \
                 and the lamp a place beside it",
            ));
        }
    }
}

/// Along a side of the picture so many pixels are looked at.
const LOOKS: u32 = 48;

/// Nothing in view, by rays through a grid of pixels.
fn unseen(scene: &Scene, facts: &Facts, tracer: &dyn Tracer, lints: &mut Vec<Lint>) {
    if facts.shapes == 0 {
        lints.push(Lint::new(
            About::Scene,
            "there is no shape: the picture is the background alone",
            "no shapes",
            "add shapes to <shapes>",
        ));
        return;
    }
    let [width, height] = [scene.camera.px_width.get(), scene.camera.px_height.get()];
    let steps = |side: u32| {
        let count = side.min(LOOKS);
        (0..count).map(move |k| {
            ((2 * u64::from(k) + 1) * u64::from(side) / (2 * u64::from(count))) as u32
        })
    };
    let places = || steps(height).flat_map(|y| steps(width).map(move |x| (x, y)));
    // Engines that do not say what is met first are not asked.
    let is_met = |(x, y)| tracer.first_hit(x, y).is_none_or(|hit| hit.shape != 0);
    if places().any(is_met) {
        return;
    }
    let rays = places().count();
    let remedy = match &facts.around {
        Some(around) => {
            let [x, y, z] = <[f64; 3]>::from(around.centre().coords);
            format!(
                "the shapes' middle is at {x:.4} {y:.4} {z:.4}: let the camera's target be there, \
                 or widen its view"
            )
        }
        None => "turn the camera to the shapes, or widen its view".to_owned(),
    };
    lints.push(Lint::new(
        About::Camera,
        format!("nothing is in view: none of {rays} rays spread over the picture meets a shape"),
        "looks past all shapes",
        remedy,
    ));
}

/// Shapes are compared with one another up to so many.
const MOST_COMPARED: usize = 1000;

/// Shapes wholly within opaque spheres and boxes, but for those around the eye.
fn enclosed(scene: &Scene, around_eye: Option<usize>, lints: &mut Vec<Lint>) {
    let shapes = &scene.shapes;
    if shapes.len() > MOST_COMPARED {
        return;
    }
    // Convex, so that what has its corners inside is inside.
    let convex = |shape: &Shape| {
        matches!(shape.geometry, Geometry::Sphere(_) | Geometry::Cuboid(_))
            && !shape.surface.is_transparent()
    };
    let bounds: Vec<_> = shapes.iter().map(figure::bounds).collect();
    for (number, own) in bounds.iter().enumerate() {
        let Some(own) = own else { continue };
        let around = shapes.iter().enumerate().position(|(other, shape)| {
            other != number
                && around_eye != Some(other)
                && convex(shape)
                && own.corners().iter().all(|corner| figure::encloses(shape, corner))
        });
        if let Some(around) = around {
            lints.push(Lint::new(
                About::Shape(number),
                format!(
                    "shape {}, a {}, is hidden: it is wholly inside of shape {}, a {}, which is opaque",
                    number + 1,
                    shapes[number].geometry.kind(),
                    around + 1,
                    shapes[around].geometry.kind()
                ),
                "nobody sees it",
                "move it, make the other one transparent, or take it away",
            ));
        }
    }
}
