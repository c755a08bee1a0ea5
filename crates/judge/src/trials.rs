//! Pictures of a scene with one setting after the other, timed and judged.

use crate::compared::{Point, Series};
use crate::picture::Picture;
use crate::reference::{Reference, ReferenceSettings, reference};
use lancer_film::{Quality, Size, exposure_factor};
use lancer_integrator::{
    Accuracy, Engine, KernelSettings, Plan, RenderError, RenderSettings, Sampling, Strategy,
    Whitted, Why, render,
};
use lancer_scene::{Exposure, Scene, Stops};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// What pictures are made of. All is done on the threads of the pool that it is called in.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// The scene, with the size of its pictures.
    pub scene: &'a Scene,
    /// The exposure that errors are measured with.
    pub stops: Stops,
    /// How rays are followed.
    pub kernel: KernelSettings,
    /// Where this becomes true all ends with [`RenderError::Interrupted`].
    pub cancel: Option<&'a AtomicBool>,
}

/// A picture that was made.
#[derive(Debug, Clone)]
pub struct Trial {
    /// The picture.
    pub picture: Picture,
    /// Wall time, with all that it takes to make the scene ready.
    pub seconds: f64,
    /// What the program says of it.
    pub accuracy: Accuracy,
    /// What the program says of its pixels.
    pub quality: Quality,
}

/// Which settings are tried of each strategy, from the coarsest on.
#[derive(Debug, Clone, Copy)]
pub struct Ladder {
    /// Not beyond this error.
    pub finest: f64,
    /// No setting of which the one before suggests that a picture takes longer.
    pub longest: Duration,
    /// How many pictures of each setting, each another draw; at least 1. Their median time
    /// counts, and the root of the mean square of their errors.
    pub draws: u32,
}

impl<'a> Subject<'a> {
    /// The scene as it is shown by that exposure, or else the camera's. Where that looks at
    /// the picture, it is found by a sample in each pixel, once for all.
    ///
    /// # Errors
    /// Where the scene cannot be rendered.
    pub fn new(
        scene: &'a Scene,
        exposure: Option<Exposure>,
        kernel: KernelSettings,
        cancel: Option<&'a AtomicBool>,
    ) -> Result<Self, RenderError> {
        let stops = match exposure.unwrap_or(scene.camera.exposure) {
            Exposure::Stops(stops) => stops,
            Exposure::Auto => {
                let settings = RenderSettings {
                    for_display: true,
                    exposure: Some(Exposure::Auto),
                    kernel,
                    cancel,
                    ..RenderSettings::default()
                };
                let rendered = render(scene, &Whitted::default(), &settings)?;
                let stops = rendered.film.stops().and_then(|stops| Stops::new(stops).ok());
                // A meter's stops are always in range.
                stops.unwrap_or_default()
            }
        };
        Ok(Self { scene, stops, kernel, cancel })
    }

    /// The size of its pictures.
    #[must_use]
    pub fn size(&self) -> Size {
        Size::new(self.scene.camera.px_width.get(), self.scene.camera.px_height.get())
    }

    fn factor(&self) -> f64 {
        exposure_factor(self.stops.get())
    }

    /// What its pictures are held against, with an error of at most so much, if that can be had
    /// in about that time. Rays are left out where all of them together would change it by a fifth
    /// of that at most.
    ///
    /// # Errors
    /// Where the engine cannot show the scene, or the work was cancelled.
    pub fn reference(&self, error: f64, longest: Duration) -> Result<Reference, RenderError> {
        let engine = Whitted::for_error(Some(error));
        let refused = engine.refusals(self.scene);
        if !refused.is_empty() {
            let engine = engine.name().to_owned();
            return Err(RenderError::Refused { engine, reasons: refused });
        }
        let tracer = engine.prepare(self.scene, &Plan::full(&self.kernel));
        let sampler = tracer
            .sampler()
            .ok_or_else(|| RenderError::NoSamples { engine: engine.name().to_owned() })?;
        let begun = Instant::now();
        let fewest = std::sync::OnceLock::new();
        let affords = || {
            // A first one tells what a sample takes.
            let each: f64 = *fewest.get_or_init(|| {
                begun.elapsed().as_secs_f64() / f64::from(ReferenceSettings::FEWEST_SAMPLES)
            });
            let left = longest.saturating_sub(begun.elapsed());
            // What does not fit is as many as there are.
            (left.as_secs_f64() / each) as u32
        };
        let settings = ReferenceSettings {
            size: self.size(),
            factor: self.factor(),
            error,
            affords: &affords,
            seed: REFERENCE_SEED,
            cancel: self.cancel,
        };
        reference(sampler, &settings).ok_or(RenderError::Interrupted)
    }

