//! D4 to D7: several media, thin layers, and where light is neither made nor lost.

use crate::pictures::{
    FILM, assert_near, black, built, eye, file, floor, glass, middle, middle_with, power, rays,
    scene, seen_with, shining,
};
use lancer_math::Ray;
use lancer_scene::{InvalidField, Light, Medium, SceneBuilder, Shape, Surface};
use std::f64::consts::PI;

const GAPS: [f64; 13] =
    [0.0, 1e-15, 1e-14, 1e-13, 1e-12, 1e-10, 1e-9, 1e-7, 1e-6, 5e-5, 1e-4, 1e-3, 1e-2];

/// The fraction that is mirrored, by Fresnel's own form: sines and tangents.
fn fresnel(sine: f64, n1: f64, n2: f64) -> f64 {
    let (a, b) = (libm::asin(sine), libm::asin(sine * n1 / n2));
    let s = libm::sin(a - b) / libm::sin(a + b);
    let t = libm::tan(a - b) / libm::tan(a + b);
    (s * s + t * t) / 2.0
}

/// The least distance from `expected` at which one of the rays arrives; infinite where
/// none does.
fn least(paths: &[Ray], arrives: impl Fn(&Ray) -> Option<f64>, expected: f64) -> f64 {
    let misses = paths.iter().filter_map(arrives).map(|at| (at - expected).abs());
    misses.fold(f64::INFINITY, f64::min)
}

/// n sin(angle) is the same in all layers, so a ray lands at tan(asin(s/1.5)) +
/// tan(asin(s/1.33)) + tan(50 degrees). Pass: |x - x*| <= 10 gap + 1e-9, where faces
/// overlap, touch or leave air between them. Elsewhere it is 1.8926 where they overlap
/// by 5e-5.
#[test]
fn d4_glass_on_water_bends_light_as_two_layers_do() {
    let expected = 2.490_333_019_593_422;
    let fifty = 50.0_f64.to_radians();
    let from = [-libm::sin(fifty), 0.0, libm::cos(fifty)];
    let slab = |from, to, surface| Shape::cuboid([-20.0, -20.0, from], [20.0, 20.0, to], surface);
    for gap in GAPS.into_iter().flat_map(|gap| [gap, -gap]) {
        for (first, second) in [(0, 0), (1, 0), (0, 1)] {
            let (first, second) = (glass(1.5).priority(first), glass(1.33).priority(second));
            if gap > 0.0 && first.priority != second.priority {
                continue;
            }
            let paths =
                rays(scene(eye(from, [0.0; 3]), 0.0).shape(slab(-1.0, 0.0, first)).shape(slab(
                    -2.0 - gap,
                    -1.0 - gap,
                    second,
                )));
            let arrives = |ray: &Ray| {
                let t = (-3.0 - ray.origin.z) / ray.direction.z;
                let is_out = ray.origin.z < -2.0 - gap + 1e-12 && ray.direction.z < 0.0;
                is_out.then_some(ray.origin.x + t * ray.direction.x)
            };
            let miss = least(&paths, arrives, expected);
            assert!(miss <= 10.0 * gap.abs() + 1e-9, "{gap}: {miss}");
        }
    }
}

/// The same as a picture: a small light where the ray lands, dimmed by two borders and
/// not by those of air that is not there, then by the water's lower face.
#[test]
fn d4_glass_on_water_lets_through_what_two_borders_do() {
    let sine = libm::sin(50.0_f64.to_radians());
    let out = 1.0 - fresnel(sine, 1.0, 1.33);
    let two = 0.938_346_095_178_402_1 * out;
    let water_top = "<to x=\"20\" y=\"20\" z=\"-1\"/>";
    for overlap in [0.0, 1e-15, 1e-13, 1e-9, 1e-6, 5e-5, 1e-3] {
        let top = format!("<to x=\"20\" y=\"20\" z=\"{}\"/>", overlap - 1.0);
        let found = middle_with(&file("glass_on_water", &[(water_top, &top)]), 1e-9);
        assert_near(found, two, 2.0 * FILM, &format!("overlap {overlap}"));
    }
    // With air between there are two more borders, and light goes to and fro in it; all
    // of it lands on the light, for it is larger than the gap.
    for gap in [1e-9, 1e-6, 5e-5] {
        let top = format!("<to x=\"20\" y=\"20\" z=\"{}\"/>", -1.0 - gap);
        let found = middle_with(&file("glass_on_water", &[(water_top, &top)]), 1e-9);
        let [a, b] = [fresnel(sine, 1.0, 1.5), fresnel(sine, 1.0, 1.33)];
        let expected = 0.858_473_276_527_201_3 * out / (1.0 - a * b);
        assert_near(found, expected, 1e-6, &format!("gap {gap}"));
    }
}

