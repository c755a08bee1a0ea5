//! From an item's number back to what it is.

use super::Prepared;
use super::looks::Look;
use super::space::{Content, Entry, Kept, Kind};
use super::walk::{Place, Walk};
use crate::hierarchy::Stack;
use crate::lanes::{One, lanes_of};
use crate::primitive::Primitive;
use crate::{Crossing, Hit, SurfacePoint};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::Surface;
use std::cmp::Ordering;
use std::ops::ControlFlow;

/// An item: a shape where it stands.
struct Item<'a> {
    place: Place<'a>,
    /// Its number among the shapes of its group.
    shape: u32,
    look: &'a Look,
}

impl Item<'_> {
    /// What `ask` says of its shape.
    #[inline]
    fn primitive<R>(&self, ask: impl FnOnce(&dyn Primitive) -> R) -> R {
        let space = self.place.space;
        match space.own[self.shape as usize].kept {
            Kept::Sphere(spot) => ask(&space.spheres.ball(spot)),
            Kept::Other(index) => ask(space.others[index as usize].primitive.get()),
        }
    }
}

/// A number of a unit vector that is the same for those that are about so many steps of 1
/// apart. What is amid a step are zeros, halves and ones, of which roundings do not
/// matter.
fn coarse(v: &Vector, steps: f64) -> u64 {
    let [x, y, z] = [v.x, v.y, v.z].map(|c| (c * steps + (steps + 0.5)) as u64);
    (x << 42) | (y << 21) | z
}

