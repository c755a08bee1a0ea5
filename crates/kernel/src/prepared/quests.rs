//! The three things to ask about a ray: the nearest hit, whether there is any,
//! and all of them.

use super::Which;
use super::balls::Name;
use super::planes::Planes;
use super::walk::Quest;
use crate::Hit;
use crate::hierarchy::Stack;
use crate::lanes::{Lanes, MOST, Mask, Real, lanes_of};
use crate::primitive::Primitive;
use crate::rays::{Rays, Tame};
use crate::shapes::mesh::Facets;
use crate::shapes::sphere::Balls;
use lancer_math::Ray;

/// Where spheres are crossed first ahead and before `to`, and in which lanes.
#[inline(always)]
fn first_ahead<L: Lanes>(
    balls: &Balls<L::Real>,
    count: usize,
    (rays, tame): (&Rays<L>, &Tame<L::Real>),
    to: f64,
) -> Option<(L::Real, L::Mask)> {
    let lanes = rays.lanes;
    let may = balls.may_meet(rays, tame) & lanes.first(count);
    if !may.any() {
        return None;
    }
    let zero = lanes.splat(0.0);
    let t = balls.crossings(rays, tame).ahead(zero);
    Some((t, may & t.gt(zero) & t.lt(lanes.splat(to))))
}

/// Where planes are crossed ahead, and in which lanes.
#[inline(always)]
fn ahead<L: Lanes>(planes: &Planes, from: usize, rays: &Rays<L>) -> (L::Real, L::Mask) {
    let (ahead, slope) = planes.slopes(rays, from);
    let t = ahead / slope;
    (t, t.gt(rays.lanes.splat(0.0)) & t.lt(rays.lanes.splat(f64::INFINITY)))
}

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

    /// Where one is known already.
    #[inline(always)]
    pub(super) fn beyond(t_max: f64, known: Option<Hit>) -> Self {
        let mut this = Self::new(t_max);
        if let Some(hit) = known {
            this.consider(hit);
        }
        this
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

    #[inline(always)]
    fn lanes<R: Real>(&mut self, t: R, met: R::Mask, item: impl Fn(usize) -> u32) {
        let bits = met.bits();
        if bits == 0 {
            return;
        }
        let mut at = [0.0; MOST];
        t.store(&mut at);
        for lane in lanes_of(bits) {
            self.consider(Hit { t: at[lane & (MOST - 1)], item: item(lane), part: 0 });
        }
    }
}

impl Quest for Nearest {
    const NEAREST_FIRST: bool = true;

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
    fn is_done(&self) -> bool {
        false
    }

    #[inline(always)]
    fn primitive(&mut self, primitive: &dyn Primitive, ray: &Ray, item: u32) {
        if let Some(crossing) = primitive.nearest(ray, self.to) {
            self.consider(Hit { t: crossing.t, item, part: crossing.part });
        }
    }

    #[inline(always)]
    fn mesh<L: Lanes>(&mut self, lanes: L, stack: &mut Stack, mesh: &Facets, ray: &Ray, item: u32) {
        if let Some(crossing) = mesh.nearest_of(lanes, stack, ray, self.to) {
            self.consider(Hit { t: crossing.t, item, part: crossing.part });
        }
    }

    #[inline(always)]
    fn spheres<L: Lanes>(
        &mut self,
        balls: &Balls<L::Real>,
        names: &[Name],
        rays: (&Rays<L>, &Tame<L::Real>),
        first_item: u32,
    ) {
        if let Some((t, met)) = first_ahead(balls, names.len(), rays, self.to) {
            self.lanes(t, met, |lane| first_item + names[lane].shape());
        }
    }

