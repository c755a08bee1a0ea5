//! The binary hierarchy, from the top, by the surface-area heuristic over bins
//! (Wald, *On fast Construction of SAH-based Bounding Volume Hierarchies*, 2007).
//!
//! Halves are built in parallel, each in places of its own, so what comes out does
//! not depend on threads.

use super::collapse::{Costs, cost_of_leaf, cost_of_node};

/// An item's box, or one around several: the lower corner, the item's number, and
/// the upper corner with its signs turned, so that a union is eight minima.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(super) struct Item([f32; 8]);

impl Item {
    const NONE: Self = Self([f32::INFINITY; 8]);

    pub(super) fn new([low, high]: [[f32; 3]; 2], number: u32) -> Self {
        let [a, b, c] = low;
        let [d, e, f] = high;
        Self([a, b, c, f32::from_bits(number), -d, -e, -f, 0.0])
    }

    pub(super) const fn number(&self) -> u32 {
        self.0[3].to_bits()
    }

    pub(super) fn sides(&self) -> [[f32; 3]; 2] {
        let [a, b, c, _, d, e, f, _] = self.0;
        [[a, b, c], [-d, -e, -f]]
    }

    /// Of the number nothing is left.
    #[inline(always)]
    fn union(&self, other: &Self) -> Self {
        Self(std::array::from_fn(
            #[inline(always)]
            |i| if self.0[i] < other.0[i] { self.0[i] } else { other.0[i] },
        ))
    }

    /// Twice the middle.
    #[inline(always)]
    fn middle(&self, axis: usize) -> f32 {
        self.0[axis] - self.0[axis + 4]
    }

    /// Half the surface.
    #[inline(always)]
    pub(super) fn area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| -self.0[axis + 4] - self.0[axis]);
        x * y + y * z + z * x
    }

    /// Twice the middle, as a box.
    #[inline(always)]
    fn middles(&self) -> Self {
        let [x, y, z] = [0, 1, 2].map(|axis| self.middle(axis));
        Self([x, y, z, 0.0, -x, -y, -z, 0.0])
    }
}

/// A node of the binary hierarchy. The first of its children follows it.
#[derive(Debug, Clone)]
pub(super) struct Binary {
    pub(super) bounds: Item,
    /// Its items are neighbours.
    pub(super) first: u32,
    pub(super) count: u32,
    /// How far away its second child is, or 0 where there are none.
    pub(super) second: u32,
    /// See [`collapse`](super::collapse).
    pub(super) choices: [u8; 9],
}

impl Binary {
    const EMPTY: Self = Self { bounds: Item::NONE, first: 0, count: 0, second: 0, choices: [0; 9] };
}

const BINS: usize = 32;

/// Not more than this are never split.
const FEW: usize = 2;

/// From this depth on halves are made by number.
const DEEP: usize = 40;

/// So many levels of nodes there are at most: 28 by halving down to a leaf, as
/// there are at most 2^28 items.
pub(crate) const DEPTH: usize = DEEP + 28;

/// More items than this are worth another thread.
const MANY: usize = 4096;

/// Orders the items and makes the hierarchy over them, with at most so many in a
/// leaf.
pub(super) fn build(items: &mut [Item], most: usize) -> Vec<Binary> {
    let mut nodes = vec![Binary::EMPTY; 2 * items.len() - 1];
    let part = Part::new(items, most, 0, 0);
    part.build(items, &mut nodes);
    nodes
}

/// Neighbouring items that become a node.
struct Part {
    bounds: Item,
    middles: Item,
    /// How many a leaf may have.
    most: usize,
    first: usize,
    depth: usize,
}

#[derive(Clone, Copy)]
struct Bin {
    bounds: Item,
    count: u32,
}

impl Part {
    fn new(items: &[Item], most: usize, first: usize, depth: usize) -> Self {
        let (mut bounds, mut middles) = (Item::NONE, Item::NONE);
        for item in items {
            bounds = bounds.union(item);
            middles = middles.union(&item.middles());
        }
        Self { bounds, middles, most, first, depth }
    }

