//! What clear surfaces mirror and let through.

use crate::help::{
    FILM, assert_near, eye, eye_at, floor, fresnel, glass, grey, grey_with, largest_difference,
    mirror, picture, scene, shining, sin_cos, slab, white,
};
use lancer_integrator::Whitted;
use lancer_scene::{Camera, Colour, Light, SceneBuilder, Shape, Surface};

/// Glass below, so thick that nothing comes out of it: what is seen of white
/// surroundings is the mirrored part.
#[test]
fn glass_mirrors_what_fresnel_says() {
    let thick = glass(1.5).absorption([1e3; 3]).expect("in range");
    for degrees in [0.0, 10.0, 30.0, 45.0, 60.0, 75.0, 80.0, 89.0] {
        let mirrored = scene(eye_at(degrees, 1.0, [0.0; 3]), 1.0).shape(floor(0.0, thick));
        let expected = fresnel(degrees, 1.0, 1.5);
        assert_near(grey(mirrored), expected, FILM, &format!("{degrees} degrees"));
    }
    // Known numbers: (n-1)^2/(n+1)^2, and half of (5/13)^2 at Brewster's angle.
    let at = |degrees| grey(scene(eye_at(degrees, 1.0, [0.0; 3]), 1.0).shape(floor(0.0, thick)));
    assert_near(at(0.0), 0.04, FILM, "squarely");
    assert_near(at(60.0), 0.089_186_712_8, 1e-7, "60 degrees");
    let brewster = libm::atan(1.5).to_degrees();
    assert_near(at(brewster), (5.0 / 13.0) * (5.0 / 13.0) / 2.0, FILM, "Brewster's angle");
}

/// What is not mirrored goes on: surroundings that are white above and below.
#[test]
fn what_is_mirrored_and_what_goes_on_are_all_there_is() {
    for n in [1.0 / 1.5, 1.000_001, 1.33, 1.5, 2.42, 10.0] {
        for degrees in [0.0, 30.0, 60.0, 85.0, 89.999] {
            for from in [degrees, 180.0 - degrees] {
                let all = scene(eye_at(from, 1.0, [0.0; 3]), 1.0).shape(floor(0.0, glass(n)));
                assert_near(grey(all), 1.0, FILM, &format!("n = {n}, {from} degrees"));
            }
        }
    }
}

/// The eye in the glass, over a black ground: what goes out is seen.
fn out_of(n: f64, degrees: f64) -> SceneBuilder {
    scene(eye_at(180.0 - degrees, 1.0, [0.0; 3]), 1.0)
        .shape(floor(0.0, glass(n)))
        .shape(floor(-5.0, mirror(0.0)))
}

#[test]
fn from_inside_glass_mirrors_what_fresnel_says_and_then_all() {
    for degrees in [0.0, 10.0, 25.0, 40.0, 41.0] {
        let found = grey(out_of(1.5, degrees));
        assert_near(found, 1.0 - fresnel(degrees, 1.5, 1.0), 1e-6, &format!("{degrees}"));
    }
    assert_near(1.0 - grey(out_of(1.5, 40.0)), 0.24529, 1e-4, "a known number");
    assert_near(1.0 - grey(out_of(1.5, 41.0)), 0.37975, 1e-4, "a known number");
    for degrees in [42.0, 60.0, 89.0] {
        assert_eq!(grey(out_of(1.5, degrees)), 0.0, "{degrees}");
    }
}

#[test]
fn the_critical_angle_is_found_to_a_millionth() {
    for n in [1.333, 1.5, 2.42] {
        let (mut low, mut high) = (0.0, 89.0);
        while high - low > 1e-9 {
            let middle = (low + high) / 2.0;
            if grey_with(out_of(n, middle), 1e-6) > 0.0 { low = middle } else { high = middle }
        }
        let found = low.to_radians();
        let expected = libm::asin(1.0 / n);
        assert!((found - expected).abs() < 1e-8, "{n}: {found} {expected}");
    }
}

