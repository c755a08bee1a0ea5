//! What a plan leaves out changes no bit of the picture, or no more than it says: for the scenes of the
//! project and for random ones. `LANCER_SCENES=N` tries so many of these.

use fastrand::Rng;
use lancer_film::Film;
use lancer_integrator::{Reason, RenderSettings, Sampling, Whitted, render};
use lancer_scene::{
    Camera, Colour, Exposure, InvalidField, Light, PixelCount, Scene, Shape, Spectrum, Stops,
    Surface,
};
use lancer_tests::golden;

/// As planned, and with nothing left out; and by how much pixels may differ.
fn both(scene: &Scene, sampling: Option<Sampling>, exposure: Option<Exposure>) -> ([Film; 2], f64) {
    let settings = RenderSettings { sampling, exposure, ..RenderSettings::default() };
    let engine = Whitted::default();
    let films = [false, true].map(|full_model| {
        let settings = RenderSettings { full_model, ..settings };
        render(scene, &engine, &settings).expect("it is rendered").film
    });
    (films, settings.plan(scene, &engine).most())
}

fn check(name: &str, scene: &Scene, sampling: Option<Sampling>, exposure: Option<Exposure>) -> f64 {
    let ([planned, full], most) = both(scene, sampling, exposure);
    let factor = planned.stops().map_or(1.0, lancer_film::exposure_factor);
    if most == 0.0 {
        let same = planned.pixels().iter().flatten().zip(full.pixels().iter().flatten());
        assert!(same.into_iter().all(|(a, b)| a.to_bits() == b.to_bits()), "{name}");
        return 0.0;
    }
    let off = planned.pixels().iter().flatten().zip(full.pixels().iter().flatten());
    let worst = off.map(|(a, b)| f64::from((a - b).abs()) * factor).fold(0.0, f64::max);
    // Singles round by a part in 10^7 of what they are.
    let rounding = 1e-6 * f64::from(Film::peak(full.pixels())) * factor;
    assert!(worst <= most + rounding, "{name}: {worst} of {most}");
    worst
}

fn small(mut scene: Scene, [width, height]: [u32; 2]) -> Scene {
    let side = |own: PixelCount, most| PixelCount::new(own.get().min(most)).expect("it is above 0");
    scene.camera.px_width = side(scene.camera.px_width, width);
    scene.camera.px_height = side(scene.camera.px_height, height);
    scene
}

#[test]
fn the_scenes_of_the_project_are_the_same_with_nothing_left_out() {
    let goldens = golden::all().unwrap_or_else(|problems| panic!("{}", problems[0]));
    let mut seen = Vec::new();
    for golden in goldens {
        let name = golden.scene_name();
        if golden.engine() != "whitted" || seen.contains(&name) {
            continue;
        }
        let scene = golden.scene().unwrap_or_else(|e| panic!("{e}"));
        check(&name, &small(scene, [48, 36]), None, None);
        seen.push(name);
    }
    assert!(seen.len() > 10, "{seen:?}");
}

