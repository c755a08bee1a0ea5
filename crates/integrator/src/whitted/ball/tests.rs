use super::part::Part;
use super::{Ball, mean_cosine};
use fastrand::Rng;
use lancer_math::Vector;
use lancer_scene::Falloff;
use std::f64::consts::{FRAC_PI_2, PI};

/// The integral from `from` to `to` of a function that may rise like a root at both ends: the
/// double-exponential rule (Takahasi and Mori, 1974).
fn integral(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let step = 1.0 / 32.0;
    let sum: f64 = (-140..=140)
        .map(|k| {
            let t = step * f64::from(k);
            let s = FRAC_PI_2 * libm::sinh(t);
            let cosh = libm::cosh(s);
            let weight = FRAC_PI_2 * libm::cosh(t) / (cosh * cosh);
            weight * f(middle + half * libm::tanh(s))
        })
        .sum();
    sum * half * step
}

/// The projected solid angle over pi, of a ball of half the angle `sigma` whose centre is
/// `height` of its radius above the horizon, from rings around the way to its centre.
fn by_rings(height: f64, sigma: f64) -> f64 {
    let cosine_of_way = height * libm::sin(sigma);
    let sine_of_way = (1.0 - cosine_of_way * cosine_of_way).sqrt();
    let ring = |alpha: f64| {
        let (sine, cosine) = (libm::sin(alpha), libm::cos(alpha));
        let (a, b) = (cosine_of_way * cosine, sine_of_way * sine);
        let sum = if a >= b {
            2.0 * PI * a
        } else if a <= -b {
            0.0
        } else {
            let half = libm::acos(-a / b);
            2.0 * (a * half + b * libm::sin(half))
        };
        sum * sine
    };
    // Where rings begin to be cut.
    let cut = libm::asin(cosine_of_way.abs());
    (integral(0.0, cut, ring) + integral(cut, sigma, ring)) / PI
}

#[test]
fn h5_what_is_above_the_horizon_is_what_rings_add_up_to() {
    for sigma in [1e-4, 1e-3, 0.02, 0.2, 0.24, 0.25, 0.3, 0.7, 1.2, 1.5, 1.57] {
        let (sine, tangent) = (libm::sin(sigma), libm::cos(sigma));
        for i in -19..20 {
            let height = f64::from(i) / 20.0;
            let right = by_rings(height, sigma) / (sine * sine);
            let found = mean_cosine(height, sine, tangent);
            assert!((found - right).abs() < 1e-10 * sine, "{sigma} {height} {found} {right}");
        }
    }
}

/// A formula of another kind for it: the area between ellipse and circle.
#[test]
fn h5_it_is_right_to_the_last_places_for_tiny_and_distant_lamps() {
    let mut rng = Rng::with_seed(1);
    for case in 0..100_000 {
        let height = 2.0 * rng.f64() - 1.0;
        let sine = libm::exp(-21.0 * rng.f64());
        let tangent = ((1.0 - sine) * (1.0 + sine)).sqrt();
        let right = Part::new(height, sine, tangent).mean_cosine();
        let found = mean_cosine(height, sine, tangent);
        // A ball that nearly fills half of all directions has a rim that is hardly known.
        let slack = 40.0 * f64::EPSILON * sine / tangent;
        assert!((found - right).abs() < slack, "{case}: {height} {sine} {found} {right}");
    }
}

#[test]
fn h5_above_the_horizon_it_is_as_a_point_and_below_nothing() {
    let mut rng = Rng::with_seed(2);
    for case in 0..20_000 {
        let mut number = || 2.0 * rng.f64() - 1.0;
        let normal = Vector::new(number(), number(), number()).normalize();
        let way = Vector::new(number(), number(), number());
        let radius = way.norm() * libm::exp(-21.0 * number().abs());
        let ball = Ball::new(way, radius, [normal; 2]);
        let squared = way.norm_squared();
        let (along, cosine) = (way.dot(&normal), way.dot(&normal) / squared.sqrt());
        let (square, none) =
            (ball.strength(3.0, Falloff::Square), ball.strength(3.0, Falloff::None));
        if along >= radius {
            let point = 3.0 * cosine / squared;
            assert!((square / point - 1.0).abs() <= 4.0 * f64::EPSILON, "{case}");
            assert!((none / (3.0 * cosine) - 1.0).abs() <= 4.0 * f64::EPSILON, "{case}");
        } else if along <= -radius {
            assert_eq!((square, none), (0.0, 0.0), "{case}");
        } else {
            assert!(square >= 0.0 && none >= 0.0, "{case}");
            assert!((square * squared - none).abs() <= 4.0 * f64::EPSILON * none, "{case}");
            // Never less than the half above or the mean of the disc.
            let sine = radius / squared.sqrt();
            assert!(none <= 3.0 * sine && none >= 3.0 * cosine * (1.0 - 1e-12), "{case}");
        }
    }
}

