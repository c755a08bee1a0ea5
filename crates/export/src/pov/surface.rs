//! Surfaces as textures.
//!
//! An opaque surface with gloss g is `diffuse 1-g reflection g`, which add up. A clear one is
//! `reflection { g, 1 fresnel }` with `conserve_energy`: with F by Fresnel it mirrors
//! F + (1-F) g and lets through the rest. One that is partly clear is the average of a matte,
//! a clear and a mirroring texture, weighted by their shares.

use super::checker::Cells;
use super::rgb;
use crate::omission::Omissions;
use crate::text::Number;
use lancer_scene::{Geometry, Pattern, Shadows, Shape, Surface};
use std::fmt::Write;

/// Where a layer must show no more than its emission, it is so opaque: 2^-14, which
/// single precision takes from 1 exactly.
const FILM: f64 = 6.103_515_625e-5;

/// The darkest component of a matte colour that emission can be a multiple of: 2^-20.
const DARKEST: f64 = 9.536_743_164_062_5e-7;

/// A surface as it is written.
pub(super) struct Look<'a> {
    /// `None` for what is dark and opaque.
    surface: Option<&'a Surface>,
    exposure: f64,
    /// What is behind a surface that lets light through; empty for others.
    pub(super) interior: String,
}

impl<'a> Look<'a> {
    pub(super) fn new(surface: &'a Surface, exposure: f64) -> Self {
        let interior = if !surface.is_transparent() {
            String::new()
        } else if surface.thin {
            " interior { ior 1 }".to_owned()
        } else {
            let absorption = surface.medium.absorption;
            let media = if absorption.is_none() {
                String::new()
            } else {
                format!(" media {{ absorption {} }}", rgb(absorption.get(), 1.0))
            };
            format!(" interior {{ ior {}{media} }}", Number(surface.medium.ior.get()))
        };
        Self { surface: Some(surface), exposure, interior }
    }

    /// Of what casts a shadow and is not seen.
    pub(super) fn dark() -> Self {
        Self { surface: None, exposure: 1.0, interior: String::new() }
    }

    /// Where its colours are; none where it has but one.
    pub(super) fn cells(&self, geometry: &Geometry) -> Vec<Cells> {
        let visible = |surface: &&Surface| matte(surface) > 0.0;
        let surface = self.surface.filter(visible);
        surface.map_or_else(Vec::new, |surface| super::checker::cells(geometry, surface))
    }

    /// What stands in the braces of `texture`.
    pub(super) fn texture(&self, cells: Option<&Cells>) -> String {
        let Some(surface) = self.surface else { return "pigment { rgb 0 }".to_owned() };
        let (gloss, clear) = (surface.gloss.get(), surface.transparency.get());
        if !surface.is_transparent() {
            return self.opaque(surface, cells, gloss, 1.0);
        }
        if clear == 1.0 && !surface.thin {
            return glass(gloss) + &self.film();
        }
        let shares = [(1.0 - gloss) * (1.0 - clear), (1.0 - gloss) * clear, gloss];
        let parts = [
            self.opaque(surface, cells, 0.0, shares[0]),
            if surface.thin { sheet(surface.medium.ior.get()) } else { glass(0.0) },
            opaque_finish("pigment { rgb 0 }", 1.0, ""),
        ];
        let mut map = String::new();
        for (share, part) in shares.iter().zip(&parts) {
            if *share > 0.0 {
                let _ = write!(map, " [{} {part}]", Number(*share));
            }
        }
        format!("average texture_map {{{map} }}")
    }

    /// A matte surface that mirrors so much, and whose emission is shown at `share`.
    fn opaque(&self, surface: &Surface, cells: Option<&Cells>, gloss: f64, share: f64) -> String {
        let emission = surface.emission.get().map(|e| e * self.exposure / share);
        let glows = !surface.emission.is_none();
        let first = surface.colour.shares();
        let second = match surface.pattern {
            Pattern::Checker(checker) => checker.second.shares(),
            Pattern::Solid => first,
        };
        let one = |colour: [f64; 3]| {
            let (colour, glow) =
                if glows { glowing(colour, emission) } else { (colour, String::new()) };
            opaque_finish(&format!("pigment {{ {} }}", rgb(colour, 1.0)), gloss, &glow)
        };
        match cells {
            None => one(first),
            Some(cells) if glows => cells.texture(&one(first), &one(second)),
            Some(cells) => opaque_finish(&cells.pigment(first, second), gloss, ""),
        }
    }

