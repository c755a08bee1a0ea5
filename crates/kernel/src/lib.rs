//! Where rays meet the shapes of a scene.
//!
//! [`Prepared`] is made once from a scene and then asked, from any thread, for the
//! nearest hit of a ray, for any hit on a stretch, or for all; a hit is expanded
//! to a [`SurfacePoint`] only once it is known to be the one that is wanted.
//! This crate knows no camera, no light and no picture.
//!
//! Most is got out of the processor by asking for many rays at once: the
//! instructions that it has are chosen once for a batch, and rays that come in no
//! order are followed in one that finds neighbouring shapes near at hand. What
//! is answered is what each ray would be answered alone, to the last bit.
//!
//! ```
//! use lancer_kernel::{Prepared, Which};
//! use lancer_math::{Point, Ray, Vector};
//! use lancer_scene::{Camera, Colour, Scene, Shape, Surface};
//!
//! let scene = Scene::builder()
//!     .camera(Camera::new([0.0, -4.0, 0.0], [0.0; 3], 1.0, [4, 3]))
//!     .shape(Shape::torus([0.0; 3], [0.0, 0.0, 1.0], [2.0, 0.5], Surface::new(Colour::RED)))
//!     .build()?;
//! let prepared = Prepared::new(&scene);
//! let ray = Ray::new(Point::new(0.0, -4.0, 0.0), Vector::y());
//! let hit = prepared.nearest(&ray, f64::INFINITY).expect("the ring is ahead");
//! assert_eq!(hit.t, 1.5);
//! assert_eq!(prepared.expand(&ray, &hit).normal, -Vector::y());
//!
//! // A line of sight through the hole.
//! let through = Ray::new(Point::new(0.5, 0.0, -3.0), Vector::z());
//! assert!(!prepared.any(&through, 6.0, Which::All));
//! assert_eq!(prepared.all(&ray, (0.0, 10.0), Which::All).len(), 4);
//!
//! // Many at once.
//! let rays: Vec<Ray> = (0..1000)
//!     .map(|i| Ray::new(Point::new(f64::from(i) * 0.005 - 2.5, 0.0, -3.0), Vector::z()))
//!     .collect();
//! let mut hits = vec![None; rays.len()];
//! prepared.nearest_each(&rays, f64::INFINITY, &mut hits);
//! assert_eq!(hits[900].map(|hit| hit.t), Some(2.5));
//! let mut hidden = vec![false; rays.len()];
//! prepared.any_each(&rays, 1.0, Which::All, &mut hidden);
//! assert!(!hidden.contains(&true));
//! # Ok::<(), lancer_scene::InvalidScene>(())
//! ```
//!
//! Two small programs of that kind are among the examples: `ambient_occlusion`
//! bakes into a mesh how much of the sky its vertices see, and `line_of_sight`
//! answers whether hills hide one point from another.
#![forbid(unsafe_code)]

mod checker;
mod crossing;
mod hierarchy;
mod hit;
mod listed;
mod near;
mod prepared;
mod primitive;
mod rays;
mod settings;
mod shapes;

pub use checker::LaneCells;
use crossing::Crossing;
pub mod lanes;
pub use hit::{Hit, SurfacePoint};
pub use listed::{Candidates, Goal, LaneHits, LanePoints, ListedShape};
pub use prepared::{Prepared, Which};
pub use rays::Rays;
pub use settings::{Culling, KernelSettings};
