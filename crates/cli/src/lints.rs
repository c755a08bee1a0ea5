//! What is probably not meant in a scene, as diagnostics with their places.

use crate::report::{self, Tally};
use lancer_film::{Film, exposure_factor};
use lancer_integrator::{About, Engine, Facts, Lint, Plan};
use lancer_scene::Scene;
use lancer_xml::{Diagnostic, Parsed, Places, Severity, Source};
use std::ops::Range;

/// What is probably not meant in a scene, for which that engine is made ready.
pub(crate) fn of_scene(
    scene: &Scene,
    facts: &Facts,
    engine: &dyn Engine,
    plan: &Plan,
) -> Vec<Lint> {
    let tracer = engine.prepare(scene, plan);
    lancer_integrator::lints(scene, facts, plan, &*tracer)
}

/// Tells it, unless only errors are to be told.
pub(crate) fn tell(lints: &[Lint], name: &str, source: &Source, quiet: bool) -> Tally {
    if lints.is_empty() {
        return Tally::default();
    }
    // What was read as a scene is XML, but for what was mended.
    let places = Places::of(source).unwrap_or_default();
    let diagnostics = lints.iter().map(|lint| diagnostic(lint, &places)).collect();
    let parsed = Parsed { source: source.clone(), diagnostics, scene: None };
    report::show(name, &parsed, quiet)
}

fn diagnostic(lint: &Lint, places: &Places) -> Diagnostic {
    let of = |spans: &[Range<usize>], number: usize| {
        spans.get(number).cloned().unwrap_or_else(|| places.world.clone())
    };
    let span = match lint.about {
        About::Scene => places.world.clone(),
        About::Camera => places.camera.clone(),
        About::Light(number) => of(&places.lights, number),
        About::Shape(number) => of(&places.shapes, number),
    };
    Diagnostic {
        severity: Severity::Warning,
        message: lint.message.clone(),
        span,
        label: lint.label.clone(),
        related: None,
        help: Some(lint.remedy.clone()),
    }
}

/// What is wrong with a picture that is all black or all white as it is shown.
pub(crate) fn of_picture(film: &Film) -> Option<&'static str> {
    let factor = exposure_factor(film.stops()?);
    // Less than half a step of 8 bits in the dark; white.
    const DARK: f64 = 0.5 / 255.0 / 12.92;
    let mut shown = film.pixels().iter().flatten().map(|v| f64::from(*v) * factor);
    if shown.clone().all(|v| v < DARK) {
        return Some(
            "all of the picture is black: let lights shine on what is seen, or raise --exposure",
        );
    }
    shown.all(|v| v >= 1.0).then_some("all of the picture is white: lower --exposure")
}
