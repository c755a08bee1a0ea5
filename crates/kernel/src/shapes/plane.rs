//! Planes.
//!
//! t = n . (origin - o) / n . d, with the difference first: the other form,
//! (n . origin - n . o) / n . d, loses what is small against the coordinates. The
//! normal is that of the scene times a power of two, so that it has no rounding.
//! Parallel rays divide by zero and give what is no finite number, hence no hit;
//! a ray in the plane likewise. A ray that is nearly parallel meets it, however
//! far away.

use super::exact::tamed;
use super::frame::Frame;
use crate::Crossing;
use crate::checker;
use crate::crossing::Crossings;
use crate::lanes::{Lanes, One, Real, Vectors, larger};
use crate::primitive::{Contact, Primitive, Square};
use crate::rays::Rays;
use lancer_math::{Bounds, Point, Ray, Vector, unit};
use lancer_scene::{Checker, Plane};

#[derive(Debug, Clone, Copy)]
pub(crate) struct HalfSpace {
    pub(crate) origin: Point,
    /// With its largest component in [1, 2), exact.
    pub(crate) normal: Vector,
    /// One over its squared length.
    inverse: f64,
    frame: Frame,
}

impl HalfSpace {
    pub(crate) fn new(plane: &Plane) -> Self {
        let normal = plane.normal.get();
        let frame = Frame::new(unit(normal).unwrap_or_else(Vector::z));
        let normal = tamed(&normal);
        let inverse = 1.0 / normal.norm_squared();
        Self { origin: plane.origin.get(), normal, inverse, frame }
    }
}

/// `p` put onto a plane, and how far from it that is at most.
///
/// With x = p - origin and u half of EPSILON: the subtraction and the product
/// n . x of three terms err by up to 4 u |n| |x|, in Euclidean lengths, and
/// rounding the result by u for each coordinate. In terms of the largest
/// coordinates this is below 9 u (|p| + |origin|).
#[inline(always)]
fn onto_plane<R: Real>(
    p: &Vectors<R>,
    origin: &Vectors<R>,
    normal: &Vectors<R>,
    inverse: R,
) -> (Vectors<R>, R) {
    let off = (*p - *origin).dot(normal) * inverse;
    let point = normal.mul_add(-off, *p);
    // Not of the point alone: where it is near the origin of the world, what was
    // subtracted may be larger than what is left.
    let size = larger(p.amax(), point.amax()) + origin.amax();
    (point, size * (8.0 * f64::EPSILON))
}

/// A plane for each lane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HalfSpaces<R> {
    origin: Vectors<R>,
    normal: Vectors<R>,
    unit: Vectors<R>,
    inverse: R,
}

impl<R: Real> HalfSpaces<R> {
    #[inline(always)]
    pub(crate) fn splat<L: Lanes<Real = R>>(lanes: L, plane: &HalfSpace) -> Self {
        Self {
            origin: Vectors::splat_point(lanes, &plane.origin),
            normal: Vectors::splat(lanes, &plane.normal),
            unit: Vectors::splat(lanes, &plane.frame.axis),
            inverse: lanes.splat(plane.inverse),
        }
    }

    /// How far the planes are along their normals, and how fast the rays go along
    /// them: the quotient is where they cross.
    #[inline(always)]
    pub(crate) fn slopes<L: Lanes<Real = R>>(&self, rays: &Rays<L>) -> (R, R) {
        slopes(&self.origin, &self.normal, rays)
    }

    /// The points of crossings, their errors and the unit normals.
    #[inline(always)]
    pub(crate) fn contacts<L: Lanes<Real = R>>(
        &self,
        rays: &Rays<L>,
        t: R,
    ) -> (Vectors<R>, R, Vectors<R>) {
        let at = rays.direction.mul_add(t, rays.origin);
        let (point, error) = onto_plane(&at, &self.origin, &self.normal, self.inverse);
        (point, error, self.unit)
    }
}

/// As [`HalfSpaces::slopes`] has it.
#[inline(always)]
pub(crate) fn slopes<L: Lanes>(
    origin: &Vectors<L::Real>,
    normal: &Vectors<L::Real>,
    rays: &Rays<L>,
) -> (L::Real, L::Real) {
    let ahead = normal.dot(&(*origin - rays.origin));
    (ahead, normal.dot(&rays.direction))
}

