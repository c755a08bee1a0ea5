use crate::bvh::Bvh;
use crate::checker::{self, LaneCells};
use crate::lanes::{Lanes, MOST, Mask, Real, lanes_of};
use crate::listed::{Candidates, Goal, LaneHits, LanePoints, Listed};
use crate::primitive::{Cell, Primitive};
use crate::shapes::plane::HalfSpace;
use crate::shapes::primitive;
use crate::shapes::sphere::Ball;
use crate::{Hit, Rays, SurfacePoint};
use lancer_math::{Bounds, Placement, Point, Ray, Vector};
use lancer_scene::{Checker, Geometry, Group, Pattern, Placed, Scene, Shape, Surface};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::sync::Arc;

/// More spheres than these go into the hierarchy.
const MOST_BALLS: usize = 16;

/// The shapes of a scene, made ready to be met by rays. It does not change any
/// more and may be asked from any thread.
///
/// What groups hold is shared by all places where they stand; each place of a
/// shape is an *item* with a number: first the shapes that stand by themselves,
/// then those of groups, each group's own before those of groups inside it. Of
/// items that a ray meets at the very same distance the first is the one
/// that is met.
#[derive(Debug)]
pub struct Prepared {
    shapes: Vec<Ready>,
    /// The first one leaves everything where it is.
    placements: Vec<Placement>,
    items: Vec<Item>,
    /// Spheres and planes that are met in lanes.
    listed: Listed,
    /// Other items that a box holds, and the hierarchy of their boxes.
    bounded: Vec<u32>,
    hierarchy: Bvh,
    /// Those without an end; a ray is held against each.
    unbounded: Vec<u32>,
    /// Items that can be filled with a medium.
    solids: Vec<u32>,
    has_transparent: bool,
    coarsest: f64,
}

/// A shape and what it looks like.
#[derive(Debug)]
struct Ready {
    primitive: Box<dyn Primitive>,
    surface: Surface,
    is_closed: bool,
    simple: Simple,
    /// The colour's shares, and those of a checker.
    albedo: [f64; 3],
    second: [f64; 3],
}

/// A shape that can be listed.
#[derive(Debug, Clone, Copy)]
enum Simple {
    Ball(Ball),
    Plane(HalfSpace),
    Not,
}

/// A shape where it stands.
#[derive(Debug, Clone, Copy)]
struct Item {
    shape: u32,
    placement: u32,
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

impl Ready {
    fn new(shape: &Shape) -> Self {
        let surface = shape.surface;
        let albedo = surface.colour.shares();
        let second = match surface.pattern {
            Pattern::Solid => albedo,
            Pattern::Checker(checker) => checker.second.shares(),
        };
        Self {
            primitive: primitive(&shape.geometry),
            surface,
            // A mesh finds out by looking at all its edges: only where it matters.
            is_closed: surface.has_medium() && shape.geometry.is_closed(),
            simple: match &shape.geometry {
                Geometry::Sphere(sphere) => Simple::Ball(Ball::new(sphere)),
                Geometry::Plane(plane) => Simple::Plane(HalfSpace::new(plane)),
                _ => Simple::Not,
            },
            albedo,
            second,
        }
    }

    fn is_asked(&self, which: Which) -> bool {
        match which {
            Which::All => true,
            Which::Opaque => !self.surface.is_transparent(),
            Which::Transparent => self.surface.is_transparent(),
        }
    }
}

impl Prepared {
    /// Makes the shapes of `scene` ready.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let mut builder = Builder::default();
        builder.placements.push(Placement::IDENTITY);
        builder.shapes(&scene.shapes, 0);
        builder.groups(&scene.groups, &Placement::IDENTITY);
        builder.finish()
    }

    /// Whether any of them lets light through.
    #[must_use]
    pub const fn has_transparent(&self) -> bool {
        self.has_transparent
    }

    /// The error of the points of the item whose points are least certain, but
    /// for what a point far from it adds where it has no end: from the sizes of
    /// coordinates, in its own space and in the world.
    #[must_use]
    pub const fn coarsest(&self) -> f64 {
        self.coarsest
    }

    /// The nearest hit with 0 < t < `t_max`.
    #[must_use]
    pub fn nearest(&self, ray: &Ray, t_max: f64) -> Option<Hit> {
        let best = self.listed.nearest_of(ray, t_max);
        let best = best.map(|(t, item)| Hit { t, item, part: 0 });
        self.nearest_unlisted(ray, t_max, best)
    }

