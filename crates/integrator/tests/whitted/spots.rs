//! Spot lamps.

use crate::help::{FILM, assert_near, eye, floor, grey, scene, sin_cos, white};
use lancer_scene::{InvalidField, Light};

fn floor_lit_by(light: Result<Light, InvalidField>) -> f64 {
    let camera = eye([2.0, 1.0, 1.5], [0.0; 3]);
    grey(scene(camera, 0.0).shape(floor(0.0, white())).light(light))
}

/// A spot at distance 1 above the point that is seen, with its axis turned so
/// many degrees away from it: no other factor plays a part.
fn turned(degrees: f64, angles: [f64; 2]) -> f64 {
    let [sine, cosine] = sin_cos(degrees);
    floor_lit_by(Light::spot([0.0, 0.0, 1.0], [3.0 * sine, 0.0, -3.0 * cosine], angles, 0.8))
}

#[test]
fn on_its_axis_a_spot_is_a_lamp() {
    for place in [[0.0, 0.0, 1.0], [0.0, 0.0, 4.0], [1.0, -2.0, 2.0]] {
        let axis = place.map(|c: f64| -c);
        let spot = floor_lit_by(Light::spot(place, axis, [20.0, 40.0], 3.0));
        assert_eq!(spot, floor_lit_by(Light::lamp(place, 3.0)));
        let even = |light: Light| light.without_falloff();
        let spot = floor_lit_by(Light::spot(place, axis, [20.0, 40.0], 3.0).map(even));
        assert_eq!(spot, floor_lit_by(Light::lamp(place, 3.0).map(even)));
    }
}

#[test]
fn a_spot_is_full_inside_its_inner_angle_and_dark_outside_the_outer_one() {
    for degrees in [0.0, 5.0, 19.999, -12.0] {
        assert_near(turned(degrees, [20.0, 40.0]), 0.8, FILM, "inside");
    }
    for degrees in [40.001, 60.0, 90.0, 180.0, -55.0] {
        assert_eq!(turned(degrees, [20.0, 40.0]), 0.0, "{degrees}");
    }
}

#[test]
fn between_the_angles_is_a_smooth_step_of_the_cosine() {
    let [inner, outer] = [sin_cos(20.0)[1], sin_cos(40.0)[1]];
    for degrees in [20.1, 25.0, 30.0, 35.0, 39.9, -30.0] {
        let s = (sin_cos(degrees)[1] - outer) / (inner - outer);
        // 3 s^2 - 2 s^3.
        let expected = 0.8 * (3.0 * s * s - 2.0 * s * s * s);
        assert_near(turned(degrees, [20.0, 40.0]), expected, 1e-6, &format!("{degrees}"));
    }
}

#[test]
fn an_edge_may_be_sharp_and_a_spot_may_shine_everywhere() {
    assert_near(turned(29.999, [30.0, 30.0]), 0.8, FILM, "just inside");
    assert_eq!(turned(30.001, [30.0, 30.0]), 0.0);
    for degrees in [0.0, 90.0, 179.0, 180.0] {
        assert_near(turned(degrees, [180.0, 180.0]), 0.8, FILM, "everywhere");
    }
    assert_eq!(turned(1.0, [0.0, 0.0]), 0.0);
    assert_near(turned(0.0, [0.0, 0.0]), 0.8, FILM, "a beam without a width");
}
