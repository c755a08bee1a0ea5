//! The usual engine against the oracle, pixel by pixel.

use lancer_integrator::{RenderSettings, Whitted, render};
use lancer_oracle::Tracer;
use lancer_tests::golden;

#[test]
fn look() {
    let bits = 160;
    for golden in golden::all().unwrap_or_else(|problems| panic!("{}", problems[0])) {
        if golden.engine() != "whitted" {
            continue;
        }
        let scene = golden.scene().unwrap_or_else(|e| panic!("{e}"));
        let engine = Whitted::with_cutoff(1e-9).expect("in range");
        let start = std::time::Instant::now();
        let film = render(&scene, &engine, &RenderSettings::default())
            .unwrap_or_else(|e| panic!("{e}"))
            .film;
        let t_render = start.elapsed();
        let tracer = Tracer::new(&scene, bits, 1e-9, 60);
        let (w, h) = (scene.camera.px_width.get(), scene.camera.px_height.get());
        let mut rng = fastrand::Rng::with_seed(7);
        let start = std::time::Instant::now();
        let (mut n, mut unsure, mut bad, mut worst) = (0, 0, 0, 0.0_f64);
        while n < 200 && start.elapsed().as_secs_f64() < 3.0 {
            n += 1;
            let (x, y) = (rng.u32(0..w), rng.u32(0..h));
            let pixel = tracer.follow(x, y);
            let truth = pixel.radiance.to_f64();
            let found = film.pixels()[(y * w + x) as usize];
            let error = truth
                .iter()
                .zip(found)
                .map(|(t, f)| (t - f64::from(f)).abs() / t.abs().max(1e-6))
                .fold(0.0, f64::max);
            if pixel.margin < 1e-9 {
                unsure += 1;
                if error > 1e-6 && std::env::var("SHOW").is_ok() {
                    println!("   unsure {x} {y}: {truth:?} {found:?} {:e}", pixel.margin);
                }
                continue;
            }
            worst = worst.max(error);
            if error > 2e-7 {
                bad += 1;
                if bad < 6 {
                    println!(
                        "   {x} {y}: {truth:?} {found:?} margin {:e} missing {:e}",
                        pixel.margin, pixel.missing
                    );
                }
            }
        }
        println!(
            "{}: {n} pixels in {:?} (render {:?}), {unsure} unsure, {bad} bad, worst {worst:e}",
            golden.name(),
            start.elapsed(),
            t_render
        );
    }
}
