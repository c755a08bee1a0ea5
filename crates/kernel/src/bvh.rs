//! A hierarchy of boxes, so that a ray is not held against every shape.
//!
//! Binary, built from the top by the surface-area heuristic over sixteen bins
//! (Wald, *On fast Construction of SAH-based Bounding Volume Hierarchies*, 2007).
//! Boxes are kept in double precision. The test of a box is conservative (Ize,
//! *Robust BVH Ray Traversal*, JCGT 2(2), 2013) and counts a ray along a face as
//! inside, so a hierarchy never loses a hit.

use lancer_math::{Bounds, Ray, Vector};

#[derive(Debug)]
pub(crate) struct Bvh {
    nodes: Vec<Node>,
    /// The numbers of the boxes, those of each leaf together.
    order: Vec<u32>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    bounds: Bounds,
    /// Of a leaf its first place in `order`; else the first of two neighbouring
    /// children.
    first: u32,
    /// How many boxes a leaf has; 0 for what is no leaf.
    count: u32,
}

/// A leaf has at most so many boxes, unless they cannot be told apart.
const LEAF: usize = 4;

const BINS: usize = 16;

/// From this depth on halves are made by number, so that no order of boxes
/// makes the hierarchy deeper than [`STACK`].
const DEEP: usize = 48;

/// 48 levels, and at most 32 more by halving up to 2^32 boxes.
const STACK: usize = 96;

impl Bvh {
    /// The hierarchy over some boxes, which must be finite.
    pub(crate) fn new(boxes: &[Bounds]) -> Self {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = vec![Node { bounds: Bounds::EMPTY, first: 0, count: 0 }];
        let mut open = vec![(0_usize, 0..boxes.len(), 0_usize)];
        while let Some((node, range, depth)) = open.pop() {
            let part = &mut order[range.clone()];
            let bounds = union(boxes, part);
            let middle = if part.len() <= LEAF { None } else { split(boxes, part, &bounds, depth) };
            nodes[node] = match middle {
                None => Node { bounds, first: range.start as u32, count: part.len() as u32 },
                Some(middle) => {
                    let first = nodes.len();
                    nodes.extend([nodes[node]; 2]);
                    let middle = range.start + middle;
                    open.push((first, range.start..middle, depth + 1));
                    open.push((first + 1, middle..range.end, depth + 1));
                    Node { bounds, first: first as u32, count: 0 }
                }
            };
        }
        Self { nodes, order }
    }

    /// The numbers of the boxes, those of each leaf together.
    pub(crate) fn leaves(&self) -> impl Iterator<Item = &[u32]> {
        let leaves = self.nodes.iter().filter(|node| node.count > 0);
        leaves.map(|node| &self.order[node.first as usize..][..node.count as usize])
    }

    /// Calls `meet` with the number of each box that the ray may be in for some
    /// t from `from` to `to`, roughly the nearest first; what it returns is the
    /// new `to`.
    #[inline]
    pub(crate) fn visit(&self, ray: &Ray, from: f64, to: f64, meet: impl FnMut(usize, f64) -> f64) {
        self.visit_wide(ray, 0.0, from, to, meet);
    }

    /// The same, of boxes each of which is larger by `margin` on all sides.
    #[inline]
    pub(crate) fn visit_wide(
        &self,
        ray: &Ray,
        margin: f64,
        from: f64,
        mut to: f64,
        mut meet: impl FnMut(usize, f64) -> f64,
    ) {
        let slabs = Slabs::new(ray, margin);
        let mut stack = [0_u32; STACK];
        let mut height = 0;
        let mut index = 0_u32;
        if slabs.enter(&self.nodes[0].bounds, from, to).is_none() {
            return;
        }
        loop {
            let node = &self.nodes[index as usize];
            if node.count > 0 || self.order.is_empty() {
                let first = node.first as usize;
                for &item in &self.order[first..first + node.count as usize] {
                    to = meet(item as usize, to);
                }
            } else {
                let (left, right) = (node.first, node.first + 1);
                let a = slabs.enter(&self.nodes[left as usize].bounds, from, to);
                let b = slabs.enter(&self.nodes[right as usize].bounds, from, to);
                match (a, b) {
                    (Some(a), Some(b)) => {
                        let (near, far) = if b < a { (right, left) } else { (left, right) };
                        stack[height] = far;
                        height += 1;
                        index = near;
                        continue;
                    }
                    (Some(_), None) => {
                        index = left;
                        continue;
                    }
                    (None, Some(_)) => {
                        index = right;
                        continue;
                    }
                    (None, None) => {}
                }
            }
            // The next one that is still near enough.
            loop {
                if height == 0 {
                    return;
                }
                height -= 1;
                index = stack[height];
                if slabs.enter(&self.nodes[index as usize].bounds, from, to).is_some() {
                    break;
                }
            }
        }
    }
}

