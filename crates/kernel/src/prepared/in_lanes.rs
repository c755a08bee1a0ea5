//! Whole registers of rays against a scene whose own spheres and planes are few.

use super::build::is_finite;
use super::space::Space;
use super::walk::{Known, Quest};
use super::{Absent, Any, Nearest, Prepared, Question, Which};
use crate::lanes::{Lanes, MOST, Mask, Real, Work, lanes_of};
use crate::listed::{Candidates, Goal, LaneHits, Listed, ListedShape, MOST_LISTED};
use crate::primitive::Primitive;
use crate::shapes::plane::HalfSpace;
use crate::shapes::sphere::Ball;
use crate::{Hit, LEAN, Rays};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{Geometry, Scene, Shape};

/// More spheres than these are met by one ray at a time, many spheres at once.
const MOST_SPHERES: usize = 16;

/// Whether all shapes of a scene that are there are few enough, and simple enough, to be held
/// against whole registers of rays, so that there is no hierarchy of boxes.
#[must_use]
pub fn is_met_in_lanes(scene: &Scene, absent: &Absent) -> bool {
    let count = |is_one: fn(&Geometry) -> bool| {
        present(&scene.shapes, absent).filter(|(_, shape)| is_one(&shape.geometry)).count()
    };
    let spheres = count(|geometry| matches!(geometry, Geometry::Sphere(_)));
    let planes = count(|geometry| matches!(geometry, Geometry::Plane(_)));
    spheres + planes == count(|_| true)
        && (0..scene.groups.len()).all(|group| absent.has_group(group))
        && spheres <= MOST_SPHERES
        && planes <= MOST_LISTED
}

/// The shapes that are there, with their numbers.
fn present<'a>(shapes: &'a [Shape], absent: &'a Absent) -> impl Iterator<Item = (u32, &'a Shape)> {
    let is_there = |(number, _): &(u32, _)| !absent.has_shape(*number as usize);
    (0..).zip(shapes).filter(is_there)
}

/// A scene's own spheres and its planes, each kind if it is few, and which are.
pub(super) fn listed(shapes: &[Shape], absent: &Absent) -> (Listed, Known) {
    let ball = |shape: &Shape| match &shape.geometry {
        Geometry::Sphere(sphere) => {
            let ball = Ball::new(sphere);
            ball.bounds().is_some_and(|bounds| is_finite(&bounds)).then_some(ball)
        }
        _ => None,
    };
    let plane = |shape: &Shape| match &shape.geometry {
        Geometry::Plane(plane) => Some(HalfSpace::new(plane)),
        _ => None,
    };
    let few = |count: usize, most: usize| count <= most;
    let there = || present(shapes, absent).map(|(_, shape)| shape);
    let known = Known {
        spheres: few(there().filter_map(ball).take(MOST_SPHERES + 1).count(), MOST_SPHERES),
        planes: few(there().filter_map(plane).take(MOST_LISTED + 1).count(), MOST_LISTED),
    };
    let mut listed = Listed::default();
    for (item, shape) in present(shapes, absent) {
        let is_transparent = shape.surface.is_transparent();
        if known.spheres
            && let Some(ball) = ball(shape)
        {
            listed.add_ball(item, ball, is_transparent);
        } else if known.planes
            && let Some(plane) = plane(shape)
        {
            listed.add_plane(item, plane, is_transparent);
        }
    }
    (listed, known)
}

/// Whether there is nothing in a space but those kinds of shapes.
#[inline(always)]
pub(super) fn is_all(space: &Space, Known { spheres, planes }: Known) -> bool {
    spheres && planes && space.bounded.is_empty() && space.unbounded.is_empty()
}

impl Prepared {
    pub(crate) const fn listed(&self) -> &Listed {
        &self.listed
    }

    /// Whether there is nothing but what is met in lanes.
    fn lists_all(&self) -> bool {
        LEAN || is_all(&self.root, self.listed_kinds)
    }

    /// The nearest hits with 0 < t < `t_max` of the `asked` rays of a register; for
    /// others it answers anything. Listed shapes that are no candidates are not asked. If
    /// rays leave the outside of closed items as [`SurfacePoint::leave`](crate::SurfacePoint::leave)
    /// has it, those are named with the candidates; -1 where they do not.
    #[inline(always)]
    pub fn nearest_in_lanes<L: Lanes>(
        &self,
        rays: &Rays<L>,
        t_max: f64,
        asked: L::Mask,
        among: (&Candidates, Option<L::Real>),
    ) -> LaneHits<L::Real> {
        let plain = self.settings.culling.plain_cases;
        let hits = self.listed.nearest(rays, rays.lanes.splat(t_max), among, plain);
        if self.lists_all() { hits } else { self.nearest_lane_by_lane(rays, t_max, asked, hits) }
    }

