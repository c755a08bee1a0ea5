//! Engines that turn a scene into a film, and the scheduler that runs them on
//! all cores.
//!
//! [`render`] cuts the frame into tiles, gives them to the engine on as many
//! threads as asked for, and puts the answers together. The film does not
//! depend on the number of threads. Three engines are built in: [`Whitted`], the usual one, and
//! [`Classic`] and [`Direct`], the original program's; [`Engine`] is all that is needed to write
//! another one.
//!
//! With the feature `serde`, [`Facts`] and [`Plan`]s can be written, and plans read.
//!
//! ```
//! use lancer_integrator::{Classic, RenderSettings, render};
//! use lancer_scene::{Camera, Colour, Light, Scene, Shape, Surface};
//!
//! let scene = Scene::builder()
//!     .camera(Camera::new([0.0, -4.0, 0.0], [0.0, -3.0, 0.0], 1.0, [32, 24]))
//!     .light(Light::sun([0.0, 1.0, 0.0], 1.0))
//!     .shape(Shape::sphere([0.0; 3], 1.0, Surface::new(Colour::RED)))
//!     .build()?;
//! let rendered = render(&scene, &Classic, &RenderSettings::default())?;
//! let [red, green, _] = rendered.film.pixel(16, 12);
//! assert!(red > 250.0 && green == 0.0);
//! assert_eq!(rendered.counts.primary, 32 * 24);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

mod classic;
mod counts;
mod direct;
mod disc;
mod enclose;
mod engine;
mod numbers;
mod plan;
mod ray_tree;
mod render;
mod rows;
mod samples;
mod sampling;
mod whitted;

pub use classic::camera::PinholeCamera;
pub use classic::engine::Classic;
pub use classic::world::{Hit, SurfacePoint, World};
pub use counts::{RayCounts, Trouble, Troubles};
pub use direct::Direct;
pub use engine::{Engine, Rgb, Tracer, engine_by_name, engines};
pub use lancer_kernel::{Absent, Culling, KernelSettings, lanes::Width};
pub use numbers::Stream;
pub use plan::{About, Asked, Dropped, Facts, LightCounts, Lint, Part, Plan, Reason, lints};
pub use ray_tree::{
    InMedium, LightAnswer, LightFate, MetSurface, NamedShape, RayFate, RayKind, RayTree, ShadowRay,
    TracedRay,
};
pub use render::{Progress, RenderError, RenderSettings, Rendered, TILE_SIDE, render};
pub use samples::{MOST_SAMPLES, Sample, Sampler, Seen};
pub use sampling::{Accuracy, Forecast, Sampling, StopAt, Strategy, Why};
pub use whitted::Whitted;
