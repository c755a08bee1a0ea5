//! The truth about a scene, to judge the fast crates by.
//!
//! Numbers are taken as they stand, and what follows from them is computed without
//! rounding as far as it goes: whether a line meets a shape is the sign of an exact
//! number. Where it meets it is right to as many bits as are asked for. Everything
//! is written from textbooks in the simplest form that is right, is slow, and shares
//! no formula with the crates that it judges, but what a mesh says of itself (whether it is
//! closed, and its signed volume); no crate of the program may use it.
//!
//! ```
//! use lancer_math::{Point, Ray, Vector};
//! use lancer_oracle::{Line, Space, crossings};
//! use lancer_scene::{Colour, Shape, Surface};
//!
//! let sphere = Shape::sphere([0.0; 3], 1.0, Surface::new(Colour::RED))?;
//! let ray = Ray::new(Point::new(0.9, 0.0, -1e9), Vector::z());
//! let found = crossings(&sphere.geometry, &Space::world(), &Line::from(&ray), 300);
//! assert_eq!(found.list.len(), 2);
//! // 1e9 - sqrt(1 - 0.9^2), where 0.9 is the nearest double.
//! assert_eq!(found.list[0].t.to_f64(), 1e9 - 0.435_889_894_354_067_3);
//! # Ok::<(), lancer_scene::InvalidField>(())
//! ```
#![forbid(unsafe_code)]

mod camera;
mod crossing;
mod light;
mod line;
mod number;
mod optics;
mod pattern;
mod polynomial;
mod quadratic;
mod shapes;
mod stops;
mod tracer;
mod vector;
mod world;

pub use camera::pixel_line;
pub use crossing::{Crossing, Crossings, Passage};
pub use line::{Line, Space};
pub use number::Number;
pub use optics::{Refraction, fresnel, reflect, refract, sheet};
pub use polynomial::{Polynomial, RealRoot};
pub use shapes::{crossings, inside, passages};
pub use stops::Stop;
pub use tracer::{Branch, Kind, Pixel, Rgb, Tracer};
pub use vector::Triple;
pub use world::{Hit, Hits, Item, World};

/// Where a point is with respect to a solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In it.
    Inside,
    /// On its surface, exactly.
    Border,
    /// Out of it.
    Outside,
}

impl Place {
    fn of_sign(value: &Number) -> Self {
        match value.signum() {
            -1 => Self::Inside,
            0 => Self::Border,
            _ => Self::Outside,
        }
    }
}
