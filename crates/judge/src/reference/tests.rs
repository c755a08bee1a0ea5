//! References of pictures that are known in closed form.

use super::*;
use std::sync::atomic::AtomicU64;

/// What is seen at a place of the picture, and by the numbers for the lens.
struct Known<F: Fn([f64; 2], [f64; 2]) -> f64 + Sync> {
    value: F,
    seen: AtomicU64,
}

impl<F: Fn([f64; 2], [f64; 2]) -> f64 + Sync> Known<F> {
    fn new(value: F) -> Self {
        Self { value, seen: AtomicU64::new(0) }
    }
}

impl<F: Fn([f64; 2], [f64; 2]) -> f64 + Sync> Sampler for Known<F> {
    fn see(&self, samples: &[Sample], seen: &mut [Seen], _: &mut RayCounts) {
        assert!(samples.len() <= MOST_SAMPLES && samples.len() == seen.len());
        self.seen.fetch_add(samples.len() as u64, Ordering::Relaxed);
        for (sample, seen) in samples.iter().zip(seen) {
            let [x, y] = sample.place;
            let (column, row) = sample.pixel;
            assert!((f64::from(column)..f64::from(column + 1)).contains(&x));
            assert!((f64::from(row)..f64::from(row + 1)).contains(&y));
            let value = (self.value)(sample.place, sample.stream.pair(1)) as f32;
            seen.radiance = [value, 0.5 * value, 0.0];
        }
    }

    fn see_alone(&self, sample: &Sample, counts: &mut RayCounts) -> Seen {
        let mut seen = [Seen::default()];
        self.see(&[*sample], &mut seen, counts);
        seen[0]
    }
}

fn settings(width: u32, height: u32, error: f64) -> ReferenceSettings<'static> {
    ReferenceSettings {
        size: Size::new(width, height),
        factor: 1.0,
        error,
        affords: &|| 1 << 20,
        seed: 1,
        cancel: None,
    }
}

/// The picture with those means of the first channel.
fn truth(size: Size, mean: impl Fn(f64, f64) -> f64) -> Picture {
    let places = (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y)));
    let pixels = places.map(|(x, y)| {
        let mean = mean(f64::from(x), f64::from(y));
        [mean, 0.5 * mean, 0.0]
    });
    Picture::new(size, pixels, 1.0).expect("one for each pixel")
}

/// The antiderivative of the area below the line y = slope x + start within a unit square.
fn below(slope: f64, start: f64) -> f64 {
    // By many thin columns, each exactly: the integral of the height, clipped to the square.
    let columns = 100_000;
    let height = |i: i32| slope * ((f64::from(i) + 0.5) / f64::from(columns)) + start;
    (0..columns).map(|i| height(i).clamp(0.0, 1.0)).sum::<f64>() / f64::from(columns)
}

/// A half plane with a slanted edge. What the reference says of its own error is right, and it
/// is as small as was asked for.
#[test]
fn the_coverage_of_an_edge_and_the_error_of_it() {
    let (slope, start) = (0.37, 2.2);
    let edge = Known::new(|[x, y]: [f64; 2], _| f64::from(y < slope * x + start));
    for asked in [0.0005, 0.0002, 0.0001] {
        let settings = settings(24, 16, asked);
        let found = reference(&edge, &settings).expect("it is not cancelled");
        let truth = truth(settings.size, |x, y| below(slope, slope * x + start - y));
        let error = found.picture.error(&truth).expect("one size");
        assert!(found.error <= asked, "{found:?}");
        // 24 pixels have an edge: their errors' sum of squares is off by a third, or so.
        let ratio = error / found.error;
        assert!((0.6..1.6).contains(&ratio), "{asked}: {error} {}", found.error);
    }
}

/// The mean of many is right where each is wrong, so there is no bias: with few samples, over
/// many seeds.
#[test]
fn it_has_no_bias() {
    let edge = Known::new(|[x, y]: [f64; 2], _| f64::from(y < 0.37 * x + 0.2));
    let mut sum = 0.0;
    let seeds = 400;
    for seed in 0..seeds {
        let settings = ReferenceSettings { seed, affords: &|| 0, ..settings(4, 2, 0.0) };
        let found = reference(&edge, &settings).expect("it is not cancelled");
        assert_eq!(found.samples, 512);
        sum += found.picture.mean();
    }
    let size = Size::new(4, 2);
    let truth = truth(size, |x, y| below(0.37, 0.37 * x + 0.2 - y)).mean();
    let mean = sum / seeds as f64;
    assert!((mean - truth).abs() < 2e-4, "{mean} {truth}");
}

/// Light that depends on the numbers for the lens as well: a pixel is an integral over both.
#[test]
fn other_dimensions_are_integrated_too() {
    let blurred = Known::new(|[x, _]: [f64; 2], [u, v]: [f64; 2]| f64::from(x / 4.0 < u * v));
    let settings = settings(4, 3, 2e-3);
    let found = reference(&blurred, &settings).expect("it is not cancelled");
    // The chance that a product of two uniform numbers is above a is 1 - a + a ln a; its
    // integral from 0 on is a - 3 a^2 / 4 + a^2 ln a / 2.
    let whole = |a: f64| a - 0.75 * a * a + if a > 0.0 { 0.5 * a * a * libm::log(a) } else { 0.0 };
    let truth = truth(settings.size, |x, _| 4.0 * (whole((x + 1.0) / 4.0) - whole(x / 4.0)));
    let error = found.picture.error(&truth).expect("one size");
    assert!(found.error <= 2e-3 && error < 2.0 * 2e-3, "{error} {}", found.error);
}

