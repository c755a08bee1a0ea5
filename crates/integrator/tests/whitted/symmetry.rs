//! What pictures have in common with their mirror images, and with those of
//! scenes that are larger or elsewhere.

use crate::help::{black, floor, glass, mirror, picture, scene, white};
use lancer_integrator::{Rendered, Whitted};
use lancer_scene::{Camera, Checker, Colour, Length, Light, Pattern, Shape, Surface};

/// A picture mirrored left to right, upside down, and both.
fn mirrored(rendered: &Rendered, side: u32) -> [Vec<[u32; 3]>; 4] {
    let bits = |x: u32, y: u32| rendered.film.pixel(x, y).map(f32::to_bits);
    let all = |place: &dyn Fn(u32, u32) -> (u32, u32)| {
        let places = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
        places.map(|(x, y)| place(x, y)).map(|(x, y)| bits(x, y)).collect()
    };
    let last = side - 1;
    [
        all(&|x, y| (x, y)),
        all(&|x, y| (last - x, y)),
        all(&|x, y| (x, last - y)),
        all(&|x, y| (last - x, last - y)),
    ]
}

/// A ball on the axis, of every kind of surface, in a sun from the eye.
#[test]
fn a_symmetric_scene_has_a_symmetric_picture_to_the_bit() {
    for surface in [white(), mirror(0.5), glass(1.5), glass(1.5).thin()] {
        for side in [64, 65] {
            for projection in 0..3 {
                let camera = Camera::new([0.0, -4.0, 0.0], [0.0; 3], 3.0, [side, side]);
                let camera = match projection {
                    0 => camera,
                    1 => camera.and_then(|camera| camera.field_of_view(50.0)),
                    _ => camera.and_then(|camera| camera.orthographic(3.0)),
                };
                let lit = scene(camera, 0.25)
                    .shape(Shape::sphere([0.0; 3], 1.0, surface))
                    .shape(Shape::cube([0.0, 5.0, 0.0], 2.0, white()))
                    .light(Light::sun([0.0, 1.0, 0.0], 1.0))
                    .light(Light::lamp([0.0, -3.0, 0.0], 2.0));
                let rendered = picture(lit, Whitted::CUTOFF);
                let [plain, turned @ ..] = mirrored(&rendered, side);
                for (i, turned) in turned.iter().enumerate() {
                    let differing = plain.iter().zip(turned).filter(|(a, b)| a != b).count();
                    assert_eq!(differing, 0, "{surface:?} {side} {projection} {i}");
                }
                let background = rendered.film.pixel(0, 0);
                assert_eq!(background, [0.25; 3]);
                assert_ne!(rendered.film.pixel(side / 2, side / 2), background);
            }
        }
    }
}

/// Columns and rows that a ball covers are as many on both sides.
#[test]
fn a_ball_on_the_axis_is_in_the_middle() {
    for side in [64, 65] {
        let camera = Camera::new([0.0, -4.0, 0.0], [0.0; 3], 3.0, [side, side]);
        let ball = Shape::sphere([0.0; 3], 1.0, black());
        let layers = picture(scene(camera, 0.25).shape(ball), Whitted::CUTOFF).layers;
        let layers = layers.expect("asked for");
        let lit: Vec<(u32, u32)> = (0..side)
            .flat_map(|y| (0..side).map(move |x| (x, y)))
            .filter(|&(x, y)| layers.pixel(x, y).shape == 1)
            .collect();
        let columns = lit.iter().map(|(x, _)| *x);
        let rows = lit.iter().map(|(_, y)| *y);
        assert_eq!(columns.clone().min().unwrap() + columns.max().unwrap(), side - 1);
        assert_eq!(rows.clone().min().unwrap() + rows.max().unwrap(), side - 1);
    }
}

