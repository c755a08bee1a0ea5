//! Which shapes rays can reach.

use super::Dropped;
use super::half_space::{HalfSpace, Ways};
use crate::whitted::outermost_rays;
use lancer_kernel::{Absent, figure};
use lancer_math::{Bounds, Point, Vector, unit};
use lancer_scene::{Geometry, Group, Length, Light, Placed, Plane, Scene, Shape};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Where what is seen can be: directly, by a flat mirror, or anywhere on this side of opaque planes.
///
/// *Planes.* Neither rays nor light cross an opaque plane: all that is met is on the side where all rays
/// start.
///
/// *The view.* Without mirrors and glass in view, rays end where they are met. They start at the eye
/// or its lens, between those of the picture's corners. Mirrors that are all in one plane show what
/// their images of the eye see, as well. Shadow rays are between points that are seen and a lamp, or
/// go on from such a point to a sun. So what is outside of a half-space with all of those is met by no ray
/// (see [`Ways::half_spaces`]). Where a round mirror or glass is in view, rays may go anywhere.
pub(super) struct Sight<'a> {
    scene: &'a Scene,
    /// The opaque planes, with their numbers among the scene's own shapes.
    pub(super) planes: Vec<(usize, &'a Plane)>,
    /// The own shapes that rays go on from.
    bending: Vec<&'a Shape>,
    walls: Vec<HalfSpace>,
    /// Those of the eye, and those by flat mirrors; none where they lead anywhere.
    ways: Vec<Ways>,
    /// What is seen is in all of the half-spaces of one of these.
    seen: Vec<Vec<HalfSpace>>,
}

impl<'a> Sight<'a> {
    pub(super) fn new(scene: &'a Scene) -> Self {
        // One look at each: there may be millions.
        let numbered = scene.shapes.par_iter().with_min_len(MANY).enumerate();
        let notable: Vec<(usize, &Shape)> =
            numbered.filter(|(_, shape)| bends(shape) || wall(shape).is_some()).collect();
        let planes: Vec<_> =
            notable.iter().filter_map(|(number, shape)| Some((*number, wall(shape)?))).collect();
        let bending =
            notable.iter().map(|(_, shape)| *shape).filter(|shape| bends(shape)).collect();
        let eye = Ways::of_rays(&outermost_rays(&scene.camera));
        let walls = walls(&planes, &eye);
        let (ways, seen) = (Vec::new(), Vec::new());
        let mut sight = Self { scene, planes, bending, walls, ways, seen };
        sight.ways = sight.with_mirrors(eye).unwrap_or_default();
        sight.seen = sight.within(&sight.ways);
        sight
    }

    /// For each of some ways, or where there are none for all, the half-spaces that hold them.
    fn within(&self, ways: &[Ways]) -> Vec<Vec<HalfSpace>> {
        if ways.is_empty() {
            return vec![self.walls.clone()];
        }
        ways.iter().map(|ways| [self.walls.clone(), ways.half_spaces()].concat()).collect()
    }

    /// The eye's ways and those by mirrors; `None` where those lead anywhere.
    fn with_mirrors(&self, eye: Ways) -> Option<Vec<Ways>> {
        let bending = self.bending();
        let in_sight = |ways: &[Ways]| -> Vec<Option<Flat>> {
            let seen = self.within(ways);
            let is_seen = |(bounds, _): &&(Option<Bounds>, Option<Flat>)| is_within(*bounds, &seen);
            bending.iter().filter(is_seen).map(|(_, flat)| *flat).collect()
        };
        let first = in_sight(std::slice::from_ref(&eye));
        let Some(mirror) = first.first() else { return Some(vec![eye]) };
        let mirror = (*mirror)?;
        let eyes = eye.balls.iter().map(|(centre, radius)| centre.coords.amax() + radius);
        let size = mirror.0.coords.amax() + eyes.fold(0.0, f64::max);
        // Far more than rounding, and than mirrors in one plane are apart.
        let ways = vec![eye.image(&mirror, 1e-10 * size), eye];
        let are_one =
            |other: &Option<Flat>| other.is_some_and(|other| is_same_plane(&mirror, &other, size));
        in_sight(&ways).iter().all(are_one).then_some(ways)
    }

