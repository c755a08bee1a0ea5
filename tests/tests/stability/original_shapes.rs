//! Scenes in which the original program gets shapes wrong. `classic` and `direct` keep
//! its answers, number by number; `whitted` gets them right.

use super::films::film;
use lancer_film::Film;
use lancer_output::to_rgb8;
use lancer_scene::Scene;
use lancer_tests::paths::{Beside, scenes};
use lancer_tests::plain::{self, Plain};
use lancer_xml::{Options, parse_with};

/// A scene of the folder `scenes/stability`, with some of its text replaced.
fn scene(name: &str, replaced: &[(&str, &str)]) -> Scene {
    let folder = scenes().join("stability");
    let text = std::fs::read_to_string(folder.join(name)).expect("it can be read");
    let text = replaced.iter().fold(text, |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replace(old, new)
    });
    let parsed = parse_with(text.as_bytes(), &Options::default(), &Beside(&folder));
    parsed.into_result().unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The engines that do what the original does.
const ORIGINALS: [&str; 2] = ["classic", "direct"];

/// As 8 bits show it.
fn codes(scene: &Scene, engine: &str) -> Vec<[u8; 3]> {
    let image = to_rgb8(&film(scene, engine)).expect("it is whole");
    image.pixels().map(|pixel| pixel.0).collect()
}

fn count(codes: &[[u8; 3]], what: impl Fn(&[u8; 3]) -> bool) -> usize {
    codes.iter().filter(|code| what(code)).count()
}

fn lit(code: &[u8; 3]) -> bool {
    *code != [0; 3]
}

fn red(code: &[u8; 3]) -> bool {
    code[0] > 0
}

fn blue(code: &[u8; 3]) -> bool {
    code[2] > 0
}

/// From inside a ball, its wall behind the eye hid what is in front of it.
#[test]
fn inside_sphere() {
    let scene = scene("inside_sphere.xml", &[]);
    let mut small = scene.clone();
    small.shapes.remove(0);
    for engine in ORIGINALS {
        assert_eq!(count(&codes(&scene, engine), red), 0, "{engine}");
        assert_eq!(count(&codes(&small, engine), red), 166, "{engine}");
    }
    let alone = count(&codes(&small, "whitted"), red);
    assert!(alone > 160);
    assert_eq!(count(&codes(&scene, "whitted"), red), alone);
}

/// A lamp outside lit a closed ball inside.
#[test]
fn closed_ball() {
    let scene = scene("closed_ball.xml", &[]);
    for engine in ORIGINALS {
        assert_eq!(codes(&scene, engine)[32 * 65 + 32], [0, 0, 254], "{engine}");
    }
    assert_eq!(count(&codes(&scene, "whitted"), lit), 0);
}

/// A plane behind the eye was all over the picture.
#[test]
fn plane_behind() {
    let scene = scene("plane_behind.xml", &[]);
    for engine in ORIGINALS {
        assert_eq!(count(&codes(&scene, engine), red), 4225, "{engine}");
    }
    assert_eq!(count(&codes(&scene, "whitted"), lit), 0);
}

/// An opaque floor was seen through from below.
#[test]
fn plane_from_below() {
    let scene = scene("plane_from_below.xml", &[]);
    for engine in ORIGINALS {
        assert_eq!(count(&codes(&scene, engine), red), 842, "{engine}");
    }
    assert_eq!(count(&codes(&scene, "whitted"), red), 0);
}

/// A plane behind a point hid the lamp before it.
#[test]
fn plane_aside() {
    let scene = scene("plane_aside.xml", &[]);
    let mut ball = scene.clone();
    ball.shapes.remove(1);
    for engine in ORIGINALS {
        assert_eq!(count(&codes(&scene, engine), lit), 0, "{engine}");
        assert_eq!(count(&codes(&ball, engine), lit), 87, "{engine}");
    }
    let alone = count(&codes(&ball, "whitted"), red);
    assert!(alone > 80);
    assert_eq!(count(&codes(&scene, "whitted"), red), alone);
}

/// How many pixels show the ball and should not, or the other way round: their
/// places are so many pixels from the middle, and the ball is 32 of them wide.
fn misjudged(pixels: &[[f32; 3]], offset: f64) -> usize {
    let place = |i: usize| i as f64 - 64.0 + offset;
    let is_ball = |i: usize| {
        let (x, y) = (place(i % 128), place(i / 128));
        x * x + y * y < 1024.0
    };
    pixels.iter().enumerate().filter(|(i, pixel)| is_ball(*i) != (pixel[0] > 0.0)).count()
}

