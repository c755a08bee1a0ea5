//! Closed rooms that shine and mirror, and clear things in a white furnace.

use crate::help::{glass, mirror, picture, rendered, scene};
use lancer_integrator::{Engine, RayCounts, Troubles, Whitted};
use lancer_scene::{Camera, InvalidField, SceneBuilder, Shape, Surface};

fn camera() -> Result<Camera, InvalidField> {
    Camera::new([0.3, -0.4, 0.2], [1.0, 0.7, 0.35], 1.5, [8, 8])
}

/// Rooms around the origin, each made in another way.
fn rooms(surface: Surface) -> Vec<(&'static str, SceneBuilder)> {
    let empty = || scene(camera(), 0.0);
    let mut planes = empty();
    let mut rectangles = empty();
    for axis in 0..3 {
        for side in [-2.0, 2.0] {
            let (mut origin, mut normal, mut corner) = ([0.0; 3], [0.0; 3], [-2.0; 3]);
            origin[axis] = side;
            normal[axis] = side;
            corner[axis] = side;
            let mut sides = [[0.0; 3]; 2];
            sides[0][(axis + 1) % 3] = 4.0;
            sides[1][(axis + 2) % 3] = 4.0;
            planes = planes.shape(Shape::plane(origin, normal, surface));
            rectangles = rectangles.shape(Shape::rectangle(corner, sides, surface));
        }
    }
    vec![
        ("ball", empty().shape(Shape::sphere([0.1, 0.2, -0.1], 3.0, surface))),
        ("box", empty().shape(Shape::cuboid([-2.0, -1.0, -1.5], [2.0, 3.0, 1.0], surface))),
        ("planes", planes),
        ("rectangles", rectangles),
    ]
}

/// L = e + rho L, so L = e / (1 - rho); what is left out is at most the cutoff
/// times L.
#[test]
fn a_closed_room_is_as_bright_as_its_series() {
    let surface = mirror(0.9).emission([0.1; 3]).expect("in range");
    for (name, room) in rooms(surface) {
        for pixel in picture(room, 1e-6).film.pixels().iter().flatten() {
            assert!((pixel - 1.0).abs() <= 1.5e-6, "{name}: {pixel}");
        }
    }
    // The last takes some 9,000 surfaces of the 10,000 that there may be.
    for (rho, expected, cutoff) in [(0.5, 0.2, 1e-4), (0.99, 10.0, 1e-4), (0.999, 100.0, 1e-3)] {
        let surface = mirror(rho).emission([0.1; 3]).expect("in range");
        let (name, room) = rooms(surface).swap_remove(1);
        for pixel in picture(room, cutoff).film.pixels().iter().flatten() {
            let missing = 1.0 - f64::from(*pixel) / expected;
            assert!((-1e-6..=cutoff).contains(&missing), "{name} {rho}: {pixel}");
        }
    }
}

/// No light is lost and none goes out: only the ceiling ends it.
#[test]
fn a_room_of_perfect_mirrors_ends_and_says_so() {
    let surface = mirror(1.0).emission([0.1; 3]).expect("in range");
    let (_, room) = rooms(surface).swap_remove(0);
    let result = rendered(room, Whitted::CUTOFF);
    assert_eq!(result.counts.troubles.given_up.count, 64);
    assert_eq!(result.counts.troubles.given_up.first, Some((0, 0)));
    for pixel in result.film.pixels().iter().flatten() {
        assert!((pixel - 1000.1).abs() < 0.01, "{pixel}");
    }
}

fn furnace() -> SceneBuilder {
    scene(Camera::new([0.3, -5.0, 2.0], [0.0; 3], 3.2, [24, 24]), 0.5)
}

fn ball(radius: f64, ior: f64) -> Result<Shape, InvalidField> {
    Shape::sphere([0.0; 3], radius, glass(ior))
}

/// Lossless things in an even surrounding cannot be seen.
#[test]
fn clear_things_vanish_in_a_white_furnace() {
    let clear = glass(1.5);
    let scenes = [
        ("ball", furnace().shape(ball(1.0, 1.5))),
        ("dense ball", furnace().shape(ball(1.0, 2.42))),
        ("bubble in glass", furnace().shape(ball(1.0, 0.75))),
        ("box", furnace().shape(Shape::cube([0.0; 3], 1.6, clear))),
        ("ring", furnace().shape(Shape::torus([0.0; 3], [0.3, 0.2, 1.0], [0.9, 0.4], clear))),
        ("cone", furnace().shape(Shape::cone([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 1.0, clear))),
        ("shells", furnace().shape(ball(1.2, 1.5)).shape(ball(1.1, 1.33)).shape(ball(0.7, 1.8))),
        ("sheet", furnace().shape(Shape::disc([0.0; 3], [0.2, -1.0, 0.5], 1.0, clear.thin()))),
        ("ball on glass", {
            let ground = Shape::plane([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], glass(1.33));
            furnace().shape(ball(1.0, 1.5)).shape(ground)
        }),
    ];
    for (name, furnace) in scenes {
        let furnace_off = |cutoff: f64| {
            let film = picture(furnace.clone(), cutoff).film;
            let values = film.pixels().iter().flatten();
            values.map(|v| (f64::from(*v) - 0.5).abs()).fold(0.0, f64::max)
        };
        // What is left out, of a surrounding that is half as bright as white.
        let worst = furnace_off(Whitted::CUTOFF);
        assert!(worst <= 0.5 * Whitted::CUTOFF + 1e-7, "{name}: {worst}");
        if ["ball", "box", "ring", "cone"].contains(&name) {
            let worst = furnace_off(1e-7);
            assert!(worst <= 1e-7, "{name}, summed up: {worst}");
        }
    }
}

/// Between two balls that overlap some light stays for so long, and is split so
/// often, that no number of rays would do: what is missing is said.
#[test]
fn where_light_is_missing_in_a_furnace_it_is_said() {
    let beside = Shape::sphere([0.5, 0.0, 0.3], 0.8, glass(1.33));
    let overlap = furnace().shape(ball(0.9, 1.5)).shape(beside).build().expect("valid");
    let engine = Whitted::new();
    let tracer = engine.prepare(&overlap, &lancer_integrator::Plan::default());
    let mut given_up = 0;
    for (x, y) in (0..24).flat_map(|y| (0..24).map(move |x| (x, y))) {
        let mut counts = RayCounts::default();
        let [red, _, _] = tracer.pixel(x, y, &mut counts);
        let missing = 0.5 - f64::from(red);
        if counts.troubles == Troubles::default() {
            assert!((-1e-7..=0.5 * Whitted::CUTOFF + 1e-7).contains(&missing), "{x} {y}");
        } else {
            assert!(missing > 0.0 && counts.troubles.given_up.first == Some((x, y)));
            given_up += 1;
        }
    }
    assert!(given_up <= 5, "{given_up} of 576");
}