impl Prepared {
    /// # Panics
    /// Where there is no such item.
    fn item(&self, number: u32) -> Item<'_> {
        let mut place = Place::world(&self.root);
        loop {
            let local = number - place.first;
            if let Some(own) = place.space.own.get(local as usize) {
                return Item { place, shape: local, look: &self.looks[own.look as usize] };
            }
            // The last that begins no later: none is without items.
            let after = place.space.placed.partition_point(|stand| stand.first <= local);
            place = place.inside(&place.space.placed[after - 1], &self.spaces);
        }
    }

    /// The point of a hit that this ray has, with all that shading needs.
    ///
    /// # Panics
    /// Where there is no such item.
    #[must_use]
    pub fn expand(&self, ray: &Ray, hit: &Hit) -> SurfacePoint<'_> {
        let item = self.item(hit.item);
        let local = item.place.local(ray);
        let crossing = Crossing { t: hit.t, part: hit.part };
        let (contact, (albedo, cell)) = item.primitive(|primitive| {
            let contact = primitive.contact(&local, &crossing);
            (contact, item.look.albedo(primitive, &contact, hit.part))
        });
        let mut surface = SurfacePoint {
            point: contact.point,
            error: contact.error,
            normal: contact.normal,
            shading: contact.shading,
            surface: &item.look.surface,
            albedo,
            cell,
            shape: item.place.space.first_shape + item.shape,
            item: hit.item,
            part: hit.part,
        };
        if !item.place.is_world {
            surface.place(&item.place.placement);
        }
        surface
    }

    /// A number for each piece of an item's surface that is smooth: points of one item with
    /// different ones have an edge between them. Of meshes facets in one plane are one
    /// piece, and what has normals of its own is one of about a hundred by where they
    /// point, so that creases and what stands in front of itself are told as well.
    ///
    /// # Panics
    /// Where there is no such item.
    #[must_use]
    pub fn patch(&self, point: &SurfacePoint<'_>) -> u64 {
        let item = self.item(point.item);
        let Kept::Other(index) = item.place.space.own[item.shape as usize].kept else { return 0 };
        match &item.place.space.others[index as usize].primitive {
            Kind::Mesh(mesh) if mesh.is_smooth() => coarse(&point.shading, 2.0),
            // Facets in one plane are a few roundings apart.
            Kind::Mesh(_) => coarse(&point.normal, 524_288.0),
            Kind::Any(_) => u64::from(point.part),
        }
    }

    /// What an item looks like.
    ///
    /// # Panics
    /// Where there is no such item.
    #[must_use]
    pub fn surface(&self, item: u32) -> &Surface {
        &self.look(item).surface
    }

    fn look(&self, item: u32) -> &Look {
        let mut space = &self.root;
        let mut local = item;
        loop {
            if let Some(own) = space.own.get(local as usize) {
                return &self.looks[own.look as usize];
            }
            let after = space.placed.partition_point(|stand| stand.first <= local);
            let stand = &space.placed[after - 1];
            local -= stand.first;
            space = &self.spaces[stand.space as usize];
        }
    }

    /// The number of an item's shape in the description: that of
    /// [`SurfacePoint::shape`].
    ///
    /// # Panics
    /// Where there is no such item.
    #[must_use]
    pub fn shape(&self, item: u32) -> u32 {
        let item = self.item(item);
        item.place.space.first_shape + item.shape
    }

    /// The two colours of an item; the same where it has no checker.
    ///
    /// # Panics
    /// Where there is no such item.
    #[must_use]
    pub fn albedos(&self, item: u32) -> [[f64; 3]; 2] {
        self.look(item).albedos()
    }

    /// Whose medium a point is in that is in both: that of the higher priority;
    /// of the same, the one with the smaller volume; of the same again, the one
    /// that comes later.
    ///
    /// # Panics
    /// Where there are no such items.
    #[must_use]
    pub fn rank(&self, a: u32, b: u32) -> Ordering {
        let volume = |number: u32| {
            let item = self.item(number);
            let own = item.primitive(|primitive| primitive.volume());
            let volume = own * item.place.placement.volume_factor();
            // To 28 bits, rounded: a turn changes the last ones. Bits of positive
            // numbers are ordered as the numbers are.
            (volume.to_bits() + (1 << 23)) >> 24
        };
        let (one, other) = (self.surface(a).priority, self.surface(b).priority);
        one.cmp(&other).then_with(|| volume(b).cmp(&volume(a))).then(a.cmp(&b))
    }

    /// The items filled with a medium that `point` is in, in their order.
    #[must_use]
    pub fn solids_at(&self, point: &Point) -> Vec<u32> {
        let mut solids = Vec::new();
        // Any direction serves: the ray goes nowhere.
        let walk = Walk::new(self, &Ray::new(*point, Vector::new(1.0, 1.0, 1.0)));
        self.solids_in(&Place::world(&self.root), &walk, &mut solids);
        solids.sort_unstable();
        solids
    }

    fn solids_in(&self, place: &Place<'_>, walk: &Walk<'_>, solids: &mut Vec<u32>) {
        let space = place.space;
        let ray = place.local(&walk.ray);
        let point = &ray.origin;
        if space.spheres.holds.solid {
            space.spheres.around(point, |shape, ball| {
                let look = &self.looks[space.own[shape as usize].look as usize];
                if look.surface.has_medium() && ball.contains(point) {
                    solids.push(place.first + shape);
                }
            });
        }
        let mut enter = |entry: Entry| match entry.content() {
            Content::Other(index) => {
                let other = &space.others[index];
                if other.is_solid && other.primitive.get().contains(point) {
                    solids.push(place.first + other.shape);
                }
            }
            Content::Placed(index) => {
                let stand = &space.placed[index];
                if stand.holds.solid {
                    self.solids_in(&place.inside(stand, &self.spaces), walk, solids);
                }
            }
        };
        for planes in &space.planes {
            for lane in lanes_of(planes.transparent) {
                let shape = planes.shapes[lane];
                if let Kept::Other(index) = space.own[shape as usize].kept {
                    enter(Entry::other(index as usize));
                }
            }
        }
        space.unbounded.iter().copied().for_each(&mut enter);
        space.hierarchy.visit(
            One,
            &mut Stack::new(),
            &ray,
            walk.margin(place),
            (0.0, 0.0),
            |places, to| {
                space.bounded[places].iter().copied().for_each(&mut enter);
                ControlFlow::Continue(to)
            },
        );
    }
}
