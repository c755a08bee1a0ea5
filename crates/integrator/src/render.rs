use crate::sampling::{Job as SamplingJob, sample};
use crate::{Accuracy, Asked, Engine, Forecast, Plan, RayCounts, Rgb, Sampling, Tracer};
use lancer_film::{
    Display, Film, FilmError, LayerPixel, Layers, LightMeter, Quality, Size, Strip, Window,
    exposure_factor,
};
use lancer_kernel::KernelSettings;
use lancer_scene::{Exposure, Scene};
use std::num::NonZeroUsize;
use std::ops::AddAssign;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// The side of the square tiles that a frame is cut into, in pixels.
pub const TILE_SIDE: u32 = 16;

/// How a picture is to be rendered. But for `sampling`, none of it changes the value of a pixel; where
/// an error is asked for, a plan may change it by a part of that.
#[derive(Clone, Copy, Default)]
pub struct RenderSettings<'a> {
    /// The part of the frame to keep; all of it by default.
    pub window: Option<Window>,
    /// Whether the film is to be shown in codes of a display. Where the rule for
    /// that looks at the whole frame (the brightest component, or automatic
    /// exposure), the whole frame is rendered even where only a part is kept.
    pub for_display: bool,
    /// The exposure, if not the camera's own.
    pub exposure: Option<Exposure>,
    /// Whether to find out also what each pixel's ray meets first.
    pub layers: bool,
    /// How many samples each pixel gets; one at its centre if that is not said, and nothing is
    /// found out about its error.
    pub sampling: Option<Sampling>,
    /// Whether to tell, with samples, what is known of each pixel's error.
    pub quality: bool,
    /// How rays are followed.
    pub kernel: KernelSettings,
    /// Whether nothing is left out that nobody could see ([`Plan`]).
    pub full_model: bool,
    /// How many threads to start for it; by default those of the rayon pool that it
    /// is called in, one for each core where nobody has made another.
    pub threads: Option<NonZeroUsize>,
    /// Called now and then, from any thread, as work goes on: with pixels, or with samples
    /// where pixels have many; then how many there will be is a guess that becomes better.
    pub progress: Option<&'a Progress<'a>>,
    /// Is told how long it will take, as far as that can be known, once it can be, where an error
    /// was asked for.
    pub forecast: Option<&'a (dyn Fn(Forecast) + Sync)>,
    /// Once this is true the work stops and [`RenderError::Interrupted`] is
    /// returned; where pixels have several samples, instead the picture as it is then.
    pub cancel: Option<&'a AtomicBool>,
}

impl RenderSettings<'_> {
    /// What is done for the scene, and what is left out.
    #[must_use]
    pub fn plan(&self, scene: &Scene, engine: &dyn Engine) -> Plan {
        let factor = match Showing::new(scene, engine, self) {
            // The original's engines show glows of lights, and see through planes from behind: what
            // is hidden for others may be seen by them.
            Showing::Brightest if !self.full_model => return Plan::full(&self.kernel),
            Showing::Exposed(stops) => Some(exposure_factor(stops)),
            Showing::Brightest | Showing::AutoExposed => None,
        };
        let error = self.sampling.and_then(|sampling| sampling.error);
        Plan::new(scene, &Asked { kernel: self.kernel, error, factor, full_model: self.full_model })
    }
}

/// Is told how much is done and how much there is to do. Calls come
/// from several threads and may overtake one another.
pub type Progress<'a> = dyn Fn(u64, u64) + Sync + 'a;

