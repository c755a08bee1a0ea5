//! What `--stats` writes.

use crate::asked::Stop;
use crate::report::count;
use lancer_film::Window;
use lancer_integrator::{Accuracy, RayCounts, Sampling, Trouble, Troubles as Met, Why};
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
    pub(crate) sampling: Option<Sampled>,
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

/// What was asked about samples, and what came of it.
#[derive(Debug, Serialize)]
pub(crate) struct Sampled {
    strategy: &'static str,
    seed: u64,
    asked: Asked,
    error: f64,
    samples: u64,
    samples_per_pixel: f64,
    pixels_without_samples: u64,
    stopped: &'static str,
    stop_at: String,
    forecast: Option<Foretold>,
    #[serde(skip)]
    why: Why,
}

#[derive(Debug, Serialize)]
struct Asked {
    samples: Option<u32>,
    error: Option<f64>,
    seconds: Option<f64>,
    stop_at: Option<String>,
}

/// A forecast of the time that rendering takes, and how good it was.
#[derive(Debug, Serialize)]
struct Foretold {
    seconds: f64,
    made_after: f64,
    /// By which part of the forecast it took longer.
    off: f64,
}

impl Sampled {
    /// Of a picture of so many pixels, which took so many seconds.
    pub(crate) fn new(sampling: &Sampling, accuracy: &Accuracy, pixels: u64, seconds: f64) -> Self {
        let stop = |at| Stop { at, error: sampling.error }.to_string();
        let foretold = |forecast: lancer_integrator::Forecast| {
            let all = forecast.all.as_secs_f64();
            let made_after = forecast.made_after.as_secs_f64();
            Foretold { seconds: all, made_after, off: (seconds - all) / all.max(1e-9) }
        };
        Self {
            strategy: sampling.strategy.name(),
            seed: sampling.seed,
            asked: Asked {
                samples: sampling.samples,
                error: sampling.error,
                seconds: sampling.time.map(|time| time.as_secs_f64()),
                stop_at: sampling.stop_at.map(stop),
            },
            error: accuracy.predicted,
            samples: accuracy.samples,
            samples_per_pixel: accuracy.samples as f64 / pixels as f64,
            pixels_without_samples: accuracy.unseen,
            stopped: accuracy.stopped.name(),
            stop_at: stop(accuracy.at),
            forecast: accuracy.forecast.map(foretold),
            why: accuracy.stopped,
        }
    }

    /// The error, and why it is that, for a person.
    fn summary(&self) -> String {
        let asked = &self.asked;
        let why = match (self.why, asked.error) {
            (Why::Error, Some(error)) => format!("asked: {error}"),
            (Why::Samples, _) => "all samples asked for".to_owned(),
            (Why::Time, _) => "in the time asked for".to_owned(),
            (Why::StopAt, _) => "at the place asked for".to_owned(),
            (Why::Interrupted, Some(error)) => format!("interrupted; asked: {error}"),
            (Why::Interrupted | Why::Error, _) => self.stopped.to_owned(),
            (Why::MostSamples, _) => "pixels have as many samples as they may".to_owned(),
        };
        let samples = match &*short(self.samples_per_pixel) {
            "1" => "1 sample".to_owned(),
            number => format!("{number} samples"),
        };
        let mut text = format!("error about {} ({why}), {samples} a pixel", short(self.error));
        if self.pixels_without_samples > 0 {
            let pixels = count(self.pixels_without_samples as usize, "pixel");
            text.push_str(&format!(", {pixels} still without (black)"));
        }
        text
    }
}

/// A number to two digits; whole numbers in full.
fn short(value: f64) -> String {
    if value >= 10.0 || value == 0.0 || !value.is_finite() {
        return format!("{value:.0}");
    }
    let digits = (1.0 - libm::log10(value.abs()).floor()).clamp(0.0, 12.0);
    let text = format!("{value:.*}", digits as usize);
    match text.strip_suffix(".0") {
        Some(whole) => whole.to_owned(),
        None => text,
    }
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

    /// One line for a person, about a picture that has these pixels.
    pub(crate) fn summary(&self, window: Window) -> String {
        let Window { width, height, .. } = window;
        let accuracy = match &self.sampling {
            Some(sampled) => sampled.summary(),
            None => "one sample at the centre of each pixel".to_owned(),
        };
        format!(
            "{width}x{height} pixels by {}: {accuracy}; {:.2} s on {}, {:.1} million rays a second",
            self.engine,
            self.seconds.render,
            count(self.threads, "thread"),
            self.rays.total as f64 / 1e6 / self.seconds.render.max(1e-9),
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

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_for_a_person_have_two_digits() {
        for (value, text) in [
            (0.000_471_2, "0.00047"),
            (0.0005, "0.00050"),
            (1.0, "1"),
            (1.94, "1.9"),
            (9.99, "10"),
            (64.0, "64"),
            (1234.5, "1234"),
            (0.0, "0"),
            (0.25, "0.25"),
        ] {
            assert_eq!(short(value), text);
        }
    }
}
