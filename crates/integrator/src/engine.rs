use crate::{Classic, Direct, Lint, Plan, RayCounts, Sampler, TILE_SIDE, Whitted};
use lancer_film::{Display, LayerPixel, Window};
use lancer_kernel::LEAN;
use lancer_scene::Scene;

/// Red, green and blue in the unit of the film's [`Display`].
pub type Rgb = [f32; 3];

/// A way of turning a scene into a picture.
///
/// An engine holds its own settings, if any. What it derives from a scene goes
/// into the [`Tracer`] that it prepares, once for each picture.
pub trait Engine: Sync {
    /// The name by which users choose it.
    fn name(&self) -> &str;

    /// What the engine does, in a line for `--help`.
    fn summary(&self) -> &str;

    /// How its values are meant to be shown. By default as the original
    /// program shows its own: 255 is white, and brighter pictures are scaled
    /// down.
    fn display(&self) -> Display {
        Display::Brightest { white: 255.0 }
    }

    /// What a user should know about this scene in this engine: what will look wrong, and what to do.
    fn warnings(&self, scene: &Scene) -> Vec<Lint> {
        let _ = scene;
        Vec::new()
    }

    /// What is in this scene that the engine cannot show, as sentences without
    /// a full stop. Such a scene is not rendered.
    fn refusals(&self, scene: &Scene) -> Vec<String> {
        let _ = scene;
        Vec::new()
    }

    /// Makes ready to render `scene`, which it does not refuse, by a plan for it. Whatever that leaves
    /// out may be done all the same.
    fn prepare<'s>(&'s self, scene: &'s Scene, plan: &Plan) -> Box<dyn Tracer + 's>;
}

/// An engine made ready for one scene. It is shared by all threads.
///
/// The answer for a pixel must depend on the pixel alone: not on the order in
/// which pixels are asked for, nor on the thread that asks.
pub trait Tracer: Sync {
    /// The colour of the pixel at column `x` and row `y` of the frame; row 0
    /// is at the top. Adds the rays followed to `counts`.
    fn pixel(&self, x: u32, y: u32, counts: &mut RayCounts) -> Rgb;

    /// What the ray of the pixel's centre meets first; `None` where the engine
    /// does not say.
    fn first_hit(&self, x: u32, y: u32) -> Option<LayerPixel> {
        let _ = (x, y);
        None
    }

    /// Itself, where it sees any place of the picture and not only pixels' centres.
    fn sampler(&self) -> Option<&dyn Sampler> {
        None
    }

    /// The colours of a tile, row by row; `pixels` has one place for each.
    fn tile(&self, tile: Window, pixels: &mut [Rgb], counts: &mut RayCounts) {
        let columns = tile.x..tile.x + tile.width;
        let places =
            (tile.y..tile.y + tile.height).flat_map(|y| columns.clone().map(move |x| (x, y)));
        for ((x, y), pixel) in places.zip(pixels) {
            *pixel = self.pixel(x, y, counts);
        }
    }
}

/// The engines that are built in; the first is the usual one.
#[must_use]
pub fn engines() -> &'static [&'static dyn Engine] {
    const WHITTED: Whitted = Whitted::new();
    if LEAN { &[&WHITTED] } else { &[&WHITTED, &Classic, &Direct] }
}

/// The built-in engine of that name.
#[must_use]
pub fn engine_by_name(name: &str) -> Option<&'static dyn Engine> {
    engines().iter().copied().find(|engine| engine.name() == name)
}

/// Has a tile coloured in parts of at most [`TILE_SIDE`] by as many pixels, as stages
/// have room for.
pub(crate) fn in_parts(
    window: Window,
    pixels: &mut [Rgb],
    mut part: impl FnMut(Window, &mut [Rgb]),
) {
    if window.width <= TILE_SIDE && window.height <= TILE_SIDE {
        return part(window, pixels);
    }
    let mut buffer = [[0.0; 3]; (TILE_SIDE * TILE_SIDE) as usize];
    for top in (0..window.height).step_by(TILE_SIDE as usize) {
        for left in (0..window.width).step_by(TILE_SIDE as usize) {
            let (width, height) =
                (TILE_SIDE.min(window.width - left), TILE_SIDE.min(window.height - top));
            let small = Window { x: window.x + left, y: window.y + top, width, height };
            let colours = &mut buffer[..small.pixels() as usize];
            part(small, colours);
            for (row, y) in colours.chunks_exact(width as usize).zip(top..) {
                let start = y as usize * window.width as usize + left as usize;
                pixels[start..start + row.len()].copy_from_slice(row);
            }
        }
    }
}
