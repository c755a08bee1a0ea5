//! Mirrors, what is behind everything, and what shines by itself.

use crate::help::{
    FILM, assert_near, black, eye, eye_at, floor, grey, grey_with, mirror, pixel, pixel_with, rays,
    rendered, scene, shining, sin_cos,
};
use lancer_integrator::Whitted;
use lancer_scene::{Colour, Light, Scene, Shape, Spectrum, Surface};

#[test]
fn the_background_is_seen_where_nothing_else_is() {
    let radiance = [0.25, 0.5, 3.0];
    let empty = Scene::builder().camera(eye([0.0; 3], [1.0, 2.0, 3.0]));
    assert_eq!(pixel(empty.clone()), [0.0; 3]);
    assert_eq!(pixel(empty.background(Spectrum::new(radiance))), radiance);
}

#[test]
fn mirrors_show_their_share_of_what_is_seen_in_them() {
    let radiance = [0.25, 0.5, 3.0];
    for gloss in [0.0, 0.3, 1.0] {
        let sky = Scene::builder()
            .camera(eye([2.0, 1.0, 1.0], [0.0; 3]))
            .background(Spectrum::new(radiance))
            .shape(floor(0.0, mirror(gloss)));
        let shape = Shape::sphere([-2.0, -1.0, 1.0], 0.5, shining([7.0, 0.0, 1.0]));
        let ball = sky.clone().shape(shape);
        for i in 0..3 {
            assert_near(pixel(sky.clone())[i], gloss * radiance[i], FILM, "the background");
            assert_near(pixel(ball.clone())[i], gloss * [7.0, 0.0, 1.0][i], FILM, "a shining ball");
        }
    }
    // Seen directly it shows all of it.
    let direct = scene(eye([2.0, 1.0, 1.0], [0.0; 3]), 9.0);
    let shape = Shape::sphere([0.0; 3], 0.5, shining([7.0, 0.0, 1.0]));
    assert_eq!(pixel(direct.shape(shape)), [7.0, 0.0, 1.0]);
}

#[test]
fn what_is_not_mirrored_is_matte() {
    let surface = Surface::new(Colour::WHITE).gloss(0.3).expect("in range");
    let lit = scene(eye([2.0, 1.0, 1.0], [0.0; 3]), 2.0)
        .shape(floor(0.0, surface))
        .light(Light::sun([0.0, 0.0, -1.0], 1.0));
    assert_near(grey(lit), 0.7 + 0.3 * 2.0, FILM, "0.7 matte and 0.3 mirrored");
}

/// Two mirrors that face each other, with A = a + g B and B = b + g A: so
/// A = (a + g b) / (1 - g^2).
#[test]
fn two_facing_mirrors_sum_a_geometric_series() {
    let [a, b] = [[0.1, 0.3, 0.0], [0.2, 0.05, 0.4]];
    for gloss in [0.5, 0.9, 0.99] {
        let surface = |own| mirror(gloss).emission(own).expect("in range");
        for degrees in [0.0, 25.0, 70.0] {
            let facing = scene(eye_at(degrees, 0.5, [0.0; 3]), 0.0)
                .shape(floor(0.0, surface(a)))
                .shape(floor(1.0, surface(b)));
            let found = pixel_with(facing, 1e-7);
            for i in 0..3 {
                let expected = (a[i] + gloss * b[i]) / (1.0 - gloss * gloss);
                assert_near(found[i], expected, 1e-6, &format!("gloss {gloss}, {degrees} degrees"));
            }
        }
    }
}

/// Discs that a slanting sun each lights between them: matte parts of
/// (1 - g) c, so A = (cA + g cB) / (1 + g).
#[test]
fn two_facing_mirrors_of_different_colours() {
    let [a, b] = [[0.2, 0.9, 0.5], [1.0, 0.1, 0.4]];
    for gloss in [0.5, 0.9] {
        let surface = |own| {
            let colour = Colour::linear(own).expect("in range");
            Surface::new(colour).gloss(gloss).expect("in range")
        };
        let up = [0.0, 0.0, 1.0];
        let root = 2.0_f64.sqrt();
        let facing = scene(eye([0.0, 0.0, 5.0], [0.0; 3]), 0.0)
            .shape(Shape::disc([0.0; 3], up, 1.0, surface(a)))
            .shape(Shape::disc([0.0, 0.0, 10.0], up, 1.0, surface(b)))
            // At 45 degrees each gives 1 of its sqrt(2), past the other disc.
            .light(Light::sun([1.0, 0.0, -1.0], root))
            .light(Light::sun([0.0, 1.0, 1.0], root));
        let found = pixel_with(facing, 1e-7);
        for i in 0..3 {
            let expected = (a[i] + gloss * b[i]) / (1.0 + gloss);
            assert_near(found[i], expected, 1e-6, &format!("gloss {gloss}"));
        }
    }
}

