//! Cylinders, cones and frustums.
//!
//! The inside is where a slab (between the lids) and an infinite barrel (within
//! the side) are both, so a line is cut by the two intervals: entry and exit
//! exist together, also through a rim, and the mirror image of a cone beyond its
//! apex is never in the slab.
//!
//! Heights are counted from the centre of the smaller lid, where that of a cone
//! is its apex, so that a radius is a sum of positive terms. With p, d the
//! ray's origin and direction in the shape's frame, g the barrel's radius at the
//! height of the origin and q what it gains for one direction, the barrel's
//! border is at the roots of a t^2 + 2 b t + c with
//!
//! - a = dx^2 + dy^2 - q^2, b = px dx + py dy - g q, c = px^2 + py^2 - g^2,
//! - b^2 - a c = (px q - g dx)^2 + (py q - g dy)^2 - (px dy - py dx)^2,
//!
//! the last by Lagrange's identity, each difference with Kahan's products, and
//! all differences of squares as products of sum and difference: that is the
//! perpendicular distance compared with the radius, and no digit is lost for thin
//! cylinders far away. The roots are e / a and c / e with e = -(b + sign(b) root),
//! which do not cancel, and of which the second is right however small a is.
//!
//! Degenerate cases: along the axis of a cylinder the barrel is everywhere or
//! nowhere; parallel to a line of a cone's side (a = 0), and steeper (a < 0), it is
//! a half-line; a ray in a line of the side is none. At the apex the normal is
//! that of the side which the ray comes towards, so that it is as bright as what is
//! around it. A ray through the apex alone touches: its two crossings are one.

use super::exact::difference_of_products;
use super::frame::{Frame, across};
use crate::Crossing;
use crate::checker;
use crate::crossing::Crossings;
use crate::near::{Near, stepped};
use crate::primitive::{Cell, Contact, Primitive};
use lancer_math::{Bounds, Point, Ray, Vector, unit};
use lancer_scene::{Checker, Cone};

const SIDE: u32 = 0;
const BASE: u32 = 1;
const TOP: u32 = 2;

/// A line passes the narrow end closely if it is so many times nearer to it than
/// the ray's origin.
const NARROW: f64 = 16.0;

#[derive(Debug)]
pub(crate) struct Barrel {
    base: Point,
    /// The centre of the smaller lid.
    narrow: Point,
    /// Its axis from the base to the top.
    frame: Frame,
    /// The axis from the smaller lid to the larger one.
    axis: Vector,
    length: f64,
    /// The radius of the smaller lid, and of the larger one.
    radii: [f64; 2],
    /// How much the radius grows for each length; not negative.
    slope: f64,
    /// The parts that the two lids are: a lid of radius 0 is part of the side.
    lids: [u32; 2],
    /// Its length and its larger radius.
    size: f64,
    open: bool,
}

/// An end of an interval of the line.
#[derive(Clone, Copy)]
struct End {
    t: f64,
    part: u32,
}

impl Barrel {
    pub(crate) fn new(cone: &Cone) -> Self {
        let (base, top) = (cone.base(), cone.top());
        let along = top - base;
        let frame = Frame::new(unit(along).unwrap_or_else(Vector::z));
        let length = along.dot(&frame.axis);
        let narrows = cone.top_radius() < cone.base_radius();
        let mut radii = [cone.base_radius(), cone.top_radius()];
        let mut lids = [BASE, TOP];
        if narrows {
            radii.reverse();
            lids.reverse();
        }
        if radii[0] == 0.0 {
            lids[0] = SIDE;
        }
        Self {
            base,
            narrow: if narrows { top } else { base },
            frame,
            axis: if narrows { -frame.axis } else { frame.axis },
            length,
            radii,
            slope: (radii[1] - radii[0]) / length,
            lids,
            size: length + radii[1],
            open: cone.open,
        }
    }

