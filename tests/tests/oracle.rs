//! The usual engine against the oracle: the radiance of some pixels of each scene, which
//! the one finds with doubles and by shortcuts, the other with exact decisions and many
//! digits, by its own formulas.

use lancer_integrator::{RenderSettings, Whitted, render};
use lancer_oracle::Tracer;
use lancer_scene::PixelCount;
use lancer_tests::golden;

const BITS: usize = 160;
const PIXELS: u32 = 24;

/// What the engine may leave out of a pixel.
const CUTOFF: f64 = 1e-8;

/// What the oracle may; more where glass splits rays without end.
const MISSING: f64 = 1e-3;

/// A pixel with a decision nearer than this is left out, and counted.
const UNSURE: f64 = 1e-9;

/// Half a unit in the last place of a film's numbers, and what doubles may lose.
const PRECISION: f64 = 5.960_464_477_539_063e-8 + 1e-9;

#[test]
fn whitted_sees_what_is_there() {
    let mut random = fastrand::Rng::with_seed(7);
    let (mut judged, mut unsure) = (0, 0);
    for golden in golden::all().unwrap_or_else(|problems| panic!("{}", problems[0])) {
        if golden.engine() != "whitted" {
            continue;
        }
        let mut scene = golden.scene().unwrap_or_else(|e| panic!("{e}"));
        let smaller = |side: PixelCount| PixelCount::new(side.get().div_ceil(8)).expect("above 0");
        if scene.camera.aperture.is_some() || scene.lights.iter().any(|l| l.radius().is_some()) {
            // Such pixels are integrals, which the oracle does not find.
            continue;
        }
        scene.camera.px_width = smaller(scene.camera.px_width);
        scene.camera.px_height = smaller(scene.camera.px_height);
        let engine = Whitted::with_cutoff(CUTOFF).expect("in range");
        let film = render(&scene, &engine, &RenderSettings::default());
        let film = film.unwrap_or_else(|e| panic!("{e}")).film;
        let tracer = Tracer::new(&scene, BITS, 1e-9, 200);
        // Where that does not follow all of a pixel's rays.
        let rougher = Tracer::new(&scene, BITS, 1e-4, 400);
        let (width, height) = (scene.camera.px_width.get(), scene.camera.px_height.get());
        for _ in 0..PIXELS {
            let (x, y) = (random.u32(0..width), random.u32(0..height));
            let mut truth = tracer.follow(x, y);
            if truth.missing > CUTOFF {
                truth = rougher.follow(x, y);
            }
            if truth.margin < UNSURE || truth.missing > MISSING {
                unsure += 1;
                continue;
            }
            judged += 1;
            let found = film.pixels()[(y * width + x) as usize];
            // Nothing in these scenes is brighter than this.
            let left_out = 4.0 * (truth.missing + CUTOFF);
            for (truth, found) in truth.radiance.to_f64().iter().zip(found) {
                let error = (truth - f64::from(found)).abs();
                let limit = truth * PRECISION + left_out;
                assert!(
                    error <= limit,
                    "{} at {x}, {y}: {found}, and not {truth}: {error:e} above {limit:e}",
                    golden.name
                );
            }
        }
    }
    println!("{judged} pixels judged, {unsure} left out");
    assert!(judged > 500 && unsure < judged / 8, "{judged} judged, {unsure} left out");
}