/// At the surface of the lamp, at both ends of being cut, and within.
#[test]
fn it_goes_over_into_its_limits() {
    for sine in [1e-9_f64, 1e-3, 0.1, 0.5, 0.99] {
        let tangent = ((1.0 - sine) * (1.0 + sine)).sqrt();
        let whole = mean_cosine(1.0 - 1e-12, sine, tangent);
        assert!((whole / sine - 1.0).abs() < 1e-11, "{sine} {whole}");
        assert!(mean_cosine(-1.0 + 1e-12, sine, tangent) <= 1e-16 * sine, "{sine}");
    }
    for height in [-0.9, -0.2, 0.0, 0.6] {
        let sine = 1.0 - 1e-15_f64;
        let tangent = ((1.0 - sine) * (1.0 + sine)).sqrt();
        let found = mean_cosine(height, sine, tangent);
        // Half of all directions are filled by the lamp, turned against the horizon.
        assert!((found - 0.5 * (1.0 + height)).abs() < 1e-7, "{height} {found}");
    }
    let inside = |way: Vector| Ball::new(way, 2.0, [Vector::z(); 2]);
    for way in [Vector::zeros(), Vector::new(0.5, 0.0, -1.5), Vector::new(0.0, 0.0, 2.0)] {
        assert_eq!(inside(way).strength(8.0, Falloff::Square), 2.0);
        assert_eq!(inside(way).strength(8.0, Falloff::None), 8.0);
    }
    let nowhere = Ball::new(Vector::new(f64::NAN, 0.0, 0.0), 1.0, [Vector::z(); 2]);
    assert_eq!(nowhere.strength(1.0, Falloff::Square), 0.0);
}

/// Balls of all kinds with the normal that sees them, so large that differences can be
/// taken.
fn balls() -> impl Iterator<Item = (usize, Ball, Vector)> {
    let mut rng = Rng::with_seed(3);
    (0..6_000).map(move |case| {
        let mut number = || 2.0 * rng.f64() - 1.0;
        let normal = Vector::new(number(), number(), number()).normalize();
        let aside = normal.cross(&Vector::new(number(), number(), number())).normalize();
        let distance = 1.0 + number().abs();
        let sine = [2e-3, 0.05, 0.4, 0.9, 0.999, 1.7][case % 6];
        let sine = sine * (0.5 + 0.5 * number().abs());
        // Every other one is cut.
        let cosine = if case % 2 == 0 { number() } else { number() * sine.min(1.0) };
        let cosine = if cosine <= -sine { -cosine } else { cosine };
        let way = (normal * cosine + aside * (1.0 - cosine * cosine).max(0.0).sqrt()) * distance;
        (case, Ball::new(way, sine * distance, [normal; 2]), normal)
    })
}

#[test]
fn points_are_on_the_near_side_of_the_lamp_and_above_the_horizon() {
    let mut rng = Rng::with_seed(4);
    for (case, ball, normal) in balls() {
        for _ in 0..4 {
            let to = ball.any_point([rng.f64(), rng.f64()]);
            let from_centre = to - ball.way;
            let off = (from_centre.norm() / ball.radius - 1.0).abs();
            assert!(off < 1e-9, "{case} {off}");
            assert!(to.dot(&normal) > 0.0, "{case}");
            let outward = from_centre.dot(&to) * if ball.is_inside() { -1.0 } else { 1.0 };
            assert!(outward <= 1e-7 * ball.radius * to.norm(), "{case} {outward}");
        }
    }
}

/// Equal areas of numbers are equal projected solid angles, which add up to all that is
/// above the horizon.
#[test]
fn points_are_distributed_as_light_is() {
    let mut rng = Rng::with_seed(5);
    let mut steep = 0;
    for (case, ball, normal) in balls() {
        let all = PI * ball.strength(1.0, Falloff::Square) * (ball.radius * ball.radius);
        let [u, v] = [0.05 + 0.9 * rng.f64(), 0.05 + 0.9 * rng.f64()];
        let step = 1e-5;
        let (ahead, aside, _) = ball.frame();
        assert!((ahead.norm() - 1.0).abs() < 1e-14 && ahead.dot(&normal).abs() < 1e-14, "{case}");
        let flat = |u: f64, v: f64| {
            let direction = ball.any_point([u, v]).normalize();
            [direction.dot(&ahead), direction.dot(&aside)]
        };
        let slope = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|i| (a[i] - b[i]) / (2.0 * step));
        let across = slope(flat(u + step, v), flat(u - step, v));
        let along = slope(flat(u, v + step), flat(u, v - step));
        let density = (across[0] * along[1] - across[1] * along[0]).abs();
        let off = (density / all - 1.0).abs();
        // A crease of the disc's map, or of the part's, may be in between.
        if off > 1e-3 {
            steep += 1;
        }
    }
    assert!(steep < 30, "{steep}");
}

/// Balls too small for differences are cut as larger ones are, in units of their size.
#[test]
fn h5_points_of_tiny_lamps_are_those_of_small_ones() {
    let mut rng = Rng::with_seed(6);
    for case in 0..2_000 {
        let numbers = [rng.f64(), rng.f64()];
        let height = 2.2 * rng.f64() - 1.0;
        let seen = |sine: f64| {
            let cosine = sine * height;
            let way = Vector::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
            let to = Ball::new(way, sine, [Vector::z(); 2]).any_point(numbers);
            assert!(to.z > 0.0, "{case}");
            (to - way) / sine
        };
        let (tiny, small) = (seen(1e-8), seen(1e-6));
        assert!((tiny - small).amax() < 3e-5, "{case} {height} {tiny} {small}");
        // Along the way, one is as good as the other.
        assert!((tiny.norm() - 1.0).abs() < 1e-7, "{case}");
    }
}
