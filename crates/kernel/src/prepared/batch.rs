//! Many rays at once: the processor's instructions are chosen once for all of them,
//! and rays that come in no order are followed in a better one.

use super::quests::{Any, Nearest};
use super::space::Kind;
use super::walk::{Known, Place, Quest, Walk, with_stacks};
use super::{Prepared, Which};
use crate::Hit;
use crate::hierarchy::{Stack, answer_each, order_in};
use crate::lanes::{Lanes, Work, dispatch};
use crate::primitive::Primitive;
use crate::shapes::mesh::Facets;
use lancer_math::Ray;

/// What takes less memory is near the processor anyway.
const NEAR: usize = 1 << 19;

impl Prepared {
    /// The nearest hit of each ray with 0 < t < `t_max`, as [`nearest`](Self::nearest)
    /// finds it, in the same order. Large batches are faster.
    ///
    /// # Panics
    /// Where there are not as many places for hits as rays.
    pub fn nearest_each(&self, rays: &[Ray], t_max: f64, hits: &mut [Option<Hit>]) {
        assert_eq!(rays.len(), hits.len(), "rays and places for their hits");
        if let Some(mesh) = self.only_mesh() {
            let mut crossings = vec![None; rays.len()];
            mesh.nearest_each(rays, t_max, &mut crossings);
            for (hit, crossing) in hits.iter_mut().zip(crossings) {
                *hit = crossing.map(|met| Hit { t: met.t, item: 0, part: met.part });
            }
            return;
        }
        self.ask_each(rays, hits, || Nearest::new(t_max), |quest| quest.best);
    }

    /// Whether each ray has a hit with 0 < t < `t_max` among some items, as
    /// [`any`](Self::any) finds it, in the same order. Large batches are faster.
    ///
    /// # Panics
    /// Where there are not as many places for answers as rays.
    pub fn any_each(&self, rays: &[Ray], t_max: f64, which: Which, answers: &mut [bool]) {
        assert_eq!(rays.len(), answers.len(), "rays and places for their answers");
        if !self.root.holds.any(which) {
            answers.fill(false);
        } else if let Some(mesh) = self.only_mesh() {
            mesh.any_each(rays, t_max, answers);
        } else {
            self.ask_each(rays, answers, || Any::new(t_max, which), |quest| quest.found);
        }
    }

    /// The mesh that is all there is.
    fn only_mesh(&self) -> Option<&Facets> {
        let root = &self.root;
        match &root.others[..] {
            [other] if root.item_count == 1 => match &other.primitive {
                Kind::Mesh(mesh) => Some(mesh),
                Kind::Any(_) => None,
            },
            _ => None,
        }
    }

    fn ask_each<A, Q: Quest>(
        &self,
        rays: &[Ray],
        answers: &mut [A],
        quest: impl Fn() -> Q,
        answer: impl Fn(Q) -> A,
    ) {
        let is_far = self.settings.culling.sorted_rays && self.bytes() > NEAR;
        let order = if is_far { order_in(&self.root.around, rays) } else { None };
        let order = order.as_deref();
        dispatch(
            self.settings.lanes,
            Batch { prepared: self, rays, order, answers, quest, answer },
        );
    }
}

struct Batch<'a, A, N, F> {
    prepared: &'a Prepared,
    rays: &'a [Ray],
    order: Option<&'a [u32]>,
    answers: &'a mut [A],
    quest: N,
    answer: F,
}

impl<A, Q: Quest, N: Fn() -> Q, F: Fn(Q) -> A> Work for Batch<'_, A, N, F> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { prepared, rays, order, answers, quest, answer } = self;
        with_stacks(
            prepared.root.depth + 1,
            #[inline(always)]
            |stacks| {
                answer_each(
                    order,
                    rays,
                    answers,
                    #[inline(always)]
                    |ray| answer(asked(lanes, stacks, prepared, ray, quest())),
                );
            },
        );
    }
}

/// The quest, answered for one ray.
#[inline(always)]
fn asked<L: Lanes, Q: Quest>(
    lanes: L,
    stacks: &mut [Stack],
    prepared: &Prepared,
    ray: &Ray,
    mut quest: Q,
) -> Q {
    let root = Place::world(&prepared.root);
    Walk::new(prepared, ray).go(lanes, stacks, &root, Known::NONE, &mut quest);
    quest
}