    /// A layer for a clear texture that shows the emission.
    fn film(&self) -> String {
        match self.surface {
            Some(surface) if !surface.emission.is_none() => format!(
                " }} texture {{ pigment {{ rgbt <1, 1, 1, {}> }} finish {{ diffuse 0 emission {} }}",
                Number(1.0 - FILM),
                rgb(surface.emission.get(), self.exposure / FILM)
            ),
            _ => String::new(),
        }
    }

    /// What cannot be said of it.
    pub(super) fn note(
        &self,
        shape: &Shape,
        shadows: Shadows,
        place: &str,
        omissions: &mut Omissions,
    ) {
        let surface = &shape.surface;
        if !surface.is_transparent() {
            return;
        }
        if shadows == Shadows::Tinted {
            omissions.add(
                place,
                "on its way to a surface light passes through clear things without being mirrored \
                 or absorbed",
                "say shadows=\"opaque\", which can be said",
            );
        }
        if surface.priority != 0 {
            omissions.add(
                place,
                "its priority: where clear solids overlap, what is there is what a ray has entered \
                 last",
                "let them not overlap",
            );
        }
        if surface.thin {
            omissions.add(
                place,
                "a thin sheet mirrors as much from every side as it does of light that meets it \
                 squarely",
                "",
            );
        }
        if surface.thin && matte(surface) == 0.0 && !surface.emission.is_none() {
            omissions.add(
                place,
                "the emission of a thin sheet that is wholly clear is left out",
                "make it matte by a little: transparency=\"0.999\"",
            );
        }
        if surface.has_medium() && !shape.geometry.is_closed() {
            omissions.add(
                place,
                "clear, with a medium that nothing encloses: POV-Ray may take another way out of it",
                "make it thin=\"true\", or close it",
            );
        }
    }
}

/// How much of a surface is matte.
fn matte(surface: &Surface) -> f64 {
    (1.0 - surface.gloss.get()) * (1.0 - surface.transparency.get())
}

fn opaque_finish(pigment: &str, gloss: f64, glow: &str) -> String {
    let mirror =
        if gloss == 0.0 { String::new() } else { format!(" reflection {}", Number(gloss)) };
    format!("{pigment} finish {{ diffuse {}{mirror}{glow} }}", Number(1.0 - gloss))
}

fn glass(gloss: f64) -> String {
    format!(
        "pigment {{ rgbt 1 }} finish {{ diffuse 0 reflection {{ {}, 1 fresnel }} conserve_energy }}",
        Number(gloss)
    )
}

/// The colour and the emission, which is a multiple of it, of a surface that shows both.
fn glowing(colour: [f64; 3], emission: [f64; 3]) -> ([f64; 3], String) {
    let mut pair = colour.into_iter().zip(emission).map(|(c, e)| {
        let c = if e > 0.0 { c.max(DARKEST) } else { c };
        (c, if e > 0.0 { e / c } else { 0.0 })
    });
    let mut next = || pair.next().unwrap_or_default();
    let [(r, x), (g, y), (b, z)] = [next(), next(), next()];
    ([r, g, b], format!(" emission {}", rgb([x, y, z], 1.0)))
}

/// A clear sheet, which mirrors as much from everywhere as it does of light that meets it squarely:
/// 2 F / (1 + F), with F by Fresnel from air into that medium.
fn sheet(ior: f64) -> String {
    let root = (ior - 1.0) / (ior + 1.0);
    let f = root * root;
    format!(
        "pigment {{ rgbt 1 }} finish {{ diffuse 0 reflection {} conserve_energy }}",
        Number(2.0 * f / (1.0 + f))
    )
}
