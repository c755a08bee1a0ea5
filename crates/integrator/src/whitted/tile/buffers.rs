//! What a batch's rays carry.

use crate::rows::{BATCH, Row, Triples, ZEROS};
use lancer_kernel::lanes::MOST;
use lancer_kernel::{Candidates, Hit};
use lancer_math::{Ray, Vector};

/// Rays that are followed together.
#[derive(Clone)]
pub(super) struct Bundle {
    pub(super) count: usize,
    pub(super) origin: Triples,
    pub(super) direction: Triples,
    /// How much of what they see is in the pixel.
    pub(super) share: Triples,
    /// The number of that pixel, or sample, in the batch.
    pub(super) pixel: [u16; BATCH + MOST],
    pub(super) t: Row,
    /// The items that they leave the outside of; -1 where they do not.
    pub(super) outside: Row,
    /// -1 where they meet nothing.
    pub(super) item: Row,
    pub(super) part: Row,
}

impl Bundle {
    pub(super) const fn new() -> Self {
        Self {
            count: 0,
            origin: Triples::ZEROS,
            direction: Triples::ZEROS,
            share: Triples::ZEROS,
            pixel: [0; BATCH + MOST],
            t: ZEROS,
            outside: ZEROS,
            item: ZEROS,
            part: ZEROS,
        }
    }

    /// Fills the last register with copies of the last ray, so that nothing strange
    /// is in it.
    pub(super) fn pad(&mut self) {
        let Some(last) = self.count.checked_sub(1) else { return };
        let triples = [&mut self.origin, &mut self.direction, &mut self.share];
        let columns = triples.into_iter().flat_map(|triples| &mut triples.0);
        let others = [&mut self.t, &mut self.outside, &mut self.item, &mut self.part];
        for column in columns.chain(others) {
            let value = column[last];
            column[last + 1..last + MOST].fill(value);
        }
    }

    /// Becomes the rays of another bundle that are listed.
    pub(super) fn gather(&mut self, other: &Self, which: &[u16]) {
        let copy = |to: &mut Row, from: &Row| {
            for (to, &k) in to.iter_mut().zip(which) {
                *to = from[usize::from(k)];
            }
        };
        for axis in 0..3 {
            copy(&mut self.origin.0[axis], &other.origin.0[axis]);
            copy(&mut self.direction.0[axis], &other.direction.0[axis]);
            copy(&mut self.share.0[axis], &other.share.0[axis]);
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
        let vector = |triple: &Triples| Vector::from(triple.0.each_ref().map(|row| row[k]));
        Ray::new(vector(&self.origin).into(), vector(&self.direction))
    }

    pub(super) fn share(&self, k: usize) -> [f64; 3] {
        self.share.0.each_ref().map(|row| row[k])
    }

    /// What a ray met that met something.
    pub(super) fn hit(&self, k: usize) -> Hit {
        Hit { t: self.t[k], item: self.item[k] as u32, part: self.part[k] as u32 }
    }
}

/// What rays of a bundle see where they meet one item.
#[derive(Clone)]
pub(super) struct Sights {
    pub(super) point: Triples,
    pub(super) error: Row,
    /// The normals on the side that is seen.
    pub(super) facet: Triples,
    /// Where those to shade with are others, these.
    pub(super) is_smooth: bool,
    pub(super) shading: Triples,
    pub(super) albedo: Triples,
    /// Where signatures are asked for, as [`Spot`](crate::whitted::signature::Spot) has them.
    pub(super) lit: Row,
    pub(super) piece: Signatures,
}

/// A hash for each ray.
pub(super) type Signatures = [u64; BATCH + MOST];

impl Sights {
    pub(super) const fn new() -> Self {
        Self {
            point: Triples::ZEROS,
            error: ZEROS,
            facet: Triples::ZEROS,
            is_smooth: false,
            shading: Triples::ZEROS,
            albedo: Triples::ZEROS,
            lit: ZEROS,
            piece: [0; BATCH + MOST],
        }
    }
}

/// What may hide a light from a batch of points.
pub(super) struct Hiding {
    pub(super) among: Candidates,
    /// The item that all leave the outside of, if it is one.
    pub(super) outside: Option<u32>,
    /// Whether nothing opaque does.
    pub(super) is_clear: bool,
}

/// All that a batch needs, kept by each thread from one to the next.
pub(super) struct Buffers {
    // Boxed, to be swapped.
    pub(super) rays: Box<Bundle>,
    pub(super) next: Box<Bundle>,
    /// Those that met the same item.
    pub(super) group: Box<Bundle>,
    pub(super) sights: Sights,
    /// What may stand between those and each light.
    pub(super) hiding: Vec<Hiding>,
    pub(super) radiance: Triples,
    pub(super) signatures: Signatures,
    /// The rays in the order of what they met.
    pub(super) order: [u16; BATCH + MOST],
    /// What they met, and how many of them.
    pub(super) items: Vec<(f64, u16)>,
    pub(super) slots: [u16; BATCH + MOST],
}

impl Buffers {
    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            rays: Box::new(Bundle::new()),
            next: Box::new(Bundle::new()),
            group: Box::new(Bundle::new()),
            sights: Sights::new(),
            hiding: Vec::new(),
            radiance: Triples::ZEROS,
            signatures: [0; BATCH + MOST],
            order: [0; BATCH + MOST],
            items: Vec::with_capacity(BATCH),
            slots: [0; BATCH + MOST],
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
        let mut next = [0_u16; BATCH];
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
