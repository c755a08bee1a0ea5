//! The rays of a pixel as lines in space.

use super::Explained;
use lancer_integrator::{LightFate, RayKind, RayTree};
use std::fmt::Write;

/// A place in space.
pub(super) type Place = [f64; 3];

/// What a line is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Ray(RayKind),
    /// From a surface to a light, or to what hides it.
    Shadow,
}

impl Kind {
    pub(super) const ALL: [Self; 4] = [
        Self::Ray(RayKind::Primary),
        Self::Ray(RayKind::Reflected),
        Self::Ray(RayKind::Transmitted),
        Self::Shadow,
    ];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Ray(kind) => kind.name(),
            Self::Shadow => "shadow",
        }
    }
}

/// A ray from where it starts to where it ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    pub(super) kind: Kind,
    pub(super) from: Place,
    pub(super) to: Place,
    /// The share that it has in the pixel, from 0 to 1; of a shadow ray that of the one whose end it
    /// leaves from.
    pub(super) size: f64,
    /// The light whose place it ends at, counted from 1.
    pub(super) light: Option<usize>,
}

/// Rays that never end are so long, as a part of the extent of all others.
const ENDLESS: f64 = 0.3;

fn ahead(from: Place, direction: Place, length: f64) -> Place {
    [0, 1, 2].map(|i| from[i] + length * direction[i])
}

/// All rays that were followed, and those to lights; without those that finite numbers do not tell.
pub(super) fn lines(tree: &RayTree) -> Vec<Line> {
    let endless = endless(tree);
    let mut lines = Vec::new();
    for ray in tree.rays.iter().filter(|ray| ray.distance.is_some() || ray.background.is_some()) {
        let length = ray.distance.unwrap_or(endless);
        lines.push(Line {
            kind: Kind::Ray(ray.kind),
            from: ray.origin,
            to: ahead(ray.origin, ray.direction, length),
            size: ray.size(),
            light: None,
        });
        for answer in ray.surfaces.iter().flat_map(|surface| &surface.lights) {
            let Some(shadow) = answer.shadow else { continue };
            let arrives = matches!(answer.fate, LightFate::Arrives(_));
            lines.push(Line {
                kind: Kind::Shadow,
                from: shadow.origin,
                to: ahead(shadow.origin, shadow.direction, shadow.length.unwrap_or(endless)),
                size: ray.size(),
                light: (arrives && shadow.length.is_some()).then_some(answer.light),
            });
        }
    }
    lines.retain(|line| line.from.iter().chain(&line.to).all(|c| c.is_finite()));
    lines
}

/// How long a ray is drawn that sees the background or a sun.
fn endless(tree: &RayTree) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let ends = tree.rays.iter().flat_map(|ray| [Some(ray.origin), ray.end()]).flatten();
    for place in ends {
        for i in 0..3 {
            (low[i], high[i]) = (low[i].min(place[i]), high[i].max(place[i]));
        }
    }
    let squared: f64 = (0..3).map(|i| (high[i] - low[i]) * (high[i] - low[i])).sum();
    let length = ENDLESS * squared.sqrt();
    // The primary ray alone has no extent.
    if length > 0.0 && length.is_finite() { length } else { 1.0 }
}

/// The rays as an OBJ file: an object for each kind, a line for each ray.
pub(super) fn obj(explained: &Explained) -> String {
    let lines = lines(&explained.tree);
    let mut text = format!("# Rays of {}\n", explained.title());
    let mut count = 0;
    for kind in Kind::ALL {
        let mut is_first = true;
        for line in lines.iter().filter(|line| line.kind == kind) {
            // Writing to a string does not fail.
            if is_first {
                let _ = writeln!(text, "o {}", kind.name());
            }
            for [x, y, z] in [line.from, line.to] {
                let _ = writeln!(text, "v {x} {y} {z}");
            }
            let _ = writeln!(text, "l {} {}", count + 1, count + 2);
            (count, is_first) = (count + 2, false);
        }
    }
    text
}
