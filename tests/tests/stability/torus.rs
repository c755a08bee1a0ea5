//! Rings: from afar, touched, as thin as hoops, and without a hole.

use super::asked::{Asked, GREY, assert_near, direction, ray, ulp};
use fastrand::Rng;
use lancer_kernel::Which;
use lancer_math::{Point, Ray, Vector};
use lancer_scene::Shape;

/// Around z.
fn torus(ring: f64, tube: f64) -> Asked {
    Asked::one(Shape::torus([0.0; 3], [0.0, 0.0, 1.0], [ring, tube], GREY))
}

/// Of the quartic with the rounded origin and direction, from 60 digits.
#[test]
fn c6_from_afar() {
    const WAY: [f64; 3] = [-3.0 / 7.0, -2.0 / 7.0, -6.0 / 7.0];
    const CROSSINGS: [(f64, [f64; 2]); 6] = [
        (10.0, [9.767_097_997_943_218, 10.233_973_236_464_443]),
        (100.0, [99.767_097_997_943_21, 100.233_973_236_464_44]),
        (1e3, [999.767_097_997_943_2, 1_000.233_973_236_464_4]),
        (1e4, [9_999.767_097_997_941, 10_000.233_973_236_463]),
        (1e5, [99_999.767_097_997_94, 100_000.233_973_236_46]),
        (1e6, [999_999.767_097_998, 1_000_000.233_973_236_4]),
    ];
    let target = [0.9, 0.1, 0.05];
    for exponent in [-100, -40, 0, 40, 100] {
        let size = libm::scalbn(1.0, exponent);
        let ring = torus(size, 0.25 * size);
        for (distance, expected) in CROSSINGS {
            let eye = std::array::from_fn(|i| (target[i] - WAY[i] * distance) * size);
            let found = ring.ts(&ray(eye, WAY.map(|c| c * size)));
            assert_eq!(found.len(), 2, "{distance}");
            for (found, expected) in found.iter().zip(expected) {
                assert_near(Some(*found), expected, 4.0 * ulp(distance));
            }
        }
    }
}

/// (a) Just below the highest circle of the tube, from 60 digits.
#[test]
fn c7_tangent_from_above() {
    let ring = torus(1.0, 0.25);
    let below = |e: f64| ring.ts(&ray([-3.0, 0.3, 0.25 - e], [1.0, 0.0, 0.0]));
    for (e, outer, inner) in [
        (1e-6, 0.954_680_424_093_402_9, 0.953_197_926_902_299),
        (1e-7, 0.954_173_602_417_702_1, 0.953_704_795_232_363_8),
        (1e-8, 0.954_013_326_088_679_8, 0.953_865_076_226_828_9),
        (1e-9, 0.953_962_641_752_544_5, 0.953_915_761_029_508_6),
    ] {
        let found = below(e);
        assert_eq!(found.len(), 4, "{e}: {found:?}");
        for (found, x) in found.iter().zip([-outer, -inner, inner, outer]) {
            assert_near(Some(found - 3.0), x, 1e-7);
        }
    }
    // Touching: none, or pairs at the two places.
    let touch = 0.91_f64.sqrt();
    for e in [1e-12, 0.0] {
        let found = below(e);
        assert!(found.len().is_multiple_of(2), "{e}: {found:?}");
        assert!(found.iter().all(|t| ((t - 3.0).abs() - touch).abs() < 2e-6), "{e}: {found:?}");
    }
    for e in [-1e-15, -1e-12, -1e-6, -1.0] {
        assert!(below(e).is_empty(), "{e}");
    }
}

/// (b) The equator, (d) a ring without a hole. What touches in its middle is none
/// or a pair.
#[test]
fn c7_equator_and_horn() {
    for exponent in [-100, -40, 0, 40, 100] {
        let size = libm::scalbn(1.0, exponent);
        let equator = ray([-3.0 * size, 0.0, 0.0], [size, 0.0, 0.0]);
        let found = torus(size, 0.25 * size).ts(&equator);
        assert_eq!(found.len(), 4);
        for (found, expected) in found.iter().zip([1.75, 2.25, 3.75, 4.25]) {
            assert_near(Some(*found), expected, 4.0 * ulp(expected));
        }
        let found = torus(size, size).ts(&equator);
        assert!(matches!(found[..], [1.0, 5.0] | [1.0, _, _, 5.0]), "{found:?}");
        for touch in &found[1..found.len() - 1] {
            assert_near(Some(*touch), 3.0, 1e-7);
        }
    }
}

