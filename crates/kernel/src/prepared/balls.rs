//! Spheres by the block of eight.

use crate::bvh::Bvh;
use crate::lanes::MOST;
use crate::shapes::Ball;
use lancer_math::Bounds;

/// Eight spheres at most, each with a lane; the others have a radius that is no
/// number, so that nothing meets them.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Block {
    pub(super) centre: [[f64; MOST]; 3],
    pub(super) radius: [f64; MOST],
}

/// What a block's spheres are: looked at once one is met.
#[derive(Debug, Clone, Copy)]
pub(super) struct Names {
    /// Their numbers among the shapes of their group.
    pub(super) shapes: [u32; MOST],
    /// Which lanes are spheres that let light through, a bit for each.
    pub(super) transparent: u8,
    /// Which lanes are spheres.
    pub(super) filled: u8,
}

/// The spheres of a group.
#[derive(Debug)]
pub(super) struct Balls {
    pub(super) blocks: Vec<Block>,
    pub(super) names: Vec<Names>,
    pub(super) hierarchy: Bvh,
}

/// A sphere that is to be put into a block.
pub(super) struct Given {
    pub(super) shape: u32,
    pub(super) ball: Ball,
    pub(super) bounds: Bounds,
    pub(super) is_transparent: bool,
}

impl Block {
    const EMPTY: Self = Self { centre: [[0.0; MOST]; 3], radius: [f64::NAN; MOST] };

    /// One of the spheres.
    #[inline]
    pub(super) fn ball(&self, lane: usize) -> Ball {
        Ball::at([0, 1, 2].map(|axis| self.centre[axis][lane]), self.radius[lane])
    }
}

impl Names {
    /// The lanes to look at.
    #[inline(always)]
    pub(super) const fn lanes(&self, which: super::Which) -> u8 {
        match which {
            super::Which::All => self.filled,
            super::Which::Opaque => self.filled & !self.transparent,
            super::Which::Transparent => self.transparent,
        }
    }
}

impl Balls {
    /// Puts spheres that are near to one another into blocks.
    pub(super) fn new(given: &[Given]) -> Self {
        let bounds: Vec<Bounds> = given.iter().map(|given| given.bounds).collect();
        let (mut blocks, mut names, mut boxes) = (Vec::new(), Vec::new(), Vec::new());
        for part in Bvh::new(&bounds).leaves().flat_map(|leaf| leaf.chunks(MOST)) {
            let mut block = Block::EMPTY;
            let mut name = Names { shapes: [0; MOST], transparent: 0, filled: 0 };
            let mut around = Bounds::EMPTY;
            for (lane, &i) in part.iter().enumerate() {
                let given = &given[i as usize];
                let (centre, radius) = given.ball.numbers();
                for axis in 0..3 {
                    block.centre[axis][lane] = centre[axis];
                }
                block.radius[lane] = radius;
                name.shapes[lane] = given.shape;
                name.filled |= 1 << lane;
                name.transparent |= u8::from(given.is_transparent) << lane;
                around = around.union(given.bounds);
            }
            blocks.push(block);
            names.push(name);
            boxes.push(around);
        }
        let hierarchy = Bvh::new(&boxes);
        Self { blocks, names, hierarchy }
    }

    /// Each sphere's number among the shapes, and its place: eight times that of the
    /// block plus the lane.
    pub(super) fn places(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        (0..).zip(&self.names).flat_map(|(block, names)| {
            let lanes = (0..MOST as u32).filter(|lane| names.filled >> lane & 1 != 0);
            lanes.map(move |lane| (names.shapes[lane as usize], MOST as u32 * block + lane))
        })
    }
}
