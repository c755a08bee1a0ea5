//! `classic` and `direct` compute what the original computes.

use lancer_integrator::{Classic, Culling, Direct, Engine, KernelSettings, RenderSettings};
use lancer_integrator::{Rendered, Width, render};
use lancer_output::{Bits, Format, compare, decode, encode};
use lancer_scene::{Geometry, Light, PixelCount, Scene};
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
        if !["classic", "direct"].contains(&golden.engine()) {
            continue;
        }
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

/// Everything that may be chosen of how rays are followed, with a name.
fn ways_to_follow() -> Vec<(String, KernelSettings)> {
    let mut ways = Vec::new();
    for lanes in Width::available() {
        let name = |culling: &str| format!("{}, {culling}", lanes.name());
        let settings = |culling| KernelSettings { lanes, culling };
        ways.push((name("all culling"), settings(Culling::ALL)));
        ways.push((name("no culling"), settings(Culling::NONE)));
    }
    for (name, culling) in Culling::without_each() {
        ways.push((format!("without {name}"), KernelSettings { culling, ..Default::default() }));
    }
    ways
}

/// The same film and the same counts of rays, whatever the lanes and with each
/// shortcut off.
fn assert_all_ways_agree(scene: &Scene, engine: &dyn Engine, plain: Plain, name: &str) {
    let expected = plain::render(scene, plain);
    let mut counts = None;
    for (way, kernel) in ways_to_follow() {
        let settings = RenderSettings { kernel, ..RenderSettings::default() };
        let Rendered { film, counts: found, .. } = rendered(scene, engine, &settings);
        let difference = first_difference(film.pixels(), &expected);
        assert_eq!(difference, None, "{name}, {}, {way}", engine.name());
        assert_eq!(*counts.get_or_insert(found), found, "{name}, {}, {way}", engine.name());
    }
}

#[test]
fn lanes_and_culling_change_no_bit_and_no_count() {
    let readme = scene("readme.xml", [200, 150]);
    assert_all_ways_agree(&readme, &Classic, Plain::Classic, "readme");
    assert_all_ways_agree(&readme, &Direct, Plain::Direct, "readme");
    let corridor = scene("mirror_corridor.xml", [67, 45]);
    assert_all_ways_agree(&corridor, &Classic, Plain::Classic, "corridor");
    for seed in 0..250 {
        let scene = random::scene(seed, [24, 18]);
        assert_all_ways_agree(&scene, &Classic, Plain::Classic, &format!("seed {seed}"));
    }
    for seed in 250..300 {
        let scene = random::scene(seed, [24, 18]);
        assert_all_ways_agree(&scene, &Direct, Plain::Direct, &format!("seed {seed}"));
    }
}

/// So many small spheres that tiles meet most of them nowhere, and bundles of
/// mirrored rays are small and go everywhere; as large or as small as numbers
/// allow, too.
#[test]
fn many_spheres_are_culled_without_a_trace() {
    for (seed, size) in [(1, 1.0), (2, 1e60), (3, 1e-60), (4, 1.0)] {
        let scene = random::crowd(seed, [40, 30], 150, size);
        assert_all_ways_agree(&scene, &Classic, Plain::Classic, &format!("crowd {seed}"));
    }
}

/// Whether a lamp is so near a plane that rounding alone decides from where it
/// is hidden.
fn a_lamp_touches_a_plane(scene: &Scene) -> bool {
    let lamps = scene.lights.iter().filter_map(|light| match light {
        Light::Lamp { point, .. } => Some(point.get()),
        _ => None,
    });
    let planes = scene.shapes.iter().filter_map(|shape| match &shape.geometry {
        Geometry::Plane(plane) => Some(*plane),
        _ => None,
    });
    let planes: Vec<_> = planes.collect();
    lamps.into_iter().any(|lamp| {
        planes.iter().any(|plane| {
            let normal = plane.normal.get().normalize();
            (lamp - plane.origin.get()).dot(&normal).abs() < 1e-6
        })
    })
}

/// The arithmetic that `classic` has defined for itself shows in next to no
/// pixel: random scenes with it and as the original's description has it.
#[test]
fn the_arithmetic_is_the_originals_but_for_rounding() {
    let (mut pixels, mut differing) = (0, 0);
    for seed in 0..1_500 {
        let scene = random::scene(seed, [24, 18]);
        if a_lamp_touches_a_plane(&scene) {
            continue;
        }
        let mut film = rendered(&scene, &Classic, &RenderSettings::default()).film;
        let picture =
            |film: &lancer_film::Film| encode(film, Format::Ppm, Bits::Eight).expect("it encodes");
        let ours = decode(&picture(&film)).expect("it decodes");
        let original = plain::render(&scene, Plain::Original);
        let window = film.window();
        film.put(window, &original);
        film.set_frame_peak(lancer_film::Film::peak(&original));
        let theirs = decode(&picture(&film)).expect("it decodes");
        let comparison = compare(&ours, &theirs).expect("same size");
        pixels += comparison.pixels;
        differing += comparison.differing;
    }
    assert!(pixels > 300_000, "too few scenes are left: {pixels} pixels");
    // At the time of writing none; a new seed may well find one.
    assert!(differing * 100_000 <= pixels, "{differing} of {pixels} pixels differ");
}

/// A sum of glows is added up light by light: with other brackets the last
/// place of this one is another.
#[test]
fn glows_are_added_one_by_one() {
    let tiny = 0.5 * f64::EPSILON;
    let mut builder = Scene::builder()
        .camera(lancer_scene::Camera::new([0.0; 3], [0.0, 1.0, 0.0], 1.0, [3, 2]))
        .light(Light::sun([0.0, -1.0, 0.0], 1.0 + f64::from(f32::EPSILON) / 2.0));
    for _ in 0..2 {
        builder = builder.light(Light::lamp([0.0, 4.0, 0.0], tiny));
    }
    let scene = builder.build().expect("valid");
    let film = rendered(&scene, &Classic, &RenderSettings::default()).film;
    let expected = plain::render(&scene, Plain::Classic);
    assert_eq!(first_difference(film.pixels(), &expected), None);
    assert_eq!(film.pixel(1, 1), [255.0; 3], "two tiny ones change nothing, one after another");
}

/// The plane that the eye lies in wins over a sphere behind it, though the
/// squares of the plane's slope and height are too small for numbers.
#[test]
fn a_hit_at_no_distance_is_the_nearest() {
    let mirror = lancer_scene::Surface::new(lancer_scene::Colour::GREY).gloss(1.0);
    let plane = |colour| {
        let surface = lancer_scene::Surface::new(colour);
        lancer_scene::Shape::plane([0.0; 3], [0.0, 0.0, 1.0], surface)
    };
    let sphere = || lancer_scene::Shape::sphere([0.0, 5.0, 0.0], 1.0, mirror.clone());
    for tilt in [1e-100, 1e-154, 1e-170, 1e-300, 5e-324] {
        let scene = Scene::builder()
            .camera(lancer_scene::Camera::new([0.0; 3], [0.0, 1.0, -tilt], 1.0, [4, 4]))
            .light(Light::lamp([0.0, 0.0, 1.0], 1.0))
            .shape(sphere())
            .shape(plane(lancer_scene::Colour::RED))
            .build()
            .expect("valid");
        let film = rendered(&scene, &Classic, &RenderSettings::default()).film;
        let expected = plain::render(&scene, Plain::Classic);
        assert_eq!(first_difference(film.pixels(), &expected), None, "tilt {tilt}");
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
            RenderSettings { window: Some(window), for_display: true, ..RenderSettings::default() };
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
