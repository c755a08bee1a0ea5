//! `whitted` sees at a place of the picture what it sees there alone, whatever else is seen
//! together with it, and at a pixel's centre what it shows there.

use lancer_film::{Size, Window};
use lancer_integrator::{
    Culling, Engine, KernelSettings, MOST_SAMPLES, Plan, RayCounts, Sample, Sampler, Seen, Stream,
    TILE_SIDE, Whitted, Width,
};
use lancer_scene::{PixelCount, Scene};
use lancer_tests::{golden, random};

fn all_widths() -> Vec<KernelSettings> {
    let widths = Width::available().into_iter();
    let mut all: Vec<_> =
        widths.map(|lanes| KernelSettings { lanes, ..KernelSettings::default() }).collect();
    // Without this, more shadows are looked for.
    let culling = Culling { full_mirrors: true, ..Culling::NONE };
    all.push(KernelSettings { culling, ..KernelSettings::default() });
    all
}

fn small(mut scene: Scene, [width, height]: [u32; 2]) -> Scene {
    scene.camera.px_width = PixelCount::new(width).expect("positive");
    scene.camera.px_height = PixelCount::new(height).expect("positive");
    scene
}

fn bits(seen: &Seen) -> ([u32; 3], u64) {
    (seen.radiance.map(f32::to_bits), seen.signature)
}

fn together(sampler: &dyn Sampler, samples: &[Sample]) -> (Vec<Seen>, RayCounts) {
    let mut counts = RayCounts::default();
    let mut seen = vec![Seen::default(); samples.len()];
    sampler.see(samples, &mut seen, &mut counts);
    (seen, counts)
}

fn alone(sampler: &dyn Sampler, samples: &[Sample]) -> (Vec<Seen>, RayCounts) {
    let mut counts = RayCounts::default();
    let seen = samples.iter().map(|sample| sampler.see_alone(sample, &mut counts)).collect();
    (seen, counts)
}

/// Samples at random places of a window: several for some of its pixels, in no order.
fn scattered(window: Window, count: usize, rng: &mut fastrand::Rng) -> Vec<Sample> {
    let mut pixel = (0, 0);
    let mut samples: Vec<_> = (0..count as u32)
        .map(|index| {
            if index % 4 == 0 {
                pixel = (window.x + rng.u32(0..window.width), window.y + rng.u32(0..window.height));
            }
            Sample::new(pixel, Stream::new(3, pixel, 0, index))
        })
        .collect();
    rng.shuffle(&mut samples);
    samples
}

fn compare(
    name: &str,
    samples: &[Sample],
    expected: &(Vec<Seen>, RayCounts),
    found: &(Vec<Seen>, RayCounts),
) {
    for ((sample, expected), found) in samples.iter().zip(&expected.0).zip(&found.0) {
        assert_eq!(bits(expected), bits(found), "{name} {sample:?}");
    }
    assert_eq!(expected.1, found.1, "{name}");
}

fn check(name: &str, scene: &Scene) {
    let engine = Whitted::new();
    let scalar = KernelSettings { lanes: Width::SCALAR, ..KernelSettings::default() };
    let reference = engine.prepare(scene, &Plan::full(&scalar));
    let reference = reference.sampler().expect("whitted sees samples");
    let settings = all_widths();
    let tracers: Vec<_> =
        settings.iter().map(|settings| engine.prepare(scene, &Plan::full(settings))).collect();
    let frame = Size::new(scene.camera.px_width.get(), scene.camera.px_height.get()).window();
    let mut rng = fastrand::Rng::with_seed(1);
    for window in frame.strips(TILE_SIDE, TILE_SIDE) {
        let pixels = (window.y..window.y + window.height)
            .flat_map(|y| (window.x..window.x + window.width).map(move |x| (x, y)));
        let centres: Vec<_> =
            pixels.map(|pixel| Sample::at_centre(pixel, Stream::new(0, pixel, 0, 0))).collect();
        let expected_centres = alone(reference, &centres);
        let count = [1, 3, 17, 64, MOST_SAMPLES][rng.usize(0..5)];
        let some = scattered(window, count, &mut rng);
        let expected_some = alone(reference, &some);
        // From all over the picture.
        let far = scattered(frame, rng.usize(1..40), &mut rng);
        let expected_far = alone(reference, &far);
        for (tracer, settings) in tracers.iter().zip(&settings) {
            let name = format!("{name} {window:?} {settings:?}");
            let sampler = tracer.sampler().expect("whitted sees samples");
            let found = together(sampler, &centres);
            compare(&name, &centres, &expected_centres, &found);
            compare(&name, &some, &expected_some, &together(sampler, &some));
            compare(&name, &far, &expected_far, &together(sampler, &far));

            let mut counts = RayCounts::default();
            let mut pixels = vec![[0.0; 3]; window.pixels() as usize];
            tracer.tile(window, &mut pixels, &mut counts);
            let seen: Vec<_> = found.0.iter().map(|seen| seen.radiance).collect();
            assert_eq!((pixels, counts), (seen, found.1), "{name}");
        }
    }
}

#[test]
fn the_scenes_that_people_read() {
    for golden in golden::all().expect("the settings are valid") {
        if golden.engine() == "whitted" {
            let scene = golden.scene().expect("the scene is valid");
            check(&golden.name, &small(scene, [64, 48]));
        }
    }
}

/// The same with lamps that are balls, and a camera with a lens.
fn blurred(mut scene: Scene, seed: u64) -> Scene {
    let mut rng = fastrand::Rng::with_seed(seed);
    for light in &mut scene.lights {
        let radius = [0.0, 1e-3, 0.3, 2.0][rng.usize(0..4)];
        *light = light.with_radius(radius).expect("at least 0");
    }
    if rng.u8(0..3) > 0 {
        scene.camera = scene.camera.aperture(0.4 * rng.f64()).expect("at least 0");
    }
    scene
}

/// With every width of lanes and with nothing left out by proof.
#[test]
fn lamps_and_lenses() {
    for (seed, golden) in (0..).zip(golden::all().expect("the settings are valid")) {
        if golden.engine() == "whitted" {
            let scene = golden.scene().expect("the scene is valid");
            check(&golden.name, &blurred(small(scene, [32, 24]), seed));
        }
    }
    for seed in 0..24 {
        let scene = blurred(random::scene(seed, [19, 17]), seed);
        check(&format!("seed {seed}"), &scene);
    }
}

#[test]
fn random_scenes() {
    for seed in 0..12 {
        check(&format!("seed {seed}"), &random::scene(seed, [19, 17]));
    }
}

/// More at once than travel together, and none.
#[test]
fn any_number_of_samples() {
    let scene = random::scene(3, [90, 70]);
    let engine = Whitted::new();
    let tracer = engine.prepare(&scene, &Plan::default());
    let sampler = tracer.sampler().expect("whitted sees samples");
    let window = Window { x: 3, y: 2, width: 40, height: 40 };
    for count in [0, 2 * MOST_SAMPLES + 5] {
        let samples = scattered(window, count, &mut fastrand::Rng::with_seed(2));
        compare("many", &samples, &alone(sampler, &samples), &together(sampler, &samples));
    }
}