/// A shell of glass with water in it: a ball of air in the glass, and one of water in
/// that, larger, of the same size, or smaller. Pass: |y - y*| <= 10 gap + 1e-9. Elsewhere
/// y is 0.6587 for balls of the same size, 0.0237 for an overlap of 5e-5, and 1.1462 for
/// as large a gap; right is -0.4511.
#[test]
fn d4_water_in_a_shell_of_glass() {
    let expected = -0.451_097_304_767_569_5;
    let ball = |radius: f64, surface: Surface| Shape::sphere([0.0; 3], radius, surface);
    let arrives = |ray: &Ray| {
        let out = ray.origin.x > 0.5 && ray.direction.x > 0.0 && ray.origin.coords.norm() > 1.05;
        out.then(|| ray.origin.y + (4.0 - ray.origin.x) * ray.direction.y / ray.direction.x)
    };
    let around = || scene(eye([-5.0, 0.5, 0.0], [0.0, 0.5, 0.0]), 0.0).shape(ball(1.1, glass(1.5)));
    let nested = rays(around().shape(ball(1.0, glass(1.33))));
    assert!(least(&nested, arrives, expected) <= 1e-12, "without air");
    for gap in GAPS.into_iter().flat_map(|gap| [gap, -gap]) {
        let paths = rays(
            around()
                .shape(ball(1.0 + gap, glass(1.0).priority(1)))
                .shape(ball(1.0, glass(1.33).priority(2))),
        );
        let miss = least(&paths, arrives, expected);
        assert!(miss <= 10.0 * gap.abs() + 1e-9, "{gap}: {miss}");
    }
    // And as a picture: a small light where it lands.
    for radius in ["1", "1.00005", "0.99995", "1.000000000001", "0.999999999999"] {
        let inside = format!("size=\"{radius}\" priority=\"1\"");
        let scene = file("water_in_glass", &[("size=\"1\" priority=\"1\"", &inside)]);
        let found = middle(&scene);
        // Four borders; six and what goes to and fro where there is air.
        let [outer, glass_water] = [fresnel(0.5 / 1.1, 1.0, 1.5), fresnel(0.5 / 1.5, 1.5, 1.33)];
        let [a, b] = [fresnel(0.5, 1.0, 1.5), fresnel(0.5, 1.0, 1.33)];
        let middle: f64 = if radius.starts_with("1.0") {
            (1.0 - a) * (1.0 - b) / (1.0 - a * b)
        } else {
            1.0 - glass_water
        };
        let expected = (1.0 - outer) * (1.0 - outer) * middle * middle;
        assert_near(found, expected, 3e-4, radius);
    }
}

/// Eight sheets that pass half of the light. Pass: exactly 1/256 for spacings of at least
/// 16 last places of a coordinate. Elsewhere half of them are lost at 9e-5.
#[test]
fn d5_every_sheet_of_a_stack_counts() {
    for spacing in [1e-2, 9e-5, 1e-5, 1e-6, 1e-9, 1e-12, power(-48)] {
        let by = format!("z=\"{spacing:e}\"");
        let stack = file("sheets", &[("z=\"1e-5\"", &by)]);
        assert_eq!(middle(&stack), 1.0 / 256.0, "{spacing}");
    }
    // The same without a group, around another place: spacings of 16 last places there.
    let half = black().transparency(0.5).expect("in range").thin();
    let half = Surface { medium: Medium::AIR, ..half };
    for at in [1.0, 1e3, 1e6] {
        let mut stack = scene(eye([0.5, 0.25, 2.0 * at], [0.0, 0.0, at]), 1.0);
        let step = 16.0 * (at.next_up() - at);
        for i in 0..8 {
            let centre = [0.0, 0.0, at - f64::from(i) * step];
            stack = stack.shape(Shape::disc(centre, [0.0, 0.0, 1.0], 1.0, half));
        }
        assert_eq!(middle(&built(stack)), 1.0 / 256.0, "at {at}");
    }
}

/// A film of water: both of its faces, with what goes to and fro, whatever its thickness.
#[test]
fn d5_both_faces_of_a_film_count() {
    for thickness in ["1", "1e-2", "4e-5", "1e-8", "1e-12"] {
        let top = format!("z=\"{thickness}\"");
        let found = middle_with(&file("film", &[("z=\"4e-5\"", &top)]), 1e-9);
        assert_near(found, 0.960_670_302_286_106_4, FILM, thickness);
    }
}

