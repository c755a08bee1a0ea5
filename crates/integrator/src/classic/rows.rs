use super::vectors::Vectors;
use lancer_kernel::lanes::{Lanes, MOST, Real};

/// How many rays travel together at most.
pub(super) const BATCH: usize = 256;

/// A number for each ray of a batch, and room for a register that begins at the
/// last one. Not a power of two, so that several do not share cache lines' places.
pub(super) type Row = [f64; BATCH + MOST];

pub(super) const ZEROS: Row = [0.0; BATCH + MOST];

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
            x: lanes.load(&self.x[i..]),
            y: lanes.load(&self.y[i..]),
            z: lanes.load(&self.z[i..]),
        }
    }

    #[inline(always)]
    pub(super) fn store<R: Real>(&mut self, i: usize, vectors: &Vectors<R>) {
        vectors.x.store(&mut self.x[i..]);
        vectors.y.store(&mut self.y[i..]);
        vectors.z.store(&mut self.z[i..]);
    }

    /// Without gaps.
    #[inline(always)]
    pub(super) fn pack<R: Real>(&mut self, i: usize, vectors: &Vectors<R>, mask: R::Mask) {
        vectors.x.store_packed(mask, &mut self.x[i..]);
        vectors.y.store_packed(mask, &mut self.y[i..]);
        vectors.z.store_packed(mask, &mut self.z[i..]);
    }
}
