//! Whether a ray goes through a triangle, without a gap between neighbours.
//!
//! Woop, Benthin and Wald, *Watertight Ray/Triangle Intersection*, Journal of
//! Computer Graphics Techniques 2(1), 2013: vertices are moved to the ray's
//! origin and sheared along its longest component, so that the ray is the third
//! axis, and the triangle is looked at in the plane of the other two. What that
//! rounds depends on the vertex alone, so neighbours agree on where a shared
//! vertex is.
//!
//! Ours differs in two ways. The sign of an edge function is exact (the paper
//! computes it again in a higher precision only where it is 0). And where it is
//! exactly 0, the ray counts as moved by an infinitely small amount along the
//! first and a much smaller one along the second axis (Edelsbrunner and Mücke,
//! *Simulation of Simplicity*, 1990): a ray through an edge or a vertex of a
//! closed mesh meets it an even number of times, and where the mesh is not folded
//! there, exactly one of the triangles around.
//!
//! A triangle that the ray sees edge on has no area in that plane and is never
//! met. Products of coordinates must be in the range of doubles.

use super::exact::{compare_products, difference_of_products};
use lancer_math::{Point, Ray};

/// A ray made ready to be held against triangles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shear {
    origin: Point,
    /// The axes of the plane, and that of the longest component.
    axes: [usize; 3],
    /// Its other components in terms of the longest one, and that.
    slopes: [f64; 2],
    longest: f64,
    others: [f64; 2],
}

/// Where a ray meets a triangle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Meeting {
    pub(crate) t: f64,
    /// Of its corners: not negative, and 1 together, up to rounding.
    pub(crate) weights: [f64; 3],
}

/// A vertex as the ray sees it.
#[derive(Clone, Copy)]
struct Seen {
    x: f64,
    y: f64,
    /// Along the axis of the longest component.
    z: f64,
}

impl Shear {
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> Self {
        let z = ray.direction.iamax();
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let longest = ray.direction[z];
        let others = [ray.direction[axes[0]], ray.direction[axes[1]]];
        let slopes = [others[0] / longest, others[1] / longest];
        Self { origin: ray.origin, axes, slopes, longest, others }
    }

    /// Those of the plane, and that of the direction's longest component.
    #[inline(always)]
    pub(crate) const fn axes(&self) -> [usize; 3] {
        self.axes
    }

    #[inline(always)]
    pub(crate) const fn origin(&self) -> &Point {
        &self.origin
    }

    #[inline(always)]
    pub(crate) const fn slopes(&self) -> [f64; 2] {
        self.slopes
    }

    #[inline(always)]
    pub(crate) const fn longest(&self) -> f64 {
        self.longest
    }

    /// The direction's other components.
    #[inline(always)]
    pub(crate) const fn others(&self) -> [f64; 2] {
        self.others
    }

    #[inline(always)]
    fn see(&self, vertex: &[f64; 3]) -> Seen {
        let [i, j, k] = self.axes;
        let (x, y, z) =
            (vertex[0] - self.origin[i], vertex[1] - self.origin[j], vertex[2] - self.origin[k]);
        Seen { x: x - self.slopes[0] * z, y: y - self.slopes[1] * z, z }
    }

    #[inline(always)]
    pub(crate) fn meet(&self, corners: &[Point; 3]) -> Option<Meeting> {
        let [i, j, k] = self.axes;
        self.meet_turned(&corners.map(
            #[inline(always)]
            |corner| [corner[i], corner[j], corner[k]],
        ))
    }

    /// The same for corners whose coordinates are in the order of the axes.
    #[inline(always)]
    pub(crate) fn meet_turned(&self, corners: &[[f64; 3]; 3]) -> Option<Meeting> {
        let [a, b, c] = [self.see(&corners[0]), self.see(&corners[1]), self.see(&corners[2])];
        // All on the same side: NaN is on none.
        let side = side(b, c);
        let met = if side > 0.0 {
            self::side(c, a) > 0.0 && self::side(a, b) > 0.0
        } else {
            side < 0.0 && self::side(c, a) < 0.0 && self::side(a, b) < 0.0
        };
        if !met {
            return None;
        }
        // Of one sign, or 0.
        let areas = [area(b, c), area(c, a), area(a, b)];
        let sum = areas[0] + areas[1] + areas[2];
        let weights = [areas[0] / sum, areas[1] / sum, areas[2] / sum];
        let depth = weights[0] * a.z + weights[1] * b.z + weights[2] * c.z;
        // Between those of its corners, also where the ray grazes it.
        let depth = least(depth, most(most(a.z, b.z), c.z));
        let depth = most(depth, least(least(a.z, b.z), c.z));
        Some(Meeting { t: self.in_box(corners, depth / self.longest), weights })
    }
}

impl Shear {
    /// The t, moved to where the ray is in the triangle's box along the two other
    /// axes, too. Where the ray grazes the triangle, rounding can take it far along
    /// the ray; with this it is never nearer than a box that holds the triangle.
    #[inline(always)]
    fn in_box(&self, corners: &[[f64; 3]; 3], mut t: f64) -> f64 {
        for (k, (&axis, &component)) in self.axes.iter().zip(&self.others).enumerate() {
            if component != 0.0 {
                let inverse = 1.0 / component;
                let origin = self.origin[axis];
                let a = (corners[0][k] - origin) * inverse;
                let b = (corners[1][k] - origin) * inverse;
                let c = (corners[2][k] - origin) * inverse;
                t = least(t, most(most(a, b), c));
                t = most(t, least(least(a, b), c));
            }
        }
        t
    }
}

/// The smaller one, and the first where they cannot be compared.
#[inline(always)]
fn least(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The larger one, and the first where they cannot be compared.
#[inline(always)]
fn most(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

/// Twice that of the triangle of the ray, p and q.
#[inline(always)]
fn area(p: Seen, q: Seen) -> f64 {
    difference_of_products(p.x, q.y, p.y, q.x)
}

/// On which side of the line from p to q the ray goes by; 0 only where p and q
/// are seen in the same place, or for NaN.
#[inline(always)]
fn side(p: Seen, q: Seen) -> f64 {
    let sign = compare_products(p.x, q.y, p.y, q.x);
    if sign != 0.0 {
        sign
    } else if p.y != q.y {
        // The ray moved by (e, e^2) adds e (p.y - q.y) + e^2 (q.x - p.x).
        p.y - q.y
    } else {
        q.x - p.x
    }
}