/// A finished picture and what it took.
#[derive(Debug, Clone)]
pub struct Rendered {
    /// The picture. It knows how it is to be shown, unless only a part of the
    /// frame was rendered and the rule looks at all of it.
    pub film: Film,
    /// What the rays of the pixels meet first, where that was asked for.
    pub layers: Option<Layers>,
    /// The error of the picture, and why there are no more samples, where [`Sampling`] was asked for.
    pub accuracy: Option<Accuracy>,
    /// That of its pixels, where that was asked for, too.
    pub quality: Option<Quality>,
    /// The rays that were followed.
    pub counts: RayCounts,
    /// How many threads worked on it.
    pub threads: usize,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// There is no film to render to.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// The system would not start the threads.
    #[error("could not start {threads} threads: {reason}")]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// What the system said.
        reason: rayon::ThreadPoolBuildError,
    },
    /// There are things in the scene that the engine does not know.
    #[error("the engine {engine} cannot show this scene: {}", .reasons.join("; "))]
    Refused {
        /// The engine's name.
        engine: String,
        /// What it does not know.
        reasons: Vec<String>,
    },
    /// The engine does not say what rays meet first.
    #[error("the engine {engine} has no layers")]
    NoLayers {
        /// The engine's name.
        engine: String,
    },
    /// Pixels are to have several samples, but the engine has only one, at their centres.
    #[error("the engine {engine} has one sample in each pixel")]
    NoSamples {
        /// The engine's name.
        engine: String,
    },
    /// The work was cancelled.
    #[error("interrupted")]
    Interrupted,
}

/// Renders `scene` with `engine`.
///
/// # Errors
/// Where the engine cannot show the scene or has no layers, the window does
/// not lie in the frame, memory or threads cannot be had, or the work was
/// cancelled.
pub fn render(
    scene: &Scene,
    engine: &dyn Engine,
    settings: &RenderSettings<'_>,
) -> Result<Rendered, RenderError> {
    let reasons = engine.refusals(scene);
    if !reasons.is_empty() {
        return Err(RenderError::Refused { engine: engine.name().to_owned(), reasons });
    }
    let frame = Size::new(scene.camera.px_width.get(), scene.camera.px_height.get());
    let window = settings.window.unwrap_or_else(|| frame.window());
    let film = Film::new(frame, window, engine.display())?;
    let layers = settings.layers.then(|| Layers::new(frame, window)).transpose()?;
    match settings.threads {
        None => draw(scene, engine, settings, film, layers),
        Some(threads) => {
            // Others would have nothing to do.
            let most = usize::try_from(frame.window().strip_count(TILE_SIDE, TILE_SIDE));
            let threads = threads.get().min(most.unwrap_or(usize::MAX));
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .map_err(|reason| RenderError::Threads { threads, reason })?;
            pool.install(|| draw(scene, engine, settings, film, layers))
        }
    }
}

/// Renders to a film, and to layers where there are any, on the threads of the pool
/// that it is called in.
fn draw(
    scene: &Scene,
    engine: &dyn Engine,
    settings: &RenderSettings<'_>,
    film: Film,
    layers: Option<Layers>,
) -> Result<Rendered, RenderError> {
    let begun = Instant::now();
    let showing = Showing::new(scene, engine, settings);
    let plan = settings.plan(scene, engine);
    let tracer = engine.prepare(scene, &plan);
    let Some(sampling) = &settings.sampling else {
        return fill((engine, &*tracer), showing, settings, film, layers);
    };
    let sampler = tracer.sampler();
    let sampler =
        sampler.ok_or_else(|| RenderError::NoSamples { engine: engine.name().to_owned() })?;
    // The exposure is fixed before: by one sample in each pixel of the frame, the same
    // whatever the seed is.
    let (frame, window) = (film.frame(), film.window());
    let mut quality = settings.quality.then(|| Quality::new(frame, window)).transpose()?;
    // A single sample is just that.
    let is_single = sampling.samples == Some(1) && window == frame.window();
    let mut rendered = if (showing.looks_at_frame() && !is_single) || layers.is_some() {
        let settings = RenderSettings { for_display: true, ..*settings };
        fill((engine, &*tracer), showing, &settings, film, layers)?
    } else {
        let threads = rayon::current_num_threads();
        let counts = RayCounts::default();
        Rendered { film, layers, accuracy: None, quality: None, counts, threads }
    };
    if let Showing::Exposed(stops) = showing {
        rendered.film.set_stops(stops);
    }
    let sampled = sample(&SamplingJob {
        sampler,
        window,
        sampling,
        stops: rendered.film.stops(),
        lanes: settings.kernel.lanes,
        begun,
        cancel: settings.cancel,
        progress: settings.progress,
        forecast: settings.forecast,
    });
    rendered.film.set_stops(sampled.stops);
    sampled.put(&mut rendered.film, quality.as_mut());
    if window == frame.window() {
        let peak = Film::peak(rendered.film.pixels());
        rendered.film.set_frame_peak(peak);
    }
    rendered.counts += sampled.counts;
    rendered.accuracy = Some(sampled.accuracy);
    rendered.quality = quality;
    Ok(rendered)
}

