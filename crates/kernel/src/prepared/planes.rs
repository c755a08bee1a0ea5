//! The planes of a group, eight at a time.

use crate::lanes::{Lanes, MOST, Vectors};
use crate::rays::Rays;
use crate::shapes::plane::{HalfSpace, slopes};

/// Eight planes at most; the others have normals that are no numbers, so that
/// nothing meets them.
#[derive(Debug)]
pub(super) struct Planes {
    origin: [[f64; MOST]; 3],
    normal: [[f64; MOST]; 3],
    /// Their numbers among the shapes of their group.
    pub(super) shapes: [u32; MOST],
    /// Which let light through, a bit for each.
    pub(super) transparent: u32,
}

impl Planes {
    /// Puts planes into blocks.
    pub(super) fn blocks(planes: &[(u32, HalfSpace, bool)]) -> Vec<Self> {
        planes.chunks(MOST).map(Self::new).collect()
    }

    fn new(planes: &[(u32, HalfSpace, bool)]) -> Self {
        let mut block = Self {
            origin: [[0.0; MOST]; 3],
            normal: [[f64::NAN; MOST]; 3],
            shapes: [0; MOST],
            transparent: 0,
        };
        for (lane, (shape, plane, is_transparent)) in planes.iter().enumerate() {
            for axis in 0..3 {
                block.origin[axis][lane] = plane.origin[axis];
                block.normal[axis][lane] = plane.normal[axis];
            }
            block.shapes[lane] = *shape;
            block.transparent |= u32::from(*is_transparent) << lane;
        }
        block
    }

    /// As [`slopes`] has it, from the lane `from` on.
    #[inline(always)]
    pub(super) fn slopes<L: Lanes>(&self, rays: &Rays<L>, from: usize) -> (L::Real, L::Real) {
        let load = |rows: &[[f64; MOST]; 3]| {
            Vectors::load(rays.lanes, [&rows[0][from..], &rows[1][from..], &rows[2][from..]])
        };
        slopes(&load(&self.origin), &load(&self.normal), rays)
    }
}
