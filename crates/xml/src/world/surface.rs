//! What surfaces look like, and the materials that they share.

use super::Out;
use super::names::Names;
use crate::Diagnostic;
use crate::element::Reader;
use crate::schema::{self, Cells};
use lancer_scene::{
    Checker, Colour, Degrees, Fraction, Ior, Length, Medium, Pattern, Spectrum, Surface,
};
use std::ops::Range;

/// The attributes of a surface that an element gives.
#[derive(Debug, Clone, Copy, Default)]
struct Look {
    colour: Option<Colour>,
    gloss: Option<Fraction>,
    chess: Option<Chess>,
    transparency: Option<Fraction>,
    ior: Option<Ior>,
    absorption: Option<Spectrum>,
    thin: Option<bool>,
    emission: Option<Spectrum>,
    priority: Option<i32>,
    /// Whether a value was wrong, and so is missing here.
    broken: bool,
}

#[derive(Debug, Clone, Copy)]
enum Chess {
    None,
    Complement,
    Colour(Colour),
}

impl Look {
    fn read(reader: &Reader<'_, '_>, out: Out<'_>) -> Self {
        let before = out.len();
        let colour = reader.colour("color", &[], out);
        let gloss = reader.number("gloss", Fraction::new, out);
        let chess = match reader.text("chess") {
            None => None,
            Some("none") => Some(Chess::None),
            Some("default") => Some(Chess::Complement),
            Some(_) => reader.colour("chess", &["default", "none"], out).map(Chess::Colour),
        };
        let transparency = reader.number("transparency", Fraction::new, out);
        let ior = reader.number("ior", Ior::new, out);
        let absorption = reader.spectrum("absorption", out);
        let thin = reader.flag("thin", out);
        let emission = reader.spectrum("emission", out);
        let priority = reader.integer("priority", out);
        let broken = out.len() > before;
        Self {
            colour,
            gloss,
            chess,
            transparency,
            ior,
            absorption,
            thin,
            emission,
            priority,
            broken,
        }
    }

    /// These, and where they are missing those of `other`.
    fn or(self, other: Self) -> Self {
        Self {
            colour: self.colour.or(other.colour),
            gloss: self.gloss.or(other.gloss),
            chess: self.chess.or(other.chess),
            transparency: self.transparency.or(other.transparency),
            ior: self.ior.or(other.ior),
            absorption: self.absorption.or(other.absorption),
            thin: self.thin.or(other.thin),
            emission: self.emission.or(other.emission),
            priority: self.priority.or(other.priority),
            broken: self.broken || other.broken,
        }
    }

    fn is_clear(&self) -> bool {
        self.transparency.is_some_and(|transparency| transparency > Fraction::NONE)
    }

    fn is_thin(&self) -> bool {
        self.thin == Some(true)
    }

    fn has_matte_part(&self) -> bool {
        self.gloss != Some(Fraction::ALL) && self.transparency != Some(Fraction::ALL)
    }

    fn surface(&self, size: CellSize) -> Surface {
        let colour = self.colour.unwrap_or(Colour::WHITE);
        let second = match self.chess {
            None | Some(Chess::None) => None,
            Some(Chess::Complement) => Some(colour.complement()),
            Some(Chess::Colour(second)) => Some(second),
        };
        let pattern = second.map_or(Pattern::Solid, |second| {
            let usual = Checker::new(second);
            Pattern::Checker(Checker {
                second,
                length: size.length.unwrap_or(usual.length),
                angle: size.angle.unwrap_or(usual.angle),
            })
        });
        Surface {
            colour,
            gloss: self.gloss.unwrap_or_default(),
            pattern,
            transparency: self.transparency.unwrap_or_default(),
            medium: Medium {
                ior: self.ior.unwrap_or(Ior::GLASS),
                absorption: self.absorption.unwrap_or_default(),
            },
            thin: self.is_thin(),
            emission: self.emission.unwrap_or_default(),
            priority: self.priority.unwrap_or_default(),
        }
    }
}

/// Those of the attributes that mean something for clear surfaces alone which
/// the element gives.
fn for_clear(reader: &Reader<'_, '_>, look: &Look) -> impl Iterator<Item = &'static str> {
    ["ior", "absorption", "thin", "priority"]
        .into_iter()
        .filter(|name| reader.has(name))
        .filter(|name| *name != "thin" || look.is_thin())
}

fn no_effect(name: &str, element: &str, span: Range<usize>, why: &str) -> Diagnostic {
    Diagnostic::warning(span, format!("`{name}` of <{element}> has no effect"), why)
}

/// Warns of what an element says of the inside of a thin sheet.
fn warn_thin(reader: &Reader<'_, '_>, out: Out<'_>) {
    for name in ["absorption", "priority"].into_iter().filter(|name| reader.has(name)) {
        let why = "a thin sheet has nothing inside";
        let warning = no_effect(name, reader.name(), reader.name_span_of(name), why);
        out.push(match reader.has("thin") {
            true => warning.related(reader.name_span_of("thin"), "thin is said here"),
            false => warning,
        });
    }
}

