//! Spheres: far away, large, touched, from inside, and numbers at the ends of
//! the range of doubles.

use super::asked::{Asked, GREY, assert_near, direction, ray, ulp};
use fastrand::Rng;
use lancer_integrator::engine_by_name;
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{Camera, Scene, Shape};

fn sphere(centre: [f64; 3], radius: f64) -> Asked {
    Asked::one(Shape::sphere(centre, radius, GREY))
}

/// Powers of two by which everything can be multiplied without a rounding.
const SCALES: [i32; 5] = [-300, -40, 0, 40, 300];

fn scaled(v: [f64; 3], exponent: i32) -> [f64; 3] {
    v.map(|c| libm::scalbn(c, exponent))
}

/// The direction is scaled too, so t stays what it is.
#[test]
fn s1_small_and_far() {
    // sqrt(1 - x^2) for x the double 0.9.
    const HALF_CHORD: f64 = 0.435_889_894_354_067_33;
    for exponent in SCALES {
        let scale = |v| scaled(v, exponent);
        let unit = sphere([0.0; 3], libm::scalbn(1.0, exponent));
        for d in [1e3, 1e5, 1e7, 1e8, 1e9] {
            let far = ray(scale([0.9, 0.0, -d]), scale([0.0, 0.0, 1.0]));
            assert_near(unit.t(&far), d - HALF_CHORD, 2.0 * ulp(d));
        }
        let tenth = sphere([0.0; 3], libm::scalbn(0.1, exponent));
        let far = ray(scale([-1e7, 0.095, 0.0]), scale([1.0, 0.0, 0.0]));
        assert_near(tenth.t(&far), 9_999_999.968_775_01, 2.0 * ulp(1e7));
    }
}

/// The same with ball and eye far from the origin of the world: coordinates are
/// rounded there, and what is left of them has the same closed form.
#[test]
fn s1_small_and_far_from_the_origin_too() {
    for offset in [1e3, 1e6, 1e9, 1e12] {
        let unit = sphere([offset; 3], 1.0);
        for d in [1e3, 1e5, 1e7, 1e8, 1e9] {
            let eye = [offset + 0.9, offset, offset - d];
            // Both differences are exact.
            let (aside, back) = (eye[0] - offset, offset - eye[2]);
            let half = ((1.0 - aside) * (1.0 + aside)).sqrt();
            let expected = back - half;
            assert_near(unit.t(&ray(eye, [0.0, 0.0, 1.0])), expected, 2.0 * ulp(d));
        }
    }
}

/// With the sine and the cosine of two degrees as doubles.
#[test]
fn s2_standing_on_a_planet() {
    const SINE: f64 = 0.034_899_496_702_500_97;
    const COSINE: f64 = 0.999_390_827_019_095_8;
    const EXPECTED: f64 = 48.716_634_703_613_64;
    for exponent in SCALES {
        let planet = sphere([0.0; 3], libm::scalbn(6.371e6, exponent));
        let eye = scaled([0.0, 6.371e6 + 1.7, 0.0], exponent);
        let way = scaled([COSINE, -SINE, 0.0], exponent);
        assert_near(planet.t(&ray(eye, way)), EXPECTED, 1e-12 * EXPECTED);
    }
}

#[test]
fn s3_ground_is_a_huge_ball() {
    const EXPECTED: f64 = 0.001_000_000_000_000_050_1;
    for exponent in SCALES {
        let ground = sphere(scaled([0.0, -1e10, 0.0], exponent), libm::scalbn(1e10, exponent));
        let eye = scaled([0.0, 0.001, 0.0], exponent);
        let way = scaled([1.0, -1.0, 0.0], exponent);
        assert_near(ground.t(&ray(eye, way)), EXPECTED, 1e-9 * EXPECTED);
    }
}

/// Primitive Pythagorean triples a^2 + b^2 = c^2 of m below 60.
fn triples() -> Vec<[f64; 3]> {
    let gcd = |mut a: u32, mut b: u32| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    let mut triples = Vec::new();
    for m in 2..60_u32 {
        for n in (1..m).filter(|n| (m - n) % 2 == 1 && gcd(m, *n) == 1) {
            triples.push([m * m - n * n, 2 * m * n, m * m + n * n].map(f64::from));
        }
    }
    triples
}

/// A line that touches crosses twice at one place; where it is rounded, twice or
/// never. Of spheres that grow by a unit in the last place, a first one is
/// met, and all larger ones.
#[test]
fn s4_tangent() {
    let five = sphere([0.0; 3], 5.0);
    assert_eq!(five.ts(&ray([-2.0, -11.0, 0.0], [3.0, 4.0, 0.0])), [2.0, 2.0]);
    let half_epsilon = 0.5 * f64::EPSILON;
    let triples = triples();
    assert_eq!(triples.len(), 721);
    for [a, b, c] in triples {
        for length in [1.0, c] {
            // At (-b, a) the direction (a, b) touches the circle of radius c.
            let d = [a / length, b / length, 0.0];
            let touching = ray([-b - 2.0 * d[0], a - 2.0 * d[1], 0.0], d);
            let distance = touching.origin.coords.norm();
            let mut met = Vec::new();
            for k in -8..=8 {
                let ball = sphere([0.0; 3], c * (1.0 + f64::from(k) * half_epsilon));
                let found = ball.ts(&touching);
                assert!(found.is_empty() || found.len() == 2, "{a} {b} {c}, {k}: {found:?}");
                if k == 0 {
                    let bound = 4.0 * half_epsilon.sqrt() * distance * length / c;
                    assert!(found.iter().all(|t| (t - 2.0).abs() <= bound), "{a} {b}: {found:?}");
                }
                met.push(!found.is_empty());
            }
            let changes = met.windows(2).filter(|pair| pair[0] != pair[1]).count();
            assert!(changes == 1 && met[16], "{a} {b} {c}, {length}: {met:?}");
        }
    }
}

