use crate::bvh::Bvh;
use crate::primitive::{Cell, Primitive};
use crate::shapes::primitive;
use crate::{Hit, KernelSettings, SurfacePoint};
use lancer_math::{Bounds, Placement, Point, Ray};
use lancer_scene::{Group, Pattern, Placed, Scene, Shape, Surface};
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::sync::Arc;

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
    /// Items that a box holds, and the hierarchy of their boxes.
    bounded: Vec<u32>,
    hierarchy: Bvh,
    /// The others; a ray is held against each.
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
    /// The colour's shares, and those of a checker.
    albedo: [f64; 3],
    second: [f64; 3],
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
    fn new(shape: &Shape, settings: &KernelSettings) -> Self {
        let surface = shape.surface;
        let albedo = surface.colour.shares();
        let second = match surface.pattern {
            Pattern::Solid => albedo,
            Pattern::Checker(checker) => checker.second.shares(),
        };
        Self {
            primitive: primitive(&shape.geometry, settings),
            surface,
            // A mesh finds out by looking at all its edges: only where it matters.
            is_closed: surface.has_medium() && shape.geometry.is_closed(),
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
        let mut best: Option<Hit> = None;
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
        let mut to = t_max;
        for &item in &self.unbounded {
            to = consider(item, to);
        }
        self.hierarchy.visit(ray, 0.0, to, |i, to| consider(self.bounded[i], to));
        best
    }

    /// The only shape there is, where it stands as it is.
    pub(crate) fn only_shape(&self) -> Option<&dyn Primitive> {
        match self.items[..] {
            [Item { shape, placement: 0 }] => Some(&*self.shapes[shape as usize].primitive),
            _ => None,
        }
    }

    /// Whether there is a hit with 0 < t < `t_max` among some items.
    #[must_use]
    pub fn any(&self, ray: &Ray, t_max: f64, which: Which) -> bool {
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
        self.shapes
            .extend(shapes.iter().map(|shape| Ready::new(shape, &KernelSettings::default())));
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
            match bounds.filter(is_finite) {
                Some(bounds) => {
                    bounded.push(i);
                    boxes.push(bounds);
                }
                None => unbounded.push(i),
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
