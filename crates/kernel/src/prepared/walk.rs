//! A ray's way through a scene and the groups that stand in it.
//!
//! A ray is brought into a group's space by the product of all placements on the
//! way there, in one step from the world: so it is rounded there once, however deep
//! the group stands, and the same whichever boxes were looked at before. The box of a
//! placed group is held against the ray as it is in the space around, which is
//! rounded otherwise. So such boxes are made wider by what both roundings can
//! come to ([`Walk::margin`]); those of a group's own shapes are not, since there
//! shape and box are held against the very same ray.

use super::balls::{Block, Names};
use super::space::{Content, Entry, Space, Stand};
use super::{Prepared, Which};
use crate::lanes::Lanes;
use crate::primitive::Primitive;
use lancer_math::{Placement, Ray};

/// What is asked about a ray.
pub(super) trait Quest {
    /// Which shapes it is held against.
    fn which(&self) -> Which;

    /// From where on it is looked at.
    fn from(&self) -> f64;

    /// Up to where; less and less.
    fn to(&self) -> f64;

    /// Looks at a shape, with the ray in its space.
    fn meet(&mut self, primitive: &dyn Primitive, ray: &Ray, item: u32);

    /// Looks at the spheres of a block; their items are numbered from `first` on.
    fn meet_block<L: Lanes>(
        &mut self,
        lanes: L,
        block: &Block,
        names: &Names,
        ray: &Ray,
        first: u32,
    );
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
    pub(super) const fn world(space: &'a Space) -> Self {
        Self { space, placement: Placement::IDENTITY, is_world: true, first: 0, shrink: 1.0 }
    }

    /// Where a group stands in it.
    #[inline]
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
    #[inline]
    pub(super) fn local(&self, ray: &Ray) -> Ray {
        if self.is_world {
            return *ray;
        }
        let origin = self.placement.local_point(&ray.origin);
        Ray::new(origin, self.placement.local_vector(&ray.direction))
    }
}

pub(super) struct Walk<'a> {
    spaces: &'a [Space],
    /// In the world.
    ray: Ray,
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
    fn margin(&self, place: &Place<'_>) -> f64 {
        const UNIT: f64 = 2048.0 * f64::EPSILON;
        UNIT * place.shrink * (1.0 + place.space.size.condition) * self.reach
    }

    /// Holds the ray against all that may matter to the quest.
    #[inline(always)]
    pub(super) fn go<L: Lanes, Q: Quest>(&self, lanes: L, place: &Place<'_>, quest: &mut Q) {
        let space = place.space;
        let ray = place.local(&self.ray);
        for &entry in &space.unbounded {
            self.enter(lanes, place, &ray, entry, quest);
        }
        let from = quest.from().min(0.0);
        let balls = &space.balls;
        if !balls.blocks.is_empty() {
            balls.hierarchy.visit(
                &ray,
                from,
                quest.to(),
                #[inline(always)]
                |i, _| {
                    quest.meet_block(lanes, &balls.blocks[i], &balls.names[i], &ray, place.first);
                    quest.to()
                },
            );
        }
        if !space.bounded.is_empty() {
            let margin = if space.placed.is_empty() { 0.0 } else { self.margin(place) };
            space.hierarchy.visit_wide(
                &ray,
                margin,
                from,
                quest.to(),
                #[inline(always)]
                |i, _| {
                    self.enter(lanes, place, &ray, space.bounded[i], quest);
                    quest.to()
                },
            );
        }
    }

    #[inline(always)]
    fn enter<L: Lanes, Q: Quest>(
        &self,
        lanes: L,
        place: &Place<'_>,
        ray: &Ray,
        entry: Entry,
        quest: &mut Q,
    ) {
        match entry.content() {
            Content::Other(index) => {
                let other = &place.space.others[index];
                if other.is_asked(quest.which()) {
                    quest.meet(&*other.primitive, ray, place.first + other.shape);
                }
            }
            Content::Placed(index) => {
                let stand = &place.space.placed[index];
                if stand.holds.any(quest.which()) {
                    self.descend(lanes, place, stand, quest);
                }
            }
        }
    }

    /// No deeper than groups may be nested.
    fn descend<L: Lanes, Q: Quest>(
        &self,
        lanes: L,
        place: &Place<'_>,
        stand: &Stand,
        quest: &mut Q,
    ) {
        lanes.vectorize(
            #[inline(always)]
            || self.go(lanes, &place.inside(stand, self.spaces), quest),
        );
    }
}
