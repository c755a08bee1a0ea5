//! Where a ray stops, and the media on both sides.
//!
//! Which media are at a place is not remembered from what was crossed before, but
//! found by asking each solid whether the middle between two stops is in it.

use crate::{Crossing, Hit, Line, Number, Place, Triple, World, inside};
use lancer_scene::{Geometry, Medium};

/// Surfaces whose distance across them is at most this fraction of the numbers
/// around (a few units of a double's last place) are one border: faces that touch
/// "to within rounding".
const TOGETHER: i32 = -46;

/// Those up to this far apart may be one border or two: too near for anybody who
/// computes with doubles.
const UNSURE: i32 = -30;

/// All surfaces that a ray meets at one place.
#[derive(Clone, Debug)]
pub struct Stop {
    /// How far from the ray's origin, in its directions: that of the first.
    pub t: Number,
    /// What is met there, nearest first.
    pub hits: Vec<Hit>,
    /// The solids that the ray is in before it, by their numbers.
    pub before: Vec<usize>,
    /// Those that it is in behind it, if it goes straight on.
    pub after: Vec<usize>,
}

/// The stops of a ray, in order, and how sure they are.
#[derive(Clone, Debug)]
pub(crate) struct Way {
    pub(crate) stops: Vec<Stop>,
    /// The solids beyond the last.
    pub(crate) last: Vec<usize>,
    pub(crate) margin: f64,
}

/// What a ray meets, from its origin, which may be on surfaces, up to `end` if
/// there is one. Of all stops only the first is looked for with `first_only`.
pub(crate) fn way(world: &World<'_>, line: &Line, end: Option<&Number>, first_only: bool) -> Way {
    let hits = world.all(line);
    let mut margin = hits.margin;
    let largest = line.origin.0.iter().map(Number::abs).max().unwrap_or_else(Number::zero);
    let span = |t: &Number| &largest + t.abs();
    let across = |hit: &Hit| {
        let cosine = hit.crossing.normal.dot(&line.direction).abs().to_f64();
        // Where it grazes, a curved surface is not crossed within that.
        Number::from(cosine.max(1e-8))
    };
    let mut groups: Vec<Vec<Hit>> = vec![];
    for hit in hits.list {
        let t = &hit.crossing.t;
        if t.signum() <= 0 {
            // It may be behind by a hair, and in front for others.
            let gap = t.abs() * across(&hit);
            let is_start = gap <= span(t) * Number::power_of_two(TOGETHER);
            if !is_start && gap < span(t) * Number::power_of_two(UNSURE) {
                margin = 0.0;
            }
            continue;
        }
        if end.is_some_and(|end| t >= end) {
            continue;
        }
        let start = groups.last().map_or_else(Number::zero, |group| group[0].crossing.t.clone());
        let gap = (t - &start) * across(&hit);
        let together = gap <= span(t) * Number::power_of_two(TOGETHER);
        if !together && gap < span(t) * Number::power_of_two(UNSURE) {
            margin = 0.0;
        }
        if !together {
            groups.push(vec![hit]);
        } else if let Some(group) = groups.last_mut() {
            group.push(hit);
        }
    }
    let places: Vec<(Number, Number)> = groups
        .iter()
        .filter_map(|group| {
            let (first, last) = (group.first()?, group.last()?);
            Some((first.crossing.t.clone(), last.crossing.t.clone()))
        })
        .collect();
    // Whom a point between two stops is in.
    let half = Number::power_of_two(-1);
    let between = |k: usize| {
        let from = if k == 0 { Number::zero() } else { places[k - 1].1.clone() };
        let to = match places.get(k) {
            Some((to, _)) => to.clone(),
            // No solid ends beyond the last stop.
            None => end.cloned().unwrap_or_else(|| &from + Number::one() + span(&from)),
        };
        let middle = (from + to) * &half;
        solids_around(world, &line.at(&middle.rounded(64)).rounded(128))
    };
    let mut before = between(0);
    let mut stops = vec![];
    for (k, hits) in groups.into_iter().enumerate() {
        let after = between(k + 1);
        let t = hits[0].crossing.t.clone();
        stops.push(Stop { t, hits, before, after: after.clone() });
        before = after;
        if first_only {
            break;
        }
    }
    Way { stops, last: before, margin }
}

