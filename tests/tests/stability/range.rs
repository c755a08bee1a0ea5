//! I: scenes that are moved, scaled, mirrored and turned, and numbers at the ends of their
//! range.

use crate::pictures::{
    bits, built, by, codes, differing, file, glass, parsed, power, scene, seen, text, white,
};
use lancer_film::Window;
use lancer_integrator::{Engine, Rendered, Whitted};
use lancer_scene::{
    Camera, Checker, Colour, Degrees, Falloff, InvalidField, Length, Light, Mesh, Pattern, Scene,
    Shape, Surface,
};
use std::sync::Arc;

/// A map of space that keeps doubles: signs and order of axes, a power of two, and a
/// shift.
#[derive(Clone, Copy)]
struct Map {
    axes: [usize; 3],
    signs: [f64; 3],
    scale: f64,
    shift: [f64; 3],
}

const SAME: Map = Map { axes: [0, 1, 2], signs: [1.0; 3], scale: 1.0, shift: [0.0; 3] };

impl Map {
    fn direction(&self, v: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| self.signs[i] * v[self.axes[i]])
    }

    fn vector(&self, v: [f64; 3]) -> [f64; 3] {
        self.direction(v).map(|c| c * self.scale)
    }

    fn point(&self, p: [f64; 3]) -> [f64; 3] {
        let v = self.vector(p);
        std::array::from_fn(|i| v[i] + self.shift[i])
    }
}

fn checker(map: Map) -> Surface {
    let length = Length::new(0.75 * map.scale).expect("above 0");
    let angle = Degrees::dividing_180(30.0).expect("it divides 180");
    let pattern = Pattern::Checker(Checker { second: Colour::RED, length, angle });
    Surface { pattern, ..white() }
}

fn without_falloff(light: Result<Light, InvalidField>) -> Result<Light, InvalidField> {
    light.map(|light| match light {
        Light::Lamp { point, radius, brightness, .. } => {
            Light::Lamp { point, radius, brightness, falloff: Falloff::None }
        }
        other => other,
    })
}

/// Each kind of shape, mirrors, glass that absorbs, a lamp and a sun: with all coordinates
/// short, so that the map of them is exact.
fn world(map: Map, cells: bool) -> Scene {
    let p = |x, y, z| map.point([x, y, z]);
    let v = |x, y, z| map.vector([x, y, z]);
    let d = |x, y, z| map.direction([x, y, z]);
    let s = map.scale;
    let pattern = if cells { checker(map) } else { white() };
    let colour = Surface::new(Colour::BLUE);
    let clear = glass(1.5).absorption([0.25 / s, 0.5 / s, 0.0]).expect("in range");
    let mirror = Surface::new(Colour::GREEN).gloss(0.5).expect("in range");
    let camera = Camera::new(p(0.5, -7.0, 3.5), p(0.0, -3.5, 1.75), 2.5 * s, [80, 60])
        .and_then(|camera| camera.up(d(0.0, 0.0, 1.0)));
    let mesh = {
        let corners =
            vec![p(-3.0, 2.0, 0.0), p(-2.0, 2.0, 0.0), p(-2.5, 2.5, 0.0), p(-2.5, 2.25, 2.0)];
        let mut sides = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        // Outward, also after an odd number of flips.
        if map.signs.iter().product::<f64>() < 0.0 {
            sides.iter_mut().for_each(|side| side.swap(0, 1));
        }
        Mesh::new(corners, sides).expect("valid")
    };
    let mut built_up = scene(camera, 0.25)
        .light(without_falloff(Light::lamp(p(-4.0, -4.0, 6.0), 1.0)))
        .light(Light::sun(d(1.0, 2.0, -4.0), 0.5))
        .shape(Shape::plane(p(0.0, 0.0, 0.0), d(0.0, 0.0, 1.0), pattern))
        .shape(Shape::sphere(p(-1.0, 0.0, 1.0), s, mirror))
        .shape(Shape::sphere(p(0.25, -2.0, 0.5), 0.5 * s, clear))
        .shape(Shape::cylinder(p(1.5, -1.0, 0.0), p(1.5, -1.0, 1.5), 0.5 * s, pattern))
        .shape(Shape::cone(p(2.5, 1.0, 0.0), p(2.5, 1.0, 2.0), 0.75 * s, colour))
        .shape(Shape::frustum(
            (p(-2.25, -1.5, 0.0), 0.5 * s),
            (p(-2.0, -1.5, 1.0), 0.25 * s),
            colour,
        ))
        .shape(Shape::torus(p(1.0, 2.0, 1.5), d(0.5, -1.0, 0.25), [0.75 * s, 0.25 * s], mirror))
        .shape(Shape::disc(p(0.0, 3.0, 1.0), d(0.25, -1.0, 0.0), s, mirror))
        .shape(Shape::tetrahedron(
            [p(3.0, -1.0, 0.0), p(4.0, -1.0, 0.0), p(3.0, 0.0, 0.0), p(3.0, -1.0, 1.0)],
            colour,
        ))
        .shape(Shape::triangle([p(-4.0, 4.0, 0.0), p(-1.0, 4.0, 0.0), p(-2.0, 4.0, 4.0)], colour))
        .shape(Shape::mesh(Arc::new(mesh), colour));
    let sides = [v(1.0, 0.0, 0.25), v(0.0, 0.5, 0.5)];
    built_up = built_up.shape(Shape::rectangle(p(-4.0, 0.0, 0.5), sides, pattern));
    let [a, b] = [p(-0.75, -2.75, 0.0), p(-0.25, -2.25, 0.5)];
    let least = std::array::from_fn(|i| a[i].min(b[i]));
    let most = std::array::from_fn(|i| a[i].max(b[i]));
    built(built_up.shape(Shape::cuboid(least, most, clear)))
}

