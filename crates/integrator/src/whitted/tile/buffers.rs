//! What a tile's rays carry, field by field, so that registers are filled from
//! neighbours in memory.

use crate::TILE_SIDE;
use lancer_kernel::Hit;
use lancer_kernel::lanes::{Lanes, MOST, Vectors};
use lancer_math::{Ray, Vector};

/// How many rays of a tile are followed at the same time: one for each pixel.
pub(super) const MOST_RAYS: usize = (TILE_SIDE * TILE_SIDE) as usize;

/// One more register: the last one may be filled in part. No power of two, which
/// would put all fields of a ray into the same lines of the cache.
pub(super) const ROOM: usize = MOST_RAYS + MOST;

/// A number for each ray.
pub(super) type Column = [f64; ROOM];

/// Three numbers for each ray.
pub(super) type Triple = [Column; 3];

/// From one place on, so many as are there.
pub(super) fn from(triple: &Triple, at: usize) -> [&[f64]; 3] {
    [&triple[0][at..], &triple[1][at..], &triple[2][at..]]
}

/// The same to write to.
pub(super) fn from_mut(triple: &mut Triple, at: usize) -> [&mut [f64]; 3] {
    let [x, y, z] = triple;
    [&mut x[at..], &mut y[at..], &mut z[at..]]
}

/// Three registers of a triple.
#[inline(always)]
pub(super) fn load<L: Lanes>(lanes: L, triple: &Triple, at: usize) -> Vectors<L::Real> {
    Vectors::load(lanes, from(triple, at))
}

/// Rays that are followed together.
#[derive(Clone)]
pub(super) struct Bundle {
    pub(super) count: usize,
    pub(super) origin: Triple,
    pub(super) direction: Triple,
    /// How much of what they see is in the pixel.
    pub(super) share: Triple,
    /// The place of that pixel in the tile.
    pub(super) pixel: [u16; ROOM],
    pub(super) t: Column,
    /// The items that they leave the outside of; -1 where they do not.
    pub(super) outside: Column,
    /// -1 where they meet nothing.
    pub(super) item: Column,
    pub(super) part: Column,
}

impl Bundle {
    pub(super) const fn new() -> Self {
        const NONE: Triple = [[0.0; ROOM]; 3];
        Self {
            count: 0,
            origin: NONE,
            direction: NONE,
            share: NONE,
            pixel: [0; ROOM],
            t: NONE[0],
            outside: NONE[0],
            item: NONE[0],
            part: NONE[0],
        }
    }

    /// Fills the last register with copies of the last ray, so that nothing strange
    /// is in it.
    pub(super) fn pad(&mut self) {
        let Some(last) = self.count.checked_sub(1) else { return };
        let columns = self.origin.iter_mut().chain(&mut self.direction).chain(&mut self.share);
        for column in
            columns.chain([&mut self.t, &mut self.outside, &mut self.item, &mut self.part])
        {
            let value = column[last];
            column[last + 1..last + MOST].fill(value);
        }
    }

    /// Becomes the rays of another bundle that are listed.
    pub(super) fn gather(&mut self, other: &Self, which: &[u16]) {
        let copy = |to: &mut Column, from: &Column| {
            for (to, &k) in to.iter_mut().zip(which) {
                *to = from[usize::from(k)];
            }
        };
        for axis in 0..3 {
            copy(&mut self.origin[axis], &other.origin[axis]);
            copy(&mut self.direction[axis], &other.direction[axis]);
            copy(&mut self.share[axis], &other.share[axis]);
        }
        copy(&mut self.t, &other.t);
        copy(&mut self.item, &other.item);
        copy(&mut self.part, &other.part);
        for (to, &k) in self.pixel.iter_mut().zip(which) {
            *to = other.pixel[usize::from(k)];
        }
        self.count = which.len();
        self.pad();
    }