/// The outline of a ball far away was lost in rounding, more and more, and its
/// shading with it. With rays through the corners of pixels, 3205 of them meet it.
///
/// At 1e8 radii not a digit of the discriminant is left, and what is seen depends on the
/// rounding of each sum. `classic`, which has its own, sees nothing there where the
/// original saw 11189 pixels, as its transcription does.
#[test]
fn far_sphere() {
    let far = |distance: &str, width: &str| {
        scene("far_sphere.xml", &[("1e8", distance), ("4e-8", width)])
    };
    for (distance, width, wrong) in [
        ("1e6", "4e-6", 0),
        ("1e7", "4e-7", 52),
        ("3e7", "1.3333333333333334e-7", 352),
        ("1e8", "4e-8", 3205),
    ] {
        let scene = far(distance, width);
        for engine in ORIGINALS {
            let found = misjudged(film(&scene, engine).pixels(), 0.0);
            assert_eq!(found, wrong, "{engine} {distance}");
        }
        let whitted = film(&scene, "whitted");
        assert_eq!(misjudged(whitted.pixels(), 0.5), 0, "{distance}");
        // As bright as the cosine: its square is 1 - (x^2 + y^2) / 32^2.
        for (i, pixel) in whitted.pixels().iter().enumerate() {
            let [x, y] = [i % 128, i / 128].map(|k| k as f64 - 63.5);
            let expected = (1.0 - (x * x + y * y) / 1024.0).max(0.0).sqrt();
            assert!((f64::from(pixel[0]) - expected).abs() < 1e-6, "{distance}: {x} {y}");
        }
    }
    let original = plain::render(&far("1e8", "4e-8"), Plain::Original);
    assert_eq!(original.iter().filter(|pixel| pixel[0] > 0.0).count(), 11_189);
    assert_eq!(misjudged(&original, 0.0), 7984);
}

/// Squares of components left the range of doubles.
#[test]
fn normals() {
    for (name, original) in [("tiny_normal.xml", [0, 0]), ("normal_nearly_x.xml", [4096, 0])] {
        let scene = scene(name, &[]);
        for engine in ORIGINALS {
            let found = codes(&scene, engine);
            assert_eq!([count(&found, red), count(&found, blue)], original, "{engine} {name}");
        }
        let found = codes(&scene, "whitted");
        assert_eq!([count(&found, red), count(&found, blue)], [2048, 2048], "{name}");
        assert_eq!(count(&found, lit), 4096, "{name}");
    }
}

/// How wide the cells are, in degrees, along a circle around the pole.
fn widths(film: &Film, pixels: f64) -> Vec<f64> {
    let middle = f64::from(film.window().width - 1) / 2.0;
    let is_white = |step: i32| {
        let (s, c) = lancer_math::sin_cos_degrees(f64::from(step) / 20.0);
        let [x, y] = [c, s].map(|v| (middle + pixels * v).round() as u32);
        film.pixel(x, y)[0] > 0.0
    };
    let borders: Vec<i32> = (0..7200).filter(|&k| is_white(k) != is_white(k + 1)).collect();
    let next = borders.iter().cycle().skip(1);
    borders.iter().zip(next).map(|(a, b)| f64::from((b - a + 7199) % 7200 + 1) / 20.0).collect()
}

/// Cells of half a radian do not go around a globe a whole number of times: one was
/// left over, and another one twice as wide. Here they are of 30 degrees.
#[test]
fn globe() {
    let scene = scene("globe_pole.xml", &[("129", "1001")]);
    let sorted = |engine| {
        // The ball itself is 215 pixels wide.
        let mut widths = widths(&film(&scene, engine), 200.0);
        widths.sort_by(f64::total_cmp);
        widths
    };
    let mut expected = [28.6; 12];
    (expected[0], expected[11]) = (16.2, 57.3);
    for (engine, expected) in [("classic", expected), ("direct", expected), ("whitted", [30.0; 12])]
    {
        let found = sorted(engine);
        assert_eq!(found.len(), 12, "{engine}: {found:?}");
        // A pixel is a third of a degree there.
        let fine = found.iter().zip(expected).all(|(found, width)| (found - width).abs() < 0.7);
        assert!(fine, "{engine}: {found:?}");
    }
}