/// Moved by 2^k along all axes. Pass: the same bytes up to 2^20, at most 0.1 % of pixels
/// that differ by more than a level up to 2^30; beyond, a warning that gives the
/// resolution. Elsewhere 4.1 % differ at 1e7 and 32.5 % at 1e8.
#[test]
fn i1_a_moved_scene_has_the_same_picture() {
    let here = seen(&world(SAME, true));
    for k in [4, 10, 16, 20, 23, 27, 30] {
        let far = world(Map { shift: [power(k), -power(k), power(k)], ..SAME }, true);
        let there = seen(&far);
        if k <= 20 {
            assert_eq!(differing(&here, &there, 0), 0, "2^{k}");
        }
        let off = differing(&here, &there, 1);
        assert!(off <= 80 * 60 / 1000, "2^{k}: {off}");
        assert!(Whitted::new().warnings(&far).is_empty(), "2^{k}");
    }
    for k in [34, 40, 46] {
        let far = world(Map { shift: [power(k); 3], ..SAME }, true);
        let [warning] = &Whitted::new().warnings(&far)[..] else { panic!("2^{k}") };
        let said = &warning.message;
        assert!(said.contains(&format!("{:.1e} apart", power(k - 52))), "{said}");
        // It ends, with numbers.
        finite(&far, "far away");
    }
}

/// Scaled by 2^k, with lamps that do not fall off, cells and absorption scaled along.
/// Pass: not one bit differs for |k| <= 100. Elsewhere 0.4 % of pixels differ at 2^-7 and
/// 12.5 % at 2^-13.
#[test]
fn i2_a_scaled_scene_has_the_same_bits() {
    let here = bits(&seen(&world(SAME, true)));
    for k in [-100, -73, -40, -20, -13, -10, -7, -1, 1, 2, 10, 17, 20, 33, 60, 100] {
        let there = bits(&seen(&world(Map { scale: power(k), ..SAME }, true)));
        let off = here.iter().zip(&there).filter(|(a, b)| a != b).count();
        assert_eq!(off, 0, "2^{k}");
    }
}

/// In decimal steps scaling rounds the scene itself; the picture is that of the rounded
/// one, so only pixels with a border in them differ.
#[test]
fn i2_a_scene_in_other_units_has_the_same_picture() {
    let here = seen(&world(SAME, true));
    for scale in [1e-12, 1e-6, 1e-4, 1e-3, 1e3, 3e6, 1e12] {
        let there = seen(&world(Map { scale, ..SAME }, true));
        assert!(differing(&here, &there, 1) <= 4, "{scale}");
    }
}

/// A text with its coordinates and lengths times a factor, and its points moved.
fn mapped(text: &str, factor: f64, shift: f64) -> String {
    let tag = |tag: &str| {
        let is_direction = tag.starts_with("normal");
        let mut parts: Vec<String> = tag.split('"').map(str::to_owned).collect();
        for i in (1..parts.len()).step_by(2) {
            let offset = match parts[i - 1].trim_start().rsplit(' ').next().unwrap_or_default() {
                "x=" | "y=" | "z=" if !is_direction => shift,
                "size=" | "chess-size=" | "width=" => 0.0,
                _ => continue,
            };
            let value: f64 = parts[i].parse().expect("a number");
            parts[i] = format!("{:?}", value * factor + offset);
        }
        parts.join("\"")
    };
    let tags: Vec<String> = text.split('<').map(tag).collect();
    tags.join("<")
}

