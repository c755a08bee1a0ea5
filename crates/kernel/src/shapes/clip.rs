//! A ray's line cut down to what is inside of convex shapes.
//!
//! Entry and exit are two ends of one interval, so they exist together, also
//! where the line goes through an edge or a corner. Where the ends come from
//! planes, each is a quotient; if two have the same rounded value they are
//! compared exactly, so for numbers small enough that numerator and denominator
//! are exact the decision is that of rational arithmetic. An interval of one
//! point (touching) counts.

use super::exact::compare_products;
use crate::crossing::Crossings;
use crate::hierarchy::stretch_in;
use lancer_math::{Bounds, Ray};

/// Where a line goes through a plane: t and the quotient that it is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cut {
    t: f64,
    numerator: f64,
    denominator: f64,
    part: u32,
}

impl Cut {
    #[inline]
    pub(crate) fn new(numerator: f64, denominator: f64, part: u32) -> Self {
        Self { t: numerator / denominator, numerator, denominator, part }
    }

    /// Not for NaN.
    #[inline]
    fn is_after(&self, other: &Self) -> bool {
        if self.t != other.t {
            return self.t > other.t;
        }
        let (a, b) = (self, other);
        let sign = compare_products(a.numerator, b.denominator, b.numerator, a.denominator);
        if (a.denominator > 0.0) == (b.denominator > 0.0) { sign > 0.0 } else { sign < 0.0 }
    }
}

/// The part of a line that is inside.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretch {
    from: Cut,
    to: Cut,
}

impl Stretch {
    /// All of the ray's line; `None` where a number of it is NaN.
    #[inline]
    pub(crate) fn of(ray: &Ray) -> Option<Self> {
        let sum = ray.origin.coords.sum() + ray.direction.sum();
        (!sum.is_nan()).then_some(Self {
            from: Cut { t: f64::NEG_INFINITY, numerator: -1.0, denominator: 0.0, part: 0 },
            to: Cut { t: f64::INFINITY, numerator: 1.0, denominator: 0.0, part: 0 },
        })
    }

    /// Leaves out what is before `cut`.
    #[inline]
    pub(crate) fn enter(&mut self, cut: Cut) {
        if cut.is_after(&self.from) {
            self.from = cut;
        }
    }

    /// Leaves out what is after `cut`.
    #[inline]
    pub(crate) fn leave(&mut self, cut: Cut) {
        if self.to.is_after(&cut) {
            self.to = cut;
        }
    }

    /// Its two ends, if anything is left.
    #[inline]
    pub(crate) fn ends(&self) -> Crossings {
        self.ends_by(Some)
    }

    /// Those in the box of the shape, which are no others but for roundings.
    #[inline]
    pub(crate) fn ends_in(&self, bounds: &Bounds, ray: &Ray) -> Crossings {
        self.ends_by(|ends| kept_in(bounds, ray, ends))
    }

    #[inline]
    fn ends_by(&self, kept: impl FnOnce([f64; 2]) -> Option<[f64; 2]>) -> Crossings {
        let mut crossings = Crossings::NONE;
        let finite = self.from.t > f64::NEG_INFINITY && self.to.t < f64::INFINITY;
        if finite
            && !self.from.is_after(&self.to)
            && let Some([from, to]) = kept([self.from.t, self.to.t])
        {
            crossings.add(from, self.from.part);
            crossings.add(to, self.to.part);
        }
        crossings
    }
}

/// The part of a stretch of a ray that is in the box of the convex shape which it is the
/// inside of; `None` where that has none, as past a sharp corner.
///
/// Both contain what is exactly inside, so no more is lost than a stretch which is shorter
/// than its roundings, and the ends come nearer to where they are. Without this, ends may be
/// outside of the box by any number of roundings, where two surfaces meet at a small
/// angle, and then be found or not, as other boxes are around that one.
#[inline]
pub(crate) fn kept_in(bounds: &Bounds, ray: &Ray, [from, to]: [f64; 2]) -> Option<[f64; 2]> {
    let inverse = ray.direction.map(|c| 1.0 / c);
    stretch_in(bounds, ray, &inverse, 0.0, (from, to)).map(|(from, to)| [from, to])
}
