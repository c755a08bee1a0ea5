//! Who looks.

use super::{Out, direction, position};
use crate::Diagnostic;
use crate::element::Reader;
use crate::parse::Options;
use crate::schema;
use lancer_scene::{Camera, Degrees, Direction, Exposure, Length, PixelCount, Projection, Stops};

pub(super) fn camera(reader: &Reader<'_, '_>, options: &Options, out: Out<'_>) -> Option<Camera> {
    let projection = projection(reader, out);
    let px_width = reader.whole("pxwidth", PixelCount::new, out);
    let px_height = reader.whole("pxheight", PixelCount::new, out);
    let origin = position(reader, &schema::ORIGIN, out);
    let target = position(reader, &schema::TARGET, out);
    let up = direction(reader, &schema::UP, out);
    let roll = reader.number("roll", Degrees::new, out);
    let (aperture, focus) = lens(reader, out);
    let exposure = exposure(reader, out);
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
    match Camera::from_values(origin?, target?, projection?, px_width, px_height) {
        Ok(mut camera) => {
            camera.up = up.unwrap_or(Direction::Z);
            camera.roll = roll.unwrap_or_default();
            (camera.aperture, camera.focus) = (aperture, focus);
            camera.exposure = exposure.unwrap_or_default();
            Some(camera)
        }
        Err(_) => {
            out.push(
                Diagnostic::error(
                    reader.start_of(&schema::TARGET),
                    "the camera's target is where the eye is",
                    "expected a point other than the origin",
                )
                .help("the eye looks from `origin` at `target`".to_owned())
                .related(reader.start_of(&schema::ORIGIN), "the eye is here"),
            );
            None
        }
    }
}

/// The projection; that both `width` and `fov` are given, or none, has been
/// reported.
fn projection(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Projection> {
    let words = [("perspective", false), ("orthographic", true)];
    let parallel = reader.keyword("projection", &words, out);
    if reader.has("projection") && parallel.is_none() {
        return None;
    }
    let parallel = parallel.unwrap_or(false);
    if reader.has("fov") {
        if parallel && !reader.has("width") {
            out.push(
                Diagnostic::error(
                    reader.name_span_of("fov"),
                    "`fov` of <camera> means nothing where rays are parallel",
                    "expected `width`, a length",
                )
                .related(reader.span_of("projection"), "rays are parallel")
                .help("give the width of what is to be seen as `width`".to_owned()),
            );
        }
        let fov = reader.number("fov", Degrees::view, out)?;
        return (!parallel).then_some(Projection::FieldOfView(fov));
    }
    let width = reader.number("width", Length::new, out)?;
    Some(if parallel { Projection::Orthographic(width) } else { Projection::Pinhole(width) })
}

/// The aperture and the distance in focus.
fn lens(reader: &Reader<'_, '_>, out: Out<'_>) -> (Option<Length>, Option<Length>) {
    if reader.has("focus") && !reader.has("aperture") {
        out.push(
            Diagnostic::error(
                reader.name_span_of("focus"),
                "`focus` of <camera> means nothing without `aperture`",
                "expected an `aperture`, too",
            )
            .help(
                "to a pinhole all is sharp; give the diameter of a lens as `aperture`".to_owned(),
            ),
        );
    }
    let aperture = reader.number("aperture", Length::or_none, out).flatten();
    (aperture, reader.number("focus", Length::new, out))
}

fn exposure(reader: &Reader<'_, '_>, out: Out<'_>) -> Option<Exposure> {
    if reader.text("exposure") == Some("auto") {
        return Some(Exposure::Auto);
    }
    reader.number("exposure", Stops::new, out).map(Exposure::Stops)
}
