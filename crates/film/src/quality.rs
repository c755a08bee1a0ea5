//! What is known of how good a film's pixels are.

use crate::grid::Grid;
use crate::{FilmError, Size, Strip, Window};

/// What is known of a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PixelQuality {
    /// The root of the mean square that its error is expected to have, in exposed linear units,
    /// clipped (1 is display white), over its components.
    pub error: f32,
    /// What its error does not exceed in 95 pixels of 100 like it.
    pub interval: f32,
    /// How many samples it has.
    pub samples: u32,
}

/// That of each pixel of a window of a frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Quality {
    grid: Grid<PixelQuality>,
}

impl Quality {
    /// Of pixels without samples, which are sure to be black.
    ///
    /// # Errors
    /// Where `window` does not fit in `frame`, or memory does not suffice.
    pub fn new(frame: Size, window: Window) -> Result<Self, FilmError> {
        Ok(Self { grid: Grid::new(frame, window, PixelQuality::default())? })
    }

    /// The size of the frame that it is of a window of.
    #[must_use]
    pub const fn frame(&self) -> Size {
        self.grid.frame()
    }

    /// The window of the frame that it is of.
    #[must_use]
    pub const fn window(&self) -> Window {
        self.grid.window()
    }

    /// The window's pixels, row by row from the top.
    #[must_use]
    pub fn pixels(&self) -> &[PixelQuality] {
        self.grid.values()
    }

    /// The pixel at column `x` and row `y` of the frame.
    ///
    /// # Panics
    /// Where that pixel is not in the window.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> PixelQuality {
        self.grid.get(x, y)
    }

    /// It in strips of that width and of `ROWS` rows, as those of
    /// [`Film::strips_mut`](crate::Film::strips_mut).
    ///
    /// # Panics
    /// Where `width` or `ROWS` is 0.
    pub fn strips_mut<const ROWS: usize>(
        &mut self,
        width: u32,
    ) -> impl Iterator<Item = Strip<'_, PixelQuality, ROWS>> {
        self.grid.strips_mut(width)
    }

    /// Writes `values`, row by row, to the pixels of `tile` (in the frame's
    /// coordinates).
    ///
    /// # Panics
    /// Where `tile` reaches out of the window, or `values` has another number
    /// of pixels.
    pub fn put(&mut self, tile: Window, values: &[PixelQuality]) {
        self.grid.put(tile, values);
    }
}
