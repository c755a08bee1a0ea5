use crate::{FilmError, Size, Window};

/// A value for each pixel of a window of a frame, row by row from the top:
/// what [`Film`](crate::Film) and [`Layers`](crate::Layers) have in common.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Grid<T> {
    frame: Size,
    window: Window,
    values: Vec<T>,
}

impl<T: Copy> Grid<T> {
    /// A grid of nothing but `background`.
    ///
    /// # Errors
    /// Where `window` does not fit in `frame`, or memory does not suffice.
    pub(crate) fn new(frame: Size, window: Window, background: T) -> Result<Self, FilmError> {
        if !window.fits(frame) {
            return Err(FilmError::WindowOutside { window, frame });
        }
        let pixels = window.pixels();
        let bytes = pixels.saturating_mul(size_of::<T>() as u64);
        let out_of_memory = FilmError::OutOfMemory { pixels, bytes };
        let count = usize::try_from(pixels).map_err(|_| out_of_memory)?;
        // Asks whether there is enough; what `vec!` then takes is, if the
        // background is all zeros, there without being written to.
        Vec::<T>::new().try_reserve_exact(count).map_err(|_| out_of_memory)?;
        Ok(Self { frame, window, values: vec![background; count] })
    }

    /// The size of the frame.
    pub(crate) const fn frame(&self) -> Size {
        self.frame
    }

    /// The window that the values are of.
    pub(crate) const fn window(&self) -> Window {
        self.window
    }

    /// All values, row by row from the top.
    pub(crate) fn values(&self) -> &[T] {
        &self.values
    }

    /// The same, to be written to.
    pub(crate) fn values_mut(&mut self) -> &mut [T] {
        &mut self.values
    }

    /// The value at column `x` and row `y` of the frame.
    ///
    /// # Panics
    /// Where that pixel is not in the window.
    pub(crate) fn get(&self, x: u32, y: u32) -> T {
        self.values[self.row_start(x, y)]
    }

    /// Writes `values`, row by row, to the pixels of `tile` (in the frame's
    /// coordinates).
    ///
    /// # Panics
    /// Where `tile` reaches out of the window, or `values` has another number
    /// of pixels.
    pub(crate) fn put(&mut self, tile: Window, values: &[T]) {
        assert_eq!(values.len() as u64, tile.pixels(), "one value for each pixel");
        assert_eq!(tile.intersection(self.window), Some(tile), "the tile lies in the window");
        let width = tile.width as usize;
        for (row, y) in values.chunks_exact(width).zip(tile.y..) {
            let start = self.row_start(tile.x, y);
            self.values[start..start + width].copy_from_slice(row);
        }
    }

    fn row_start(&self, x: u32, y: u32) -> usize {
        let inside = Window { x, y, width: 1, height: 1 }.intersection(self.window).is_some();
        assert!(inside, "pixel {x},{y} is outside the window {}", self.window);
        (y - self.window.y) as usize * self.window.width as usize + (x - self.window.x) as usize
    }
}