    #[inline(never)]
    fn nearest_lane_by_lane<L: Lanes>(
        &self,
        rays: &Rays<L>,
        t_max: f64,
        asked: L::Mask,
        hits: LaneHits<L::Real>,
    ) -> LaneHits<L::Real> {
        let lanes = rays.lanes;
        lanes.vectorize(
            #[inline(always)]
            || {
                let (mut t, mut item, mut part) = ([0.0; MOST], [0.0; MOST], [0.0; MOST]);
                hits.t.store(&mut t);
                hits.item.store(&mut item);
                for k in lanes_of(asked.bits()) {
                    let hit = Hit { t: t[k], item: item[k] as u32, part: 0 };
                    let known = (item[k] >= 0.0).then_some(hit);
                    let quest = Nearest::beyond(t_max, known);
                    if let Some(hit) = self.ask_unlisted(lanes, &rays.lane(k), quest).best {
                        (t[k], item[k], part[k]) =
                            (hit.t, f64::from(hit.item), f64::from(hit.part));
                    }
                }
                LaneHits { t: lanes.load(&t), item: lanes.load(&item), part: lanes.load(&part) }
            },
        )
    }

    /// Of the scene's own shapes the listed ones are left out.
    #[inline(always)]
    fn ask_unlisted<L: Lanes, Q: Quest>(&self, lanes: L, ray: &Ray, quest: Q) -> Q {
        Question { prepared: self, ray, quest, known: self.listed_kinds }.run(lanes)
    }

    /// Which of the `asked` rays of a register hit something with 0 < t < `t_max`
    /// among some items. Listed shapes that are no candidates are not asked. If all of
    /// them leave the outside of a closed item as [`SurfacePoint::leave`](crate::SurfacePoint::leave) has it,
    /// that is named with the candidates.
    #[inline(always)]
    pub fn any_in_lanes<L: Lanes>(
        &self,
        rays: &Rays<L>,
        t_max: f64,
        asked: L::Mask,
        which: Which,
        among: (&Candidates, Option<u32>),
    ) -> L::Mask {
        let plain = self.settings.culling.plain_cases;
        let met = self.listed.any(rays, (t_max, which), among, plain) & asked;
        if self.lists_all() {
            return met;
        }
        self.any_lane_by_lane(rays, t_max, asked, which, met)
    }

    #[inline(never)]
    fn any_lane_by_lane<L: Lanes>(
        &self,
        rays: &Rays<L>,
        t_max: f64,
        asked: L::Mask,
        which: Which,
        met: L::Mask,
    ) -> L::Mask {
        let lanes = rays.lanes;
        lanes.vectorize(
            #[inline(always)]
            || {
                let mut bits = met.bits();
                for k in lanes_of((asked & !met).bits()) {
                    let quest = Any::new(t_max, which);
                    let found = self.ask_unlisted(lanes, &rays.lane(k), quest).found;
                    bits |= u32::from(found) << k;
                }
                lanes.mask(bits)
            },
        )
    }

    /// The shape of an item, if it is one that is met in lanes.
    #[must_use]
    pub fn shape_in_lanes(&self, item: u32) -> Option<ListedShape<'_>> {
        self.listed.shape(item)
    }

    /// Whether rays that are held against these candidates meet nothing of some items.
    #[must_use]
    pub fn is_clear(&self, which: Which, among: &Candidates) -> bool {
        self.lists_all() && self.listed.has_none(which, among)
    }

    /// What rays of length 1 may meet that start in a ball and whose angle with an axis of
    /// length 1 has at least that cosine.
    #[must_use]
    pub fn candidates_in_cone(
        &self,
        centre: &Point,
        radius: f64,
        axis: &Vector,
        cosine: f64,
    ) -> Candidates {
        self.listed.in_cone(centre, radius, axis, cosine)
    }

    /// What rays may meet that start in a ball and go to a goal. If all leave the
    /// surface of an item as [`SurfacePoint::leave`](crate::SurfacePoint::leave) has it, on the side of a unit normal,
    /// that is `leaving`.
    #[must_use]
    pub fn candidates_between(
        &self,
        centre: &Point,
        radius: f64,
        goal: &Goal,
        leaving: Option<(u32, Vector)>,
    ) -> Candidates {
        self.listed.between(centre, radius, goal, leaving)
    }
}
