//! The spheres of a group.
//!
//! Those of a leaf are side by side: four rows, of coordinates and radii, of as many
//! numbers as the leaf has spheres. A row is read as many numbers wide as there are
//! lanes; what is behind its end is not looked at. So a sphere takes 32 bytes there,
//! 4 for what it is, and its share of the hierarchy.

use super::space::Holds;
use crate::hierarchy::{Hierarchy, LEAF};
use crate::lanes::{Lanes, Vectors};
use crate::shapes::sphere::{Ball, Balls};
use lancer_math::{Bounds, Point};
use std::ops::Range;

#[derive(Debug)]
pub(super) struct Spheres {
    rows: Vec<f64>,
    pub(super) names: Vec<Name>,
    /// None over so few that it is faster to hold a ray against each.
    hierarchy: Option<Hierarchy>,
    pub(super) holds: Holds,
}

/// A sphere's number among the shapes of its group, and in the highest bit whether
/// it lets light through.
#[derive(Debug, Clone, Copy)]
pub(super) struct Name(u32);

/// Where a sphere is kept: its place, and among how many its leaf has it where.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    place: u32,
    lane: u8,
    count: u8,
}

/// A sphere that is to be kept here.
pub(super) struct Given {
    pub(super) shape: u32,
    pub(super) ball: Ball,
    pub(super) bounds: Bounds,
    pub(super) is_transparent: bool,
}

const ROWS: usize = 4;

/// More spheres than these are put into a hierarchy; `cargo bench --bench traversal
/// among_spheres` times what lies on both sides.
const FEW: usize = 64;

impl Name {
    const TRANSPARENT: u32 = 1 << 31;

    #[inline(always)]
    pub(super) const fn shape(self) -> u32 {
        self.0 & !Self::TRANSPARENT
    }

    #[inline(always)]
    pub(super) const fn is_transparent(self) -> bool {
        self.0 & Self::TRANSPARENT != 0
    }
}

impl Spheres {
    pub(super) fn new(given: &[Given], holds: Holds) -> Self {
        let (hierarchy, order) = if given.len() <= FEW {
            (None, (0..given.len() as u32).collect())
        } else {
            let (hierarchy, order) = Hierarchy::over(given.len(), |i| given[i].bounds);
            (Some(hierarchy), order)
        };
        let name = |&i: &u32| {
            let Given { shape, is_transparent, .. } = given[i as usize];
            Name(shape | if is_transparent { Name::TRANSPARENT } else { 0 })
        };
        let names: Vec<Name> = order.iter().map(name).collect();
        let mut rows = vec![0.0; ROWS * given.len() + LEAF - 1];
        let mut this = Self { rows: Vec::new(), names, hierarchy, holds };
        for places in this.leaves() {
            let (first, count) = (ROWS * places.start, places.len());
            for (lane, place) in places.enumerate() {
                let Ball { centre, radius } = given[order[place] as usize].ball;
                for (row, x) in [centre.x, centre.y, centre.z, radius].into_iter().enumerate() {
                    rows[first + row * count + lane] = x;
                }
            }
        }
        this.rows = rows;
        this
    }

    pub(super) const fn hierarchy(&self) -> Option<&Hierarchy> {
        self.hierarchy.as_ref()
    }

    /// The places of what would be leaves if there were a hierarchy.
    #[inline(always)]
    pub(super) fn few(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let count = if self.hierarchy.is_none() { self.names.len() } else { 0 };
        (0..count).step_by(LEAF).map(
            #[inline(always)]
            move |first| first..(first + LEAF).min(count),
        )
    }

    /// The places of the leaves.
    fn leaves(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        self.hierarchy.iter().flat_map(Hierarchy::leaves).chain(self.few())
    }

    /// The spheres of a leaf from the lane `from` on.
    #[inline(always)]
    pub(super) fn load<L: Lanes>(
        &self,
        lanes: L,
        places: &Range<usize>,
        from: usize,
    ) -> Balls<L::Real> {
        let (first, count) = (ROWS * places.start + from, places.len());
        let row = |row: usize| lanes.load(&self.rows[first + row * count..]);
        Balls { centre: Vectors { x: row(0), y: row(1), z: row(2) }, radius: row(3) }
    }

    /// Each sphere's number among the shapes, and where it is.
    pub(super) fn spots(&self) -> impl Iterator<Item = (u32, Spot)> + '_ {
        self.leaves().flat_map(move |places| {
            let count = places.len() as u8;
            (0..).zip(places).map(move |(lane, place)| {
                (self.names[place].shape(), Spot { place: place as u32, lane, count })
            })
        })
    }

    #[inline]
    pub(super) fn ball(&self, spot: Spot) -> Ball {
        let (lane, count) = (usize::from(spot.lane), usize::from(spot.count));
        let first = ROWS * (spot.place as usize - lane) + lane;
        let [x, y, z, radius] = [0, 1, 2, 3].map(|row| self.rows[first + row * count]);
        Ball { centre: Point::new(x, y, z), radius }
    }

    /// Calls `met` with each sphere that may hold the point, and its number among
    /// the shapes.
    pub(super) fn around(&self, point: &Point, mut met: impl FnMut(u32, Ball)) {
        let mut leaf = |places: Range<usize>| {
            let count = places.len() as u8;
            for (lane, place) in (0..).zip(places) {
                let spot = Spot { place: place as u32, lane, count };
                met(self.names[place].shape(), self.ball(spot));
            }
        };
        match &self.hierarchy {
            Some(hierarchy) => hierarchy.visit_around(point, leaf),
            None => self.few().for_each(&mut leaf),
        }
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.rows[..])
            + size_of_val(&self.names[..])
            + self.hierarchy.as_ref().map_or(0, Hierarchy::bytes)
    }
}
