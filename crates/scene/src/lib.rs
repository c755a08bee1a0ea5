//! The description of a scene: camera, lights and shapes with their surfaces.
//!
//! Everything here is plain data made of values that cannot be wrong: a
//! [`Length`] is positive, a [`Fraction`] lies in [0, 1], a [`Direction`] is not
//! zero, and so on. So whoever holds a [`Scene`] need not check it again.
//! This crate knows no file, no XML and no way of finding a hit faster.
//!
//! ```
//! use lancer_scene::{Camera, Colour, Light, Scene, Shape, Surface};
//!
//! let scene = Scene::builder()
//!     .camera(Camera::new([1.0, 0.0, 3.0], [4.0, 5.0, 2.0], 3.3, [400, 300]))
//!     .light(Light::lamp([5.0, 5.0, 4.0], 1.5))
//!     .shape(Shape::sphere([6.0, 11.0, 1.0], 1.0, Surface::new(Colour::GREY).gloss(1.0)))
//!     .shape(Shape::plane([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], Surface::new(Colour::BLUE)))
//!     .build()?;
//! assert_eq!(scene.shapes.len(), 2);
//!
//! // Every mistake is named, with its place, in one go.
//! let mistakes = Scene::builder()
//!     .camera(Camera::new([0.0; 3], [0.0; 3], 1.0, [4, 3]))
//!     .shape(Shape::sphere([0.0; 3], -1.0, Surface::new(Colour::RED)))
//!     .build()
//!     .unwrap_err();
//! assert_eq!(
//!     mistakes.to_string(),
//!     "camera.target is (0, 0, 0), expected a point other than the origin\n\
//!      shapes[0].radius is -1, expected a number greater than 0"
//! );
//! # Ok::<(), lancer_scene::InvalidScene>(())
//! ```
#![forbid(unsafe_code)]

mod builder;
mod camera;
mod colour;
mod colour_names;
mod custom;
mod dump;
mod error;
mod group;
mod light;
mod mesh;
mod scene;
mod shape;
mod sheets;
mod solids;
mod surface;
mod values;

pub use builder::SceneBuilder;
pub use camera::{Camera, Exposure, Projection, Stops};
pub use colour::{Colour, LinearColour};
pub use custom::CustomShape;
pub use error::{InvalidField, InvalidScene, OutOfRange};
pub use group::{Group, Placed};
pub use light::{Beam, Falloff, Light, Shadows};
pub use mesh::{Mesh, MeshError};
pub use scene::Scene;
pub use shape::{Geometry, IntoSurface, Shape};
pub use sheets::{Disc, Plane, Rectangle, Triangle};
pub use solids::{Cone, Cuboid, Sphere, Tetrahedron, Torus};
pub use surface::{Checker, Medium, Pattern, Surface};
pub use values::{
    Brightness, Degrees, Direction, Fraction, Ior, Length, PixelCount, Position, Spectrum,
};
