//! What is done for a scene, and what is left out, as text and as JSON.

use crate::report::count;
use lancer_integrator::{Culling, Facts, Part, Plan, RayCounts, Reason};
use lancer_scene::Scene;
use serde_json::{Value, json};
use std::fmt::Write;

/// A plan, and what it follows from.
pub(super) struct Planned<'a> {
    /// The scene's.
    pub(super) name: &'a str,
    pub(super) scene: &'a Scene,
    pub(super) facts: &'a Facts,
    pub(super) plan: &'a Plan,
    pub(super) parts: &'a [Part],
    pub(super) engine: &'static str,
    pub(super) cutoff: f64,
    /// The error that is planned for.
    pub(super) error: f64,
    /// The part of a small picture's pixels that one sample settles.
    pub(super) settled: f64,
    /// The rays of such a picture, and how many pixels that has.
    pub(super) counts: RayCounts,
    pub(super) pixels: u64,
}

/// The kinds of rays, and how many of each a pixel takes.
fn rays(planned: &Planned<'_>) -> [(&'static str, f64); 4] {
    let of = |count: u64| count as f64 / planned.pixels as f64;
    let counts = &planned.counts;
    [
        ("primary", of(counts.primary)),
        ("reflected", of(counts.reflected)),
        ("transmitted", of(counts.transmitted)),
        ("shadow", of(counts.shadow)),
    ]
}

fn kinds(facts: &Facts) -> String {
    let kind = |(kind, number): (&String, &u64)| match (number, kind.as_str()) {
        (1, _) => format!("1 {kind}"),
        (_, "box" | "mesh") => format!("{number} {kind}es"),
        (_, "tetrahedron") => format!("{number} tetrahedra"),
        (_, "torus") => format!("{number} tori"),
        _ => format!("{number} {kind}s"),
    };
    let kinds: Vec<_> = facts.kinds.iter().map(kind).collect();
    if kinds.is_empty() { "no shapes".to_owned() } else { kinds.join(", ") }
}

fn lights(facts: &Facts) -> String {
    let lights = facts.lights.iter().zip(["sun", "lamp", "spot"]);
    let lights: Vec<_> = lights
        .filter(|(number, _)| **number > 0)
        .map(|(number, kind)| count(*number as usize, kind))
        .collect();
    if lights.is_empty() { "no lights".to_owned() } else { lights.join(", ") }
}

/// The plan in words.
pub(super) fn text(planned: &Planned<'_>) -> String {
    let Planned { facts, parts, .. } = planned;
    let mut out = String::new();
    // Writing to a string does not fail.
    let mut line = |text: &str| {
        let _ = writeln!(out, "{text}");
    };
    let name: String = planned.name.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    let camera = &planned.scene.camera;
    line(&format!("{name}: {}x{} pixels", camera.px_width.get(), camera.px_height.get()));
    line(&format!("  shapes: {}", kinds(facts)));
    line(&format!("  lights: {}", lights(facts)));
    if let Some(around) = &facts.around {
        let [from, to] = [around.min, around.max].map(|p| {
            // No minus before a zero.
            let [x, y, z] = [p.x, p.y, p.z].map(|c| format!("{c:.4}").replace("-0.0000", "0.0000"));
            format!("{x} {y} {z}")
        });
        let endless = match facts.endless {
            0 => String::new(),
            n => format!(", and {} without an end", count(n as usize, "shape")),
        };
        line(&format!("  from {from} to {to}{endless}"));
    }
    line("");
    line(&format!(
        "engine: {}, the least that shows all of this; classic and direct show pictures of their own",
        planned.engine
    ));
    line(&format!(
        "planned for an error of {}: rays that are left out change no pixel by more than {:.1e}",
        planned.error, planned.cutoff
    ));
    for (title, runs) in [("what runs", true), ("what does not", false)] {
        let own: Vec<_> = parts.iter().filter(|part| part.runs == runs).collect();
        if own.is_empty() {
            continue;
        }
        line("");
        line(&format!("{title}:"));
        for part in own {
            let most = part.most.map_or_else(String::new, |most| format!(" (at most {most:.1e})"));
            line(&format!("  {}: {}{most}", part.name, part.why));
        }
    }
    line("");
    line(&format!(
        "of a small picture {:.0} % of the pixels are settled by one sample; rays for each sample:",
        100.0 * planned.settled
    ));
    let all: f64 = rays(planned).iter().map(|(_, rays)| rays).sum();
    for (kind, each) in rays(planned) {
        line(&format!("  {kind:11} {each:9.2}  {:3.0} %", 100.0 * each / all));
    }
    out
}

/// The plan as JSON.
pub(super) fn json(planned: &Planned<'_>) -> String {
    let Planned { facts, plan, .. } = planned;
    let switches = Culling::without_each();
    let is_off = |culling: &Culling| plan.kernel.culling == *culling;
    let nothing = plan.kernel.culling == Culling::NONE;
    let shortcuts: serde_json::Map<String, Value> = switches
        .iter()
        .map(|(name, culling)| ((*name).to_owned(), json!(!nothing && !is_off(culling))))
        .collect();
    let dropped: Vec<_> = plan
        .dropped
        .iter()
        .map(|dropped| {
            let (why, plane) = match dropped.why {
                Reason::NoLight => ("no-light", None),
                Reason::Behind(plane) => ("behind", Some(plane + 1)),
                Reason::Aside => ("aside", None),
                Reason::Dim => ("dim", None),
            };
            json!({"light": dropped.light + 1, "why": why, "plane": plane, "most": dropped.most})
        })
        .collect();
    let marked = |marks: &[bool]| -> Vec<usize> {
        (1..).zip(marks).filter(|(_, mark)| **mark).map(|(number, _)| number).collect()
    };
    let around = facts.around.as_ref().map(|b| [b.min, b.max].map(|p| [p.x, p.y, p.z]));
    let value = json!({
        "scene": planned.name,
        "facts": {
            "shapes": facts.shapes,
            "kinds": facts.kinds,
            "triangles": facts.triangles,
            "groups": facts.groups,
            "depth": facts.depth,
            "lights": {"suns": facts.lights[0], "lamps": facts.lights[1], "spots": facts.lights[2]},
            "balls": facts.balls,
            "mirrors": facts.mirrors,
            "best_mirror": facts.best_mirror,
            "transparent": facts.transparent,
            "media": facts.media,
            "nested_media": facts.nested_media,
            "checkers": facts.checkers,
            "glowing": facts.glowing,
            "endless": facts.endless,
            "around": around,
            "reach": facts.reach,
            "lens": facts.lens,
            "perspective": facts.perspective,
        },
        "plan": {
            "engine": planned.engine,
            "error": planned.error,
            "cutoff": planned.cutoff,
            "lanes": plan.kernel.lanes.name(),
            "shortcuts": shortcuts,
            "dropped_lights": dropped,
            "absent": {"shapes": marked(&plan.absent.shapes), "groups": marked(&plan.absent.groups)},
            "most": plan.most(),
        },
        "parts": planned.parts.iter().map(|part| json!({
            "name": part.name, "runs": part.runs, "why": part.why, "most": part.most,
        })).collect::<Vec<_>>(),
        "settled_by_one_sample": planned.settled,
        "rays_per_sample": rays(planned).into_iter().collect::<std::collections::BTreeMap<_, _>>(),
    });
    format!("{value:#}\n")
}