    /// The boxes of what rays do not end at, mirrors and glass, and the planes of flat mirrors.
    fn bending(&self) -> Vec<(Option<Bounds>, Option<Flat>)> {
        let mut bending: Vec<_> =
            self.bending.iter().map(|shape| (figure::bounds(shape), flat_mirror(shape))).collect();
        let (mut known, mut boxes) = (BTreeMap::new(), BTreeMap::new());
        for placed in &self.scene.groups {
            if group_bends(&placed.group, &mut known) {
                bending.push((around_placed(placed, &mut boxes), None));
            }
        }
        bending
    }

    /// Whether something with that box, or without an end, may be seen.
    pub(super) fn may_see(&self, bounds: Option<Bounds>) -> bool {
        is_within(bounds, &self.seen)
    }

    /// What no ray of a picture reaches where those lights are not asked.
    pub(super) fn absent(&self, dropped: &[Dropped]) -> Absent {
        let spaces = self.reached(dropped);
        if spaces.iter().any(Vec::is_empty) {
            return Absent::NONE;
        }
        let useful_for_shapes = useful(&self.scene.shapes, &spaces, figure::bounds);
        let shapes = useful_for_shapes.map_or_else(Vec::new, |useful| {
            let shapes = self.scene.shapes.par_iter().with_min_len(MANY);
            shapes.map(|shape| !is_within(figure::bounds(shape), &useful)).collect()
        });
        let mut known = BTreeMap::new();
        let mut around = |placed: &Placed| around_placed(placed, &mut known);
        let useful_for_groups = useful(&self.scene.groups, &spaces, &mut around);
        let groups = useful_for_groups.map_or_else(Vec::new, |useful| {
            let placed = self.scene.groups.iter();
            placed.map(|placed| !is_within(around(placed), &useful)).collect()
        });
        Absent::new(shapes, groups)
    }

    /// Half-spaces that hold all rays, shadow rays too.
    fn reached(&self, dropped: &[Dropped]) -> Vec<Vec<HalfSpace>> {
        let (mut balls, mut directions) = (Vec::new(), Vec::new());
        for (number, light) in self.scene.lights.iter().enumerate() {
            if dropped.iter().any(|dropped| dropped.light == number) {
                continue;
            }
            match light {
                Light::Sun { direction, .. } => directions.push(-direction.get()),
                Light::Lamp { point, radius, .. } | Light::Spot { point, radius, .. } => {
                    balls.push((point.get(), radius.map_or(0.0, Length::get)));
                }
            }
        }
        let mut ways = self.ways.clone();
        for ways in &mut ways {
            ways.balls.extend(&balls);
            ways.directions.extend(&directions);
        }
        self.within(&ways)
    }
}

/// Whether a box, or what has no end, may be in all half-spaces of one of some families.
fn is_within(bounds: Option<Bounds>, families: &[Vec<HalfSpace>]) -> bool {
    let is_in = |bounds: &Bounds, spaces: &Vec<HalfSpace>| {
        !spaces.iter().any(|space| space.excludes(bounds))
    };
    bounds.is_none_or(|bounds| families.iter().any(|spaces| is_in(&bounds, spaces)))
}

/// An opaque plane, which is all that cuts space in two.
fn wall(shape: &Shape) -> Option<&Plane> {
    match &shape.geometry {
        Geometry::Plane(plane) if !shape.surface.is_transparent() => Some(plane),
        _ => None,
    }
}

/// The sides of opaque planes on which all rays start.
fn walls(planes: &[(usize, &Plane)], eye: &Ways) -> Vec<HalfSpace> {
    let side = |(_, plane): &(usize, &Plane)| {
        HalfSpace::with_balls(&plane.origin.get(), &unit(plane.normal.get())?, &eye.balls)
    };
    planes.iter().filter_map(side).collect()
}

