//! The triangles of the leaves, so that a ray is held against those of one leaf
//! together.
//!
//! The nine coordinates of n triangles are nine rows of n numbers, without gaps:
//! in single precision where that holds all of them exactly. A row is read eight
//! numbers wide; what is behind its end is not looked at. Rounding keeps the
//! order of two products unless it makes them equal, so lanes decide for eight triangles at
//! once, and find where they are met with the operations of `edges.rs`; only where
//! products are equal, or fusing is no instruction, those that may be met are met one by one as
//! `edges.rs` has it.

use crate::hierarchy::Hierarchy;
use crate::lanes::{Answers, Doubles, Eight, lanes_of};
use crate::shapes::edges::{Meeting, Shear};
use lancer_scene::Mesh;
use std::ops::Range;

#[derive(Debug)]
pub(super) struct Leaves {
    rows: Rows,
    /// The numbers of the triangles.
    order: Vec<u32>,
}

#[derive(Debug)]
enum Rows {
    Single(Vec<f32>),
    Double(Vec<f64>),
}

/// Coordinates of a triangle.
const ROWS: usize = 9;

impl Leaves {
    pub(super) fn new(mesh: &Mesh, hierarchy: &Hierarchy, order: Vec<u32>) -> Self {
        let corner =
            |place: usize, row: usize| mesh.corners(order[place] as usize)[row / 3][row % 3];
        let is_single = |x: f64| f64::from(x as f32).to_bits() == x.to_bits();
        let all_single = (0..order.len()).all(|place| {
            mesh.corners(order[place] as usize).iter().flat_map(|p| p.iter()).all(|&x| is_single(x))
        });
        let length = ROWS * order.len() + READABLE;
        let rows = if all_single {
            let mut rows = vec![0.0; length];
            for places in hierarchy.leaves() {
                fill(&mut rows, places, |place, row| corner(place, row) as f32);
            }
            Rows::Single(rows)
        } else {
            let mut rows = vec![0.0; length];
            for places in hierarchy.leaves() {
                fill(&mut rows, places, corner);
            }
            Rows::Double(rows)
        };
        Self { rows, order }
    }

    pub(super) fn bytes(&self) -> usize {
        let rows = match &self.rows {
            Rows::Single(rows) => rows.capacity() * size_of::<f32>(),
            Rows::Double(rows) => rows.capacity() * size_of::<f64>(),
        };
        rows + self.order.capacity() * size_of::<u32>()
    }

    /// The ray made ready to be held against the triangles of a leaf.
    #[inline(always)]
    pub(super) fn filter<E: Eight>(&self, lanes: E, shear: &Shear) -> Filter<E> {
        let ([x, y, z], [u, v]) = (shear.axes(), shear.slopes());
        let origin = shear.origin();
        let [first, second] = shear.others();
        Filter {
            lanes,
            axes: [x, y, z],
            origin: [lanes.double(origin[x]), lanes.double(origin[y]), lanes.double(origin[z])],
            slopes: [lanes.double(u), lanes.double(v)],
            longest: lanes.double(shear.longest()),
            inverses: [lanes.double(1.0 / first), lanes.double(1.0 / second)],
            moves: [first != 0.0, second != 0.0],
        }
    }

    /// Calls `met` with the number of each triangle there that the ray goes through, and
    /// the t, if that is more than `from` and at most `to`.
    #[inline(always)]
    pub(super) fn each<E: Eight>(
        &self,
        filter: &Filter<E>,
        shear: &Shear,
        places: Range<usize>,
        (from, to): (f64, f64),
        mut met: impl FnMut(u32, f64),
    ) {
        let first = ROWS * places.start;
        // Bits that are known to the compiler, so that rows are read unchecked.
        let count = places.len() & 15;
        match &self.rows {
            Rows::Single(rows) => {
                let Some(leaf) = rows.get(first..).and_then(<[f32]>::first_chunk) else { return };
                filter.each(
                    count,
                    (from, to),
                    #[inline(always)]
                    |at| filter.lanes.widened(eight(leaf, at)),
                    #[inline(always)]
                    |lane| shear.meet_turned(&corners(leaf, count, lane, shear.axes())),
                    #[inline(always)]
                    |lane, t| met(self.order[places.start + lane], t),
                );
            }
            Rows::Double(rows) => {
                let Some(leaf) = rows.get(first..).and_then(<[f64]>::first_chunk) else { return };
                filter.each(
                    count,
                    (from, to),
                    #[inline(always)]
                    |at| filter.lanes.doubles(eight(leaf, at)),
                    #[inline(always)]
                    |lane| shear.meet_turned(&corners(leaf, count, lane, shear.axes())),
                    #[inline(always)]
                    |lane, t| met(self.order[places.start + lane], t),
                );
            }
        }
    }
}

/// So many numbers can be read from the beginning of a leaf on: more than are
/// its own, and as many as 15 rows of 15 and one more reach.
const READABLE: usize = 256;

/// Eight numbers of a leaf.
#[inline(always)]
fn eight<T>(leaf: &[T; READABLE], at: usize) -> &[T; 8] {
    leaf[at..].first_chunk().unwrap_or_else(
        #[inline(always)]
        || unreachable!(),
    )
}

/// The corners of a leaf's triangle, their coordinates in the order of the axes: no
/// array is written and then read at places that only the ray tells.
#[inline(always)]
fn corners<T: Copy + Into<f64>>(
    leaf: &[T; READABLE],
    count: usize,
    lane: usize,
    [x, y, z]: [usize; 3],
) -> [[f64; 3]; 3] {
    let number = |row: usize| leaf[(row * count + lane) % READABLE].into();
    [
        [number(x), number(y), number(z)],
        [number(3 + x), number(3 + y), number(3 + z)],
        [number(6 + x), number(6 + y), number(6 + z)],
    ]
}