/// (c) From 60 digits, along an oblique line.
#[test]
fn c7_hoops() {
    const CROSSINGS: [(f64, f64, [f64; 4]); 5] = [
        (
            1.0,
            1e-2,
            [
                1.328_117_235_129_107_3,
                1.341_598_726_238_255_8,
                2.498_361_230_472_196_5,
                2.511_923_608_158_440_4,
            ],
        ),
        (
            1.0,
            1e-3,
            [
                1.334_176_453_154_334,
                1.335_524_590_447_756_4,
                2.504_471_369_208_244,
                2.505_827_595_189_665,
            ],
        ),
        (
            1.0,
            1e-4,
            [
                1.334_783_040_361_465_6,
                1.334_917_854_078_992_3,
                2.505_081_741_526_592_7,
                2.505_217_364_112_949_6,
            ],
        ),
        (
            1.0,
            1e-5,
            [
                1.334_843_705_788_551_2,
                1.334_857_187_160_292_1,
                2.505_142_772_396_666_4,
                2.505_156_334_655_29,
            ],
        ),
        (
            1e5,
            0.25,
            [
                133_484.876_129_589_16,
                133_485.213_163_882_67,
                250_514.785_825_033_8,
                250_515.124_881_499_4,
            ],
        ),
    ];
    for (ring, tube, expected) in CROSSINGS {
        let line = ray([3.0 * ring, -0.6 * ring, -0.5 * tube], [-1.5, 0.5, 0.25 * tube / ring]);
        let found = torus(ring, tube).ts(&line);
        assert_eq!(found.len(), 4, "{ring} {tube}: {found:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert_near(Some(*found), expected, 1e-8 * tube);
        }
    }
}

/// (e) A ray that leaves the surface finds what is ahead and not where it is.
#[test]
fn c7_leaving() {
    for (ring, tube) in [(1.0, 0.25), (1.0, 1e-3), (1e5, 0.25)] {
        let shape = torus(ring, tube);
        let mut rng = Rng::with_seed(7);
        let (mut left, mut again) = (0, 0);
        for case in 0..20_000 {
            let (s, c) = lancer_math::sin_cos_degrees(360.0 * rng.f64());
            let around = Vector::new(c, s, 0.0) * ring;
            let target = Point::from(around + direction(&mut rng) * (0.99 * tube));
            let way = direction(&mut rng);
            let to = Ray::new(target - way * (3.0 * ring), way);
            let Some(point) = shape.prepared().nearest(&to, f64::INFINITY) else { continue };
            let point = shape.prepared().expand(&to, &point);
            let out = direction(&mut rng);
            let out = if out.dot(&point.normal) < 0.0 { -out } else { out };
            let leaving = point.leave(out);
            let ahead = shape.prepared().all(&leaving, (0.0, f64::INFINITY), Which::All);
            // From outside pairs are ahead, none of them at once.
            assert!(ahead.len().is_multiple_of(2), "{case}: {ahead:?}");
            let near = 1000.0 * point.error;
            assert!(ahead.iter().all(|hit| hit.t > near), "{case}: {ahead:?} {}", point.error);
            left += 1;
            again += usize::from(!ahead.is_empty());
        }
        assert!(left > 10_000 && (again > 20 || tube < 0.25 * ring), "{left} {again}");
    }
}

/// Lines that touch the innermost circle: along it, where the tube curves away on
/// both sides of it, and across it, through the hole. What touches is none or a pair.
#[test]
fn inner_tangents() {
    for exponent in [-100, -40, 0, 40, 100] {
        let size = libm::scalbn(1.0, exponent);
        let ring = torus(size, 0.25 * size);
        let along = ray([0.75 * size, -4.0 * size, 0.0], [0.0, size, 0.0]);
        let found = ring.ts(&along);
        assert!(matches!(found.len(), 2 | 4), "{found:?}");
        for (t, expected) in [(found[0], 3.0), (found[found.len() - 1], 5.0)] {
            assert_near(Some(t), expected, 4.0 * ulp(5.0));
        }
        for touch in &found[1..found.len() - 1] {
            assert_near(Some(*touch), 4.0, 1e-7);
        }
        let through = ray([0.75 * size, 0.0, -3.0 * size], [0.0, 0.0, size]);
        let found = ring.ts(&through);
        assert!(matches!(found.len(), 0 | 2), "{found:?}");
        for touch in &found {
            assert_near(Some(*touch), 3.0, 1e-7);
        }
        // Beside it, by 2^-30: two crossings at sqrt(e (0.5 - e)), or none.
        let e = libm::scalbn(1.0, -30);
        let beside = |e: f64| ray([(0.75 + e) * size, 0.0, -3.0 * size], [0.0, 0.0, size]);
        let half = (e * (0.5 - e)).sqrt();
        let found = ring.ts(&beside(e));
        assert_eq!(found.len(), 2, "{found:?}");
        assert_near(Some(found[0]), 3.0 - half, 1e-10);
        assert_near(Some(found[1]), 3.0 + half, 1e-10);
        assert!(ring.line(&beside(-e)).is_empty());
    }
}
