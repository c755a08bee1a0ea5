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
//! whose square is no number is beyond what can be met, and so is a radius whose
//! square has lost digits for being too small.

use super::exact::{two_products, two_sums};
use crate::Crossing;
use crate::checker;
use crate::crossing::Crossings;
use crate::lanes::{Lanes, Mask, One, Real, Vectors};
use crate::near::steps;
use crate::primitive::{Contact, Primitive, Square};
use crate::rays::{Pairs, Rays, Tame};
use lancer_math::{Bounds, Point, Ray, Vector};
use lancer_scene::{Checker, Sphere};

#[derive(Debug, Clone, Copy)]
pub(crate) struct Ball {
    pub(crate) centre: Point,
    pub(crate) radius: f64,
}

/// A ball for each lane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Balls<R> {
    pub(crate) centre: Vectors<R>,
    pub(crate) radius: R,
}

impl<R: Real> Balls<R> {
    #[inline(always)]
    pub(crate) fn splat<L: Lanes<Real = R>>(lanes: L, ball: &Ball) -> Self {
        Self { centre: Vectors::splat_point(lanes, &ball.centre), radius: lanes.splat(ball.radius) }
    }

    /// The lanes in which [`crossings`](Self::crossings) may find something ahead: never
    /// too few.
    ///
    /// With c from the centre to the origin, b = c . d, and e below 8 u for all
    /// rounding errors of these products (u is half of EPSILON): the squared distance of the
    /// line is c^2 - b^2 / d^2 to within 4 e c^2, and where it is more than r^2 +
    /// 2^-44 c^2, the quadratic has no root, whose own terms err by less than that.
    /// Where the ray goes away (b > 0) and the origin is outside by more than 2^-40
    /// c^2, both crossings are behind it. What is so small that squares lose digits is
    /// not left out.
    #[inline(always)]
    pub(crate) fn may_meet<L: Lanes<Real = R>>(&self, rays: &Rays<L>, tame: &Tame<R>) -> R::Mask {
        const OUTSIDE: f64 = 1.0 - 9.094_947_017_729_282e-13; // 1 - 2^-40
        let from_centre = rays.origin - self.centre;
        let b = from_centre.dot(&tame.direction);
        let c2 = from_centre.norm_squared();
        let leaves =
            b.gt(rays.lanes.splat(0.0)) & (c2 * OUTSIDE).gt(self.radius * self.radius + 1e-280);
        !(self.passes(tame, b, c2) | leaves)
    }

    /// The lanes in which one of the crossings is at 0 < t < `t_max`, whatever
    /// roundings do: the origin is outside and the line passes through the ball, both by
    /// 2^-40 of the squares, and is nearest to the centre before `t_max`.
    #[inline(always)]
    pub(crate) fn surely_meet<L: Lanes<Real = R>>(
        &self,
        rays: &Rays<L>,
        tame: &Tame<R>,
        t_max: R,
    ) -> R::Mask {
        const LESS: f64 = 1.0 - 9.094_947_017_729_282e-13; // 1 - 2^-40
        let from_centre = rays.origin - self.centre;
        let b = from_centre.dot(&tame.direction);
        let c2 = from_centre.norm_squared();
        let r2 = self.radius * self.radius;
        let is_outside = (c2 * LESS).gt(r2 + 1e-280);
        let is_through = ((c2 - r2 * LESS) * tame.squared + 1e-80).lt(b * b * LESS);
        // In directions as they are.
        let is_before = (-b * tame.unit).lt(tame.squared * (t_max * LESS));
        is_outside & is_through & is_before & b.lt(rays.lanes.splat(0.0))
    }

    /// The lanes in which a ray that starts outside by more than its error may come back:
    /// where it does not go away from the centre. Where it does, with the same product
    /// [`crossings`](Self::crossings) finds both behind it, since the sign of
    /// [`excess`](Self::excess) is right.
    #[inline(always)]
    pub(crate) fn may_come_back<L: Lanes<Real = R>>(
        &self,
        rays: &Rays<L>,
        tame: &Tame<R>,
    ) -> R::Mask {
        let from_centre = rays.origin - self.centre;
        !from_centre.dot(&tame.direction).gt(rays.lanes.splat(0.0))
    }

    /// The same for something ahead or behind.
    #[inline(always)]
    pub(crate) fn may_meet_line<L: Lanes<Real = R>>(
        &self,
        rays: &Rays<L>,
        tame: &Tame<R>,
    ) -> R::Mask {
        let from_centre = rays.origin - self.centre;
        !self.passes(tame, from_centre.dot(&tame.direction), from_centre.norm_squared())
    }

