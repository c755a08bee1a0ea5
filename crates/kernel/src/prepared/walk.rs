//! A ray's way through a scene and the groups that stand in it.
//!
//! A ray is brought into a group's space by the product of all placements on the
//! way there, in one step from the world: so it is rounded there once, however deep
//! the group stands, and the same whichever boxes were looked at before. The box of a
//! placed group is held against the ray as it is in the space around, which is
//! rounded otherwise. So such boxes are made wider by what both roundings can
//! come to ([`Walk::margin`]); those of a group's own shapes are not, since there
//! shape and box are held against the very same ray.

use super::balls::{Name, Spheres};
use super::planes::Planes;
use super::space::{Content, Entry, Kind, Space, Stand};
use super::{Prepared, Which};
use crate::hierarchy::{Hierarchy, Stack};
use crate::lanes::{Lanes, MOST};
use crate::primitive::Primitive;
use crate::rays::{Rays, Tame};
use crate::shapes::mesh::Facets;
use crate::shapes::sphere::Balls;
use lancer_math::{Placement, Ray};
use std::cell::Cell;
use std::ops::{ControlFlow, Range};

/// What is asked about a ray.
pub(super) trait Quest {
    /// Whether what is near is to be looked at first.
    const NEAREST_FIRST: bool;

    /// Which shapes it is held against.
    fn which(&self) -> Which;

    /// From where on it is looked at.
    fn from(&self) -> f64;

    /// Up to where; less and less.
    fn to(&self) -> f64;

    /// Whether the answer is known.
    fn is_done(&self) -> bool;

    /// Looks at a shape, with the ray in its space.
    fn primitive(&mut self, primitive: &dyn Primitive, ray: &Ray, item: u32);

    /// Looks at a mesh.
    fn mesh<L: Lanes>(&mut self, lanes: L, stack: &mut Stack, mesh: &Facets, ray: &Ray, item: u32);

    /// Looks at as many spheres of a register as there are names; their items are
    /// numbered from `first` on.
    fn spheres<L: Lanes>(
        &mut self,
        balls: &Balls<L::Real>,
        names: &[Name],
        rays: (&Rays<L>, &Tame<L::Real>),
        first: u32,
    );

    /// Looks at the planes of a block from the lane `from` on.
    fn planes<L: Lanes>(&mut self, planes: &Planes, from: usize, rays: &Rays<L>, first: u32);
}

/// A space where it is met.
pub(super) struct Place<'a> {
    pub(super) space: &'a Space,
    /// To the world.
    pub(super) placement: Placement,
    /// Whether that leaves everything where it is.
    pub(super) is_world: bool,
    /// The number of its first item in the world.
    pub(super) first: u32,
    /// How many times as large a displacement can become on the way from the world.
    shrink: f64,
}

impl<'a> Place<'a> {
    /// The scene itself.
    #[inline(always)]
    pub(super) const fn world(space: &'a Space) -> Self {
        Self { space, placement: Placement::IDENTITY, is_world: true, first: 0, shrink: 1.0 }
    }

    /// Where a group stands in it.
    #[inline(always)]
    pub(super) fn inside(&self, stand: &Stand, spaces: &'a [Space]) -> Self {
        let placement =
            if self.is_world { stand.placement } else { stand.placement.then(&self.placement) };
        Self {
            space: &spaces[stand.space as usize],
            is_world: placement.is_identity(),
            placement,
            first: self.first + stand.first,
            shrink: self.shrink * stand.shrink,
        }
    }

    /// The ray of the world there.
    #[inline(always)]
    pub(super) fn local(&self, ray: &Ray) -> Ray {
        if self.is_world {
            return *ray;
        }
        let origin = self.placement.local_point(&ray.origin);
        Ray::new(origin, self.placement.local_vector(&ray.direction))
    }
}

/// Which of the scene's own shapes have been looked at already.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Known {
    pub(super) spheres: bool,
    pub(super) planes: bool,
}

impl Known {
    pub(super) const NONE: Self = Self { spheres: false, planes: false };
}

pub(super) struct Walk<'a> {
    spaces: &'a [Space],
    /// In the world.
    pub(super) ray: Ray,
    /// The coordinates between the origin and whatever a hit can be on, offsets
    /// included, are at most this.
    reach: f64,
}

impl<'a> Walk<'a> {
    #[inline(always)]
    pub(super) fn new(prepared: &'a Prepared, ray: &Ray) -> Self {
        let size = &prepared.root.size;
        let reach = ray.origin.coords.amax() + 2.0 * size.extent + size.offset;
        Self { spaces: &prepared.spaces, ray: *ray, reach }
    }

    /// How much wider, in that place, the boxes of groups are made.
    ///
    /// Bringing a point of the world in has at most four roundings of sums of three
    /// products for each of 64 placements (u is half of EPSILON, each at most 12 u
    /// of the coordinates times what a displacement can grow by): of the matrix
    /// multiplied, the offset, the point. So the ray in the space around is off by
    /// 1,000 u of `reach` times the growth from the world to there, and that in
    /// the group, brought back out, by as much times the growth on the way in and
    /// out again. The bound is four times as much, and still far less than what
    /// rounding boxes to single precision adds.
    #[inline(always)]
    pub(super) fn margin(&self, place: &Place<'_>) -> f64 {
        const UNIT: f64 = 2048.0 * f64::EPSILON;
        if place.space.placed.is_empty() {
            return 0.0;
        }
        UNIT * place.shrink * (1.0 + place.space.size.condition) * self.reach
    }