    /// Makes a picture.
    ///
    /// # Errors
    /// Where that fails or was interrupted.
    pub fn picture(&self, sampling: Sampling) -> Result<Trial, RenderError> {
        let engine = Whitted::for_error(sampling.error);
        let settings = RenderSettings {
            exposure: Some(Exposure::Stops(self.stops)),
            sampling: Some(sampling),
            quality: true,
            kernel: self.kernel,
            cancel: self.cancel,
            ..RenderSettings::default()
        };
        let begun = Instant::now();
        let rendered = render(self.scene, &engine, &settings)?;
        let seconds = begun.elapsed().as_secs_f64();
        let picture = Picture::of_film(&rendered.film, self.factor());
        match (picture, rendered.accuracy, rendered.quality) {
            (Some(picture), Some(accuracy), Some(quality))
                if accuracy.stopped != Why::Interrupted =>
            {
                Ok(Trial { picture, seconds, accuracy, quality })
            }
            // There is all of it unless it was interrupted.
            _ => Err(RenderError::Interrupted),
        }
    }

    /// Tries the settings of a strategy. Pictures so good that the reference's own error would count
    /// for more than a tenth are left out, and are the last ones tried.
    ///
    /// # Errors
    /// Where a picture fails or was interrupted.
    pub fn series(
        &self,
        strategy: Strategy,
        ladder: &Ladder,
        reference: &Reference,
    ) -> Result<Series, RenderError> {
        let mut points = Vec::new();
        for (setting, sampling) in settings(strategy, ladder.finest) {
            let point = self.point(setting, sampling, ladder, reference)?;
            let Point { seconds, error, .. } = point;
            let is_known = error >= 10.0 * reference.error;
            if is_known {
                points.push(point);
            }
            let is_by_error = sampling.error.is_some();
            let is_last = !is_known || (!is_by_error && error <= ladder.finest);
            // Half the error takes about twice the time; counts go up by fours.
            let times = if is_by_error { 2.0 } else { 4.0 };
            if is_last || times * seconds > ladder.longest.as_secs_f64() {
                break;
            }
        }
        Ok(Series::new(strategy.name(), points))
    }

    fn point(
        &self,
        setting: String,
        sampling: Sampling,
        ladder: &Ladder,
        reference: &Reference,
    ) -> Result<Point, RenderError> {
        let mut times = Vec::new();
        let (mut squares, mut predicted, mut samples) = (0.0, 0.0, 0);
        for seed in 0..u64::from(ladder.draws.max(1)) {
            let trial = self.picture(Sampling { seed, ..sampling })?;
            // Both have this subject's size.
            let error = trial.picture.error(&reference.picture).unwrap_or(f64::NAN);
            times.push(trial.seconds);
            squares += error * error;
            predicted += trial.accuracy.predicted * trial.accuracy.predicted;
            samples += trial.accuracy.samples;
        }
        let draws = times.len();
        times.sort_by(f64::total_cmp);
        let mean = |sum: f64| (sum / draws as f64).sqrt();
        Ok(Point {
            predicted: Some(mean(predicted)),
            samples: Some(samples / draws as u64),
            ..Point::new(setting, times[draws / 2], mean(squares))
        })
    }
}

/// None that anybody would ask pictures for.
const REFERENCE_SEED: u64 = 0x9d2c_5680_ca1f_7b31;

