//! Films to picture files, and how much two pictures differ.
//!
//! This crate makes and reads bytes; it opens no file and knows no engine.
//!
//! ```
//! use lancer_film::{Display, Film, Size};
//! use lancer_output::{Bits, Format, compare, decode, encode};
//!
//! let frame = Size::new(2, 1);
//! let mut film = Film::new(frame, frame.window(), Display::Brightest { white: 255.0 })?;
//! film.put(frame.window(), &[[255.0, 0.0, 0.0], [510.0, 255.0, 0.0]]);
//!
//! // The brightest component is 510, so all values are halved.
//! let ppm = encode(&film, Format::Ppm, Bits::Eight)?;
//! assert_eq!(ppm, b"P6\n2 1\n255\n\x7f\0\0\xff\x7f\0");
//!
//! let png = encode(&film, Format::Png, Bits::Eight)?;
//! let comparison = compare(&decode(&ppm)?, &decode(&png)?)?;
//! assert_eq!(comparison.differing, 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

mod compare;
mod decode;
mod display;
mod encode;
mod format;

pub use compare::{Comparison, SizesDiffer, compare, difference_picture};
pub use decode::{DecodeError, Picture, decode};
pub use display::{PeakUnknown, to_rgb8};
pub use encode::{EncodeError, encode, encode_rgb8};
pub use format::{Bits, Format};
