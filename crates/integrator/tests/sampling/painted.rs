//! Pictures that are given by a function of the place, and what is right for them.

use lancer_film::Display;
use lancer_integrator::{
    Engine, Plan, RayCounts, RenderError, RenderSettings, Rendered, Rgb, Sample, Sampler, Sampling,
    Seen, Tracer, render,
};
use lancer_scene::{Camera, Exposure, Scene, Stops};
use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;

/// An engine that sees a function of the place: a value and a signature.
pub(crate) struct Painted<F>(pub(crate) F);

impl<F: Fn(f64, f64) -> (f64, u64) + Sync> Engine for Painted<F> {
    fn name(&self) -> &str {
        "painted"
    }

    fn summary(&self) -> &str {
        "a function of the place"
    }

    fn display(&self) -> Display {
        Display::Exposed
    }

    fn prepare<'s>(&'s self, _: &'s Scene, _: &Plan) -> Box<dyn Tracer + 's> {
        Box::new(Painter(&self.0))
    }
}

struct Painter<'a, F>(&'a F);

impl<F: Fn(f64, f64) -> (f64, u64) + Sync> Tracer for Painter<'_, F> {
    fn pixel(&self, x: u32, y: u32, counts: &mut RayCounts) -> Rgb {
        counts.primary += 1;
        [(self.0)(f64::from(x) + 0.5, f64::from(y) + 0.5).0 as f32; 3]
    }

    fn sampler(&self) -> Option<&dyn Sampler> {
        Some(self)
    }
}

impl<F: Fn(f64, f64) -> (f64, u64) + Sync> Sampler for Painter<'_, F> {
    fn see(&self, samples: &[Sample], seen: &mut [Seen], counts: &mut RayCounts) {
        for (sample, seen) in samples.iter().zip(seen) {
            *seen = self.see_alone(sample, counts);
        }
    }

    fn see_alone(&self, sample: &Sample, counts: &mut RayCounts) -> Seen {
        counts.primary += 1;
        let [x, y] = sample.place;
        let (value, signature) = (self.0)(x, y);
        Seen { radiance: [value as f32; 3], signature }
    }
}

/// The picture of so many pixels along each side, with 0 stops.
pub(crate) fn picture(
    side: u32,
    sampling: Sampling,
    threads: usize,
    see: impl Fn(f64, f64) -> (f64, u64) + Sync,
) -> Rendered {
    let settings = RenderSettings {
        sampling: Some(sampling),
        threads: NonZeroUsize::new(threads),
        ..RenderSettings::default()
    };
    draw(side, settings, see).expect("rendered")
}

/// The same, which may be interrupted.
pub(crate) fn try_picture(
    side: u32,
    sampling: Sampling,
    cancel: Option<&AtomicBool>,
    see: impl Fn(f64, f64) -> (f64, u64) + Sync,
) -> Result<Rendered, RenderError> {
    draw(
        side,
        RenderSettings { sampling: Some(sampling), cancel, ..RenderSettings::default() },
        see,
    )
}

fn draw(
    side: u32,
    settings: RenderSettings<'_>,
    see: impl Fn(f64, f64) -> (f64, u64) + Sync,
) -> Result<Rendered, RenderError> {
    let camera = Camera::new([0.0; 3], [0.0, 1.0, 0.0], 1.0, [side, side]);
    let scene = Scene::builder().camera(camera).build().expect("valid");
    let stops = Exposure::Stops(Stops::new(0.0).expect("in range"));
    let settings = RenderSettings { exposure: Some(stops), quality: true, ..settings };
    render(&scene, &Painted(see), &settings)
}

/// The part of each pixel that a shape covers which is met by each row in stretches: exactly
/// along rows, of which there are 1024 in a pixel.
pub(crate) fn coverage(side: u32, stretches: impl Fn(f64) -> Vec<[f64; 2]>) -> Vec<f64> {
    const ROWS: u32 = 1024;
    let mut all = vec![0.0; (side * side) as usize];
    for row in 0..side * ROWS {
        let y = (f64::from(row) + 0.5) / f64::from(ROWS);
        for [left, right] in stretches(y) {
            let (left, right) = (left.max(0.0), right.min(f64::from(side)));
            if right <= left {
                continue;
            }
            for x in left as u32..=(right as u32).min(side - 1) {
                let x0 = left.max(f64::from(x));
                let x1 = right.min(f64::from(x + 1));
                all[(row / ROWS * side + x) as usize] += (x1 - x0).max(0.0) / f64::from(ROWS);
            }
        }
    }
    all
}

/// The root of the mean square of what a picture is off.
pub(crate) fn true_error(rendered: &Rendered, right: &[f64]) -> f64 {
    let pixels = rendered.film.pixels();
    assert_eq!(pixels.len(), right.len());
    let squares = pixels.iter().zip(right).map(|(pixel, right)| {
        let off = f64::from(pixel[0]).clamp(0.0, 1.0) - right.clamp(0.0, 1.0);
        off * off
    });
    (squares.sum::<f64>() / right.len() as f64).sqrt()
}
