use crate::exposure::{MOST_STOPS, exposure_factor};
use crate::grid::Grid;
use crate::{Size, Strip, Window};

/// How the values of a film become codes of a picture file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Display {
    /// The original program's rule: all values are scaled so that the largest
    /// component of the whole frame, but at least `white`, becomes the top
    /// code, and are then truncated. No gamma.
    Brightest {
        /// The value of display white, in the film's unit.
        white: f32,
    },
    /// The values are linear radiance. They are multiplied by 2^stops (what
    /// [`Film::set_stops`] says), clipped to what is from 0 to 1, and encoded
    /// as sRGB; codes are the nearest.
    Exposed,
}

impl Display {
    /// The value of display white, in the film's unit; for exposed films that
    /// of 0 stops. Formats that hold linear values store a film divided by it.
    #[must_use]
    pub const fn white(self) -> f32 {
        match self {
            Self::Brightest { white } => white,
            Self::Exposed => 1.0,
        }
    }
}

/// Red, green and blue for each pixel of a window of a frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    grid: Grid<[f32; 3]>,
    display: Display,
    frame_peak: Option<f32>,
    stops: Option<f64>,
}

/// Why a film could not be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum FilmError {
    /// The window reaches out of the frame, or has no pixel.
    #[error("the window {window} (x,y,width,height) does not lie in a frame of {frame} pixels")]
    WindowOutside {
        /// The window asked for.
        window: Window,
        /// The frame it should lie in.
        frame: Size,
    },
    /// The system has not enough memory for so many pixels.
    #[error("not enough memory for {pixels} pixels ({bytes} bytes)")]
    OutOfMemory {
        /// How many pixels were asked for.
        pixels: u64,
        /// How many bytes they take.
        bytes: u64,
    },
}

impl Film {
    /// A black film.
    ///
    /// # Errors
    /// Where `window` does not fit in `frame`, or memory does not suffice.
    pub fn new(frame: Size, window: Window, display: Display) -> Result<Self, FilmError> {
        let grid = Grid::new(frame, window, [0.0; 3])?;
        Ok(Self { grid, display, frame_peak: None, stops: None })
    }

    /// The size of the frame that the film is a window of.
    #[must_use]
    pub const fn frame(&self) -> Size {
        self.grid.frame()
    }

    /// The window of the frame that the film holds.
    #[must_use]
    pub const fn window(&self) -> Window {
        self.grid.window()
    }

    /// How its values are meant to be shown.
    #[must_use]
    pub const fn display(&self) -> Display {
        self.display
    }

    /// The window's pixels, row by row from the top.
    #[must_use]
    pub fn pixels(&self) -> &[[f32; 3]] {
        self.grid.values()
    }

