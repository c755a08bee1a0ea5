//! D1 to D3: what a clear surface does to a ray. What a film of single precision cannot
//! show is tested beside the formulas, under the same names.

use crate::pictures::{
    FILM, U, assert_near, black, built, eye, floor, glass, middle_with, rays, scene, shining,
};
use lancer_math::{Ray, Vector};
use lancer_scene::{Camera, InvalidField, Shape};

/// A camera of one pixel that sees the origin at so many radians from the vertical:
/// from above, or from below where `side` is -1.
fn eye_at(radians: f64, side: f64) -> Result<Camera, InvalidField> {
    eye([-libm::sin(radians), 0.0, side * libm::cos(radians)], [0.0; 3])
}

/// What of the light above glass is seen from in it.
fn passes(camera: Result<Camera, InvalidField>, ior: f64) -> f64 {
    let below = scene(camera, 0.0).shape(floor(0.0, glass(ior))).shape(floor(1.0, shining(1.0)));
    middle_with(&built(below), 1e-9)
}

/// Pass: F is 1 from the critical angle on, rises monotonically up to it, and just before
/// it 1 - F is 8.693 times the root of the angle that is left. Never NaN.
#[test]
fn d1_light_leaves_glass_up_to_the_critical_angle() {
    let critical = 0.729_727_656_226_966_4;
    for (before, expected) in [
        (1e-3, 0.236_358_812_164_235_2),
        (1e-6, 8.650_413_258_621_546e-3),
        (1e-9, 2.748_731_541_387_211e-4),
        (1e-12, 8.693_580_585_144_332e-6),
    ] {
        // The angle itself is known to within 1e-16 or so.
        let slack = FILM + 2e-16 / before;
        let found = passes(eye_at(critical - before, -1.0), 1.5);
        assert_near(found, expected, slack, &format!("{before} before"));
        assert_eq!(passes(eye_at(critical + before, -1.0), 1.5), 0.0, "{before} after");
    }
    // A sweep across it, step by step of doubles. A direction is rounded by as much as
    // these steps, which the root makes 1e-7.
    for ior in [1.31, 1.33, 1.5, 1.7, 2.0, 2.42] {
        let sine: f64 = 1.0 / ior;
        let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
        let mut last = 1.0;
        let mut x: f64 = (0..60).fold(sine, |x: f64, _| x.next_down());
        for _ in 0..120 {
            let through = passes(eye([-x, 0.0, -cosine], [0.0; 3]), ior);
            assert!(through <= last + 1e-7 && through < 2e-6, "{ior}: {through} after {last}");
            (last, x) = (through, x.next_up());
        }
        assert_eq!(last, 0.0, "{ior}");
    }
}

/// The values are those of Fresnel's own form, sines and tangents of both angles, with 60
/// digits. Elsewhere an approximation gives 0.07 at 60 degrees, and 0.04067 from inside
/// at 40.
#[test]
fn d2_glass_mirrors_what_fresnel_says() {
    let brewster = libm::atan(1.5).to_degrees();
    for (degrees, expected) in [
        (0.0_f64, 0.04),
        (30.0, 0.041_522_625_975_821_54),
        (45.0, 0.050_239_911_012_235_94),
        (brewster, 0.073_964_497_041_420_12),
        (60.0, 0.089_186_712_802_212_78),
        (80.0, 0.387_704_354_691_472_7),
    ] {
        let on_glass = scene(eye_at(degrees.to_radians(), 1.0), 1.0)
            .shape(floor(0.0, glass(1.5)))
            .shape(floor(-1.0, black()));
        let found = middle_with(&built(on_glass), 1e-9);
        assert_near(found, expected, FILM, &format!("{degrees} degrees"));
    }
    for (degrees, expected) in
        [(0.0_f64, 0.04), (40.0, 0.245_291_204_286_910_35), (41.0, 0.379_751_265_962_44)]
    {
        let found = passes(eye_at(degrees.to_radians(), -1.0), 1.5);
        assert_near(found, 1.0 - expected, FILM, &format!("{degrees} degrees, from inside"));
    }
}

/// What comes in at an angle goes out at the angle of the other side: as much is mirrored
/// of either.
#[test]
fn d2_glass_mirrors_the_same_both_ways() {
    for degrees in [10.0_f64, 30.0, 50.0, 70.0, 85.0] {
        let inside = libm::asin(libm::sin(degrees.to_radians()) / 1.5);
        let on_glass = scene(eye_at(degrees.to_radians(), 1.0), 1.0)
            .shape(floor(0.0, glass(1.5)))
            .shape(floor(-1.0, black()));
        let from_above = middle_with(&built(on_glass), 1e-9);
        let from_below = 1.0 - passes(eye_at(inside, -1.0), 1.5);
        assert!((from_above - from_below).abs() <= 2.0 * FILM, "{degrees}");
    }
}

/// The rays that go on downward from below that height.
fn below(paths: &[Ray], height: f64) -> Ray {
    let is_below = |ray: &&Ray| ray.direction.z < 0.0 && ray.origin.z <= height;
    *paths.iter().find(is_below).expect("there is one")
}

/// Pass: the deviation e tan(60 degrees) to 1e-3 at e = 1e-12.
#[test]
fn d3_indices_that_nearly_match_bend_a_little() {
    let sixty = 60.0_f64.to_radians();
    for (apart, fraction) in [(1e-6, 1e-3), (1e-9, 1e-3), (1e-12, 1e-3), (1e-15, 0.5)] {
        let ior = 1.0 + apart;
        let paths = rays(scene(eye_at(sixty, 1.0), 0.0).shape(floor(0.0, glass(ior))));
        let (into, onward) = (paths[0].direction, below(&paths, 0.0).direction);
        let bent = into.cross(&onward).norm();
        assert_near(bent, (ior - 1.0) * 3.0_f64.sqrt(), fraction, &format!("{apart}"));
    }
    // No difference bends nothing, to the bit.
    let paths = rays(scene(eye_at(sixty, 1.0), 0.0).shape(floor(0.0, glass(1.0))));
    assert_eq!(paths[0].direction, below(&paths, 0.0).direction);
}

/// Pass: the direction to 4 u, the shift to 1e-14, and the light with all that goes to
/// and fro to the last place of a film.
#[test]
fn d3_a_parallel_slab_shifts_and_does_not_bend() {
    let sixty = 60.0_f64.to_radians();
    // Rays leave by a bound on their error, which goes by the size of the box.
    let slab = || Shape::cuboid([-2.0, -2.0, -1.0], [2.0, 2.0, 0.0], glass(1.5));
    let paths = rays(scene(eye_at(sixty, 1.0), 0.0).shape(slab()));
    let (into, out) = (paths[0], below(&paths, -1.0));
    assert!((into.direction - out.direction).norm() <= 4.0 * U, "{:?}", out.direction);
    let apart: Vector = out.origin - into.origin;
    assert_near(apart.cross(&into.direction).norm(), 0.512_472_013_191_164_9, 1e-14, "shift");
    for (angle, expected) in [(sixty, 0.836_232_462_710_168_3), (0.0, 12.0 / 13.0)] {
        let lit = scene(eye_at(angle, 1.0), 0.0).shape(slab()).shape(floor(-2.0, shining(1.0)));
        assert_near(middle_with(&built(lit), 1e-9), expected, FILM, "all that passes");
    }
}