/// A clear blue box just above a shining plane. Pass: no pixel is black; blue passes
/// whole. Elsewhere 6.3 % are black at 7e-5, and 24.7 % at 7e-6.
#[test]
fn d5_a_clear_box_just_above_a_plane_has_no_black_specks() {
    for gap in [1e-2, 7e-5, 7e-6, 1e-9, 1e-12, 1e-15, 0.0] {
        let plane = format!("z=\"{}\"", -1.0 - gap);
        let film = seen_with(&file("box_on_plane", &[("z=\"-1.00007\"", &plane)]), 1e-6).film;
        let mut tinted = 0;
        for pixel in film.pixels() {
            assert_eq!(pixel[2], 1.0, "{gap}: {pixel:?}");
            tinted += usize::from(pixel[0] < 0.5);
        }
        assert!(tinted > film.pixels().len() / 4, "the box is seen");
    }
}

/// Lossless things in an even surrounding cannot be seen. Pass: 1e-3 with the usual
/// cutoff, and what a film can hold with the series summed (1e-9 are below its last
/// place, 3e-8). Elsewhere it is down to 0.447, in 4.8 % of the frame.
#[test]
fn d6_clear_things_vanish_in_a_white_furnace() {
    let furnace = || file("furnace", &[]);
    let ball = |radius: f64, ior: f64| Shape::sphere([0.0; 3], radius, glass(ior));
    let all: [(&str, Vec<Result<Shape, InvalidField>>); 6] = [
        ("ball", vec![ball(1.0, 1.5)]),
        ("diamond", vec![ball(1.0, 2.42)]),
        ("bubble", vec![ball(1.0, 0.75)]),
        ("box", vec![Shape::cube([0.0; 3], 1.4, glass(1.5))]),
        ("torus", vec![Shape::torus([0.0; 3], [0.3, 0.2, 1.0], [0.7, 0.3], glass(1.5))]),
        ("shells", vec![ball(1.0, 1.5), ball(0.9, 1.33), ball(0.6, 1.8)]),
    ];
    for (name, shapes) in all {
        let mut scene = furnace();
        scene.shapes = shapes.into_iter().map(|shape| shape.expect("valid")).collect();
        let worst = |cutoff: f64| {
            let film = seen_with(&scene, cutoff).film;
            let values = film.pixels().as_flattened().iter();
            values.map(|v| (f64::from(*v) - 0.5).abs()).fold(0.0, f64::max)
        };
        let usual = worst(lancer_integrator::Whitted::CUTOFF);
        assert!(usual <= 1e-4, "{name}: {usual}");
        if name != "shells" {
            let summed = worst(1e-9);
            assert!(summed <= 6e-8, "{name}, summed up: {summed}");
        }
    }
    assert_near(middle(&furnace()), 0.5, 1e-4, "the scene itself");
}

/// The rays of a ball of that index at the origin, which a ray along x meets at that
/// height.
fn in_ball(height: f64, ior: f64) -> Vec<Ray> {
    let ball = Shape::sphere([0.0; 3], 1.0, glass(ior));
    rays(scene(eye([-5.0, height, 0.0], [0.0, height, 0.0]), 0.0).shape(ball))
}

/// The rays that leave the ball.
fn outgoing(paths: &[Ray]) -> impl Iterator<Item = &Ray> {
    let outward = |ray: &&Ray| ray.origin.coords.dot(&ray.direction) > 0.0;
    // The eye's own goes inward.
    paths.iter().filter(outward)
}

/// Pass: the deviation to 1e-12, and where the axis is crossed.
#[test]
fn d7_a_ball_lens_bends_by_snells_law_twice() {
    let paths = in_ball(0.5, 1.5);
    let ahead = outgoing(&paths).find(|ray| ray.direction.x > 0.5).expect("it goes through");
    let degrees = libm::atan2(-ahead.direction.y, ahead.direction.x).to_degrees();
    assert!((degrees - 21.057_558_731_018_617).abs() <= 1e-12, "{degrees}");
    let crossing = ahead.origin.x - ahead.origin.y * ahead.direction.x / ahead.direction.y;
    assert_near(crossing, 1.391_572_948_889_310_4, 1e-13, "the axis");
    // Near the axis it is 1.5 radii.
    let paths = in_ball(1e-6, 1.5);
    let ahead = outgoing(&paths).find(|ray| ray.direction.x > 0.5).expect("it goes through");
    let crossing = ahead.origin.x - ahead.origin.y * ahead.direction.x / ahead.direction.y;
    assert_near(crossing, 1.5, 1e-9, "paraxial");
}

/// The angle by which light is turned that is mirrored once inside a drop.
fn turned(incidence: f64) -> f64 {
    let paths = in_ball(libm::sin(incidence), 4.0 / 3.0);
    // Downward and back: what is mirrored outside goes upward.
    let back = |ray: &&Ray| ray.direction.x < 0.0 && ray.direction.y < 0.0;
    let ray = outgoing(&paths).find(back).expect("there is one");
    PI - libm::atan2(-ray.direction.y, -ray.direction.x)
}

