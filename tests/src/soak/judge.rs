//! Compares what the kernel says about a ray with what is exactly so.

use super::case::{Case, Entry};
use super::dd::Dd;
use super::figure::{BAND, NEAR};
use super::sample::{any_direction, power_of_ten};
use super::tally::{Tally, Wrong};
use fastrand::Rng;
use lancer_kernel::{Hit, Which};
use lancer_math::{Ray, Vector};

/// The distance is asked for to no less than this where |cos| is at least [`STEEP`].
const RELATIVE: f64 = 1e-12;
const STEEP: f64 = 1e-3;

/// How many roundings of the lengths that a ray's numbers are held against may
/// move the surface along its normal: the only bound below [`STEEP`],
/// where the ray starts nearer to the surface than a quarter of those lengths
/// (an origin that is known to a rounding knows no better how near that is), and
/// where shapes are placed (the ray's numbers in the space of the group are
/// rounded themselves).
///
/// As many come on top for each placement that a shape stands in: where it is multiplied
/// with others, its matrix and the inverse of that are rounded by 3 units of their terms
/// each, and by about 1 unit each when it is described; what is asked is where the
/// matrix puts a shape, and what is used is the inverse.
const ROUNDINGS: f64 = 8.0;

/// Whether a surface is ahead of a ray or behind it may be found either way where
/// the origin is so many roundings away from it.
const AT_ORIGIN: f64 = 16.0;

/// Normals of two faces of a shape differ by more.
const FLAT: f64 = 1e-6;

/// Half the distance of two neighbouring doubles in [1, 2).
const ROUNDING: f64 = f64::EPSILON / 2.0;

impl Entry {
    /// The lengths by which roundings count at the crossing.
    fn reach(&self) -> f64 {
        self.reach_at(self.crossing.t.round())
    }

    fn reach_at(&self, t: f64) -> f64 {
        self.line.scale + self.line.growth * t.abs() * self.line.length
    }

    fn is_sure(&self) -> bool {
        self.crossing.is_there && self.crossing.margin >= BAND
    }

    fn is_doubtful(&self) -> bool {
        self.crossing.margin < BAND
    }

    fn is_ahead(&self) -> bool {
        self.crossing.t.is_positive()
    }

    /// Where the ray leaves a surface by some distance, the others that meet it there
    /// are as near.
    fn is_at_origin(&self, left: Option<Left>) -> bool {
        let along = self.crossing.t.round().abs() * self.line.length * self.local_cosine;
        let by = match left {
            Some(left) if (left.item, left.part) == (self.item, self.crossing.part) => {
                return false;
            }
            Some(left) => 2.0 * left.by * self.shrinking,
            None => 0.0,
        };
        along.max(self.from_origin) <= by + AT_ORIGIN * ROUNDING * self.reach()
    }

    /// Whether the ray leaves this part of the surface within roundings of an edge, where
    /// another one begins: which of them is crossed there, and whether ahead or behind, nobody
    /// knows. That other one is met at no distance, by rays that are flat to it.
    fn is_left_at_edge(&self, case: &Case, left: Option<Left>) -> bool {
        left.is_some_and(|left| {
            let within = 2.0 * left.by * self.shrinking + AT_ORIGIN * ROUNDING * self.line.scale;
            let origin = self.line.at(Dd::from(0.0));
            let near = case.subject(self.item).figure.parts_near(origin, within);
            (left.item, left.part) == (self.item, self.crossing.part)
                && near.iter().any(|part| *part != left.part)
        })
    }

    /// Whether the surface that is met there is turned away from this part of it.
    fn is_of_another(&self, case: &Case, ray: &Ray, hit: &Hit) -> bool {
        let surface = case.prepared.expand(ray, hit);
        let (_, normal) = self.side(case, self.crossing.part, surface.point);
        (surface.normal - normal / normal.norm()).norm() > FLAT
    }

    /// Whether the distance must be right to [`RELATIVE`], whatever the roundings.
    fn is_plain(&self, case: &Case) -> bool {
        case.frame(self.item).is_identity && self.is_far()
    }

    fn is_far(&self) -> bool {
        self.crossing.t.round().abs() * self.line.length >= self.line.size / 4.0
    }

