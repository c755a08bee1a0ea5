//! Surfaces that touch, nearly touch, or overlap a little.

use crate::help::{
    FILM, assert_near, at_height, black, eye, eye_at, floor, fresnel, glass, grey, grey_with, rays,
    scene, shining, slab, white,
};
use lancer_scene::{InvalidField, Light, SceneBuilder, Shape, Surface};

/// Glass above water, each 1 thick, from 50 degrees. The water begins `gap` below
/// the glass, or above its lower face where it is negative.
fn glass_on_water(gap: f64, [first, second]: [Surface; 2]) -> SceneBuilder {
    scene(eye_at(50.0, 1.0, [0.0; 3]), 1.0).shape(slab(-1.0, 0.0, first)).shape(slab(
        -2.0 - gap,
        -1.0 - gap,
        second,
    ))
}

/// sin(50 degrees), and the tangents of the angle in glass and in water.
fn tangents() -> [f64; 2] {
    let sine = libm::sin(50.0_f64.to_radians());
    [1.5, 1.33].map(|n| libm::tan(libm::asin(sine / n)))
}

/// n sin(angle) is the same in all layers. Elsewhere the path has been wrong by
/// a quarter where faces overlapped by 5e-5.
#[test]
fn glass_on_water_bends_light_as_two_layers_do() {
    let [in_glass, in_water] = tangents();
    let expected = in_glass + in_water + libm::tan(50.0_f64.to_radians());
    assert_near(expected, 2.4903, 2e-5, "a known number");
    let (a, b) = (glass(1.5), glass(1.33));
    for gap in [0.0, 1e-15, 1e-14, 5e-14, 1e-13, 1e-12, 1e-9, 1e-6, 5e-5, 1e-4, 1e-2] {
        for (gap, surfaces) in
            [(gap, [a, b]), (-gap, [a, b]), (-gap, [a.priority(1), b]), (-gap, [a, b.priority(1)])]
        {
            let paths = rays(glass_on_water(gap, surfaces));
            let below = paths
                .iter()
                .filter(|ray| ray.origin.z < -2.0 - gap + 1e-12 && ray.direction.z < 0.0);
            let misses = below.map(|ray| (at_height(ray, -3.0)[0] - expected).abs());
            let least = misses.fold(f64::INFINITY, f64::min);
            assert!(least <= 10.0 * gap.abs() + 1e-9, "{gap}: {least}");
            if gap == 0.0 {
                assert!(least <= 1e-12, "{least}");
            }
        }
    }
}

/// A small light in the water, where the ray that is bent twice arrives, and none
/// that has been mirrored.
fn light_in_water(gap: f64, radius: f64, surfaces: [Surface; 2]) -> f64 {
    let [in_glass, in_water] = tangents();
    let air = gap.max(0.0) * libm::tan(50.0_f64.to_radians());
    let x = in_glass + air + (1.0 - gap) * in_water;
    let [first, second] = surfaces;
    let lit = scene(eye_at(50.0, 1.0, [0.0; 3]), 0.0)
        .shape(slab(-1.0, 0.0, first))
        .shape(slab(-9.0, -1.0 - gap, second))
        .shape(Shape::disc([x, 0.0, -2.0], [0.0, 0.0, 1.0], radius, shining([1.0; 3])));
    grey_with(lit, 1e-8)
}

