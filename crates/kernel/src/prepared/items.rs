//! From an item's number back to what it is.

use super::Prepared;
use super::looks::Look;
use super::space::{Content, Entry, Kept};
use super::walk::Place;
use crate::primitive::Primitive;
use crate::{Crossing, Hit, SurfacePoint};
use lancer_math::{Point, Ray};
use lancer_scene::Surface;
use std::cmp::Ordering;

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
        match space.own[self.shape as usize].kept() {
            Kept::Ball(block, lane) => ask(&space.balls.blocks[block].ball(lane)),
            Kept::Other(index) => ask(&*space.others[index].primitive),
        }
    }
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
        let (contact, albedo) = item.primitive(|primitive| {
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
            shape: item.place.space.first_shape + item.shape,
            item: hit.item,
        };
        if !item.place.is_world {
            surface.place(&item.place.placement);
        }
        surface
    }

    /// What an item looks like.
    ///
    /// # Panics
    /// Where there is no such item.
    #[must_use]
    pub fn surface(&self, item: u32) -> &Surface {
        let mut space = &self.root;
        let mut local = item;
        loop {
            if let Some(own) = space.own.get(local as usize) {
                return &self.looks[own.look as usize].surface;
            }
            let after = space.placed.partition_point(|stand| stand.first <= local);
            let stand = &space.placed[after - 1];
            local -= stand.first;
            space = &self.spaces[stand.space as usize];
        }
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
        self.solids_in(&Place::world(&self.root), point, &mut solids);
        solids.sort_unstable();
        solids
    }

    fn solids_in(&self, place: &Place<'_>, point: &Point, solids: &mut Vec<u32>) {
        let space = place.space;
        if !space.holds.solid {
            return;
        }
        let local = if place.is_world { *point } else { place.placement.local_point(point) };
        for (block, names) in space.balls.blocks.iter().zip(&space.balls.names) {
            for lane in crate::lanes::lanes_of(u32::from(names.transparent)) {
                let shape = names.shapes[lane];
                let look = &self.looks[space.own[shape as usize].look as usize];
                if look.surface.has_medium() && block.ball(lane).contains(&local) {
                    solids.push(place.first + shape);
                }
            }
        }
        let mut enter = |entry: &Entry| match entry.content() {
            Content::Other(index) => {
                let other = &space.others[index];
                if other.is_solid && other.primitive.contains(&local) {
                    solids.push(place.first + other.shape);
                }
            }
            Content::Placed(index) => {
                self.solids_in(&place.inside(&space.placed[index], &self.spaces), point, solids);
            }
        };
        space.unbounded.iter().for_each(&mut enter);
        space.bounded.iter().for_each(&mut enter);
    }
}
