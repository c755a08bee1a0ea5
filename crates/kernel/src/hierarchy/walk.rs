//! The walk of a ray from node to node.
//!
//! Tried without a gain that could be told from noise: rays that are followed in turns,
//! a step each; children sorted without a branch; nodes at multiples of 256 bytes;
//! rays sorted in fewer passes.
//! Children in no order behind the nearest one were slower.

use super::Hierarchy;
use super::node::{CHILDREN, Child};
use super::query::Query;
use crate::lanes::{Eight, Singles};
use lancer_math::{Point, Ray};
use std::ops::{ControlFlow, Range};

/// What is still to be looked at.
pub(crate) struct Stack {
    /// How far away it is, by the bits, and what. Distances are not negative, so their
    /// bits are ordered as they are.
    ordered: [u64; ENTRIES],
    /// Just what, where there is no order.
    unordered: [u32; ENTRIES],
}

/// A power of two, so that an index is in range by masking: [`super::DEPTH`]
/// nodes leave at most 7 children each, and eight numbers are written at once.
const ENTRIES: usize = 512;
const _: () = assert!((CHILDREN - 1) * super::DEPTH + CHILDREN <= ENTRIES);

impl Stack {
    pub(crate) const fn new() -> Self {
        Self { ordered: [0; ENTRIES], unordered: [0; ENTRIES] }
    }
}

#[inline(always)]
fn entry(distance: f32, child: Child) -> u64 {
    u64::from(distance.to_bits() & 0x7FFF_FFFF) << 32 | u64::from(child.0)
}

/// A ray along an axis, for eight boxes: where it enters and where it leaves.
#[derive(Clone, Copy)]
struct Axis<E: Eight> {
    inverse: E::Singles,
    offset: [E::Singles; 2],
    side: usize,
}

impl<E: Eight> Axis<E> {
    #[inline(always)]
    fn new(lanes: E, query: &Query, axis: usize) -> Self {
        Self {
            inverse: lanes.single(query.inverse[axis]),
            offset: [lanes.single(query.offset[0][axis]), lanes.single(query.offset[1][axis])],
            side: usize::from(query.side[axis]),
        }
    }

    #[inline(always)]
    fn enter(&self, lanes: E, faces: &[[f32; CHILDREN]; 2]) -> E::Singles {
        lanes.singles(&faces[self.side & 1]).near_mul_add(self.inverse, self.offset[0])
    }

    #[inline(always)]
    fn leave(&self, lanes: E, faces: &[[f32; CHILDREN]; 2]) -> E::Singles {
        lanes.singles(&faces[self.side & 1 ^ 1]).near_mul_add(self.inverse, self.offset[1])
    }
}

impl Hierarchy {
    /// Calls `meet` with the places of each leaf that the ray may be in for some t
    /// from `from` to `to`, roughly the nearest first; what it returns is the new
    /// `to`, or that this is enough. Each box counts as larger by `margin` on all
    /// sides.
    #[inline(always)]
    pub(crate) fn visit<E: Eight>(
        &self,
        lanes: E,
        stack: &mut Stack,
        ray: &Ray,
        margin: f64,
        stretch: (f64, f64),
        meet: impl FnMut(Range<usize>, f64) -> ControlFlow<(), f64>,
    ) {
        self.walk::<true, E>(lanes, stack, ray, margin, stretch, meet);
    }

    /// The same in no order of distance: of a node's children the largest first, where
    /// the ray most likely meets something. What is beyond the new `to` may still be visited.
    #[inline(always)]
    pub(crate) fn visit_any<E: Eight>(
        &self,
        lanes: E,
        stack: &mut Stack,
        ray: &Ray,
        margin: f64,
        stretch: (f64, f64),
        meet: impl FnMut(Range<usize>, f64) -> ControlFlow<(), f64>,
    ) {
        self.walk::<false, E>(lanes, stack, ray, margin, stretch, meet);
    }