    /// The interval in which the line is between the lids.
    #[inline]
    fn slab(&self, z: f64, dz: f64) -> Option<[End; 2]> {
        let [narrow, wide] = self.lids;
        if dz > 0.0 {
            Some([End { t: -z / dz, part: narrow }, End { t: (self.length - z) / dz, part: wide }])
        } else if dz < 0.0 {
            Some([End { t: (self.length - z) / dz, part: wide }, End { t: -z / dz, part: narrow }])
        } else {
            let between = z >= 0.0 && z <= self.length;
            between.then_some([
                End { t: f64::NEG_INFINITY, part: SIDE },
                End { t: f64::INFINITY, part: SIDE },
            ])
        }
    }

    /// The interval in which the line is within the side's infinite extension, on
    /// the apex's near side.
    #[inline]
    fn barrel(&self, p: &Vector, d: &Vector) -> Option<[f64; 2]> {
        let g = self.radii[0] + self.slope * p.z;
        let distance = (p.x * p.x + p.y * p.y).sqrt();
        let q = self.slope * d.z;
        let largest = d.x.abs().max(d.y.abs()).max(q.abs());
        if largest == 0.0 {
            // Along the axis of a cylinder.
            return (distance <= g).then_some([f64::NEG_INFINITY, f64::INFINITY]);
        }
        // Nearly along the axis: that the squares are numbers.
        let unit = if largest > 1e-100 {
            1.0
        } else {
            libm::scalbn(1.0, -libm::ilogb(largest).max(-1000))
        };
        let (dx, dy, q) = (d.x * unit, d.y * unit, q * unit);

        let sideways = (dx * dx + dy * dy).sqrt();
        let a = (sideways - q.abs()) * (sideways + q.abs());
        let b = p.x * dx + p.y * dy - g * q;
        let c = (distance - g.abs()) * (distance + g.abs());
        let e = [
            difference_of_products(p.x, q, g, dx),
            difference_of_products(p.y, q, g, dy),
            difference_of_products(p.x, dy, p.y, dx),
        ];
        let reach = (e[0] * e[0] + e[1] * e[1]).sqrt();
        let under_root = (reach - e[2].abs()) * (reach + e[2].abs());
        let (first, second) = if a > 0.0 {
            // The root of a negative number is NaN.
            let root = under_root.sqrt();
            if root.is_nan() {
                return None;
            }
            let e = -(b + root.copysign(b));
            // Both 0 where it touches at its origin.
            let (far, near) = if e == 0.0 { (0.0, 0.0) } else { (e / a, c / e) };
            (far.min(near), far.max(near))
        } else if a < 0.0 {
            // Below 0 by rounding alone.
            let e = -(b + under_root.max(0.0).sqrt().copysign(b));
            let (far, near) = if e == 0.0 { (0.0, 0.0) } else { (e / a, c / e) };
            // The one of the two half-lines that goes to larger radii.
            if q > 0.0 {
                (far.max(near), f64::INFINITY)
            } else {
                (f64::NEG_INFINITY, far.min(near))
            }
        } else if b < 0.0 && q > 0.0 {
            (-c / (2.0 * b), f64::INFINITY)
        } else if b > 0.0 && q < 0.0 {
            (f64::NEG_INFINITY, -c / (2.0 * b))
        } else {
            return None;
        };
        Some([first * unit, second * unit])
    }

    /// Where a point is along the axis, from the smaller lid, and the rest.
    #[inline]
    fn split(&self, at: &Vector) -> (f64, Vector) {
        let z = self.axis.dot(at);
        (z, at - self.axis * z)
    }
}

impl Primitive for Barrel {
    #[inline]
    fn crossings(&self, ray: &Ray) -> Crossings {
        // Past the apex or a narrow end what matters is small against the distance of
        // an origin that is near the shape, too.
        let near = Near::new(ray, &self.narrow);
        let near = if NARROW * near.origin.amax() < (ray.origin - self.narrow).amax() {
            near
        } else {
            Near::around(ray, &self.narrow, self.size)
        };
        let local = |v: &Vector| {
            Vector::new(self.frame.first.dot(v), self.frame.second.dot(v), self.axis.dot(v))
        };
        let (p, d) = (local(&near.origin), local(&near.direction));
        let mut crossings = Crossings::NONE;
        let (Some([mut from, mut to]), Some([first, second])) =
            (self.slab(p.z, d.z), self.barrel(&p, &d))
        else {
            return crossings;
        };
        if first >= from.t {
            from = End { t: first, part: SIDE };
        }
        if second <= to.t {
            to = End { t: second, part: SIDE };
        }
        if from.t <= to.t && from.t > f64::NEG_INFINITY && to.t < f64::INFINITY {
            for end in [from, to] {
                if end.part == SIDE || !self.open {
                    crossings.add(near.t(end.t), end.part);
                }
            }
        }
        crossings
    }

