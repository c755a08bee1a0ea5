//! Flat shapes.

use crate::solids::normal_of;
use crate::{Direction, Length, OutOfRange, Position};
use lancer_math::Point;

/// An infinite plane. What is behind it, seen against its normal, is its inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// A point on it, where a checker begins.
    pub origin: Position,
    /// Its normal, of any length.
    pub normal: Direction,
}

/// The inside of a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// Its centre, where a checker begins.
    pub centre: Position,
    /// Its normal, of any length.
    pub normal: Direction,
    /// Its radius.
    pub radius: Length,
}

/// A rectangle, or with sides that are not perpendicular a parallelogram.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    corner: Position,
    sides: [Direction; 2],
}

impl Rectangle {
    /// The points up to one times each side away from `corner`.
    ///
    /// # Errors
    /// Where the sides are parallel.
    pub fn new(corner: Position, sides: [Direction; 2]) -> Result<Self, OutOfRange> {
        let zero = Point::origin();
        let [u, v] = sides.map(|side| zero + side.get());
        if normal_of(zero, u, v).is_none() {
            return Err(OutOfRange::new("parallel to the other side", "another direction"));
        }
        Ok(Self { corner, sides })
    }

    /// The corner where a checker begins.
    #[must_use]
    pub const fn corner(&self) -> Point {
        self.corner.get()
    }

    /// Its sides from that corner; not parallel. Its normal points to where
    /// the first is to the right and the second upward.
    #[must_use]
    pub const fn sides(&self) -> [Direction; 2] {
        self.sides
    }
}

/// A triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    corners: [Point; 3],
}

impl Triangle {
    /// The triangle with those corners; its normal points to where they are
    /// counterclockwise.
    ///
    /// # Errors
    /// Where they are on a line.
    pub fn new(corners: [Position; 3]) -> Result<Self, OutOfRange> {
        let corners = corners.map(Position::get);
        let [a, b, c] = corners;
        if normal_of(a, b, c).is_none() {
            return Err(OutOfRange::new("on one line", "three corners that are not on one line"));
        }
        Ok(Self { corners })
    }

    /// Its corners; not on a line. A checker begins at the first, along the side
    /// to the second.
    #[must_use]
    pub const fn corners(&self) -> [Point; 3] {
        self.corners
    }
}
