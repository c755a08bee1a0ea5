//! What is done for a scene, and what is left out, as text and as JSON.

use crate::report::count;
use lancer_integrator::{Facts, LightCounts, Part, Plan, RayCounts, Strategy};
use lancer_scene::Scene;
use serde_json::json;
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
    /// Where samples go.
    pub(super) strategy: Strategy,
    /// The part of a small picture's pixels that one sample settles.
    pub(super) settled: f64,
    /// The rays of such a picture.
    pub(super) counts: RayCounts,
}

/// The kinds of rays, and how many of each a sample takes, which has one primary ray.
fn rays(planned: &Planned<'_>) -> [(&'static str, f64); 4] {
    let counts = &planned.counts;
    let of = |count: u64| count as f64 / counts.primary.max(1) as f64;
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
    let LightCounts { suns, lamps, spots } = facts.lights;
    let lights: Vec<_> = [(suns, "sun"), (lamps, "lamp"), (spots, "spot")]
        .into_iter()
        .filter(|(number, _)| *number > 0)
        .map(|(number, kind)| count(number as usize, kind))
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
        "planned for an error of {}: samples go by the strategy {}; rays that are left out change no \
         pixel by more than {:.1e}",
        planned.error,
        planned.strategy.name(),
        planned.cutoff
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
    let mut plan = json!(planned.plan);
    plan["engine"] = json!(planned.engine);
    plan["error"] = json!(planned.error);
    plan["cutoff"] = json!(planned.cutoff);
    plan["strategy"] = json!(planned.strategy.name());
    let value = json!({
        "scene": planned.name,
        "facts": planned.facts,
        "plan": plan,
        "parts": planned.parts,
        "settled_by_one_sample": planned.settled,
        "rays_per_sample": rays(planned).into_iter().collect::<std::collections::BTreeMap<_, _>>(),
    });
    format!("{value:#}\n")
}
