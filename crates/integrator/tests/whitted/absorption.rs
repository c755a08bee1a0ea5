//! What media take away (Beer and Lambert), of what is seen and of what lights.

use crate::help::{
    FILM, assert_near, eye, eye_at, floor, fresnel, glass, grey, pixel, pixel_with, scene, shining,
    sin_cos, slab, smoke, white,
};
use lancer_math::{Placement, Vector};
use lancer_scene::{Camera, Group, Light, SceneBuilder, Shadows, Shape};

const SIGMA: [f64; 3] = [0.0, 0.5, 2.0];

/// That a pixel shows exp(-sigma length) times a factor.
#[track_caller]
fn assert_left(found: [f64; 3], length: f64, factor: f64, what: &str) {
    for (found, sigma) in found.into_iter().zip(SIGMA) {
        let expected = factor * libm::exp(-sigma * length);
        assert_near(found, expected, 3e-7, &format!("{what}, sigma {sigma}"));
    }
}

#[test]
fn a_slab_takes_away_by_the_length_of_the_way_through_it() {
    for degrees in [0.0, 30.0, 60.0, 75.0] {
        let seen = scene(eye_at(degrees, 2.0, [0.0; 3]), 1.0).shape(slab(-2.0, 0.0, smoke(SIGMA)));
        let length = 2.0 / sin_cos(degrees)[1];
        assert_left(pixel_with(seen, 1e-9), length, 1.0, &format!("{degrees} degrees"));
    }
}

#[test]
fn slabs_in_series_multiply() {
    let (one, other) = (smoke(SIGMA), smoke([0.25, 0.0, 0.125]));
    for gap in [0.0, 1e-6, 1.0] {
        let seen = scene(eye_at(60.0, 2.0, [0.0; 3]), 1.0).shape(slab(-1.0, 0.0, one)).shape(slab(
            -2.5 - gap,
            -1.0 - gap,
            other,
        ));
        for (i, found) in pixel(seen).into_iter().enumerate() {
            let expected = libm::exp(-2.0 * SIGMA[i] - 3.0 * [0.25, 0.0, 0.125][i]);
            assert_near(found, expected, 3e-7, &format!("gap {gap}"));
        }
    }
}

/// (1-F)^2 a / (1 - F^2 a^2), where a is left after the way once through.
#[test]
fn tinted_glass_takes_away_and_mirrors() {
    let tinted = glass(1.5).absorption(SIGMA).expect("in range");
    let seen = scene(eye_at(0.0, 2.0, [0.0; 3]), 0.0)
        .shape(slab(-0.75, 0.0, tinted))
        .shape(floor(-2.0, shining([1.0; 3])));
    for (found, sigma) in pixel_with(seen, 1e-9).into_iter().zip(SIGMA) {
        let (f, a) = (0.04, libm::exp(-0.75 * sigma));
        let expected = (1.0 - f) * (1.0 - f) * a / (1.0 - f * f * a * a);
        assert_near(found, expected, 3e-7, &format!("sigma {sigma}"));
    }
}

#[test]
fn an_eye_in_a_medium_looks_through_it() {
    let out = |from: SceneBuilder| pixel(from);
    let below = scene(eye_at(180.0, 1.5, [0.0; 3]), 1.0).shape(floor(0.0, smoke(SIGMA)));
    assert_left(out(below), 1.5, 1.0, "out of a sea");
    let below = scene(eye_at(120.0, 1.5, [0.0; 3]), 1.0).shape(floor(0.0, smoke(SIGMA)));
    assert_left(out(below), 1.5, 1.0, "out of a sea, slanting");
    let centre = || scene(eye([0.0; 3], [1.0, 2.0, 3.0]), 1.0);
    let ball = centre().shape(Shape::sphere([0.0; 3], 1.25, smoke(SIGMA)));
    assert_left(out(ball), 1.25, 1.0, "out of a ball");
    let up = || scene(eye([0.1, 0.2, 0.3], [0.1, 0.2, 1.0]), 1.0);
    let cuboid = Shape::cuboid([-1.0, -2.0, -1.0], [1.0, 2.0, 2.0], smoke(SIGMA));
    assert_left(out(up().shape(cuboid)), 1.7, 1.0, "out of a box");
    let ring = Shape::torus([0.1, -0.8, 0.3], [1.0, 0.0, 0.0], [1.0, 0.5], smoke(SIGMA));
    assert_left(out(up().shape(ring)), (2.25_f64 - 1.0).sqrt(), 1.0, "out of a ring");
    // Each of parallel rays starts where it starts.
    let wide = Camera::new([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], 1.0, [3, 1])
        .and_then(|camera| camera.orthographic(6.0));
    let half = Shape::cuboid([1.0, -1.0, -1.0], [3.0, 1.0, 2.0], smoke(SIGMA));
    let film = crate::help::picture(scene(wide, 1.0).shape(half), 1e-6).film;
    let columns = [0, 1, 2].map(|x| film.pixel(x, 0).map(f64::from));
    // Looking up with y upward, x grows to the left.
    assert_left(columns[0], 2.0, 1.0, "a parallel ray that starts inside");
    assert_eq!(columns[1..], [[1.0; 3]; 2]);
}

#[test]
fn what_is_in_a_medium_is_seen_through_it() {
    let sunk = scene(eye_at(60.0, 2.0, [0.0; 3]), 0.0)
        .shape(floor(0.0, smoke(SIGMA)))
        .shape(floor(-0.5, shining([1.0; 3])));
    assert_left(pixel(sunk), 1.0, 1.0, "the ground of a sea");
    // Where it has no end, nothing is left of what it takes away at all.
    let endless = scene(eye_at(60.0, 2.0, [0.0; 3]), 1.0).shape(floor(0.0, smoke(SIGMA)));
    assert_eq!(pixel(endless), [1.0, 0.0, 0.0]);
}

