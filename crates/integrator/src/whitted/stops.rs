//! Surfaces that lie so near together that no double tells them apart.
//!
//! Where a liquid touches its glass, a ray leaves the one and enters the other
//! at one place, and there is no air between them to be mirrored by. So surfaces
//! whose distances along a ray differ by no more than their error bounds are
//! crossed together, in one stop.

use super::media::Media;
use lancer_kernel::{Hit, Prepared, SurfacePoint};
use lancer_math::{Ray, Vector};

/// Surfaces that are crossed together, the nearest first.
pub(super) struct Stop<'a> {
    pub(super) t: f64,
    hits: Vec<Touch<'a>>,
}

struct Touch<'a> {
    point: SurfacePoint<'a>,
    /// The size of the cosine between ray and normal.
    cosine: f64,
    entering: bool,
    /// How far off, along the ray, the point may be.
    slack: f64,
    t: f64,
}

/// About the root of the precision of doubles: where a ray grazes a round surface
/// it is within rounding of it for so much of its radius and no more, whatever
/// the cosine is.
const GRAZING: f64 = 1e-8;

impl<'a> Touch<'a> {
    fn new(prepared: &'a Prepared, ray: &Ray, hit: &Hit) -> Self {
        let point = prepared.expand(ray, hit);
        let length = ray.direction.norm();
        let along = ray.direction.dot(&point.normal);
        let cosine = along.abs() / length;
        let slack = 4.0 * point.error / (cosine.max(GRAZING) * length);
        Self { point, cosine, entering: along < 0.0, slack, t: hit.t }
    }
}

/// The border between two media, or what hides in one.
pub(super) struct Border<'s, 'a> {
    pub(super) before: Option<u32>,
    pub(super) after: Option<u32>,
    /// The surface that is seen there and its cosine; none where the solid on
    /// both sides is the same.
    pub(super) surface: Option<(&'s SurfacePoint<'a>, f64)>,
    /// Whether the solids were entered before they were left.
    pub(super) makes_sense: bool,
}

impl<'a> Stop<'a> {
    /// The stop at a hit, with all others that are no farther than rounding.
    pub(super) fn at(prepared: &'a Prepared, ray: &Ray, hit: &Hit) -> Self {
        let first = Touch::new(prepared, ray, hit);
        // The other surface may be known less well than this one. Generous: those
        // that do not belong are sorted out below.
        let other = 4.0 * prepared.coarsest() / (first.cosine.max(GRAZING) * ray.direction.norm());
        // And beyond the hit itself, where the slack is nothing or not a number.
        let reach = (hit.t + 8.0 * (first.slack + other)).max(hit.t).next_up();
        let mut hits = prepared.all(ray, (hit.t.next_down(), reach), lancer_kernel::Which::All);
        // A shape of the user's own may find it one time and not another.
        if !hits.contains(hit) {
            hits.insert(0, *hit);
        }
        Self::gather(prepared, ray, &hits).0
    }

    /// The stop at the first of some hits, and how many of them belong to it.
    fn gather(prepared: &'a Prepared, ray: &Ray, hits: &[Hit]) -> (Self, usize) {
        let first = Touch::new(prepared, ray, &hits[0]);
        let (t, slack) = (first.t, first.slack);
        let mut touches = vec![first];
        for hit in &hits[1..] {
            let touch = Touch::new(prepared, ray, hit);
            let together = touch.t - t <= slack + touch.slack;
            if !together {
                break;
            }
            touches.push(touch);
        }
        let count = touches.len();
        (Self { t, hits: touches }, count)
    }

