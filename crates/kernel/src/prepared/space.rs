//! What a group holds, in its own space: prepared once, wherever it stands.

use super::Which;
use super::balls::{Spheres, Spot};
use super::planes::Planes;
use crate::hierarchy::Hierarchy;
use crate::primitive::Primitive;
use crate::shapes::mesh::Facets;
use lancer_math::{Bounds, Placement, Point, Vector};
use std::sync::Arc;

/// The shapes of a group and the groups in it; or of a scene.
///
/// Its *items* are its own shapes and then those of each group that is placed in
/// it, one after the other; each has a number, counted from 0 here.
#[derive(Debug)]
pub(super) struct Space {
    /// The number of its first shape in the description.
    pub(super) first_shape: u32,
    pub(super) own: Vec<Own>,
    pub(super) spheres: Spheres,
    pub(super) planes: Vec<Planes>,
    pub(super) others: Vec<Other>,
    pub(super) placed: Vec<Stand>,
    /// Others and placed groups that a box holds, in the order of the places of the
    /// hierarchy of these boxes.
    pub(super) bounded: Vec<Entry>,
    pub(super) hierarchy: Hierarchy,
    /// The rest, planes apart; a ray is held against each.
    pub(super) unbounded: Vec<Entry>,
    pub(super) item_count: u32,
    pub(super) holds: Holds,
    pub(super) size: Size,
    /// Around everything; `None` where something has no end.
    pub(super) bounds: Option<Bounds>,
    /// How many spaces are nested, this one included.
    pub(super) depth: usize,
}

/// One of a group's own shapes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Own {
    /// What it looks like.
    pub(super) look: u32,
    pub(super) kept: Kept,
}

/// Where a shape is kept.
#[derive(Debug, Clone, Copy)]
pub(super) enum Kept {
    Sphere(Spot),
    /// Its number among the others.
    Other(u32),
}

/// A shape that is no sphere.
#[derive(Debug)]
pub(super) struct Other {
    pub(super) primitive: Kind,
    /// Its number among the shapes of its group.
    pub(super) shape: u32,
    pub(super) is_transparent: bool,
    /// Whether a medium can fill it.
    pub(super) is_solid: bool,
}

/// A mesh, which is met in lanes, or another kind.
#[derive(Debug, Clone)]
pub(super) enum Kind {
    Mesh(Arc<Facets>),
    Any(Arc<dyn Primitive>),
}

/// A group where it stands in another.
#[derive(Debug)]
pub(super) struct Stand {
    /// To the space of the group that it stands in.
    pub(super) placement: Placement,
    /// How many times as large a displacement can become on the way in, by its
    /// largest coordinate.
    pub(super) shrink: f64,
    /// The number of its space.
    pub(super) space: u32,
    /// The number of its first item.
    pub(super) first: u32,
    pub(super) holds: Holds,
}

/// What a hierarchy's box is around.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry(u32);

/// The same, to be looked at.
pub(super) enum Content {
    /// The number of a shape among the others.
    Other(usize),
    /// The number of a group among those placed.
    Placed(usize),
}

/// What kinds of surfaces there are among some shapes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Holds {
    pub(super) opaque: bool,
    pub(super) transparent: bool,
    /// Solids that a medium fills.
    pub(super) solid: bool,
}

/// Bounds on what numbers are met between a space and the shapes in it at any
/// depth, seen from this space and by largest coordinates. They hold for each
/// step's placement as it was described, and for the products of several.
#[derive(Debug, Clone, Copy)]
pub(super) struct Size {
    /// The error of a point of the least certain shape, apart from the placements.
    pub(super) error: f64,
    /// Coordinates and offsets.
    pub(super) extent: f64,
    /// Offsets alone.
    pub(super) offset: f64,
    /// How many times as large an error becomes that is made on the way in and
    /// taken back out.
    pub(super) condition: f64,
}

impl Kind {
    pub(super) fn get(&self) -> &dyn Primitive {
        match self {
            Self::Mesh(facets) => &**facets,
            Self::Any(primitive) => &**primitive,
        }
    }
}

impl Entry {
    const PLACED: u32 = 1 << 31;

    pub(super) const fn other(index: usize) -> Self {
        Self(index as u32)
    }

    pub(super) const fn placed(index: usize) -> Self {
        Self(index as u32 | Self::PLACED)
    }

    #[inline(always)]
    pub(super) const fn content(self) -> Content {
        let index = (self.0 & !Self::PLACED) as usize;
        if self.0 & Self::PLACED == 0 { Content::Other(index) } else { Content::Placed(index) }
    }
}

impl Holds {
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            opaque: self.opaque || other.opaque,
            transparent: self.transparent || other.transparent,
            solid: self.solid || other.solid,
        }
    }

    /// Whether any of those are there.
    #[inline(always)]
    pub(super) const fn any(&self, which: Which) -> bool {
        match which {
            Which::All => true,
            Which::Opaque => self.opaque,
            Which::Transparent => self.transparent,
        }
    }
}

impl Other {
    #[inline(always)]
    pub(super) const fn is_asked(&self, which: Which) -> bool {
        which.has(self.is_transparent)
    }
}

impl Size {
    /// Of nothing.
    pub(super) const NONE: Self = Self { error: 0.0, extent: 0.0, offset: 0.0, condition: 1.0 };

    /// Of a shape in that box.
    pub(super) fn of(bounds: &Bounds) -> Self {
        let reach = bounds.reach();
        Self { error: 64.0 * f64::EPSILON * reach, extent: reach, ..Self::NONE }
    }

    /// Seen from outside of a placement.
    pub(super) fn placed(self, placement: &Placement) -> Self {
        let (stretch, shrink) = norms(placement);
        let offset = placement.point(&Point::origin()).coords.amax();
        Self {
            error: stretch * self.error,
            extent: stretch * self.extent + offset,
            offset: stretch * self.offset + offset,
            condition: stretch * self.condition * shrink,
        }
    }

    /// That of both together.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            error: self.error.max(other.error),
            extent: self.extent.max(other.extent),
            offset: self.offset.max(other.offset),
            condition: self.condition.max(other.condition),
        }
    }

    /// The error of a point of the least certain shape, as
    /// [`Placement::error_of`] adds it up.
    pub(super) fn coarsest(&self) -> f64 {
        const UNIT: f64 = 6.0 * f64::EPSILON;
        self.error + UNIT * self.extent + self.condition * UNIT * (self.extent + self.offset)
    }
}

/// How many times as large a displacement can become, by its largest coordinate,
/// on the way out and on the way in.
pub(super) fn norms(placement: &Placement) -> (f64, f64) {
    let axes = [Vector::x(), Vector::y(), Vector::z()];
    let sum = |columns: [Vector; 3]| {
        columns.iter().fold(Vector::zeros(), |sum, column| sum + column.abs()).amax()
    };
    (
        sum(axes.map(|axis| placement.vector(&axis))),
        sum(axes.map(|axis| placement.local_vector(&axis))),
    )
}
