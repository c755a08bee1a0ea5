//! Rings.
//!
//! With p the point of the ray nearest to the centre (as in [`Near`]: otherwise
//! the coefficients of the quartic grow with the fourth power of the distance),
//! d its unit direction, R and r the radii of ring and tube, the surface is at the
//! roots of
//!
//!   (t^2 + p^2 + R^2 - r^2)^2 - 4 R^2 ((px + t dx)^2 + (py + t dy)^2),
//!
//! which, p being perpendicular to d, has no cubic term. Only its critical points
//! are found from this polynomial, as the roots of a depressed cubic: between them
//! there is at most one crossing. Whether there is one, and where, is asked of
//! the distance from the ring's circle itself, sqrt((rho - R)^2 + z^2) - r with
//! rho the distance from the axis, which does not cancel and has the same sign:
//! Newton's method, kept within a bracket. Along a line this distance is nearly
//! linear, so it takes few steps.
//!
//! The ends of the line's part that is looked at, where it is in a sphere around
//! all and in a slab as thick as the tube, count as outside. So the number of
//! crossings is even, whatever rounding does; a ray that touches (a double
//! root) has none or two that are next to each other. With r = R (a horn) a ray
//! through the centre touches there.

use super::frame::{Frame, across};
use crate::Crossing;
use crate::checker;
use crate::crossing::Crossings;
use crate::near::{Near, stepped};
use crate::primitive::{Contact, Primitive, Square};
use lancer_math::{Bounds, Point, Ray, Vector, unit};
use lancer_scene::{Checker, Torus};

#[derive(Debug)]
pub(crate) struct Ring {
    centre: Point,
    frame: Frame,
    ring: f64,
    tube: f64,
}

/// A line in the frame of the ring, with a unit direction.
struct Line {
    p: Vector,
    d: Vector,
}

impl Line {
    /// The distance from the axis at `t`.
    #[inline]
    fn rho(&self, t: f64) -> f64 {
        let (x, y) = (self.p.x + t * self.d.x, self.p.y + t * self.d.y);
        (x * x + y * y).sqrt()
    }
}

impl Ring {
    pub(crate) fn new(torus: &Torus) -> Self {
        Self {
            centre: torus.centre.get(),
            frame: Frame::new(unit(torus.axis.get()).unwrap_or_else(Vector::z)),
            ring: torus.ring(),
            tube: torus.tube(),
        }
    }

    /// The part of the line outside of which it surely misses.
    #[inline]
    fn stretch(&self, line: &Line) -> Option<[f64; 2]> {
        let reach = self.ring + self.tube;
        let p = line.p.norm();
        // The root of a negative number is NaN. A little more than it, since the
        // ends must not be inside.
        let half = ((reach - p) * (reach + p)).sqrt() + 4.0 * f64::EPSILON * reach;
        if half.is_nan() {
            return None;
        }
        let (mut from, mut to) = (-half, half);
        let (z, dz) = (line.p.z, line.d.z);
        if dz != 0.0 {
            let (a, b) = ((-self.tube - z) / dz, (self.tube - z) / dz);
            from = from.max(a.min(b));
            to = to.min(a.max(b));
        } else if z.abs() > self.tube {
            return None;
        }
        // Through the hole: the distance from the axis is largest at an end.
        let hole = self.ring - self.tube;
        let through = line.rho(from) < hole && line.rho(to) < hole;
        (from < to && !through).then_some([from, to])
    }

    /// The distance from the tube's surface, negative inside, and how fast it
    /// grows.
    #[inline]
    fn distance(&self, line: &Line, t: f64) -> (f64, f64) {
        let Line { p, d } = line;
        let (x, y, z) = (p.x + t * d.x, p.y + t * d.y, p.z + t * d.z);
        let rho = (x * x + y * y).sqrt();
        let off = rho - self.ring;
        let from_circle = (off * off + z * z).sqrt();
        let slope = (off * ((x * d.x + y * d.y) / rho) + z * d.z) / from_circle;
        (from_circle - self.tube, slope)
    }

