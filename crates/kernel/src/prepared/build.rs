//! From the description of a scene to its spaces.

use super::Absent;
use super::balls::{Given, Spheres};
use super::looks::{Look, Looks};
use super::planes::Planes;
use super::space::{Entry, Holds, Kept, Kind, Other, Own, Size, Space, Stand, norms};
use crate::hierarchy::Hierarchy;
use crate::lean::not_lean;
use crate::primitive::Primitive;
use crate::shapes::mesh::Facets;
use crate::shapes::plane::HalfSpace;
use crate::shapes::primitive;
use crate::shapes::sphere::{Ball, LEAST_RADIUS};
use crate::{KernelSettings, figure};
use lancer_math::{Bounds, Placement};
use lancer_scene::{Geometry, Group, Mesh, Placed, Scene, Shape};
use std::collections::{BTreeMap, btree_map};
use std::sync::Arc;

/// Everything that is prepared of a scene.
pub(super) struct Built {
    pub(super) root: Space,
    /// Those of the groups; each after those that stand in it.
    pub(super) spaces: Vec<Space>,
    pub(super) looks: Vec<Look>,
    /// How much memory all takes.
    pub(super) bytes: usize,
}

pub(super) fn build(scene: &Scene, settings: &KernelSettings, absent: &Absent) -> Built {
    let mut builder = Builder { settings: *settings, ..Builder::default() };
    let mut shape_count = scene.shapes.len() as u32;
    number(&scene.groups, &mut shape_count, &mut builder.firsts);
    let root = builder.space(0, (&scene.shapes, &scene.groups), absent);
    let Builder { spaces, looks, meshes, .. } = builder;
    let looks = looks.finish();
    let bytes = root.bytes()
        + spaces.iter().map(Space::bytes).sum::<usize>()
        + meshes.values().map(|mesh| mesh.bytes()).sum::<usize>()
        + size_of_val(&looks[..]);
    Built { root, spaces, looks, bytes }
}

/// The number of the first shape of each group. Shapes are numbered as a reader meets them: those
/// of a group before those of groups in it, and each group where it stands first.
fn number(groups: &[Placed], shape_count: &mut u32, firsts: &mut BTreeMap<*const Group, u32>) {
    for Placed { group, .. } in groups {
        if let btree_map::Entry::Vacant(new) = firsts.entry(Arc::as_ptr(group)) {
            new.insert(*shape_count);
            *shape_count = shape_count.saturating_add(group.shapes().len() as u32);
            number(group.groups(), shape_count, firsts);
        }
    }
}

/// How a group stands. Negative zeros become zeros, as they do in every product.
fn described(placed: &Placed) -> Placement {
    placed.placement.then(&Placement::IDENTITY)
}

/// The size that the space of a group would have.
fn size(group: &Arc<Group>, known: &mut BTreeMap<*const Group, Size>) -> Size {
    if let Some(size) = known.get(&Arc::as_ptr(group)) {
        return *size;
    }
    let bounds = group.shapes().iter().filter_map(figure::bounds).filter(is_finite);
    let own = bounds.fold(Size::NONE, |all, bounds| all.and(Size::of(&bounds)));
    let all = group
        .groups()
        .iter()
        .filter(|placed| placed.group.shape_count() > 0)
        .fold(own, |all, placed| all.and(size(&placed.group, known).placed(&described(placed))));
    known.insert(Arc::as_ptr(group), all);
    all
}

#[derive(Default)]
struct Builder {
    settings: KernelSettings,
    spaces: Vec<Space>,
    looks: Looks,
    /// The numbers of groups' first shapes, the spaces of groups, the sizes of those that are absent, and the meshes,
    /// by address: only looked up, never walked, so that no address decides an order.
    firsts: BTreeMap<*const Group, u32>,
    known: BTreeMap<*const Group, u32>,
    sizes: BTreeMap<*const Group, Size>,
    meshes: BTreeMap<*const Mesh, Arc<Facets>>,
}

impl Builder {
    fn space(
        &mut self,
        first_shape: u32,
        (shapes, groups): (&[Shape], &[Placed]),
        absent: &Absent,
    ) -> Space {
        let looks: Vec<u32> =
            shapes.iter().map(|shape| self.looks.number(&shape.surface)).collect();
        let mut parts = Parts::default();
        for (i, shape) in (0..).zip(shapes) {
            if !absent.has_shape(i as usize) {
                self.shape(i, shape, &mut parts);
            } else if let Some(bounds) = figure::bounds(shape).filter(is_finite) {
                // What rounding comes to in the scene depends on it all the same.
                parts.size = parts.size.and(Size::of(&bounds));
            }
        }
        let mut item_count = shapes.len() as u32;
        for (i, placed) in groups.iter().enumerate() {
            let count = placed.group.shape_count();
            if count > 0 && !absent.has_group(i) {
                let space = self.group(&placed.group);
                parts.stand(placed, space, &self.spaces[space as usize], item_count);
            } else if count > 0 {
                let size = size(&placed.group, &mut self.sizes);
                parts.size = parts.size.and(size.placed(&described(placed)));
            }
            item_count = item_count.saturating_add(u32::try_from(count).unwrap_or(u32::MAX));
        }
        parts.finish(first_shape, &looks, item_count)
    }