#[test]
fn lengths_are_those_of_the_scene_in_groups_too() {
    let ball = Shape::sphere([0.0; 3], 1.0, smoke(SIGMA)).expect("valid");
    let group = Group::new(None, vec![ball], Vec::new()).expect("few");
    let twice = Placement::scale(Vector::new(1.5, 0.5, 2.0)).expect("it has an inverse");
    let seen = scene(eye([-5.0, 0.0, 0.0], [0.0; 3]), 1.0).group(twice, group.clone());
    assert_left(pixel(seen), 3.0, 1.0, "along x");
    let inside = scene(eye([0.0; 3], [0.0, 0.0, 1.0]), 1.0).group(twice, group);
    assert_left(pixel(inside), 2.0, 1.0, "from inside, along z");
}

/// A white ground under a slab, in the light of a sun from so many degrees; seen
/// from below the slab.
fn ground_under(degrees: f64) -> SceneBuilder {
    let [sine, cosine] = sin_cos(degrees);
    scene(eye([1.0, 0.5, 0.25], [0.0; 3]), 0.0)
        .shape(floor(0.0, white()))
        .light(Light::sun([sine, 0.0, -cosine], 1.0))
}

#[test]
fn shadows_are_tinted_by_the_media_on_the_way() {
    for degrees in [0.0, 45.0, 60.0] {
        let cosine = sin_cos(degrees)[1];
        let smoky = ground_under(degrees).shape(slab(1.0, 1.5, smoke(SIGMA)));
        assert_left(pixel(smoky), 0.5 / cosine, cosine, "smoke");
        // Unbent, with what both faces of a pane mirror at that angle.
        let tinted = glass(1.5).absorption(SIGMA).expect("in range");
        let pane = ground_under(degrees).shape(slab(1.0, 1.5, tinted));
        let f = fresnel(degrees, 1.0, 1.5);
        let left = cosine * (1.0 - f) * (1.0 - f);
        assert_left(pixel(pane), 0.5 / cosine, left, "tinted glass");
        let sheet = Shape::plane([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], glass(1.5).thin());
        let left = cosine * (1.0 - f) / (1.0 + f);
        assert_near(grey(ground_under(degrees).shape(sheet)), left, 3e-7, "a sheet");
    }
    // Light does not pass what is glossy, and only the clear part passes a part.
    let partly = glass(1.0).gloss(0.25).and_then(|s| s.transparency(0.5)).expect("in range");
    let partly = partly.absorption(SIGMA).expect("in range");
    let seen = ground_under(0.0).shape(slab(1.0, 1.5, partly));
    assert_left(pixel(seen), 0.5, (0.75 * 0.5) * (0.75 * 0.5), "two faces that pass 3/8 each");
}

#[test]
fn a_lamp_has_the_media_before_it_and_no_others() {
    let lit = |height: f64| {
        scene(eye([1.0, 0.5, 0.25], [0.0; 3]), 0.0)
            .shape(floor(0.0, white()))
            .shape(slab(1.0, 2.0, smoke(SIGMA)))
            .light(Light::lamp([0.0, 0.0, height], 1.0).map(Light::without_falloff))
    };
    assert_left(pixel(lit(0.5)), 0.0, 1.0, "below");
    assert_left(pixel(lit(1.25)), 0.25, 1.0, "inside");
    assert_left(pixel(lit(4.0)), 1.0, 1.0, "above");
}

/// The ground of a pool: the light passes one face, and then the water.
#[test]
fn the_ground_of_a_pool_is_lit_through_the_water() {
    let water = glass(1.33).absorption(SIGMA).expect("in range");
    for degrees in [0.0, 50.0] {
        let [sine, cosine] = sin_cos(degrees);
        // The eye is in the water, too, at distance 0.3.
        let pool = scene(eye([0.3, 0.0, -1.0], [0.0, 0.0, -1.0 + 1e-9]), 0.0);
        let pool = pool.shape(floor(0.0, water)).shape(Shape::plane(
            [0.0, 0.0, -1.0],
            [1.0, 0.0, 0.0],
            white(),
        ));
        // A wall that faces the sun as far as its angle lets it.
        let lit = pool.light(Light::sun([-cosine, 0.0, -sine], 1.0));
        if sine == 0.0 {
            continue;
        }
        let f = fresnel(90.0 - degrees, 1.0, 1.33);
        let found = pixel(lit);
        assert_left(found, 0.3 + 1.0 / sine, cosine * (1.0 - f), "a wall in the pool");
    }
    // Squarely, from above.
    let pool = scene(eye([0.6, 0.0, -0.2], [0.0, 0.0, -1.0]), 0.0)
        .shape(floor(0.0, water))
        .shape(floor(-1.0, white()))
        .light(Light::sun([0.0, 0.0, -1.0], 1.0));
    let f = (0.33 / 2.33) * (0.33 / 2.33);
    assert_left(pixel(pool), 2.0, 1.0 - f, "the ground of the pool");
}

#[test]
fn opaque_shadows_are_black() {
    for pane in [
        slab(1.0, 1.5, glass(1.5)),
        slab(1.0, 1.5, glass(1.0)),
        Shape::plane([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], glass(1.5).thin()),
    ] {
        assert_eq!(grey(ground_under(30.0).shape(pane.clone()).shadows(Shadows::Opaque)), 0.0);
        assert!(grey(ground_under(30.0).shape(pane).shadows(Shadows::Tinted)) > 0.5);
    }
    let free = ground_under(0.0).shape(slab(-3.0, -2.0, glass(1.5))).shadows(Shadows::Opaque);
    assert_near(grey(free), 1.0, FILM, "what is not on the way");
}
