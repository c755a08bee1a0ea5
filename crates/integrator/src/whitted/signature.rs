//! Signatures of samples: a hash of all that their rays met.
//!
//! Each ray adds a number of its own to the signature of its sample: a hash of the way to
//! it, branch by branch, and of what it met. The order in which rays are followed depends
//! on shares, which may change places from one sample to the next, and does not matter.

use super::record::{Notes, Record};
use crate::numbers::mixed;
use lancer_kernel::{Prepared, SurfacePoint};
use lancer_scene::Pattern;
use std::ops::{Add, Mul};

/// Whether signatures are asked for, and notes.
pub(super) trait Signing {
    const SIGNED: bool;
    type Notes: Notes;
}

pub(super) struct Signed;

impl Signing for Signed {
    const SIGNED: bool = true;
    type Notes = ();
}

pub(super) struct Unsigned;

impl Signing for Unsigned {
    const SIGNED: bool = false;
    type Notes = ();
}

/// Without a signature, but with all rays written down.
pub(super) struct Recorded;

impl Signing for Recorded {
    const SIGNED: bool = false;
    type Notes = Record;
}

/// The halves of a product of 128 bits, one over the other, as Wang Yi's wyhash has it
/// (2019): few instructions, and all bits depend on all.
#[inline(always)]
pub(super) const fn hash(x: u64) -> u64 {
    const SALT: u64 = 0xa076_1d64_78bd_642f;
    const FACTOR: u64 = 0xe703_7ed1_a0b4_28db;
    let product = (x ^ SALT) as u128 * FACTOR as u128;
    (product >> 64) as u64 ^ product as u64
}

/// The way from the eye to a ray.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Way(u64);

/// The branch of a mirrored ray.
pub(super) const MIRRORED: u64 = 1;

/// The branch of what goes on.
pub(super) const ONWARD: u64 = 2;

impl Way {
    /// To the ray from the eye.
    pub(super) const EYE: Self = Self(0);

    /// To the ray that leaves by a branch what the last one met.
    #[inline]
    pub(super) const fn then(self, branch: u64) -> Self {
        Self(hash(self.0.wrapping_add(branch)))
    }

    /// As a number.
    #[inline]
    pub(super) const fn end(self) -> u64 {
        self.0
    }

    /// Its ray meets the item, or nothing.
    #[inline(always)]
    pub(super) fn meets(self, item: Option<u32>) -> Meeting {
        Meeting(hash(self.0 ^ item.map_or(u64::MAX, u64::from)))
    }
}

/// A ray on a way to it and what item it met.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting(u64);

impl Meeting {
    /// What the ray adds to the signature, by where it met the item.
    #[inline(always)]
    pub(super) fn at(self, lit: f64, piece: u64) -> u64 {
        hash((self.0 ^ lit.to_bits()).wrapping_add(piece))
    }
}

/// Where a ray met an item.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Spot {
    /// A sum of marks, by the side from which it is seen, the cell of its checker, and
    /// which lights arrive; lanes are summed up likewise.
    pub(super) lit: f64,
    /// A sum of hashes, by the piece of the surface and through what light arrives.
    pub(super) piece: u64,
}

impl Spot {
    /// Where light does not arrive yet.
    pub(super) fn new(prepared: &Prepared, point: &SurfacePoint<'_>, from_behind: bool) -> Self {
        let piece = match prepared.patch(point) {
            // Most surfaces have but one.
            0 => 0,
            patch => hash(patch),
        };
        let side = if from_behind { BEHIND } else { 0.0 };
        let lit = match point.surface.pattern {
            Pattern::Solid => side,
            Pattern::Checker(_) => in_cell(side, point.cell),
        };
        Self { lit, piece }
    }
}

/// A mark: a whole number, of which sums are exact.
pub(super) const fn mark(number: u64) -> f64 {
    (mixed(number) >> 24) as f64
}

/// The mark of what is seen from behind.
pub(super) const BEHIND: f64 = mark(u64::MAX);

/// The mark where all light is mirrored.
pub(super) const TOTAL: f64 = mark(u64::MAX - 1);

/// What rows and columns of a checker's cells are multiplied with.
const CELLS: [f64; 2] = [mark(u64::MAX - 2), mark(u64::MAX - 3)];

/// A mark and that of a cell of a checker. Of neighbours that is another however far out
/// they are: what rounding takes is far less than a mark.
#[inline(always)]
pub(super) fn in_cell<R>(mark: R, [i, j]: [R; 2]) -> R
where
    R: Add<Output = R> + Mul<f64, Output = R>,
{
    mark + (i * CELLS[0] + j * CELLS[1])
}