    /// Not where something is not a number.
    #[inline(always)]
    fn passes(&self, tame: &Tame<R>, b: R, c2: R) -> R::Mask {
        const SLACK: f64 = 5.684_341_886_080_802e-14; // 2^-44
        ((c2 * (1.0 - SLACK) - self.radius * self.radius) * tame.squared).gt(b * b + 1e-80)
    }

    /// Where the rays cross the balls.
    #[inline(always)]
    pub(crate) fn crossings<L: Lanes<Real = R>>(&self, rays: &Rays<L>, tame: &Tame<R>) -> Pairs<R> {
        let lanes = rays.lanes;
        let inverse = lanes.splat(1.0) / tame.squared;
        let (zero, not) = (lanes.splat(0.0), lanes.splat(f64::NAN));
        let direction = &tame.direction;
        let from_centre = rays.origin - self.centre;
        // An origin within a few times the size of the ball stays where it is: its
        // rounding is small already.
        let is_near = from_centre.amax().le(self.radius * 2.0);
        let shift = -(from_centre.dot(direction) * inverse);
        let shift = is_near.select(zero, shift);
        let moved = steps(&rays.origin, &self.centre, shift, direction);
        let origin = Vectors::select(is_near, from_centre, moved);
        // What is left along the ray, all of it where the origin was not moved.
        let along = origin.dot(direction) * inverse;
        let p = direction.mul_add(-along, origin).norm();
        let under_root = (self.radius - p) * (self.radius + p);
        let half = (under_root * inverse).sqrt();
        let middle = shift - along;
        let far = middle + half.copysign(middle);
        let close = middle - half.copysign(middle);
        let cancels = half.gt(middle.abs() * 0.5);
        let close = if cancels.any() {
            cancels.select(self.excess(lanes, &rays.origin) / (tame.squared * far), close)
        } else {
            close
        };
        // Not for NaN either.
        let meets = under_root.ge(zero);
        let pairs = Pairs::sorted(far * tame.unit, close * tame.unit);
        Pairs { near: meets.select(pairs.near, not), far: meets.select(pairs.far, not) }
    }

    /// The squared distances of points from the centre minus that of the surface.
    #[inline(always)]
    fn excess<L: Lanes<Real = R>>(&self, lanes: L, point: &Vectors<R>) -> R {
        let (square, square_lost) = two_products(self.radius, self.radius);
        let (mut sum, mut lost) = (-square, -square_lost);
        let two = lanes.splat(2.0);
        for (p, c) in [(point.x, self.centre.x), (point.y, self.centre.y), (point.z, self.centre.z)]
        {
            let (off, off_lost) = two_sums(p, -c);
            let (square, square_lost) = two_products(off, off);
            let (next, next_lost) = two_sums(sum, square);
            sum = next;
            lost = lost + (next_lost + (two * off).mul_add(off_lost, square_lost));
        }
        sum + lost
    }

    /// The points of crossings, their errors and the unit normals.
    ///
    /// The direction from the centre has a length of 1 to within 4 u (u is half
    /// of EPSILON), its product with the radius and the sum with the centre are
    /// rounded once: below 6 u of the radius and u of the centre, and here more.
    #[inline(always)]
    pub(crate) fn contacts<L: Lanes<Real = R>>(
        &self,
        rays: &Rays<L>,
        t: R,
    ) -> (Vectors<R>, R, Vectors<R>) {
        let from_centre = steps(&rays.origin, &self.centre, t, &rays.direction);
        let length = from_centre.norm();
        let normal = Vectors {
            x: from_centre.x / length,
            y: from_centre.y / length,
            z: from_centre.z / length,
        };
        let point = normal.mul_add(self.radius, self.centre);
        let error = (self.centre.amax() + self.radius) * (4.0 * f64::EPSILON);
        (point, error, normal)
    }
}

/// Spheres with a smaller radius are never met: 2^-480, in units of length. Of its
/// square, all digits of a double and of what it loses are in range.
pub const LEAST_RADIUS: f64 = f64::from_bits((1023 - 480) << 52);

impl Ball {
    /// With a radius that is no number where it is too small to be met.
    pub(crate) fn new(sphere: &Sphere) -> Self {
        let radius = sphere.radius.get();
        let radius = if radius >= LEAST_RADIUS { radius } else { f64::NAN };
        Self { centre: sphere.centre.get(), radius }
    }
}

