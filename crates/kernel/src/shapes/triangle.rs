//! Triangles; whether a ray meets one is decided in `edges.rs`.

use super::edges::{Meeting, Shear};
use super::exact::{cross, tamed};
use super::flat::Patch;
use crate::Crossing;
use crate::crossing::Crossings;
use crate::primitive::{Cell, Contact, Primitive};
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

    fn cell(&self, contact: &Contact, _part: u32, checker: &Checker) -> Cell {
        self.patch.cell(&contact.point, checker)
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(Bounds::around(self.corners))
    }

    fn contains(&self, _point: &Point) -> bool {
        false
    }

    fn volume(&self) -> f64 {
        0.0
    }
}