/// A scene whose coordinates are multiples of 1/64, s times as large and moved.
fn still_life(s: f64, offset: [f64; 3], falloff: bool) -> Rendered {
    let at = |p: [f64; 3]| [0, 1, 2].map(|i| p[i] * s + offset[i]);
    let checkered = |second| {
        let checker = Checker { length: Length::new(s).expect("positive"), ..Checker::new(second) };
        Surface { pattern: Pattern::Checker(checker), ..white() }
    };
    let tinted = glass(1.5).absorption([0.25 / s, 0.5 / s, 1.0 / s]).expect("in range");
    let lamp = |point: [f64; 3], brightness: f64| {
        let brightness = if falloff { brightness * 16.0 * s * s } else { brightness };
        let lamp = Light::lamp(at(point), brightness);
        if falloff { lamp } else { lamp.map(Light::without_falloff) }
    };
    let ground = Shape::plane(at([0.0; 3]), [0.0, 0.0, 1.0], checkered(Colour::RED));
    let camera = Camera::new(at([0.5, -6.0, 3.0]), at([0.0, 0.0, 0.75]), 4.0 * s, [48, 36]);
    let lit = scene(camera, 0.25)
        .shape(ground)
        .shape(Shape::sphere(at([-1.0, 0.5, 0.75]), 0.75 * s, mirror(0.75)))
        .shape(Shape::sphere(at([0.75, -0.5, 0.5]), 0.5 * s, tinted))
        .shape(Shape::cuboid(at([0.0, 1.0, 0.0]), at([1.0, 2.0, 1.5]), checkered(Colour::BLUE)))
        .shape(Shape::cylinder(at([1.5, 0.0, 0.0]), at([1.5, 0.0, 1.0]), 0.25 * s, white()))
        .shape(Shape::torus(
            at([-1.5, -1.5, 0.25]),
            [0.0, 0.0, 1.0],
            [0.5 * s, 0.25 * s],
            glass(1.25),
        ))
        .shape(Shape::triangle(
            [[1.5, 1.5, 0.0], [2.5, 1.0, 0.0], [2.0, 1.5, 1.5]].map(at),
            mirror(0.5),
        ))
        .shape(Shape::disc(at([0.0, -1.0, 0.5]), [1.0, 2.0, 0.5], 0.375 * s, glass(1.5).thin()))
        .light(lamp([-2.0, -3.0, 5.0], 0.75))
        .light(Light::sun([0.5, 0.25, -1.0], 0.5));
    picture(lit, Whitted::CUTOFF)
}

fn bits(rendered: &Rendered) -> Vec<u32> {
    rendered.film.pixels().iter().flatten().map(|v| v.to_bits()).collect()
}

/// Scaling by powers of two is exact, so any number in the engine that does not
/// scale would show.
#[test]
fn a_larger_scene_has_the_same_picture_to_the_bit() {
    for falloff in [false, true] {
        let plain = bits(&still_life(1.0, [0.0; 3], falloff));
        for power in [-100, -40, -1, 3, 40, 100] {
            let scale = libm::ldexp(1.0, power);
            let differing = bits(&still_life(scale, [0.0; 3], falloff));
            let differing = plain.iter().zip(&differing).filter(|(a, b)| a != b).count();
            assert_eq!(differing, 0, "2^{power} {falloff}");
        }
    }
}

/// Moved by a power of two so that all coordinates are exact, all but the points
/// of hits, which are rounded to other places: no pixel changes by as much as the
/// 255th part of white, and hardly any at all.
#[test]
fn a_scene_elsewhere_has_the_same_picture() {
    let plain = still_life(1.0, [0.0; 3], false);
    for power in [4, 10, 20] {
        let far = libm::ldexp(1.0, power);
        for offset in [[far, far, far], [-far, far, 0.0], [0.0, 0.0, -far]] {
            let moved = still_life(1.0, offset, false);
            let pairs = plain.film.pixels().iter().flatten();
            let pairs = pairs.zip(moved.film.pixels().iter().flatten());
            let differing = pairs.filter(|(a, b)| (**a - **b).abs() > 1.0 / 510.0).count();
            assert_eq!(differing, 0, "2^{power} {offset:?}");
        }
    }
}

/// A flat ground is as bright near a far point as near the origin.
#[test]
fn far_from_the_origin_the_ground_has_no_speckles() {
    for far in [0.0, 1e3, 1e6, 1e9] {
        let camera = Camera::new([far, far, 2.0], [far, far + 4.0, 0.0], 4.0, [32, 32]);
        let lit =
            scene(camera, 0.0).shape(floor(0.0, white())).light(Light::sun([0.5, 0.25, -1.0], 1.0));
        let film = picture(lit, Whitted::CUTOFF).film;
        let first = film.pixel(0, 31);
        assert!(film.pixels().iter().all(|p| *p == first || *p == [0.0; 3]), "{far}");
        assert!(film.pixels()[16 * 32..].iter().all(|p| *p == first), "{far}");
    }
}
