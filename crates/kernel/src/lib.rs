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
//! # Doubtful cases
//!
//! Each has one answer, whatever the number of lanes and whatever else is in the scene:
//!
//! - A hit is ahead, 0 < t, and finite. An origin exactly on a surface does not meet it
//!   there; one that leaves by [`SurfacePoint::leave`] does not either, and meets what is
//!   farther off than three error bounds. There is no other smallest distance, and no
//!   largest one.
//! - Faces, edges, rims and corners belong to their shape: a ray in a face of a box or
//!   along an edge is inside of it, and so is one along the side of a cylinder, but not one
//!   in the side of a cone. Planes and other flat shapes are not met by rays in them. Zero components of directions mean the same
//!   with either sign.
//! - A line crosses a closed shape an even number of times. Where it touches, in exact
//!   arithmetic, there is a pair of crossings or none, as rounding has it: within about
//!   the root of the precision of doubles, and never one alone. So it is at the inner
//!   equator of a ring, in the middle of one without a hole, and at an apex.
//! - Of hits at the same t that of the first item is the nearest. Faces in one place that
//!   are planes across an axis, faces of boxes or the same shape twice are at the same t; others
//!   may be apart by some units in the last place, and the nearer one is met.
//! - A mesh is met at an edge or a vertex by exactly one of the triangles around, where it
//!   is not folded there. A triangle seen edge on is not met.
//! - The normal at an apex is that of the side that faces the ray; with a direction along
//!   the axis, of one side that is always the same.
//! - What is not a number misses, and so does what leaves the range of doubles: spheres
//!   with radii outside of about 1e-145 to 1e154, and other round shapes beyond the range in which
//!   sixth powers of lengths are numbers.
//!
//! Two small programs of that kind are among the examples: `ambient_occlusion`
//! bakes into a mesh how much of the sky its vertices see, and `line_of_sight`
//! answers whether hills hide one point from another.
#![forbid(unsafe_code)]

mod checker;
mod crossing;
pub mod figure;
mod hierarchy;
mod hit;
mod lean;
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
pub use hierarchy::BOX_SLACK;
pub use hit::{Hit, SurfacePoint};
pub use lean::{LEAN, not_lean};
pub use listed::{Candidates, Goal, LaneHits, LanePoints, ListedShape};
pub use prepared::{Absent, Prepared, Which, is_met_in_lanes};
pub use rays::Rays;
pub use settings::{Culling, KernelSettings};
pub use shapes::sphere::LEAST_RADIUS;