/// A point of a plane, and its normal of length 1.
type Flat = (Point, Vector);

/// The plane of an opaque flat shape.
fn flat_mirror(shape: &Shape) -> Option<Flat> {
    if shape.surface.is_transparent() {
        return None;
    }
    let (origin, normal) = match &shape.geometry {
        Geometry::Plane(plane) => (plane.origin.get(), plane.normal.get()),
        Geometry::Disc(disc) => (disc.centre.get(), disc.normal.get()),
        Geometry::Rectangle(rectangle) => {
            let [u, v] = rectangle.sides().map(lancer_scene::Direction::get);
            (rectangle.corner(), u.cross(&v))
        }
        Geometry::Triangle(triangle) => {
            let [a, b, c] = triangle.corners();
            (a, (b - a).cross(&(c - a)))
        }
        _ => return None,
    };
    Some((origin, unit(normal)?))
}

/// Whether two planes are one, but for rounding of coordinates of that size: those of points that say
/// where a plane is, from far away, would say less.
fn is_same_plane(a: &Flat, b: &Flat, size: f64) -> bool {
    let way = b.0 - a.0;
    way.amax() <= 50.0 * size
        && a.1.cross(&b.1).amax() <= 1e-13
        && way.dot(&a.1).abs() <= 1e-13 * size
}

/// Whether rays go on from a shape.
fn bends(shape: &Shape) -> bool {
    shape.surface.gloss.get() > 0.0 || shape.surface.is_transparent()
}

/// Only looked up, never walked.
pub(super) type Known<T> = BTreeMap<*const Group, T>;

fn group_bends(group: &Arc<Group>, known: &mut Known<bool>) -> bool {
    if let Some(bends) = known.get(&Arc::as_ptr(group)) {
        return *bends;
    }
    let is_bending = group.shapes().iter().any(bends)
        || group.groups().iter().any(|placed| group_bends(&placed.group, known));
    known.insert(Arc::as_ptr(group), is_bending);
    is_bending
}

/// The box around a group where it stands; `None` where it has no end.
pub(super) fn around_placed(placed: &Placed, known: &mut Known<Option<Bounds>>) -> Option<Bounds> {
    let group = &placed.group;
    let own = known.get(&Arc::as_ptr(group)).copied().unwrap_or_else(|| {
        let shapes = group
            .shapes()
            .iter()
            .try_fold(Bounds::EMPTY, |all, shape| Some(all.union(figure::bounds(shape)?)));
        let own = group
            .groups()
            .iter()
            .fold(shapes, |all, placed| Some(all?.union(around_placed(placed, known)?)));
        known.insert(Arc::as_ptr(group), own);
        own
    })?;
    (own.min.x <= own.max.x).then(|| placed.placement.bounds(&own))
}

/// Threads take no fewer shapes at once.
const MANY: usize = 4096;
/// So many are looked at first,
const LOOKED_AT: usize = 256;
/// and all only if at least one in so many of those is not reached: else it does not pay.
const WORTH: usize = 8;

/// Of each family the half-spaces that exclude some of those that are looked at first; `None` where
/// too few of those are outside of one of each.
fn useful<T>(
    all: &[T],
    families: &[Vec<HalfSpace>],
    bounds: impl FnMut(&T) -> Option<Bounds>,
) -> Option<Vec<Vec<HalfSpace>>> {
    let step = all.len().div_ceil(LOOKED_AT).max(1);
    let some: Vec<Bounds> = all.iter().step_by(step).filter_map(bounds).collect();
    let excluded = some.iter().filter(|bounds| !is_within(Some(**bounds), families)).count();
    if excluded == 0 || excluded * WORTH < all.len().div_ceil(step) {
        return None;
    }
    let is_useful = |space: &&HalfSpace| some.iter().any(|bounds| space.excludes(bounds));
    Some(families.iter().map(|spaces| spaces.iter().filter(is_useful).copied().collect()).collect())
}
