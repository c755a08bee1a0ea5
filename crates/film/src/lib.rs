//! Picture buffers: what a renderer fills and an encoder reads.
//!
//! A [`Film`] holds linear values for a [`Window`] of a frame, and says how
//! they are meant to be shown ([`Display`]). It knows no engine and no format.
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
#![forbid(unsafe_code)]

mod film;
mod window;

pub use film::{Display, Film, FilmError};
pub use window::{Size, Window};