/// What is left out stays below the cutoff, of a surrounding of display white.
#[test]
fn the_cutoff_is_a_bound_on_what_is_left_out() {
    for cutoff in [0.3, 1e-2, 1e-4, 1e-6] {
        for gloss in [0.5, 0.9] {
            let surface = mirror(gloss).emission([1.0 - gloss; 3]).expect("in range");
            let facing = scene(eye_at(30.0, 0.5, [0.0; 3]), 0.0)
                .shape(floor(0.0, surface))
                .shape(floor(1.0, surface));
            let missing = 1.0 - grey_with(facing, cutoff);
            assert!((-FILM..=cutoff + FILM).contains(&missing), "{cutoff} {gloss}: {missing}");
        }
    }
    for bad in [-1e-9, 1.1, f64::NAN, f64::INFINITY] {
        assert!(Whitted::with_cutoff(bad).is_err(), "{bad}");
    }
    assert_eq!(Whitted::new().cutoff(), 1e-4);
}

/// Nothing is lost, so the ceiling of 10,000 surfaces ends it, and says so.
#[test]
fn perfect_mirrors_end_at_the_ceiling_which_is_counted() {
    let surface = mirror(1.0).emission([0.001; 3]).expect("in range");
    let facing = scene(eye_at(30.0, 0.5, [0.0; 3]), 0.0)
        .shape(floor(0.0, surface))
        .shape(floor(1.0, surface));
    let result = rendered(facing, Whitted::CUTOFF);
    let troubles = result.counts.troubles;
    assert_eq!((troubles.given_up.count, troubles.given_up.first), (1, Some((0, 0))));
    assert_eq!(troubles.media.count + troubles.not_finite.count, 0);
    let found = f64::from(result.film.pixel(0, 0)[0]);
    // 10,000 surfaces after the first, each giving a thousandth.
    assert_near(found, 10.001, 1e-6, "what was summed up");
}

/// Two perfect mirrors that meet at 60 degrees. Unfolded, the ray is a straight
/// line past the edge, which turns by nearly 180 degrees as seen from there: it
/// crosses 3 images of a mirror.
#[test]
fn a_wedge_of_mirrors_reflects_three_times() {
    let [sine, cosine] = sin_cos(60.0);
    for degrees in [5.0, 15.0, 29.0, 44.0, 55.0] {
        for beside in [0.01, -0.01] {
            let [s, c] = sin_cos(degrees);
            let wedge = scene(eye([c, 0.0, s], [-s * beside, 0.0, c * beside]), 1.0)
                .shape(floor(0.0, mirror(1.0)))
                .shape(Shape::plane([0.0; 3], [sine, 0.0, -cosine], mirror(1.0)));
            let result = rendered(wedge, Whitted::CUTOFF);
            assert_eq!(result.counts.reflected, 3, "{degrees} {beside}");
            assert_eq!(result.film.pixel(0, 0), [1.0; 3]);
        }
    }
}

/// Balls of radius 1 with centres 6 apart. An error in y grows by 5 + sqrt(24)
/// at each of them. Expected: the same path with 60 digits, worked out elsewhere.
#[test]
fn a_corridor_between_two_mirror_balls_keeps_thirteen_digits() {
    for (slope, bounce, expected) in
        [(1e-9, 9, 0.206_273_215_027_127_53), (1e-12, 12, 0.200_017_316_793_880_08)]
    {
        let corridor = scene(eye([0.0; 3], [1.0, slope, 0.0]), 0.0)
            .shape(Shape::sphere([3.0, 0.0, 0.0], 1.0, mirror(1.0)))
            .shape(Shape::sphere([-3.0, 0.0, 0.0], 1.0, mirror(1.0)));
        let paths = rays(corridor);
        // The first ray is the eye's own; each later one starts at a bounce.
        assert_near(paths[bounce].origin.y, expected, 1e-13, "y");
    }
}

#[test]
fn a_mirror_that_is_also_black_and_shining_shows_both() {
    let surface = black().gloss(0.25).and_then(|s| s.emission([0.5; 3])).expect("in range");
    let both = scene(eye([2.0, 1.0, 1.0], [0.0; 3]), 2.0).shape(floor(0.0, surface));
    assert_eq!(grey(both), 1.0);
}
