//! Spheres.
//!
//! From the point of the ray that is nearest to the centre, where the
//! quadratic has no linear term to cancel ([`Near`]): with p that point and d
//! the direction, the crossings are at -+sqrt((r - |p|)(r + |p|)) / |d| from it
//! (Haines, Günther and Akenine-Möller, *Ray Tracing Gems*, 2019, chapter 7).
//!
//! Of an origin that is near to the surface compared with the radius, the nearer
//! crossing is the small difference of two large numbers. There it is c over the
//! product of |d|^2 with the farther one, where c = |o|^2 - r^2 from the centre
//! is summed up with what each rounding loses: so it has about all its digits, and
//! its sign says exactly on which side of the surface the origin is.
//!
//! Touching (|p| = r) counts as two crossings at one place. A radius or a distance
//! whose square is no number is beyond what can be met.

use super::exact::{two_product, two_sum};
use crate::Crossing;
use crate::checker;
use crate::crossing::Crossings;
use crate::near::{Near, stepped};
use crate::primitive::{Cell, Contact, Primitive};
use lancer_math::{Bounds, Point, Ray, Vector};
use lancer_scene::{Checker, Sphere};

#[derive(Debug)]
pub(crate) struct Ball {
    centre: Point,
    radius: f64,
}

impl Ball {
    pub(crate) fn new(sphere: &Sphere) -> Self {
        Self { centre: sphere.centre.get(), radius: sphere.radius.get() }
    }

    /// From its numbers, as [`numbers`](Self::numbers) gives them.
    #[inline]
    pub(crate) fn at(centre: [f64; 3], radius: f64) -> Self {
        Self { centre: Point::from(centre), radius }
    }

    /// Its centre and radius.
    pub(crate) fn numbers(&self) -> ([f64; 3], f64) {
        (self.centre.coords.into(), self.radius)
    }

    /// The squared distance of a point from the centre minus that of the surface.
    fn excess(&self, point: &Point) -> f64 {
        let (square, square_lost) = two_product(self.radius, self.radius);
        let (mut sum, mut lost) = (-square, -square_lost);
        for axis in 0..3 {
            let (off, off_lost) = two_sum(point[axis], -self.centre[axis]);
            let (square, square_lost) = two_product(off, off);
            let (next, next_lost) = two_sum(sum, square);
            sum = next;
            lost += next_lost + (square_lost + 2.0 * off * off_lost);
        }
        sum + lost
    }
}

impl Primitive for Ball {
    #[inline]
    fn crossings(&self, ray: &Ray) -> Crossings {
        let near = Near::around(ray, &self.centre, 0.5 * self.radius);
        // What is left along the ray, all of it where the origin was not moved.
        let d2 = near.direction.norm_squared();
        let inverse = 1.0 / d2;
        let along = near.origin.dot(&near.direction) * inverse;
        let p = (near.origin - near.direction * along).norm();
        let under_root = (self.radius - p) * (self.radius + p);
        let mut crossings = Crossings::NONE;
        // Not for NaN either.
        if under_root >= 0.0 {
            let half = (under_root * inverse).sqrt();
            let middle = near.shift - along;
            let far = middle + half.copysign(middle);
            let close = if half > 0.5 * middle.abs() {
                self.excess(&ray.origin) / (d2 * far)
            } else {
                middle - half.copysign(middle)
            };
            crossings.add(far * near.unit, 0);
            crossings.add(close * near.unit, 0);
        }
        crossings
    }

