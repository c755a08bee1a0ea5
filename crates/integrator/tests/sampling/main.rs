//! Pictures whose right values are known, sampled.

mod painted;

use lancer_integrator::{Sampling, Strategy};
use painted::{coverage, picture, true_error};

fn asked(error: f64, seed: u64) -> Sampling {
    Sampling { error: Some(error), seed, ..Sampling::default() }
}

/// A half plane whose border is nearly upright.
fn half_plane(x: f64, y: f64) -> (f64, u64) {
    let is_in = x < 20.3 + 0.4 * y;
    (f64::from(u8::from(is_in)), u64::from(is_in))
}

/// A bar of that width, tilted by 7.3 degrees against the horizontal.
fn bar(width: f64) -> impl Fn(f64, f64) -> (f64, u64) + Sync {
    let slope = libm::tan(7.3_f64.to_radians());
    let high = width / libm::cos(7.3_f64.to_radians());
    move |x, y| {
        let is_in = (y - 40.0 - slope * x).abs() < high / 2.0;
        (f64::from(u8::from(is_in)), u64::from(is_in))
    }
}

#[test]
fn explore() {
    let right = coverage(64, |y| vec![[0.0, 20.3 + 0.4 * y]]);
    for strategy in Strategy::ALL {
        for error in [0.01, 0.003, 0.001, 0.0003] {
            if *strategy != Strategy::Edges && error < 0.003 {
                continue;
            }
            let sampling = Sampling { strategy: *strategy, ..asked(error, 1) };
            let rendered = picture(64, sampling, 1, half_plane);
            let accuracy = rendered.accuracy.expect("sampled");
            println!(
                "{} {error}: predicted {:.6}, true {:.6}, {} samples, {:?} {}",
                strategy.name(),
                accuracy.predicted,
                true_error(&rendered, &right),
                accuracy.samples,
                accuracy.stopped,
                accuracy.at
            );
        }
    }
    for width in [0.5, 0.1, 0.02] {
        let all = width / libm::cos(7.3_f64.to_radians()) / 128.0;
        let mut sum = 0.0;
        let mut samples = 0;
        for seed in 0..64 {
            let rendered = picture(128, asked(0.002, seed), 1, bar(width));
            let pixels = rendered.film.pixels();
            sum += pixels.iter().map(|p| f64::from(p[0])).sum::<f64>() / pixels.len() as f64;
            samples = rendered.accuracy.expect("sampled").samples;
        }
        println!("bar {width}: {:.4} of what is right, {samples}", sum / 64.0 / all);
    }
    let ball = |x: f64, y: f64| {
        let (u, v) = (x - x.floor() - 0.37, y - y.floor() - 0.61);
        let is_in = u * u + v * v < 0.0025;
        let number = if is_in { 1 + (x.floor() * 1000.0 + y.floor()) as u64 } else { 0 };
        (f64::from(u8::from(is_in)), number)
    };
    let mut sum = 0.0;
    for seed in 0..4 {
        let rendered = picture(128, asked(0.002, seed), 1, ball);
        let pixels = rendered.film.pixels();
        let mean = pixels.iter().map(|p| f64::from(p[0])).sum::<f64>() / pixels.len() as f64;
        let right = vec![std::f64::consts::PI * 0.0025; 128 * 128];
        sum += mean / right[0];
        let accuracy = rendered.accuracy.expect("sampled");
        println!("balls {:?} {} {}", accuracy, mean / right[0], true_error(&rendered, &right));
    }
    println!("balls: {}", sum / 4.0);
}