    /// Holds the ray against all that may matter to the quest. There are as many
    /// stacks as spaces are nested, and one more for meshes.
    #[inline(always)]
    pub(super) fn go<L: Lanes, Q: Quest>(
        &self,
        lanes: L,
        stacks: &mut [Stack],
        place: &Place<'_>,
        known: Known,
        quest: &mut Q,
    ) {
        let Some((stack, inner)) = stacks.split_first_mut() else { return };
        let space = place.space;
        let ray = place.local(&self.ray);
        let rays = Rays::splat(lanes, &ray);
        if !known.planes {
            for planes in &space.planes {
                for from in (0..MOST).step_by(L::WIDTH) {
                    quest.planes(planes, from, &rays, place.first);
                }
            }
        }
        for &entry in &space.unbounded {
            self.enter(lanes, inner, place, &ray, entry, quest);
        }
        let from = quest.from().min(0.0);
        let spheres = &space.spheres;
        let tame = rays.tame();
        let tamed = (&rays, &tame);
        if !known.spheres && spheres.holds.any(quest.which()) && !quest.is_done() {
            match spheres.hierarchy() {
                Some(hierarchy) => visit::<L, Q>(
                    hierarchy,
                    lanes,
                    stack,
                    &ray,
                    0.0,
                    (from, quest.to()),
                    #[inline(always)]
                    |places, _| {
                        leaf(spheres, &places, tamed, place.first, quest);
                        go_on(quest)
                    },
                ),
                None => {
                    for places in spheres.few() {
                        leaf(spheres, &places, tamed, place.first, quest);
                    }
                }
            }
        }
        if !space.bounded.is_empty() && !quest.is_done() {
            visit::<L, Q>(
                &space.hierarchy,
                lanes,
                stack,
                &ray,
                self.margin(place),
                (from, quest.to()),
                #[inline(always)]
                |places, _| {
                    for &entry in &space.bounded[places] {
                        self.enter(lanes, inner, place, &ray, entry, quest);
                    }
                    go_on(quest)
                },
            );
        }
    }

    /// Not inlined, as it is wanted twice; and no deeper in itself than groups may
    /// be nested.
    fn enter<L: Lanes, Q: Quest>(
        &self,
        lanes: L,
        stacks: &mut [Stack],
        place: &Place<'_>,
        ray: &Ray,
        entry: Entry,
        quest: &mut Q,
    ) {
        let which = quest.which();
        lanes.vectorize(
            #[inline(always)]
            || match entry.content() {
                Content::Other(index) => {
                    let other = &place.space.others[index];
                    if !other.is_asked(which) {
                        return;
                    }
                    let item = place.first + other.shape;
                    match &other.primitive {
                        Kind::Mesh(mesh) => quest.mesh(lanes, &mut stacks[0], mesh, ray, item),
                        Kind::Any(primitive) => quest.primitive(&**primitive, ray, item),
                    }
                }
                Content::Placed(index) => {
                    let stand = &place.space.placed[index];
                    if stand.holds.any(which) {
                        let inside = place.inside(stand, self.spaces);
                        self.go(lanes, stacks, &inside, Known::NONE, quest);
                    }
                }
            },
        );
    }
}

/// In the order that serves the quest.
#[inline(always)]
fn visit<L: Lanes, Q: Quest>(
    hierarchy: &Hierarchy,
    lanes: L,
    stack: &mut Stack,
    ray: &Ray,
    margin: f64,
    stretch: (f64, f64),
    meet: impl FnMut(Range<usize>, f64) -> ControlFlow<(), f64>,
) {
    if Q::NEAREST_FIRST {
        hierarchy.visit(lanes, stack, ray, margin, stretch, meet);
    } else {
        hierarchy.visit_any(lanes, stack, ray, margin, stretch, meet);
    }
}

/// The spheres of a leaf.
#[inline(always)]
fn leaf<L: Lanes, Q: Quest>(
    spheres: &Spheres,
    places: &Range<usize>,
    rays: (&Rays<L>, &Tame<L::Real>),
    first: u32,
    quest: &mut Q,
) {
    let names = &spheres.names[places.clone()];
    for from in (0..names.len()).step_by(L::WIDTH) {
        let balls = spheres.load(rays.0.lanes, places, from);
        quest.spheres(&balls, &names[from..], rays, first);
    }
}

#[inline(always)]
fn go_on<Q: Quest>(quest: &Q) -> ControlFlow<(), f64> {
    if quest.is_done() { ControlFlow::Break(()) } else { ControlFlow::Continue(quest.to()) }
}

thread_local! {
    /// Kept from one question to the next.
    static STACKS: Cell<Vec<Stack>> = const { Cell::new(Vec::new()) };
}

/// Runs `work` with at least so many stacks.
#[inline(always)]
pub(super) fn with_stacks<R>(count: usize, work: impl FnOnce(&mut [Stack]) -> R) -> R {
    // Taken, so that a shape of the user's own may ask another question meanwhile.
    let mut stacks = STACKS.take();
    if stacks.len() < count {
        stacks.resize_with(count, Stack::new);
    }
    let result = work(&mut stacks);
    STACKS.set(stacks);
    result
}