    fn group(&mut self, group: &Arc<Group>) -> u32 {
        not_lean();
        if let Some(&space) = self.known.get(&Arc::as_ptr(group)) {
            return space;
        }
        let first = self.firsts[&Arc::as_ptr(group)];
        let space = self.space(first, (group.shapes(), group.groups()), &Absent::NONE);
        self.spaces.push(space);
        let number = (self.spaces.len() - 1) as u32;
        self.known.insert(Arc::as_ptr(group), number);
        number
    }

    fn shape(&mut self, number: u32, shape: &Shape, parts: &mut Parts) {
        let surface = &shape.surface;
        let is_transparent = surface.is_transparent();
        // A mesh finds out by looking at all its edges: only where it matters.
        let is_solid = surface.has_medium() && shape.geometry.is_closed();
        let holds = Holds { opaque: !is_transparent, transparent: is_transparent, solid: is_solid };
        parts.holds = parts.holds.and(holds);
        if let Geometry::Sphere(sphere) = &shape.geometry {
            let ball = Ball::new(sphere);
            if let Some(bounds) = ball.bounds().filter(is_finite) {
                parts.size = parts.size.and(Size::of(&bounds));
                parts.around = parts.around.union(bounds);
                parts.of_balls = parts.of_balls.and(holds);
                parts.balls.push(Given { shape: number, ball, bounds, is_transparent });
                return;
            }
        }
        // It has a number, but no ray needs to be held against it.
        let is_met = !matches!(&shape.geometry, Geometry::Sphere(sphere) if sphere.radius.get() < LEAST_RADIUS);
        let primitive = match &shape.geometry {
            Geometry::Mesh(mesh) => {
                not_lean();
                let known = self.meshes.entry(Arc::as_ptr(mesh));
                let facets = known.or_insert_with(|| Arc::new(Facets::new(mesh, &self.settings)));
                Kind::Mesh(Arc::clone(facets))
            }
            geometry => Kind::Any(primitive(geometry, &self.settings)),
        };
        let bounds = primitive.get().bounds().filter(is_finite);
        if let Some(bounds) = &bounds {
            parts.size = parts.size.and(Size::of(bounds));
        }
        if let Geometry::Plane(plane) = &shape.geometry {
            parts.planes.push((number, HalfSpace::new(plane), is_transparent));
        } else if is_met {
            parts.enter(Entry::other(parts.others.len()), bounds);
        }
        parts.others.push(Other { primitive, shape: number, is_transparent, is_solid });
    }
}

/// A space while it is put together.
struct Parts {
    balls: Vec<Given>,
    of_balls: Holds,
    planes: Vec<(u32, HalfSpace, bool)>,
    others: Vec<Other>,
    placed: Vec<Stand>,
    bounded: Vec<Entry>,
    boxes: Vec<Bounds>,
    unbounded: Vec<Entry>,
    holds: Holds,
    size: Size,
    around: Bounds,
    depth: usize,
}

impl Default for Parts {
    fn default() -> Self {
        Self {
            balls: Vec::new(),
            of_balls: Holds::default(),
            planes: Vec::new(),
            others: Vec::new(),
            placed: Vec::new(),
            bounded: Vec::new(),
            boxes: Vec::new(),
            unbounded: Vec::new(),
            holds: Holds::default(),
            size: Size::NONE,
            around: Bounds::EMPTY,
            depth: 1,
        }
    }
}

impl Parts {
    fn enter(&mut self, entry: Entry, bounds: Option<Bounds>) {
        match bounds {
            Some(bounds) => {
                self.around = self.around.union(bounds);
                self.boxes.push(bounds);
                self.bounded.push(entry);
            }
            None => self.unbounded.push(entry),
        }
    }

    fn stand(&mut self, placed: &Placed, number: u32, space: &Space, first: u32) {
        let placement = described(placed);
        let bounds = space.has_end.then(|| placement.bounds(&space.around)).filter(is_finite);
        self.enter(Entry::placed(self.placed.len()), bounds);
        self.size = self.size.and(space.size.placed(&placement));
        self.holds = self.holds.and(space.holds);
        self.depth = self.depth.max(1 + space.depth);
        let (_, shrink) = norms(&placement);
        self.placed.push(Stand { placement, shrink, space: number, first, holds: space.holds });
    }

    fn finish(self, first_shape: u32, looks: &[u32], item_count: u32) -> Space {
        let spheres = Spheres::new(&self.balls, self.of_balls);
        let own = looks.iter().map(|&look| Own { look, kept: Kept::Other(0) });
        let mut own: Vec<Own> = own.collect();
        for (index, other) in (0..).zip(&self.others) {
            own[other.shape as usize].kept = Kept::Other(index);
        }
        for (shape, spot) in spheres.spots() {
            own[shape as usize].kept = Kept::Sphere(spot);
        }
        // Each has a way of its own to be met, so each has a leaf.
        let (hierarchy, order) = Hierarchy::with_leaves_of(1, self.boxes.len(), |i| self.boxes[i]);
        let has_end = self.unbounded.is_empty() && self.planes.is_empty();
        Space {
            first_shape,
            own,
            spheres,
            planes: Planes::blocks(&self.planes),
            others: self.others,
            placed: self.placed,
            bounded: order.iter().map(|&i| self.bounded[i as usize]).collect(),
            hierarchy,
            unbounded: self.unbounded,
            item_count,
            holds: self.holds,
            size: self.size,
            around: self.around,
            has_end,
            depth: self.depth,
        }
    }
}

pub(super) fn is_finite(bounds: &Bounds) -> bool {
    bounds.sides().iter().all(|side| side.is_finite())
}
