//! Meshes: every triangle is asked.

use super::dd::Dd;
use super::figure::{BAND, Crossing, Figure, NEAR};
use super::sheets::Flat;
use super::space::{Line, Long};
use lancer_math::{Point, Vector};
use std::collections::BTreeMap;

#[derive(Debug)]
struct Facet {
    flat: Flat,
    /// Whether no other triangle has the edge that begins at each corner.
    is_rim: [bool; 3],
    middle: Vector,
    reach: f64,
}

/// Triangles. Those of a closed mesh look outward.
pub(crate) struct Facets {
    facets: Vec<Facet>,
    is_closed: bool,
}

/// Not its hundreds of numbers: the number of the case makes it again.
impl std::fmt::Debug for Facets {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Facets({})", self.facets.len())
    }
}

impl Facets {
    pub(crate) fn new(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Self {
        let mut uses = BTreeMap::new();
        let edges = |t: &[u32; 3]| [0, 1, 2].map(|k| (t[k], t[(k + 1) % 3]));
        let sorted = |(a, b): (u32, u32)| (a.min(b), a.max(b));
        for edge in triangles.iter().flat_map(edges) {
            *uses.entry(sorted(edge)).or_insert(0) += 1;
        }
        let facets = triangles.iter().map(|triangle| {
            let corners = triangle.map(|vertex| Point::from(positions[vertex as usize]));
            let middle = corners.iter().map(|c| c.coords).sum::<Vector>() / 3.0;
            Facet {
                flat: Flat::polygon(&corners.map(Long::from)),
                is_rim: edges(triangle).map(|edge| uses[&sorted(edge)] == 1),
                middle,
                reach: corners.iter().map(|c| (c.coords - middle).norm()).fold(0.0, f64::max),
            }
        });
        Self { facets: facets.collect(), is_closed: uses.values().all(|&count| count == 2) }
    }
}

/// A crossing with the plane of a facet, in the facet or nearly so.
struct Candidate {
    crossing: Crossing,
    is_outward: bool,
    at_rim: bool,
    /// It runs along the facet, so near that it may be on either side of it.
    is_grazing: bool,
}

impl Facets {
    fn candidates(&self, line: &Line) -> Vec<Candidate> {
        // Aside by so little that it changes no crossing, but so that the line goes
        // exactly through no edge and along no facet. Else one that goes from a
        // facet to its neighbour could be in both or in none.
        let aside = Vector::new(0.73, -0.41, 0.55);
        let by = |size: f64, v: Vector| Long::from(v).times(Dd::from(size * 1e-24));
        let line = Line {
            origin: line.origin + by(line.scale, aside),
            direction: line.direction + by(line.length, aside.yzx()),
            ..*line
        };
        let (origin, direction) = (line.origin.round(), line.direction.round() / line.length);
        let mut candidates = Vec::new();
        for (part, facet) in self.facets.iter().enumerate() {
            // Most are far away, by more than roundings.
            let to_middle = facet.middle - origin;
            let past = (to_middle - direction * to_middle.dot(&direction)).norm();
            if past > 1.001 * facet.reach + 1e-9 * line.scale {
                continue;
            }
            let Some((t, cosine)) = facet.flat.meets(&line) else { continue };
            let beyond = facet.flat.beyond(line.at(t));
            let farthest = beyond.iter().fold(f64::NEG_INFINITY, |a, &b| a.max(b));
            let share = cosine / line.scale;
            let margin = farthest.abs() * share;
            if farthest <= 0.0 || margin < NEAR {
                let mut crossing = Crossing::new(t, part, farthest <= 0.0, margin);
                crossing.slack = (4.0 * BAND * line.scale / cosine).min(line.scale) / line.length;
                let at_rim = (0..3).any(|k| facet.is_rim[k] && beyond[k].abs() * share < BAND);
                let is_outward = facet.flat.normal.dot(line.direction).is_positive();
                let is_grazing = facet.reach * share < BAND;
                candidates.push(Candidate { crossing, is_outward, at_rim, is_grazing });
            }
        }
        candidates
    }
}

impl Figure for Facets {
    fn crossings(&self, line: &Line, found: &mut Vec<Crossing>) {
        let (mut near_edges, inside): (Vec<_>, Vec<_>) =
            self.candidates(line).into_iter().partition(|c| c.crossing.margin < BAND);
        found.extend(inside.into_iter().map(|c| Crossing { slack: 0.0, ..c.crossing }));
        near_edges.sort_by(|a, b| a.crossing.t.partial_cmp(&b.crossing.t).expect("no NaN"));
        // What lies together is around one edge or corner. Where more facets are
        // crossed in one sense than in the other, the surface goes through there
        // and one of the facets must be found, whichever; else the edge is a
        // silhouette. It may be one, too, where the line runs along a facet.
        let is_grazing = near_edges.iter().any(|c| c.is_grazing);
        let together = |a: &Candidate, b: &Candidate| {
            let gap = (b.crossing.t - a.crossing.t).round();
            gap <= a.crossing.slack + b.crossing.slack
        };
        for group in near_edges.chunk_by_mut(together) {
            let there = group.iter().filter(|c| c.crossing.is_there);
            let net: i32 = there.map(|c| if c.is_outward { 1 } else { -1 }).sum();
            let slack = group.iter().map(|c| c.crossing.slack).sum::<f64>();
            let is_sure = net != 0 && !is_grazing && !group.iter().any(|c| c.at_rim);
            let needed = |c: &&mut Candidate| c.crossing.is_there && c.is_outward == (net > 0);
            if let Some(last) = group.iter_mut().rfind(needed)
                && is_sure
            {
                last.crossing.margin = f64::INFINITY;
            }
            found.extend(group.iter().map(|c| Crossing { slack, ..c.crossing }));
        }
    }

    fn side(&self, part: usize, point: Long) -> Dd {
        self.facets[part].flat.side(0, point)
    }

    fn off(&self, point: Long) -> f64 {
        let near = |f: &&Facet| (f.middle - point.round()).norm() <= 1.001 * f.reach;
        let off = self.facets.iter().filter(near).map(|f| f.flat.off(point));
        off.fold(f64::INFINITY, f64::min)
    }

    fn normal(&self, part: usize, _: Long) -> Long {
        self.facets[part].flat.normal
    }

    fn is_closed(&self) -> bool {
        self.is_closed
    }
}