    /// The nearest hit, where that of the listed shapes is known.
    fn nearest_unlisted(&self, ray: &Ray, t_max: f64, known: Option<Hit>) -> Option<Hit> {
        let mut best = known;
        let mut consider = |item: u32, to: f64| {
            let (ready, local) = self.local(item, ray);
            match ready.primitive.nearest(&local, to) {
                Some(crossing) if best.is_none_or(|b| (crossing.t, item) < (b.t, b.item)) => {
                    best = Some(Hit { t: crossing.t, item, part: crossing.part });
                    // Another one at the same distance is to be looked at, too.
                    crossing.t.next_up().min(t_max)
                }
                _ => to,
            }
        };
        let mut to = known.map_or(t_max, |hit| hit.t.next_up().min(t_max));
        for &item in &self.unbounded {
            to = consider(item, to);
        }
        self.hierarchy.visit(ray, 0.0, to, |i, to| consider(self.bounded[i], to));
        best
    }

    /// Whether there is a hit with 0 < t < `t_max` among some items.
    #[must_use]
    pub fn any(&self, ray: &Ray, t_max: f64, which: Which) -> bool {
        self.listed.meets(ray, t_max, which) || self.any_unlisted(ray, t_max, which)
    }

    fn any_unlisted(&self, ray: &Ray, t_max: f64, which: Which) -> bool {
        let meets = |item: u32| {
            let (ready, local) = self.local(item, ray);
            ready.is_asked(which) && ready.primitive.nearest(&local, t_max).is_some()
        };
        if self.unbounded.iter().any(|&item| meets(item)) {
            return true;
        }
        let mut found = false;
        self.hierarchy.visit(ray, 0.0, t_max, |i, to| {
            found = found || meets(self.bounded[i]);
            // Once there is one, nothing is near enough any more.
            if found { f64::NEG_INFINITY } else { to }
        });
        found
    }

    /// All hits with `from` < t < `to` among some items, nearest first; those at
    /// the very same t in the order of the items.
    #[must_use]
    pub fn all(&self, ray: &Ray, (from, to): (f64, f64), which: Which) -> Vec<Hit> {
        let mut hits = Vec::new();
        let mut collect = |item: u32| {
            let (ready, local) = self.local(item, ray);
            if ready.is_asked(which) {
                ready.primitive.each(&local, from, to, &mut |crossing| {
                    hits.push(Hit { t: crossing.t, item, part: crossing.part });
                });
            }
        };
        self.listed.items(which).for_each(&mut collect);
        self.unbounded.iter().for_each(|&item| collect(item));
        // From the beginning of the ray: the box of a flat shape may end before
        // its hit does, by rounding.
        self.hierarchy.visit(ray, from.min(0.0), to, |i, to| {
            collect(self.bounded[i]);
            to
        });
        hits.sort_by(|a, b| a.t.total_cmp(&b.t).then((a.item, a.part).cmp(&(b.item, b.part))));
        hits
    }

