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

use super::clip::kept_in;
use super::exact::difference_of_products;
use super::frame::{Frame, across};
use crate::Crossing;
use crate::checker;
use crate::crossing::Crossings;
use crate::near::{Near, stepped};
use crate::primitive::{Contact, Primitive, Square};
use lancer_math::{Bounds, Point, Ray, Vector, unit};
use lancer_scene::{Checker, Cone};

const SIDE: u32 = 0;
const BASE: u32 = 1;
const TOP: u32 = 2;

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
    bounds: Bounds,
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
        let narrow = if narrows { top } else { base };
        let axis = if narrows { -frame.axis } else { frame.axis };
        let size = length + radii[1];
        // Around the circles of both lids.
        let circle = |centre: Point, radius: f64| {
            Bounds { min: centre, max: centre }.grown(across(&axis) * radius)
        };
        let around = circle(narrow, radii[0]).union(circle(narrow + axis * length, radii[1]));
        let slack = 8.0 * f64::EPSILON * (narrow.coords.amax() + size);
        Self {
            base,
            narrow,
            frame,
            axis,
            length,
            radii,
            slope: (radii[1] - radii[0]) / length,
            lids,
            size,
            bounds: around.grown(Vector::repeat(slack)),
            open: cone.open,
        }
    }

    /// The ray from where it is nearest to the narrow end, or from its origin if that is no
    /// more than twice as far: then, where it meets the shape, the origin is within some
    /// sizes of it.
    ///
    /// A rounding of an origin R away moves b and c by as many of R^2 as of the squared
    /// distance r at which the side is met, and its normal distance by R / r of
    /// that. So what counts is how much farther the origin is than the narrow end from the
    /// place, and not whether it is far as against the size.
    #[inline]
    fn near(&self, ray: &Ray) -> Near {
        let near = Near::new(ray, &self.narrow);
        let origin = ray.origin - self.narrow;
        if 2.0 * near.origin.amax() < origin.amax() {
            near
        } else {
            Near { origin, shift: 0.0, ..near }
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
            // Both 0 where it touches at its origin. Where it touches, both may be lost in
            // roundings: then that of c is no farther than the other, which is small.
            let (far, near) = if e == 0.0 { (0.0, 0.0) } else { (e / a, c / e) };
            let near = if near.abs() > far.abs() { far.abs().copysign(near) } else { near };
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
        let near = self.near(ray);
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
            // Where the side is nearly a lid, a rounding along the axis is many across it.
            let ends = [from, to].map(|end| near.t(end.t));
            let Some(ends) = kept_in(&self.bounds, ray, ends) else { return crossings };
            for (t, end) in ends.into_iter().zip([from, to]) {
                if end.part == SIDE || !self.open {
                    crossings.add(t, end.part);
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
    fn square(&self, contact: &Contact, part: u32, checker: &Checker) -> Square {
        let at = self.frame.local(&(contact.point - self.base));
        let across = (at.x * at.x + at.y * at.y).sqrt();
        let along = if part == SIDE { at.z } else { across };
        let turn = checker::turn(at.x, at.y);
        let (length, angle) = (checker.length.get(), checker.angle.get());
        let slack = checker::slack(contact.error, length);
        let slack_around = checker::slack_around(contact.error, across, angle);
        checker::square([along / length, turn / angle], [slack, slack_around])
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(self.bounds)
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
mod tests;
