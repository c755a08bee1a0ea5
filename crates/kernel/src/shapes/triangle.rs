//! Triangles; whether a ray meets one is decided in `edges.rs`.

use super::edges::{Meeting, Shear};
use super::exact::{cross, tamed};
use super::flat::Patch;
use crate::Crossing;
use crate::crossing::Crossings;
use crate::primitive::{Contact, Primitive, Square};
use lancer_math::{Bounds, Point, Ray, Vector, unit};
use lancer_scene::{Checker, Triangle};

#[derive(Debug)]
pub(crate) struct Facet {
    corners: [Point; 3],
    patch: Patch,
}

impl Facet {
    pub(crate) fn new(triangle: &Triangle) -> Self {
        let corners = triangle.corners();
        let [a, b, c] = corners;
        Self { corners, patch: Patch::new(a, [b - a, c - a]) }
    }
}

/// The unit normal of a triangle, to the side from which its corners go
/// anticlockwise. No cancellation but that of the edges themselves.
#[inline]
pub(crate) fn normal_of(&[a, b, c]: &[Point; 3]) -> Vector {
    unit(cross(&tamed(&(b - a)), &tamed(&(c - a)))).unwrap_or_else(Vector::z)
}

/// The point with these weights, and how far from the exact triangle a
/// coordinate of it is at most.
///
/// From the corners, not along the ray. With m the largest coordinate of a
/// corner and u half of EPSILON: an edge is at most 2 m long, and the rounding
/// of it, of its product with a weight, of their sum and of the sum with the
/// corner come to at most 2 (2 + 2) m u + 2 m u + m u = 11 m u, as the weights of
/// two edges are 1 together at most; what the weights themselves err by moves
/// the point in the triangle, or out of it by another 4 m u.
#[inline]
pub(crate) fn point_of(&[a, b, c]: &[Point; 3], [_, v, w]: [f64; 3]) -> (Point, f64) {
    let point = a + ((b - a) * v + (c - a) * w);
    let largest = a.coords.amax().max(b.coords.amax()).max(c.coords.amax());
    (point, 8.0 * f64::EPSILON * largest)
}

impl Primitive for Facet {
    #[inline]
    fn crossings(&self, ray: &Ray) -> Crossings {
        let mut crossings = Crossings::NONE;
        if let Some(Meeting { t, .. }) = Shear::new(ray).meet(&self.corners) {
            crossings.add(t, 0);
        }
        crossings
    }

    fn contact(&self, ray: &Ray, _crossing: &Crossing) -> Contact {
        let third = 1.0 / 3.0;
        let met = Shear::new(ray).meet(&self.corners);
        let (point, error) = point_of(&self.corners, met.map_or([third; 3], |met| met.weights));
        let normal = self.patch.unit_normal;
        Contact { point, error, normal, shading: normal }
    }

    fn square(&self, contact: &Contact, _part: u32, checker: &Checker) -> Square {
        self.patch.square(contact, checker)
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(Bounds::around(self.corners))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{
        between, check_scaling, direction, dot, ray, ray_to, ts, worst_error,
    };
    use super::*;
    use fastrand::Rng;
    use lancer_scene::Position;

    fn triangle(corners: [[f64; 3]; 3]) -> Facet {
        let corners = corners.map(|c| Position::new(c).unwrap());
        Facet::new(&Triangle::new(corners).unwrap())
    }

    /// Atlas T2: no threshold, and T4: no digit of a coordinate is lost.
    #[test]
    fn small_ones_and_far_ones() {
        for s in [1e-2, 1e-3, 2e-4, 1e-5, 1e-8, 1e-60, 1e60] {
            let shape = triangle([[0.0; 3], [s, 0.0, 0.0], [0.0, s, 0.0]]);
            assert_eq!(ts(&shape, &ray([s / 3.0, s / 3.0, -1.0], [0.0, 0.0, 1.0])), [1.0], "{s}");
        }
        for x in [1e6 + 0.3, 16_777_217.0, 1e8 + 0.3] {
            let shape = triangle([[x, -1.0, -1.0], [x, 2.0, 0.3], [x, 0.1, 1.7]]);
            assert_eq!(ts(&shape, &ray([0.0; 3], [1.0, 0.0, 0.0])), [x]);
        }
    }

    #[test]
    fn what_is_no_ray_misses() {
        let shape = triangle([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]]);
        assert_eq!(ts(&shape, &ray([0.0, 0.0, 3.0], [0.0, 0.0, -2.0])), [1.5]);
        assert_eq!(ts(&shape, &ray([0.0, 0.0, -3.0], [0.0, 0.0, -2.0])), [-1.5]);
        for d in [[0.0; 3], [f64::NAN; 3], [0.0, f64::NAN, 1.0], [1.0, 0.0, 0.0], [1.0, 2.0, -0.0]]
        {
            assert!(ts(&shape, &ray([0.0; 3], d)).is_empty(), "{d:?}");
        }
        assert!(ts(&shape, &ray([f64::NAN, 0.0, 1.0], [0.0, 0.0, 1.0])).is_empty());
    }

