//! From the XML tree to the scene.

use crate::document::{decode, start_of, tree};
use crate::element::{Reader, shorten};
use crate::schema::{self, Element};
use crate::{Diagnostic, Severity, Source, suggest};
use lancer_scene::{
    Brightness, Camera, Colour, Direction, Geometry, Gloss, Length, Light, OutOfRange, Pattern,
    PixelCount, Plane, Position, Scene, Shape, Sphere, Surface,
};
use std::ops::Range;

/// The pixel budget of [`Options::default`]: a picture may have so many.
pub const MAX_PIXELS: u64 = 100_000_000;

/// How a file is to be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// A camera whose picture has more pixels is an error. None: no limit.
    pub max_pixels: Option<u64>,
}

impl Default for Options {
    fn default() -> Self {
        Self { max_pixels: Some(MAX_PIXELS) }
    }
}

/// What a file says.
#[derive(Debug, Clone)]
pub struct Parsed {
    /// The text that the diagnostics speak of.
    pub source: Source,
    /// All that is wrong, in the order of the file.
    pub diagnostics: Vec<Diagnostic>,
    /// The scene; there is none if a diagnostic is an error.
    pub scene: Option<Scene>,
}

/// A file that holds no valid scene.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{}", self.list())]
pub struct InvalidFile {
    /// The text that the diagnostics speak of.
    pub text: Source,
    /// All that is wrong, in the order of the file; one at least is an error.
    pub diagnostics: Vec<Diagnostic>,
}

impl InvalidFile {
    fn list(&self) -> String {
        let lines = self.diagnostics.iter().map(|diagnostic| {
            let (line, column) = self.text.location(diagnostic.span.start);
            format!("{line}:{column}: {}", diagnostic.message)
        });
        lines.collect::<Vec<_>>().join("\n")
    }
}

impl Parsed {
    /// The scene, warnings left aside.
    ///
    /// # Errors
    /// Where the file holds no valid scene.
    pub fn into_result(self) -> Result<Scene, InvalidFile> {
        self.scene.ok_or(InvalidFile { text: self.source, diagnostics: self.diagnostics })
    }
}

/// Reads the bytes of a scene file.
#[must_use]
pub fn parse(bytes: &[u8], options: &Options) -> Parsed {
    let (source, not_text) = decode(bytes);
    let mut diagnostics = Vec::new();
    let scene = if let Some(diagnostic) = not_text {
        diagnostics.push(diagnostic);
        None
    } else {
        mended_world(&source, options, &mut diagnostics)
    };
    diagnostics.sort_by_key(|diagnostic| diagnostic.span.start);
    let scene = scene.filter(|_| diagnostics.iter().all(|d| d.severity != Severity::Error));
    Parsed { source, diagnostics, scene }
}

/// How many mistakes are blanked out to find those behind them.
const MOST_MENDED: usize = 50;

/// The scene, found even where the XML has mistakes that can be left out.
fn mended_world(source: &Source, options: &Options, out: Out<'_>) -> Option<Scene> {
    let mut text = std::borrow::Cow::Borrowed(source.text());
    let mut mended: Vec<Range<usize>> = Vec::new();
    for _ in 0..=MOST_MENDED {
        let problem = match tree(&text, source) {
            Ok(document) => {
                let mut found = Vec::new();
                let scene = world(document.root_element(), options, &mut found);
                // What is wrong with a blank has been said.
                let blank = |span: &Range<usize>| {
                    mended.iter().any(|mend| span.start < mend.end && mend.start < span.end)
                };
                out.extend(found.into_iter().filter(|diagnostic| !blank(&diagnostic.span)));
                return scene;
            }
            Err(problem) => *problem,
        };
        out.push(problem.diagnostic);
        let mend = problem.mend?;
        text.to_mut().replace_range(mend.clone(), &" ".repeat(mend.len()));
        mended.push(mend);
    }
    None
}

type Node<'a, 'i> = roxmltree::Node<'a, 'i>;
type Out<'o> = &'o mut Vec<Diagnostic>;

fn world(root: Node<'_, '_>, options: &Options, out: Out<'_>) -> Option<Scene> {
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
    let camera = world.child(&schema::CAMERA, out).and_then(|r| camera(&r, options, out));
    let lights = world.child(&schema::LIGHTS, out).map(|r| list(&r, light, out));
    let shapes = world.child(&schema::SHAPES, out).map(|r| list(&r, shape, out));
    Some(Scene { camera: camera?, lights: lights?, shapes: shapes? })
}

