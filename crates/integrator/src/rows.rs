//! What travels through the stages of a tile: a number, or a vector, of each ray side
//! by side with those of the others.

use crate::TILE_SIDE;
use lancer_kernel::lanes::{Lanes, MOST, Real, Vectors};

/// How many rays travel together at most: one for each pixel.
pub(crate) const BATCH: usize = (TILE_SIDE * TILE_SIDE) as usize;

/// A number for each ray of a batch, and room for a register that begins at the
/// last one. Not a power of two, so that several do not share cache lines' places.
pub(crate) type Row = [f64; BATCH + MOST];

pub(crate) const ZEROS: Row = [0.0; BATCH + MOST];

/// The register of a row that begins at `i`.
#[inline(always)]
pub(crate) fn load<L: Lanes>(lanes: L, row: &Row, i: usize) -> L::Real {
    lanes.load(&row[i..i + L::WIDTH])
}

/// Writes it there.
#[inline(always)]
pub(crate) fn store<L: Lanes>(_: L, row: &mut Row, i: usize, register: L::Real) {
    register.store(&mut row[i..i + L::WIDTH]);
}

/// Writes the lanes of the mask there, without gaps, and says how many they are.
#[inline(always)]
pub(crate) fn pack<L: Lanes>(
    _: L,
    row: &mut Row,
    i: usize,
    register: L::Real,
    mask: L::Mask,
) -> usize {
    register.store_packed(mask, &mut row[i..i + L::WIDTH])
}

/// A vector for each ray, by coordinate.
#[derive(Debug, Clone)]
pub(crate) struct Triples(pub(crate) [Row; 3]);

impl Triples {
    pub(crate) const ZEROS: Self = Self([ZEROS; 3]);

    #[inline(always)]
    pub(crate) fn load<L: Lanes>(&self, lanes: L, i: usize) -> Vectors<L::Real> {
        let [x, y, z] = &self.0;
        Vectors { x: load(lanes, x, i), y: load(lanes, y, i), z: load(lanes, z, i) }
    }

    #[inline(always)]
    pub(crate) fn store<L: Lanes>(&mut self, lanes: L, i: usize, vectors: &Vectors<L::Real>) {
        let [x, y, z] = &mut self.0;
        store(lanes, x, i, vectors.x);
        store(lanes, y, i, vectors.y);
        store(lanes, z, i, vectors.z);
    }

    /// Without gaps.
    #[inline(always)]
    pub(crate) fn pack<L: Lanes>(
        &mut self,
        lanes: L,
        i: usize,
        vectors: &Vectors<L::Real>,
        mask: L::Mask,
    ) {
        let [x, y, z] = &mut self.0;
        pack(lanes, x, i, vectors.x, mask);
        pack(lanes, y, i, vectors.y, mask);
        pack(lanes, z, i, vectors.z, mask);
    }
}
