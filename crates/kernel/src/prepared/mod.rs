mod absent;
mod balls;
mod batch;
mod build;
mod in_lanes;
mod items;
mod looks;
mod planes;
mod quests;
mod space;
mod walk;

pub use absent::Absent;
pub use in_lanes::is_met_in_lanes;

use crate::lanes::{Lanes, Work, dispatch};
use crate::listed::Listed;
use crate::{Hit, KernelSettings, LEAN, not_lean};
use lancer_math::Ray;
use lancer_scene::Scene;
use looks::Look;
use quests::{All, Any, Nearest};
use space::Space;
use walk::{Known, Place, Quest, Walk, with_stacks};

/// The shapes of a scene, made ready to be met by rays. It does not change any
/// more and may be asked from any thread.
///
/// What a group holds is prepared once and shared by all places where it stands,
/// groups in groups too, so memory grows with what is described and not with what
/// is shown. Each place of a shape is an *item* with a number: first the
/// shapes that stand by themselves, then those of groups, each group's own before
/// those of groups inside it. Of items that a ray meets at the very same distance
/// the first is the one that is met.
#[derive(Debug)]
pub struct Prepared {
    root: Space,
    spaces: Vec<Space>,
    looks: Vec<Look>,
    /// Of the scene's own shapes those that whole registers of rays are held against.
    listed: Listed,
    listed_kinds: Known,
    bytes: usize,
    settings: KernelSettings,
}

/// Which items a ray is held against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Which {
    /// Every one.
    All,
    /// Those that let no light through.
    Opaque,
    /// Those that let light through.
    Transparent,
}

impl Which {
    #[inline(always)]
    const fn has(self, is_transparent: bool) -> bool {
        match self {
            Self::All => true,
            Self::Opaque => !is_transparent,
            Self::Transparent => is_transparent,
        }
    }
}

impl Prepared {
    /// Makes the shapes of `scene` ready, for rays to be followed as fast as can be.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        Self::with(scene, &KernelSettings::default())
    }

    /// Makes the shapes of `scene` ready, for rays to be followed as `settings`
    /// say.
    #[must_use]
    pub fn with(scene: &Scene, settings: &KernelSettings) -> Self {
        Self::without(scene, settings, &Absent::NONE)
    }

    /// The same but for some shapes, which no ray will reach.
    #[must_use]
    pub fn without(scene: &Scene, settings: &KernelSettings, absent: &Absent) -> Self {
        let build::Built { root, spaces, looks, bytes } = build::build(scene, settings, absent);
        let (listed, listed_kinds) = in_lanes::listed(&scene.shapes, absent);
        if root.holds.transparent || !in_lanes::is_all(&root, listed_kinds) {
            not_lean();
        }
        Self { root, spaces, looks, listed, listed_kinds, bytes, settings: *settings }
    }

    /// About how much memory it takes, apart from the positions and normals of meshes,
    /// which it shares with the scene.
    #[must_use]
    pub const fn bytes(&self) -> usize {
        self.bytes
    }

    /// Whether any of them lets light through.
    #[must_use]
    pub const fn has_transparent(&self) -> bool {
        !LEAN && self.root.holds.transparent
    }

    /// The error of the points of the item whose points are least certain, but
    /// for what a point far from it adds where it has no end: from the sizes of
    /// coordinates, in its own space and in the world.
    #[must_use]
    pub fn coarsest(&self) -> f64 {
        self.root.size.coarsest()
    }

    /// The nearest hit with 0 < t < `t_max`.
    #[must_use]
    pub fn nearest(&self, ray: &Ray, t_max: f64) -> Option<Hit> {
        self.ask(ray, Nearest::new(t_max), Known::NONE).best
    }

    /// Whether there is a hit with 0 < t < `t_max` among some items.
    #[must_use]
    pub fn any(&self, ray: &Ray, t_max: f64, which: Which) -> bool {
        self.root.holds.any(which) && self.ask(ray, Any::new(t_max, which), Known::NONE).found
    }

    /// All hits with `from` < t < `to` among some items, nearest first; those at
    /// the very same t in the order of the items.
    #[must_use]
    pub fn all(&self, ray: &Ray, stretch: (f64, f64), which: Which) -> Vec<Hit> {
        let mut hits = Vec::new();
        self.ask(ray, All::new(stretch, which, &mut hits), Known::NONE);
        hits.sort_by(|a, b| a.t.total_cmp(&b.t).then((a.item, a.part).cmp(&(b.item, b.part))));
        hits
    }

    /// Of the scene's own shapes those that are known already are left out.
    fn ask<Q: Quest>(&self, ray: &Ray, quest: Q, known: Known) -> Q {
        dispatch(self.settings.lanes, Question { prepared: self, ray, quest, known })
    }
}

/// One quest for one ray.
struct Question<'a, Q> {
    prepared: &'a Prepared,
    ray: &'a Ray,
    quest: Q,
    known: Known,
}

impl<Q: Quest> Work for Question<'_, Q> {
    type Output = Q;

    #[inline(always)]
    fn run<L: Lanes>(mut self, lanes: L) -> Q {
        let walk = Walk::new(self.prepared, self.ray);
        let root = &self.prepared.root;
        with_stacks(
            root.depth + 1,
            #[inline(always)]
            |stacks| walk.go(lanes, stacks, &Place::world(root), self.known, &mut self.quest),
        );
        self.quest
    }
}