fn union(boxes: &[Bounds], part: &[u32]) -> Bounds {
    part.iter().fold(Bounds::EMPTY, |bounds, &i| bounds.union(boxes[i as usize]))
}

/// Half the surface of a box.
fn area(bounds: &Bounds) -> f64 {
    let s = bounds.sides();
    s.x * s.y + s.y * s.z + s.z * s.x
}

/// Orders the part so that those of the first child come first, and says how
/// many they are; `None` where a leaf is cheaper or the boxes cannot be told
/// apart by their middles.
fn split(boxes: &[Bounds], part: &mut [u32], bounds: &Bounds, depth: usize) -> Option<usize> {
    let centre = |i: u32, axis: usize| boxes[i as usize].centre()[axis];
    let middles = Bounds::around(part.iter().map(|&i| boxes[i as usize].centre()));
    let sides = middles.sides();
    let axis = sides.imax();
    if depth >= DEEP || !(sides[axis] > 0.0 && sides[axis].is_finite()) {
        // Nothing to choose by: halves.
        let half = part.len() / 2;
        part.select_nth_unstable_by(half, |&a, &b| {
            centre(a, axis).total_cmp(&centre(b, axis)).then(a.cmp(&b))
        });
        return Some(half);
    }
    let bin_of = |i: u32| {
        let share = (centre(i, axis) - middles.min[axis]) / sides[axis];
        // Saturates.
        ((share * BINS as f64) as usize).min(BINS - 1)
    };
    let mut bins = [(Bounds::EMPTY, 0_usize); BINS];
    for &i in part.iter() {
        let bin = &mut bins[bin_of(i)];
        *bin = (bin.0.union(boxes[i as usize]), bin.1 + 1);
    }
    let mut right = [(0.0, 0_usize); BINS];
    let mut sum = (Bounds::EMPTY, 0);
    for k in (1..BINS).rev() {
        sum = (sum.0.union(bins[k].0), sum.1 + bins[k].1);
        right[k] = (if sum.1 > 0 { area(&sum.0) } else { 0.0 }, sum.1);
    }
    let mut best: Option<(f64, usize)> = None;
    let mut left = (Bounds::EMPTY, 0);
    for k in 1..BINS {
        left = (left.0.union(bins[k - 1].0), left.1 + bins[k - 1].1);
        if left.1 == 0 || right[k].1 == 0 {
            continue;
        }
        let cost = area(&left.0) * left.1 as f64 + right[k].0 * right[k].1 as f64;
        if best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, k));
        }
    }
    let (cost, bin) = best?;
    // Going down costs about as much as one shape.
    if part.len() <= 4 * LEAF && cost + area(bounds) >= area(bounds) * part.len() as f64 {
        return None;
    }
    // In order, so that the hierarchy depends on nothing else.
    let (first, second): (Vec<u32>, Vec<u32>) = part.iter().partition(|&&i| bin_of(i) < bin);
    part[..first.len()].copy_from_slice(&first);
    part[first.len()..].copy_from_slice(&second);
    Some(first.len())
}

/// A ray made ready to be held against boxes.
struct Slabs {
    /// Moved by the margin, once against the direction and once along it.
    before: Vector,
    after: Vector,
    inverse: Vector,
    towards_less: [bool; 3],
}

/// More than one, by more than the roundings of a difference, an inverse and a
/// product can make a far side seem nearer.
const ROUNDED_UP: f64 = 1.0 + 8.0 * f64::EPSILON;

impl Slabs {
    fn new(ray: &Ray, margin: f64) -> Self {
        let inverse = ray.direction.map(|d| 1.0 / d);
        let margin = inverse.map(|i| margin.copysign(i));
        Self {
            before: ray.origin.coords + margin,
            after: ray.origin.coords - margin,
            inverse,
            // By the bit: 1 / -0 is minus infinity.
            towards_less: [0, 1, 2].map(|axis| inverse[axis].is_sign_negative()),
        }
    }