    #[inline(always)]
    fn planes<L: Lanes>(&mut self, planes: &Planes, from: usize, rays: &Rays<L>, first: u32) {
        let (t, met) = ahead(planes, from, rays);
        let met = met & t.lt(rays.lanes.splat(self.to));
        self.lanes(t, met, |lane| first + planes.shapes[(from + lane) & (MOST - 1)]);
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

    #[inline(always)]
    fn lanes(&mut self, bits: u32, is_transparent: impl Fn(usize) -> bool) {
        for lane in lanes_of(bits) {
            self.found = self.found || self.which.has(is_transparent(lane));
        }
    }
}

impl Quest for Any {
    const NEAREST_FIRST: bool = false;

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
        self.t_max
    }

    #[inline(always)]
    fn is_done(&self) -> bool {
        self.found
    }

    #[inline(always)]
    fn primitive(&mut self, primitive: &dyn Primitive, ray: &Ray, _item: u32) {
        self.found = self.found || primitive.any(ray, self.t_max);
    }

    #[inline(always)]
    fn mesh<L: Lanes>(
        &mut self,
        lanes: L,
        stack: &mut Stack,
        mesh: &Facets,
        ray: &Ray,
        _item: u32,
    ) {
        self.found = self.found || mesh.any_of(lanes, stack, ray, self.t_max);
    }

    #[inline(always)]
    fn spheres<L: Lanes>(
        &mut self,
        balls: &Balls<L::Real>,
        names: &[Name],
        rays: (&Rays<L>, &Tame<L::Real>),
        _first: u32,
    ) {
        if let Some((_, met)) = first_ahead(balls, names.len(), rays, self.t_max) {
            self.lanes(met.bits(), |lane| names[lane].is_transparent());
        }
    }

    #[inline(always)]
    fn planes<L: Lanes>(&mut self, planes: &Planes, from: usize, rays: &Rays<L>, _first: u32) {
        let (t, met) = ahead(planes, from, rays);
        let met = met & t.lt(rays.lanes.splat(self.t_max));
        self.lanes(met.bits(), |lane| planes.transparent >> (from + lane) & 1 != 0);
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

    #[inline(always)]
    fn consider(&mut self, t: f64, item: u32) {
        if t > self.from && t < self.t_max && t.is_finite() {
            self.hits.push(Hit { t, item, part: 0 });
        }
    }
}

impl Quest for All<'_> {
    const NEAREST_FIRST: bool = false;

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
    fn is_done(&self) -> bool {
        false
    }

    #[inline(always)]
    fn primitive(&mut self, primitive: &dyn Primitive, ray: &Ray, item: u32) {
        primitive.each(ray, self.from, self.t_max, &mut |crossing| {
            self.hits.push(Hit { t: crossing.t, item, part: crossing.part });
        });
    }

    #[inline(always)]
    fn mesh<L: Lanes>(
        &mut self,
        _lanes: L,
        _stack: &mut Stack,
        mesh: &Facets,
        ray: &Ray,
        item: u32,
    ) {
        self.primitive(mesh, ray, item);
    }

    #[inline(always)]
    fn spheres<L: Lanes>(
        &mut self,
        balls: &Balls<L::Real>,
        names: &[Name],
        (rays, tame): (&Rays<L>, &Tame<L::Real>),
        first_item: u32,
    ) {
        let may = balls.may_meet_line(rays, tame) & rays.lanes.first(names.len());
        let pairs = balls.crossings(rays, tame);
        for lane in lanes_of(may.bits()) {
            if self.which.has(names[lane].is_transparent()) {
                let item = first_item + names[lane].shape();
                self.consider(pairs.near.lane(lane), item);
                self.consider(pairs.far.lane(lane), item);
            }
        }
    }

    #[inline(always)]
    fn planes<L: Lanes>(&mut self, planes: &Planes, from: usize, rays: &Rays<L>, first: u32) {
        let (ahead, slope) = planes.slopes(rays, from);
        let t = ahead / slope;
        for lane in 0..L::WIDTH {
            let at = (from + lane) & (MOST - 1);
            if self.which.has(planes.transparent >> at & 1 != 0) {
                self.consider(t.lane(lane), first + planes.shapes[at]);
            }
        }
    }
}