/// Both faces and all that goes to and fro between them: (1-F)/(1+F).
#[test]
fn a_pane_lets_through_the_sum_of_its_bounces() {
    let bright = || shining([1.0; 3]);
    for (degrees, known) in [(60.0, 0.836_232_462_710_168_3), (0.0, 12.0 / 13.0), (80.0, 0.0)] {
        let f = fresnel(degrees, 1.0, 1.5);
        let through = (1.0 - f) / (1.0 + f);
        if known > 0.0 {
            assert_near(through, known, 1e-14, "a known number");
        }
        for (name, pane) in [
            ("slab", slab(-1.0, 0.0, glass(1.5))),
            ("thin slab", slab(-1e-6, 0.0, glass(1.5))),
            ("sheet", Shape::plane([0.0; 3], [0.0, 0.0, 1.0], glass(1.5).thin())),
            ("sheet the other way", Shape::plane([0.0; 3], [0.0, 0.0, -1.0], glass(1.5).thin())),
        ] {
            let eye = || eye_at(degrees, 2.0, [0.0; 3]);
            let lit = scene(eye(), 0.0).shape(pane.clone()).shape(floor(-2.0, bright()));
            assert_near(grey_with(lit, 1e-8), through, 3e-7, &format!("through the {name}"));
            let dark = scene(eye(), 1.0).shape(pane).shape(floor(-2.0, mirror(0.0)));
            let found = grey_with(dark, 1e-8);
            assert_near(found, 1.0 - through, 3e-7, &format!("mirrored by the {name}"));
        }
    }
    // A film of water: 0.97994 where one of its faces is lost.
    let film = scene(eye_at(0.0, 2.0, [0.0; 3]), 0.0)
        .shape(slab(-4e-5, 0.0, glass(1.33)))
        .shape(floor(-2.0, bright()));
    let f = (0.33 / 2.33) * (0.33 / 2.33);
    assert_near(grey_with(film, 1e-8), (1.0 - f) / (1.0 + f), 3e-7, "a film");
}

#[test]
fn a_sheet_bends_nothing() {
    // Through a wide sheet at 60 degrees a small disc is where it is.
    for target in [[0.0, 0.0, 0.0], [5.0, 0.0, -3.0]] {
        let [x, y, z] = target;
        let small = Shape::disc([x, y, z - 1e-9], [0.0, 0.0, 1.0], 1e-6, shining([1.0; 3]));
        let through = scene(eye_at(60.0, 10.0, target), 0.0)
            .shape(Shape::plane([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], glass(1.5).thin()))
            .shape(small);
        assert_near(grey(through), 0.836_232_462_710_168_3, 1e-6, "through the sheet");
    }
}

/// emission + g mirror + (1-g) (t (F mirror + (1-F) refracted) + (1-t) matte).
#[test]
fn a_surface_is_the_sum_of_its_parts() {
    let colour = Colour::linear([0.5; 3]).expect("in range");
    let parts = Surface { transparency: glass(1.5).transparency, ..Surface::new(colour) };
    let parts = parts.gloss(0.2).and_then(|s| s.transparency(0.7));
    let parts = parts.and_then(|s| s.emission([0.25; 3])).expect("in range");
    let seen = |surface: Surface| {
        scene(eye_at(0.0, 1.0, [0.0; 3]), 2.0)
            .shape(floor(0.0, surface))
            .shape(floor(-1.0, shining([3.0; 3])))
            .light(Light::sun([0.0, 0.0, -1.0], 1.0))
    };
    let bent = 0.04 * 2.0 + 0.96 * 3.0;
    let expected = 0.25 + 0.2 * 2.0 + 0.8 * (0.7 * bent + 0.3 * 0.5);
    assert_near(grey(seen(parts)), expected, 2e-7, "the parts of a solid");
    let f = 2.0 * 0.04 / 1.04;
    let straight = f * 2.0 + (1.0 - f) * 3.0;
    let expected = 0.25 + 0.2 * 2.0 + 0.8 * (0.7 * straight + 0.3 * 0.5);
    assert_near(grey(seen(parts.thin())), expected, 2e-7, "the parts of a sheet");
}

