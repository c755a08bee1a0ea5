//! Spheres.
//!
//! From the point of the ray that is nearest to the centre, where the
//! quadratic has no linear term to cancel ([`Near`]): with p that point and d
//! the direction, the crossings are at -+sqrt((r - |p|)(r + |p|)) / |d| from it.
//! Touching (|p| = r) counts as two crossings at one place; r below the smallest
//! square root of a double is beyond what can be met.

use crate::checker;
use crate::crossing::{Crossing, Crossings};
use crate::near::Near;
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
}

impl Primitive for Ball {
    #[inline]
    fn crossings(&self, ray: &Ray) -> Crossings {
        let near = Near::new(ray, &self.centre);
        // What is left along the ray after moving: rounding, but it must not be
        // lost where the ray's origin is very near to the surface.
        let d2 = near.direction.norm_squared();
        let along = near.origin.dot(&near.direction) / d2;
        let p2 = near.origin.norm_squared() - along * along * d2;
        let p = p2.sqrt();
        let under_root = (self.radius - p) * (self.radius + p);
        let mut crossings = Crossings::NONE;
        // Not for NaN either.
        if under_root >= 0.0 {
            let half = (under_root / d2).sqrt();
            crossings.add(near.shift - along - half, 0);
            crossings.add(near.shift - along + half, 0);
        }
        crossings
    }

    fn contact(&self, ray: &Ray, crossing: &Crossing) -> Contact {
        let near = Near::new(ray, &self.centre);
        let from_centre = near.origin + near.direction * (crossing.t - near.shift);
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
        (point - self.centre).norm() < self.radius
    }

    fn volume(&self) -> f64 {
        4.0 / 3.0 * std::f64::consts::PI * self.radius * self.radius * self.radius
    }
}
