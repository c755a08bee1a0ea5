//! R: light that is mirrored often.

use crate::pictures::{
    assert_near, black, built, by, eye, file, middle_with, mirror, rays, scene, seen, seen_with,
};
use lancer_integrator::{Trouble, Whitted};
use lancer_scene::{Colour, Light, Shape, Surface};

/// L = e / (1 - rho). Pass: a relative error of at most 1e-3. Elsewhere it is 0.4095
/// instead of 1, and 0.6513 where more mirrors are asked for.
#[test]
fn r1_a_mirror_room_is_as_bright_as_its_series() {
    for (gloss, expected) in [("0.5", 0.2), ("0.9", 1.0), ("0.99", 10.0), ("0.999", 100.0)] {
        let rendered =
            seen(&file("mirror_room", &[("gloss=\"0.9\"", &format!("gloss=\"{gloss}\""))]));
        for value in rendered.film.pixels().as_flattened() {
            let missing = 1.0 - f64::from(*value) / expected;
            // The cutoff is a bound of what is missing, as a part of all.
            assert!((-1e-6..=1e-4).contains(&missing), "{gloss}: {value}");
        }
    }
}

/// What is left out is what N mirrors leave, rho^(N+1), and no more than the cutoff.
#[test]
fn r1_what_a_cutoff_leaves_out_is_bounded_by_it() {
    for cutoff in [1e-2, 1e-4, 1e-6] {
        let value = middle_with(&file("mirror_room", &[]), cutoff);
        // The first N with 0.9^N at most the cutoff.
        let mut share = 1.0;
        while share > cutoff {
            share *= 0.9;
        }
        assert_near(value, 1.0 - share, 1e-6, "the series so far");
    }
}

/// With a reflectance of 1 nothing ends by itself. It ends, and each pixel that lacks
/// something is counted.
#[test]
fn r1_a_room_of_perfect_mirrors_ends_and_says_what_is_missing() {
    let scene = file("mirror_room", &[("gloss=\"0.9\"", "gloss=\"1\"")]);
    let rendered = by("whitted", &scene);
    let pixels = rendered.film.pixels();
    let count = pixels.len() as u64;
    assert_eq!(rendered.counts.troubles.given_up, Trouble { count, first: Some((0, 0)) });
    for value in pixels.as_flattened() {
        let expected = 0.1 * f64::from(Whitted::DEEPEST + 1);
        assert_near(f64::from(*value), expected, 1e-6, "10,001 surfaces");
    }
}

/// Two facing mirrors of different colours, each lit between them by a lamp without
/// falloff: (cA + g cB) / (1 + g), since their matte parts are 1 - g of their colours.
#[test]
fn r1_two_facing_mirrors_of_different_colours() {
    let [a, b] = [[1.0, 0.0, 0.25], [0.0, 1.0, 0.5]];
    for (gloss, cutoff) in [(0.5, 1e-7), (0.9, 1e-7), (0.99, 1e-7), (0.999, 1e-4)] {
        let surface = |shares| {
            let colour = Colour::linear(shares).expect("in range");
            Surface::new(colour).gloss(gloss).expect("in range")
        };
        let facing = scene(eye([0.0; 3], [0.5, 0.0, 0.0]), 0.0)
            .shape(Shape::plane([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], surface(a)))
            .shape(Shape::plane([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], surface(b)))
            // Straight onto one of them, each from between them.
            .light(Light::lamp([0.0; 3], 1.0));
        let film = seen_with(&built(facing), cutoff).film;
        for i in 0..3 {
            let expected = (a[i] + gloss * b[i]) / (1.0 + gloss);
            let found = f64::from(film.pixel(0, 0)[i]);
            assert_near(found, expected, 2.0 * cutoff + 1e-6, "the series");
        }
    }
    // And the mirrors themselves, without light.
    let dark = scene(eye([0.0; 3], [0.5, 0.0, 0.0]), 0.0)
        .shape(Shape::plane([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], mirror(0.9)))
        .shape(Shape::plane([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], black()));
    assert_eq!(middle_with(&built(dark), 1e-4), 0.0);
}

/// Balls of radius 1 with centres 6 apart: an error in y grows by 5 + sqrt(24) at each
/// of them. Pass: a relative error of y of at most 1e-13. The same path with 60 digits.
#[test]
fn r2_a_corridor_between_two_mirror_balls() {
    for (slope, bounce, expected) in
        [(1e-9, 9, 0.206_273_215_027_127_53), (1e-12, 12, 0.200_017_316_793_880_01)]
    {
        let corridor = scene(eye([0.0; 3], [1.0, slope, 0.0]), 0.0)
            .shape(Shape::sphere([3.0, 0.0, 0.0], 1.0, mirror(1.0)))
            .shape(Shape::sphere([-3.0, 0.0, 0.0], 1.0, mirror(1.0)));
        // The first ray is the eye's own; each later one starts at a bounce.
        assert_near(rays(corridor)[bounce].origin.y, expected, 1e-13, "y");
    }
}

/// A plane mirror is no worse after ten thousand: directions keep their length, and a
/// ray that goes to and fro straight comes back to where it was.
#[test]
fn r2_ten_thousand_plane_mirrors_keep_a_direction() {
    let facing = scene(eye([0.0; 3], [0.5, 0.0, 0.0]), 0.0)
        .shape(Shape::plane([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], mirror(1.0)))
        .shape(Shape::plane([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], mirror(1.0)));
    let paths = rays(facing);
    assert_eq!(paths.len(), Whitted::DEEPEST as usize + 1);
    for ray in &paths {
        assert!((ray.direction.norm() - 1.0).abs() <= 1e-15);
        assert_eq!((ray.direction.y, ray.direction.z), (0.0, 0.0));
        assert_eq!((ray.origin.y, ray.origin.z), (0.0, 0.0));
    }
}