/// The materials of a scene.
pub(super) struct Materials<'a> {
    names: Names<'a>,
    materials: Vec<Material>,
}

struct Material {
    look: Look,
    /// The attributes that mean something for clear surfaces alone.
    for_clear: Vec<(&'static str, Range<usize>)>,
    used: bool,
    /// Whether a shape of it is clear, or may be meant to.
    clear: bool,
}

impl<'a> Materials<'a> {
    pub(super) fn read(world: &Reader<'a, '_>, out: Out<'_>) -> Self {
        let mut all = Self { names: Names::new("material"), materials: Vec::new() };
        let is_material = |element| std::ptr::eq(element, &schema::MATERIAL);
        for (node, element) in world.children().filter(|(_, e)| is_material(*e)) {
            let reader = Reader::new(node, element, out);
            let look = Look::read(&reader, out);
            if look.is_thin() {
                warn_thin(&reader, out);
            }
            if all.names.add(&reader, out) {
                let given = for_clear(&reader, &look);
                let for_clear = given.map(|name| (name, reader.name_span_of(name))).collect();
                all.materials.push(Material { look, for_clear, used: false, clear: false });
            }
        }
        all
    }

    /// Reports what turned out to mean nothing.
    pub(super) fn finish(&self, out: Out<'_>) {
        self.names.report_unused(out);
        for material in self.materials.iter().filter(|m| m.used && !m.clear) {
            for (name, span) in &material.for_clear {
                let why = "no shape of this material has a `transparency` above 0";
                out.push(no_effect(name, schema::MATERIAL.name, span.clone(), why));
            }
        }
    }
}

/// The surface of a shape.
pub(super) fn surface<'a>(
    reader: &Reader<'a, '_>,
    materials: &mut Materials<'a>,
    out: Out<'_>,
) -> Option<Surface> {
    let own = Look::read(reader, out);
    let size = CellSize::read(reader, out);
    let material = match reader.has("material") {
        true => Some(materials.names.find(reader, "material", out)?),
        false => None,
    };
    let material = material.map(|place| &mut materials.materials[place]);
    let look = own.or(material.as_ref().map_or_else(Look::default, |m| m.look));
    if let Some(material) = material {
        material.used = true;
        material.clear |= look.is_clear() || look.broken;
    }
    // What is wrong may be the colour, or what would make one needless.
    let excused = ["color", "material", "gloss", "transparency"];
    let excused = look.broken && excused.iter().any(|name| reader.has(name));
    if look.colour.is_none() && look.has_matte_part() && !excused {
        reader.demand(&schema::SURFACE[0], out);
        return None;
    }
    if look.broken {
        return None;
    }
    if reader.has("chess-size") && matches!(look.chess, None | Some(Chess::None)) {
        out.push(
            Diagnostic::error(
                reader.name_span_of("chess-size"),
                format!("`chess-size` of <{}> is given without `chess`", reader.name()),
                "expected `chess=\"...\"` with it",
            )
            .help("give the second colour as `chess`, or leave `chess-size` out".to_owned()),
        );
        return None;
    }
    if !look.is_clear() {
        for name in for_clear(reader, &own) {
            let warning = no_effect(
                name,
                reader.name(),
                reader.name_span_of(name),
                "nothing of this surface is clear",
            );
            let help = format!("give it a `transparency` above 0, or leave `{name}` out");
            out.push(warning.help(help));
        }
    } else if look.is_thin() {
        warn_thin(reader, out);
    }
    Some(look.surface(size?))
}

/// The sides of the cells of a checker, where they are given.
#[derive(Debug, Clone, Copy, Default)]
struct CellSize {
    length: Option<Length>,
    angle: Option<Degrees>,
}

impl CellSize {
    fn read(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Self> {
        if !reader.has("chess-size") {
            return Some(Self::default());
        }
        let length = |value| Length::new(value).map(Length::get);
        let angle = |value| Degrees::dividing_180(value).map(Degrees::get);
        Some(match reader.element.cells? {
            Cells::Length => {
                let [side] = reader.numbers("chess-size", |_, value| length(value), out)?;
                Self { length: Length::new(side).ok(), angle: None }
            }
            Cells::Angle => {
                let [side] = reader.numbers("chess-size", |_, value| angle(value), out)?;
                Self { length: None, angle: Degrees::dividing_180(side).ok() }
            }
            Cells::LengthAndAngle => {
                let range = |i, value| if i == 0 { length(value) } else { angle(value) };
                let [side, around] = reader.numbers("chess-size", range, out)?;
                Self { length: Length::new(side).ok(), angle: Degrees::dividing_180(around).ok() }
            }
        })
    }
}