/// The solids with a medium that a point is in.
fn solids_around(world: &World<'_>, point: &Triple) -> Vec<usize> {
    let holds = |number: &usize| {
        let item = &world.items()[*number];
        item.surface().has_medium()
            && inside(item.geometry(), &item.space, point) == Some(Place::Inside)
    };
    (0..world.items().len()).filter(holds).collect()
}

/// Of some solids the one whose medium counts: of the highest priority, then of the
/// smallest volume, then the last in order.
pub(crate) fn top(world: &World<'_>, solids: &[usize]) -> Option<usize> {
    solids.iter().copied().reduce(|a, b| {
        let items = world.items();
        let priority = |k: usize| items[k].surface().priority;
        let by_priority = priority(a).cmp(&priority(b));
        let by_volume = volume(world, b).total_cmp(&volume(world, a));
        if by_priority.then(by_volume).then(a.cmp(&b)).is_gt() { a } else { b }
    })
}

/// The medium of a solid, or the air.
pub(crate) fn medium(world: &World<'_>, solid: Option<usize>) -> Medium {
    solid.map_or(Medium::AIR, |k| world.items()[k].surface().medium)
}

/// Good enough to tell which of two is the smaller one; a plane's is infinite.
fn volume(world: &World<'_>, number: usize) -> f64 {
    use std::f64::consts::PI;
    let item = &world.items()[number];
    let own = match item.geometry() {
        Geometry::Sphere(sphere) => {
            let r = sphere.radius.get();
            4.0 / 3.0 * PI * r * r * r
        }
        Geometry::Cuboid(cuboid) => (cuboid.max() - cuboid.min()).product(),
        Geometry::Tetrahedron(solid) => {
            let [a, b, c, d] = solid.corners();
            ((b - a).cross(&(c - a)).dot(&(d - a)) / 6.0).abs()
        }
        Geometry::Cone(cone) => {
            let (a, b) = (cone.base_radius(), cone.top_radius());
            PI / 3.0 * (cone.top() - cone.base()).norm() * (a * a + a * b + b * b)
        }
        Geometry::Torus(torus) => 2.0 * PI * PI * torus.ring() * torus.tube() * torus.tube(),
        Geometry::Mesh(mesh) => mesh.signed_volume().abs(),
        Geometry::Plane(_)
        | Geometry::Disc(_)
        | Geometry::Rectangle(_)
        | Geometry::Triangle(_)
        | Geometry::Custom(_) => f64::INFINITY,
    };
    own * item.space.stretch().to_f64()
}

impl Stop {
    /// The first opaque item of those that are met, and its crossing.
    pub(crate) fn opaque(&self, world: &World<'_>) -> Option<&Hit> {
        let opaque = |hit: &&Hit| !world.items()[hit.item].surface().is_transparent();
        self.hits.iter().filter(opaque).min_by_key(|hit| hit.item)
    }

    /// The thin sheets that are met, each once.
    pub(crate) fn sheets(&self, world: &World<'_>) -> Vec<&Hit> {
        let thin = |hit: &&Hit| {
            let surface = world.items()[hit.item].surface();
            surface.thin && surface.is_transparent()
        };
        self.hits.iter().filter(thin).collect()
    }

    /// The surface that is seen of the solids that begin or end here, if one of
    /// the media on both sides is its own.
    pub(crate) fn border(&self, world: &World<'_>) -> Option<(usize, &Crossing)> {
        let sides = [top(world, &self.before), top(world, &self.after)];
        let changes: Vec<usize> = self
            .hits
            .iter()
            .map(|hit| hit.item)
            .filter(|item| self.before.contains(item) != self.after.contains(item))
            .filter(|item| sides.contains(&Some(*item)))
            .collect();
        if sides[0] == sides[1] {
            return None;
        }
        let item = top(world, &changes)?;
        let hit = self.hits.iter().find(|hit| hit.item == item)?;
        Some((item, &hit.crossing))
    }
}