/// A room with colours, mirrors and shadows, and something in it.
fn room(something: &[Shape]) -> SceneBuilder {
    let [sine, cosine] = sin_cos(20.0);
    let mut room = scene(Camera::new([0.0, -6.0, 2.0], [0.0; 3], 4.0, [48, 36]), 0.3)
        .shape(floor(-1.0, white().checker(Colour::RED)))
        .shape(Shape::sphere([1.5, 1.0, 0.0], 1.0, mirror(0.8)))
        .shape(Shape::plane([0.0, 6.0, 0.0], [sine, -cosine, 0.0], white().checker(Colour::BLUE)))
        .light(Light::lamp([-2.0, -3.0, 4.0], 20.0))
        .light(Light::sun([0.3, 0.4, -1.0], 0.5));
    for shape in something {
        room = room.shape(Ok(shape.clone()));
    }
    room
}

#[test]
fn what_bends_like_its_surroundings_cannot_be_seen() {
    let empty = picture(room(&[]), Whitted::CUTOFF);
    for shape in [
        Shape::sphere([-0.3, -0.2, 0.1], 1.0, glass(1.0)),
        Shape::cube([-0.3, -0.2, 0.1], 1.5, glass(1.0)),
        Shape::torus([-0.3, -0.2, 0.1], [0.2, 1.0, 0.1], [0.8, 0.4], glass(1.0)),
        Shape::disc([-0.3, -0.2, 0.1], [0.2, 1.0, 0.1], 1.0, glass(1.0).thin()),
    ] {
        let shape = shape.expect("valid");
        let with_it = picture(room(&[shape]), Whitted::CUTOFF);
        assert!(largest_difference(&with_it, &empty) <= 1e-6);
    }
    // As well visible as it should be, else this shows nothing.
    let shape = Shape::sphere([-0.3, -0.2, 0.1], 1.0, glass(1.01)).expect("valid");
    assert!(largest_difference(&picture(room(&[shape]), Whitted::CUTOFF), &empty) > 0.05);
}

#[test]
fn glass_in_glass_cannot_be_seen() {
    let sea = |something: &[Shape]| {
        let mut sea = scene(Camera::new([0.0, -3.0, 4.0], [0.0; 3], 3.0, [48, 36]), 0.3)
            .shape(floor(1.0, glass(1.5)))
            .shape(floor(-2.0, white().checker(Colour::RED)))
            .light(Light::sun([0.3, 0.4, -1.0], 1.0));
        for shape in something {
            sea = sea.shape(Ok(shape.clone()));
        }
        picture(sea, Whitted::CUTOFF)
    };
    let empty = sea(&[]);
    // Wholly in it, and half out of it: then its upper half is seen.
    let inside = Shape::sphere([0.1, 0.2, -0.3], 1.0, glass(1.5)).expect("valid");
    assert!(largest_difference(&sea(&[inside]), &empty) <= 1e-6);
    let half = Shape::sphere([0.1, 0.2, 0.7], 1.0, glass(1.5)).expect("valid");
    assert!(largest_difference(&sea(&[half]), &empty) > 0.05);
}

#[test]
fn what_shines_is_seen_through_glass() {
    let behind = scene(eye([0.0, -4.0, 0.0], [0.0; 3]), 0.0)
        .shape(Shape::cuboid([-1.0, -0.5, -1.0], [1.0, 0.5, 1.0], glass(1.5)))
        .shape(Shape::sphere([0.0, 3.0, 0.0], 1.0, shining([5.0; 3])));
    // Both faces, squarely, and what goes to and fro.
    assert_near(grey_with(behind, 1e-8), 5.0 * 12.0 / 13.0, 3e-7, "a shining ball");
}
