use crate::{Engine, RayCounts, Rgb, Tracer};
use lancer_film::{Film, FilmError, Size, Window};
use lancer_scene::Scene;
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
    /// Whether the film must know the largest component of the whole frame
    /// even where it keeps only a part. Then the whole frame is rendered.
    pub frame_peak: bool,
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
    /// The picture.
    pub film: Film,
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
    /// The work was cancelled.
    #[error("interrupted")]
    Interrupted,
}

/// Renders `scene` with `engine`.
///
/// # Errors
/// Where the window does not lie in the frame, memory or threads cannot be
/// had, or the work was cancelled.
pub fn render(
    scene: &Scene,
    engine: &dyn Engine,
    settings: &RenderSettings<'_>,
) -> Result<Rendered, RenderError> {
    let frame = Size::new(scene.camera.px_width.get(), scene.camera.px_height.get());
    let window = settings.window.unwrap_or_else(|| frame.window());
    let film = Film::new(frame, window, engine.display())?;
    let to_do = if settings.frame_peak { frame.window() } else { window };

    let threads = threads_for(settings.threads, to_do.tile_count(TILE_SIDE));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|reason| RenderError::Threads { threads, reason })?;

    let tracer = engine.prepare(scene);
    let work = Work {
        tracer: &*tracer,
        to_do,
        settings,
        pixels_done: AtomicU64::new(0),
        picture: Mutex::new(Picture { film, peak: 0.0, counts: RayCounts::default() }),
    };
    pool.install(|| {
        (0..to_do.tile_count(TILE_SIDE)).into_par_iter().try_for_each(|index| work.tile(index))
    })?;

    let Picture { mut film, peak, counts } =
        work.picture.into_inner().unwrap_or_else(PoisonError::into_inner);
    if to_do == frame.window() {
        film.set_frame_peak(peak);
    }
    Ok(Rendered { film, counts, threads })
}

/// No more threads than tiles: others would have nothing to do.
fn threads_for(asked: Option<NonZeroUsize>, tiles: u64) -> usize {
    let cores = || std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let threads = asked.unwrap_or_else(cores).get();
    threads.min(usize::try_from(tiles).unwrap_or(usize::MAX)).max(1)
}

/// What the threads share while a picture is rendered.
struct Work<'a> {
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
        let Some(kept) = tile.intersection(picture.film.window()) else { return };
        for y in kept.y..kept.y + kept.height {
            let start = ((y - tile.y) * tile.width + (kept.x - tile.x)) as usize;
            let row = Window { y, height: 1, ..kept };
            picture.film.put(row, &pixels[start..start + kept.width as usize]);
        }
    }
}
