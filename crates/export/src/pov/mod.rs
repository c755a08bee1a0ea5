//! The language of POV-Ray 3.7.
//!
//! What it computes was found in its own documentation (*POV-Ray 3.7 Reference*) and by rendering:
//! a white surface with `diffuse 1` and no `ambient` shows the light's colour times the cosine,
//! without a factor of pi; layers, transmitted and reflected light add up as the text of
//! [`surface`] says.

mod checker;
mod lights;
mod shape;
mod surface;

use crate::frame::{Frame, View};
use crate::omission::{Omission, Omissions};
use crate::text::{Number, angled, angled_point, for_comment};
use lancer_math::Placement;
use lancer_scene::{Camera, Group, Placed, Scene, Shadows, Shape};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Arc;
use surface::Look;

pub(crate) use checker::axis;
pub(crate) use shape::FACES;

/// Rays that count for less are not followed: the cutoff that engine `whitted` usually has.
const BAILOUT: f64 = 1e-4;

/// As deep as it goes.
const DEEPEST: u32 = 256;

/// Coordinates and sizes beyond which its own tolerances, which are absolute, show.
const SMALLEST: f64 = 0.1;
const LARGEST: f64 = 1e6;

/// How many rays there are for each pixel where the camera has a lens.
const THROUGH_LENS: u32 = 100;

/// More shapes than this in memory are worth a word.
const MANY: u64 = 1_000_000;

/// The lines at the top of the file.
pub(crate) fn head(scene: &Scene, omissions: &[Omission]) -> String {
    let (width, height) = (scene.camera.px_width.get(), scene.camera.px_height.get());
    let mut text = format!(
        "// A scene for POV-Ray 3.7, written by `lancer export`.\n\
         // povray +ISCENE.pov +OPICTURE.png +W{width} +H{height} -A\n"
    );
    if omissions.is_empty() {
        text += "// Nothing is left out.\n";
    } else {
        text += "// What this language cannot say as it was:\n";
    }
    for omission in omissions {
        let _ = writeln!(text, "// - {}", for_comment(&omission.to_string()));
    }
    text
}

pub(crate) fn write(scene: &Scene, exposure: f64, omissions: &mut Omissions) -> String {
    let mut text = format!(
        "#version 3.7;\n\
         global_settings {{ assumed_gamma 1.0 max_trace_level {DEEPEST} adc_bailout {} }}\n\
         #default {{ finish {{ ambient 0 diffuse 1 }} }}\n",
        Number(BAILOUT)
    );
    text += &camera(&scene.camera, omissions);
    if !scene.background.is_none() {
        let _ = writeln!(text, "background {{ {} }}", rgb(scene.background.get(), exposure));
    }
    for (i, light) in scene.lights.iter().enumerate() {
        let place = format!("light {}", i + 1);
        text += &lights::light(light, exposure, &place, omissions);
    }
    text += checker::FUNCTIONS;
    if scene.shape_count() > MANY {
        omissions.add(
            "groups",
            "POV-Ray keeps each shape in memory as often as it is shown",
            "show fewer",
        );
    }
    let mut writer = Writer {
        exposure,
        shadows: scene.shadows,
        omissions,
        groups: BTreeMap::new(),
        declared: String::new(),
    };
    let shapes = writer.body(&scene.shapes, &scene.groups, "");
    text + &writer.declared + &shapes
}

/// By vectors of its own, so that no rule about `sky` or `look_at` has a say.
fn camera(camera: &Camera, omissions: &mut Omissions) -> String {
    let view = View::new(camera);
    let size = view.distance.min(view.width);
    let reach = view.origin.coords.amax().max(view.distance);
    if size < SMALLEST || reach > LARGEST {
        omissions.add(
            "camera",
            "POV-Ray leaves out what is nearer than 0.001 or farther than 10000000, and this \
             scene is small or far away",
            "scale the scene, or move it",
        );
    }
    let kind = if view.is_parallel { "orthographic" } else { "perspective" };
    let ahead = if view.is_parallel { view.axis } else { view.axis * view.distance };
    let lens = if view.aperture == 0.0 {
        String::new()
    } else {
        omissions.add(
            "camera",
            &format!("a lens is {THROUGH_LENS} rays for each pixel, whatever is asked for"),
            "",
        );
        // Twice the diameter, as rendering shows.
        format!(
            " focal_point {} aperture {} blur_samples {THROUGH_LENS} variance 0",
            angled_point(&(view.origin + view.axis * view.focus)),
            Number(2.0 * view.aperture)
        )
    };
    format!(
        "camera {{ {kind} location {} direction {} right {} up {} * image_height / image_width{lens} }}\n",
        angled_point(&view.origin),
        angled(&ahead),
        angled(&(view.right * view.width)),
        angled(&(view.up * view.width)),
    )
}