    /// The pixel at column `x` and row `y` of the frame.
    ///
    /// # Panics
    /// Where that pixel is not in the window.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> [f32; 3] {
        self.grid.get(x, y)
    }

    /// Writes `values`, row by row, to the pixels of `tile` (in the frame's
    /// coordinates).
    ///
    /// # Panics
    /// Where `tile` reaches out of the film's window, or `values` has another
    /// number of pixels.
    pub fn put(&mut self, tile: Window, values: &[[f32; 3]]) {
        self.grid.put(tile, values);
    }

    /// The film in strips of that width and of `ROWS` rows, row by row from its top
    /// left corner, for several threads to write to at once; those at the right and
    /// at the bottom may be smaller.
    ///
    /// # Panics
    /// Where `width` or `ROWS` is 0.
    pub fn strips_mut<const ROWS: usize>(
        &mut self,
        width: u32,
    ) -> impl Iterator<Item = Strip<'_, [f32; 3], ROWS>> {
        self.grid.strips_mut(width)
    }

    /// The largest component of the whole frame, at least 0, where it is known.
    ///
    /// A film of the whole frame knows it; one of a part knows it only if the
    /// renderer has looked at the rest and said so.
    #[must_use]
    pub fn frame_peak(&self) -> Option<f32> {
        let whole = self.window() == self.frame().window();
        self.frame_peak.or_else(|| whole.then(|| Self::peak(self.pixels())))
    }

    /// Says what the largest component of the whole frame is.
    pub fn set_frame_peak(&mut self, peak: f32) {
        self.frame_peak = Some(peak);
    }

    /// The largest component of `values`, at least 0; NaN is passed over.
    #[must_use]
    pub fn peak(values: &[[f32; 3]]) -> f32 {
        let larger = |peak: f32, &v: &f32| if v > peak { v } else { peak };
        // Several at a time, which the processor's wide registers can do at once.
        let mut peaks = [0.0; 16];
        let (runs, rest) = values.as_flattened().as_chunks::<16>();
        for run in runs {
            for (peak, v) in peaks.iter_mut().zip(run) {
                *peak = larger(*peak, v);
            }
        }
        peaks.iter().chain(rest).fold(0.0, larger)
    }

    /// How many stops it is to be shown with, where that has been said.
    #[must_use]
    pub const fn stops(&self) -> Option<f64> {
        self.stops
    }

    /// Says how many stops it is to be shown with, from -[`MOST_STOPS`] to
    /// [`MOST_STOPS`]: a choice, or what a [`LightMeter`](crate::LightMeter) finds
    /// for the whole frame. Its values stay as they are.
    ///
    /// # Panics
    /// Where `stops` is not in that range.
    pub fn set_stops(&mut self, stops: f64) {
        let possible = stops.abs() <= MOST_STOPS;
        assert!(possible, "{stops} stops are not from -{MOST_STOPS} to {MOST_STOPS}");
        self.stops = Some(stops);
    }

    /// What its values are multiplied by to be shown, 2^stops, where that has
    /// been said.
    #[must_use]
    pub fn exposure(&self) -> Option<f64> {
        self.stops.map(exposure_factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DISPLAY: Display = Display::Brightest { white: 255.0 };

    #[test]
    fn a_crop_holds_the_same_pixels_as_the_whole() {
        let frame = Size::new(7, 5);
        let values: Vec<_> = (0..35_u8).map(|i| [f32::from(i), 0.0, 0.5]).collect();
        let mut whole = Film::new(frame, frame.window(), DISPLAY).expect("fits");
        whole.put(frame.window(), &values);
        let window = Window { x: 2, y: 1, width: 3, height: 2 };
        let mut crop = Film::new(frame, window, DISPLAY).expect("fits");
        for y in 1..3 {
            for x in 2..5 {
                let tile = Window { x, y, width: 1, height: 1 };
                crop.put(tile, &[whole.pixel(x, y)]);
                assert_eq!(crop.pixel(x, y), whole.pixel(x, y));
            }
        }
        assert_eq!(crop.pixels()[4], [17.0, 0.0, 0.5]);
    }

    #[test]
    fn a_crop_does_not_know_the_peak_of_the_frame() {
        let frame = Size::new(2, 1);
        let mut whole = Film::new(frame, frame.window(), DISPLAY).expect("fits");
        whole.put(frame.window(), &[[1.0, f32::NAN, 300.0], [2.0, 2.0, 2.0]]);
        assert_eq!(whole.frame_peak(), Some(300.0));
        let window = Window { x: 1, y: 0, width: 1, height: 1 };
        let mut crop = Film::new(frame, window, DISPLAY).expect("fits");
        assert_eq!(crop.frame_peak(), None);
        crop.set_frame_peak(300.0);
        assert_eq!(crop.frame_peak(), Some(300.0));
    }

    #[test]
    fn the_peak_is_found_wherever_it_is() {
        for count in [0, 1, 5, 16, 17, 256] {
            let mut values = vec![[0.5, -1.0, f32::NAN]; count];
            assert_eq!(Film::peak(&values), if count == 0 { 0.0 } else { 0.5 });
            for place in 0..3 * count {
                values[place / 3][place % 3] = 0.75;
                assert_eq!(Film::peak(&values), 0.75, "place {place} of {count} pixels");
                values[place / 3] = [0.5, -1.0, f32::NAN];
            }
        }
    }

    #[test]
    fn impossible_films_are_refused() {
        let frame = Size::new(10, 10);
        let window = Window { x: 5, y: 5, width: 6, height: 1 };
        assert_eq!(
            Film::new(frame, window, DISPLAY).expect_err("outside").to_string(),
            "the window 5,5,6,1 (x,y,width,height) does not lie in a frame of 10x10 pixels"
        );
        let huge = Size::new(u32::MAX, u32::MAX);
        assert!(matches!(
            Film::new(huge, huge.window(), DISPLAY),
            Err(FilmError::OutOfMemory { .. })
        ));
    }

    #[test]
    fn stops_are_kept_beside_the_values() {
        let frame = Size::new(2, 1);
        let mut film = Film::new(frame, frame.window(), Display::Exposed).expect("fits");
        film.put(frame.window(), &[[0.5, 1.0, 3e30], [0.0; 3]]);
        assert_eq!((film.stops(), film.exposure()), (None, None));
        film.set_stops(-3.0);
        assert_eq!((film.stops(), film.exposure()), (Some(-3.0), Some(0.125)));
        assert_eq!(film.pixel(0, 0), [0.5, 1.0, 3e30]);
        assert_eq!(film.display().white(), 1.0);
        film.set_stops(MOST_STOPS);
        assert!(film.exposure().is_some_and(f64::is_finite));
    }

    #[test]
    #[should_panic(expected = "NaN stops are not from -1000 to 1000")]
    fn stops_are_numbers() {
        let frame = Size::new(1, 1);
        let mut film = Film::new(frame, frame.window(), Display::Exposed).expect("fits");
        film.set_stops(f64::NAN);
    }
}