    /// From where on the ray is in the box, if it is so between `from` and `to`.
    ///
    /// Along an axis in which the ray does not move, it is between the sides
    /// everywhere or nowhere; exactly on one, infinity times 0 is not a number
    /// and, as it is compared here, does not narrow the interval.
    #[inline]
    fn enter(&self, bounds: &Bounds, from: f64, to: f64) -> Option<f64> {
        let (mut near, mut far) = (from, to);
        for axis in 0..3 {
            let (low, high) = if self.towards_less[axis] {
                (bounds.max[axis], bounds.min[axis])
            } else {
                (bounds.min[axis], bounds.max[axis])
            };
            let enter = (low - self.before[axis]) * self.inverse[axis];
            let leave = (high - self.after[axis]) * self.inverse[axis];
            // Outward: away from where the ray is.
            let enter = if enter > 0.0 { enter / ROUNDED_UP } else { enter * ROUNDED_UP };
            let leave = if leave > 0.0 { leave * ROUNDED_UP } else { leave / ROUNDED_UP };
            if enter > near {
                near = enter;
            }
            if leave < far {
                far = leave;
            }
        }
        (near <= far).then_some(near)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastrand::Rng;
    use lancer_math::Point;

    fn boxes(rng: &mut Rng, count: usize, grid: bool) -> Vec<Bounds> {
        let mut point = |size: f64| {
            let mut c = || {
                let c = size * (2.0 * rng.f64() - 1.0);
                if grid { c.round() } else { c }
            };
            Vector::new(c(), c(), c())
        };
        (0..count)
            .map(|_| {
                let a = Point::from(point(8.0));
                Bounds::around([a, a + point(2.0)])
            })
            .collect()
    }

    /// With whole numbers everything is exact, so a ray through a corner is in.
    #[test]
    fn no_box_that_a_ray_goes_through_is_lost() {
        for case in 0..400 {
            let mut rng = Rng::with_seed(case);
            let boxes = boxes(&mut rng, 1 + case as usize % 60, true);
            let bvh = Bvh::new(&boxes);
            for _ in 0..60 {
                let target = rng.usize(0..boxes.len());
                let corner = boxes[target].corners()[rng.usize(0..8)];
                let mut whole = || f64::from(rng.i32(-3..4));
                let direction = Vector::new(whole(), whole(), whole());
                if direction.norm_squared() == 0.0 {
                    continue;
                }
                let ray = Ray::new(corner - direction * 4.0, direction);
                let mut met = false;
                bvh.visit(&ray, 0.0, f64::INFINITY, |i, to| {
                    met |= i == target;
                    to
                });
                assert!(met, "case {case}: box {target} {:?} by {ray:?}", boxes[target]);
            }
        }
    }

    #[test]
    fn each_box_is_in_one_leaf_and_its_parents_hold_it() {
        for (count, case) in [0, 1, 4, 5, 1000, 5000].into_iter().zip(0..) {
            let mut rng = Rng::with_seed(case);
            let boxes = boxes(&mut rng, count, false);
            let bvh = Bvh::new(&boxes);
            let mut seen = bvh.order.clone();
            seen.sort_unstable();
            assert!(seen.iter().copied().eq(0..count as u32));
            for node in &bvh.nodes {
                let inside = if node.count > 0 {
                    union(&boxes, &bvh.order[node.first as usize..][..node.count as usize])
                } else if count > 0 {
                    let pair = &bvh.nodes[node.first as usize..][..2];
                    pair[0].bounds.union(pair[1].bounds)
                } else {
                    continue;
                };
                assert_eq!(node.bounds, inside);
            }
        }
    }

    /// Neither a hang nor a deep hierarchy.
    #[test]
    fn boxes_that_cannot_be_told_apart_are_halved() {
        let same = vec![Bounds::around([Point::origin(), Point::new(1.0, 1.0, 1.0)]); 10_000];
        let bvh = Bvh::new(&same);
        let ray = Ray::new(Point::new(0.5, 0.5, -1.0), Vector::z());
        let mut met = 0;
        bvh.visit(&ray, 0.0, f64::INFINITY, |_, to| {
            met += 1;
            to
        });
        assert_eq!(met, 10_000);
        // Each half the size of the one before.
        let mut side = 1e300;
        let halves: Vec<_> = (0..1900)
            .map(|_| {
                side /= 2.0;
                Bounds::around([Point::origin(), Point::new(side, side, side)])
            })
            .collect();
        let bvh = Bvh::new(&halves);
        let ray = Ray::new(Point::new(0.0, 0.0, -1.0), Vector::z());
        let mut met = 0;
        bvh.visit(&ray, 0.0, f64::INFINITY, |_, to| {
            met += 1;
            to
        });
        assert_eq!(met, 1900);
    }
}
