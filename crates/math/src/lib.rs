//! Points, vectors, rays, bounds and placements on top of nalgebra, and
//! elementary functions that give the same bits on every machine.
//!
//! This is the lowest crate of Lancer. It knows no shape, no file and no
//! thread. All coordinates are double precision, right-handed, with z up by
//! the convention of the scene language.
//!
//! ```
//! use lancer_math::{Point, Ray, Vector, unit};
//!
//! let eye = Point::new(1.0, 0.0, 3.0);
//! let target = Point::new(4.0, 5.0, 2.0);
//! let ray = Ray::new(eye, unit(target - eye).expect("the points differ"));
//! let distance = (target - eye).norm();
//! assert!((ray.at(distance) - target).norm() < 1e-15);
//!
//! // A direction may have any length that a number can have.
//! assert_eq!(unit(Vector::new(0.0, 3e-200, 4e-200)), Some(Vector::new(0.0, 0.6, 0.8)));
//! ```
#![forbid(unsafe_code)]

mod bounds;
mod degrees;
pub mod elementary;
mod placement;
mod ray;
pub mod srgb;
mod unit;

pub use bounds::Bounds;
pub use degrees::sin_cos_degrees;
pub use placement::Placement;
pub use ray::Ray;
pub use unit::unit;

/// A position in the world: three coordinates in scene lengths.
pub type Point = nalgebra::Point3<f64>;

/// A displacement or a direction; no normalisation is implied.
pub type Vector = nalgebra::Vector3<f64>;
