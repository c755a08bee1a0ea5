//! The triangles of the leaves, so that a ray is held against those of one leaf
//! together.
//!
//! The nine coordinates of n triangles are nine rows of n numbers, without gaps:
//! in single precision where that holds all of them exactly. A row is read eight
//! numbers wide; what is behind its end is not looked at. What eight triangles tell
//! at once is which of them cannot be met, since rounding keeps the order of two
//! products unless it makes them equal; the others, hardly ever two, are met one by
//! one as `edges.rs` decides.

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
        Filter {
            lanes,
            axes: [x, y, z],
            origin: [lanes.double(origin[x]), lanes.double(origin[y]), lanes.double(origin[z])],
            slopes: [lanes.double(u), lanes.double(v)],
        }
    }

    /// Calls `met` with the number of each triangle there that the ray goes through.
    #[inline(always)]
    pub(super) fn each<E: Eight>(
        &self,
        filter: &Filter<E>,
        shear: &Shear,
        places: Range<usize>,
        mut met: impl FnMut(u32, Meeting),
    ) {
        let first = ROWS * places.start;
        // Bits that are known to the compiler, so that rows are read unchecked.
        let count = places.len() & 15;
        match &self.rows {
            Rows::Single(rows) => {
                let Some(leaf) = rows.get(first..).and_then(<[f32]>::first_chunk) else { return };
                let candidates = filter.candidates(
                    count,
                    #[inline(always)]
                    |at| filter.lanes.widened(eight(leaf, at)),
                );
                for lane in lanes_of(candidates) {
                    if let Some(meeting) =
                        shear.meet_turned(&corners(leaf, count, lane, shear.axes()))
                    {
                        met(self.order[places.start + lane], meeting);
                    }
                }
            }
            Rows::Double(rows) => {
                let Some(leaf) = rows.get(first..).and_then(<[f64]>::first_chunk) else { return };
                let candidates = filter.candidates(
                    count,
                    #[inline(always)]
                    |at| filter.lanes.doubles(eight(leaf, at)),
                );
                for lane in lanes_of(candidates) {
                    if let Some(meeting) =
                        shear.meet_turned(&corners(leaf, count, lane, shear.axes()))
                    {
                        met(self.order[places.start + lane], meeting);
                    }
                }
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

/// The two products whose order says on which side of the line from p to q the ray
/// goes by.
#[inline(always)]
fn products<D: Doubles>(p: [D; 2], q: [D; 2]) -> [D; 2] {
    [p[0] * q[1], p[1] * q[0]]
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
}

impl<E: Eight> Filter<E> {
    /// Those that the ray may go through.
    #[inline(always)]
    fn candidates(&self, count: usize, row: impl Fn(usize) -> E::Doubles) -> u32 {
        let [a, b, c] =
            [self.see(0, count, &row), self.see(3, count, &row), self.see(6, count, &row)];
        let [i, j, k] = [products(b, c), products(c, a), products(a, b)];
        let left = i[0].ge(i[1]) & j[0].ge(j[1]) & k[0].ge(k[1]);
        let right = i[0].le(i[1]) & j[0].le(j[1]) & k[0].le(k[1]);
        (left | right).bits() & ((1 << count) - 1)
    }

    /// A corner of each, as `Shear` sees it.
    #[inline(always)]
    fn see(
        &self,
        corner: usize,
        count: usize,
        row: &impl Fn(usize) -> E::Doubles,
    ) -> [E::Doubles; 2] {
        let x = row((corner + (self.axes[0] & 3)) * count) - self.origin[0];
        let y = row((corner + (self.axes[1] & 3)) * count) - self.origin[1];
        let z = row((corner + (self.axes[2] & 3)) * count) - self.origin[2];
        [x - self.slopes[0] * z, y - self.slopes[1] * z]
    }
}