    pub(super) fn ray(&self, k: usize) -> Ray {
        let vector = |triple: &Triple| Vector::new(triple[0][k], triple[1][k], triple[2][k]);
        Ray::new(vector(&self.origin).into(), vector(&self.direction))
    }

    pub(super) fn share(&self, k: usize) -> [f64; 3] {
        [self.share[0][k], self.share[1][k], self.share[2][k]]
    }

    /// What a ray met that met something.
    pub(super) fn hit(&self, k: usize) -> Hit {
        Hit { t: self.t[k], item: self.item[k] as u32, part: self.part[k] as u32 }
    }
}

/// What rays of a bundle see where they meet one item.
#[derive(Clone)]
pub(super) struct Sights {
    pub(super) point: Triple,
    pub(super) error: Column,
    /// The normals on the side that is seen.
    pub(super) facet: Triple,
    /// Where those to shade with are others, these.
    pub(super) is_smooth: bool,
    pub(super) shading: Triple,
    pub(super) albedo: Triple,
    /// The share of the matte part in the pixel, by colour.
    pub(super) matte: Triple,
    /// Whether one of them is above 0 everywhere.
    pub(super) all_matter: bool,
    /// The light that falls on it.
    pub(super) light: Triple,
    /// Whether that is the same for all colours, and only the first is kept.
    pub(super) is_grey: bool,
}

impl Sights {
    pub(super) const fn new() -> Self {
        const NONE: Triple = [[0.0; ROOM]; 3];
        Self {
            point: NONE,
            error: NONE[0],
            facet: NONE,
            is_smooth: false,
            shading: NONE,
            albedo: NONE,
            matte: NONE,
            all_matter: false,
            light: NONE,
            is_grey: true,
        }
    }
}

/// All that a tile needs, kept by each thread from tile to tile.
pub(super) struct Buffers {
    // Boxed, to be swapped.
    pub(super) rays: Box<Bundle>,
    pub(super) next: Box<Bundle>,
    /// Those that met the same item.
    pub(super) group: Box<Bundle>,
    pub(super) sights: Sights,
    pub(super) radiance: Triple,
    /// The rays in the order of what they met.
    pub(super) order: [u16; ROOM],
    /// What they met, and how many of them.
    pub(super) items: Vec<(f64, u16)>,
    pub(super) slots: [u16; ROOM],
}

impl Buffers {
    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            rays: Box::new(Bundle::new()),
            next: Box::new(Bundle::new()),
            group: Box::new(Bundle::new()),
            sights: Sights::new(),
            radiance: [[0.0; ROOM]; 3],
            order: [0; ROOM],
            items: Vec::with_capacity(MOST_RAYS),
            slots: [0; ROOM],
        })
    }

    /// What there is to sort where all rays met the same.
    pub(super) fn all_alike(&mut self) {
        self.items.clear();
        self.items.push((self.rays.item[0], self.rays.count as u16));
    }

    /// Sorts the rays by what they met, in the order in which it is first met.
    pub(super) fn sort(&mut self) {
        self.items.clear();
        let mut last = 0;
        for (&item, slot) in self.rays.item[..self.rays.count].iter().zip(&mut self.slots) {
            if self.items.get(last).is_none_or(|(known, _)| *known != item) {
                last = match self.items.iter().position(|(known, _)| *known == item) {
                    Some(at) => at,
                    None => {
                        self.items.push((item, 0));
                        self.items.len() - 1
                    }
                };
            }
            self.items[last].1 += 1;
            *slot = last as u16;
        }
        if self.items.len() == 1 {
            return;
        }
        let mut next = [0_u16; MOST_RAYS];
        let mut begin = 0;
        for (next, (_, count)) in next.iter_mut().zip(&self.items) {
            *next = begin;
            begin += count;
        }
        for (k, &slot) in (0..).zip(&self.slots[..self.rays.count]) {
            let at = &mut next[usize::from(slot)];
            self.order[usize::from(*at)] = k;
            *at += 1;
        }
    }
}