impl HalfSpace {
    /// The normal, of length 1.
    pub(crate) const fn unit(&self) -> Vector {
        self.frame.axis
    }

    /// In squares of a checker, counted from its origin.
    #[inline(always)]
    pub(crate) fn squares<L: Lanes>(
        &self,
        lanes: L,
        point: &Vectors<L::Real>,
        checker: &Checker,
    ) -> (L::Real, L::Real) {
        let from_origin = *point - Vectors::splat_point(lanes, &self.origin);
        let length = checker.length.get();
        let first = Vectors::splat(lanes, &self.frame.first).dot(&from_origin);
        let second = Vectors::splat(lanes, &self.frame.second).dot(&from_origin);
        if length == 1.0 {
            return (first, second);
        }
        let length = lanes.splat(length);
        (first / length, second / length)
    }
}

impl Primitive for HalfSpace {
    #[inline]
    fn crossings(&self, ray: &Ray) -> Crossings {
        let (ahead, slope) = HalfSpaces::splat(One, self).slopes(&Rays::splat(One, ray));
        let mut crossings = Crossings::NONE;
        crossings.add(ahead / slope, 0);
        crossings
    }

    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let planes = HalfSpaces::splat(One, self);
        let (point, error, normal) = planes.contacts(&Rays::splat(One, ray), crossing.t);
        let normal = normal.lane(0);
        Contact { point: point.lane(0).into(), error, normal, shading: normal }
    }

    fn square(&self, contact: &Contact, _part: u32, checker: &Checker) -> Square {
        let point = Vectors::splat_point(One, &contact.point);
        let (first, second) = self.squares(One, &point, checker);
        checker::square([first, second], [checker::slack(contact.error, checker.length.get()); 2])
    }

    fn bounds(&self) -> Option<Bounds> {
        None
    }

    /// What is behind it.
    fn contains(&self, point: &Point) -> bool {
        self.normal.dot(&(point - self.origin)) < 0.0
    }

    fn volume(&self) -> f64 {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{
        assert_sound, between, dot, doubles, ray, ray_to, ts, worst_error,
    };
    use super::*;
    use crate::primitive::Cell;
    use fastrand::Rng;
    use lancer_scene::{Direction, Position};

    fn plane(origin: [f64; 3], normal: [f64; 3]) -> HalfSpace {
        HalfSpace::new(&Plane {
            origin: Position::new(origin).unwrap(),
            normal: Direction::new(normal).unwrap(),
        })
    }

    /// Atlas P1.
    #[test]
    fn grazing_rays_meet_and_parallel_ones_do_not() {
        let floor = plane([0.0; 3], [0.0, 1.0, 0.0]);
        for (h, s) in [(1e-5, 5e-11), (1.0, 1e-9), (1.0, 1e-12), (1.0, 1e-300), (3.0, 7e-150)] {
            let found = ts(&floor, &ray([0.0, h, 0.0], [1.0, -s, 0.0]))[0];
            assert!((found / (h / s) - 1.0).abs() <= f64::EPSILON, "{h} {s}: {found}");
        }
        for zero in [0.0, -0.0] {
            for other in [0.0, -0.0] {
                for height in [1.0, -1.0, 0.0, -0.0] {
                    let along = ray([0.0, height, 0.0], [1.0, zero, other]);
                    assert!(ts(&floor, &along).is_empty(), "{along:?}");
                }
            }
        }
    }

    /// Atlas P3, and nothing is too far away.
    #[test]
    fn far_from_the_origin_and_far_away() {
        for s in [1e8, 1e12] {
            let oblique = plane([s; 3], [1.0, 2.0, 2.0].map(|c| c / 3.0));
            let d = [-2.0, -1.0, -2.0].map(|c| c / 3.0);
            let found = ts(&oblique, &ray([s + 2.0, s + 1.0, s + 2.0], d))[0];
            assert!((found - 3.0).abs() <= 1e-13, "{s}: {found}");
        }
        for far in [1.01e7, 1e12, 1e300] {
            let wall = plane([far, 0.0, 0.0], [-1.0, 0.0, 0.0]);
            assert_eq!(ts(&wall, &ray([0.0; 3], [1.0, 0.0, 0.0])), [far]);
        }
    }

    #[test]
    fn contacts_are_on_the_plane_and_leave_it() {
        let origin = [5.0, -3.0, 700.0];
        for normal in [[0.0, 0.0, 1.0], [1.0, 2.0, 2.0], [-0.3, 1e-9, 0.7], [1e-200, 0.0, 2e-200]] {
            let shape = plane(origin, normal);
            let mut rng = Rng::with_seed(7);
            let rays: Vec<Ray> =
                (0..50_000).map(|_| ray_to(&mut rng, &Point::from(origin), 10.0)).collect();
            let n = doubles(&tamed(&Vector::from(normal)));
            let (worst, count) = worst_error(&shape, rays.iter().copied(), |p, _| {
                (dot(between(p, &Point::from(origin)), n) / dot(n, n).sqrt()).0
            });
            assert!(worst <= 1.0 && count > 25_000, "{worst} of {count}");
            for ray in rays {
                for crossing in shape.crossings(&ray).iter() {
                    let contact = shape.contact(&ray, &crossing);
                    assert_sound(&contact);
                    let offset = contact.normal * (2.0 * contact.error);
                    assert!(shape.contains(&(contact.point - offset)));
                    assert!(!shape.contains(&(contact.point + offset)));
                    let out = if ray.direction.dot(&contact.normal) > 0.0 { 1.0 } else { -1.0 };
                    let leaving = Ray::new(contact.point + offset, ray.direction * out);
                    assert!(shape.nearest(&leaving, f64::INFINITY).is_none(), "{leaving:?}");
                    let entering = Ray::new(contact.point - offset, ray.direction * out);
                    assert!(shape.nearest(&entering, f64::INFINITY).is_some(), "{entering:?}");
                }
            }
        }
    }

    /// Atlas X1 and s21b.
    #[test]
    fn checkers_use_the_planes_own_two_coordinates() {
        let checker = Checker::new(lancer_scene::Colour::RED);
        for normal in [[1.0, 0.0, 0.0], [1.0, 1e-200, 0.0], [1.0, 2.0, 2.0], [0.0, 0.0, -1.0]] {
            let shape = plane([0.25, 1e3, -4.0], normal);
            let Frame { first, second, axis } = shape.frame;
            for (i, j) in [(0.5, 0.5), (1.5, 0.5), (-0.5, 0.5), (-0.5, -0.5), (100.5, -7.5)] {
                let target = shape.origin + first * i + second * j;
                let from = Ray::new(target + axis * 3.0, -axis);
                let crossing = shape.nearest(&from, f64::INFINITY).unwrap();
                let contact = shape.contact(&from, &crossing);
                let odd = libm::floor(i) % 2.0 != 0.0;
                let other = libm::floor(j) % 2.0 != 0.0;
                let expected = if odd == other { Cell::First } else { Cell::Second };
                assert_eq!(
                    shape.square(&contact, 0, &checker).cell,
                    expected,
                    "{normal:?} {i} {j}"
                );
            }
        }
    }

    /// A point near the origin of the world is no better known than the larger
    /// one that it was made from.
    #[test]
    fn points_near_the_origin_are_left_like_others() {
        let mut rng = Rng::with_seed(11);
        for case in 0..20_000 {
            let normal = super::super::testing::direction(&mut rng);
            let shape = plane([0.0; 3], normal.into());
            // Along the normal, so that all of the point's error is across the plane.
            let distance = 0.5 + 10.0 * rng.f64();
            let from = Ray::new(Point::from(normal * distance), -normal);
            let Some(crossing) = shape.nearest(&from, f64::INFINITY) else { continue };
            let contact = shape.contact(&from, &crossing);
            let n = if normal.dot(&from.direction) < 0.0 { normal } else { -normal };
            let away = contact.point + n * (2.0 * contact.error);
            let mirrored = from.direction - n * (2.0 * n.dot(&from.direction));
            let left = Ray::new(away, mirrored);
            assert_eq!(shape.nearest(&left, f64::INFINITY), None, "case {case}");
        }
    }
}
