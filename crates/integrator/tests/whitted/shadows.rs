//! What keeps light away: everything strictly between a point and its lamp, and
//! nothing else.

use crate::help::{
    FILM, assert_near, black, eye, floor, grey, mirror, picture, pixel, scene, shining, white,
};
use lancer_integrator::Whitted;
use lancer_scene::{InvalidField, Light, SceneBuilder, Shape};

/// A white floor, seen from the side, under a lamp at height 1.
fn under_a_lamp() -> SceneBuilder {
    scene(eye([2.0, 1.0, 0.25], [0.0; 3]), 0.0)
        .shape(floor(0.0, white()))
        .light(Light::lamp([0.0, 0.0, 1.0], 1.0))
}

fn lid(height: f64, radius: f64) -> Result<Shape, InvalidField> {
    Shape::disc([0.0, 0.0, height], [0.0, 0.0, 1.0], radius, black())
}

#[test]
fn what_is_between_hides_the_lamp() {
    for shape in [
        lid(0.5, 0.1),
        Shape::sphere([0.0, 0.0, 0.5], 0.1, black()),
        Shape::cuboid([-0.1, -0.1, 0.4], [0.1, 0.1, 0.6], black()),
        Shape::plane([0.0, 0.0, 0.5], [0.0, 1.0, 1.0], black()),
        Shape::sphere([0.0, 0.0, 0.5], 0.1, mirror(1.0)),
    ] {
        assert_eq!(grey(under_a_lamp().shape(shape.clone())), 0.0, "{shape:?}");
    }
}

#[test]
fn what_is_beside_above_or_below_does_not() {
    for shape in [
        Shape::sphere([0.25, 0.0, 0.5], 0.249, black()),
        lid(1.5, 10.0),
        Shape::sphere([0.0, 0.0, 3.0], 1.0, black()),
        lid(-0.5, 0.1),
        Shape::sphere([0.0, 0.0, -2.0], 1.0, black()),
    ] {
        assert_eq!(grey(under_a_lamp().shape(shape.clone())), 1.0, "{shape:?}");
    }
}

/// The distances differ by 2^-40 of themselves.
#[test]
fn just_behind_the_lamp_is_not_before_it() {
    let little = 1.0 / (1_u64 << 40) as f64;
    assert_eq!(grey(under_a_lamp().shape(lid(1.0 + little, 10.0))), 1.0);
    assert_eq!(grey(under_a_lamp().shape(lid(1.0 - little, 10.0))), 0.0);
    // A sun has nothing behind it.
    let sunny = |height| {
        scene(eye([2.0, 1.0, 0.25], [0.0; 3]), 0.0)
            .shape(floor(0.0, white()))
            .shape(lid(height, 1.0))
            .light(Light::sun([0.0, 0.0, -1.0], 1.0))
    };
    assert_eq!((grey(sunny(1e12)), grey(sunny(-1e-9))), (0.0, 1.0));
}

#[test]
fn a_lamp_in_an_opaque_ball_lights_its_inside_alone() {
    let ball = Shape::sphere([0.0, 0.0, 1.0], 0.5, white());
    assert_eq!(grey(under_a_lamp().shape(ball)), 0.0);
}

/// A disc over the floor, seen from inside the gap. Elsewhere such a floor has
/// been fully lit below 9e-4.
#[test]
fn contact_shadows_are_dark_down_to_the_last_gap() {
    for gap in [1e-1, 1e-3, 9e-4, 1e-6, 1e-9, 1e-12] {
        let lit = |lid: Result<Shape, InvalidField>| {
            scene(eye([0.5, 0.0, gap / 2.0], [0.0; 3]), 0.0)
                .shape(floor(0.0, white()))
                .shape(lid)
                .light(Light::sun([0.0, 0.0, -1.0], 1.0))
        };
        assert_eq!(grey(lit(lid(gap, 1.0))), 0.0, "{gap}");
        assert_eq!(grey(lit(Shape::sphere([0.0, 0.0, 1.0 + gap], 1.0, black()))), 0.0, "{gap}");
        // And the floor does not shade itself.
        assert_eq!(grey(lit(lid(-1.0, 1.0))), 1.0, "{gap}");
    }
}

/// From inside the gap, straight down: the mirror sends the ray up, to the outer
/// ball. Elsewhere it has shown what is inside below 5e-5.
#[test]
fn a_mirror_shows_the_outside_of_what_nearly_touches_it() {
    for gap in [1e-1, 1e-3, 5e-5, 1e-6, 1e-9, 1e-12] {
        let mirrored = scene(eye([0.0, 0.0, gap / 2.0], [0.0; 3]), 0.0)
            .shape(floor(0.0, mirror(1.0)))
            .shape(Shape::sphere([0.0, 0.0, 1.0 + gap], 1.0, shining([1.0, 0.0, 0.0])))
            .shape(Shape::sphere([0.0, 0.0, 1.0 + gap], 0.5, shining([0.0, 1.0, 0.0])));
        assert_eq!(pixel(mirrored), [1.0, 0.0, 0.0], "{gap}");
    }
}

#[test]
fn an_eye_close_to_a_ball_sees_its_near_side() {
    for gap in [1e-1, 5e-5, 1e-9, 1e-12] {
        let from = -(1.0 + gap);
        let near = scene(eye([from, 0.0, 0.0], [0.0; 3]), 0.0).shape(Shape::sphere(
            [0.0; 3],
            1.0,
            black(),
        ));
        let layers = picture(near, Whitted::CUTOFF).layers.expect("asked for");
        // Exact, by Sterbenz: 1 + gap has been rounded before.
        assert_near(f64::from(layers.pixel(0, 0).ray_depth), -from - 1.0, 1e-3, "first hit");
    }
}

/// A ball does not hide its own lit side, however far it is from the origin.
#[test]
fn nothing_shades_itself() {
    for far in [0.0, 1e3, 1e6, 1e8] {
        let from = [far, far - 5.0, far];
        let camera = lancer_scene::Camera::new(from, [far; 3], 2.5, [24, 24]);
        let lit = scene(camera, 0.0)
            .shape(Shape::sphere([far; 3], 1.0, white()))
            .light(Light::lamp(from, 1.0).map(Light::without_falloff));
        let rendered = picture(lit, Whitted::CUTOFF);
        let layers = rendered.layers.expect("asked for");
        for (pixel, layer) in rendered.film.pixels().iter().zip(layers.pixels()) {
            // The lamp is in the eye, so every point that is seen faces it.
            assert_eq!(pixel[0] > 0.0, layer.shape == 1, "{far}: {pixel:?}");
        }
    }
}

#[test]
fn what_shines_lights_nothing() {
    let beside = scene(eye([2.0, 1.0, 0.25], [0.0; 3]), 0.0)
        .shape(floor(0.0, white()))
        .shape(Shape::sphere([0.0, 0.0, 2.0], 1.0, shining([1e6; 3])));
    assert_eq!(grey(beside), 0.0);
    let open = scene(eye([2.0, 1.0, 0.25], [0.0; 3]), 1e6).shape(floor(0.0, white()));
    assert_eq!(grey(open), 0.0);
    // What shines is lit by lamps like anything else.
    let both = white().emission([0.5; 3]).expect("in range");
    let lit = scene(eye([2.0, 1.0, 0.25], [0.0; 3]), 0.0)
        .shape(floor(0.0, both))
        .light(Light::lamp([0.0, 0.0, 2.0], 1.0));
    assert_near(grey(lit), 0.75, FILM, "its own and the lamp's");
}