/// `rgb <r, g, b>`, each times a factor.
fn rgb(colour: [f64; 3], factor: f64) -> String {
    format!("rgb {}", angled(&colour.map(|c| c * factor).into()))
}

/// `matrix <...>`: the images of the axes and of the origin.
fn matrix(frame: &Frame) -> String {
    let [x, y, z] = frame.axes;
    let numbers: Vec<f64> =
        [x, y, z, frame.origin.coords].iter().flat_map(|v| [v.x, v.y, v.z]).collect();
    format!("matrix <{}>", crate::text::joined(&numbers, ", "))
}

struct Writer<'a> {
    exposure: f64,
    shadows: Shadows,
    omissions: &'a mut Omissions,
    /// The numbers of groups that are declared already, by address; `None` where nothing of one
    /// can be shown. Only looked up, so that no address decides an order.
    groups: BTreeMap<*const Group, Option<usize>>,
    declared: String,
}

impl Writer<'_> {
    /// Shapes and groups, a line each.
    fn body(&mut self, shapes: &[Shape], groups: &[Placed], of: &str) -> String {
        let mut text = String::new();
        for (i, shape) in shapes.iter().enumerate() {
            let place = format!("shape {}{of}, a {}", i + 1, shape.geometry.kind());
            self.shape(shape, &place, &mut text);
        }
        for placed in groups {
            if let Some(number) = self.group(&placed.group) {
                let place = matrix(&Frame::of(&placed.placement));
                let moved =
                    if placed.placement == Placement::IDENTITY { "" } else { place.as_str() };
                let _ = writeln!(text, "object {{ Group{number} {moved} }}");
            }
        }
        text
    }

    /// Declares a group, unless it is declared already.
    fn group(&mut self, group: &Arc<Group>) -> Option<usize> {
        if let Some(number) = self.groups.get(&Arc::as_ptr(group)) {
            return *number;
        }
        let of = group.name().map_or_else(|| " of a group".to_owned(), |n| format!(" of `{n}`"));
        let body = self.body(group.shapes(), group.groups(), &of);
        let known = self.groups.values().flatten().count();
        let number = (!body.is_empty()).then_some(known + 1);
        if let Some(number) = number {
            // A line is an object, and one alone is no union.
            let is_one = body.lines().count() == 1;
            let body = if is_one { body } else { format!("union {{\n{body}}}\n") };
            let _ = write!(self.declared, "#declare Group{number} = {body}");
        }
        self.groups.insert(Arc::as_ptr(group), number);
        number
    }

    fn shape(&mut self, shape: &Shape, place: &str, text: &mut String) {
        let look = Look::new(&shape.surface, self.exposure);
        let Some(object) = shape::object(shape, &look) else {
            self.omissions.add(place, "a shape of your own, which is left out", "");
            return;
        };
        look.note(shape, self.shadows, place, self.omissions);
        // What is not hollow keeps absorption from what is in it, an eye in a room for one.
        let hollow = if shape.geometry.is_closed() { " hollow" } else { "" };
        if self.shadows == Shadows::Opaque && shape.surface.is_transparent() {
            // What is seen casts no shadow, and what casts one is not seen.
            let _ = writeln!(text, "{object}{}{hollow} no_shadow }}", look.interior);
            let dark = Look::dark();
            if let Some(object) = shape::object(shape, &dark) {
                let _ = writeln!(text, "{object}{hollow} no_image no_reflection }}");
            }
        } else {
            let _ = writeln!(text, "{object}{}{hollow} }}", look.interior);
        }
    }
}