    /// The surface that lets no light through, if there is one: the first item
    /// of those that do not.
    pub(super) fn opaque(&self) -> Option<&SurfacePoint<'a>> {
        let opaque = self.hits.iter().filter(|touch| !touch.point.surface.is_transparent());
        opaque.min_by_key(|touch| touch.point.item).map(|touch| &touch.point)
    }

    /// The thin sheets and their cosines.
    pub(super) fn sheets(&self) -> impl Iterator<Item = (&SurfacePoint<'a>, f64)> {
        let sheets = self.hits.iter().filter(|touch| touch.point.surface.thin);
        sheets.map(|touch| (&touch.point, touch.cosine))
    }

    /// Crosses the borders of all media here. `None` where there is none.
    ///
    /// The surface that is seen is that of the solid that outranks the others,
    /// of those whose medium is on either side.
    pub(super) fn border(&self, prepared: &Prepared, media: &mut Media) -> Option<Border<'_, 'a>> {
        let solids = self.crossed();
        if solids.is_empty() {
            return None;
        }
        let mut makes_sense = true;
        let mut inside = media.clone();
        for touch in &solids {
            let item = touch.point.item;
            if media.has(item) == touch.entering {
                // What starts at an edge may do so beyond the other face there.
                if touch.t <= 2.0 * touch.slack {
                    continue;
                }
                makes_sense = false;
                // As if it had been otherwise before.
                media.cross(item, !touch.entering);
                inside.cross(item, !touch.entering);
            }
            inside.cross(item, touch.entering);
        }
        let (before, after) = (media.top(prepared), inside.top(prepared));
        *media = inside;
        let is_seen = |touch: &&Touch<'a>| {
            before != after && [before, after].contains(&Some(touch.point.item))
        };
        let surface = solids
            .into_iter()
            .filter(is_seen)
            .max_by(|a, b| prepared.rank(a.point.item, b.point.item))
            .map(|touch| (&touch.point, touch.cosine));
        Some(Border { before, after, surface, makes_sense })
    }

    /// The borders of media that are crossed. A solid that is met here an even
    /// number of times is only touched: at an edge, or where it curves away. Its
    /// touches are at one place, so their order means nothing.
    fn crossed(&self) -> Vec<&Touch<'a>> {
        let mut crossed: Vec<&Touch<'a>> = Vec::new();
        let solids = || self.hits.iter().filter(|touch| touch.point.surface.has_medium());
        for touch in solids() {
            let same = || solids().filter(|other| other.point.item == touch.point.item);
            let (met, entered) = (same().count(), same().filter(|other| other.entering).count());
            let is_new = crossed.iter().all(|other| other.point.item != touch.point.item);
            if met % 2 == 1 && is_new && touch.entering == (2 * entered > met) {
                crossed.push(touch);
            }
        }
        crossed
    }

    /// The ray that goes on as it came where no border between two media is, `more`
    /// farther off, to where those media are.
    pub(super) fn straight_on(&self, direction: Vector, media: &Media, more: f64) -> Ray {
        let point = &self.hits[0].point;
        let mut onward = point.leave_by(direction, more);
        if self.crossed().is_empty() {
            // It only touches: the surface curves away, to whichever side.
            let outward = if media.has(point.item) { -point.normal } else { point.normal };
            onward.origin = point.leave_by(outward, more).origin;
        }
        onward
    }

    /// How far apart, across the surface, the points of the surfaces are, with
    /// their errors: a ray must start so much farther off to have left them all.
    pub(super) fn thickness(&self) -> f64 {
        let (first, rest) = (&self.hits[0], &self.hits[1..]);
        rest.iter().fold(0.0, |most, touch| {
            let apart = (touch.point.point - first.point.point).norm();
            most.max(apart + 2.0 * touch.point.error)
        })
    }
}

/// The stops of some hits, nearest first.
pub(super) struct Stops<'a, 'h> {
    prepared: &'a Prepared,
    ray: &'h Ray,
    hits: &'h [Hit],
}

impl<'a, 'h> Stops<'a, 'h> {
    pub(super) const fn new(prepared: &'a Prepared, ray: &'h Ray, hits: &'h [Hit]) -> Self {
        Self { prepared, ray, hits }
    }
}

impl<'a> Iterator for Stops<'a, '_> {
    type Item = Stop<'a>;

    fn next(&mut self) -> Option<Stop<'a>> {
        if self.hits.is_empty() {
            return None;
        }
        let (stop, count) = Stop::gather(self.prepared, self.ray, self.hits);
        self.hits = &self.hits[count..];
        Some(stop)
    }
}