    fn tolerance(&self, case: &Case) -> f64 {
        let relative = RELATIVE * self.crossing.t.round().abs();
        let roundings = ROUNDINGS * (1 + case.depth(self.item)) as f64;
        let rounding = roundings * ROUNDING * self.reach() / (self.local_cosine * self.line.length);
        let is_strict = self.cosine >= STEEP && self.is_plain(case);
        self.crossing.slack + if is_strict { relative.min(rounding) } else { rounding }
    }

    fn off(&self, t: f64) -> f64 {
        (self.crossing.t - Dd::from(t)).abs().round()
    }

    /// Whether this is what was found at `t`: where it is not sure, a place near the
    /// surface is enough.
    fn is_found_at(&self, case: &Case, t: f64) -> bool {
        if self.crossing.is_there && self.off(t) <= self.tolerance(case) {
            return true;
        }
        let (figure, place) = (&case.subject(self.item).figure, self.line.at(Dd::from(t)));
        let near = 4.0 * BAND * self.reach_at(t);
        self.crossing.margin < BAND
            && figure.side(self.crossing.part, place).round().abs() <= near
            && figure.off(place) <= near
    }
}

/// Whether something that a ray meets is within sixteen bounds of a decision.
pub(crate) fn is_close(entries: &[Entry]) -> bool {
    entries.iter().any(|e| e.crossing.margin < NEAR)
}

/// A ray, and what it was made to start off from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Asked {
    pub(crate) ray: Ray,
    pub(crate) left: Option<Left>,
}

/// What a ray was made to start off from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Left {
    item: u32,
    part: usize,
    by: f64,
    /// To the outside of a closed shape.
    goes_out: bool,
}

impl Left {
    /// The closed item whose outside it leaves.
    pub(crate) fn outside(&self) -> Option<u32> {
        self.goes_out.then_some(self.item)
    }
}

/// Holds what the kernel says of a ray against its crossings. Returned is a ray that
/// leaves the hit.
pub(crate) fn judge(
    case: &Case,
    asked: &Asked,
    (hit, entries): (Option<Hit>, &[Entry]),
    rng: &mut Rng,
    tally: &mut Tally,
) -> Option<Asked> {
    let ray = &asked.ray;

    let is_open = |e: &Entry| e.is_at_origin(asked.left);
    let needed = |e: &&Entry| e.is_sure() && e.is_ahead() && !is_open(e);
    let first = entries.iter().find(needed);
    let until = first.map_or(f64::INFINITY, |e| e.crossing.t.round());
    let doubtful =
        |e: &Entry| e.crossing.t.round() < until && (is_open(e) || e.is_doubtful() && e.is_ahead());
    if entries.iter().any(doubtful) {
        tally.in_band();
    }
    let mut next = None;
    let Some(hit) = hit else {
        if let Some(first) = first {
            tally.fail(case, ray, first, "misses", None);
        } else if let Some(e) =
            entries.iter().find(|e| e.crossing.is_there && e.is_ahead() && !is_open(e))
        {
            tally.widen(e);
        }
        all(case, asked, entries, None, tally);
        return None;
    };
    let may_be = |e: &&Entry| {
        let ahead = e.is_ahead()
            || is_open(e)
            || e.is_doubtful() && asked.left.is_none()
            || e.is_left_at_edge(case, asked.left) && e.is_of_another(case, ray, &hit);
        e.item == hit.item && ahead && e.is_found_at(case, hit.t)
    };
    let found: Vec<&Entry> = entries.iter().filter(may_be).collect();
    if let Some(first) = first
        && until + first.tolerance(case) < hit.t
    {
        tally.fail(case, ray, first, "finds too late", Some(&hit));
    } else if found.is_empty() {
        let is_own = asked.left.is_some_and(|left| left.item == hit.item);
        let wrong = if is_own { Wrong::SelfHit } else { Wrong::False };
        tally.complain(case, ray, wrong, format!("finds what is not there: {hit:?}"));
    } else {
        if found.iter().all(|e| !e.crossing.is_there) {
            tally.widen(found[0]);
        }
        let nearest = found.iter().filter(|e| e.is_sure());
        let off = |e: &&&Entry| e.off(hit.t);
        if let Some(e) = nearest.min_by(|a, b| off(a).total_cmp(&off(b))) {
            let off = (e.off(hit.t) - e.crossing.slack).max(0.0);
            let ulps = off * e.line.length / (e.reach() * f64::EPSILON);
            let of_bound = off / (e.tolerance(case) - e.crossing.slack);
            tally.distance(if e.cosine >= 0.1 { ulps } else { 0.0 }, of_bound);
        }
        let part = contact(case, ray, &hit, &found, tally).filter(|_| asked.left.is_none());
        // Every other time.
        let part = part.filter(|_| rng.bool());
        next = part.and_then(|part| leave(case, ray, &hit, (found[0], part), rng, tally));
    }
    all(case, asked, entries, Some(hit), tally);
    next
}

