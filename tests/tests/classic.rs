//! `classic` and `direct` compute what the original computes.

use lancer_integrator::{Classic, Direct, Engine, RenderSettings, Rendered, render};
use lancer_output::{Bits, Format, compare, decode, encode};
use lancer_scene::{PixelCount, Scene};
use lancer_tests::golden;
use lancer_tests::paths::{scenes, top};
use lancer_tests::plain::{self, Plain};
use lancer_tests::random;
use std::num::NonZeroUsize;

fn scene(name: &str, pixels: [u32; 2]) -> Scene {
    let bytes = std::fs::read(scenes().join(name)).expect("the scene is there");
    let parsed = lancer_xml::parse(&bytes, &lancer_xml::Options::default());
    let mut scene = parsed.into_result().expect("the scene is valid");
    scene.camera.px_width = PixelCount::new(pixels[0]).expect("positive");
    scene.camera.px_height = PixelCount::new(pixels[1]).expect("positive");
    scene
}

fn rendered(scene: &Scene, engine: &dyn Engine, settings: &RenderSettings<'_>) -> Rendered {
    render(scene, engine, settings).expect("it renders")
}

/// Where two films differ in a bit; NaNs are all alike.
fn first_difference(a: &[[f32; 3]], b: &[[f32; 3]]) -> Option<(usize, [f32; 3], [f32; 3])> {
    assert_eq!(a.len(), b.len());
    let bits = |v: f32| if v.is_nan() { u32::MAX } else { v.to_bits() };
    a.iter()
        .zip(b)
        .position(|(a, b)| a.map(bits) != b.map(bits))
        .map(|index| (index, a[index], b[index]))
}

#[test]
fn the_picture_in_the_originals_readme() {
    let scene = scene("readme.xml", [400, 300]);
    let film = rendered(&scene, &Classic, &RenderSettings::default()).film;
    let ours = decode(&encode(&film, Format::Ppm, Bits::Eight).expect("it encodes"));
    let original = std::fs::read(top().join("tests/reference/readme_400.png"));
    let original = decode(&original.expect("the reference is there")).expect("it decodes");
    let comparison = compare(&original, &ours.expect("it decodes")).expect("same size");
    assert!(comparison.largest <= 1.0, "{comparison:?}");
    // 99.95 % identical is asked for; this is what it is.
    assert!(comparison.differing <= 4, "{comparison:?}");
}

#[test]
fn the_shortcuts_change_no_bit_of_the_scenes() {
    for golden in golden::all().expect("the goldens are in order") {
        let mut scene = golden.scene().expect("the scene is valid");
        // The plain transcription is slow.
        scene.camera.px_width = PixelCount::new(160).expect("positive");
        scene.camera.px_height = PixelCount::new(120).expect("positive");
        for (engine, plain) in [(&Classic as &dyn Engine, Plain::Classic), (&Direct, Plain::Direct)]
        {
            let film = rendered(&scene, engine, &RenderSettings::default()).film;
            let expected = plain::render(&scene, plain);
            assert_eq!(first_difference(film.pixels(), &expected), None, "{}", golden.name);
        }
    }
}

#[test]
fn the_shortcuts_change_no_bit_of_random_scenes() {
    for seed in 0..1_500 {
        let scene = random::scene(seed, [24, 18]);
        for (engine, plain) in [(&Classic as &dyn Engine, Plain::Classic), (&Direct, Plain::Direct)]
        {
            let film = rendered(&scene, engine, &RenderSettings::default()).film;
            let expected = plain::render(&scene, plain);
            let difference = first_difference(film.pixels(), &expected);
            assert_eq!(difference, None, "seed {seed}, {}\n{scene}", engine.name());
        }
    }
}

/// `classic` ends the glow where it is below 2^-50 of a code; the original never
/// does. No picture shows it.
#[test]
fn the_end_of_the_glow_cannot_be_seen() {
    for seed in 0..800 {
        let scene = random::scene(seed, [24, 18]);
        let mut film = rendered(&scene, &Classic, &RenderSettings::default()).film;
        let ours = encode(&film, Format::Png, Bits::Sixteen).expect("it encodes");
        let endless = plain::render(&scene, Plain::ClassicEndlessGlow);
        let window = film.window();
        film.put(window, &endless);
        film.set_frame_peak(lancer_film::Film::peak(&endless));
        let theirs = encode(&film, Format::Png, Bits::Sixteen).expect("it encodes");
        assert!(ours == theirs, "seed {seed}\n{scene}");
    }
}

#[test]
fn threads_change_nothing() {
    let scene = scene("mirror_corridor.xml", [123, 77]);
    let with = |threads| {
        let threads = NonZeroUsize::new(threads);
        rendered(&scene, &Classic, &RenderSettings { threads, ..RenderSettings::default() })
    };
    let one = with(1);
    for threads in [2, 3, 7, 16] {
        let other = with(threads);
        assert_eq!(first_difference(one.film.pixels(), other.film.pixels()), None);
        assert_eq!(one.film.frame_peak(), other.film.frame_peak());
        assert_eq!(one.counts, other.counts);
    }
}

/// A crop of a picture is the picture of a crop, brightness and all.
#[test]
fn crops_are_cut_from_the_same_picture() {
    let scene = scene("readme.xml", [160, 120]);
    let whole = rendered(&scene, &Classic, &RenderSettings::default()).film;
    assert!(whole.frame_peak() > Some(255.0), "otherwise this shows nothing");
    for window in [
        lancer_film::Window { x: 0, y: 0, width: 160, height: 120 },
        lancer_film::Window { x: 17, y: 33, width: 50, height: 19 },
        lancer_film::Window { x: 159, y: 119, width: 1, height: 1 },
    ] {
        let settings =
            RenderSettings { window: Some(window), frame_peak: true, ..RenderSettings::default() };
        let crop = rendered(&scene, &Classic, &settings).film;
        assert_eq!(crop.frame_peak(), whole.frame_peak());
        for y in window.y..window.y + window.height {
            for x in window.x..window.x + window.width {
                assert_eq!(crop.pixel(x, y), whole.pixel(x, y), "{x},{y} of {window}");
            }
        }
    }
}

#[test]
fn only_what_is_kept_is_rendered_if_that_is_enough() {
    let scene = scene("readme.xml", [160, 120]);
    let window = lancer_film::Window { x: 17, y: 33, width: 50, height: 19 };
    let settings = RenderSettings { window: Some(window), ..RenderSettings::default() };
    let crop = rendered(&scene, &Classic, &settings);
    assert_eq!(crop.counts.primary, window.pixels());
    assert_eq!(crop.film.frame_peak(), None);
}
