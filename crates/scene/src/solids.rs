//! Shapes that enclose a space, or do so unless they are left open.

use crate::{Direction, InvalidField, Length, OutOfRange, Position};
use lancer_math::{Point, Vector, unit};

/// A sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Its centre.
    pub centre: Position,
    /// Its radius.
    pub radius: Length,
}

/// A box with sides along the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cuboid {
    min: Point,
    max: Point,
}

impl Cuboid {
    /// The box with two opposite corners.
    ///
    /// # Errors
    /// Where the corners agree in a coordinate, so that it has no inside.
    pub fn new(from: Position, to: Position) -> Result<Self, OutOfRange> {
        let (from, to) = (from.get().coords, to.get().coords);
        if (0..3).any(|axis| from[axis] == to[axis]) {
            let found = format!("({}, {}, {})", to.x, to.y, to.z);
            return Err(OutOfRange::new(found, "a corner that differs in all coordinates"));
        }
        Ok(Self { min: Point::from(from.inf(&to)), max: Point::from(from.sup(&to)) })
    }

    /// The corner with the smallest coordinates.
    #[must_use]
    pub const fn min(&self) -> Point {
        self.min
    }

    /// The corner with the largest coordinates; above the smallest in each.
    #[must_use]
    pub const fn max(&self) -> Point {
        self.max
    }
}

/// A cylinder, cone or frustum: the points on straight lines from a circle
/// around one point to a circle around another, both across the line between
/// them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    base: Position,
    top: Position,
    base_radius: f64,
    top_radius: f64,
    /// Whether it has no lids: a tube, with no inside.
    pub open: bool,
}

impl Cone {
    /// The cone between circles around `base` and `top`; one of the radii may
    /// be 0.
    ///
    /// # Errors
    /// Where the centres are the same point, or a radius is not finite and at
    /// least 0, or both are 0.
    pub fn new(
        (base, base_radius): (Position, f64),
        (top, top_radius): (Position, f64),
        open: bool,
    ) -> Result<Self, InvalidField> {
        for (field, radius) in [("base_radius", base_radius), ("top_radius", top_radius)] {
            if !(radius >= 0.0 && radius.is_finite()) {
                let expected = "a finite number of at least 0";
                return Err(OutOfRange::new(radius, expected).in_field(field));
            }
        }
        if base_radius == 0.0 && top_radius == 0.0 {
            return Err(OutOfRange::new(0, "a number greater than 0").in_field("base_radius"));
        }
        if base == top {
            let p = top.get();
            let found = format!("({}, {}, {})", p.x, p.y, p.z);
            return Err(OutOfRange::new(found, "a point other than the base").in_field("top"));
        }
        Ok(Self { base, top, base_radius, top_radius, open })
    }

    /// The centre of the one end.
    #[must_use]
    pub const fn base(&self) -> Point {
        self.base.get()
    }

    /// The centre of the other end; never the same point.
    #[must_use]
    pub const fn top(&self) -> Point {
        self.top.get()
    }

    /// The radius at the base; 0 only where that at the top is not.
    #[must_use]
    pub const fn base_radius(&self) -> f64 {
        self.base_radius
    }

    /// The radius at the top; 0 only where that at the base is not.
    #[must_use]
    pub const fn top_radius(&self) -> f64 {
        self.top_radius
    }
}

/// A ring: the points at one distance from a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    /// The centre of the circle.
    pub centre: Position,
    /// Its axis, of any length.
    pub axis: Direction,
    ring: Length,
    tube: Length,
}

impl Torus {
    /// A circle of radius `ring` in the middle of a tube of radius `tube`.
    ///
    /// # Errors
    /// Where the tube is wider than the ring, so that it would run into itself.
    pub fn new(
        centre: Position,
        axis: Direction,
        ring: Length,
        tube: Length,
    ) -> Result<Self, OutOfRange> {
        if tube > ring {
            return Err(OutOfRange::new(tube.get(), "at most the radius of the ring"));
        }
        Ok(Self { centre, axis, ring, tube })
    }

    /// The radius of the circle in the middle of the tube.
    #[must_use]
    pub const fn ring(&self) -> f64 {
        self.ring.get()
    }

    /// The radius of the tube; at most that of the ring.
    #[must_use]
    pub const fn tube(&self) -> f64 {
        self.tube.get()
    }
}

/// A tetrahedron.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tetrahedron {
    corners: [Point; 4],
}

impl Tetrahedron {
    /// The tetrahedron with those corners, in any order.
    ///
    /// # Errors
    /// Where they lie in a plane, to within rounding.
    pub fn new(corners: [Position; 4]) -> Result<Self, OutOfRange> {
        let [a, b, c, d] = corners.map(Position::get);
        let normal = normal_of(a, b, c);
        let height = normal.and_then(|n| Some(n.dot(&unit(d - a)?)));
        match height {
            Some(height) if height.abs() > 1e-12 => Ok(Self {
                // So ordered that the normals of its faces point outward.
                corners: if height > 0.0 { [a, c, b, d] } else { [a, b, c, d] },
            }),
            _ => Err(OutOfRange::new("in one plane", "four corners that are not in one plane")),
        }
    }

    /// Its corners: the first three, seen from outside, counterclockwise.
    #[must_use]
    pub const fn corners(&self) -> [Point; 4] {
        self.corners
    }
}

/// The unit normal of the plane through three points; `None` where they are on
/// a line.
pub(crate) fn normal_of(a: Point, b: Point, c: Point) -> Option<Vector> {
    let (u, v) = (unit(b - a)?, unit(c - a)?);
    let normal = u.cross(&v);
    if normal.amax() > 1e-15 { unit(normal) } else { None }
}