/// The scene of the folder in other units, and elsewhere. POV-Ray has 73 % of other pixels
/// at 1e-5, and 4.1 % and 32.5 % at coordinates of 1e7 and 1e8.
#[test]
fn i2_the_little_world_in_other_units_and_elsewhere() {
    let text = text("little_world", &[]);
    let here = seen(&parsed(&mapped(&text, 1.0, 0.0)));
    assert_eq!(bits(&here), bits(&seen(&parsed(&text))), "nothing is lost on the way");
    let pixels = here.film.pixels().len();
    for factor in [1e-6, 1e-5, 1e-4, 1e-3, 1e5, 1e6, 3e6] {
        let there = seen(&parsed(&mapped(&text, factor, 0.0)));
        assert!(differing(&here, &there, 1) * 2000 <= pixels, "{factor}");
    }
    for factor in [power(-20), power(-10), power(17), power(20)] {
        assert_eq!(bits(&here), bits(&seen(&parsed(&mapped(&text, factor, 0.0)))), "{factor}");
    }
    for shift in [1e5, 1e7, 1e8] {
        let there = seen(&parsed(&mapped(&text, 1.0, shift)));
        assert!(differing(&here, &there, 1) * 1000 <= pixels, "{shift}");
    }
}

/// The picture, left and right exchanged.
fn mirrored(rendered: &Rendered) -> Vec<u32> {
    let film = &rendered.film;
    let Window { width, height, .. } = film.window();
    let places = (0..height).flat_map(|y| (0..width).rev().map(move |x| (x, y)));
    places.flat_map(|(x, y)| film.pixel(x, y).map(f32::to_bits)).collect()
}

/// Flipping the sign of an axis is exact. Checkers are left out, for their axes are
/// those of a right hand.
#[test]
fn i2_a_mirrored_scene_has_the_mirrored_bits() {
    let here = mirrored(&seen(&world(SAME, false)));
    for axis in 0..3 {
        let mut signs = [1.0; 3];
        signs[axis] = -1.0;
        let there = bits(&seen(&world(Map { signs, ..SAME }, false)));
        let off = here.iter().zip(&there).filter(|(a, b)| a != b).count();
        assert_eq!(off, 0, "axis {axis}");
    }
    let turned = world(Map { signs: [-1.0, -1.0, 1.0], ..SAME }, false);
    let half_turn = bits(&seen(&turned));
    assert!(half_turn == bits(&seen(&world(SAME, false))), "two flips are a turn");
}

/// Other axes change the order of sums. Pass: no pixel differs by more than a level.
#[test]
fn i2_permuted_axes_have_the_same_picture() {
    let here = seen(&world(SAME, false));
    for axes in [[1, 2, 0], [2, 0, 1]] {
        let there = seen(&world(Map { axes, ..SAME }, false));
        assert_eq!(differing(&here, &there, 1), 0, "{axes:?}");
    }
}

/// What a scene's text may say of numbers, and whether it is an error.
const NUMBERS: [(&str, bool); 14] = [
    ("nan", true),
    ("NaN", true),
    ("inf", true),
    ("-infinity", true),
    ("1e999", true),
    ("-1e309", true),
    ("", true),
    ("1e", true),
    ("0x10", true),
    ("-0", false),
    ("-0.0", false),
    ("1e-310", false),
    ("1e-400", false),
    ("1e200", false),
];

/// Pass: an error that names the line, or finite pixels; never a panic.
#[test]
fn i3_bad_numbers_are_errors_with_their_line() {
    let good = text("numbers", &[]);
    let values: Vec<&str> = good
        .match_indices("=\"")
        .map(|(at, _)| {
            let rest = &good[at + 2..];
            &rest[..rest.find('"').unwrap_or(0)]
        })
        .collect();
    let mut tried = 0;
    let mut places: Vec<usize> = good.match_indices("=\"").map(|(at, _)| at + 2).collect();
    places.retain(|at| good[*at..].starts_with(|c: char| c.is_ascii_digit() || c == '-'));
    assert!(places.len() > 40 && values.len() >= places.len());
    for at in places {
        let end = at + good[at..].find('"').expect("it is closed");
        for (number, is_error) in NUMBERS {
            let bad = format!("{}{number}{}", &good[..at], &good[end..]);
            let parsed = lancer_xml::parse(bad.as_bytes(), &lancer_xml::Options::default());
            tried += 1;
            let line = good[..at].lines().count();
            match &parsed.scene {
                None => {
                    let named = parsed.diagnostics.iter().any(|diagnostic| {
                        parsed.source.location(diagnostic.span.start).0 as usize == line
                            || diagnostic.message.contains("origin")
                    });
                    assert!(named, "{number} in line {line}: {:?}", parsed.diagnostics);
                }
                Some(scene) => {
                    assert!(!is_error, "{number} in line {line}");
                    finite(scene, &format!("{number} in line {line}"));
                }
            }
        }
    }
    assert!(tried > 500);
}

