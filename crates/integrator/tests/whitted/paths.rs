//! Where light goes: the rays themselves, watched by a shape that none meets.

use crate::help::{assert_near, at_height, eye, eye_at, floor, glass, rays, scene, sin_cos, slab};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{InvalidField, SceneBuilder, Shape};

fn ball(radius: f64, ior: f64) -> Result<Shape, InvalidField> {
    Shape::sphere([0.0; 3], radius, glass(ior))
}

/// An eye from which a ray parallel to the x axis passes it at height b.
fn parallel_at(b: f64) -> SceneBuilder {
    scene(eye([-3.0, 0.0, b], [0.0, 0.0, b]), 1.0)
}

/// The angle by which a ray that came along x is turned towards the axis.
fn deviation(ray: &Ray) -> f64 {
    libm::atan2(-ray.direction.z, ray.direction.x)
}

/// Of the rays that have left a ball of that radius around the origin for good,
/// the one that is turned most nearly by that angle; others have been mirrored.
fn turned_by(paths: &[Ray], radius: f64, angle: f64) -> Ray {
    let outside = paths[1..].iter().filter(|ray| {
        let from = ray.origin.coords;
        from.norm() > radius - 1e-10 && from.dot(&ray.direction) > 0.0
    });
    let off = |ray: &Ray| (deviation(ray) - angle).abs();
    *outside.min_by(|a, b| off(a).total_cmp(&off(b))).expect("some leave it")
}

/// Where it meets the x axis.
fn on_axis(ray: &Ray) -> f64 {
    ray.origin.x - ray.origin.z * ray.direction.x / ray.direction.z
}

#[test]
fn a_pane_moves_light_aside_and_does_not_turn_it() {
    let paths = rays(scene(eye_at(60.0, 1.0, [0.0; 3]), 1.0).shape(slab(-1.0, 0.0, glass(1.5))));
    let first = paths[0];
    let shifts = paths.iter().filter(|ray| ray.origin.z < -0.999 && ray.direction.z < 0.0);
    let mut errors = Vec::new();
    for ray in shifts {
        assert!((ray.direction - first.direction).norm() <= 1e-15, "{ray:?}");
        // How far its line is from that of the eye's ray.
        let apart = (ray.origin - first.origin).cross(&first.direction).norm();
        errors.push((apart - 0.512_472_013_191_164_9).abs());
    }
    assert!(errors.len() > 1, "some of it goes to and fro first");
    let least = errors.into_iter().fold(f64::INFINITY, f64::min);
    assert!(least <= 1e-13, "{least}");
}

/// A ball's deviation is twice the bend at a face: 2 (asin b - asin(b/n)), and by
/// symmetry the ray leaves as far from the centre as it came.
#[test]
fn a_ball_lens_bends_as_two_faces_do() {
    for n in [1.33, 1.5, 1.8] {
        for b in [1e-6, 0.1, 0.5, 0.9, 0.999] {
            let expected = 2.0 * (libm::asin(b) - libm::asin(b / n));
            let ray = turned_by(&rays(parallel_at(b).shape(ball(1.0, n))), 1.0, expected);
            let error = (deviation(&ray) - expected).abs();
            assert!(error < 1e-13, "{n} {b}: {error}");
            assert_near(on_axis(&ray), b / libm::sin(expected), 1e-9, "the axis");
        }
    }
    let ray = turned_by(&rays(parallel_at(0.5).shape(ball(1.0, 1.5))), 1.0, 0.3675);
    assert_near(deviation(&ray).to_degrees(), 21.057_558_731_018_6, 1e-14, "known numbers");
    assert_near(on_axis(&ray), 1.391_572_948_889_31, 1e-13, "known numbers");
}

#[test]
fn near_the_axis_a_ball_lens_has_the_focus_of_the_lens_makers() {
    for (radius, n) in [(1.0, 1.5), (2.5, 1.33), (0.25, 1.8)] {
        let b = 0.01 * radius;
        let ray = turned_by(&rays(parallel_at(b).shape(ball(radius, n))), radius, 0.0);
        assert_near(on_axis(&ray), n * radius / (2.0 * (n - 1.0)), 1e-3, "the focus");
    }
}

/// n r sin(angle) is the same on both sides of every face of shells.
#[test]
fn shells_bend_as_their_faces_do() {
    let b = 0.5;
    for thickness in [0.1, 1e-3, 1e-6, 1e-9] {
        let outer = 1.0 + thickness;
        let shells = parallel_at(b).shape(ball(outer, 1.5)).shape(ball(1.0, 1.33));
        let expected = 2.0
            * ((libm::asin(b / outer) - libm::asin(b / (1.5 * outer)))
                + (libm::asin(b / 1.5) - libm::asin(b / 1.33)));
        let ray = turned_by(&rays(shells), outer, expected);
        let error = (deviation(&ray) - expected).abs();
        assert!(error < 1e-13, "{thickness}: {error}");
        if thickness == 0.1 {
            assert_near(deviation(&ray).to_degrees(), 13.569_595_670_389_4, 1e-13, "known");
            let at_4 = ray.origin.z + (4.0 - ray.origin.x) * ray.direction.z / ray.direction.x;
            assert_near(at_4, -0.451_097_304_8, 1e-9, "known");
        }
    }
}