#[test]
fn glass_on_water_lets_through_what_two_borders_do() {
    let (a, b) = (glass(1.5), glass(1.33));
    let in_glass = libm::asin(libm::sin(50.0_f64.to_radians()) / 1.5).to_degrees();
    let two = (1.0 - fresnel(50.0, 1.0, 1.5)) * (1.0 - fresnel(in_glass, 1.5, 1.33));
    assert_near(two, 0.938_346_095_2, 1e-9, "a known number");
    for overlap in [0.0, 1e-15, 1e-14, 1e-13, 1e-12, 1e-9, 5e-5] {
        for surfaces in [[a, b], [a.priority(1), b], [a, b.priority(1)]] {
            let found = light_in_water(-overlap, 1e-2, surfaces);
            assert_near(found, two, 2e-7, &format!("overlap {overlap}"));
        }
    }
    // With air between there are three borders.
    let [out, into] = [fresnel(50.0, 1.0, 1.5), fresnel(50.0, 1.0, 1.33)];
    let three = (1.0 - out) * (1.0 - out) * (1.0 - into);
    assert_near(three, 0.858_473_276_5, 1e-9, "a known number");
    assert_near(light_in_water(1e-2, 1e-3, [a, b]), three, 2e-7, "a gap");
    // In a small one what goes to and fro arrives at the same place.
    for gap in [1e-6, 1e-9, 1e-12] {
        let all = three / (1.0 - out * into);
        assert_near(light_in_water(gap, 1e-2, [a, b]), all, 5e-7, &format!("gap {gap}"));
    }
}

/// Of layers one after the other, each with its mirrored part: what goes through
/// both is T1 T2 / (1 - R1 R2), with all that goes to and fro.
fn through(mirrored: &[f64]) -> f64 {
    let (mut t, mut r) = (1.0, 0.0);
    for f in mirrored {
        let once = 1.0 / (1.0 - r * f);
        (t, r) = (t * (1.0 - f) * once, f + (1.0 - f) * (1.0 - f) * r * once);
    }
    t
}

/// A glass tank, filled to the brim: the smaller solid in the larger one, with
/// its upper face in the same plane. From above: air, water, glass, air.
#[test]
fn a_liquid_touches_its_glass() {
    let tank = || Shape::cuboid([-1.0, -1.0, -1.0], [1.0, 1.0, 0.0], glass(1.5));
    let filled = |to| Shape::cuboid([-0.8, -0.8, -0.8], [0.8, 0.8, to], glass(1.33));
    let seen = |shapes: Vec<Result<Shape, InvalidField>>| {
        let mut lit =
            scene(eye([0.0, 0.0, 2.0], [0.0; 3]), 0.0).shape(floor(-2.0, shining([1.0; 3])));
        for shape in shapes {
            lit = lit.shape(shape);
        }
        grey_with(lit, 1e-8)
    };
    let f = |n1: f64, n2: f64| ((n1 - n2) / (n1 + n2)) * ((n1 - n2) / (n1 + n2));
    let brim = through(&[f(1.0, 1.33), f(1.33, 1.5), f(1.5, 1.0)]);
    assert_near(seen(vec![tank(), filled(0.0)]), brim, 3e-7, "filled to the brim");
    assert_near(seen(vec![filled(0.0), tank()]), brim, 3e-7, "in the other order");
    // The last places do not matter, and a liquid may stand out of its glass.
    assert_near(seen(vec![tank(), filled(-1e-17)]), brim, 3e-7, "a rounding below");
    assert_near(seen(vec![tank(), filled(0.1)]), brim, 3e-7, "more than full");
    let under_glass = through(&[f(1.0, 1.5), f(1.5, 1.33), f(1.33, 1.5), f(1.5, 1.0)]);
    assert_near(seen(vec![tank(), filled(-0.1)]), under_glass, 3e-7, "under a lid of glass");
    // Two panes with their faces together are one.
    let (upper, lower) = (slab(-0.5, 0.0, glass(1.5)), slab(-1.0, -0.5, glass(1.5)));
    assert_near(seen(vec![upper, lower]), through(&[0.04, 0.04]), 3e-7, "two panes as one");
}

