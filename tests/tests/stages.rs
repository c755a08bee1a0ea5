//! `whitted` computes for a whole tile at once what it computes for each pixel
//! alone, to the last bit, and follows the same rays.

use lancer_film::Window;
use lancer_integrator::{
    Culling, Engine, KernelSettings, Plan, RayCounts, Rgb, TILE_SIDE, Tracer, Whitted, Width,
};
use lancer_scene::{PixelCount, Scene};
use lancer_tests::golden;
use lancer_tests::random;

/// NaNs do not occur: such pixels are black.
fn bits(pixels: &[Rgb]) -> Vec<[u32; 3]> {
    pixels.iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

fn alone(tracer: &dyn Tracer, window: Window) -> (Vec<Rgb>, RayCounts) {
    let mut counts = RayCounts::default();
    let places = (0..window.height).flat_map(|y| (0..window.width).map(move |x| (x, y)));
    let pixels =
        places.map(|(x, y)| tracer.pixel(window.x + x, window.y + y, &mut counts)).collect();
    (pixels, counts)
}

fn together(tracer: &dyn Tracer, window: Window) -> (Vec<Rgb>, RayCounts) {
    let mut counts = RayCounts::default();
    let mut pixels = vec![[0.0; 3]; window.pixels() as usize];
    tracer.tile(window, &mut pixels, &mut counts);
    (pixels, counts)
}

/// Compares all tiles of a frame.
fn check(name: &str, scene: &Scene, settings: &[KernelSettings]) {
    let engine = Whitted::new();
    let (width, height) = (scene.camera.px_width.get(), scene.camera.px_height.get());
    let scalar = KernelSettings { lanes: Width::SCALAR, ..KernelSettings::default() };
    let reference = engine.prepare(scene, &Plan::full(&scalar));
    let tracers: Vec<_> =
        settings.iter().map(|settings| engine.prepare(scene, &Plan::full(settings))).collect();
    let frame = lancer_film::Size::new(width, height).window();
    for window in frame.strips(TILE_SIDE, TILE_SIDE) {
        let (expected, counts) = alone(&*reference, window);
        for (tracer, settings) in tracers.iter().zip(settings) {
            let (found, found_counts) = together(&**tracer, window);
            assert_eq!(bits(&expected), bits(&found), "{name} {window:?} {settings:?}");
            assert_eq!(counts, found_counts, "{name} {window:?} {settings:?}");
        }
    }
}

fn all_widths() -> Vec<KernelSettings> {
    let widths = Width::available().into_iter();
    widths.map(|lanes| KernelSettings { lanes, ..KernelSettings::default() }).collect()
}

fn small(mut scene: Scene, [width, height]: [u32; 2]) -> Scene {
    scene.camera.px_width = PixelCount::new(width).expect("positive");
    scene.camera.px_height = PixelCount::new(height).expect("positive");
    scene
}

#[test]
fn the_scenes_that_people_read() {
    for golden in golden::all().expect("the settings are valid") {
        if golden.engine() == "whitted" {
            let scene = golden.scene().expect("the scene is valid");
            check(&golden.name, &small(scene, [112, 84]), &all_widths());
        }
    }
}

#[test]
fn windows_may_have_any_size() {
    let scene = random::scene(3, [90, 70]);
    let engine = Whitted::new();
    let tracer = engine.prepare(&scene, &Plan::default());
    for (width, height) in [(41, 35), (1, 40), (70, 1), (16, 17), (3, 5)] {
        let window = Window { x: 3, y: 2, width, height };
        let (expected, found) = (alone(&*tracer, window), together(&*tracer, window));
        assert_eq!((bits(&expected.0), expected.1), (bits(&found.0), found.1), "{window:?}");
    }
}

#[test]
fn random_scenes() {
    for seed in 0..24 {
        check(&format!("seed {seed}"), &random::scene(seed, [19, 17]), &all_widths());
    }
}

#[test]
fn nothing_that_is_left_out_matters() {
    let without = Culling::without_each().into_iter().map(|(_, culling)| culling);
    let settings: Vec<_> = without
        .chain([Culling::NONE])
        .map(|culling| KernelSettings { culling, ..KernelSettings::default() })
        .collect();
    for seed in 150..158 {
        check(&format!("seed {seed}"), &random::scene(seed, [19, 17]), &settings);
    }
}
