//! The three things to ask about a ray: the nearest hit, whether there is any,
//! and all of them.

use super::Which;
use super::balls::{Block, Names};
use super::walk::Quest;
use crate::Hit;
use crate::lanes::{Lanes, lanes_of};
use crate::primitive::Primitive;
use lancer_math::Ray;

/// The nearest hit; of those at the very same distance that of the first item.
pub(super) struct Nearest {
    t_max: f64,
    to: f64,
    pub(super) best: Option<Hit>,
}

impl Nearest {
    #[inline(always)]
    pub(super) const fn new(t_max: f64) -> Self {
        Self { t_max, to: t_max, best: None }
    }

    #[inline(always)]
    fn consider(&mut self, hit: Hit) {
        if self.best.is_none_or(
            #[inline(always)]
            |best| (hit.t, hit.item) < (best.t, best.item),
        ) {
            // Another one at the same distance is to be looked at, too.
            self.to = hit.t.next_up().min(self.t_max);
            self.best = Some(hit);
        }
    }
}

impl Quest for Nearest {
    #[inline(always)]
    fn which(&self) -> Which {
        Which::All
    }

    #[inline(always)]
    fn from(&self) -> f64 {
        0.0
    }

    #[inline(always)]
    fn to(&self) -> f64 {
        self.to
    }

    #[inline(always)]
    fn meet(&mut self, primitive: &dyn Primitive, ray: &Ray, item: u32) {
        if let Some(crossing) = primitive.nearest(ray, self.to) {
            self.consider(Hit { t: crossing.t, item, part: crossing.part });
        }
    }

    #[inline(always)]
    fn meet_block<L: Lanes>(
        &mut self,
        _lanes: L,
        block: &Block,
        names: &Names,
        ray: &Ray,
        first: u32,
    ) {
        for lane in lanes_of(u32::from(names.filled)) {
            if let Some(crossing) = block.ball(lane).nearest(ray, self.to) {
                self.consider(Hit { t: crossing.t, item: first + names.shapes[lane], part: 0 });
            }
        }
    }
}

/// Whether there is a hit.
pub(super) struct Any {
    which: Which,
    t_max: f64,
    pub(super) found: bool,
}

impl Any {
    #[inline(always)]
    pub(super) const fn new(t_max: f64, which: Which) -> Self {
        Self { which, t_max, found: false }
    }
}

impl Quest for Any {
    #[inline(always)]
    fn which(&self) -> Which {
        self.which
    }

    #[inline(always)]
    fn from(&self) -> f64 {
        0.0
    }

    #[inline(always)]
    fn to(&self) -> f64 {
        // Once there is one, nothing is near enough any more.
        if self.found { f64::NEG_INFINITY } else { self.t_max }
    }

    #[inline(always)]
    fn meet(&mut self, primitive: &dyn Primitive, ray: &Ray, _item: u32) {
        self.found = self.found || primitive.nearest(ray, self.t_max).is_some();
    }

    #[inline(always)]
    fn meet_block<L: Lanes>(
        &mut self,
        _lanes: L,
        block: &Block,
        names: &Names,
        ray: &Ray,
        _first: u32,
    ) {
        for lane in lanes_of(u32::from(names.lanes(self.which))) {
            self.found = self.found || block.ball(lane).nearest(ray, self.t_max).is_some();
        }
    }
}

/// All hits on a stretch, in no order.
pub(super) struct All<'h> {
    which: Which,
    from: f64,
    t_max: f64,
    hits: &'h mut Vec<Hit>,
}

impl<'h> All<'h> {
    pub(super) fn new((from, t_max): (f64, f64), which: Which, hits: &'h mut Vec<Hit>) -> Self {
        Self { which, from, t_max, hits }
    }
}

impl Quest for All<'_> {
    #[inline(always)]
    fn which(&self) -> Which {
        self.which
    }

    #[inline(always)]
    fn from(&self) -> f64 {
        self.from
    }

    #[inline(always)]
    fn to(&self) -> f64 {
        self.t_max
    }

    #[inline(always)]
    fn meet(&mut self, primitive: &dyn Primitive, ray: &Ray, item: u32) {
        primitive.each(ray, self.from, self.t_max, &mut |crossing| {
            self.hits.push(Hit { t: crossing.t, item, part: crossing.part });
        });
    }

    #[inline(always)]
    fn meet_block<L: Lanes>(
        &mut self,
        _lanes: L,
        block: &Block,
        names: &Names,
        ray: &Ray,
        first: u32,
    ) {
        for lane in lanes_of(u32::from(names.lanes(self.which))) {
            self.meet(&block.ball(lane), ray, first + names.shapes[lane]);
        }
    }
}