/// Pass: the least turn to 1e-12, at cos i = sqrt((n^2 - 1) / 3) to 1e-7.
#[test]
fn d7_the_rainbow_is_where_the_turn_is_least() {
    let at = 1.036_570_282_226_982_3;
    let least = 137.970_341_134_302_3;
    assert!((turned(at).to_degrees() - least).abs() <= 1e-12, "{}", turned(at).to_degrees());
    for aside in [1e-3, 1e-2, 0.1] {
        assert!(turned(at + aside) > turned(at) && turned(at - aside) > turned(at));
    }
    // Where the slope is nothing, by the secant of central differences.
    let slope = |angle: f64| (turned(angle + 1e-4) - turned(angle - 1e-4)) / 2e-4;
    let (low, high) = (at - 0.01, at + 0.01);
    let (a, b) = (slope(low), slope(high));
    let mut best = low - a * (high - low) / (b - a);
    for _ in 0..3 {
        let (a, b) = (slope(best - 1e-3), slope(best + 1e-3));
        best -= slope(best) * 2e-3 / (b - a);
    }
    assert!((best - at).abs() <= 1e-7, "{best}");
}

/// Beer and Lambert along a chord, exp(-sigma 2 r cos t), as seen from outside and from
/// within. What a film cannot hold is tested beside the formula, under the same name.
#[test]
fn d7_absorption_goes_by_the_length_in_the_medium() {
    let smoke = |sigma: f64| glass(1.0).absorption([sigma; 3]).expect("in range");
    for sigma in [1e-17, 1e-6, 0.5, 3.0] {
        for height in [0.0_f64, 0.6, 0.96] {
            let chord = 2.0 * (1.0 - height * height).sqrt();
            let ball = || Shape::sphere([0.0; 3], 1.0, smoke(sigma));
            let outside = scene(eye([-5.0, height, 0.0], [0.0, height, 0.0]), 1.0).shape(ball());
            let expected = libm::exp(-sigma * chord);
            assert_near(middle(&built(outside)), expected, FILM, "through a ball");
            // The first leg counts where the eye is inside.
            let inside = scene(eye([0.0, height, 0.0], [0.25, height, 0.0]), 1.0).shape(ball());
            let expected = libm::exp(-sigma * chord / 2.0);
            assert_near(middle(&built(inside)), expected, FILM, "from the middle");
        }
    }
    // A lamp in the medium, and a floor.
    let pool: SceneBuilder = scene(eye([0.0, 0.0, 5.0], [0.0; 3]), 0.0)
        .shape(floor(0.0, crate::pictures::white()))
        .shape(Shape::cuboid([-9.0, -9.0, -1.0], [9.0, 9.0, 2.0], smoke(0.5)))
        .light(Light::lamp([0.0, 0.0, 1.0], 1.0));
    assert_near(middle(&built(pool)), libm::exp(-0.5 * 3.0), 2.0 * FILM, "down to it, and back");
}

/// An eye in glass: the first border is one out of it, of 1.5 to 1.
#[test]
fn d7_an_eye_in_glass_looks_out_of_it() {
    let inside = file("eye_in_glass", &[]);
    assert_near(middle_with(&inside, 1e-9), 0.96, FILM, "squarely");
    // Taken for one in the air, its border would let through more at a slant.
    let slanted =
        file("eye_in_glass", &[("x=\"0\" y=\"0\" z=\"-1\"", "x=\"-0.5\" y=\"0\" z=\"-1\"")]);
    let sine = 0.5 / 1.25_f64.sqrt();
    let expected = 1.0 - fresnel(sine, 1.5, 1.0);
    assert_near(middle_with(&slanted, 1e-9), expected, 2.0 * FILM, "slanted");
    // Its sky and what is mirrored below, beyond the critical angle: nothing of it.
    let flat = file("eye_in_glass", &[("x=\"0\" y=\"0\" z=\"-1\"", "x=\"-1\" y=\"0\" z=\"-1\"")]);
    assert_eq!(middle(&flat), 0.0);
    // A glass ball around the eye is left squarely in all directions.
    for to in [[1.0, 0.0, 0.0], [0.3, -0.4, 0.7]] {
        let ball = scene(eye([0.0; 3], to), 1.0)
            .shape(Shape::sphere([0.0; 3], 1.0, glass(1.5)))
            .shape(Shape::sphere([0.0; 3], 9.0, shining(0.5)));
        // 0.96 of the light at once, and 0.04 of what is seen backwards.
        assert_near(middle_with(&built(ball), 1e-9), 0.5, FILM, "a furnace");
    }
}
