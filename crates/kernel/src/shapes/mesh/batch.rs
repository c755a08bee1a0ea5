//! Many rays at once: the processor's instructions are chosen once, and rays that
//! come in no order are followed in a better one.

use super::Facets;
use crate::Crossing;
use crate::hierarchy::{Stack, answer_each};
use crate::lanes::{Lanes, Work, dispatch};
use lancer_math::Ray;

/// Rays are sorted so many at a time.
const TOGETHER: usize = 1 << 20;

/// What takes less memory is near the processor in any order: rays of meshes of 4 MiB were
/// followed faster unsorted, those of one of 57 MiB far faster sorted (`cargo xtask bench
/// --triangles`, with this 0 and with `usize::MAX`).
/// The tests here have none so large, and sort all.
const NEAR: usize = if cfg!(test) { 0 } else { 1 << 24 };

/// What is asked of each ray.
trait Query {
    type Answer: Copy;

    fn answer<L: Lanes>(
        facets: &Facets,
        lanes: L,
        stack: &mut Stack,
        ray: &Ray,
        t_max: f64,
    ) -> Self::Answer;
}

struct Nearest;
struct Any;

impl Query for Nearest {
    type Answer = Option<Crossing>;

    #[inline(always)]
    fn answer<L: Lanes>(
        facets: &Facets,
        lanes: L,
        stack: &mut Stack,
        ray: &Ray,
        t_max: f64,
    ) -> Option<Crossing> {
        facets.nearest_of(lanes, stack, ray, t_max)
    }
}

impl Query for Any {
    type Answer = bool;

    #[inline(always)]
    fn answer<L: Lanes>(
        facets: &Facets,
        lanes: L,
        stack: &mut Stack,
        ray: &Ray,
        t_max: f64,
    ) -> bool {
        facets.any_of(lanes, stack, ray, t_max)
    }
}

struct Batch<'a, Q: Query> {
    facets: &'a Facets,
    rays: &'a [Ray],
    t_max: f64,
    order: Option<&'a [u32]>,
    answers: &'a mut [Q::Answer],
}

impl<Q: Query> Work for Batch<'_, Q> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { facets, rays, t_max, order, answers } = self;
        let mut stack = Stack::new();
        answer_each(
            order,
            rays,
            answers,
            #[inline(always)]
            |ray| Q::answer(facets, lanes, &mut stack, ray, t_max),
        );
    }
}

impl Facets {
    pub(super) fn nearest_each_of(
        &self,
        rays: &[Ray],
        t_max: f64,
        answers: &mut [Option<Crossing>],
    ) {
        self.ask::<Nearest>(rays, t_max, answers);
    }

    pub(super) fn any_each_of(&self, rays: &[Ray], t_max: f64, answers: &mut [bool]) {
        self.ask::<Any>(rays, t_max, answers);
    }

    fn ask<Q: Query>(&self, rays: &[Ray], t_max: f64, answers: &mut [Q::Answer]) {
        for (rays, answers) in rays.chunks(TOGETHER).zip(answers.chunks_mut(TOGETHER)) {
            let is_sorted = self.settings.culling.sorted_rays && self.bytes() > NEAR;
            let order = if is_sorted { self.hierarchy.order_of(rays) } else { None };
            let order = order.as_deref();
            let batch = Batch::<'_, Q> { facets: self, rays, t_max, order, answers };
            dispatch(self.settings.lanes, batch);
        }
    }
}