/// Eight sheets that pass half of the light each. Elsewhere they have been lost
/// where they were nearer together than 1e-4.
#[test]
fn every_sheet_of_a_stack_counts() {
    let half = black().transparency(0.5).expect("in range").thin();
    let half = Surface { medium: glass(1.0).medium, ..half };
    for apart in [1e-2, 1e-4, 1e-6, 1e-9, 1e-12] {
        let stacked = |mut scene: SceneBuilder, at: f64| {
            for i in 0..8 {
                let centre = [0.0, 0.0, at + f64::from(i) * apart];
                scene = scene.shape(Shape::disc(centre, [0.0, 0.0, 1.0], 1.0, half));
            }
            scene
        };
        let seen = stacked(scene(eye([0.0, 0.0, 3.0], [0.0; 3]), 1.0), 0.0);
        assert_eq!(grey(seen), 1.0 / 256.0, "{apart}");
        let slanted = stacked(scene(eye([2.0, 1.0, 1.0], [0.0; 3]), 1.0), 0.0);
        assert_eq!(grey(slanted), 1.0 / 256.0, "{apart}");
        // And in a shadow.
        let shaded = scene(eye([2.0, 1.0, 0.25], [0.0; 3]), 0.0)
            .shape(floor(0.0, white()))
            .light(Light::sun([0.0, 0.0, -1.0], 1.0));
        assert_near(grey(stacked(shaded, 0.5)), 1.0 / 256.0, FILM, "in the shadow");
    }
}

/// A clear box just over the ground, and on it: never the ground's own shadow.
#[test]
fn a_pane_on_the_ground_shows_the_ground() {
    for gap in [1e-2, 7e-5, 1e-6, 1e-12, 0.0] {
        let on_ground = scene(eye([2.0, 1.0, 3.0], [0.0; 3]), 0.0)
            .shape(floor(0.0, white()))
            .shape(Shape::cuboid([-5.0, -5.0, gap], [5.0, 5.0, 0.5], glass(1.0)))
            .light(Light::sun([0.0, 0.0, -1.0], 1.0));
        assert_near(grey(on_ground), 1.0, FILM, &format!("{gap}"));
    }
}

/// Rays that touch a ball in one point: it changes nothing for what is behind.
#[test]
fn what_is_only_touched_hides_nothing() {
    let behind = |ball: Result<Shape, InvalidField>| {
        let along = lancer_scene::Camera::new([1.0, -5.0, 0.0], [1.0, 0.0, 0.0], 1.0, [1, 1]);
        let mut along = scene(along.and_then(|camera| camera.orthographic(1.0)), 0.0);
        for y in [3.0, 5.0] {
            let half = Surface { medium: glass(1.0).medium, ..black() };
            let half = half.transparency(0.5).expect("in range").thin();
            along = along.shape(Shape::disc([1.0, y, 0.0], [0.0, 1.0, 0.0], 1.0, half));
        }
        let smoky = glass(1.0).absorption([0.5; 3]).expect("in range");
        along = along.shape(Shape::cuboid([0.0, 6.0, -1.0], [2.0, 7.0, 1.0], smoky));
        let light = Shape::plane([0.0, 9.0, 0.0], [0.0, 1.0, 0.0], shining([1.0; 3]));
        grey(along.shape(light).shape(ball))
    };
    let alone = 0.25 * libm::exp(-0.5);
    let far = Shape::sphere([50.0, 0.0, 0.0], 1.0, glass(1.0));
    assert_near(behind(far), alone, FILM, "nothing is touched");
    // Exactly: the ball's edge is at x = 1.
    let touched = Shape::sphere([0.0, 0.0, 0.0], 1.0, glass(1.0));
    assert_near(behind(touched), alone, FILM, "a ball is touched");
}

/// The same of light on its way to a shadow.
#[test]
fn what_light_only_touches_shades_nothing() {
    let lit = scene(eye([3.0, 1.0, 1.0], [1.0, 0.0, 0.0]), 0.0)
        .shape(floor(0.0, white()))
        .shape(Shape::sphere([0.0, 0.0, 3.0], 1.0, glass(1.0)))
        .shape(Shape::sphere([1.0, 0.0, 9.0], 0.5, glass(1.0)))
        .light(Light::sun([0.0, 0.0, -1.0], 1.0));
    assert_near(grey(lit), 1.0, FILM, "a ball is touched");
}
