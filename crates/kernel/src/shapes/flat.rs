//! Discs and rectangles: parts of a plane, with no inside.
//!
//! The plane is met as in `plane.rs`, from the point of the ray that is nearest
//! to the shape if the ray comes from afar ([`Near`]), so that the point that
//! is compared with the border has an error of the shape's size. A point on the
//! border belongs to the shape.

use super::exact::{cross, tamed};
use super::frame::{Frame, across};
use crate::Crossing;
use crate::checker;
use crate::crossing::Crossings;
use crate::near::{Near, stepped};
use crate::primitive::{Contact, Primitive, Square};
use lancer_math::{Bounds, Point, Ray, Vector, unit};
use lancer_scene::{Checker, Direction, Disc, Rectangle};

#[derive(Debug)]
pub(crate) struct Round {
    centre: Point,
    /// With its largest component in [1, 2), exact.
    normal: Vector,
    radius: f64,
    frame: Frame,
}

impl Round {
    pub(crate) fn new(disc: &Disc) -> Self {
        let normal = disc.normal.get();
        Self {
            centre: disc.centre.get(),
            normal: tamed(&normal),
            radius: disc.radius.get(),
            frame: Frame::new(unit(normal).unwrap_or_else(Vector::z)),
        }
    }
}

impl Primitive for Round {
    #[inline]
    fn crossings(&self, ray: &Ray) -> Crossings {
        let near = Near::around(ray, &self.centre, self.radius);
        let along = -(self.normal.dot(&near.origin) / self.normal.dot(&near.direction));
        let at = near.origin + near.direction * along;
        let mut crossings = Crossings::NONE;
        // Not for NaN either.
        if at.norm() <= self.radius {
            crossings.add(near.t(along), 0);
        }
        crossings
    }

    /// The point is put into the plane and, if it lies beyond the border by the
    /// rounding of a large t, onto that: 4 u of the radius for the sums of
    /// three products that put it into the plane, as much for its length and
    /// the quotient, u of the coordinates for adding the centre.
    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let at = stepped(&ray.origin, &self.centre, crossing.t, &ray.direction);
        let at = at - self.frame.axis * self.frame.axis.dot(&at);
        let distance = at.norm();
        let at = if distance > self.radius { at * (self.radius / distance) } else { at };
        Contact {
            point: self.centre + at,
            error: 8.0 * f64::EPSILON * (self.centre.coords.amax() + self.radius),
            normal: self.frame.axis,
            shading: self.frame.axis,
        }
    }

    fn square(&self, contact: &Contact, _part: u32, checker: &Checker) -> Square {
        let length = checker.length.get();
        let at = self.frame.local(&(contact.point - self.centre)) / length;
        checker::square([at.x, at.y], [checker::slack(contact.error, length); 2])
    }

    fn bounds(&self) -> Option<Bounds> {
        let slack = 4.0 * f64::EPSILON * (self.centre.coords.amax() + self.radius);
        let reach = across(&self.frame.axis) * self.radius + Vector::repeat(slack);
        Some(Bounds { min: self.centre, max: self.centre }.grown(reach))
    }
}

/// A flat piece with a corner and two sides there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Patch {
    pub(crate) corner: Point,
    pub(crate) sides: [Vector; 2],
    /// Perpendicular to both sides, with its largest component in [1, 2).
    pub(crate) normal: Vector,
    /// Of the same direction, and of length 1.
    pub(crate) unit_normal: Vector,
    /// Vectors whose products with a point of the plane, relative to the corner,
    /// say how many sides it is away.
    duals: [Vector; 2],
    /// The unit vectors along the first side, and in the plane across it.
    axes: [Vector; 2],
}

impl Patch {
    pub(crate) fn new(corner: Point, sides: [Vector; 2]) -> Self {
        let [a, b] = sides;
        let normal = tamed(&cross(&tamed(&a), &tamed(&b)));
        let unit_normal = unit(normal).unwrap_or_else(Vector::z);
        let along = unit(a).unwrap_or_else(Vector::x);
        let (over_b, over_a) = (cross(&b, &normal), cross(&normal, &a));
        Self {
            corner,
            sides,
            normal,
            unit_normal,
            duals: [over_b / over_b.dot(&a), over_a / over_a.dot(&b)],
            axes: [along, unit_normal.cross(&along)],
        }
    }

    /// How many sides a point of the plane, relative to the corner, is away.
    #[inline]
    pub(crate) fn shares(&self, at: &Vector) -> [f64; 2] {
        self.duals.map(|dual| dual.dot(at))
    }

    /// The point so many sides away. Its distance from the exact plane comes
    /// from two products and two sums, 3 u of the corner and both sides.
    pub(crate) fn contact(&self, [first, second]: [f64; 2], size: f64) -> Contact {
        Contact {
            point: self.corner + (self.sides[0] * first + self.sides[1] * second),
            error: 8.0 * f64::EPSILON * size,
            normal: self.unit_normal,
            shading: self.unit_normal,
        }
    }