/// All children, as `read` reads them; those with mistakes are left out.
fn list<T>(
    parent: &Reader<'_, '_>,
    read: impl Fn(&Reader<'_, '_>, &'static Element, Out<'_>) -> Option<T>,
    out: Out<'_>,
) -> Vec<T> {
    let mut items = Vec::new();
    let mut empty = true;
    for (node, element) in parent.children() {
        empty = false;
        let reader = Reader::new(node, element, out);
        items.extend(read(&reader, element, out));
    }
    if empty {
        let name = parent.name();
        out.push(Diagnostic::warning(
            parent.start(),
            format!("<{name}> is empty"),
            if name == schema::LIGHTS.name {
                "nothing shines: the picture will be black"
            } else {
                "there is nothing to be seen"
            },
        ));
    }
    items
}

fn camera(reader: &Reader<'_, '_>, options: &Options, out: Out<'_>) -> Option<Camera> {
    let width = reader.number("width", Length::new, out);
    let px_width = reader.whole("pxwidth", PixelCount::new, out);
    let px_height = reader.whole("pxheight", PixelCount::new, out);
    let origin = position(reader, &schema::ORIGIN, out);
    let target = position(reader, &schema::TARGET, out);
    let (px_width, px_height) = (px_width?, px_height?);
    let pixels = u64::from(px_width.get()) * u64::from(px_height.get());
    if let Some(most) = options.max_pixels.filter(|most| pixels > *most) {
        let wider = px_width >= px_height;
        out.push(
            Diagnostic::error(
                reader.span_of(if wider { "pxwidth" } else { "pxheight" }),
                format!("the picture has {pixels} pixels"),
                format!("expected at most {most} in all"),
            )
            .help("make the picture smaller, or allow more with `--max-pixels`".to_owned()),
        );
        return None;
    }
    match Camera::from_values(origin?, target?, width?, px_width, px_height) {
        Ok(camera) => Some(camera),
        Err(_) => {
            let place = |element| reader.child(element, &mut Vec::new()).map(|r| r.start());
            let target = place(&schema::TARGET).unwrap_or_else(|| reader.start());
            let mut diagnostic = Diagnostic::error(
                target,
                "the camera's target is where the eye is",
                "expected a point other than the origin",
            )
            .help("the eye looks from `origin` at `target`".to_owned());
            if let Some(origin) = place(&schema::ORIGIN) {
                diagnostic = diagnostic.related(origin, "the eye is here");
            }
            out.push(diagnostic);
            None
        }
    }
}

fn light(reader: &Reader<'_, '_>, element: &'static Element, out: Out<'_>) -> Option<Light> {
    let brightness = reader.number("brightness", Brightness::new, out);
    if std::ptr::eq(element, &schema::SUN) {
        let direction = direction(reader, &schema::POINT, out);
        Some(Light::Sun { direction: direction?, brightness: brightness? })
    } else {
        let point = position(reader, &schema::POINT, out);
        Some(Light::Lamp { point: point?, brightness: brightness? })
    }
}

fn shape(reader: &Reader<'_, '_>, element: &'static Element, out: Out<'_>) -> Option<Shape> {
    let surface = surface(reader, out);
    let geometry = if std::ptr::eq(element, &schema::SPHERE) {
        let radius = reader.number("size", Length::new, out);
        let centre = position(reader, &schema::POINT, out);
        Geometry::Sphere(Sphere { centre: centre?, radius: radius? })
    } else {
        let origin = position(reader, &schema::ORIGIN, out);
        let normal = direction(reader, &schema::NORMAL, out);
        Geometry::Plane(Plane { origin: origin?, normal: normal? })
    };
    Some(Shape { geometry, surface: surface? })
}

fn surface(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Surface> {
    let colour = reader.text("color").and_then(|name| named_colour(reader, "color", name, out));
    let gloss = reader.number("gloss", Gloss::new, out);
    let pattern = match reader.text("chess") {
        None => Some(Pattern::Solid),
        Some("default") => colour.map(|colour| Pattern::Checker(colour.complement())),
        Some(name) => named_colour(reader, "chess", name, out).map(Pattern::Checker),
    };
    Some(Surface { colour: colour?, gloss: gloss?, pattern: pattern? })
}

fn named_colour(
    reader: &Reader<'_, '_>,
    attribute: &str,
    name: &str,
    out: Out<'_>,
) -> Option<Colour> {
    let colour = Colour::from_name(name);
    if colour.is_none() {
        let names = Colour::NAMED.iter().map(|(name, _)| *name);
        let also = (attribute == "chess").then_some("default");
        out.push(
            Diagnostic::error(
                reader.span_of(attribute),
                format!("unknown colour `{}`", shorten(name)),
                match also {
                    Some(_) => "expected a colour name or `default`",
                    None => "expected a colour name",
                },
            )
            .help(suggest::help(name, names.chain(also), "the colours are")),
        );
    }
    colour
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
    let [x, y, z] = ["x", "y", "z"].map(|axis| reader.number(axis, Ok, out));
    match range([x?, y?, z?]) {
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
