//! All that a scene shows.

use crate::{Crossing, Line, Number, Place, Space, Triple, crossings, inside};
use lancer_scene::{Geometry, Placed, Scene, Shape, Surface};

/// A shape where it stands.
#[derive(Clone, Debug)]
pub struct Item<'a> {
    /// What it is.
    pub shape: &'a Shape,
    /// Where.
    pub space: Space,
}

/// The shapes of a scene, those of groups as often as they are shown: first those
/// that stand by themselves, then those of each group in the same order.
#[derive(Clone, Debug)]
pub struct World<'a> {
    items: Vec<Item<'a>>,
    bits: usize,
}

/// What a line meets, and of which item.
#[derive(Clone, Debug)]
pub struct Hit {
    /// The item's place in the list.
    pub item: usize,
    /// Where it is met.
    pub crossing: Crossing,
}

/// The answer to a question about all items.
#[derive(Clone, Debug)]
pub struct Hits {
    /// In the order of t; of the same t, in the order of the items.
    pub list: Vec<Hit>,
    /// The smallest margin of an item.
    pub margin: f64,
}

impl<'a> World<'a> {
    /// What `scene` shows, to be met with so many bits.
    #[must_use]
    pub fn new(scene: &'a Scene, bits: usize) -> Self {
        let mut items = vec![];
        gather(&scene.shapes, &scene.groups, &Space::world(), &mut items);
        Self { items, bits }
    }

    /// The items, in order.
    #[must_use]
    pub fn items(&self) -> &[Item<'a>] {
        &self.items
    }

    /// With how many bits places are found.
    #[must_use]
    pub fn bits(&self) -> usize {
        self.bits
    }

    /// All that the line meets on either side of its origin.
    #[must_use]
    pub fn all(&self, line: &Line) -> Hits {
        let (mut list, mut margin) = (vec![], f64::INFINITY);
        for (number, item) in self.items.iter().enumerate() {
            let found = crossings(&item.shape.geometry, &item.space, line, self.bits);
            margin = margin.min(found.margin);
            list.extend(found.list.into_iter().map(|crossing| Hit { item: number, crossing }));
        }
        list.sort_by(|a, b| a.crossing.t.cmp(&b.crossing.t));
        Hits { list, margin }
    }

    /// The nearest hit with t above 0, and all others that are as near, up to the
    /// last few of the bits. None where nothing is in front.
    #[must_use]
    pub fn nearest(&self, line: &Line) -> Hits {
        let mut hits = self.all(line);
        hits.list.retain(|hit| hit.crossing.t.signum() > 0);
        if let Some(first) = hits.list.first() {
            let slack = Number::power_of_two(16 - i32::try_from(self.bits).unwrap_or(i32::MAX));
            let last = &first.crossing.t + &first.crossing.t * slack;
            hits.list.retain(|hit| hit.crossing.t <= last);
        }
        hits
    }

    /// What is met with t between 0 and `end`, both left out.
    #[must_use]
    pub fn between(&self, line: &Line, end: &Number) -> Hits {
        let mut hits = self.all(line);
        hits.list.retain(|hit| hit.crossing.t.signum() > 0 && hit.crossing.t < *end);
        hits
    }

    /// The items that a point is in.
    #[must_use]
    pub fn around(&self, point: &Triple) -> Vec<usize> {
        let holds = |item: &Item<'_>| {
            inside(&item.shape.geometry, &item.space, point) == Some(Place::Inside)
        };
        (0..self.items.len()).filter(|number| holds(&self.items[*number])).collect()
    }
}

impl Item<'_> {
    /// Where its points are, in its own space.
    #[must_use]
    pub fn geometry(&self) -> &Geometry {
        &self.shape.geometry
    }

    /// What it looks like.
    #[must_use]
    pub fn surface(&self) -> &Surface {
        &self.shape.surface
    }
}

fn gather<'a>(shapes: &'a [Shape], groups: &'a [Placed], space: &Space, items: &mut Vec<Item<'a>>) {
    items.extend(shapes.iter().map(|shape| Item { shape, space: space.clone() }));
    for placed in groups {
        let inner = space.inside(&placed.placement);
        gather(placed.group.shapes(), placed.group.groups(), &inner, items);
    }
}
