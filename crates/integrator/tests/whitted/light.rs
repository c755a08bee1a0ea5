//! How bright a matte surface is.

use crate::help::{FILM, assert_near, black, eye, floor, grey, pixel, scene, sin_cos, white};
use lancer_scene::{Colour, InvalidField, Light, Shape, Surface};
use std::f64::consts::PI;

/// What a white floor shows at the origin.
fn floor_lit_by(light: Result<Light, InvalidField>) -> f64 {
    let camera = eye([2.0, 1.0, 1.5], [0.0; 3]);
    grey(scene(camera, 0.0).shape(floor(0.0, white())).light(light))
}

/// What that floor shows of a lamp, or of a sun, so many degrees from above.
fn lamp_at(degrees: f64, distance: f64, brightness: f64) -> Result<Light, InvalidField> {
    let [sine, cosine] = sin_cos(degrees);
    Light::lamp([0.0, -distance * sine, distance * cosine], brightness)
}

fn sun_at(degrees: f64, brightness: f64) -> Result<Light, InvalidField> {
    let [sine, cosine] = sin_cos(degrees);
    // Of any length.
    Light::sun([0.0, 7.0 * sine, -7.0 * cosine], brightness)
}

#[test]
fn brightness_is_what_white_shows_from_distance_1() {
    assert_eq!(floor_lit_by(Light::lamp([0.0, 0.0, 1.0], 0.75)), 0.75);
    assert_eq!(floor_lit_by(Light::lamp([0.0, 0.0, 1.0], 40.0)), 40.0);
    assert_eq!(floor_lit_by(Light::sun([0.0, 0.0, -3.0], 0.75)), 0.75);
    assert_eq!(floor_lit_by(Light::sun([0.0, 0.0, -1e-9], 1.0)), 1.0);
}

#[test]
fn light_falls_off_with_the_square_of_the_distance() {
    for distance in [0.125, 0.7, 3.0, 50.0] {
        let found = floor_lit_by(Light::lamp([0.0, 0.0, distance], 2.0));
        assert_near(found, 2.0 / (distance * distance), FILM, "from above");
        let found = floor_lit_by(lamp_at(35.0, distance, 2.0));
        let expected = 2.0 * libm::cos(35.0 * PI / 180.0) / (distance * distance);
        assert_near(found, expected, FILM, "from the side");
    }
}

#[test]
fn light_without_falloff_is_the_same_from_everywhere() {
    for distance in [0.125, 0.7, 3.0, 50.0, 1e9] {
        let lamp = Light::lamp([0.0, 0.0, distance], 2.0).map(Light::without_falloff);
        assert_near(floor_lit_by(lamp), 2.0, FILM, "without falloff");
        let sun = Light::sun([0.0, 0.0, -distance], 2.0).map(Light::without_falloff);
        assert_near(floor_lit_by(sun), 2.0, FILM, "a sun");
    }
}

#[test]
fn a_matte_surface_shows_lamberts_cosine() {
    for degrees in [0.0, 10.0, 30.0, 45.0, 60.0, 75.0, 89.0, 89.999] {
        let expected = 1.5 * sin_cos(degrees)[1];
        // Near 90 degrees the last place of the angle counts.
        let fraction = FILM + 1e-15 / expected;
        assert_near(floor_lit_by(sun_at(degrees, 1.5)), expected, fraction, "sun");
        assert_near(floor_lit_by(lamp_at(degrees, 1.0, 1.5)), expected, fraction, "lamp");
    }
}

#[test]
fn from_below_the_horizon_comes_nothing() {
    for degrees in [90.001, 120.0, 180.0] {
        assert_eq!(floor_lit_by(sun_at(degrees, 1.0)), 0.0, "{degrees}");
        assert_eq!(floor_lit_by(lamp_at(degrees, 1.0, 1.0)), 0.0, "{degrees}");
    }
    // Along the surface, exactly.
    assert_eq!(floor_lit_by(Light::sun([1.0, 0.0, 0.0], 1.0)), 0.0);
    assert_eq!(floor_lit_by(Light::lamp([1.0, 0.0, 0.0], 1.0)), 0.0);
    // In the very point that is seen: no direction, and no NaN.
    assert_eq!(floor_lit_by(Light::lamp([0.0; 3], 1.0)), 0.0);
}

