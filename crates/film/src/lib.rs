//! Picture buffers: what a renderer fills and an encoder reads.
//!
//! A [`Film`] holds linear values for a [`Window`] of a frame, and says how
//! they are meant to be shown ([`Display`]); [`Layers`] beside it hold what is
//! seen first at each pixel. They know no engine and no format.
//!
//! ```
//! use lancer_film::{Display, Film, Size, Window};
//!
//! let frame = Size::new(4, 3);
//! let mut film = Film::new(frame, frame.window(), Display::Brightest { white: 255.0 })?;
//! let corner = Window { x: 2, y: 1, width: 2, height: 2 };
//! film.put(corner, &[[255.0, 0.0, 0.0]; 4]);
//! assert_eq!(film.pixel(3, 2), [255.0, 0.0, 0.0]);
//! assert_eq!(film.pixel(0, 0), [0.0, 0.0, 0.0]);
//! # Ok::<(), lancer_film::FilmError>(())
//! ```
//!
//! Radiance is shown by an exposure, which a rule finds for the whole frame:
//!
//! ```
//! use lancer_film::{Display, Film, LightMeter, Size};
//!
//! let frame = Size::new(3, 1);
//! let mut film = Film::new(frame, frame.window(), Display::Exposed)?;
//! film.put(frame.window(), &[[4.0, 3.0, 2.0], [0.0, 0.0, 0.0], [0.1, 0.5, 0.1]]);
//! let mut meter = LightMeter::new(3);
//! meter.see(film.pixels());
//! film.set_stops(meter.stops());
//! assert_eq!(film.stops(), Some(-2.0));
//! # Ok::<(), lancer_film::FilmError>(())
//! ```
#![forbid(unsafe_code)]

mod exposure;
mod film;
mod grid;
mod layers;
mod quality;
mod strips;
mod window;

pub use exposure::{LightMeter, MOST_STOPS, exposure_factor};
pub use film::{Display, Film, FilmError};
pub use layers::{LayerKind, LayerPixel, Layers};
pub use quality::{PixelQuality, Quality};
pub use strips::Strip;
pub use window::{Size, Window};
