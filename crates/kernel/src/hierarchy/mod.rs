//! A hierarchy of boxes, so that a ray is not held against everything.
//!
//! A node has up to eight children, whose boxes are kept in single precision,
//! rounded outward, and are held against a ray at once. It is built from the top
//! by the surface-area heuristic with two children a node (`build.rs`), which are
//! then merged to eight in the cheapest way (`collapse.rs`). The test of a box
//! loses nothing (`query.rs`), and a ray along a face counts as inside; so what
//! is found does not depend on the boxes. A walk has a stack of fixed size
//! (`walk.rs`), as the depth is bounded.

mod build;
mod collapse;
mod node;
mod query;
mod sort;
#[cfg(test)]
mod tests;
mod walk;

use build::{DEPTH, Item};
use lancer_math::Bounds;
pub use node::BOX_SLACK;
pub(crate) use node::LEAF;
use node::{CHILDREN, MOST_ITEMS, Node, Space};
pub(crate) use query::stretch_in;
use rayon::prelude::*;
pub(crate) use sort::{answer_each, order_in};
use std::ops::Range;
pub(crate) use walk::Stack;

/// A hierarchy over boxes, which it does not keep.
#[derive(Debug)]
pub(crate) struct Hierarchy {
    space: Space,
    bounds: Bounds,
    nodes: Vec<Node>,
}

impl Hierarchy {
    /// The hierarchy over some boxes, which must be finite, and their numbers in the
    /// order that the places of leaves count in.
    ///
    /// # Panics
    /// Where there are more than 2^28.
    #[cfg(test)]
    pub(crate) fn new(boxes: &[Bounds]) -> (Self, Vec<u32>) {
        Self::over(boxes.len(), |i| boxes[i])
    }

    /// The same over so many boxes, each of which is asked for twice.
    ///
    /// # Panics
    /// Where there are more than 2^28.
    pub(crate) fn over(
        count: usize,
        bounds_of: impl Fn(usize) -> Bounds + Sync,
    ) -> (Self, Vec<u32>) {
        Self::with_leaves_of(LEAF, count, bounds_of)
    }

    /// The same with at most so many boxes in a leaf: for what is not looked at together.
    ///
    /// # Panics
    /// Where there are more than 2^28.
    pub(crate) fn with_leaves_of(
        most: usize,
        count: usize,
        bounds_of: impl Fn(usize) -> Bounds + Sync,
    ) -> (Self, Vec<u32>) {
        assert!(count <= MOST_ITEMS, "{count} boxes");
        let bounds = (0..count)
            .into_par_iter()
            .with_min_len(1024)
            .map(&bounds_of)
            .reduce(|| Bounds::EMPTY, Bounds::union);
        let space = Space::of(&bounds);
        if count == 0 {
            return (Self { space, bounds, nodes: Vec::new() }, Vec::new());
        }
        let mut items: Vec<Item> = (0..count)
            .into_par_iter()
            .with_min_len(1024)
            .map(|i| Item::new(space.outward(&bounds_of(i)), i as u32))
            .collect();
        let binary = build::build(&mut items, most);
        let nodes = collapse::collapse(&binary);
        let order = items.iter().map(Item::number).collect();
        (Self { space, bounds, nodes }, order)
    }

    /// The places of each leaf.
    pub(crate) fn leaves(&self) -> impl Iterator<Item = Range<usize>> {
        let children =
            self.nodes.iter().flat_map(|node| (0..CHILDREN).filter_map(|i| node.child(i)));
        children.filter(|(_, child)| child.is_leaf()).map(|(_, child)| child.places())
    }

    /// How much memory its nodes take.
    pub(crate) fn bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
    }
}