/// What [`Prepared::all`](lancer_kernel::Prepared::all) and `any` say.
fn all(case: &Case, asked: &Asked, entries: &[Entry], hit: Option<Hit>, tally: &mut Tally) {
    let ray = &asked.ray;
    let hits = case.prepared.all(ray, (f64::NEG_INFINITY, f64::INFINITY), Which::All);
    // Those at the origin are before it for the one and behind it for the other.
    let is_open = |h: &Hit| {
        let own = |e: &&Entry| e.item == h.item && e.is_found_at(case, h.t);
        let is_open = |e: &Entry| e.is_at_origin(asked.left) || e.is_left_at_edge(case, asked.left);
        entries.iter().filter(own).any(is_open)
    };
    let ahead = hits.iter().find(|h| h.t > 0.0);
    if ahead.map(|h| (h.t, h.item)) != hit.map(|h| (h.t, h.item)) && !ahead.is_some_and(is_open) {
        let what = format!("`nearest` finds {hit:?}, `all` {ahead:?}");
        tally.complain(case, ray, Wrong::Disagreement, what);
    }
    if let Some(hit) = hit {
        let any = |t_max| case.prepared.any(ray, t_max, Which::All);
        // A box that holds it may seem to begin a few roundings later.
        let own = entries.iter().filter(|e| e.item == hit.item && e.is_found_at(case, hit.t));
        let later = own.map(|e| e.tolerance(case)).fold(0.0, f64::max);
        let (nearer, there) = (any(hit.t), any((hit.t + later).next_up()));
        if nearer || !there {
            let what = format!("nearest is {hit:?}; `any` up to it: {nearer}, with it: {there}");
            tally.complain(case, ray, Wrong::Disagreement, what);
        }
    }
    for e in entries.iter().filter(|e| e.is_sure()) {
        if !hits.iter().any(|h| h.item == e.item && e.is_found_at(case, h.t)) {
            tally.fail(case, ray, e, "leaves out of all", None);
        }
    }
    for h in &hits {
        if !entries.iter().any(|e| e.item == h.item && e.is_found_at(case, h.t)) {
            let what = format!("counts among all what is not there: {h:?}");
            tally.complain(case, ray, Wrong::False, what);
        }
    }
    for item in (0..case.item_count()).filter(|&i| case.subject(i).figure.is_closed()) {
        let of_item: Vec<_> = hits.iter().filter(|h| h.item == item).collect();
        let found_ahead = of_item.iter().filter(|h| h.t > 0.0).count();
        let own = || entries.iter().filter(|e| e.item == item);
        let really_ahead = own().filter(|e| e.crossing.is_there && e.is_ahead()).count();
        let is_open = |e: &Entry| e.is_at_origin(asked.left) || e.is_left_at_edge(case, asked.left);
        let is_clear = own().all(|e| !is_open(e));
        if of_item.len() % 2 == 1 || is_clear && (found_ahead + really_ahead) % 2 == 1 {
            let what = format!("closed item {item} is crossed an odd number of times: {of_item:?}");
            tally.complain(case, ray, Wrong::Other, what);
        }
    }
}