/// Shapes on and below a floor, of all looks, and lights above, below, far away and without light.
fn random(rng: &mut Rng) -> Scene {
    let mut number = |from: f64, to: f64| from + (to - from) * rng.f64();
    let camera =
        Camera::new([0.0, -7.0, number(0.5, 4.0)], [0.0, -6.0, number(0.5, 3.0)], 1.2, [40, 30]);
    let camera = match rng.u8(0..6) {
        0 => camera.and_then(|camera| camera.orthographic(5.0)),
        1 => camera.and_then(|camera| camera.aperture(0.5)),
        _ => camera,
    };
    let mut scene = Scene::builder().camera(camera);
    let surface = |rng: &mut Rng| -> Result<Surface, InvalidField> {
        let colour = Surface::new([Colour::WHITE, Colour::RED, Colour::GREY][rng.usize(0..3)]);
        match rng.u8(0..20) {
            0 | 1 => colour.gloss([0.1, 0.6, 1.0][rng.usize(0..3)]),
            4 | 5 => Surface::glass(1.5),
            6..9 => Ok(colour.checker(Colour::BLUE)),
            9..12 => colour.emission([0.5, 0.1, 0.0]),
            _ => Ok(colour),
        }
    };
    if rng.u8(0..8) > 0 {
        let look = if rng.bool() { Ok(Surface::new(Colour::WHITE)) } else { surface(rng) };
        scene = scene.shape(Shape::plane([0.0; 3], [0.0, 0.0, 1.0], look));
    }
    // Now and then a flat mirror, across the view.
    if rng.u8(0..4) == 0 {
        let side = rng.f64() * 6.0 - 3.0;
        let sides = [[2.0, side, 0.0], [0.0, rng.f64() - 0.5, 2.0]];
        let look = Surface::new(Colour::WHITE).gloss(0.7);
        scene = scene.shape(Shape::rectangle([-1.0, 3.0, 0.5], sides, look));
    }
    let mut places = Vec::new();
    for number in 0..rng.usize(1..9) {
        // From the fourth on also behind the eye and beside the view.
        let (wide, back) = if number < 4 { (6.0, 1.0) } else { (20.0, 14.0) };
        let at = [(rng.f64() - 0.5) * wide, rng.f64() * (5.0 + back) - back, rng.f64() * 4.0 - 1.0];
        let (size, look) = (0.2 + rng.f64(), surface(rng));
        places.push(at);
        scene = scene.shape(match rng.u8(0..3) {
            0 => Shape::cube(at, size, look),
            1 => Shape::torus(at, [0.2, 0.1, 1.0], [size, 0.3 * size], look),
            _ => Shape::sphere(at, size, look),
        });
    }
    for _ in 0..rng.usize(1..7) {
        let height = rng.f64() * 12.0 - 5.0;
        let at = [rng.f64() * 8.0 - 4.0, rng.f64() * 8.0 - 6.0, height];
        let brightness = [0.0, 1e-5, 1e-4, 2.0, 9.0][rng.usize(0..5)];
        let light = match rng.u8(0..5) {
            0 => Light::sun([0.3, 0.4, rng.f64() * 2.0 - 1.0], 0.1 * brightness),
            1 => Light::lamp(at, brightness).and_then(|lamp| lamp.with_radius(0.3)),
            2 => {
                let anywhere = [rng.f64() - 0.5, rng.f64() - 0.5, rng.f64() - 0.7];
                let place = places[rng.usize(0..places.len())];
                let straight = [0, 1, 2].map(|i| place[i] - at[i]);
                let axis = if rng.bool() { straight } else { anywhere };
                let beam = [[20.0, 40.0], [3.0, 8.0]][rng.usize(0..2)];
                Light::spot(at, axis, beam, brightness)
            }
            3 => Light::lamp(at, 0.1 * brightness).map(Light::without_falloff),
            _ => Light::lamp(at, brightness),
        };
        scene = scene.light(light);
    }
    let mut scene = scene.build().expect("valid");
    scene.background = Spectrum::new([0.01, 0.02, 0.03]).expect("in range");
    scene
}

#[test]
fn random_scenes_are_the_same_with_nothing_left_out() {
    let count = std::env::var("LANCER_SCENES").ok().and_then(|n| n.parse().ok()).unwrap_or(60);
    let stops = Some(Exposure::Stops(Stops::default()));
    let (mut fewer, mut dim, mut aside, mut absent) = (0, 0, 0, 0);
    for number in 0..count {
        let scene = random(&mut Rng::with_seed(number));
        let name = format!("scene {number}");
        check(&name, &scene, None, None);
        // One sample, with an error for which dim lights are left out.
        let sampling = Sampling { samples: Some(1), error: Some(0.01), ..Sampling::default() };
        check(&name, &scene, Some(sampling), stops);
        let settings =
            RenderSettings { sampling: Some(sampling), exposure: stops, ..Default::default() };
        let plan = settings.plan(&scene, &Whitted::default());
        fewer += u64::from(plan.dropped.iter().any(|dropped| dropped.most == 0.0));
        dim += u64::from(plan.most() > 0.0);
        aside += u64::from(plan.dropped.iter().any(|dropped| dropped.why == Reason::Aside));
        absent += u64::from(plan.absent.shapes().next().is_some());
        // As many samples as an error takes, which what is seen decides.
        if number % 8 == 0 {
            let sampling = Sampling { error: Some(0.02), ..Sampling::default() };
            check(&name, &scene, Some(sampling), None);
        }
    }
    let counts = format!("{fewer}, {dim}, {aside} and {absent} of {count}");
    assert!(fewer > count / 4 && dim > count / 8, "{counts}");
    assert!(aside > count / 40 && absent > count / 4, "{counts}");
}
