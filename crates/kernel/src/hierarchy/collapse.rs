//! From two children to eight: which nodes of the binary hierarchy are kept is
//! found as the cheapest of all ways (Ylitalo, Karras and Laine, *Efficient
//! Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs*, HPG 2017, 3.1).
//!
//! `costs[i]` is what a subtree costs at least as at most i trees side by side, of
//! 1 to 7, and `choices[i]` how many of them its first child makes, or 0 where
//! fewer are as good; `choices[1]` is 1 where one leaf is cheapest. `choices[8]` is
//! for the node that it may become itself.

use super::build::Binary;
use super::node::{CHILDREN, Child, LEAF, Node};

/// What a part of the binary hierarchy costs as so many trees.
pub(super) type Costs = [f32; CHILDREN + 1];

/// What a ray does at a node, in units of that.
const NODE: f32 = 1.0;

/// All of a leaf's items are looked at together; a larger one is more to read.
pub(super) fn cost_of_leaf(count: usize) -> f32 {
    1.0 + 0.05 * count as f32
}

pub(super) fn cost_of_node(
    choices: &mut [u8; CHILDREN + 1],
    area: f32,
    leaf: Option<f32>,
    first: &Costs,
    second: &Costs,
) -> Costs {
    let mut costs = [f32::INFINITY; CHILDREN + 1];
    for trees in 2..=CHILDREN {
        let (mut least, mut choice) = (f32::INFINITY, 1);
        for k in 1..trees {
            let cost = first[k] + second[trees - k];
            if cost < least {
                (least, choice) = (cost, k);
            }
        }
        costs[trees] = least;
        choices[trees] = choice as u8;
    }
    let node = area * NODE + costs[CHILDREN];
    match leaf {
        Some(leaf) if leaf <= node => {
            costs[1] = leaf;
            choices[1] = 1;
        }
        _ => {
            costs[1] = node;
            choices[1] = 0;
        }
    }
    for trees in 2..CHILDREN {
        if costs[trees - 1] <= costs[trees] {
            costs[trees] = costs[trees - 1];
            choices[trees] = 0;
        }
    }
    costs
}

/// The nodes with eight children; the first is the root.
pub(super) fn collapse(binary: &[Binary]) -> Vec<Node> {
    let mut nodes = vec![Node::EMPTY];
    if is_leaf(&binary[0]) {
        nodes[0].set(0, binary[0].bounds.sides(), leaf(&binary[0]));
        return nodes;
    }
    // Which binary node is to become which wide one.
    let mut open = vec![(0_usize, 0_usize)];
    let (mut trees, mut kept) = (Vec::new(), Vec::new());
    while let Some((from, to)) = open.pop() {
        trees.clear();
        trees.push((from, CHILDREN));
        kept.clear();
        while let Some((index, mut count)) = trees.pop() {
            let node = &binary[index];
            while count > 1 && node.choices[count] == 0 {
                count -= 1;
            }
            if count > 1 {
                let first = usize::from(node.choices[count]);
                trees.push((index + node.second as usize, count - first));
                trees.push((index + 1, first));
            } else {
                kept.push(index);
            }
        }
        // The largest last: there a ray most likely meets something.
        kept.sort_by(|a, b| binary[*a].bounds.area().total_cmp(&binary[*b].bounds.area()));
        for (slot, &index) in kept.iter().enumerate() {
            let node = &binary[index];
            let child = if is_leaf(node) {
                leaf(node)
            } else {
                nodes.push(Node::EMPTY);
                open.push((index, nodes.len() - 1));
                Child::node(nodes.len() as u32 - 1)
            };
            nodes[to].set(slot, node.bounds.sides(), child);
        }
    }
    nodes.shrink_to_fit();
    nodes
}

fn is_leaf(node: &Binary) -> bool {
    node.second == 0 || node.choices[1] == 1
}

fn leaf(node: &Binary) -> Child {
    debug_assert!(node.count as usize <= LEAF);
    Child::leaf(node.first, node.count)
}