/// The point of a hit and the normal there. Near an edge it may be that of either
/// surface; returned is the one that it is, if it has a normal.
fn contact(
    case: &Case,
    ray: &Ray,
    hit: &Hit,
    found: &[&Entry],
    tally: &mut Tally,
) -> Option<usize> {
    let surface = case.prepared.expand(ray, hit);
    let mut worst = Vec::new();
    let (e, figure) = (found[0], &case.subject(hit.item).figure);
    let place = e.line.at(Dd::from(hit.t));
    let near = figure.parts_near(place, 4.0 * BAND * e.reach());
    for part in found.iter().map(|e| e.crossing.part).chain(near) {
        let (side, normal) = e.side(case, part, surface.point);
        let length = normal.norm();
        if length == 0.0 && side.abs() <= surface.error {
            // Where a ring has closed its hole, all normals meet.
            return None;
        }
        let unit = normal / length;
        // In a box of that half side around the point there is one of the surface.
        let bound = surface.error * unit.lp_norm(1);
        let off = side.abs() / length;
        let turned = (surface.normal - unit).norm();
        // Near a tip and on tubes that are thin for where they are, the normal turns
        // within the error of the point.
        let turns = |by: Vector| {
            let (_, other) = e.side(case, part, surface.point + by * surface.error);
            (other / other.norm() - unit).norm()
        };
        let spread = || {
            let around = [Vector::x(), Vector::y(), Vector::z()];
            around.iter().flat_map(|v| [turns(*v), turns(-v)]).fold(0.0, f64::max)
        };
        if off <= bound && (turned <= 1e-9 || turned <= 1e-9 + 2.0 * spread()) {
            tally.contact(off / bound, turned, surface.error / e.reach());
            return Some(part);
        }
        worst.push(format!("{off:e} off, allowed {bound:e}; normal {turned:e} off"));
    }
    let what = format!("{hit:?} expands to {:?}: {}", surface.point, worst.join(" or "));
    tally.complain(case, ray, Wrong::Other, what);
    None
}

/// A ray that leaves a hit in any direction starts on the side to which it goes.
fn leave(
    case: &Case,
    ray: &Ray,
    hit: &Hit,
    (e, part): (&Entry, usize),
    rng: &mut Rng,
    tally: &mut Tally,
) -> Option<Asked> {
    let surface = case.prepared.expand(ray, hit);
    let direction = any_direction(rng) * power_of_ten(rng, -1.0, 1.0);
    let out = surface.leave(direction);
    let (side, normal) = e.side(case, part, out.origin);
    let goes_out = direction.dot(&surface.normal) >= 0.0;
    // In the tip of a cone there is no room for that.
    let is_tip = (normal / normal.norm() - surface.normal).norm() > 0.1;
    if is_tip {
        return None;
    }
    if side == 0.0 || goes_out != (side > 0.0) {
        let what = format!("leaving {hit:?} along {direction:?} starts {side:e} off the surface");
        tally.complain(case, ray, Wrong::Other, what);
    }
    let goes_out = goes_out && case.subject(hit.item).figure.is_closed();
    let left = Left { item: hit.item, part, by: 2.0 * surface.error, goes_out };
    Some(Asked { ray: out, left: Some(left) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::soak::class::Class;
    use crate::soak::id::Id;
    use crate::soak::kind::Kind;

    /// Right answers pass; of each that is wrong it is said in which way.
    #[test]
    fn wrong_answers_are_seen() {
        for kind in [Kind::Sphere, Kind::Cuboid, Kind::Torus, Kind::ClosedMesh] {
            let id = Id { kind, seed: 1, case: 0, ray: 0, is_left: false };
            let case = Case::new(kind, id.case_seed(), 0);
            let judged = |ray: &Ray, hit: Option<Hit>| {
                let mut tally = Tally::default();
                tally.begin(id, Class::Ordinary, hit.is_some());
                let rng = &mut Rng::with_seed(1);
                let asked = Asked { ray: *ray, left: None };
                judge(&case, &asked, (hit, &case.crossings(ray)), rng, &mut tally);
                tally.total()
            };
            let mut seen = 0;
            for seed in 0..100 {
                // The first class of rays is the ordinary one.
                let (ray, _) = case.ray(&mut Rng::with_seed(seed), 0);
                let hit = case.prepared.nearest(&ray, f64::INFINITY);
                assert_eq!(judged(&ray, hit).failures(), 0, "{kind:?} {seed}");
                let Some(hit) = hit else { continue };
                seen += 1;
                assert_eq!(judged(&ray, None).misses, 1, "{kind:?} {seed}");
                let at = |t| Some(Hit { t, ..hit });
                assert_eq!(judged(&ray, at(hit.t * (1.0 - 1e-9))).false_hits, 1, "{kind:?} {seed}");
                assert_eq!(judged(&ray, at(hit.t * (1.0 + 1e-9))).misses, 1, "{kind:?} {seed}");
            }
            assert!(seen > 20, "{kind:?} {seen}");
        }
    }
}
