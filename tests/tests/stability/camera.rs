//! K: which ray belongs to which pixel.

use crate::pictures::{U, assert_near, bits, file, power, rays_of, scene, seen};
use lancer_math::Vector;
use lancer_scene::{Camera, InvalidField};

/// The directions of the picture: to the right, upward and ahead. Seen at the rays of
/// a camera with parallel ones, of which neighbours are 1 apart.
fn frame(target: [f64; 3], up: [f64; 3]) -> [Vector; 3] {
    let camera = Camera::new([0.0; 3], target, 1.0, [3, 3])
        .and_then(|camera| camera.orthographic(3.0))
        .and_then(|camera| camera.up(up));
    let ray = |place| rays_of(scene(camera.clone(), 0.0), place)[0];
    [ray((2, 1)).origin.coords, ray((1, 0)).origin.coords, ray((1, 1)).direction]
}

const TILTS: [f64; 9] = [0.0, 1e-300, 1e-17, 1e-16, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3];

/// Pass: a frame that is orthonormal to 4 u, for any tilt.
#[test]
fn k1_the_frame_is_orthonormal_at_any_tilt() {
    for tilt in TILTS {
        for (x, y) in [(tilt, 0.0), (0.0, tilt), (-tilt, 0.0), (0.0, -tilt), (tilt, 0.7 * tilt)] {
            for z in [-1.0, 1.0] {
                for target in [[x, y, z], [y, z, x], [z, x, y], [7.0 * x, 7.0 * y, 7.0 * z]] {
                    for up in [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], target] {
                        let [right, upward, ahead] = frame(target, up);
                        for v in [right, upward, ahead] {
                            assert!((v.norm() - 1.0).abs() <= 4.0 * U, "{target:?} {up:?}");
                        }
                        for (a, b) in [(right, upward), (upward, ahead), (ahead, right)] {
                            assert!(a.dot(&b).abs() <= 4.0 * U, "{target:?} {up:?}");
                        }
                        assert!((right.cross(&upward) + ahead).amax() <= 8.0 * U);
                    }
                }
            }
        }
    }
}

/// The documented rule: straight down y is up. The picture is the limit of those that
/// are tilted towards y, and no pixel is lost. The original shows none of 4096.
#[test]
fn k1_straight_down_is_the_limit_from_the_side_of_y() {
    let picture = |tilt: f64| {
        let target = format!("<target x=\"0\" y=\"{tilt:e}\" z=\"0\"/>");
        seen(&file("straight_down", &[("<target x=\"0\" y=\"0\" z=\"0\"/>", &target)]))
    };
    let straight = picture(0.0);
    assert!(straight.film.pixels().iter().all(|pixel| pixel[0] > 0.0));
    // The quarters have colours of their own: up is y, and right is x.
    let at = |x, y| straight.film.pixel(x, y).map(|v| v > 0.3);
    assert_eq!(at(48, 16), [true, false, false], "x and y above 0 are red");
    assert_eq!(at(16, 16), [true, true, false], "x below 0 is yellow");
    assert_eq!(at(16, 48), [true, true, true], "both below 0 are white");
    for tilt in [1e-17, 1e-16, 1e-15, 1e-14] {
        assert_eq!(bits(&picture(tilt)), bits(&straight), "{tilt}");
    }
    for tilt in [1e-12, 1e-9, 1e-6] {
        let tilted = picture(tilt);
        let pairs = tilted.film.pixels().as_flattened().iter();
        for (a, b) in pairs.zip(straight.film.pixels().as_flattened()) {
            assert!((a - b).abs() <= 1e-7 + 2.0 * tilt as f32, "{tilt}: {a} {b}");
        }
    }
}

#[test]
fn k1_an_eye_at_its_target_and_no_upward_side_are_errors() {
    for target in [[1.0, 2.0, 3.0], [1.0, 2.0, 3.0 + 1e-17]] {
        assert!(Camera::new([1.0, 2.0, 3.0], target, 1.0, [1, 1]).is_err());
    }
    let camera = || Camera::new([1.0, 2.0, 3.0], [1.0, 2.0, 3.0_f64.next_up()], 1.0, [1, 1]);
    assert!(camera().is_ok(), "one step of doubles is a direction");
    assert!(camera().and_then(|camera| camera.up([0.0; 3])).is_err());
    assert!(camera().and_then(|camera| camera.up([0.0, 1e-300, 0.0])).is_ok());
}

/// Pass: 0 pixels that differ from their mirror images, since flipping signs is
/// exact. The original has 1192 of 4096, and 618 of 4225.
#[test]
fn k2_a_symmetric_scene_has_a_symmetric_picture() {
    for size in [64_u32, 65] {
        let sides = format!("pxwidth=\"{size}\" pxheight=\"{size}\"");
        let scene = file("symmetric", &[("pxwidth=\"64\" pxheight=\"64\"", &sides)]);
        let film = seen(&scene).film;
        let last = size - 1;
        let mut columns = Vec::new();
        for (x, y) in (0..size).flat_map(|y| (0..size).map(move |x| (x, y))) {
            let pixel = film.pixel(x, y).map(f32::to_bits);
            assert_eq!(pixel, film.pixel(last - x, y).map(f32::to_bits), "{x} {y}");
            assert_eq!(pixel, film.pixel(x, last - y).map(f32::to_bits), "{x} {y}");
            if film.pixel(x, y) != [0.0; 3] {
                columns.push(x);
            }
        }
        let (first, end) = (columns.iter().min().copied(), columns.iter().max().copied());
        assert_eq!(first.zip(end).map(|(first, end)| first + end), Some(last));
        // The ball's outline: sin b = 2/5, so 2 tan b wide in a picture that is 2 wide.
        let lit = columns.len() as f64 / f64::from(size * size);
        let area = std::f64::consts::PI * 4.0 / 21.0 / 4.0;
        assert!((lit / area - 1.0).abs() < 0.03, "{lit} {area}");
    }
}

/// Pass: an angle error of at most 4 u wherever the eye is. Stored as two points the
/// direction is off by 5.5e-11 at 1e6 and lost at 1e16.
#[test]
fn k3_directions_do_not_depend_on_where_the_eye_is() {
    let camera = |from: f64| -> Result<Camera, InvalidField> {
        Camera::new([from; 3], [from + 2.0, from + 4.0, from + 4.0], 2.0, [5, 5])
    };
    for place in [(2, 2), (0, 0), (4, 1)] {
        let ray = |from: f64| rays_of(scene(camera(from), 0.0), place)[0];
        let near = ray(0.0).direction;
        for from in [1e6, 1e8, 1e12, 1e15, 1e16, -1e16] {
            let far = ray(from);
            assert_eq!(far.direction, near, "{from}");
            assert_eq!(far.origin.coords, Vector::repeat(from));
        }
        if place == (2, 2) {
            let exact = Vector::new(1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0);
            assert!(near.cross(&exact).norm() <= 4.0 * U);
        }
    }
    // And scaled they are the same: a target very near or far.
    for k in [-300, 0, 300] {
        let to = [power(k), 2.0 * power(k), 2.0 * power(k)];
        let camera = Camera::new([0.0; 3], to, power(k), [1, 1]);
        let direction = rays_of(scene(camera, 0.0), (0, 0))[0].direction;
        assert_near(direction.x, 1.0 / 3.0, 2.0 * U, "one third");
    }
}