/// The least deviation after one bounce inside a drop: 180 degrees minus the
/// angle of the rainbow.
#[test]
fn a_drop_makes_a_rainbow_where_it_is() {
    let b = {
        // cos i = sqrt((n^2 - 1) / 3).
        let n: f64 = 4.0 / 3.0;
        (1.0 - (n * n - 1.0) / 3.0).sqrt()
    };
    let turned = |b: f64| {
        let paths = rays(parallel_at(b).shape(ball(1.0, 4.0 / 3.0)));
        // All rays of the ball lie in a plane and leave it at known angles: once
        // mirrored inside, it is turned by 180 + 2 i - 4 r.
        let (i, r) = (libm::asin(b), libm::asin(b * 0.75));
        let expected = libm::cos(std::f64::consts::PI + 2.0 * i - 4.0 * r);
        let outside = paths[1..].iter().filter(|ray| ray.origin.coords.dot(&ray.direction) > 0.0);
        let best = outside.min_by(|a, b| {
            (a.direction.x - expected).abs().total_cmp(&(b.direction.x - expected).abs())
        });
        libm::acos(best.expect("some leave it").direction.x).to_degrees()
    };
    assert_near(turned(b), 137.970_341_134_302, 1e-13, "the rainbow");
    assert!(turned(b - 1e-3) > turned(b) && turned(b + 1e-3) > turned(b));
}

/// The way back from the far end: an eye there that looks back along a ray that
/// meets nothing more must send one through the first eye.
fn returns(
    scene_from: impl Fn([f64; 3], [f64; 3]) -> SceneBuilder,
    [eye, at]: [[f64; 3]; 2],
    is_last: impl Fn(&Ray) -> bool,
) {
    let start = Point::from(eye);
    let mut tried = 0;
    for ray in rays(scene_from(eye, at)).iter().filter(|ray| is_last(ray)).take(8) {
        let from = ray.at(1.5);
        let misses = rays(scene_from(from.coords.into(), ray.origin.coords.into()));
        let misses = misses.iter().map(|ray| {
            let to_start = start - ray.origin;
            let ahead = to_start.dot(&ray.direction) > 0.0;
            if ahead { to_start.cross(&ray.direction).norm() } else { f64::INFINITY }
        });
        let least = misses.fold(f64::INFINITY, f64::min);
        assert!(least < 1e-12, "{least}");
        tried += 1;
    }
    assert!(tried > 1);
}

#[test]
fn light_finds_the_way_back_through_layers() {
    // Glass on water, in air: from air into the water and back.
    returns(
        |from, at| {
            scene(eye(from, at), 1.0)
                .shape(slab(-1.0, 0.0, glass(1.5)))
                .shape(floor(-1.0, glass(1.33)))
        },
        [[-0.9, 0.3, 0.8], [0.0; 3]],
        |ray| ray.origin.z < -0.99 && ray.direction.z < 0.0,
    );
    // Glass in water, in air.
    returns(
        |from, at| {
            scene(eye(from, at), 1.0).shape(ball(1.1, 1.33)).shape(Shape::sphere(
                [0.2, -0.1, 0.15],
                0.6,
                glass(1.5),
            ))
        },
        [[-3.0, 0.4, 0.2], [0.0, 0.1, 0.3]],
        |ray| ray.origin.coords.norm() > 1.09 && ray.origin.coords.dot(&ray.direction) > 0.0,
    );
}

/// Bending by an index that is only a little more than 1.
#[test]
fn nearly_the_same_index_bends_a_little() {
    for (e, fraction) in [(1e-6, 1e-5), (1e-9, 1e-6), (1e-12, 1e-3)] {
        let n = 1.0 + e;
        let paths = rays(scene(eye_at(60.0, 1.0, [0.0; 3]), 1.0).shape(floor(0.0, glass(n))));
        let below = paths.iter().rfind(|ray| ray.direction.z < 0.0).expect("it goes on");
        let (a, b) = (paths[0].direction, below.direction);
        let turned = a.cross(&b).norm();
        // What was meant by 1 + e in doubles.
        assert_near(turned, (n - 1.0) * 3.0_f64.sqrt(), fraction, &format!("{e}"));
    }
}

#[test]
fn light_goes_straight_where_nothing_bends_it() {
    let [sine, cosine] = sin_cos(60.0);
    let empty = scene(eye_at(60.0, 1.0, [0.0; 3]), 1.0);
    let sheet = Shape::plane([0.0; 3], [0.1, 0.2, 1.0], glass(1.5).thin());
    let smoke = slab(-3.0, -1.0, glass(1.0));
    let paths = rays(empty.shape(sheet).shape(smoke));
    let along = Vector::new(sine, 0.0, -cosine);
    let onward: Vec<_> = paths.iter().filter(|ray| (ray.direction - along).norm() < 1e-3).collect();
    assert_eq!(onward.len(), 4, "the eye's, after the sheet, in the smoke and below it");
    for ray in onward {
        assert!((ray.direction - along).norm() < 1e-15);
        let [x, y] = at_height(ray, -5.0);
        assert_near(x, 5.0 * 3.0_f64.sqrt(), 1e-13, "x");
        assert!(y.abs() < 1e-13);
    }
}