    #[inline(always)]
    fn walk<const ORDERED: bool, E: Eight>(
        &self,
        lanes: E,
        stack: &mut Stack,
        ray: &Ray,
        margin: f64,
        (from, to): (f64, f64),
        mut meet: impl FnMut(Range<usize>, f64) -> ControlFlow<(), f64>,
    ) {
        let Some(query) = Query::new(&self.space, &self.bounds, ray, margin, (from, to)) else {
            return;
        };
        let axes =
            [Axis::new(lanes, &query, 0), Axis::new(lanes, &query, 1), Axis::new(lanes, &query, 2)];
        let zero = lanes.single(0.0);
        let mut to = to;
        let mut reach = query.reach(to);
        let Stack { ordered: stack, unordered } = stack;
        let mut height = 0;
        let mut current = Child::node(0);
        loop {
            if current.is_leaf() {
                match meet(current.places(), to) {
                    ControlFlow::Break(()) => return,
                    ControlFlow::Continue(nearer) if nearer < to => {
                        to = nearer;
                        reach = query.reach(to);
                    }
                    ControlFlow::Continue(_) => {}
                }
            } else if let Some(node) = self.nodes.get(current.0 as usize) {
                let [x, y, z] = &node.faces;
                let enter = axes[0]
                    .enter(lanes, x)
                    .max(axes[1].enter(lanes, y))
                    .max(axes[2].enter(lanes, z).max(zero));
                let leave = axes[0]
                    .leave(lanes, x)
                    .min(axes[1].leave(lanes, y))
                    .min(axes[2].leave(lanes, z).min(lanes.single(reach)));
                let mut bits = enter.le(leave);
                if !ORDERED && bits != 0 {
                    // The last one, the largest, is the next.
                    let slot = (31 - bits.leading_zeros()) as usize & (CHILDREN - 1);
                    let numbers = node.children.each_ref().map(
                        #[inline(always)]
                        |child| child.0,
                    );
                    // No loop: how many there are is hard to predict.
                    let above = &mut unordered[height & (ENTRIES - 1)..];
                    if let Some(above) = above.first_chunk_mut() {
                        lanes.pack(&numbers, bits, above);
                    }
                    height += bits.count_ones() as usize - 1;
                    current = node.children[slot];
                    continue;
                }
                if bits != 0 {
                    let mut distances = [0.0; CHILDREN];
                    enter.store(&mut distances);
                    let mut next = || {
                        let slot = bits.trailing_zeros() as usize & (CHILDREN - 1);
                        bits &= bits - 1;
                        (entry(distances[slot], node.children[slot]), bits != 0)
                    };
                    let (first, more) = next();
                    if !more {
                        current = Child(first as u32);
                        continue;
                    }
                    let (second, more) = next();
                    let (mut nearest, other) =
                        if first < second { (first, second) } else { (second, first) };
                    stack[height & (ENTRIES - 1)] = other;
                    height += 1;
                    let bottom = height - 1;
                    let mut more = more;
                    while more {
                        let (mut new, rest) = next();
                        more = rest;
                        if new < nearest {
                            std::mem::swap(&mut new, &mut nearest);
                        }
                        // The farthest one at the bottom.
                        let mut at = height;
                        while at > bottom && stack[(at - 1) & (ENTRIES - 1)] < new {
                            stack[at & (ENTRIES - 1)] = stack[(at - 1) & (ENTRIES - 1)];
                            at -= 1;
                        }
                        stack[at & (ENTRIES - 1)] = new;
                        height += 1;
                    }
                    current = Child(nearest as u32);
                    continue;
                }
            }
            // The next one that is still near enough.
            loop {
                if height == 0 {
                    return;
                }
                height -= 1;
                if !ORDERED {
                    current = Child(unordered[height & (ENTRIES - 1)]);
                    break;
                }
                let entry = stack[height & (ENTRIES - 1)];
                if f32::from_bits((entry >> 32) as u32) <= reach {
                    current = Child(entry as u32);
                    break;
                }
            }
        }
    }

    /// Calls `meet` with the places of each leaf whose box may hold the point.
    pub(crate) fn visit_around(&self, point: &Point, mut meet: impl FnMut(Range<usize>)) {
        if !self.bounds.contains(point) || self.nodes.is_empty() {
            return;
        }
        let [low, high] = self.space.outward(&lancer_math::Bounds { min: *point, max: *point });
        let mut open = vec![0_u32];
        while let Some(number) = open.pop() {
            let node = &self.nodes[number as usize];
            for slot in 0..CHILDREN {
                let Some((sides, child)) = node.child(slot) else { continue };
                if (0..3).any(|i| high[i] < sides[0][i] || low[i] > sides[1][i]) {
                    continue;
                }
                if child.is_leaf() {
                    meet(child.places());
                } else {
                    open.push(child.0);
                }
            }
        }
    }
}