    /// The root between a point outside and one inside.
    fn root(&self, line: &Line, mut outside: f64, mut inside: f64) -> f64 {
        // What rounding makes of a distance of 0.
        let noise = 2.0 * f64::EPSILON * (self.ring + self.tube);
        let (mut t, mut last) = (outside, f64::INFINITY);
        // Each step halves the distance or the bracket.
        for _ in 0..200 {
            let (distance, slope) = self.distance(line, t);
            if distance < 0.0 {
                inside = t;
            } else {
                outside = t;
            }
            let newton = t - distance / slope;
            // Not for NaN either.
            let within = newton >= outside.min(inside) && newton <= outside.max(inside);
            if distance.abs() <= noise {
                // A last step, unless the line touches here and the slope is noise.
                let small = (newton - t).abs() <= 1e-10 * (self.ring + self.tube);
                return if within && small { newton } else { t };
            }
            let fast = distance.abs() <= 0.5 * last;
            t = if within && fast { newton } else { 0.5 * (outside + inside) };
            last = distance.abs();
        }
        t
    }

    /// The crossings of the line, in order: how many, and where.
    fn roots(&self, line: &Line) -> (usize, [f64; 4]) {
        let mut roots = [0.0; 4];
        let mut count = 0;
        let Some([from, to]) = self.stretch(line) else { return (0, roots) };
        let Line { p, d } = line;
        let squared = 2.0 * self.ring * self.ring;
        let k = p.norm_squared() + (self.ring - self.tube) * (self.ring + self.tube);
        let linear = k - squared * (d.x * d.x + d.y * d.y);
        let constant = -squared * (p.x * d.x + p.y * d.y);
        let (critical, turns) = cubic_roots(linear, constant, from, to);
        let (mut last, mut last_inside) = (from, false);
        for &t in turns[..critical].iter().chain([&to]) {
            let inside = t < to && self.distance(line, t).0 < 0.0;
            if inside != last_inside {
                roots[count] =
                    if inside { self.root(line, last, t) } else { self.root(line, t, last) };
                count += 1;
            }
            (last, last_inside) = (t, inside);
        }
        (count, roots)
    }
}

/// The roots of t^3 + p t + q between two numbers, in order, to about nine
/// digits of the interval: how many, and where.
fn cubic_roots(p: f64, q: f64, from: f64, to: f64) -> (usize, [f64; 3]) {
    let value = |t: f64| (t * t + p) * t + q;
    let fine = 1e-10 * (to - from);
    let mut roots = [0.0; 3];
    let mut count = 0;
    let mut piece = |from: f64, to: f64| {
        let (at_from, at_to) = (value(from), value(to));
        // Rising or falling on all of it.
        if from >= to || (at_from < 0.0) == (at_to < 0.0) {
            return;
        }
        let (mut below, mut above) = if at_from < 0.0 { (from, to) } else { (to, from) };
        let mut t = 0.5 * (from + to);
        for _ in 0..200 {
            let here = value(t);
            if here < 0.0 {
                below = t;
            } else {
                above = t;
            }
            let (low, high) = (below.min(above), below.max(above));
            let newton = t - here / (3.0 * t * t + p);
            let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
            let step = (next - t).abs();
            t = next;
            if step <= fine {
                break;
            }
        }
        roots[count] = t;
        count += 1;
    };
    if p >= 0.0 {
        piece(from, to);
    } else {
        // It rises, falls between the turns, and rises.
        let turn = (-p / 3.0).sqrt();
        piece(from, to.min(-turn));
        piece(from.max(-turn), to.min(turn));
        piece(from.max(turn), to);
    }
    (count, roots)
}

impl Primitive for Ring {
    #[inline]
    fn crossings(&self, ray: &Ray) -> Crossings {
        let near = Near::new(ray, &self.centre);
        let length = near.direction.norm();
        let line = Line {
            p: self.frame.local(&near.origin),
            d: self.frame.local(&(near.direction / length)),
        };
        let (count, roots) = self.roots(&line);
        let mut crossings = Crossings::NONE;
        // By whether the line meets it on both sides of the hole: where it stands in front of
        // itself that changes.
        let part = u32::from(count > 2);
        for root in &roots[..count] {
            crossings.add(near.t(root / length), part);
        }
        crossings
    }