    fn build(&self, items: &mut [Item], nodes: &mut [Binary]) -> Costs {
        let area = self.bounds.area();
        let node = Binary {
            bounds: self.bounds,
            first: self.first as u32,
            count: items.len() as u32,
            ..Binary::EMPTY
        };
        if items.len() <= FEW.min(self.most) {
            let costs = [area * cost_of_leaf(items.len()); 9];
            nodes[0] = node;
            return costs;
        }
        let half = self.split(items);
        let (one, other) = items.split_at_mut(half);
        let left = Self::new(one, self.most, self.first, self.depth + 1);
        let right = Self::new(other, self.most, self.first + half, self.depth + 1);
        let (own, rest) = nodes.split_at_mut(1);
        let (near, far) = rest.split_at_mut(2 * half - 1);
        let (a, b) = if one.len() + other.len() > MANY {
            rayon::join(|| left.build(one, near), || right.build(other, far))
        } else {
            (left.build(one, near), right.build(other, far))
        };
        own[0] = Binary { second: 2 * half as u32, ..node };
        let leaf = (items.len() <= self.most).then(|| area * cost_of_leaf(items.len()));
        cost_of_node(&mut own[0].choices, area, leaf, &a, &b)
    }

    /// Orders the items so that those of the first child come first, and says how
    /// many they are.
    fn split(&self, items: &mut [Item]) -> usize {
        let sides = self.middles.sides();
        let long: [f32; 3] = std::array::from_fn(|axis| sides[1][axis] - sides[0][axis]);
        let longest = (0..3).fold(0, |a, b| if long[b] > long[a] { b } else { a });
        let is_long = long[longest] > 0.0;
        if self.depth >= DEEP || !is_long {
            return halve(items, longest);
        }
        // Not quite so many bins that the last one is one too far.
        let scale = long.map(|long| if long > 0.0 { BINS as f32 * 0.999_999 / long } else { 0.0 });
        let low = sides[0];
        let bin_of = |item: &Item, axis: usize| {
            (((item.middle(axis) - low[axis]) * scale[axis]) as usize).min(BINS - 1)
        };
        let mut bins = [[Bin { bounds: Item::NONE, count: 0 }; BINS]; 3];
        for item in items.iter() {
            for axis in 0..3 {
                let bin = &mut bins[axis][bin_of(item, axis)];
                bin.bounds = bin.bounds.union(item);
                bin.count += 1;
            }
        }
        let mut best = (f32::INFINITY, 0, 0);
        for axis in 0..3 {
            if scale[axis] > 0.0 {
                let (cost, bin) = cheapest(&bins[axis]);
                if cost < best.0 {
                    best = (cost, axis, bin);
                }
            }
        }
        let (_, axis, bin) = best;
        let half = partition(items, |item| bin_of(item, axis) < bin);
        // A cost that is no number, as where boxes are as large as can be.
        if half == 0 || half == items.len() { halve(items, longest) } else { half }
    }
}

/// The cost of the cheapest split, and the first bin beyond it.
fn cheapest(bins: &[Bin; BINS]) -> (f32, usize) {
    let mut right = [0.0; BINS];
    let mut sum = Bin { bounds: Item::NONE, count: 0 };
    for k in (1..BINS).rev() {
        sum = Bin { bounds: sum.bounds.union(&bins[k].bounds), count: sum.count + bins[k].count };
        right[k] = if sum.count > 0 { sum.bounds.area() * sum.count as f32 } else { f32::INFINITY };
    }
    let mut best = (f32::INFINITY, 0);
    let mut sum = Bin { bounds: Item::NONE, count: 0 };
    for k in 1..BINS {
        let bin = &bins[k - 1];
        sum = Bin { bounds: sum.bounds.union(&bin.bounds), count: sum.count + bin.count };
        if sum.count > 0 {
            let cost = sum.bounds.area() * sum.count as f32 + right[k];
            if cost < best.0 {
                best = (cost, k);
            }
        }
    }
    best
}

/// The lower half along an axis first; by their numbers where they are level.
fn halve(items: &mut [Item], axis: usize) -> usize {
    let half = items.len() / 2;
    items.select_nth_unstable_by(half, |a, b| {
        a.middle(axis).total_cmp(&b.middle(axis)).then(a.number().cmp(&b.number()))
    });
    half
}

/// Those for which it holds first, and how many they are. In the same order on
/// every machine.
fn partition(items: &mut [Item], is_first: impl Fn(&Item) -> bool) -> usize {
    let (mut low, mut high) = (0, items.len());
    loop {
        while low < high && is_first(&items[low]) {
            low += 1;
        }
        while low < high && !is_first(&items[high - 1]) {
            high -= 1;
        }
        if low >= high {
            return low;
        }
        items.swap(low, high - 1);
    }
}
