use super::vectors::Vectors;
use lancer_kernel::lanes::{Lanes, MOST, Real};

/// How many rays travel together at most.
pub(super) const BATCH: usize = 256;

/// A number for each ray of a batch, and room for a register that begins at the
/// last one. Not a power of two, so that several do not share cache lines' places.
pub(super) type Row = [f64; BATCH + MOST];

pub(super) const ZEROS: Row = [0.0; BATCH + MOST];

/// The register of a row that begins at `i`.
#[inline(always)]
pub(super) fn load<L: Lanes>(lanes: L, row: &Row, i: usize) -> L::Real {
    lanes.load(&row[i..i + L::WIDTH])
}

/// Writes it there.
#[inline(always)]
pub(super) fn store<L: Lanes>(_: L, row: &mut Row, i: usize, register: L::Real) {
    register.store(&mut row[i..i + L::WIDTH]);
}

/// Writes the lanes of the mask there, without gaps, and says how many they are.
#[inline(always)]
pub(super) fn pack<L: Lanes>(
    _: L,
    row: &mut Row,
    i: usize,
    register: L::Real,
    mask: L::Mask,
) -> usize {
    register.store_packed(mask, &mut row[i..i + L::WIDTH])
}

/// A vector for each ray.
#[derive(Debug, Clone)]
pub(super) struct Triples {
    x: Row,
    y: Row,
    z: Row,
}

impl Triples {
    pub(super) const ZEROS: Self = Self { x: ZEROS, y: ZEROS, z: ZEROS };

    #[inline(always)]
    pub(super) fn load<L: Lanes>(&self, lanes: L, i: usize) -> Vectors<L::Real> {
        Vectors {
            x: load(lanes, &self.x, i),
            y: load(lanes, &self.y, i),
            z: load(lanes, &self.z, i),
        }
    }

    #[inline(always)]
    pub(super) fn store<L: Lanes>(&mut self, lanes: L, i: usize, vectors: &Vectors<L::Real>) {
        store(lanes, &mut self.x, i, vectors.x);
        store(lanes, &mut self.y, i, vectors.y);
        store(lanes, &mut self.z, i, vectors.z);
    }

    /// Without gaps.
    #[inline(always)]
    pub(super) fn pack<L: Lanes>(
        &mut self,
        lanes: L,
        i: usize,
        vectors: &Vectors<L::Real>,
        mask: L::Mask,
    ) {
        pack(lanes, &mut self.x, i, vectors.x, mask);
        pack(lanes, &mut self.y, i, vectors.y, mask);
        pack(lanes, &mut self.z, i, vectors.z, mask);
    }
}
