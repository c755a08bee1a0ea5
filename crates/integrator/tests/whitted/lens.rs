//! Cameras with a lens: how large the blur of a tiny thing is, and what is sharp.

use crate::help::{scene, shining};
use crate::samples::see;
use lancer_scene::{Camera, InvalidField, Shape};

/// A tiny bright ball, twice as far away as what is in focus.
const RADIUS: f64 = 1e-6;
const DISTANCE: f64 = 2.0;
const FOCUS: f64 = 1.0;
const APERTURE: f64 = 2e-5;

/// One pixel that is `width` wide in the plane in focus, `along` the y-axis.
fn camera(width: f64) -> Result<Camera, InvalidField> {
    let camera = Camera::new([0.0; 3], [0.0, FOCUS, 0.0], width, [1, 1])?;
    camera.aperture(APERTURE)
}

/// The radius of the disc that the ball is blurred to, over that of a point: by the second
/// moment of where in the picture it is seen, less its own.
fn blur(camera: Result<Camera, InvalidField>, width: f64, own: f64) -> f64 {
    let ball = Shape::sphere([0.0, DISTANCE, 0.0], RADIUS, shining([1.0; 3]));
    let scene = scene(camera, 0.0).shape(ball).build().expect("valid");
    let (mut hits, mut squares) = (0.0, 0.0);
    for (sample, seen) in see(&scene, 1 << 21, false, 11) {
        let [x, y] = sample.place.map(|c| (c - 0.5) * width);
        if seen.radiance[0] > 0.0 {
            hits += 1.0;
            squares += x * x + y * y;
        }
    }
    assert!(hits > 8000.0, "{hits}");
    // A disc has half its squared radius; that of the ball is added to that of the blur.
    (2.0 * squares / hits - own * own).sqrt()
}

#[test]
fn circle_of_confusion() {
    // Seen in the plane in focus, from the middle of the lens.
    let expected = 0.5 * APERTURE * (DISTANCE - FOCUS) / DISTANCE;
    let width = 2.6 * expected;
    let found = blur(camera(width), width, RADIUS * FOCUS / DISTANCE);
    assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
    // The same with a target elsewhere, and the focus where it was.
    let far = Camera::new([0.0; 3], [0.0, 4.0 * FOCUS, 0.0], 4.0 * width, [1, 1]);
    let far = far.and_then(|camera| camera.aperture(APERTURE)?.focus(FOCUS));
    let found = blur(far, width, RADIUS * FOCUS / DISTANCE);
    assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
}

#[test]
fn circle_of_confusion_of_parallel_rays() {
    let expected = 0.5 * APERTURE * (DISTANCE - FOCUS) / FOCUS;
    let width = 2.6 * expected;
    let camera = camera(1.0).and_then(|camera| camera.orthographic(width));
    let found = blur(camera, width, RADIUS);
    assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
}

/// A sheet in the plane in focus has an edge as sharp as to a pinhole.
#[test]
fn what_is_in_focus_is_sharp() {
    let wide = |camera: Camera| camera.aperture(0.5);
    let pinhole = Camera::new([0.0; 3], [0.0, 3.0, 0.0], 1.0, [1, 1]);
    let near = Camera::new([0.0; 3], [0.0, 0.5, 0.0], 1.0 / 6.0, [1, 1]);
    let cameras = [
        pinhole.clone().and_then(wide),
        near.and_then(wide).and_then(|camera| camera.focus(3.0)),
        pinhole.and_then(wide).and_then(|camera| camera.orthographic(1.0)),
    ];
    for camera in cameras {
        // From 0.125 to the right and from -0.25 upward.
        let sheet = Shape::rectangle(
            [0.125, 3.0, -0.25],
            [[9.0, 0.0, 0.0], [0.0, 0.0, 9.0]],
            shining([1.0; 3]),
        );
        let scene = scene(camera, 0.0).shape(sheet).build().expect("valid");
        let mut seen_at_all = 0;
        for (sample, seen) in see(&scene, 20_000, false, 3) {
            let [x, z] = [sample.place[0] - 0.5, 0.5 - sample.place[1]];
            if (x - 0.125).abs() < 1e-12 || (z + 0.25).abs() < 1e-12 {
                continue;
            }
            let is_seen = x > 0.125 && z > -0.25;
            assert_eq!(seen.radiance, [f32::from(u8::from(is_seen)); 3], "{x} {z}");
            seen_at_all += u32::from(is_seen);
        }
        assert!(seen_at_all > 5000, "{seen_at_all}");
    }
}

/// Half of a lens is covered by a near edge: a sample sees one side or the other.
#[test]
fn what_is_near_is_half_seen() {
    let camera = Camera::new([0.0; 3], [0.0, 3.0, 0.0], 1e-9, [1, 1]);
    let camera = camera.and_then(|camera| camera.aperture(0.5));
    let half =
        Shape::rectangle([0.0, 1.0, -9.0], [[9.0, 0.0, 0.0], [0.0, 0.0, 18.0]], shining([1.0; 3]));
    let scene = scene(camera, 0.0).shape(half).build().expect("valid");
    let samples = see(&scene, 4096, false, 3);
    let mean = samples.iter().map(|(_, seen)| f64::from(seen.radiance[0])).sum::<f64>() / 4096.0;
    assert!((mean - 0.5).abs() < 4.0 * 0.5 / 64.0, "{mean}");
}