/// The same with a sample at the centre of each pixel.
fn fill(
    (engine, tracer): (&dyn Engine, &dyn Tracer),
    showing: Showing,
    settings: &RenderSettings<'_>,
    mut film: Film,
    mut layers: Option<Layers>,
) -> Result<Rendered, RenderError> {
    let (frame, window) = (film.frame(), film.window());
    let to_do =
        if settings.for_display && showing.looks_at_frame() { frame.window() } else { window };
    let is_whole = to_do == frame.window();
    let threads = rayon::current_num_threads();
    let tiles = to_do.strip_count(TILE_SIDE, TILE_SIDE);
    let width = strip_width(tiles, threads);

    let work = Work {
        engine: engine.name(),
        tracer,
        settings,
        metered: (is_whole && showing == Showing::AutoExposed).then(|| frame.window().pixels()),
        pixels: to_do.pixels(),
        pixels_done: AtomicU64::new(0),
    };
    let mut layer_strips = layers.as_mut().map(|layers| layers.strips_mut(width));
    let kept = film.strips_mut(width).map(move |film| Job {
        window: film.window(),
        kept: Some((film, layer_strips.as_mut().and_then(Iterator::next))),
    });
    // Where all of the frame must be looked at, but not all is kept.
    let others = window.around(frame).take_while(|_| to_do != window);
    let others = others.flat_map(|part| part.strips(width, TILE_SIDE));
    let jobs = Mutex::new(kept.chain(others.map(|window| Job { window, kept: None })));
    let found = rayon::broadcast(|_| work.do_jobs(&jobs));
    drop(jobs);

    let mut all = Found::new(work.metered);
    for found in found {
        all += found?;
    }
    match showing {
        Showing::Exposed(stops) => film.set_stops(stops),
        _ => {
            if let Some(meter) = &all.meter {
                film.set_stops(meter.stops());
            }
        }
    }
    if is_whole {
        film.set_frame_peak(all.peak);
    }
    let threads = threads.min(usize::try_from(tiles).unwrap_or(usize::MAX));
    let counts = all.counts;
    Ok(Rendered { film, layers, accuracy: None, quality: None, counts, threads })
}

/// How wide the strips are that threads take to work on. Neighbouring tiles
/// share what they read and write, so a thread takes several at a time; but
/// no more than a 64th of its share, so that all are done at about the same time.
fn strip_width(tiles: u64, threads: usize) -> u32 {
    const MOST_TILES: u64 = 16;
    TILE_SIDE * (tiles / (64 * threads as u64)).clamp(1, MOST_TILES) as u32
}

/// By which rule a film is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Showing {
    Brightest,
    AutoExposed,
    Exposed(f64),
}

impl Showing {
    fn new(scene: &Scene, engine: &dyn Engine, settings: &RenderSettings<'_>) -> Self {
        match (engine.display(), settings.exposure.unwrap_or(scene.camera.exposure)) {
            (Display::Brightest { .. }, _) => Self::Brightest,
            (Display::Exposed, Exposure::Auto) => Self::AutoExposed,
            (Display::Exposed, Exposure::Stops(stops)) => Self::Exposed(stops.get()),
        }
    }