    /// Put onto the circle of the tube around the nearest point of the ring.
    ///
    /// The sum with the centre errs by u of the coordinates (u is half of
    /// EPSILON), its terms by 8 u of ring and tube, which is what the two
    /// lengths, quotients and products come to; the rounding of the axis moves
    /// the exact ring by 3 u of its radius.
    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let at = stepped(&ray.origin, &self.centre, crossing.t, &ray.direction);
        let z = self.frame.axis.dot(&at);
        let across = at - self.frame.axis * z;
        let rho = across.norm();
        let outward = if rho > 0.0 { across / rho } else { self.frame.first };
        let off = rho - self.ring;
        let normal = unit(outward * off + self.frame.axis * z).unwrap_or(self.frame.axis);
        Contact {
            point: self.centre + (outward * self.ring + normal * self.tube),
            error: 8.0 * f64::EPSILON * (self.centre.coords.amax() + self.ring + self.tube),
            normal,
            shading: normal,
        }
    }

    fn square(&self, contact: &Contact, _part: u32, checker: &Checker) -> Square {
        let at = self.frame.local(&(contact.point - self.centre));
        let across = (at.x * at.x + at.y * at.y).sqrt();
        let off = across - self.ring;
        let angle = checker.angle.get();
        let slack =
            [across, self.tube].map(|radius| checker::slack_around(contact.error, radius, angle));
        checker::square(
            [checker::turn(at.x, at.y) / angle, checker::turn(off, at.z) / angle],
            slack,
        )
    }

    fn bounds(&self) -> Option<Bounds> {
        let slack = 8.0 * f64::EPSILON * (self.centre.coords.amax() + self.ring + self.tube);
        let reach = across(&self.frame.axis) * self.ring + Vector::repeat(self.tube + slack);
        Some(Bounds { min: self.centre, max: self.centre }.grown(reach))
    }

    fn contains(&self, point: &Point) -> bool {
        let at = self.frame.local(&(point - self.centre));
        let off = (at.x * at.x + at.y * at.y).sqrt() - self.ring;
        (off * off + at.z * at.z).sqrt() < self.tube
    }

    fn volume(&self) -> f64 {
        2.0 * std::f64::consts::PI * std::f64::consts::PI * self.ring * self.tube * self.tube
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{
        Double, between, check_leaving, check_pairs, check_scaling, direction, dot, doubles, minus,
        ray, ray_to, times, ts, worst_error,
    };
    use super::*;
    use crate::primitive::Cell;
    use fastrand::Rng;
    use lancer_scene::{Colour, Direction, Length, Position};

    fn torus(centre: [f64; 3], axis: [f64; 3], ring: f64, tube: f64) -> Ring {
        let [ring, tube] = [ring, tube].map(|r| Length::new(r).unwrap());
        let (centre, axis) = (Position::new(centre).unwrap(), Direction::new(axis).unwrap());
        Ring::new(&Torus::new(centre, axis, ring, tube).unwrap())
    }

    fn around_z(ring: f64, tube: f64) -> Ring {
        torus([0.0; 3], [0.0, 0.0, 1.0], ring, tube)
    }

    fn ulp(x: f64) -> f64 {
        x.next_up() - x
    }

    /// Atlas C6.
    #[test]
    fn far_away() {
        let shape = around_z(1.0, 0.25);
        let through = Vector::new(0.9, 0.1, 0.05);
        let way = -Vector::new(3.0, 2.0, 6.0) / 7.0;
        let near = ts(&shape, &Ray::new(Point::from(through), way));
        for d in [10.0, 100.0, 1e3, 1e4, 1e5, 1e6] {
            let found = ts(&shape, &Ray::new(Point::from(through - way * d), way));
            assert_eq!(found.len(), 2, "{d}");
            if d == 1e4 {
                for (found, expected) in
                    found.iter().zip([9_999.767_097_997_942, 10_000.233_973_236_463])
                {
                    assert!((found - expected).abs() <= 4.0 * ulp(d), "{found}");
                }
            }
            // The origin is rounded to units of d.
            for (found, near) in found.iter().zip(&near) {
                assert!((found - (near + d)).abs() <= 8.0 * ulp(d), "{d}: {found} {near}");
            }
        }
    }

    /// Atlas C7 (a).
    #[test]
    fn touching_from_above() {
        let shape = around_z(1.0, 0.25);
        let rays = |e: f64| ts(&shape, &ray([-3.0, 0.3, 0.25 - e], [1.0, 0.0, 0.0]));
        for (e, x) in [(1e-6, -0.954_680_424_093), (1e-7, -0.954_173_602_418)] {
            let found = rays(e);
            assert_eq!(found.len(), 4, "{e}");
            assert!((found[0] - 3.0 - x).abs() <= 1e-11, "{e}: {}", found[0] - 3.0);
        }
        for e in [1e-8, 1e-9, 1e-12] {
            let found = rays(e);
            // Where z is 0.25 - e, rho is 1 +- sqrt(e (0.5 - e)).
            let off = (e * (0.5 - e)).sqrt();
            let wide = ((1.0 + off) * (1.0 + off) - 0.09).sqrt();
            assert_eq!(found.len(), 4, "{e}");
            assert!((found[0] - (3.0 - wide)).abs() <= 1e-7, "{e}");
        }
        let found = rays(0.0);
        assert!(found.len().is_multiple_of(2));
        assert!(found.iter().all(|t| ((t - 3.0).abs() - 0.91_f64.sqrt()).abs() < 1e-7));
        for e in [-1e-12, -1e-6, -1.0] {
            assert!(rays(e).is_empty(), "{e}");
        }
    }

    /// Atlas C7 (b), (d).
    #[test]
    fn through_the_equator_and_a_horn() {
        let equator = ray([-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
        let found = ts(&around_z(1.0, 0.25), &equator);
        assert_eq!(found.len(), 4);
        for (found, expected) in found.iter().zip([1.75, 2.25, 3.75, 4.25]) {
            assert!((found - expected).abs() <= 4.0 * ulp(expected), "{found}");
        }
        let found = ts(&around_z(1.0, 1.0), &equator);
        assert!(found.len().is_multiple_of(2), "{found:?}");
        assert_eq!((found[0], found[found.len() - 1]), (1.0, 5.0));
        assert!(found[1..found.len() - 1].iter().all(|t| (t - 3.0).abs() < 1e-7), "{found:?}");
    }

    /// Atlas C7 (c): the values of the plane cut, where they are closed forms.
    #[test]
    fn hoops() {
        for (ring, tube) in [(1.0, 1e-2), (1.0, 1e-3), (1.0, 1e-5), (1e5, 0.25)] {
            let shape = around_z(ring, tube);
            // Through the equator, aside of the axis, and down onto the tube.
            let y = 0.3 * ring;
            let found = ts(&shape, &ray([-3.0 * ring, y, 0.0], [1.0, 0.0, 0.0]));
            assert_eq!(found.len(), 4, "{ring} {tube}");
            let root = |r: f64| ((r - y) * (r + y)).sqrt();
            let (wide, narrow) = (root(ring + tube), root(ring - tube));
            let expected = [-wide, -narrow, narrow, wide].map(|x| x + 3.0 * ring);
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() <= 1e-8 * tube, "{ring} {tube}: {found}");
            }
            let aside = 0.6 * tube;
            let found = ts(&shape, &ray([ring + aside, 0.0, 2.0 * tube], [0.0, 0.0, -1.0]));
            for (found, expected) in found.iter().zip([1.2 * tube, 2.8 * tube]) {
                // The place beside the tube's middle is rounded as the ring is.
                let bound = 1e-8 * tube + 2.0 * ulp(ring);
                assert!((found - expected).abs() <= bound, "{ring} {tube}: {found}");
            }
            assert_eq!(found.len(), 2);
        }
    }

    fn shapes() -> [Ring; 5] {
        [
            around_z(1.0, 0.25),
            around_z(1.0, 1.0),
            torus([3.0, -2.0, 0.5], [1.0, 2.0, -2.0], 2.0, 1.5),
            torus([300.0, 20.0, -7.0], [0.1, 0.0, 0.3], 5.0, 0.01),
            torus([0.0; 3], [1.0, 0.0, 0.0], 1.0, 1e-4),
        ]
    }

    /// At points of the tube's inside and its surface, along its tangents, and
    /// through the hole's middle.
    fn rays(shape: &Ring, seed: u64, count: usize) -> impl Iterator<Item = Ray> {
        let mut rng = Rng::with_seed(seed);
        let &Ring { centre, frame, ring, tube } = shape;
        (0..count).map(move |_| {
            let (s, c) = lancer_math::sin_cos_degrees(15.0 * f64::from(rng.u8(0..24)));
            let (v, u) = lancer_math::sin_cos_degrees(360.0 * rng.f64());
            let (s, c) = if rng.bool() { (s, c) } else { (v, u) };
            let outward = frame.first * c + frame.second * s;
            let (v, u) = lancer_math::sin_cos_degrees(15.0 * f64::from(rng.u8(0..24)));
            let normal = outward * u + frame.axis * v;
            let reach = [0.0, 1.0, rng.f64(), 1.0 - 1e-12 * rng.f64()][rng.usize(0..4)];
            let target = centre + outward * ring + normal * (tube * reach);
            match rng.u8(0..8) {
                0 => ray_to(&mut rng, &centre, ring),
                1 => {
                    let turned = frame.first * s - frame.second * c;
                    let way = turned * rng.f64() + normal.cross(&turned) * rng.f64();
                    Ray::new(target - way * (3.0 * ring), way)
                }
                _ => ray_to(&mut rng, &target, ring),
            }
        })
    }

    #[test]
    fn crossings_come_in_pairs_and_contacts_are_on_the_surface() {
        for shape in shapes() {
            let met = check_pairs(&shape, rays(&shape, 1, 200_000));
            assert!(met > 100_000, "{met}");
            let given = doubles(&shape.frame.axis);
            let (worst, count) = worst_error(&shape, rays(&shape, 2, 50_000), |p, _| {
                let w = between(p, &shape.centre);
                let axis = times(given, Double::from(1.0) / dot(given, given).sqrt());
                let z = dot(w, axis);
                let across = minus(w, times(axis, z));
                let off = dot(across, across).sqrt() - Double::from(shape.ring);
                ((off * off + z * z).sqrt() - Double::from(shape.tube)).0
            });
            assert!(worst <= 1.0 && count > 50_000, "{worst} of {count}");
        }
    }

    /// Rays that touch the surface from outside or, at the inner equator, from
    /// inside: all that is found is on the surface, also where slopes are 0.
    #[test]
    fn touching_rays_find_nothing_beside_the_surface() {
        let mut rng = Rng::with_seed(13);
        for shape in shapes() {
            let Ring { centre, frame, ring, tube } = shape;
            for case in 0..100_000 {
                let (s, c) = lancer_math::sin_cos_degrees(360.0 * rng.f64());
                let (v, u) = lancer_math::sin_cos_degrees(360.0 * rng.f64());
                let outward = frame.first * c + frame.second * s;
                let turned = frame.first * s - frame.second * c;
                let normal = outward * u + frame.axis * v;
                // Of the two directions in the surface, one may be left out; and there
                // is one along which the surface of the inner side is flat.
                let up = normal.cross(&turned);
                let curved = (-u * tube / (ring + u * tube)).max(0.0).sqrt();
                let way = match case % 4 {
                    0 => turned,
                    1 => up,
                    2 => turned + up * curved,
                    _ => turned * rng.f64() + up * rng.f64(),
                };
                let off = 1.0 + [0.0, 1e-15, -1e-15, -1e-9][rng.usize(0..4)];
                let target = centre + outward * ring + normal * (tube * off);
                let ray = Ray::new(target - way * (3.0 * ring * rng.f64()), way);
                let size = centre.coords.amax() + 10.0 * ring;
                let found = ts(&shape, &ray);
                assert!(found.len().is_multiple_of(2), "case {case}: {found:?}");
                for t in found {
                    let at = frame.local(&(ray.at(t) - centre));
                    let off = libm::hypot(libm::hypot(at.x, at.y) - ring, at.z) - tube;
                    assert!(off.abs() <= 1e-14 * size, "case {case}: {off:e} {t} {ray:?}");
                }
            }
        }
    }

    /// Each crossing is one, and no more are there: against steps along the ray.
    #[test]
    fn no_crossing_is_missed() {
        let mut rng = Rng::with_seed(9);
        let mut met = [0; 5];
        for case in 0..3000 {
            let shape = torus([0.0; 3], [0.1, 0.2, 0.3], 1.0, [0.1, 0.5, 1.0][case % 3]);
            let mut c = || 2.0 * rng.f64() - 1.0;
            let target = Point::new(c(), c(), c());
            let way = direction(&mut rng);
            let found = ts(&shape, &Ray::new(target, way));
            let steps: Vec<bool> = (0..=4000)
                .map(|i| shape.contains(&(target + way * (f64::from(i) / 500.0 - 4.0))))
                .collect();
            let changes = steps.windows(2).filter(|pair| pair[0] != pair[1]).count();
            // Two within a step are not seen by steps.
            let close = found.windows(2).any(|pair| pair[1] - pair[0] < 0.004);
            assert!(found.len() == changes || close, "case {case}: {found:?} {changes}");
            met[found.len()] += 1;
        }
        assert!(met[0] > 100 && met[2] > 100 && met[4] > 100, "{met:?}");
    }

    #[test]
    fn rays_leave_the_surface_they_start_from() {
        for shape in shapes() {
            let mut rng = Rng::with_seed(11);
            // Where a horn's surface touches itself, outside is inside.
            let aimed: Vec<Ray> = rays(&shape, 12, 30_000)
                .filter(|ray| {
                    shape.crossings(ray).iter().all(|crossing| {
                        let at = shape.contact(ray, &crossing).point - shape.centre;
                        (at - shape.frame.axis * shape.frame.axis.dot(&at)).norm()
                            > 1e-3 * shape.ring
                    })
                })
                .collect();
            let wrong = check_leaving(&shape, false, &mut rng, aimed.into_iter());
            assert_eq!(wrong, 0, "{shape:?}");
        }
    }

    #[test]
    fn volume_box_and_cells() {
        let shape = torus([1.0, 2.0, 3.0], [0.6, 0.8, 0.0], 2.0, 0.5);
        assert!((shape.volume() - std::f64::consts::PI * std::f64::consts::PI).abs() < 1e-14);
        let bounds = shape.bounds().unwrap();
        let reach = Vector::new(1.6 + 0.5, 1.2 + 0.5, 2.5);
        assert!((bounds.max - (shape.centre + reach)).amax() < 1e-13);
        assert!((bounds.min - (shape.centre - reach)).amax() < 1e-13);
        let shape = around_z(1.0, 0.25);
        let checker = Checker::new(Colour::RED);
        // The first axis is z x X = Y; the equator outside is at angle 0.
        for (x, y, z, expected) in [
            (-0.1, 1.2, 0.05, Cell::First),
            (0.1, 1.2, 0.05, Cell::Second),
            (-0.1, 1.2, -0.05, Cell::Second),
            (-0.7, 1.0, 0.05, Cell::Second),
        ] {
            let from = ray([9.0 * x, 9.0 * y, z], [-x, -y, 0.0]);
            let contact = shape.contact(&from, &shape.nearest(&from, 100.0).unwrap());
            assert_eq!(shape.square(&contact, 0, &checker).cell, expected, "{x} {y} {z}");
        }
    }

    #[test]
    fn what_is_no_ray_misses() {
        let shape = around_z(1.0, 0.25);
        for d in [[0.0; 3], [f64::NAN, 0.0, 1.0], [f64::INFINITY, 0.0, 0.0]] {
            assert!(ts(&shape, &ray([1.0, 0.0, 0.0], d)).is_empty(), "{d:?}");
        }
        for k in [1e-200, 1e200] {
            let found = ts(&shape, &ray([1.0, 0.0, 2.0], [0.0, 0.0, -k]));
            assert!((found[0] * k - 1.75).abs() < 1e-15, "{found:?}");
        }
    }

    #[test]
    fn scaled_by_powers_of_two_the_bits_are_the_same() {
        for shape in shapes() {
            let rays: Vec<Ray> = rays(&shape, 3, 2000).collect();
            let (centre, axis) = (shape.centre, shape.frame.axis);
            check_scaling(
                |k| {
                    let centre = [centre.x * k, centre.y * k, centre.z * k];
                    Box::new(torus(centre, axis.into(), shape.ring * k, shape.tube * k))
                },
                &rays,
            );
        }
    }
}