fn fill<T>(rows: &mut [T], places: Range<usize>, coordinate: impl Fn(usize, usize) -> T) {
    let (first, count) = (ROWS * places.start, places.len());
    for (lane, place) in places.enumerate() {
        for row in 0..ROWS {
            rows[first + row * count + lane] = coordinate(place, row);
        }
    }
}

/// A ray made ready for eight triangles.
pub(super) struct Filter<E: Eight> {
    lanes: E,
    axes: [usize; 3],
    origin: [E::Doubles; 3],
    slopes: [E::Doubles; 2],
    longest: E::Doubles,
    inverses: [E::Doubles; 2],
    moves: [bool; 2],
}

/// A corner of each of eight triangles as [`Shear`] sees it, and before that.
#[derive(Clone, Copy)]
struct Corner<D> {
    from_origin: [D; 3],
    x: D,
    y: D,
}

/// The two products whose order says on which side of the line from p to q the ray
/// goes by.
#[derive(Clone, Copy)]
struct Products<D> {
    p: Corner<D>,
    q: Corner<D>,
    first: D,
    second: D,
}

impl<D: Doubles> Products<D> {
    #[inline(always)]
    fn new(p: Corner<D>, q: Corner<D>) -> Self {
        Self { p, q, first: p.x * q.y, second: p.y * q.x }
    }

    /// Their difference as [`difference_of_products`](crate::shapes::exact::difference_of_products)
    /// has it.
    #[inline(always)]
    fn area(&self) -> D {
        let lost = self.p.y.mul_add(self.q.x, -self.second);
        self.p.x.mul_add(self.q.y, -self.second) - lost
    }
}

impl<E: Eight> Filter<E> {
    /// Calls `met` with the lanes of those that the ray goes through, and the t, if that is
    /// more than `from` and at most `to`. What `meet` says of one triangle, lanes say of
    /// eight, but where two products are equal, so that what they lost decides.
    #[inline(always)]
    fn each(
        &self,
        count: usize,
        (from, to): (f64, f64),
        row: impl Fn(usize) -> E::Doubles,
        meet: impl Fn(usize) -> Option<Meeting>,
        mut met: impl FnMut(usize, f64),
    ) {
        let [a, b, c] =
            [self.see(0, count, &row), self.see(3, count, &row), self.see(6, count, &row)];
        let [i, j, k] = [Products::new(b, c), Products::new(c, a), Products::new(a, b)];
        let left = i.first.ge(i.second) & j.first.ge(j.second) & k.first.ge(k.second);
        let right = i.first.le(i.second) & j.first.le(j.second) & k.first.le(k.second);
        let candidates = (left | right).bits() & ((1 << count) - 1);
        if candidates == 0 {
            return;
        }
        let mut unsure = candidates;
        if self.lanes.fuses() {
            let left = i.first.gt(i.second) & j.first.gt(j.second) & k.first.gt(k.second);
            let right = i.first.lt(i.second) & j.first.lt(j.second) & k.first.lt(k.second);
            let t = self.distances([a, b, c], [i.area(), j.area(), k.area()]);
            let is_met = left | right;
            unsure &= !is_met.bits();
            let is_near = t.gt(self.lanes.double(from)) & t.le(self.lanes.double(to));
            let near = (is_met & is_near).bits() & candidates;
            if near != 0 {
                let mut distances = [0.0; 8];
                t.store(&mut distances);
                for lane in lanes_of(near) {
                    met(lane, distances[lane & 7]);
                }
            }
        }
        for lane in lanes_of(unsure) {
            if let Some(meeting) = meet(lane)
                && meeting.t > from
                && meeting.t <= to
            {
                met(lane, meeting.t);
            }
        }
    }

    /// A corner of each, as `Shear` sees it.
    #[inline(always)]
    fn see(
        &self,
        corner: usize,
        count: usize,
        row: &impl Fn(usize) -> E::Doubles,
    ) -> Corner<E::Doubles> {
        let x = row((corner + (self.axes[0] & 3)) * count) - self.origin[0];
        let y = row((corner + (self.axes[1] & 3)) * count) - self.origin[1];
        let z = row((corner + (self.axes[2] & 3)) * count) - self.origin[2];
        let [u, v] = self.slopes;
        Corner { from_origin: [x, y, z], x: x - u * z, y: y - v * z }
    }

    /// The t of each, with the operations of [`Shear::meet_turned`].
    #[inline(always)]
    fn distances(&self, [a, b, c]: [Corner<E::Doubles>; 3], areas: [E::Doubles; 3]) -> E::Doubles {
        let sum = areas[0] + areas[1] + areas[2];
        let weights = [areas[0] / sum, areas[1] / sum, areas[2] / sum];
        let [az, bz, cz] = [a.from_origin[2], b.from_origin[2], c.from_origin[2]];
        let depth = weights[0] * az + weights[1] * bz + weights[2] * cz;
        let depth = within(depth, [az, bz, cz]);
        let mut t = depth / self.longest;
        for axis in 0..2 {
            if self.moves[axis] {
                let inverse = self.inverses[axis];
                t = within(
                    t,
                    [
                        a.from_origin[axis] * inverse,
                        b.from_origin[axis] * inverse,
                        c.from_origin[axis] * inverse,
                    ],
                );
            }
        }
        t
    }
}

/// The number moved to where it is between the least and the most of three.
#[inline(always)]
fn within<D: Doubles>(x: D, [a, b, c]: [D; 3]) -> D {
    x.least(a.most(b).most(c)).most(a.least(b).least(c))
}
