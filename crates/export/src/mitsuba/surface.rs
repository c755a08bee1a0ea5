use super::rgb;
use crate::text::Number;
use lancer_scene::{Pattern, Surface};

const MIRROR: &str = "<bsdf type=\"conductor\"><string name=\"material\" value=\"none\"/></bsdf>";

/// A surface; `to_uv` is how a checker's cells follow from a shape's own coordinates.
pub(super) fn bsdf(surface: &Surface, to_uv: &str) -> String {
    let (gloss, clear) = (surface.gloss.get(), surface.transparency.get());
    if gloss == 1.0 {
        return format!("<bsdf type=\"twosided\">{MIRROR}</bsdf>");
    }
    if !surface.is_transparent() {
        let matte = blend(gloss, &matte(surface, to_uv), MIRROR);
        return format!("<bsdf type=\"twosided\">{matte}</bsdf>");
    }
    let kind = if surface.thin { "thindielectric" } else { "dielectric" };
    let glass = format!(
        "<bsdf type=\"{kind}\"><float name=\"int_ior\" value=\"{}\"/>\
         <float name=\"ext_ior\" value=\"1\"/></bsdf>",
        Number(surface.medium.ior.get())
    );
    blend(gloss, &blend(clear, &matte(surface, to_uv), &glass), MIRROR)
}

/// So much of the second.
fn blend(share: f64, first: &str, second: &str) -> String {
    if share == 0.0 {
        first.to_owned()
    } else if share == 1.0 {
        second.to_owned()
    } else {
        let share = Number(share);
        format!(
            "<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"{share}\"/>{first}{second}</bsdf>"
        )
    }
}

fn matte(surface: &Surface, to_uv: &str) -> String {
    let first = surface.colour.shares();
    let colour = match surface.pattern {
        Pattern::Solid => rgb("reflectance", first, 1.0),
        Pattern::Checker(checker) => format!(
            "<texture type=\"checkerboard\" name=\"reflectance\">{}{}{to_uv}</texture>",
            rgb("color0", first, 1.0),
            rgb("color1", checker.second.shares(), 1.0)
        ),
    };
    format!("<bsdf type=\"diffuse\">{colour}</bsdf>")
}
