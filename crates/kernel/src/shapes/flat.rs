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
use crate::primitive::{Cell, Contact, Primitive};
use lancer_math::{Bounds, Point, Ray, Vector, unit};
use lancer_scene::{Checker, Disc, Rectangle};

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

    fn cell(&self, contact: &Contact, _part: u32, checker: &Checker) -> Cell {
        let at = self.frame.local(&(contact.point - self.centre)) / checker.length.get();
        checker::cell(at.x, at.y)
    }

    fn bounds(&self) -> Option<Bounds> {
        let slack = 4.0 * f64::EPSILON * (self.centre.coords.amax() + self.radius);
        let reach = across(&self.frame.axis) * self.radius + Vector::repeat(slack);
        Some(Bounds { min: self.centre, max: self.centre }.grown(reach))
    }

    fn contains(&self, _point: &Point) -> bool {
        false
    }

    fn volume(&self) -> f64 {
        0.0
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
    pub(crate) fn cell(&self, point: &Point, checker: &Checker) -> Cell {
        let at = point - self.corner;
        let [i, j] = self.axes.map(|axis| axis.dot(&at) / checker.length.get());
        checker::cell(i, j)
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
        let [a, b] = rectangle.sides().map(|side| side.get());
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

    fn cell(&self, contact: &Contact, _part: u32, checker: &Checker) -> Cell {
        self.patch.cell(&contact.point, checker)
    }

    fn bounds(&self) -> Option<Bounds> {
        let Patch { corner, sides: [a, b], .. } = self.patch;
        let around = Bounds::around([corner, corner + a, corner + b, corner + a + b]);
        Some(around.grown(Vector::repeat(2.0 * f64::EPSILON * self.size)))
    }

    fn contains(&self, _point: &Point) -> bool {
        false
    }

    fn volume(&self) -> f64 {
        0.0
    }
}