    /// Built up from the smaller lid's centre, a height, and the radius there.
    ///
    /// Computing the place moves it by the rounding of the sum, u of the
    /// coordinates (u is half of EPSILON), and of its two terms, 2 u of the
    /// length and 5 u of the radius. The exact shape itself differs from this one
    /// by its axis (3 u of what it is multiplied with, in all directions),
    /// length and slope (5 u of the radius). That is 8 u of the size and u of
    /// the coordinates, and here twice that.
    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let at = stepped(&ray.origin, &self.narrow, crossing.t, &ray.direction);
        let (z, across) = self.split(&at);
        let distance = across.norm();
        let outward = if distance > 0.0 {
            across / distance
        } else {
            // On the axis, at the apex or where a thin end is hit from afar: the side that
            // the ray comes from.
            let (_, sideward) = self.split(&ray.direction);
            unit(-sideward).unwrap_or(self.frame.first)
        };
        let (z, radius, normal) = if crossing.part == SIDE {
            let z = z.clamp(0.0, self.length);
            let radius = self.radii[0] + self.slope * z;
            // The slope's own length may be beyond a double; unit() has none of that.
            let normal = unit(outward - self.axis * self.slope);
            (z, radius, normal.unwrap_or(-self.axis))
        } else if crossing.part == self.lids[0] {
            (0.0, distance.min(self.radii[0]), -self.axis)
        } else {
            (self.length, distance.min(self.radii[1]), self.axis)
        };
        Contact {
            point: self.narrow + (self.axis * z + outward * radius),
            error: 8.0 * f64::EPSILON * (self.narrow.coords.amax() + self.size),
            normal,
            shading: normal,
        }
    }

    /// The side by its height above the base and the angle, lids by the distance
    /// from their middle and the angle.
    fn cell(&self, contact: &Contact, part: u32, checker: &Checker) -> Cell {
        let at = self.frame.local(&(contact.point - self.base));
        let across = (at.x * at.x + at.y * at.y).sqrt();
        let along = if part == SIDE { at.z } else { across };
        let turn = checker::turn(at.x, at.y);
        let (length, angle) = (checker.length.get(), checker.angle.get());
        let slack = checker::slack(contact.error, length);
        let slack_around = checker::slack_around(contact.error, across, angle);
        checker::cell([along / length, turn / angle], [slack, slack_around])
    }

    /// Around the circles of both lids.
    fn bounds(&self) -> Option<Bounds> {
        let across = across(&self.axis);
        let wide = self.narrow + self.axis * self.length;
        let [narrow, wide] = [(self.narrow, self.radii[0]), (wide, self.radii[1])]
            .map(|(centre, radius)| Bounds { min: centre, max: centre }.grown(across * radius));
        let slack = 8.0 * f64::EPSILON * (self.narrow.coords.amax() + self.size);
        Some(narrow.union(wide).grown(Vector::repeat(slack)))
    }

    fn contains(&self, point: &Point) -> bool {
        let (z, across) = self.split(&(point - self.narrow));
        !self.open && z > 0.0 && z < self.length && across.norm() < self.radii[0] + self.slope * z
    }

    fn volume(&self) -> f64 {
        let [r, s] = self.radii;
        std::f64::consts::FRAC_PI_3 * self.length * (r * r + r * s + s * s)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{
        Double, all, assert_sound, between, check_leaving, check_pairs, check_scaling, direction,
        dot, ray, ray_to, ts, worst_error,
    };
    use super::*;
    use fastrand::Rng;
    use lancer_scene::{Colour, Position};

    fn cone(base: ([f64; 3], f64), top: ([f64; 3], f64), open: bool) -> (Cone, Barrel) {
        let [base, top] = [base, top].map(|(p, r)| (Position::new(p).unwrap(), r));
        let cone = Cone::new(base, top, open).unwrap();
        (cone, Barrel::new(&cone))
    }

    fn along_z(from: f64, to: f64, radii: [f64; 2], open: bool) -> Barrel {
        cone(([0.0, 0.0, from], radii[0]), ([0.0, 0.0, to], radii[1]), open).1
    }

    /// Atlas C1.
    #[test]
    fn rays_nearly_along_the_axis() {
        let open = along_z(0.0, 1.0, [1.0, 1.0], true);
        let x = 1.0 - 1e-6;
        let found = ts(&open, &ray([x, 0.0, 0.0], [5e-6, 0.0, 1.0]));
        let expected = (1.0 - x) / 5e-6;
        assert_eq!(found.len(), 1);
        assert!((found[0] / expected - 1.0).abs() <= 2.0 * f64::EPSILON, "{found:?}");

        let endless = along_z(0.0, 1e160, [1.0, 1.0], true);
        for s in [1e-3, 1e-8, 1e-20, 1e-100, 1e-150] {
            let found = ts(&endless, &ray([0.5, 0.0, 0.0], [s, 0.0, 1.0]));
            assert_eq!(found.len(), 1, "{s}");
            assert!((found[0] * s / 0.5 - 1.0).abs() <= 2.0 * f64::EPSILON, "{s}: {found:?}");
        }
        for s in [1e-160, 1e-170, 1e-300, 1e-310] {
            for crossing in all(&endless, &ray([0.5, 0.0, 0.0], [s, 0.0, 1.0])) {
                let t = crossing.t * s / 0.5;
                assert!((t - 1.0).abs() < 1e-9, "{s}: {t}");
            }
        }
        let closed = along_z(0.0, 1.0, [1.0, 1.0], false);
        for zero in [0.0, -0.0] {
            for x in [0.0, 0.5, 1.0, -1.0] {
                let up = ray([x, 0.0, -3.0], [zero, -zero, 2.0]);
                let parts: Vec<u32> = all(&closed, &up).iter().map(|c| c.part).collect();
                assert_eq!((ts(&closed, &up), parts), (vec![1.5, 2.0], vec![BASE, TOP]));
                assert!(ts(&open, &up).is_empty());
            }
            assert!(ts(&closed, &ray([1.5, 0.0, -3.0], [zero, zero, 2.0])).is_empty());
        }
    }

    /// Atlas C4: x^2 + y^2 = z^2.
    #[test]
    fn rays_parallel_to_a_line_of_the_side() {
        let shape = along_z(100.0, 0.0, [100.0, 0.0], false);
        // It would meet the mirror image, at t = 2; it goes below the lid.
        assert!(ts(&shape, &ray([3.0, 0.0, 1.0], [-1.0, 0.0, -1.0])).is_empty());
        let found = ts(&shape, &ray([-3.0, 0.0, 1.0], [1.0, 0.0, 1.0]));
        assert_eq!(found, [1.0, 99.0]);
        // Both are rounded, so the expected values are for the direction as it is:
        // |(x, y)|^2 = z^2 with d = (s, 0, c), by the stable formula in doubles twice
        // as long.
        for exponent in [3, 6, 9, 12, 15] {
            let angle = std::f64::consts::FRAC_PI_4 + libm::pow(10.0, f64::from(-exponent));
            let d = [libm::cos(angle), 0.0, libm::sin(angle)];
            let [dx, dz, y, z] = [d[0], d[2], 3.0, 5.0].map(Double::from);
            let a = dx * dx - dz * dz;
            let b = Double::from(0.0) - dz * z;
            let c = y * y - z * z;
            let root = (b * b - a * c).sqrt();
            // b < 0 and both c / e and e / a are roots; the near one is c / e.
            let expected = (c / (root - b)).0;
            for sign in [1.0, -1.0] {
                let found = ts(&shape, &ray([0.0, 3.0, 5.0], d.map(|c| c * sign)));
                let near = found.iter().map(|t| t * sign).fold(f64::NAN, f64::min);
                let error = near / expected - 1.0;
                assert!(error.abs() <= 1e-13, "{exponent}: {near} {expected} {error:e}");
            }
            if exponent == 12 {
                assert!((expected + 2.262_741_699_797_77).abs() < 1e-11, "{expected}");
            }
        }
    }

    /// Atlas C5.
    #[test]
    fn the_apex_has_a_normal() {
        for open in [false, true] {
            let shape = along_z(1.0, 0.0, [1.0, 0.0], open);
            for d in [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [1.0, 0.5, 0.3], [0.2, 0.1, -1.0]] {
                let through = Ray::new(Point::from(Vector::from(d) * -3.0), Vector::from(d));
                let list = all(&shape, &through);
                assert!(open || list.len().is_multiple_of(2), "{list:?}");
                for crossing in &list {
                    assert_sound(&shape.contact(&through, crossing));
                }
            }
            let at = Crossing { t: 0.0, part: SIDE };
            let contact = shape.contact(&ray([0.0; 3], [0.0, 0.0, 1.0]), &at);
            let (outward, axis) = (shape.frame.first, Vector::z());
            assert_eq!(contact.point, Point::origin());
            assert!((contact.normal - (outward - axis) * 0.5_f64.sqrt()).amax() < 1e-15);
            // That of the side towards which the ray comes.
            let contact = shape.contact(&ray([0.0; 3], [3.0, -4.0, 1.0]), &at);
            let expected = Vector::new(-0.6, 0.8, -1.0) * 0.5_f64.sqrt();
            assert!((contact.normal - expected).amax() < 1e-15, "{}", contact.normal);
        }
    }

    /// Atlas C3: 0 or 2, and never outside the slab.
    #[test]
    fn rays_through_rims_meet_both_or_none() {
        let triples = [(3, 4, 5), (5, 12, 13), (8, 15, 17), (7, 24, 25), (0, 1, 1), (20, 21, 29)];
        for shape in [
            along_z(0.0, 1.0, [1.0, 1.0], false),
            along_z(0.0, 1.0, [1.0, 0.0], false),
            along_z(0.0, 1.0, [0.0, 1.0], false),
            along_z(0.0, 1.0, [1.0, 0.5], false),
        ] {
            let mut rng = Rng::with_seed(1);
            let rim = (0..250_000).map(|_| {
                let (a, b, c) = triples[rng.usize(0..triples.len())];
                let turn = [(a, b), (b, a), (-a, b), (a, -b), (-b, -a)][rng.usize(0..5)];
                let (x, y) = (f64::from(turn.0) / f64::from(c), f64::from(turn.1) / f64::from(c));
                let (z, r) = if rng.bool() { (0.0, 1.0) } else { (1.0, 1.0) };
                let wide = if shape.radii[0] < 1.0 && rng.bool() { shape.radii[0] } else { r };
                ray_to(&mut rng, &Point::new(x * wide, y * wide, z), 1.0)
            });
            let rays: Vec<Ray> = rim.collect();
            let met = check_pairs(&shape, rays.iter().copied());
            assert!(met > 50_000, "{met}");
            for ray in rays.iter().filter(|ray| ray.origin.coords.norm() < 10.0) {
                for crossing in all(&shape, ray) {
                    let z = ray.at(crossing.t).z;
                    assert!((-1e-14..=1.0 + 1e-14).contains(&z), "{z}");
                }
            }
        }
    }

    fn shapes() -> Vec<(Cone, Barrel)> {
        vec![
            cone(([0.0; 3], 1.0), ([0.0, 0.0, 1.0], 1.0), false),
            cone(([1.0, 2.0, 3.0], 0.5), ([2.0, -1.0, 3.5], 0.5), false),
            cone(([1.0, 2.0, 3.0], 0.0), ([2.0, -1.0, 3.5], 0.7), false),
            cone(([1.0, 2.0, 300.0], 2.0), ([2.0, -1.0, 303.5], 0.7), false),
            // A coin, a hair, a flat cone.
            cone(([5.0, 5.0, 0.0], 3.0), ([5.0, 5.001, 0.0], 3.0), false),
            cone(([0.0; 3], 1e-4), ([10.0, 7.0, 3.0], 2e-4), false),
            cone(([0.1, 0.1, 0.1], 5.0), ([0.1, 0.2, 0.11], 0.0), false),
        ]
    }

    /// At points inside, on the side, on lids and rims, and on the axis.
    fn rays(cone: &Cone, seed: u64, count: usize) -> impl Iterator<Item = Ray> {
        let mut rng = Rng::with_seed(seed);
        let axis = cone.top() - cone.base();
        let frame = Frame::new(axis.normalize());
        let (base, radii) = (cone.base(), [cone.base_radius(), cone.top_radius()]);
        (0..count).map(move |_| {
            let height = [0.0, 1.0, rng.f64(), rng.f64()][rng.usize(0..4)];
            let radius = radii[0] + (radii[1] - radii[0]) * height;
            let reach = [0.0, 1.0, rng.f64(), 1.0 + 1e-12][rng.usize(0..4)];
            let (s, c) = lancer_math::sin_cos_degrees(360.0 * rng.f64());
            let aside = frame.first * c + frame.second * s;
            let target = base + axis * height + aside * (radius * reach);
            ray_to(&mut rng, &target, axis.norm() + radius)
        })
    }

    #[test]
    fn crossings_come_in_pairs_and_contacts_are_on_the_surface() {
        for (cone, shape) in shapes() {
            let met = check_pairs(&shape, rays(&cone, 1, 100_000));
            assert!(met > 40_000, "{met} {shape:?}");
            // In arithmetic of twice the length, from the scene's own numbers.
            let axis = between(&cone.top(), &cone.base());
            let length = dot(axis, axis).sqrt();
            let [r, s] = [cone.base_radius(), cone.top_radius()].map(Double::from);
            let slope = (s - r) / length;
            let (worst, count) = worst_error(&shape, rays(&cone, 2, 100_000), |p, part| {
                let w = between(p, &cone.base());
                let z = dot(w, axis) / length;
                let distance = (dot(w, w) - z * z).sqrt();
                let off_side =
                    (distance - (r + slope * z)) / (Double::from(1.0) + slope * slope).sqrt();
                match part {
                    SIDE => {
                        let beyond = (-z.0).max((z - length).0).max(0.0);
                        off_side.0.abs() + beyond
                    }
                    BASE => z.0.abs() + (distance - r).0.max(0.0),
                    _ => (z - length).0.abs() + (distance - s).0.max(0.0),
                }
            });
            assert!(worst <= 1.0 && count > 80_000, "{worst} of {count} {shape:?}");
        }
    }

    #[test]
    fn rays_leave_the_surface_they_start_from() {
        for (cone, shape) in shapes() {
            let mut rng = Rng::with_seed(11);
            let mut aim = Rng::with_seed(12);
            let axis = cone.top() - cone.base();
            let rays = (0..30_000).map(|_| {
                let target = cone.base() + axis * (0.1 + 0.8 * aim.f64());
                let way = direction(&mut aim);
                Ray::new(target - way * (2.0 * aim.f64()), way)
            });
            let wrong = check_leaving(&shape, true, &mut rng, rays);
            assert_eq!(wrong, 0, "{shape:?}");
        }
    }

    #[test]
    fn open_ones_have_a_side_alone() {
        let tube = along_z(0.0, 2.0, [1.0, 1.0], true);
        assert_eq!(ts(&tube, &ray([-3.0, 0.0, 1.0], [1.0, 0.0, 0.0])), [2.0, 4.0]);
        assert_eq!(ts(&tube, &ray([-1.5, 0.0, -1.0], [1.0, 0.0, 1.0])), [2.5]);
        assert!(ts(&tube, &ray([0.0, 0.0, -1.0], [0.0, 0.1, 1.0])).is_empty());
        assert!(!tube.contains(&Point::new(0.0, 0.0, 1.0)));
        let inside = ray([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]);
        let contact = tube.contact(&inside, &tube.nearest(&inside, 9.0).unwrap());
        assert_eq!(contact.normal, Vector::y());
    }

    #[test]
    fn volumes_and_boxes() {
        let pi = std::f64::consts::PI;
        assert!((along_z(1.0, 3.0, [2.0, 2.0], false).volume() - 8.0 * pi).abs() < 1e-13);
        assert!((along_z(1.0, 4.0, [2.0, 0.0], false).volume() - 4.0 * pi).abs() < 1e-13);
        let (_, shape) = cone(([1.0, 1.0, 1.0], 2.0), ([4.0, 5.0, 1.0], 1.0), false);
        let bounds = shape.bounds().unwrap();
        // The axis is (0.6, 0.8, 0), so the circles reach 0.8 and 0.6 of their radii.
        let expected = [[1.0 - 1.6, 1.0 - 1.2, -1.0], [4.0 + 0.8, 5.0 + 0.6, 3.0]].map(Point::from);
        assert!((bounds.min - expected[0]).amax() < 1e-13, "{bounds:?}");
        assert!((bounds.max - expected[1]).amax() < 1e-13, "{bounds:?}");
    }

    #[test]
    fn checkers_go_along_and_around() {
        let mut checker = Checker::new(Colour::RED);
        checker.length = lancer_scene::Length::new(0.5).unwrap();
        for top in [1.0, 0.25] {
            let shape = along_z(0.0, 1.0, [1.0, top], false);
            // The first axis is z x X = Y.
            for (x, y, z, expected) in [
                (-0.1, 1.0, 0.2, Cell::First),
                (0.1, 1.0, 0.2, Cell::Second),
                (-0.1, 1.0, 0.7, Cell::Second),
                (-0.7, 0.7, 0.2, Cell::Second),
            ] {
                let from = ray([9.0 * x, 9.0 * y, z], [-x, -y, 0.0]);
                let crossing = shape.nearest(&from, 100.0).unwrap();
                let contact = shape.contact(&from, &crossing);
                assert_eq!(shape.cell(&contact, crossing.part, &checker), expected, "{x} {y} {z}");
            }
            for (x, y, expected) in [(-0.01, 0.2, Cell::First), (-0.01, 0.8, Cell::Second)] {
                let from = ray([x, y, -9.0], [0.0, 0.0, 1.0]);
                let crossing = shape.nearest(&from, 100.0).unwrap();
                let contact = shape.contact(&from, &crossing);
                assert_eq!((contact.normal, crossing.part), (-Vector::z(), BASE));
                assert_eq!(shape.cell(&contact, BASE, &checker), expected, "{x} {y}");
            }
        }
    }

    #[test]
    fn a_tip_seen_from_afar_is_met_on_the_surface() {
        let shape = along_z(-1.0, 0.0, [0.25, 0.0], true);
        for (x, k) in [0.0, 1e-300, 1e-12].iter().flat_map(|x| (0..40).map(move |k| (*x, k))) {
            let from = ray([x, 0.0, 1e6 + 1e4 * f64::from(k) / 7.0], [0.0, 0.0, -1.0]);
            let t = from.origin.z + 1e-9 * f64::from(k);
            let contact = shape.contact(&from, &Crossing { t, part: SIDE });
            let p = contact.point;
            let off = libm::hypot(p.x, p.y) + 0.25 * p.z;
            assert!(off.abs() <= contact.error, "{off:e} {contact:?}");
        }
    }

    #[test]
    fn scaled_by_powers_of_two_the_bits_are_the_same() {
        for (given, _) in shapes() {
            let rays: Vec<Ray> = rays(&given, 3, 2000).collect();
            check_scaling(
                |k| {
                    let place = |p: Point| [p.x * k, p.y * k, p.z * k];
                    let base = (place(given.base()), given.base_radius() * k);
                    Box::new(cone(base, (place(given.top()), given.top_radius() * k), false).1)
                },
                &rays,
            );
        }
    }
}