    /// Atlas T3: the decision and the distance of needles at grazing angles,
    /// compared with whole numbers (Plücker's products, exact).
    #[test]
    fn needles_at_grazing_angles() {
        let mut rng = Rng::with_seed(1);
        let (mut met, mut worst) = (0, 0.0_f64);
        for case in 0..60_000 {
            // Thousandths, as whole numbers.
            let mut whole = |n: i32| i128::from(rng.i32(-n..=n));
            let mut point = |n: i32| [whole(n), whole(n), whole(n)];
            let a = point(1000);
            let along = point(10_000);
            let aside = point(700);
            let b: [i128; 3] = std::array::from_fn(|i| a[i] + along[i]);
            let c: [i128; 3] = std::array::from_fn(|i| a[i] + along[i] * 9 / 10 + aside[i]);
            let minus =
                |a: [i128; 3], b: [i128; 3]| -> [i128; 3] { std::array::from_fn(|i| a[i] - b[i]) };
            let cross = |a: [i128; 3], b: [i128; 3]| -> [i128; 3] {
                std::array::from_fn(|i| {
                    a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]
                })
            };
            let dot = |a: [i128; 3], b: [i128; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let n = cross(minus(b, a), minus(c, a));
            // Nearly along the needle, so that the plane is grazed.
            let tilt = point(90);
            let d: [i128; 3] = std::array::from_fn(|i| along[i] + tilt[i]);
            let target: [i128; 3] = std::array::from_fn(|i| (a[i] + b[i] + c[i]) / 3);
            let o = minus(target, d.map(|c| c * 40));
            let det = dot(n, d);
            let [p, q, r] = [a, b, c].map(|p| minus(p, o));
            let sides = [dot(d, cross(q, r)), dot(d, cross(r, p)), dot(d, cross(p, q))];
            let inside = sides.iter().all(|s| *s > 0) || sides.iter().all(|s| *s < 0);
            // Where the margin is too small for doubles, either is right.
            let scale = [(q, r), (r, p), (p, q)].map(|(q, r)| {
                let size = |v: [i128; 3]| v.iter().map(|c| c.unsigned_abs()).max().unwrap() as f64;
                size(d) * size(q) * size(r)
            });
            if n == [0; 3]
                || (0..3).any(|i| (sides[i] as f64).abs() <= 1e-12 * scale[i])
                || lancer_math::unit(Vector::from(n.map(|c| c as f64))).is_none()
            {
                continue;
            }
            let real = |p: [i128; 3]| p.map(|c| c as f64);
            let corners = [a, b, c].map(|p| Point::from(real(p)));
            let [x, y, z] = [corners[0], corners[1], corners[2]];
            let shape = Facet { corners, patch: Patch::new(x, [y - x, z - x]) };
            let found = ts(&shape, &ray(real(o), real(d)));
            assert_eq!(found.len(), usize::from(inside), "case {case}");
            if let [t] = found[..] {
                // Rounded once.
                let expected = dot(n, p) as f64 / det as f64;
                // By the sine of the angle, here below 0.1 and down to 1e-7.
                let size = |v: [i128; 3]| (dot(v, v) as f64).sqrt();
                let sine = (det as f64).abs() / (size(n) * size(d));
                worst = worst.max((t / expected - 1.0).abs() * sine);
                let range = [p, q, r].map(|p| dot(p, d) as f64 / dot(d, d) as f64);
                let least = range.iter().copied().fold(f64::INFINITY, f64::min);
                let most = range.iter().copied().fold(0.0, f64::max);
                assert!(t >= least * 0.98 && t <= most * 1.02, "case {case}");
                met += 1;
            }
        }
        // At half a degree, 1e-13.
        assert!(worst <= 1e-15 && met > 50_000, "{worst:e} of {met}");
    }

    #[test]
    fn contacts_are_on_the_exact_triangle_and_rays_leave_it() {
        for corners in [
            [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            [[10.3, -700.7, 3.1], [13.0, -698.0, 2.0], [9.1, -702.0, 5.5]],
            [[0.0, 0.0, 0.1], [1e6, 3.0, 0.7], [-2e5, 1e6, 0.3]],
        ] {
            let shape = triangle(corners);
            let [a, b, c] = shape.corners;
            let size = (b - a).amax().max((c - a).amax());
            let mut rng = Rng::with_seed(4);
            let rays: Vec<Ray> = (0..50_000)
                .map(|_| {
                    let (v, w) = (0.5 * rng.f64(), 0.5 * rng.f64());
                    let target = a + (b - a) * v + (c - a) * w;
                    ray_to(&mut rng, &target, size)
                })
                .collect();
            let (u, v) = (between(&b, &a), between(&c, &a));
            let n = std::array::from_fn(|i| {
                u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]
            });
            let (worst, count) = worst_error(&shape, rays.iter().copied(), |p, _| {
                (dot(between(p, &a), n) / dot(n, n).sqrt()).0
            });
            assert!(worst <= 1.0 && count > 20_000, "{worst} of {count}");
            for ray in rays {
                for crossing in shape.crossings(&ray).iter() {
                    let contact = shape.contact(&ray, &crossing);
                    let offset = contact.normal * (2.0 * contact.error);
                    let way = direction(&mut rng);
                    let out = if way.dot(&offset) > 0.0 { way } else { -way };
                    let leaving = Ray::new(contact.point + offset, out);
                    assert!(shape.nearest(&leaving, f64::INFINITY).is_none(), "{leaving:?}");
                }
            }
        }
    }

    #[test]
    fn scaled_by_powers_of_two_the_bits_are_the_same() {
        let mut rng = Rng::with_seed(8);
        let rays: Vec<Ray> = (0..4000)
            .map(|_| {
                let target = Point::from(direction(&mut rng) * 0.5);
                ray_to(&mut rng, &target, 1.0)
            })
            .collect();
        let corners = [[-1.1, -0.8, 0.3], [1.0, -1.0, -0.1], [0.2, 1.3, 0.2]];
        check_scaling(|k| Box::new(triangle(corners.map(|p| p.map(|c| c * k)))), &rays);
    }
}