/// The settings of a strategy, as they are written and as they are meant, the coarsest first.
fn settings(strategy: Strategy, finest: f64) -> impl Iterator<Item = (String, Sampling)> {
    let by_error = (0..).map(|halvings| COARSEST / f64::from(1_u32 << halvings));
    let errors = by_error.take(24).take_while(move |error| *error > 1.01 * finest);
    let errors = errors.chain([finest]).filter(move |_| strategy == Strategy::Edges);
    // The counts that a grid of cells has.
    let counts = (0..12).map(|power| 1_u32 << (2 * power));
    let counts = counts.filter(move |_| strategy != Strategy::Edges);
    let sampling = Sampling { strategy, ..Sampling::default() };
    let errors = errors.map(move |error| {
        (format!("--error {error}"), Sampling { error: Some(error), ..sampling })
    });
    errors.chain(counts.map(move |samples| {
        (format!("--samples {samples}"), Sampling { samples: Some(samples), ..sampling })
    }))
}

/// The largest error that is asked for.
const COARSEST: f64 = 0.016;

#[cfg(test)]
mod tests {
    use super::*;
    use lancer_scene::{Camera, Colour, Light, Scene, Shape, Surface};

    fn scene() -> Scene {
        Scene::builder()
            .camera(Camera::new([0.0, -4.0, 1.0], [0.0, -3.0, 0.8], 1.0, [32, 24]))
            .light(Light::lamp([2.0, -3.0, 4.0], 12.0))
            .shape(Shape::sphere([0.0, 0.0, 0.5], 0.5, Surface::new(Colour::RED)))
            .shape(Shape::plane([0.0; 3], [0.0, 0.0, 1.0], Surface::new(Colour::WHITE)))
            .build()
            .expect("it is a scene")
    }

    fn names(strategy: Strategy, finest: f64) -> Vec<String> {
        settings(strategy, finest).map(|(name, _)| name).take(5).collect()
    }

    #[test]
    fn settings_are_as_they_are_written() {
        assert_eq!(
            names(Strategy::Edges, 0.003),
            ["--error 0.016", "--error 0.008", "--error 0.004", "--error 0.003"]
        );
        assert_eq!(names(Strategy::Edges, 0.016), ["--error 0.016"]);
        assert_eq!(
            names(Strategy::Sobol, 0.003),
            ["--samples 1", "--samples 4", "--samples 16", "--samples 64", "--samples 256"]
        );
        assert_eq!(settings(Strategy::Edges, 0.0).count(), 25);
    }

    /// What is said of a picture's error and of the reference's is so: against another reference.
    #[test]
    fn pictures_are_judged() {
        let scene = scene();
        let kernel = KernelSettings::default();
        let stops = Exposure::Stops(Stops::default());
        let subject = Subject::new(&scene, Some(stops), kernel, None).expect("it is shown");
        let reference = subject.reference(0.0002, Duration::MAX).expect("it is made");
        assert!(reference.error <= 0.0002 && reference.samples >= 512, "{}", reference.error);
        let ladder = Ladder { finest: 0.004, longest: Duration::from_secs(100), draws: 2 };
        for strategy in [Strategy::Edges, Strategy::Stratified] {
            let series = subject.series(strategy, &ladder, &reference).expect("they are made");
            assert_eq!(series.name, strategy.name());
            assert!(series.points.len() >= 2, "{series:?}");
            let (first, last) = (&series.points[0], &series.points[series.points.len() - 1]);
            assert!(last.error < first.error && last.error < 0.008, "{series:?}");
            assert!(first.seconds > 0.0 && first.samples >= Some(32 * 24), "{series:?}");
        }
    }

    #[test]
    fn the_exposure_is_found_once() {
        let scene = scene();
        let kernel = KernelSettings::default();
        let subject = Subject::new(&scene, None, kernel, None).expect("it is shown");
        let auto = Subject::new(&scene, Some(Exposure::Auto), kernel, None).expect("it is shown");
        assert_eq!(subject.stops, auto.stops);
        assert!(subject.stops != Stops::default(), "{:?}", subject.stops);
    }

    #[test]
    fn it_can_be_cancelled() {
        let scene = scene();
        let cancel = AtomicBool::new(true);
        let stops = Exposure::Stops(Stops::default());
        let subject = Subject::new(&scene, Some(stops), KernelSettings::default(), Some(&cancel))
            .expect("nothing is done yet");
        let reference = subject.reference(0.01, Duration::MAX);
        assert!(matches!(reference, Err(RenderError::Interrupted)));
        assert!(matches!(subject.picture(Sampling::default()), Err(RenderError::Interrupted)));
    }
}