    const fn looks_at_frame(&self) -> bool {
        matches!(self, Self::Brightest | Self::AutoExposed)
    }
}

/// The height of strips, and the side of tiles, as a number of slices.
const ROWS: usize = TILE_SIDE as usize;

/// A part of the frame that one thread works on.
struct Job<'a> {
    window: Window,
    /// Where the pixels go, and what they show first, if they are kept.
    kept: Option<(Strip<'a, Rgb, ROWS>, Option<Strip<'a, LayerPixel, ROWS>>)>,
}

/// What a thread knows about the pixels that it has done. The sum is the same in
/// whichever order, and by whichever threads, they are done.
struct Found {
    counts: RayCounts,
    peak: f32,
    /// Where the exposure depends on the pixels.
    meter: Option<LightMeter>,
}

impl Found {
    fn new(metered: Option<u64>) -> Self {
        let meter = metered.map(LightMeter::new);
        Self { counts: RayCounts::default(), peak: 0.0, meter }
    }
}

impl AddAssign for Found {
    fn add_assign(&mut self, other: Self) {
        self.counts += other.counts;
        self.peak = if other.peak > self.peak { other.peak } else { self.peak };
        if let (Some(meter), Some(other)) = (&mut self.meter, &other.meter) {
            *meter += other;
        }
    }
}

/// What the threads share while a picture is rendered.
struct Work<'a> {
    engine: &'a str,
    tracer: &'a dyn Tracer,
    settings: &'a RenderSettings<'a>,
    /// If the exposure depends on the pixels, how many there are in the frame.
    metered: Option<u64>,
    /// How many pixels there are to do.
    pixels: u64,
    pixels_done: AtomicU64,
}

impl Work<'_> {
    /// Does jobs until there are no more.
    fn do_jobs<'a>(
        &self,
        jobs: &Mutex<impl Iterator<Item = Job<'a>>>,
    ) -> Result<Found, RenderError> {
        let mut found = Found::new(self.metered);
        let next = || jobs.lock().unwrap_or_else(PoisonError::into_inner).next();
        while let Some(mut job) = next() {
            for tile in job.window.strips(TILE_SIDE, TILE_SIDE) {
                self.tile(tile, &mut job, &mut found)?;
            }
            if let Some(progress) = self.settings.progress {
                let pixels = job.window.pixels();
                let done = self.pixels_done.fetch_add(pixels, Ordering::Relaxed);
                progress(done + pixels, self.pixels);
            }
        }
        Ok(found)
    }

    fn tile(&self, tile: Window, job: &mut Job<'_>, found: &mut Found) -> Result<(), RenderError> {
        if self.settings.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed)) {
            return Err(RenderError::Interrupted);
        }
        let mut buffer = [[0.0; 3]; ROWS * ROWS];
        let pixels = &mut buffer[..tile.pixels() as usize];
        self.tracer.tile(tile, pixels, &mut found.counts);
        let peak = Film::peak(pixels);
        found.peak = if peak > found.peak { peak } else { found.peak };
        if let Some(meter) = &mut found.meter {
            meter.see(pixels);
        }
        if let Some((film, layers)) = &mut job.kept {
            film.put(tile, pixels);
            if let Some(layers) = layers {
                layers.put(tile, &self.first_hits(tile)?);
            }
        }
        Ok(())
    }

    /// What the rays of the pixels of a tile meet first.
    fn first_hits(&self, tile: Window) -> Result<Vec<LayerPixel>, RenderError> {
        let rows = tile.y..tile.y + tile.height;
        let places = rows.flat_map(|y| (tile.x..tile.x + tile.width).map(move |x| (x, y)));
        let hits: Option<_> = places.map(|(x, y)| self.tracer.first_hit(x, y)).collect();
        hits.ok_or_else(|| RenderError::NoLayers { engine: self.engine.to_owned() })
    }
}
