//! What `--stats` writes.

use lancer_film::{Size, Window};
use lancer_integrator::{RayCounts, Trouble, Troubles as Met};
use serde::Serialize;
use std::time::{Duration, Instant};

/// Everything about a finished render. The fields are described in the manual.
#[derive(Debug, Serialize)]
pub(crate) struct Stats {
    pub(crate) version: &'static str,
    pub(crate) scene: String,
    pub(crate) output: Option<String>,
    pub(crate) engine: &'static str,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) crop: Option<[u32; 4]>,
    pub(crate) lights: usize,
    pub(crate) shapes: u64,
    pub(crate) threads: usize,
    pub(crate) lanes: &'static str,
    pub(crate) rays: Rays,
    pub(crate) frame_peak: Option<f32>,
    pub(crate) exposure: Option<f64>,
    pub(crate) cutoff: Option<f64>,
    pub(crate) troubles: Troubles,
    pub(crate) seconds: Seconds,
}

#[derive(Debug, Serialize)]
pub(crate) struct Rays {
    primary: u64,
    reflected: u64,
    transmitted: u64,
    shadow: u64,
    total: u64,
}

/// What went wrong in the picture.
#[derive(Debug, Serialize)]
pub(crate) struct Troubles {
    media: Count,
    given_up: Count,
    not_finite: Count,
}

#[derive(Debug, Serialize)]
struct Count {
    count: u64,
    first: Option<(u32, u32)>,
}

impl From<Trouble> for Count {
    fn from(Trouble { count, first }: Trouble) -> Self {
        Self { count, first }
    }
}

impl From<Met> for Troubles {
    fn from(met: Met) -> Self {
        let Met { media, given_up, not_finite } = met;
        Self { media: media.into(), given_up: given_up.into(), not_finite: not_finite.into() }
    }
}

/// Wall time by stage.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Seconds {
    pub(crate) read: f64,
    pub(crate) parse: f64,
    pub(crate) render: f64,
    pub(crate) encode: f64,
    pub(crate) write: f64,
    pub(crate) total: f64,
}

impl From<RayCounts> for Rays {
    fn from(counts: RayCounts) -> Self {
        let RayCounts { primary, reflected, transmitted, shadow, .. } = counts;
        Self { primary, reflected, transmitted, shadow, total: counts.total() }
    }
}

impl Stats {
    pub(crate) fn to_json(&self) -> String {
        // There is no map with keys that are no strings, so it cannot fail.
        let mut json = serde_json::to_string_pretty(self).unwrap_or_default();
        json.push('\n');
        json
    }

    /// One line for a person.
    pub(crate) fn summary(&self) -> String {
        let size = Size::new(self.width, self.height);
        let rays = self.rays.total as f64;
        format!(
            "{size} pixels by {} in {:.2} s on {} {}: {:.1} million rays, {:.1} million per second",
            self.engine,
            self.seconds.render,
            self.threads,
            if self.threads == 1 { "thread" } else { "threads" },
            rays / 1e6,
            rays / 1e6 / self.seconds.render.max(1e-9),
        )
    }
}

/// The parts of a window, in the order of `--crop`.
pub(crate) fn parts(window: Window) -> [u32; 4] {
    [window.x, window.y, window.width, window.height]
}

/// A clock that is read at the end of each stage.
pub(crate) struct Stopwatch {
    begun: Instant,
    lap: Instant,
}

impl Stopwatch {
    pub(crate) fn start() -> Self {
        let now = Instant::now();
        Self { begun: now, lap: now }
    }

    /// Seconds since the last lap.
    pub(crate) fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let lap: Duration = now - self.lap;
        self.lap = now;
        lap.as_secs_f64()
    }

    /// Seconds since the start.
    pub(crate) fn total(&self) -> f64 {
        self.begun.elapsed().as_secs_f64()
    }
}