/// A bar of a tenth of a pixel, tilted by 7.3 degrees, through 128 x 128 pixels (A1): its
/// light is its area.
#[test]
fn a1_a_bar_thinner_than_a_pixel() {
    let tilt = 7.3_f64.to_radians();
    let (sine, cosine) = (libm::sin(tilt), libm::cos(tilt));
    let bar = Known::new(|[x, y]: [f64; 2], _| {
        f64::from(((x - 64.0) * cosine + (y - 64.0) * sine).abs() < 0.05)
    });
    let found = reference(&bar, &settings(128, 128, 2e-4)).expect("it is not cancelled");
    let mean = 2.0 * found.picture.mean();
    assert!((mean / (0.1 / (128.0 * cosine)) - 1.0).abs() < 0.01, "{mean}");
}

/// Rows of a checker below the horizon (X3), seen from height 1, rows 1/512 high.
#[test]
fn x3_a_checker_to_the_horizon() {
    // A tall picture of one column, in which the distance is the reciprocal of the row.
    let row = |y: f64| 512.0 / y.max(1e-9);
    let checker = Known::new(|[_, y]: [f64; 2], _| libm::floor(row(y)).rem_euclid(2.0));
    let found = reference(&checker, &settings(1, 64, 4e-3)).expect("it is not cancelled");
    // The light between two distances is counted cell by cell, weighted as the eye sees it.
    let seen = |top: f64| {
        let (near, far) = (row(top + 1.0), row(top));
        let mut sum = 0.0;
        let mut cell = 2.0 * libm::floor(near / 2.0) + 1.0;
        while cell < far {
            let (from, to) = (cell.max(near), (cell + 1.0).min(far));
            sum += if to > from { 512.0 / from - 512.0 / to } else { 0.0 };
            cell += 2.0;
        }
        sum
    };
    for k in [1, 2, 4, 8, 16, 32] {
        let (found, right) = (found.picture.pixels()[k][0], seen(k as f64));
        assert!((found - right).abs() < 0.03, "row {k}: {found} {right}");
    }
    let truth = truth(Size::new(1, 64), |_, y| if y < 1.0 { 0.5 } else { seen(y) });
    let error = found.picture.error(&truth).expect("one size");
    assert!(error < 1.2e-2, "{error}");
}

/// Samples are averaged before they are clipped (A3).
#[test]
fn a3_highlights_are_averaged_first() {
    let bright = Known::new(|[x, _]: [f64; 2], _| if x < 0.01 { 100.0 } else { 0.2 });
    let settings = ReferenceSettings { factor: 0.5, ..settings(1, 1, 1e-3) };
    let found = reference(&bright, &settings).expect("it is not cancelled");
    assert!((found.picture.pixels()[0][0] - 0.5 * 1.198).abs() < 0.02, "{found:?}");
    assert!((found.spreads[0] - 0.95).abs() < 1e-6, "from 0.05 to white: {found:?}");
}

#[test]
fn what_is_smooth_has_no_spread_and_needs_few_samples() {
    let grey = Known::new(|_, _| 0.25);
    let found = reference(&grey, &settings(5, 7, 1e-9)).expect("it is not cancelled");
    assert_eq!((found.error, found.samples), (0.0, 512));
    assert!(found.spreads.iter().all(|spread| *spread == 0.0));
    assert_eq!(grey.seen.load(Ordering::Relaxed), 512 * 35);
}

/// Where no more samples are allowed, there are as many as are, and what comes of them is said.
#[test]
fn an_error_that_is_out_of_reach_is_told() {
    let noise = Known::new(|_, [u, _]: [f64; 2]| u);
    for (affords, samples) in [(511, 512), (600, 512), (1000, 2 * 22 * 22), (1 << 15, 1 << 15)] {
        let affords = || affords;
        let settings = ReferenceSettings { affords: &affords, ..settings(8, 8, 1e-9) };
        let found = reference(&noise, &settings).expect("it is not cancelled");
        assert_eq!(found.samples, samples);
        assert!(found.error > settings.error, "{}", found.error);
    }
}

#[test]
fn it_can_be_cancelled_and_threads_change_nothing() {
    let edge = Known::new(|[x, y]: [f64; 2], _| f64::from(y < 0.37 * x));
    let cancel = AtomicBool::new(true);
    let cancelled = ReferenceSettings { cancel: Some(&cancel), ..settings(8, 8, 1e-3) };
    assert!(reference(&edge, &cancelled).is_none());
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let settings = settings(20, 9, 1e-3);
    let one = alone.install(|| reference(&edge, &settings)).expect("it is not cancelled");
    let many = reference(&edge, &settings).expect("it is not cancelled");
    assert_eq!(one.picture, many.picture);
    assert_eq!(one.error.to_bits(), many.error.to_bits());
}
