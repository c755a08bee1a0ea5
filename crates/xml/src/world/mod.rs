//! From the XML tree to the scene.

mod camera;
mod groups;
mod lights;
mod mesh;
mod names;
mod reach;
mod shapes;
mod surface;

use crate::document::start_of;
use crate::element::{Reader, shorten};
use crate::files::Files;
use crate::parse::Options;
use crate::schema::{self, Element};
use crate::{Diagnostic, number};
use lancer_scene::{Direction, OutOfRange, Position, Scene, Shadows, Spectrum};

pub(crate) type Out<'o> = &'o mut Vec<Diagnostic>;
type Node<'a, 'i> = roxmltree::Node<'a, 'i>;

/// What shapes may refer to.
struct Scope<'a, 'f> {
    materials: surface::Materials<'a>,
    defines: groups::Defines<'a>,
    meshes: mesh::Meshes<'a, 'f>,
}

/// The scene below the root of the tree; where it is invalid, `out` says so.
pub(crate) fn world(
    root: Node<'_, '_>,
    options: &Options,
    files: &dyn Files,
    out: Out<'_>,
) -> Option<Scene> {
    let name = root.tag_name().name();
    if name != schema::WORLD.name {
        out.push(
            Diagnostic::error(
                start_of(&root),
                format!("the root element is <{}>", shorten(name)),
                "expected <world>",
            )
            .help("a scene file is <world> with a <camera>, <lights> and <shapes>".to_owned()),
        );
        return None;
    }
    let world = Reader::new(root, &schema::WORLD, out);
    let camera = world.child(&schema::CAMERA, out).and_then(|r| camera::camera(&r, options, out));
    let background = background(&world, out);
    let lights = world.child(&schema::LIGHTS, out);
    let shadows = lights.as_ref().and_then(|r| lights::shadows(r, out));
    let lights = lights.map(|r| lights::lights(&r, out));

    let mut scope = Scope {
        materials: surface::Materials::read(&world, out),
        defines: groups::Defines::default(),
        meshes: mesh::Meshes::new(files),
    };
    groups::read_defines(&world, &mut scope, out);
    let shapes = world.child(&schema::SHAPES, out).map(|r| groups::shapes(&r, &mut scope, out));
    scope.materials.finish(out);
    scope.defines.finish(out);

    let (shapes, groups) = shapes?;
    Some(Scene {
        camera: camera?,
        lights: lights?,
        shadows: shadows.unwrap_or(Shadows::Tinted),
        background: background.unwrap_or(Spectrum::NONE),
        shapes,
        groups,
    })
}

fn background(world: &Reader<'_, '_>, out: Out<'_>) -> Option<Spectrum> {
    world.child(&schema::BACKGROUND, out)?.radiance("color", out)
}

fn warn_empty(parent: &Reader<'_, '_>, consequence: &str, out: Out<'_>) {
    let name = parent.name();
    out.push(Diagnostic::warning(parent.start(), format!("<{name}> is empty"), consequence));
}

fn position(parent: &Reader<'_, '_>, element: &'static Element, out: Out<'_>) -> Option<Position> {
    xyz(parent, element, Position::new, out)
}

fn direction(
    parent: &Reader<'_, '_>,
    element: &'static Element,
    out: Out<'_>,
) -> Option<Direction> {
    xyz(parent, element, Direction::new, out)
}

fn xyz<T>(
    parent: &Reader<'_, '_>,
    element: &'static Element,
    range: impl FnOnce([f64; 3]) -> Result<T, OutOfRange>,
    out: Out<'_>,
) -> Option<T> {
    let reader = parent.child(element, out)?;
    match range(coordinates(&reader, out)?) {
        Ok(value) => Some(value),
        Err(OutOfRange { found, expected }) => {
            out.push(Diagnostic::error(
                reader.start(),
                format!("<{}> of <{}> is {found}", reader.name(), parent.name()),
                format!("expected {expected}"),
            ));
            None
        }
    }
}

/// The attributes x, y and z.
fn coordinates(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<[f64; 3]> {
    let [x, y, z] = ["x", "y", "z"].map(|axis| reader.number(axis, Ok, out));
    Some([x?, y?, z?])
}

/// A text from elsewhere, as one line of at most so many characters.
fn one_line(text: &str, most: usize) -> String {
    let text = number::trim(text);
    let mut line: String = text
        .chars()
        .take(most)
        .map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c })
        .collect();
    if text.chars().nth(most).is_some() {
        line.push_str("...");
    }
    line
}