    /// The point of a hit that this ray has, with all that shading needs.
    #[must_use]
    pub fn expand(&self, ray: &Ray, hit: &Hit) -> SurfacePoint<'_> {
        let item = self.items[hit.item as usize];
        let (ready, local) = self.local(hit.item, ray);
        let crossing = crate::Crossing { t: hit.t, part: hit.part };
        let contact = ready.primitive.contact(&local, &crossing);
        let albedo = match ready.surface.pattern {
            Pattern::Solid => ready.albedo,
            Pattern::Checker(checker) => match ready.primitive.cell(&contact, hit.part, &checker) {
                Cell::First => ready.albedo,
                Cell::Second => ready.second,
                Cell::Mixed => [0, 1, 2].map(|i| (ready.albedo[i] + ready.second[i]) / 2.0),
            },
        };
        let mut surface = SurfacePoint {
            point: contact.point,
            error: contact.error,
            normal: contact.normal,
            shading: contact.shading,
            surface: &ready.surface,
            albedo,
            shape: item.shape,
            item: hit.item,
        };
        if item.placement != 0 {
            surface.place(&self.placements[item.placement as usize]);
        }
        surface
    }

    /// The nearest hits with 0 < t < `t_max` of the `asked` rays of a register; for
    /// others it answers anything. Listed shapes that are no candidates are not asked.
    #[inline(always)]
    pub fn nearest_in_lanes<L: Lanes>(
        &self,
        rays: &Rays<L>,
        t_max: f64,
        asked: L::Mask,
        among: &Candidates,
    ) -> LaneHits<L::Real> {
        let hits = self.listed.nearest(rays, rays.lanes.splat(t_max), among);
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
        let (mut t, mut item, mut part) = ([0.0; MOST], [0.0; MOST], [0.0; MOST]);
        hits.t.store(&mut t);
        hits.item.store(&mut item);
        for k in lanes_of(asked.bits()) {
            let known = (item[k] >= 0.0).then(|| Hit { t: t[k], item: item[k] as u32, part: 0 });
            if let Some(hit) = self.nearest_unlisted(&rays.lane(k), t_max, known) {
                (t[k], item[k], part[k]) = (hit.t, f64::from(hit.item), f64::from(hit.part));
            }
        }
        let lanes = rays.lanes;
        LaneHits { t: lanes.load(&t), item: lanes.load(&item), part: lanes.load(&part) }
    }

    /// Which of the `asked` rays of a register hit something with 0 < t < `t_max`
    /// among some items. Listed shapes that are no candidates are not asked.
    #[inline(always)]
    pub fn any_in_lanes<L: Lanes>(
        &self,
        rays: &Rays<L>,
        t_max: f64,
        asked: L::Mask,
        which: Which,
        among: &Candidates,
    ) -> L::Mask {
        let met = self.listed.any(rays, t_max, which, among) & asked;
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
        let mut bits = met.bits();
        for k in lanes_of((asked & !met).bits()) {
            bits |= u32::from(self.any_unlisted(&rays.lane(k), t_max, which)) << k;
        }
        rays.lanes.mask(bits)
    }

    /// The points of hits that a register of rays has with one item, if it is one
    /// that is met in lanes; [`expand`](Self::expand) gives the same, one by one.
    #[inline(always)]
    pub fn points_in_lanes<L: Lanes>(
        &self,
        rays: &Rays<L>,
        t: L::Real,
        item: u32,
    ) -> Option<LanePoints<L::Real>> {
        self.listed.contacts(item, rays, t)
    }

    /// Which colours of a checker points show of an item that is met in lanes.
    #[inline(always)]
    pub fn cells_in_lanes<L: Lanes>(
        &self,
        lanes: L,
        item: u32,
        points: &LanePoints<L::Real>,
        checker: &Checker,
    ) -> LaneCells<L::Mask> {
        match self.listed.plane(item) {
            Some(plane) => {
                let (first, second) = plane.squares(lanes, &points.point, checker);
                checker::cells(lanes, first, second)
            }
            None => checker::on_globe(lanes, &points.normal, checker.angle.get()),
        }
    }

    /// Whether [`points_in_lanes`](Self::points_in_lanes) knows the item.
    #[must_use]
    pub fn is_listed(&self, item: u32) -> bool {
        self.listed.is_listed(item)
    }

    /// What rays may meet that start in a ball and whose angle with an axis of
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
    /// surface of an item as [`SurfacePoint::leave`] has it, on the side of a unit normal,
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

    /// Whether there is nothing but what is met in lanes.
    fn lists_all(&self) -> bool {
        self.bounded.is_empty() && self.unbounded.is_empty()
    }

    /// The two colours of an item; the same where it has no checker.
    #[must_use]
    pub fn albedos(&self, item: u32) -> [[f64; 3]; 2] {
        let ready = &self.shapes[self.items[item as usize].shape as usize];
        [ready.albedo, ready.second]
    }

    /// The items filled with a medium that `point` is in.
    #[must_use]
    pub fn solids_at(&self, point: &Point) -> Vec<u32> {
        let holds = |item: &u32| {
            let Item { shape, placement } = self.items[*item as usize];
            let local = match placement {
                0 => *point,
                _ => self.placements[placement as usize].local_point(point),
            };
            self.shapes[shape as usize].primitive.contains(&local)
        };
        self.solids.iter().copied().filter(holds).collect()
    }

    /// What an item looks like.
    ///
    /// # Panics
    /// Where there is no such item.
    #[must_use]
    pub fn surface(&self, item: u32) -> &Surface {
        &self.shapes[self.items[item as usize].shape as usize].surface
    }

    /// Whose medium a point is in that is in both: that of the higher priority;
    /// of the same, the one with the smaller volume; of the same again, the one
    /// that comes later.
    #[must_use]
    pub fn rank(&self, a: u32, b: u32) -> Ordering {
        let volume = |item: u32| {
            let Item { shape, placement } = self.items[item as usize];
            let placement = &self.placements[placement as usize];
            let volume = self.shapes[shape as usize].primitive.volume() * placement.volume_factor();
            // To 28 bits, rounded: a turn changes the last ones. Bits of positive
            // numbers are ordered as the numbers are.
            (volume.to_bits() + (1 << 23)) >> 24
        };
        let (one, other) = (self.surface(a).priority, self.surface(b).priority);
        one.cmp(&other).then_with(|| volume(b).cmp(&volume(a))).then(a.cmp(&b))
    }

    /// The ray in the space of the item's shape.
    #[inline]
    fn local(&self, item: u32, ray: &Ray) -> (&Ready, Ray) {
        let Item { shape, placement } = self.items[item as usize];
        let ready = &self.shapes[shape as usize];
        if placement == 0 {
            return (ready, *ray);
        }
        let placement = &self.placements[placement as usize];
        let origin = placement.local_point(&ray.origin);
        (ready, Ray::new(origin, placement.local_vector(&ray.direction)))
    }
}