#[test]
fn s5_from_inside() {
    let mut rng = Rng::with_seed(5);
    for exponent in SCALES {
        let size = libm::scalbn(1.0, exponent);
        let ten = sphere([0.0; 3], 10.0 * size);
        let ways: Vec<Vector> = (0..1000).map(|_| direction(&mut rng)).collect();
        let from = |y: f64| -> Vec<Ray> {
            let ray = |way: &Vector| Ray::new(Point::new(0.0, y * size, 0.0), way * size);
            ways.iter().map(ray).collect()
        };
        for (way, hit) in ways.iter().zip(ten.nearest_each(&from(-5.0), f64::INFINITY)) {
            let along = 5.0 * way.y;
            // Of a direction whose length is 1 but for its rounding.
            let squared = way.norm_squared();
            let expected = (along + (along * along + 75.0 * squared).sqrt()) / squared;
            assert_near(hit.map(|hit| hit.t), expected, 1e-14 * expected);
        }
        for (way, hit) in ways.iter().zip(ten.nearest_each(&from(0.0), f64::INFINITY)) {
            assert_near(hit.map(|hit| hit.t), 10.0 / way.norm(), 1e-13);
        }
    }
}

#[test]
fn s6_directions_of_any_length() {
    let unit = sphere([0.0, 0.0, 10.0], 1.0);
    for k in [1e-300, 1e-200, 1e-160, 1.0, 1e150, 1e160, 1e200, 1e300] {
        let t = unit.t(&ray([0.0; 3], [0.0, 0.0, k]));
        assert_near(t.map(|t| t * k), 9.0, 9.0 * 2.0 * f64::EPSILON);
    }
    for d in [[0.0; 3], [f64::NAN, 0.0, 1.0], [0.0, 0.0, f64::INFINITY], [f64::INFINITY; 3]] {
        assert!(unit.nearest(&ray([0.0; 3], d)).is_none(), "{d:?}");
    }
}

/// Spheres whose radius is no positive number are refused. Those whose radius has
/// a square beyond the range of a double are never met.
#[test]
fn s6_radii() {
    for radius in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(Shape::sphere([0.0; 3], radius, GREY).is_err(), "{radius}");
    }
    for radius in [5e-324, 1e-170, 1e-140, 1e-20, 1e20, 1e150, 1e160, f64::MAX] {
        let ball = sphere([0.0; 3], radius);
        let can_be_met = (1e-140..=1e150).contains(&radius);
        for (x, expected) in [(0.0, 9.0), (0.6, 9.2), (-0.8, 9.4), (1.1, f64::NAN)] {
            let through = ray([x * radius, 0.0, -10.0 * radius], [0.0, 0.0, radius]);
            if can_be_met && expected.is_finite() {
                assert_near(ball.t(&through), expected, 4.0 * ulp(10.0));
            } else {
                assert_eq!(ball.t(&through), None, "{radius}");
            }
        }
    }
}

/// Those that are never met are told of, and change nothing about what else is there.
#[test]
fn s6_those_that_are_never_met() {
    let good =
        [Shape::sphere([0.0; 3], 1.0, GREY), Shape::plane([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], GREY)];
    let mut rng = Rng::with_seed(7);
    let rays: Vec<Ray> =
        (0..500).map(|_| Ray::new(Point::new(0.0, 0.0, 3.0), direction(&mut rng))).collect();
    let expected = Asked::new(good.clone()).nearest_each(&rays, f64::INFINITY);
    assert!(expected.iter().flatten().count() > 200);
    let whitted = engine_by_name("whitted").expect("there is such an engine");
    for (radius, is_met) in [(1e-150, false), (1e-140, true), (1e150, true), (1e160, false)] {
        let odd = Shape::sphere([0.0, 0.0, 1e-300], radius, GREY);
        let scene = Scene::builder()
            .camera(Camera::new([0.0, 0.0, 5.0], [0.0; 3], 1.5, [8, 8]))
            .shape(odd.clone())
            .build()
            .expect("valid");
        let warnings = whitted.warnings(&scene);
        assert_eq!(!is_met, warnings.iter().any(|w| w.message.starts_with("shape 1, a sphere,")));
        if !is_met {
            let asked = Asked::new(good.clone().into_iter().chain([odd]));
            assert_eq!(asked.nearest_each(&rays, f64::INFINITY), expected, "{radius}");
        }
    }
}

/// Small spheres and large ones are all of their size: what is seen of them, ray
/// by ray.
#[test]
fn s6_small_ones_are_seen_whole() {
    let mut rng = Rng::with_seed(6);
    let ways: Vec<[f64; 2]> = (0..2000).map(|_| [0, 1].map(|_| 2.4 * rng.f64() - 1.2)).collect();
    let seen = |radius: f64| {
        let rays: Vec<Ray> = ways
            .iter()
            .map(|[x, y]| ray([x * radius, y * radius, -4.0 * radius], [0.0, 0.0, radius]))
            .collect();
        sphere([0.0; 3], radius).nearest_each(&rays, f64::INFINITY)
    };
    let expected = seen(1.0);
    assert!(expected.iter().flatten().count() > 1000);
    for exponent in [-400, -40, -17, 17, 40, 400] {
        assert_eq!(seen(libm::scalbn(1.0, exponent)), expected, "2^{exponent}");
    }
}
