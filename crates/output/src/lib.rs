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
//!
//! Layers go into an OpenEXR file, beside the picture:
//!
//! ```
//! use lancer_film::{Display, Film, LayerKind, LayerPixel, Layers, Size};
//! use lancer_output::{decode, encode_exr_with_layers};
//!
//! let frame = Size::new(2, 1);
//! let mut film = Film::new(frame, frame.window(), Display::Exposed)?;
//! let mut layers = Layers::new(frame, frame.window())?;
//! film.put(frame.window(), &[[0.5, 2.0, 0.0], [0.1, 0.1, 0.4]]);
//! let hit = LayerPixel { axis_depth: 3.0, ray_depth: 3.5, shape: 1, ..LayerPixel::MISS };
//! layers.put(frame.window(), &[hit, LayerPixel::MISS]);
//! let exr = encode_exr_with_layers(
//!     &film,
//!     Some(&layers),
//!     None,
//!     &[LayerKind::Depth, LayerKind::Shape],
//! )?;
//! assert_eq!(decode(&exr)?.levels(0)[1], 2.0 * 255.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

mod compare;
mod decode;
mod display;
mod encode;
mod exr_layers;
mod format;
mod srgb_codes;

pub use compare::{Comparison, SizesDiffer, compare, difference_picture};
pub use decode::{DecodeError, Picture, decode};
pub use display::{NotShowable, to_rgb8};
pub use encode::{EncodeError, encode, encode_rgb8};
pub use exr_layers::encode_exr_with_layers;
pub use format::{Bits, Format};