    /// The cell of squares along the first side.
    pub(crate) fn square(&self, contact: &Contact, checker: &Checker) -> Square {
        let length = checker.length.get();
        let at = contact.point - self.corner;
        let squares = self.axes.map(|axis| axis.dot(&at) / length);
        checker::square(squares, [checker::slack(contact.error, length); 2])
    }
}

#[derive(Debug)]
pub(crate) struct Sheet {
    patch: Patch,
    /// The sum of the largest components of its corner and its sides.
    size: f64,
    /// That of the sides alone.
    reach: f64,
}

impl Sheet {
    pub(crate) fn new(rectangle: &Rectangle) -> Self {
        let [a, b] = rectangle.sides().map(Direction::get);
        let reach = a.amax() + b.amax();
        let corner = rectangle.corner();
        Self { patch: Patch::new(corner, [a, b]), size: corner.coords.amax() + reach, reach }
    }
}

impl Primitive for Sheet {
    #[inline]
    fn crossings(&self, ray: &Ray) -> Crossings {
        let patch = &self.patch;
        let near = Near::around(ray, &patch.corner, self.reach);
        let along = -(patch.normal.dot(&near.origin) / patch.normal.dot(&near.direction));
        let shares = patch.shares(&(near.origin + near.direction * along));
        let mut crossings = Crossings::NONE;
        // Not for NaN either.
        if shares.iter().all(|share| *share >= 0.0 && *share <= 1.0) {
            crossings.add(near.t(along), 0);
        }
        crossings
    }

    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let at = stepped(&ray.origin, &self.patch.corner, crossing.t, &ray.direction);
        let shares = self.patch.shares(&at).map(|share| share.clamp(0.0, 1.0));
        self.patch.contact(shares, self.size)
    }

    fn square(&self, contact: &Contact, _part: u32, checker: &Checker) -> Square {
        self.patch.square(contact, checker)
    }

    fn bounds(&self) -> Option<Bounds> {
        let Patch { corner, sides: [a, b], .. } = self.patch;
        let around = Bounds::around([corner, corner + a, corner + b, corner + a + b]);
        Some(around.grown(Vector::repeat(2.0 * f64::EPSILON * self.size)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{
        between, check_scaling, direction, dot, doubles, minus, ray, ray_to, times, ts, worst_error,
    };
    use super::*;
    use crate::primitive::Cell;
    use fastrand::Rng;
    use lancer_scene::{Colour, Geometry, Shape, Surface};

    fn disc(centre: [f64; 3], normal: [f64; 3], radius: f64) -> Round {
        let shape = Shape::disc(centre, normal, radius, Surface::new(Colour::RED)).unwrap();
        let Geometry::Disc(disc) = shape.geometry else { panic!("a disc") };
        Round::new(&disc)
    }

    fn rectangle(corner: [f64; 3], sides: [[f64; 3]; 2]) -> Sheet {
        let shape = Shape::rectangle(corner, sides, Surface::new(Colour::RED)).unwrap();
        let Geometry::Rectangle(rectangle) = shape.geometry else { panic!("a rectangle") };
        Sheet::new(&rectangle)
    }

    #[test]
    fn borders_belong_to_the_shape() {
        let five = disc([0.0, 0.0, 2.0], [0.0, 0.0, -3.0], 5.0);
        let one = rectangle([1.0, 1.0, 2.0], [[2.0, 0.0, 0.0], [1.0, 4.0, 0.0]]);
        for (x, y, on_disc, on_rectangle) in [
            (3.0, 4.0, true, true),
            (5.0, 0.0, true, false),
            (3.0, f64::next_up(4.0), false, true),
            (1.0, 1.0, true, true),
            (4.0, 5.0, false, true),
            (2.0, 5.0, false, true),
            (f64::next_down(1.0), 1.0, true, false),
            (1.0, 2.0, true, false),
            (1.5, 3.0, true, true),
        ] {
            for o in [0.0, 4.0, 1e9] {
                let ray = ray([x, y, o], [0.0, 0.0, -0.5]);
                let expected = [2.0 * (o - 2.0)];
                assert_eq!(ts(&five, &ray), expected[..usize::from(on_disc)], "{x} {y}");
                assert_eq!(ts(&one, &ray), expected[..usize::from(on_rectangle)], "{x} {y}");
            }
        }
        // In the plane, and without a direction.
        for d in [[1.0, 0.0, 0.0], [1.0, 2.0, -0.0], [0.0; 3], [f64::NAN, 0.0, 1.0]] {
            assert!(ts(&five, &ray([0.0, 0.0, 2.0], d)).is_empty());
            assert!(ts(&one, &ray([2.0, 2.0, 2.0], d)).is_empty());
        }
    }

    /// The share of a hit disc is pi / 4 of the square around it, and the nearest
    /// hit from far away is where it is from near by.
    #[test]
    fn areas_are_right_from_afar() {
        let mut rng = Rng::with_seed(2);
        let small = disc([1.0, 2.0, 3.0], [1.0, -2.0, 0.5], 1e-3);
        let Frame { first, second, axis } = small.frame;
        let mut met = [0, 0];
        for _ in 0..100_000 {
            let [i, j] = [1e-3, 1e-3].map(|r| r * (2.0 * rng.f64() - 1.0));
            let target = small.centre + first * i + second * j;
            let way = (direction(&mut rng) + axis * 1.5).normalize();
            for (k, distance) in [0.5, 1e6].into_iter().enumerate() {
                let ray = Ray::new(target - way * distance, way);
                met[k] += small.crossings(&ray).iter().count();
            }
        }
        for met in met {
            let share = f64::from(met as u32) / 1e5;
            assert!((share - std::f64::consts::FRAC_PI_4).abs() < 0.005, "{share}");
        }
    }

    #[test]
    fn contacts_are_on_the_exact_shapes() {
        let mut rng = Rng::with_seed(4);
        for (centre, normal, radius) in
            [([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], 1.0), ([10.0, -700.0, 3.0], [1.0, 2.0, -2.5], 20.0)]
        {
            let shape = disc(centre, normal, radius);
            let rays = (0..50_000).map(|_| {
                let target = shape.centre + direction(&mut rng) * (radius * rng.f64());
                ray_to(&mut rng, &target, radius)
            });
            let n = doubles(&Vector::from(normal));
            let (worst, count) = worst_error(&shape, rays, |p, _| {
                let w = between(p, &shape.centre);
                let off = dot(w, n) / dot(n, n).sqrt();
                let beyond = (dot(w, w).sqrt().0 - radius).max(0.0);
                off.0.abs() + beyond
            });
            assert!(worst <= 1.0 && count > 10_000, "{worst} of {count}");
        }
        for (corner, sides) in [
            ([0.0; 3], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
            ([10.0, -700.0, 3.0], [[3.0, 1.0, 2.0], [2.5, 1.0, -7.0]]),
            ([1e6, 1e6, 1e6], [[1e-3, 0.0, 0.0], [0.0, 1e-3, 1e-3]]),
        ] {
            let shape = rectangle(corner, sides);
            let [a, b] = sides.map(Vector::from);
            let rays = (0..50_000).map(|_| {
                let target = shape.patch.corner + a * rng.f64() + b * rng.f64();
                ray_to(&mut rng, &target, shape.reach)
            });
            let [a, b] = [a, b].map(|side| doubles(&side));
            let (worst, count) = worst_error(&shape, rays, |p, _| {
                let w = between(p, &shape.patch.corner);
                // What is left after the parts along the sides (Gram and Schmidt).
                let u = times(a, dot(a, b) / dot(a, a));
                let c = minus(b, u);
                let w = minus(w, times(c, dot(w, c) / dot(c, c)));
                let w = minus(w, times(a, dot(w, a) / dot(a, a)));
                dot(w, w).sqrt().0
            });
            assert!(worst <= 1.0 && count > 25_000, "{worst} of {count}");
        }
    }

    #[test]
    fn normals_and_cells() {
        let mut checker = Checker::new(Colour::RED);
        checker.length = lancer_scene::Length::new(0.5).unwrap();
        let shape = rectangle([1.0, 1.0, 1.0], [[0.0, 3.0, 0.0], [0.0, 1.0, 2.0]]);
        // Along the first side, and across it, also where the second is oblique.
        for (y, z, expected) in [
            (1.3, 1.1, Cell::First),
            (1.8, 1.1, Cell::Second),
            (1.8, 1.6, Cell::First),
            (2.2, 2.2, Cell::First),
        ] {
            let ray = ray([5.0, y, z], [-1.0, 0.0, 0.0]);
            let contact = shape.contact(&ray, &shape.nearest(&ray, 10.0).unwrap());
            assert_eq!(contact.normal, Vector::x());
            assert_eq!(shape.square(&contact, 0, &checker).cell, expected, "{y} {z}");
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
        check_scaling(|k| Box::new(disc([0.1 * k, 0.2 * k, -0.3 * k], [0.3, 0.4, 0.1], k)), &rays);
        check_scaling(
            |k| {
                let sides = [[k, 0.3 * k, 0.1 * k], [0.2 * k, -k, 0.7 * k]];
                Box::new(rectangle([-0.5 * k, 0.2 * k, -0.3 * k], sides))
            },
            &rays,
        );
    }
}
