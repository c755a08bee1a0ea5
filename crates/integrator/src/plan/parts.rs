//! What runs for a scene, and what does not, in words.

use super::{Facts, Plan, Reason};
use crate::Whitted;
use lancer_kernel::{BOX_SLACK, is_met_in_lanes};
use lancer_scene::Scene;

/// A part of the machinery.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Part {
    /// What it is called.
    pub name: &'static str,
    /// Whether it runs for this scene.
    pub runs: bool,
    /// Reason it does or does not.
    pub why: String,
    /// By how much a pixel may be off for it, at most, in exposed linear units, where that is known.
    pub most: Option<f64>,
}

impl Part {
    fn new(name: &'static str, runs: bool, why: impl Into<String>) -> Self {
        Self { name, runs, why: why.into(), most: None }
    }
}

/// "1 shape", "2 shapes".
fn count(number: u64, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

impl Plan {
    /// What runs, and what does not.
    #[must_use]
    pub fn parts(&self, scene: &Scene, facts: &Facts, engine: &Whitted) -> Vec<Part> {
        let is_direct = is_met_in_lanes(scene, &self.absent);
        let mut parts = vec![acceleration(facts, is_direct), lights(scene, self)];
        if let Some(unreached) = unreached(scene, self) {
            parts.push(unreached);
        }
        if self.dropped.iter().any(|dropped| dropped.why == Reason::Dim) {
            let most = self.most();
            let why = "lights that are too dim or too far to matter are not asked";
            parts.push(Part { most: Some(most), ..Part::new("dim lights", false, why) });
        }
        parts.push(shadows(facts, self, is_direct));
        parts.push(mirrors(facts, engine));
        parts.push(glass(facts));
        parts.push(media(facts));
        parts.push(Part::new(
            "checkers",
            facts.checkers > 0,
            match facts.checkers {
                0 => "no shape has one".to_owned(),
                n => format!("{} a pattern of cells", has(n)),
            },
        ));
        parts.push(Part::new(
            "soft shadows",
            facts.balls > 0,
            match facts.balls {
                0 => "no lamp has a radius: shadows are sharp, and need no samples of lamps"
                    .to_owned(),
                n => format!("{} a radius: what hides it in part is sampled", lamps(n)),
            },
        ));
        parts.push(Part::new(
            "lens",
            facts.lens,
            if facts.lens { "the camera has an aperture" } else { "all that is seen is sharp" },
        ));
        parts.push(Part::new(
            "groups",
            facts.groups > 0,
            match facts.groups {
                0 => "nothing is placed: rays are followed in the scene's own space".to_owned(),
                n => format!(
                    "{} {} deep: each described once, and kept once",
                    placed(n),
                    facts.depth
                ),
            },
        ));
        parts.push(precision(facts, is_direct));
        parts
    }
}

fn has(shapes: u64) -> String {
    format!("{} {}", count(shapes, "shape"), if shapes == 1 { "has" } else { "have" })
}

fn lamps(lamps: u64) -> String {
    format!("{} {}", count(lamps, "lamp"), if lamps == 1 { "has" } else { "have" })
}

fn placed(groups: u64) -> String {
    format!("{} placed, at most", count(groups, "group"))
}

/// What is not made ready, if that is anything.
fn unreached(scene: &Scene, plan: &Plan) -> Option<Part> {
    let (shapes, groups) = (plan.absent.shapes().count(), plan.absent.groups().count());
    let of = |number: usize, all: usize, what: &str| match number {
        0 => None,
        _ => Some(format!("{number} of {}", count(all as u64, what))),
    };
    let own = [of(shapes, scene.shapes.len(), "shape"), of(groups, scene.groups.len(), "group")];
    let own: Vec<_> = own.into_iter().flatten().collect();
    (!own.is_empty()).then(|| {
        let why = "cannot be reached: not in view nor in a mirror, and not between what is seen and a \
                   light, or behind an opaque plane";
        Part::new("shapes out of reach", false, format!("{} {why}", own.join(" and ")))
    })
}

fn acceleration(facts: &Facts, is_direct: bool) -> Part {
    let why = if is_direct {
        "spheres and planes alone, and few: all are held against many rays at once".to_owned()
    } else {
        let triangles = match facts.triangles {
            0 => String::new(),
            n => format!(", and {} in meshes", count(n, "triangle")),
        };
        format!("{}{triangles}", count(facts.shapes, "shape"))
    };
    Part::new("hierarchy of boxes", !is_direct, why)
}

fn lights(scene: &Scene, plan: &Plan) -> Part {
    let all = scene.lights.len() as u64;
    let asked = all.saturating_sub(plan.dropped.len() as u64);
    let mut why = match (asked, all) {
        (_, 0) => "there is none: only what glows is seen".to_owned(),
        (asked, all) => format!("{asked} of {} asked", count(all, "light")),
    };
    for dropped in &plan.dropped {
        let number = dropped.light + 1;
        why += &match dropped.why {
            Reason::NoLight => format!("; light {number} has a brightness of 0"),
            Reason::Behind(plane) => format!(
                "; light {number} is behind plane {}, which hides it from all that the eye can see",
                plane + 1
            ),
            Reason::Aside => {
                format!("; light {number}, a spot, has a beam that meets nothing that may be seen")
            }
            Reason::Dim => {
                format!("; light {number} adds at most {:.1e} of display white", dropped.most)
            }
        };
    }
    Part::new("light", asked > 0, why)
}

fn shadows(facts: &Facts, plan: &Plan, is_direct: bool) -> Part {
    let culling = plan.kernel.culling;
    let lights = facts.all_lights().saturating_sub(plan.dropped.len() as u64);
    if lights == 0 {
        return Part::new("shadows", false, "no light is asked");
    }
    let mut why = "a ray to each light from each point".to_owned();
    if is_direct && culling.shadow_candidates {
        why += ", held against what stands between the point's tile and the light";
    }
    if culling.idle_planes && facts.kinds.contains_key("plane") {
        why += "; planes hide nothing from a light on the side that is seen";
    }
    Part::new("shadows", true, why)
}

/// How many mirrors in a row leave no more of a pixel than the cutoff.
fn depth(best: f64, cutoff: f64) -> Option<u32> {
    if best <= 0.0 {
        return Some(0);
    }
    if best >= 1.0 || cutoff <= 0.0 {
        return None;
    }
    let mut left = 1.0;
    (0..=Whitted::DEEPEST).find(|_| {
        let is_enough = left <= cutoff;
        left *= best;
        is_enough
    })
}

fn mirrors(facts: &Facts, engine: &Whitted) -> Part {
    let (best, cutoff) = (facts.best_mirror, engine.cutoff());
    if facts.mirrors == 0 {
        return Part::new("mirrors", false, "no shape is glossy: what is seen is seen at once");
    }
    let what = format!("{} gloss, up to {best}", has(facts.mirrors));
    match depth(best, cutoff) {
        // Glass mirrors as much as it likes.
        Some(depth) if facts.transparent == 0 => {
            let most = libm::pow(best, f64::from(depth));
            let why = format!(
                "{what}: after {} in a row at most {most:.1e} of a pixel is left, and is not followed",
                count(u64::from(depth), "mirror")
            );
            Part { most: Some(most), ..Part::new("mirrors", true, why) }
        }
        _ => {
            let why = format!("{what}: until all that is left is {cutoff:.1e} of the pixel");
            Part { most: Some(cutoff), ..Part::new("mirrors", true, why) }
        }
    }
}

fn glass(facts: &Facts) -> Part {
    match facts.transparent {
        0 => Part::new(
            "glass",
            false,
            "nothing lets light through: no ray is split, and what hides a light hides all of it",
        ),
        n => Part::new(
            "glass",
            true,
            format!(
                "{} transparent: rays are split, the largest parts first, and light to them is tinted",
                if n == 1 { "1 shape is".to_owned() } else { format!("{n} shapes are") }
            ),
        ),
    }
}

fn media(facts: &Facts) -> Part {
    match (facts.media, facts.nested_media) {
        (0, _) => Part::new("media", false, "nothing is filled: rays are in air everywhere"),
        (n, most) => Part::new(
            "media",
            true,
            format!("{} filled, and at most {most} in one place", {
                if n == 1 { "1 shape is".to_owned() } else { format!("{n} shapes are") }
            }),
        ),
    }
}

fn precision(facts: &Facts, is_direct: bool) -> Part {
    let apart = facts.reach.next_up() - facts.reach;
    let half = facts.around.map_or(0.0, |around| 0.5 * around.sides().amax());
    let boxes = if is_direct {
        "there are no boxes to be kept in single precision".to_owned()
    } else if !(1e-120..=1e120).contains(&half) {
        "the scene is too large or too small for boxes in single precision: all are one".to_owned()
    } else {
        let inside = match facts.groups {
            0 => "",
            _ => ", in groups by as large a part of the group",
        };
        format!(
            "boxes in single precision are wider than shapes by up to {:.1e}{inside}: enough to leave \
             out only what is surely not met",
            BOX_SLACK * half
        )
    };
    Part::new(
        "double precision",
        true,
        format!("coordinates up to {:.3e} are {apart:.1e} apart; {boxes}", facts.reach),
    )
}
