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
use crate::checker;
use crate::crossing::Crossings;
use crate::primitive::{Cell, Contact, Primitive};
use crate::Crossing;
use lancer_math::{Bounds, Point, Ray, Vector, unit};
use lancer_scene::{Checker, Plane};

#[derive(Debug)]
pub(crate) struct HalfSpace {
    origin: Point,
    /// With its largest component in [1, 2), exact.
    normal: Vector,
    frame: Frame,
}

impl HalfSpace {
    pub(crate) fn new(plane: &Plane) -> Self {
        let normal = plane.normal.get();
        let frame = Frame::new(unit(normal).unwrap_or_else(Vector::z));
        Self { origin: plane.origin.get(), normal: tamed(&normal), frame }
    }
}

/// `p` put onto a plane, and how far from it that is at most.
///
/// With x = p - origin and u half of EPSILON: the subtraction and the product
/// n . x of three terms err by up to 4 u |n| |x|, in Euclidean lengths, and
/// rounding the result by u for each coordinate. In terms of the largest
/// coordinates this is below 9 u (|p| + |origin|).
#[inline]
pub(crate) fn put_on_plane(p: &Point, origin: &Point, normal: &Vector) -> (Point, f64) {
    let off = (p - origin).dot(normal) / normal.norm_squared();
    let point = p - normal * off;
    (point, 8.0 * f64::EPSILON * (point.coords.amax() + origin.coords.amax()))
}

impl Primitive for HalfSpace {
    #[inline]
    fn crossings(&self, ray: &Ray) -> Crossings {
        let ahead = self.normal.dot(&(self.origin - ray.origin));
        let mut crossings = Crossings::NONE;
        crossings.add(ahead / self.normal.dot(&ray.direction), 0);
        crossings
    }

    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let (point, error) = put_on_plane(&ray.at(crossing.t), &self.origin, &self.normal);
        Contact { point, error, normal: self.frame.axis, shading: self.frame.axis }
    }

    fn cell(&self, contact: &Contact, _part: u32, checker: &Checker) -> Cell {
        let at = self.frame.local(&(contact.point - self.origin)) / checker.length.get();
        checker::cell(at.x, at.y)
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
