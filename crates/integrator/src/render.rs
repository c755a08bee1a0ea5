use crate::{Engine, RayCounts, Rgb, Tracer};
use lancer_film::{Display, Film, FilmError, LayerPixel, Layers, Size, Window, auto_stops};
use lancer_kernel::KernelSettings;
use lancer_scene::{Exposure, Scene};
use rayon::prelude::*;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

/// The side of the square tiles that a frame is cut into, in pixels.
pub const TILE_SIDE: u32 = 16;

/// How a picture is to be rendered. None of it changes the value of a pixel.
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
    /// How rays are followed.
    pub kernel: KernelSettings,
    /// How many threads to use; one for each core by default.
    pub threads: Option<NonZeroUsize>,
    /// Called now and then, from any thread, as work goes on.
    pub progress: Option<&'a Progress<'a>>,
    /// Once this is true the work stops and [`RenderError::Interrupted`] is
    /// returned.
    pub cancel: Option<&'a AtomicBool>,
}

/// Is told how many pixels are done and how many there are to do. Calls come
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
    let exposure = Showing::new(scene, engine, settings);
    let to_do =
        if settings.for_display && exposure.looks_at_frame() { frame.window() } else { window };
    let is_whole = to_do == frame.window();
    let brightest = (is_whole && exposure == Showing::AutoExposed)
        .then(|| reserve(frame.pixels()))
        .transpose()?;

    let threads = threads_for(settings.threads, to_do.tile_count(TILE_SIDE));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|reason| RenderError::Threads { threads, reason })?;

    let tracer = engine.prepare(scene, &settings.kernel);
    let work = Work {
        engine: engine.name(),
        tracer: &*tracer,
        to_do,
        settings,
        pixels_done: AtomicU64::new(0),
        picture: Mutex::new(Picture {
            film,
            layers,
            brightest,
            peak: 0.0,
            counts: RayCounts::default(),
        }),
    };
    pool.install(|| {
        (0..to_do.tile_count(TILE_SIDE)).into_par_iter().try_for_each(|index| work.tile(index))
    })?;

    let Picture { mut film, layers, brightest, peak, counts } =
        work.picture.into_inner().unwrap_or_else(PoisonError::into_inner);
    match (exposure, brightest) {
        (Showing::Exposed(stops), _) => film.set_stops(stops),
        (_, Some(mut brightest)) => film.set_stops(auto_stops(&mut brightest)),
        _ => {}
    }
    if is_whole {
        film.set_frame_peak(peak);
    }
    Ok(Rendered { film, layers, counts, threads })
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

/// A number for each pixel.
fn reserve(pixels: u64) -> Result<Vec<f32>, FilmError> {
    let out_of_memory = FilmError::OutOfMemory { pixels, bytes: pixels.saturating_mul(4) };
    let count = usize::try_from(pixels).map_err(|_| out_of_memory)?;
    Vec::<f32>::new().try_reserve_exact(count).map_err(|_| out_of_memory)?;
    Ok(vec![0.0; count])
}

/// No more threads than tiles: others would have nothing to do.
fn threads_for(asked: Option<NonZeroUsize>, tiles: u64) -> usize {
    let cores = || std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let threads = asked.unwrap_or_else(cores).get();
    threads.min(usize::try_from(tiles).unwrap_or(usize::MAX)).max(1)
}

/// What the threads share while a picture is rendered.
struct Work<'a> {
    engine: &'a str,
    tracer: &'a dyn Tracer,
    to_do: Window,
    settings: &'a RenderSettings<'a>,
    pixels_done: AtomicU64,
    picture: Mutex<Picture>,
}

/// What the tiles are put together into. Each part is the same in whichever
/// order they arrive: pixels have places, counts are whole numbers, and the
/// largest value of a set needs no order.
struct Picture {
    film: Film,
    layers: Option<Layers>,
    /// The brightest component of each pixel of the frame.
    brightest: Option<Vec<f32>>,
    peak: f32,
    counts: RayCounts,
}

impl Work<'_> {
    fn tile(&self, index: u64) -> Result<(), RenderError> {
        if self.settings.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed)) {
            return Err(RenderError::Interrupted);
        }
        let tile = self.to_do.tile(TILE_SIDE, index);
        let mut buffer: [Rgb; (TILE_SIDE * TILE_SIDE) as usize] =
            [[0.0; 3]; (TILE_SIDE * TILE_SIDE) as usize];
        let pixels = &mut buffer[..tile.pixels() as usize];
        let mut counts = RayCounts::default();
        self.tracer.tile(tile, pixels, &mut counts);
        self.deliver(tile, pixels, counts);
        if self.settings.layers {
            self.layers(tile)?;
        }

        if let Some(progress) = self.settings.progress {
            let done = self.pixels_done.fetch_add(tile.pixels(), Ordering::Relaxed);
            progress(done + tile.pixels(), self.to_do.pixels());
        }
        Ok(())
    }

    fn deliver(&self, tile: Window, pixels: &[Rgb], counts: RayCounts) {
        let peak = Film::peak(pixels);
        let mut picture = self.picture.lock().unwrap_or_else(PoisonError::into_inner);
        picture.counts += counts;
        picture.peak = if peak > picture.peak { peak } else { picture.peak };
        if let Some(brightest) = &mut picture.brightest {
            let frame = self.to_do;
            for (row, y) in pixels.chunks_exact(tile.width as usize).zip(tile.y..) {
                let start = y as usize * frame.width as usize + tile.x as usize;
                for (brightest, pixel) in brightest[start..].iter_mut().zip(row) {
                    *brightest = Film::peak(std::slice::from_ref(pixel));
                }
            }
        }
        let Some(kept) = tile.intersection(picture.film.window()) else { return };
        for y in kept.y..kept.y + kept.height {
            let start = ((y - tile.y) * tile.width + (kept.x - tile.x)) as usize;
            let row = Window { y, height: 1, ..kept };
            picture.film.put(row, &pixels[start..start + kept.width as usize]);
        }
    }

    /// What the rays of the pixels that are kept meet first.
    fn layers(&self, tile: Window) -> Result<(), RenderError> {
        let window = self.settings.window.unwrap_or(self.to_do);
        let Some(kept) = tile.intersection(window) else { return Ok(()) };
        let rows = kept.y..kept.y + kept.height;
        let places = rows.flat_map(|y| (kept.x..kept.x + kept.width).map(move |x| (x, y)));
        let hits: Option<Vec<LayerPixel>> =
            places.map(|(x, y)| self.tracer.first_hit(x, y)).collect();
        let hits = hits.ok_or_else(|| RenderError::NoLayers { engine: self.engine.to_owned() })?;
        let mut picture = self.picture.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(layers) = &mut picture.layers {
            layers.put(kept, &hits);
        }
        Ok(())
    }
}