#[test]
fn lights_add_up_and_colours_take_their_share() {
    let camera = || eye([2.0, 1.0, 1.5], [0.0; 3]);
    let lit = |surface: Surface| {
        scene(camera(), 0.0)
            .shape(floor(0.0, surface))
            .light(Light::lamp([0.0, 0.0, 2.0], 1.0))
            .light(sun_at(60.0, 0.5))
    };
    // 1/4 of the lamp and half of a sun of 1/2.
    assert_near(grey(lit(white())), 0.5, FILM, "white");
    let linear = Colour::linear([0.2, 0.5, 1.0]).expect("in range");
    for (found, share) in pixel(lit(Surface::new(linear))).into_iter().zip([0.2, 0.5, 1.0]) {
        assert_near(found, 0.5 * share, FILM, "linear shares");
    }
    // IEC 61966-2-1: code 150 is ((150/255 + 0.055) / 1.055)^2.4 of the light.
    let share = libm::pow((150.0 / 255.0 + 0.055) / 1.055, 2.4);
    assert_near(grey(lit(Surface::new(Colour::GREY))), 0.5 * share, FILM, "sRGB codes");
}

/// Something flat through the origin, with its normal up or down.
type Flat = fn(f64) -> Result<Shape, InvalidField>;

#[test]
fn the_side_that_is_seen_is_lit_whichever_way_the_normal_is_written() {
    let flats: [Flat; 4] = [
        |up| Shape::plane([0.0; 3], [0.0, 0.0, up], white()),
        |up| Shape::disc([0.0; 3], [0.0, 0.0, up], 1.0, white()),
        |up| Shape::rectangle([-1.0, -up, 0.0], [[2.0, 0.0, 0.0], [0.0, 2.0 * up, 0.0]], white()),
        |up| Shape::triangle([[-2.0, -up, 0.0], [2.0, -up, 0.0], [0.0, 2.0 * up, 0.0]], white()),
    ];
    for (i, flat) in flats.into_iter().enumerate() {
        for normal in [1.0, -1.0] {
            for (from, lamp) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let lit = scene(eye([0.4, 0.3, from], [0.0; 3]), 0.0).shape(flat(normal));
                let expected = if from == lamp { 0.25 } else { 0.0 };
                let by_lamp = lit.clone().light(Light::lamp([0.0, 0.0, 2.0 * lamp], 1.0));
                assert_near(grey(by_lamp), expected, FILM, &format!("{i} {normal} {from} {lamp}"));
                let by_sun = lit.light(Light::sun([0.0, 0.0, -lamp], 0.25));
                assert_near(grey(by_sun), expected, FILM, &format!("{i} {normal} {from} {lamp}"));
            }
        }
    }
}

#[test]
fn a_hollow_ball_is_lit_inside_by_what_is_inside() {
    let ball = || Shape::sphere([0.0; 3], 2.0, white());
    let from_inside = || scene(eye([0.5, 0.2, 0.1], [1.0, 2.0, 0.5]), 0.0).shape(ball());
    let lit = from_inside().light(Light::lamp([0.0; 3], 1.0));
    assert_near(grey(lit), 0.25, FILM, "the lamp in the centre");
    assert_eq!(grey(from_inside().light(Light::lamp([5.0, 0.0, 0.0], 1.0))), 0.0);
    assert_eq!(grey(from_inside().light(Light::sun([5.0, 0.0, 0.0], 1.0))), 0.0);
    // And the lamp lights nothing outside.
    let outside = scene(eye([0.0, 9.0, 0.0], [0.0, 4.0, 0.0]), 0.0)
        .shape(ball())
        .shape(Shape::plane([0.0, 5.0, 0.0], [0.0, 1.0, 0.0], white()));
    assert_eq!(grey(outside.light(Light::lamp([0.0; 3], 1.0))), 0.0);
}

#[test]
fn what_is_black_shows_no_light() {
    let lit = scene(eye([2.0, 1.0, 1.5], [0.0; 3]), 0.0).shape(floor(0.0, black()));
    assert_eq!(grey(lit.light(Light::lamp([0.0, 0.0, 1.0], 1.0))), 0.0);
}