impl Primitive for Ball {
    #[inline]
    fn crossings(&self, ray: &Ray) -> Crossings {
        let (ball, rays) = (Balls::splat(One, self), Rays::splat(One, ray));
        let tame = rays.tame();
        let mut crossings = Crossings::NONE;
        if ball.may_meet_line(&rays, &tame).any() {
            let pairs = ball.crossings(&rays, &tame);
            crossings.add(pairs.near, 0);
            crossings.add(pairs.far, 0);
        }
        crossings
    }

    #[inline]
    fn nearest(&self, ray: &Ray, t_max: f64) -> Option<Crossing> {
        let (ball, rays) = (Balls::splat(One, self), Rays::splat(One, ray));
        let tame = rays.tame();
        if !ball.may_meet(&rays, &tame).any() {
            return None;
        }
        let t = ball.crossings(&rays, &tame).ahead(0.0);
        (t > 0.0 && t < t_max).then_some(Crossing { t, part: 0 })
    }

    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let (ball, rays) = (Balls::splat(One, self), Rays::splat(One, ray));
        let (point, error, normal) = ball.contacts(&rays, crossing.t);
        let normal = normal.lane(0);
        Contact { point: point.lane(0).into(), error, normal, shading: normal }
    }

    fn square(&self, contact: &Contact, _part: u32, checker: &Checker) -> Square {
        let n = contact.normal;
        let angle = checker.angle.get();
        let across = libm::hypot(n.x, n.y);
        let latitude = libm::atan2(n.z, across).to_degrees();
        // Meridians run together at the poles.
        let slack = [across, 1.0]
            .map(|radius| checker::slack_around(contact.error, radius * self.radius, angle));
        checker::square([checker::turn(n.x, n.y) / angle, latitude / angle], slack)
    }

    fn bounds(&self) -> Option<Bounds> {
        let reach = Vector::repeat(self.radius * (1.0 + f64::EPSILON));
        let slack = Vector::repeat(self.centre.coords.amax() * f64::EPSILON);
        Some(Bounds { min: self.centre, max: self.centre }.grown(reach + slack))
    }

    fn contains(&self, point: &Point) -> bool {
        let ball = Balls::splat(One, self);
        ball.excess(One, &Vectors::splat_point(One, point)) < 0.0
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

    /// What is left out, and what is taken for certain, against the crossings.
    #[test]
    fn what_is_certain_is_right() {
        let mut rng = Rng::with_seed(21);
        let (mut left_out, mut sure, mut gone) = (0, 0, 0);
        for case in 0..400_000 {
            let shape = ball(rng.f64(), -3.0 * rng.f64(), 2.0, 0.1 + rng.f64());
            let reach = [1.0, 1.0 + 1e-12 * (rng.f64() - 0.5), 2.0 * rng.f64()][case % 3];
            let target = shape.centre + direction(&mut rng) * (shape.radius * reach);
            let mut ray = ray_to(&mut rng, &target, shape.radius);
            ray.direction *= [1.0, 1.0, 1e-200, 1e-120, 1e150, 0.3][case % 6];
            let (balls, rays) = (Balls::splat(One, &shape), Rays::splat(One, &ray));
            let tame = rays.tame();
            let t = balls.crossings(&rays, &tame).ahead(0.0);
            if !balls.may_meet(&rays, &tame).any() {
                left_out += 1;
                assert!(!(t > 0.0 && t < f64::INFINITY), "case {case}: {t}");
            }
            let t_max = if t > 0.0 { t * (0.5 + rng.f64()) } else { 1.0 };
            if balls.surely_meet(&rays, &tame, t_max).any() {
                sure += 1;
                assert!(t > 0.0 && t < t_max, "case {case}: {t} {t_max}");
            }
            // From the surface outward.
            let contact = shape.contact(&ray, &Crossing { t, part: 0 });
            let way = direction(&mut rng);
            let away = contact.normal * (2.0 * contact.error);
            let leaving = Ray::new(contact.point + away, way);
            let rays = Rays::splat(One, &leaving);
            let tame = rays.tame();
            if t > 0.0 && !balls.may_come_back(&rays, &tame).any() {
                gone += 1;
                let back = balls.crossings(&rays, &tame).ahead(0.0);
                assert!(back.is_nan() || back <= 0.0, "case {case}: {back}");
            }
        }
        assert!(left_out > 10_000 && sure > 10_000 && gone > 10_000, "{left_out} {sure} {gone}");
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
