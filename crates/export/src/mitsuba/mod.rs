//! The XML of Mitsuba 3.
//!
//! A point of intensity I lights a white matte surface at distance d with I cos / (pi d^2), so a
//! lamp of brightness B has an intensity of pi B, and a sun an irradiance of pi B. Light from
//! lamps alone is integrator `direct`; where something mirrors or is clear it is `path`, which
//! also carries light from one matte surface to another.

mod lights;
mod ply;
mod round;
mod shape;
mod surface;

use crate::Attachment;
use crate::frame::View;
use crate::omission::{Omission, Omissions};
use crate::text::{Number, for_comment, joined};
use lancer_math::{Placement, Point, Vector};
use lancer_scene::{Placed, Scene, Shape};
use std::collections::BTreeMap;
use std::fmt::Write;

/// How many surfaces a path may have.
const DEEPEST: u32 = 16;

/// Groups of more shapes are left out: each is written as often as it is shown.
const MANY: u64 = 100_000;

pub(crate) fn head(omissions: &[Omission]) -> String {
    let mut text = "<!-- A scene for Mitsuba 3, written by `lancer export`.\n     \
         mitsuba -m llvm_ad_rgb -Dspp=64 SCENE.xml\n"
        .to_owned();
    if !omissions.is_empty() {
        text += "     What this language cannot say as it was:\n";
    }
    for omission in omissions {
        let _ = writeln!(text, "     * {}", for_comment(&omission.to_string()));
    }
    text + "-->\n"
}

pub(crate) fn write(
    scene: &Scene,
    exposure: f64,
    stem: &str,
    omissions: &mut Omissions,
) -> (String, Vec<Attachment>) {
    let camera = &scene.camera;
    let view = View::new(camera);
    let mut text = format!(
        "<scene version=\"3.0.0\">\n\
         <default name=\"width\" value=\"{}\"/>\n\
         <default name=\"height\" value=\"{}\"/>\n\
         <default name=\"spp\" value=\"16\"/>\n",
        camera.px_width.get(),
        camera.px_height.get()
    );
    let mut writer = Writer {
        exposure,
        scene,
        stem,
        reach: view.origin.coords.amax().max(view.distance),
        omissions,
        files: Vec::new(),
        known: BTreeMap::new(),
        is_matte: true,
        body: String::new(),
    };
    writer.shapes(&scene.shapes, &Placement::IDENTITY, "");
    let inside: u64 = scene.groups.iter().map(|placed| placed.group.shape_count()).sum();
    if inside > MANY {
        writer.omissions.add(
            "groups",
            "they show more than 100000 shapes, each of which would be written as often as it is \
             shown, and are left out",
            "show fewer",
        );
    } else {
        writer.groups(&scene.groups, &Placement::IDENTITY);
    }
    let Writer { files, body, is_matte, .. } = writer;
    if is_matte {
        text += "<integrator type=\"direct\"><integer name=\"emitter_samples\" value=\"1\"/>\
                 <integer name=\"bsdf_samples\" value=\"0\"/></integrator>\n";
    } else {
        omissions.add(
            "shapes",
            "since some mirror or are clear, light is also carried from one matte surface to \
             another, which is brighter",
            "",
        );
        let _ = writeln!(
            text,
            "<integrator type=\"path\"><integer name=\"max_depth\" value=\"{DEEPEST}\"/></integrator>"
        );
    }
    text += &sensor(&view, omissions);
    text += &lights::lights(scene, &view, exposure, omissions);
    (text + &body + "</scene>\n", files)
}

/// Its own axes: to the left, upward, ahead.
fn sensor(view: &View, omissions: &mut Omissions) -> String {
    let half = view.width / 2.0;
    let (kind, size, angle) = if view.is_parallel {
        ("orthographic", half, String::new())
    } else {
        let degrees = 2.0 * libm::atan2(half, view.distance).to_degrees();
        let fov = format!(
            "<float name=\"fov\" value=\"{}\"/><string name=\"fov_axis\" value=\"x\"/>",
            Number(degrees)
        );
        if view.aperture == 0.0 {
            ("perspective", 1.0, fov)
        } else {
            let (radius, focus) = (Number(view.aperture / 2.0), Number(view.focus));
            let lens = format!(
                "<float name=\"aperture_radius\" value=\"{radius}\"/>\
                 <float name=\"focus_distance\" value=\"{focus}\"/>"
            );
            ("thinlens", 1.0, fov + &lens)
        }
    };
    if view.is_parallel && view.aperture > 0.0 {
        omissions.add("camera", "with parallel rays all is sharp", "");
    }
    let place = matrix(&[view.right * -size, view.up * size, view.axis], &view.origin);
    let near = view.distance.min(view.width) * 1e-4;
    format!(
        "<sensor type=\"{kind}\">{angle}<float name=\"near_clip\" value=\"{}\"/>\
         <float name=\"far_clip\" value=\"{}\"/>\n{place}\n\
         <film type=\"hdrfilm\"><integer name=\"width\" value=\"$width\"/>\
         <integer name=\"height\" value=\"$height\"/>\
         <string name=\"pixel_format\" value=\"rgb\"/>\
         <string name=\"component_format\" value=\"float32\"/><rfilter type=\"box\"/></film>\n\
         <sampler type=\"independent\"><integer name=\"sample_count\" value=\"$spp\"/></sampler>\n\
         </sensor>\n",
        Number(near),
        Number(near * 1e12),
    )
}

/// `to_world`: the images of the axes and of the origin.
fn matrix(axes: &[Vector; 3], origin: &Point) -> String {
    let mut numbers = Vec::with_capacity(16);
    for row in 0..3 {
        numbers.extend(axes.iter().map(|axis| axis[row]));
        numbers.push(origin[row]);
    }
    numbers.extend([0.0, 0.0, 0.0, 1.0]);
    format!(
        "<transform name=\"to_world\"><matrix value=\"{}\"/></transform>",
        joined(&numbers, " ")
    )
}

fn rgb(name: &str, colour: [f64; 3], factor: f64) -> String {
    format!("<rgb name=\"{name}\" value=\"{}\"/>", joined(&colour.map(|c| c * factor), ", "))
}

struct Writer<'a> {
    exposure: f64,
    scene: &'a Scene,
    stem: &'a str,
    /// How far from the origin the camera and its target are.
    reach: f64,
    omissions: &'a mut Omissions,
    files: Vec<Attachment>,
    /// The files of shapes that were met already, and whether they are flat, by address: only
    /// looked up.
    known: BTreeMap<*const Shape, (usize, bool)>,
    /// Whether nothing mirrors or is clear.
    is_matte: bool,
    body: String,
}

impl Writer<'_> {
    fn groups(&mut self, groups: &[Placed], outer: &Placement) {
        for placed in groups {
            let placement = placed.placement.then(outer);
            let group = &placed.group;
            let of =
                group.name().map_or_else(|| " of a group".to_owned(), |n| format!(" of `{n}`"));
            self.shapes(group.shapes(), &placement, &of);
            self.groups(group.groups(), &placement);
        }
    }

    fn shapes(&mut self, shapes: &[Shape], placement: &Placement, of: &str) {
        for (i, shape) in shapes.iter().enumerate() {
            let place = format!("shape {}{of}, a {}", i + 1, shape.geometry.kind());
            self.shape(shape, placement, &place);
        }
    }

    /// A file of the scene's, by its number among them.
    fn file(&mut self, bytes: Vec<u8>) -> usize {
        let name = format!("{}-{}.ply", self.stem, self.files.len() + 1);
        self.files.push(Attachment { name, bytes });
        self.files.len() - 1
    }
}
