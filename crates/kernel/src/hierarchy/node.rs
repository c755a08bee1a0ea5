use lancer_math::{Bounds, Point};

/// How many children a node has at most.
pub(super) const CHILDREN: usize = 8;

/// A leaf has at most so many items.
pub(crate) const LEAF: usize = 8;

/// A node's children side by side, so that a ray is held against all at once.
#[derive(Debug, Clone)]
#[repr(align(32))]
pub(super) struct Node {
    /// Along each axis the lower and the upper faces of the children's boxes, in
    /// the hierarchy's own space. A child that is not there has the faces of an
    /// empty box, infinitely far outside.
    pub(super) faces: [[[f32; CHILDREN]; 2]; 3],
    pub(super) children: [Child; CHILDREN],
}

/// Another node or a leaf: its number, or in the upper bits that it is a leaf and
/// how many items it has, in the lower ones the place of the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Child(pub(super) u32);

const IS_LEAF: u32 = 1 << 31;
const COUNT: u32 = 28;

/// More items than this there cannot be.
pub(super) const MOST_ITEMS: usize = 1 << COUNT;

impl Child {
    pub(super) const NONE: Self = Self(0);

    pub(super) const fn node(number: u32) -> Self {
        Self(number)
    }

    /// Of 1 to 8 items.
    pub(super) const fn leaf(first: u32, count: u32) -> Self {
        Self(IS_LEAF | (count - 1) << COUNT | first)
    }

    #[inline(always)]
    pub(super) const fn is_leaf(self) -> bool {
        self.0 & IS_LEAF != 0
    }

    /// The places of a leaf's items.
    #[inline(always)]
    pub(super) const fn places(self) -> std::ops::Range<usize> {
        let first = (self.0 & ((1 << COUNT) - 1)) as usize;
        first..first + (self.0 >> COUNT & 7) as usize + 1
    }
}

impl Node {
    pub(super) const EMPTY: Self = Self {
        faces: [[[f32::INFINITY; CHILDREN], [f32::NEG_INFINITY; CHILDREN]]; 3],
        children: [Child::NONE; CHILDREN],
    };

    pub(super) fn set(&mut self, slot: usize, [low, high]: [[f32; 3]; 2], child: Child) {
        for axis in 0..3 {
            self.faces[axis][0][slot] = low[axis];
            self.faces[axis][1][slot] = high[axis];
        }
        self.children[slot] = child;
    }

    /// The box of a child, and nothing where it is not there.
    pub(super) fn child(&self, slot: usize) -> Option<([[f32; 3]; 2], Child)> {
        let side = |side: usize| [0, 1, 2].map(|axis| self.faces[axis][side][slot]);
        let (low, high) = (side(0), side(1));
        (low[0] <= high[0]).then_some(([low, high], self.children[slot]))
    }
}

/// The space that boxes are kept in: moved and scaled by a power of two so that
/// everything is between -1 and 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Space {
    pub(super) centre: Point,
    /// A power of two; 0 where there is none that serves, as everything is too
    /// small, too large or in one point: then all boxes are one.
    pub(super) scale: f64,
}

/// By how much wider than shapes, on each side, the boxes of a hierarchy are at most, as a part of the
/// half of the longest side of all of it: 2^-22. Where that half is out of the range from 1e-120 to
/// 1e120, all boxes are one.
///
/// All is scaled by a power of two so that the half, h, becomes a half or more, and less than 1. There
/// singles are 2^-24 apart at most: converting to one is off by half of that, and the next one is taken.
/// Scaled back, that is at most 3 * 2^-24 h; the rest is for the roundings of doubles.
pub const BOX_SLACK: f64 = 1.0 / 4_194_304.0;

/// Powers of two in use are those up to this one, and their inverses.
pub(super) const LARGEST_POWER: f64 = f64::from_bits((1023 + 400) << 52);

/// The power of two that a positive number is at least, and below twice of;
/// nothing where that is not in use.
#[inline(always)]
pub(super) fn power_below(x: f64) -> Option<f64> {
    let power = f64::from_bits(x.to_bits() & (0x7FF << 52));
    (1.0 / LARGEST_POWER..=LARGEST_POWER).contains(&power).then_some(power)
}

impl Space {
    pub(super) fn of(bounds: &Bounds) -> Self {
        let centre = bounds.centre();
        let reach = (bounds.max - centre).amax().max((bounds.min - centre).amax());
        // At most 1 after it is divided by twice the power below, but for roundings.
        let scale = power_below(reach).map_or(0.0, |power| 0.5 / power);
        Self { centre, scale }
    }

    /// The box in this space, rounded outward.
    #[inline(always)]
    pub(super) fn outward(&self, bounds: &Bounds) -> [[f32; 3]; 2] {
        if self.scale == 0.0 {
            return [[-1.0; 3], [1.0; 3]];
        }
        // The difference and the conversion round by less than a unit in the last
        // place of a single.
        let low = (bounds.min - self.centre) * self.scale;
        let high = (bounds.max - self.centre) * self.scale;
        [
            [low.x, low.y, low.z].map(|c| (c as f32).next_down()),
            [high.x, high.y, high.z].map(|c| (c as f32).next_up()),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastrand::Rng;

    #[test]
    fn boxes_are_wider_but_no_more_than_is_said() {
        let mut rng = Rng::with_seed(3);
        let mut widest = 0.0_f64;
        for _ in 0..100_000 {
            let size = libm::exp2(f64::from(rng.i32(-390..390)));
            let mut point = || Point::from([0; 3].map(|_| size * (2.0 * rng.f64() - 1.0)));
            let all = Bounds::EMPTY.with(point()).with(point());
            let space = Space::of(&all);
            let half = 0.5 * all.sides().iter().copied().fold(0.0, f64::max);
            // A box within it.
            let mut between = || {
                let side =
                    |axis: usize, part: f64| all.min[axis] + part * (all.max[axis] - all.min[axis]);
                let parts = [0; 3].map(|_| rng.f64());
                Point::from([0, 1, 2].map(|axis| side(axis, parts[axis])))
            };
            let own = Bounds::EMPTY.with(between()).with(between());
            let [low, high] = space.outward(&own);
            for axis in 0..3 {
                let back = |c: f32| f64::from(c) / space.scale + space.centre[axis];
                let more = [own.min[axis] - back(low[axis]), back(high[axis]) - own.max[axis]];
                for more in more {
                    assert!(more >= 0.0 && more <= BOX_SLACK * half, "{} of {half}", more / half);
                    widest = widest.max(more / half);
                }
            }
        }
        assert!(widest > 0.5 * BOX_SLACK, "the bound is far too wide: {widest:e}");
    }
}