/// All pixels of the picture are finite.
fn finite(scene: &Scene, what: &str) {
    for engine in ["whitted", "classic"] {
        if engine == "classic" && !lancer_integrator::Classic.refusals(scene).is_empty() {
            continue;
        }
        let film = by(engine, scene).film;
        let finite = film.pixels().as_flattened().iter().all(|v| v.is_finite());
        assert!(finite || engine == "classic", "{engine}: {what}");
        let _ = codes(&by(engine, scene));
    }
}

/// Directions of any length: scaled by their largest coordinate first.
#[test]
fn i3_directions_may_be_very_short_or_long() {
    let lit = |normal: [f64; 3]| {
        let camera = Camera::new([0.0, 0.0, 5.0], [0.0, 1.0, 0.0], 4.0, [32, 32]);
        let surface = Surface::new(Colour::RED).checker(Colour::BLUE);
        let lit = scene(camera, 0.0)
            .light(Light::sun([0.0, 0.0, -1.0], 1.0))
            .shape(Shape::plane([0.0; 3], normal, surface));
        bits(&seen(&built(lit)))
    };
    let plain = lit([0.0, 0.0, 1.0]);
    for k in [-1074, -1022, -660, -200, 3, 660, 1023] {
        assert!(lit([0.0, 0.0, power(k)]) == plain, "2^{k}");
    }
    for tiny in [1e-200, 1e-310, 5e-324] {
        assert!(lit([tiny, 0.0, 1.0]) == plain && lit([tiny, tiny, 1.0]) == plain);
        // And where it is not along an axis of its own.
        let across = lit([1.0, tiny, 1.0]);
        assert!(across == lit([1.0, 0.0, 1.0]));
    }
    // Suns, and what is up, too.
    for length in [5e-324, 1e-200, 1e200, 1.7e308] {
        let camera = Camera::new([0.0, 0.0, 5.0], [0.0, 1.0, 0.0], 4.0, [8, 8])
            .and_then(|camera| camera.up([0.0, 0.0, length]));
        let sunny = scene(camera, 0.0)
            .light(Light::sun([0.0, length, -length], 1.0))
            .shape(Shape::plane([0.0; 3], [0.0, 0.0, 1.0], white()));
        let found = seen(&built(sunny)).film.pixel(4, 4)[0];
        assert!((found - 0.5_f32.sqrt()).abs() < 1e-7, "{length}: {found}");
    }
}

/// What is missing, empty or nothing at all is an error, and so are sizes below 0 and
/// pictures without pixels.
#[test]
fn i3_what_makes_no_scene_is_an_error() {
    let good = text("numbers", &[]);
    let _ = parsed(&good);
    for (from, to) in [
        ("size=\"1\"", "size=\"-1\""),
        ("size=\"1\"", "size=\"0\""),
        ("size=\"1\"", ""),
        ("pxwidth=\"12\"", "pxwidth=\"0\""),
        ("pxwidth=\"12\"", "pxwidth=\"-4\""),
        ("pxwidth=\"12\"", "pxwidth=\"99999999999\""),
        ("width=\"2\"", "fov=\"0\""),
        ("width=\"2\"", "fov=\"180\""),
        ("width=\"2\"", "width=\"0\""),
        ("<normal x=\"0\" y=\"0\" z=\"1\"/>", "<normal x=\"0\" y=\"0\" z=\"0\"/>"),
        ("<normal x=\"0\" y=\"0\" z=\"1\"/>", "<normal x=\"0\" y=\"-0\" z=\"1e-400\"/>"),
        ("<normal x=\"0\" y=\"0\" z=\"1\"/>", ""),
        (
            "<sun brightness=\"1\"><point x=\"0\" y=\"1\" z=\"-2\"/></sun>",
            "<sun brightness=\"1\"><point x=\"0\" y=\"0\" z=\"0\"/></sun>",
        ),
        ("brightness=\"1\"", "brightness=\"-1\""),
        ("ior=\"1.5\"", "ior=\"0\""),
    ] {
        assert!(good.contains(from), "{from}");
        let bad = good.replacen(from, to, 1);
        let parsed = lancer_xml::parse(bad.as_bytes(), &lancer_xml::Options::default());
        assert!(parsed.scene.is_none() && !parsed.diagnostics.is_empty(), "{to} for {from}");
        for diagnostic in &parsed.diagnostics {
            assert!(parsed.source.location(diagnostic.span.start).0 >= 1);
        }
    }
    // The widest angle that there is.
    let wide = good.replacen("width=\"2\"", "fov=\"179.999999\"", 1);
    finite(&parsed(&wide), "nearly 180 degrees");
    let narrow = good.replacen("width=\"2\"", "fov=\"1e-300\"", 1);
    finite(&parsed(&narrow), "hardly any angle");
}

/// The scene of the folder is one that the tests of numbers change.
#[test]
fn i3_the_scene_of_the_numbers_is_one() {
    finite(&file("numbers", &[]), "as it is");
}
