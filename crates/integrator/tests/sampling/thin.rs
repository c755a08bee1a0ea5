//! What is thinner than a pixel: its light is right in the mean.

use crate::asked;
use crate::painted::picture;
use lancer_integrator::Why;

/// The mean over seeds of the light of a picture of so many pixels along each side.
fn light(side: u32, error: f64, seeds: u64, see: impl Fn(f64, f64) -> (f64, u64) + Sync) -> f64 {
    let mut sum = 0.0;
    for seed in 0..seeds {
        let rendered = picture(side, asked(error, seed), 2, &see);
        let pixels = rendered.film.pixels();
        sum += pixels.iter().map(|p| f64::from(p[0])).sum::<f64>() / pixels.len() as f64;
    }
    sum / seeds as f64
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
fn a1_a_bar_a_tenth_of_a_pixel_wide() {
    for width in [0.5, 0.1] {
        let right = width / libm::cos(7.3_f64.to_radians()) / 128.0;
        let share = light(128, 0.002, 64, bar(width)) / right;
        assert!((share - 1.0).abs() < 0.01, "{width}: {share}");
    }
}

#[test]
fn a1_balls_a_tenth_of_a_pixel_wide_and_one_pixel_apart() {
    let ball = |x: f64, y: f64| {
        let (u, v) = (x - x.floor() - 0.37, y - y.floor() - 0.61);
        let is_in = u * u + v * v < 0.0025;
        let number = if is_in { 1 + (x.floor() * 1000.0 + y.floor()) as u64 } else { 0 };
        (f64::from(u8::from(is_in)), number)
    };
    // As many pixels as 64 pictures of 16 x 16 in the largest one.
    let share = light(64, 0.002, 4, ball) / (std::f64::consts::PI * 0.0025);
    assert!((share - 1.0).abs() < 0.01, "{share}");
}

/// What is around a thing that one sample alone has found is looked through; then there is
/// nothing more to be feared of it, however little error is asked for.
#[test]
fn a_thing_found_alone_does_not_keep_a_picture_from_its_end() {
    let ball = |x: f64, y: f64| {
        let is_in = (x - 23.4) * (x - 23.4) + (y - 40.6) * (y - 40.6) < 0.09;
        (f64::from(u8::from(is_in)), u64::from(is_in))
    };
    let mut found = 0;
    for seed in 0..16 {
        let rendered = picture(64, asked(0.0001, seed), 2, ball);
        let accuracy = rendered.accuracy.expect("sampled");
        assert_eq!(accuracy.stopped, Why::Error);
        if accuracy.samples > 64 * 64 {
            found += 1;
            let sum: f32 = rendered.film.pixels().iter().map(|pixel| pixel[0]).sum();
            assert!((f64::from(sum) / (std::f64::consts::PI * 0.09) - 1.0).abs() < 0.05, "{sum}");
        }
    }
    assert!(found > 0);
}

/// Every pixel is covered by that part, somewhere: whether some samples happen to agree must not
/// matter (Kirk and Arvo's bias).
#[test]
fn a2_stopping_where_samples_agree_does_not_darken() {
    for part in [0.05, 0.1, 0.25, 0.5] {
        for error in [0.05, 0.02] {
            let strip = |x: f64, y: f64| {
                let row = libm::sin(y.floor() * 12.9898) * 43_758.545_3;
                let from = (row - row.floor()) * (1.0 - part);
                let is_in = (from..from + part).contains(&(x - x.floor()));
                (f64::from(u8::from(is_in)), u64::from(is_in))
            };
            let share = light(32, error, 12, strip) / part;
            assert!((share - 1.0).abs() < 0.05, "{part} at {error}: {share}");
        }
    }
}
