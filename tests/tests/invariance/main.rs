//! What must not change a picture: where a scene stands, how large it is, which way it is
//! turned, in which order it is described, of what it is made up, and which end of a path the
//! eye is at. Pictures of `whitted` as linear light, and what is seen where.
//!
//! Where a picture must be the same to the bit, films are compared as they are. Else a
//! component counts as different where it differs by more than a tolerance relative to 1 (display
//! white) plus its own size; the film itself is in single precision, so no tolerance is below
//! 2^-23. Borders of shapes, shadows and cells cannot be bound like that: a pixel whose
//! ray passes them within the rounding of the scene's coordinates may be on either side.

mod made_of;
mod order;
mod reverse;
mod scale;
mod translate;
mod turn;

use lancer_film::{Film, LayerPixel};
use lancer_integrator::{Engine, RenderSettings, Rendered, Whitted, render};
use lancer_scene::{PixelCount, Scene};
use lancer_tests::paths::{Beside, scenes};
use std::num::NonZeroUsize;

/// Scenes that together have every shape, checkers on each kind, mirrors, glass and media,
/// sheets, groups in groups, smooth and flat meshes, lamps, suns and spots, and both kinds of cameras.
const SCENES: [&str; 12] = [
    "absorption",
    "all_shapes",
    "checkers",
    "facing_mirrors",
    "glass",
    "instances",
    "meshes",
    "mirror_corridor",
    "orthographic",
    "sheets",
    "spots",
    "water_glass",
];

/// One with meshes, which take longer to be prepared.
const MESHES: [&str; 2] = ["all_shapes", "meshes"];

/// Several tiles, some of them not whole.
const PIXELS: [u32; 2] = [72, 50];

/// One of the scenes, with a picture of [`PIXELS`].
fn scene(name: &str) -> Scene {
    let path = scenes().join(format!("{name}.xml"));
    let bytes = std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let parsed =
        lancer_xml::parse_with(&bytes, &lancer_xml::Options::default(), &Beside(&scenes()));
    let mut scene = parsed.into_result().unwrap_or_else(|e| panic!("{name}: {e}"));
    let [width, height] = PIXELS.map(|side| PixelCount::new(side).expect("it is above 0"));
    (scene.camera.px_width, scene.camera.px_height) = (width, height);
    scene
}

/// The picture with what is seen where.
fn picture(scene: &Scene) -> Rendered {
    rendered(scene, &Whitted::new())
}

fn rendered(scene: &Scene, engine: &dyn Engine) -> Rendered {
    let settings = RenderSettings {
        layers: true,
        threads: Some(NonZeroUsize::MIN),
        ..RenderSettings::default()
    };
    render(scene, engine, &settings).unwrap_or_else(|e| panic!("{e}"))
}

/// The bits of all components.
fn bits(film: &Film) -> Vec<[u32; 3]> {
    film.pixels().iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

/// What is seen where, but how far away it is.
fn seen(rendered: &Rendered) -> Vec<LayerPixel> {
    let layers = rendered.layers.as_ref().expect("they were asked for");
    let without_depth = |p: &LayerPixel| LayerPixel { axis_depth: 0.0, ray_depth: 0.0, ..*p };
    layers.pixels().iter().map(without_depth).collect()
}

/// How many of the pixels differ by more than `tolerance`.
fn differing<'a>(
    found: impl IntoIterator<Item = &'a [f32; 3]>,
    expected: impl IntoIterator<Item = &'a [f32; 3]>,
    tolerance: f64,
) -> usize {
    let differ = |(a, b): &(&[f32; 3], &[f32; 3])| {
        a.iter().zip(*b).any(|(&a, &b)| {
            let (a, b) = (f64::from(a), f64::from(b));
            !((a - b).abs() <= tolerance * (1.0 + b.abs()))
        })
    };
    found.into_iter().zip(expected).filter(differ).count()
}

/// The rows with their pixels from right to left.
fn mirrored(film: &Film) -> Vec<[f32; 3]> {
    film.pixels().chunks(PIXELS[0] as usize).flat_map(|row| row.iter().rev().copied()).collect()
}

#[test]
fn differences_are_seen() {
    let (a, b) = (picture(&scene("glass")), picture(&scene("sheets")));
    assert_ne!(bits(&a.film), bits(&b.film));
    assert!(differing(a.film.pixels(), b.film.pixels(), 1e-6) > 1000);
    assert_ne!(
        bits(&a.film),
        mirrored(&a.film).iter().map(|p| p.map(f32::to_bits)).collect::<Vec<_>>()
    );
    assert_eq!(differing(&[[0.0, f32::NAN, 0.0]], &[[0.0; 3]], 1.0), 1);
}