#[derive(Default)]
struct Builder {
    shapes: Vec<Ready>,
    placements: Vec<Placement>,
    items: Vec<Item>,
    /// Where the shapes of a group begin. Only looked up by address, never
    /// walked, so that no address decides an order.
    known: BTreeMap<*const Group, u32>,
}

impl Builder {
    fn shapes(&mut self, shapes: &[Shape], placement: u32) {
        let first = self.shapes.len() as u32;
        self.shapes.extend(shapes.iter().map(Ready::new));
        self.place(first, shapes.len() as u32, placement);
    }

    fn place(&mut self, first: u32, count: u32, placement: u32) {
        self.items.extend((first..first + count).map(|shape| Item { shape, placement }));
    }

    fn groups(&mut self, groups: &[Placed], outer: &Placement) {
        for placed in groups {
            if placed.group.shape_count() == 0 {
                continue;
            }
            let placement = placed.placement.then(outer);
            let number = if placement.is_identity() || placed.group.shapes().is_empty() {
                0
            } else {
                self.placements.push(placement);
                (self.placements.len() - 1) as u32
            };
            let group = &placed.group;
            match self.known.get(&Arc::as_ptr(group)) {
                Some(&first) => self.place(first, group.shapes().len() as u32, number),
                None => {
                    self.known.insert(Arc::as_ptr(group), self.shapes.len() as u32);
                    self.shapes(group.shapes(), number);
                }
            }
            self.groups(group.groups(), &placement);
        }
    }

    fn finish(self) -> Prepared {
        let Self { shapes, placements, items, .. } = self;
        let (mut bounded, mut boxes) = (Vec::new(), Vec::new());
        let (mut unbounded, mut solids) = (Vec::new(), Vec::new());
        let mut coarsest = 0.0_f64;
        let mut listed = Listed::default();
        let is_ball = |item: &&Item| {
            item.placement == 0 && matches!(shapes[item.shape as usize].simple, Simple::Ball(_))
        };
        let lists_balls = items.iter().filter(is_ball).take(MOST_BALLS + 1).count() <= MOST_BALLS;
        for (i, item) in (0..).zip(&items) {
            let ready = &shapes[item.shape as usize];
            let placement = &placements[item.placement as usize];
            let local = ready.primitive.bounds().filter(is_finite);
            if let Some(local) = &local {
                let far = Point::from(local.min.coords.abs().sup(&local.max.coords.abs()));
                let error = 64.0 * f64::EPSILON * local.reach();
                let error = placement.error_of(&far, &placement.point(&far), error);
                coarsest = coarsest.max(error);
            }
            let bounds = local.map(|local| match item.placement {
                0 => local,
                _ => placement.bounds(&local),
            });
            let is_transparent = ready.surface.is_transparent();
            match bounds.filter(is_finite) {
                Some(_) if lists_balls && is_ball(&item) => {
                    if let Simple::Ball(ball) = ready.simple {
                        listed.add_ball(i, ball, is_transparent);
                    }
                }
                Some(bounds) => {
                    bounded.push(i);
                    boxes.push(bounds);
                }
                None => match ready.simple {
                    Simple::Plane(plane) if item.placement == 0 && listed.has_room_for_plane() => {
                        listed.add_plane(i, plane, is_transparent);
                    }
                    _ => unbounded.push(i),
                },
            }
            if ready.is_closed {
                solids.push(i);
            }
        }
        let has_transparent = shapes.iter().any(|ready| ready.surface.is_transparent());
        let hierarchy = Bvh::new(&boxes);
        Prepared {
            shapes,
            placements,
            items,
            listed,
            bounded,
            hierarchy,
            unbounded,
            solids,
            has_transparent,
            coarsest,
        }
    }
}

fn is_finite(bounds: &Bounds) -> bool {
    bounds.sides().iter().all(|side| side.is_finite())
}