    /// The direction from the centre has a length of 1 to within 4 u (u is half
    /// of EPSILON), its product with the radius is rounded, and the sum with the
    /// centre: 6 u of the radius and u of the centre, and here more.
    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let from_centre = stepped(&ray.origin, &self.centre, crossing.t, &ray.direction);
        let normal = from_centre / from_centre.norm();
        Contact {
            point: self.centre + normal * self.radius,
            error: 4.0 * f64::EPSILON * (self.centre.coords.amax() + self.radius),
            normal,
            shading: normal,
        }
    }

    fn cell(&self, contact: &Contact, _part: u32, checker: &Checker) -> Cell {
        let n = contact.normal;
        let angle = checker.angle.get();
        let latitude = libm::atan2(n.z, libm::hypot(n.x, n.y)).to_degrees();
        checker::cell(checker::turn(n.x, n.y) / angle, latitude / angle)
    }

    fn bounds(&self) -> Option<Bounds> {
        let reach = Vector::repeat(self.radius * (1.0 + f64::EPSILON));
        let slack = Vector::repeat(self.centre.coords.amax() * f64::EPSILON);
        Some(Bounds { min: self.centre, max: self.centre }.grown(reach + slack))
    }

    fn contains(&self, point: &Point) -> bool {
        self.excess(point) < 0.0
    }

    fn volume(&self) -> f64 {
        4.0 / 3.0 * std::f64::consts::PI * self.radius * self.radius * self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{
        Double, between, check_leaving, check_pairs, check_scaling, direction, dot, ray, ray_to,
        ts, worst_error,
    };
    use super::*;
    use fastrand::Rng;

    fn ball(x: f64, y: f64, z: f64, radius: f64) -> Ball {
        Ball { centre: Point::new(x, y, z), radius }
    }

    fn ulp(x: f64) -> f64 {
        x.next_up() - x
    }

    /// Atlas S1.
    #[test]
    fn a_small_ball_far_away() {
        for d in [1e3, 1e5, 1e7, 1e8, 1e9] {
            let found = ts(&ball(0.0, 0.0, 0.0, 1.0), &ray([0.9, 0.0, -d], [0.0, 0.0, 1.0]));
            let expected = d - 0.435_889_894_354_067_33;
            assert!((found[0] - expected).abs() <= 2.0 * ulp(d), "{d}: {found:?}");
        }
        let found = ts(&ball(0.0, 0.0, 0.0, 0.1), &ray([-1e7, 0.095, 0.0], [1.0, 0.0, 0.0]));
        assert!((found[0] - 9_999_999.968_775_01).abs() <= 2.0 * ulp(1e7), "{found:?}");
    }

    /// Atlas S2 and S3: a person on a planet.
    #[test]
    fn near_the_surface_of_a_large_ball() {
        let r = 6.371e6;
        let (s, c) = lancer_math::sin_cos_degrees(2.0);
        let found = ts(&ball(0.0, 0.0, 0.0, r), &ray([0.0, r + 1.7, 0.0], [c, -s, 0.0]));
        let error = found[0] / 48.716_634_703_613_64 - 1.0;
        assert!(error.abs() <= 1e-12, "{error:e}");

        let found = ts(&ball(0.0, -1e10, 0.0, 1e10), &ray([0.0, 0.001, 0.0], [1.0, -1.0, 0.0]));
        let error = found[0] / 0.001_000_000_000_000_05 - 1.0;
        assert!(error.abs() <= 1e-9, "{error:e}");
    }

    /// Atlas S4: all primitive triples, as they are and with unit directions.
    #[test]
    fn touching_rays_have_a_pair_or_none() {
        let five = ball(0.0, 0.0, 0.0, 5.0);
        assert_eq!(ts(&five, &ray([-2.0, -11.0, 0.0], [3.0, 4.0, 0.0])), [2.0, 2.0]);
        let gcd = |mut a: u32, mut b: u32| {
            while b > 0 {
                (a, b) = (b, a % b);
            }
            a
        };
        let mut triples = 0;
        for m in 2..60_u32 {
            for n in (1..m).filter(|n| (m - n) % 2 == 1 && gcd(m, *n) == 1) {
                triples += 1;
                let [a, b, c] = [m * m - n * n, 2 * m * n, m * m + n * n].map(f64::from);
                // At (-b, a) the direction (a, b) touches the circle of radius c.
                for length in [1.0, c] {
                    let d = [a / length, b / length, 0.0];
                    let o = [-b - 2.0 * d[0], a - 2.0 * d[1], 0.0];
                    let size = libm::hypot(o[0], o[1]);
                    let mut changes = 0;
                    let mut met = true;
                    for k in (-8..=8).rev() {
                        let radius = c * (1.0 + f64::from(k) * 0.5 * f64::EPSILON);
                        let found = ts(&ball(0.0, 0.0, 0.0, radius), &ray(o, d));
                        assert!(found.is_empty() || found.len() == 2, "{found:?}");
                        // Of a larger radius they are half a chord away.
                        let factor = if k > 0 { 8.0 } else { 4.0 };
                        let bound = factor * (0.5 * f64::EPSILON).sqrt() * size;
                        let speed = c / length;
                        assert!(found.iter().all(|t| (t - 2.0).abs() * speed <= bound));
                        changes += usize::from(met == found.is_empty());
                        met = !found.is_empty();
                    }
                    assert_eq!((changes, met), (1, false), "{a} {b} {c}");
                }
            }
        }
        assert_eq!(triples, 721);
    }

    /// Atlas S5.
    #[test]
    fn from_inside_there_is_one_ahead() {
        let ten = ball(0.0, 0.0, 0.0, 10.0);
        let mut rng = Rng::with_seed(5);
        for case in 0..1000 {
            let d = direction(&mut rng);
            let found = ten.nearest(&Ray::new(Point::new(0.0, -5.0, 0.0), d), f64::INFINITY);
            let along = -5.0 * d.y;
            let expected = -along + (along * along + 75.0 * d.norm_squared()).sqrt();
            let error = found.unwrap().t * d.norm_squared() / expected - 1.0;
            assert!(error.abs() <= 1e-14, "case {case}: {error:e}");
            let found = ten.nearest(&Ray::new(Point::origin(), d), f64::INFINITY).unwrap().t;
            assert!((found / 10.0 - 1.0).abs() <= 1e-14, "case {case}: {found}");
        }
    }

    /// Atlas S6.
    #[test]
    fn directions_and_radii_of_any_size() {
        for k in [1e-200, 1e-160, 1.0, 1e150, 1e160, 1e200] {
            let found = ts(&ball(0.0, 0.0, 10.0, 1.0), &ray([0.0; 3], [0.0, 0.0, k]));
            assert!((found[0] * k / 9.0 - 1.0).abs() <= 2.0 * f64::EPSILON, "{k}: {found:?}");
        }
        let none = ray([0.0; 3], [0.0; 3]);
        assert!(ts(&ball(0.0, 0.0, 10.0, 1.0), &none).is_empty());
        let not = ray([0.0; 3], [0.0, f64::NAN, 1.0]);
        assert!(ts(&ball(0.0, 0.0, 10.0, 1.0), &not).is_empty());
    }

    /// Atlas H1, at several distances from the origin.
    #[test]
    fn rays_leave_the_surface_they_start_from() {
        for s in [0.0, 1e3, 1e6, 1e8, 1e10] {
            for radius in [1.0, 0.3, 700.0] {
                let mut rng = Rng::with_seed(11);
                let shape = ball(s, -s, 0.5 * s, radius);
                let mut aim = Rng::with_seed(12);
                let rays = (0..20_000).map(|_| {
                    let target = shape.centre + direction(&mut aim) * (radius * aim.f64());
                    ray_to(&mut aim, &target, radius)
                });
                let wrong = check_leaving(&shape, true, &mut rng, rays);
                assert_eq!(wrong, 0, "at {s}, radius {radius}");
            }
        }
    }

    #[test]
    fn crossings_come_in_pairs_and_contacts_are_on_the_surface() {
        let mut rng = Rng::with_seed(3);
        for shape in [ball(0.0, 0.0, 0.0, 1.0), ball(3.0, -70.0, 0.01, 20.0)] {
            let mut rays = || {
                // At its centre, its inside, its border, past it.
                let reach = [0.0, rng.f64(), 1.0, 1.0 + 1e-9 * rng.f64()][rng.usize(0..4)];
                let target = shape.centre + direction(&mut rng) * (shape.radius * reach);
                ray_to(&mut rng, &target, shape.radius)
            };
            let rays: Vec<Ray> = (0..100_000).map(|_| rays()).collect();
            let met = check_pairs(&shape, rays.iter().copied());
            assert!(met > 50_000, "{met}");
            let (worst, count) = worst_error(&shape, rays.into_iter(), |p, _| {
                let w = between(p, &shape.centre);
                (dot(w, w).sqrt() - Double::from(shape.radius)).0
            });
            assert!(worst <= 1.0 && count > 100_000, "{worst} of {count}");
        }
    }

    #[test]
    fn scaled_by_powers_of_two_the_bits_are_the_same() {
        let mut rng = Rng::with_seed(8);
        let rays: Vec<Ray> = (0..2000)
            .map(|_| {
                let target = Point::from(direction(&mut rng) * 1.2);
                ray_to(&mut rng, &target, 1.0)
            })
            .collect();
        check_scaling(|k| Box::new(ball(0.1 * k, 0.2 * k, -0.3 * k, 0.9 * k)), &rays);
    }
}
