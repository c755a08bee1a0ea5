//! Triangles in a plain tree of boxes, to be met by the textbook's test with boxes as they are,
//! and by Lancer's test with boxes that are rounded outward: everything else is the same.

use lancer_kernel::lanes::{Lanes, Work};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::Mesh;

const NEAREST: f64 = 1e-9;
/// Triangles of a leaf.
const FEW: usize = 4;

struct Node {
    min: [f64; 3],
    max: [f64; 3],
    /// The first triangle and how many, or the second child and 0; the first child is next.
    first: usize,
    count: usize,
}

pub(super) struct Tree {
    nodes: Vec<Node>,
    triangles: Vec<[[f64; 3]; 3]>,
}

impl Tree {
    pub(super) fn new(mesh: &Mesh) -> Self {
        let corner = |p: Point| p.coords.into();
        let mut triangles: Vec<[[f64; 3]; 3]> =
            (0..mesh.triangle_count()).map(|i| mesh.corners(i).map(corner)).collect();
        let mut nodes = Vec::new();
        split(&mut triangles, 0, &mut nodes);
        Self { nodes, triangles }
    }

    /// The nearest t.
    #[inline(always)]
    fn nearest<const OURS: bool>(&self, ray: &Ray, far: f64) -> f64 {
        let inverse = ray.direction.map(|c| 1.0 / c);
        let shear = Shear::new(ray);
        let mut best = far;
        let (mut stack, mut top) = ([0_usize; 64], 1);
        while top > 0 {
            top -= 1;
            let index = stack[top];
            let node = &self.nodes[index];
            if !meets_box::<OURS>(node, ray, &inverse, best) {
                continue;
            }
            if node.count == 0 {
                stack[top] = node.first;
                stack[top + 1] = index + 1;
                top += 2;
                continue;
            }
            for triangle in &self.triangles[node.first..node.first + node.count] {
                let t = if OURS { shear.meet(triangle) } else { usual(ray, triangle) };
                // Not for NaN, which is none.
                if t < best && t > if OURS { 0.0 } else { NEAREST } {
                    best = t;
                }
            }
        }
        best
    }
}

fn split(triangles: &mut [[[f64; 3]; 3]], first: usize, nodes: &mut Vec<Node>) {
    let (mut min, mut max) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for corner in triangles.iter().flatten() {
        for axis in 0..3 {
            min[axis] = min[axis].min(corner[axis]);
            max[axis] = max[axis].max(corner[axis]);
        }
    }
    let index = nodes.len();
    nodes.push(Node { min, max, first, count: triangles.len() });
    if triangles.len() <= FEW {
        return;
    }
    let axis = (0..3).fold(0, |a, b| if max[b] - min[b] > max[a] - min[a] { b } else { a });
    let middle = |t: &[[f64; 3]; 3]| t[0][axis] + t[1][axis] + t[2][axis];
    let half = triangles.len() / 2;
    triangles.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
    let (left, right) = triangles.split_at_mut(half);
    split(left, first, nodes);
    (nodes[index].first, nodes[index].count) = (nodes.len(), 0);
    split(right, first + half, nodes);
}

#[inline(always)]
fn meets_box<const OURS: bool>(node: &Node, ray: &Ray, inverse: &Vector, best: f64) -> bool {
    // Ize, Robust BVH Ray Traversal, 2013.
    const WIDER: f64 = 1.0 + 4.0 * f64::EPSILON;
    let (mut near, mut far) = (0.0, best);
    for axis in 0..3 {
        let a = (node.min[axis] - ray.origin[axis]) * inverse[axis];
        let b = (node.max[axis] - ray.origin[axis]) * inverse[axis];
        let (a, b) = if a < b { (a, b) } else { (b, a) };
        let b = if OURS { b * WIDER } else { b };
        near = if a > near { a } else { near };
        far = if b < far { b } else { far };
    }
    near <= far
}

/// Möller and Trumbore, with the division last.
#[inline(always)]
fn usual(ray: &Ray, [a, b, c]: &[[f64; 3]; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| Vector::new(p[0], p[1], p[2]));
    let (e1, e2) = (b - a, c - a);
    let p = ray.direction.cross(&e2);
    let determinant = e1.dot(&p);
    let inverse = 1.0 / determinant;
    let s = ray.origin.coords - a;
    let u = s.dot(&p) * inverse;
    if !(0.0..=1.0).contains(&u) {
        return f64::NAN;
    }
    let q = s.cross(&e1);
    let v = ray.direction.dot(&q) * inverse;
    if v < 0.0 || u + v > 1.0 {
        return f64::NAN;
    }
    e2.dot(&q) * inverse
}

/// As `shapes/edges.rs` of the kernel has it.
struct Shear {
    origin: [f64; 3],
    axes: [usize; 3],
    slopes: [f64; 2],
    inverse: f64,
}

impl Shear {
    #[inline(always)]
    fn new(ray: &Ray) -> Self {
        let z = ray.direction.iamax();
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let inverse = 1.0 / ray.direction[z];
        let slopes = [ray.direction[axes[0]] * inverse, ray.direction[axes[1]] * inverse];
        Self { origin: axes.map(|axis| ray.origin[axis]), axes, slopes, inverse }
    }

    #[inline(always)]
    fn see(&self, p: &[f64; 3]) -> [f64; 3] {
        let [i, j, k] = self.axes;
        let z = p[k] - self.origin[2];
        let (x, y) = (p[i] - self.origin[0], p[j] - self.origin[1]);
        [x - self.slopes[0] * z, y - self.slopes[1] * z, z]
    }

    #[inline(always)]
    fn meet(&self, corners: &[[f64; 3]; 3]) -> f64 {
        let [a, b, c] = [self.see(&corners[0]), self.see(&corners[1]), self.see(&corners[2])];
        let first = side(b, c);
        let met = if first > 0.0 {
            side(c, a) > 0.0 && side(a, b) > 0.0
        } else {
            first < 0.0 && side(c, a) < 0.0 && side(a, b) < 0.0
        };
        if !met {
            return f64::NAN;
        }
        let areas = [area(b, c), area(c, a), area(a, b)];
        let depth = areas[0] * a[2] + areas[1] * b[2] + areas[2] * c[2];
        depth / (areas[0] + areas[1] + areas[2]) * self.inverse
    }
}

#[inline(always)]
fn side(p: [f64; 3], q: [f64; 3]) -> f64 {
    let (first, second) = (p[0] * q[1], p[1] * q[0]);
    if first != second {
        return first - second;
    }
    let exact = p[0].mul_add(q[1], -first) - p[1].mul_add(q[0], -second);
    if exact != 0.0 {
        exact
    } else if p[1] != q[1] {
        p[1] - q[1]
    } else {
        q[0] - p[0]
    }
}

#[inline(always)]
fn area(p: [f64; 3], q: [f64; 3]) -> f64 {
    let product = p[1] * q[0];
    let lost = p[1].mul_add(q[0], -product);
    p[0].mul_add(q[1], -product) - lost
}

/// All rays, one by one: the sum of the distances and how many meet something.
pub(super) struct Follow<'a> {
    pub(super) tree: &'a Tree,
    pub(super) rays: &'a [Ray],
    pub(super) ours: bool,
}

impl Work for Follow<'_> {
    type Output = usize;

    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> usize {
        let met = |t: f64| usize::from(t < f64::INFINITY);
        let mut count = 0;
        for ray in self.rays {
            count += met(if self.ours {
                self.tree.nearest::<true>(ray, f64::INFINITY)
            } else {
                self.tree.nearest::<false>(ray, f64::INFINITY)
            });
        }
        count
    }
}
