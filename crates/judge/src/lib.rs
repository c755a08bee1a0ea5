//! How far pictures are from the true one, what time that took, and charts of it.
//!
//! The *true picture* is the mean over each pixel of the radiance that an engine sees. The
//! *error* of a picture is the root of the mean square, over pixels and channels, of its
//! differences to the true one, in exposed linear units clipped to 0 to 1 after averaging
//! ([`Picture::error`]). What it is held against is made by brute force, in a way that
//! shares nothing with how pictures are sampled, and says how wrong it is itself
//! ([`reference()`]).
//!
//! Time against error makes a [`Comparison`]: some of its points are beaten by none
//! ([`Comparison::front`]), and on one of these time is spent best ([`Comparison::knee`]). It
//! is drawn as SVG, PNG and HTML and written as CSV.
//!
//! ```
//! use lancer_judge::{Comparison, Point, Series};
//!
//! let point = |setting: &str, seconds, error| Point::new(setting, seconds, error);
//! let even = Series::new("stratified", vec![point("--samples 16", 0.8, 0.0042)]);
//! let edges = Series::new("edges", vec![
//!     point("--error 0.004", 0.03, 0.0038),
//!     point("--error 0.001", 0.11, 0.0009),
//!     point("--error 0.0005", 0.40, 0.0005),
//! ]);
//! let comparison = Comparison::new(vec![even, edges]);
//! let knee = comparison.knee().ok_or("there are points")?;
//! assert_eq!(comparison.point(knee).setting, "--error 0.001");
//! # Ok::<(), &str>(())
//! ```
#![forbid(unsafe_code)]

mod axis;
mod chart;
mod compared;
mod csv;
mod drawing;
mod pages;
mod picture;
mod reference;
mod trials;

pub use compared::{Comparison, Place, Point, Series, error, time};
pub use csv::csv;
pub use drawing::{Drawing, Raster};
pub use pages::{Caption, draw, html, scatter};
pub use picture::{Exposed, Picture};
pub use reference::{Reference, ReferenceSettings, reference};
pub use trials::{Ladder, Subject, Trial};
