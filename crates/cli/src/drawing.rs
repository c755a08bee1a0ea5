//! A picture of a scene while it is rendered, with progress for a person.

use crate::args::RenderArgs;
use crate::render::{Outputs, WHITTED};
use crate::{Failure, interrupt, lints, report};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use lancer_integrator::{
    Engine, Facts, Forecast, KernelSettings, Progress, RenderError, RenderSettings, Rendered,
    Sampling, Why, Width, render,
};
use lancer_scene::Scene;
use lancer_xml::Source;
use std::io::IsTerminal;
use std::time::Duration;

/// Of what takes at least so long it is said beforehand how long.
const LONG: Duration = Duration::from_secs(3);

/// What is rendered, and how.
pub(crate) struct Drawing<'a> {
    pub(crate) args: &'a RenderArgs,
    pub(crate) scene: &'a Scene,
    pub(crate) engine: &'a dyn Engine,
    pub(crate) sampling: Option<Sampling>,
    pub(crate) lanes: Width,
    pub(crate) outputs: &'a Outputs,
}

impl Drawing<'_> {
    fn settings(&self) -> RenderSettings<'static> {
        let args = self.args;
        let kinds = || args.layers.iter().flat_map(|kinds| &kinds.0);
        RenderSettings {
            window: args.crop,
            for_display: self.outputs.shows_codes(args),
            exposure: args.exposure,
            layers: kinds().any(|kind| kind.is_of_first_hit()),
            quality: kinds().any(|kind| !kind.is_of_first_hit()),
            sampling: self.sampling,
            kernel: KernelSettings { lanes: self.lanes, ..KernelSettings::default() },
            full_model: args.full_model,
            ..RenderSettings::default()
        }
    }

    /// Tells what is probably not meant; how much that is.
    pub(crate) fn lints(&self, name: &str, source: &Source) -> usize {
        let plan = self.settings().plan(self.scene, self.engine);
        let facts = Facts::of(self.scene);
        let found = lints::of_scene(self.scene, &facts, self.engine, &plan);
        lints::tell(&found, name, source, self.args.quiet).warnings
    }

    /// Renders it.
    pub(crate) fn draw(&self) -> Result<Rendered, Failure> {
        // Progress is for a person at a terminal.
        let talks = !self.args.quiet && std::io::stderr().is_terminal();
        let bar = talks.then(progress_bar);
        let progress = bar.as_ref().map(|bar| {
            |done, all| {
                bar.set_length(all);
                bar.set_position(done);
            }
        });
        let foretell = |forecast: Forecast| {
            if forecast.all >= LONG {
                let say = || {
                    let seconds = forecast.all.as_secs_f64();
                    report::say(format_args!("this will take about {seconds:.0} s in all"));
                };
                match &bar {
                    Some(bar) => bar.suspend(say),
                    None => say(),
                }
            }
        };
        let settings = RenderSettings {
            progress: progress.as_ref().map(|progress| progress as &Progress),
            forecast: (!self.args.quiet).then_some(&foretell),
            cancel: Some(interrupt::watch()),
            ..self.settings()
        };
        let result = render(self.scene, self.engine, &settings);
        if let Some(bar) = &bar {
            bar.finish_and_clear();
        }
        let nothing = || {
            report::say(format_args!("error: interrupted; no picture was written"));
            Failure::Interrupted
        };
        let rendered = result.map_err(|error| match error {
            RenderError::Interrupted => nothing(),
            RenderError::Refused { .. } => {
                Failure::work(format_args!("{error}; use --engine {WHITTED}"))
            }
            other => Failure::work(other),
        })?;
        match &rendered.accuracy {
            Some(known) if known.stopped == Why::Interrupted && known.samples == 0 => {
                Err(nothing())
            }
            _ => Ok(rendered),
        }
    }
}

fn progress_bar() -> ProgressBar {
    let style = ProgressStyle::with_template("{wide_bar} {percent:>3} % {eta:>4} left");
    ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::stderr_with_hz(10))
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
