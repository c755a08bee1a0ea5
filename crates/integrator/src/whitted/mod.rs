//! A physically right recursive engine after Whitted (*An Improved Illumination
//! Model for Shaded Display*, 1980): light of lamps and suns with shadows,
//! mirrors, and glass with media that are tracked.

mod ball;
mod fresnel;
mod lights;
mod media;
mod record;
mod signature;
mod stops;
mod tile;
mod tracer;
mod view;

use crate::{Engine, Plan, RayTree, Tracer};
use lancer_film::Display;
use lancer_kernel::{KernelSettings, LEAST_RADIUS};
use lancer_math::Ray;
use lancer_scene::{Camera, Geometry, Group, InvalidField, OutOfRange, Placed, Scene, Shape};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The usual engine: lamps whose light falls off, mirrors and glass to any
/// depth that can be seen, in linear light.
///
/// A pixel is the radiance that its centre's ray sees.
#[derive(Debug, Clone, Copy)]
pub struct Whitted {
    cutoff: f64,
}

impl Whitted {
    /// The cutoff of [`new`](Self::new).
    pub const CUTOFF: f64 = 1e-4;

    /// How many surfaces a ray is followed through, at most; a ray that still
    /// matters then is counted as a trouble.
    pub const DEEPEST: u32 = tracer::DEEPEST;

    /// How many rays are followed for a pixel, at most; those that still matter
    /// then are counted likewise.
    pub const MOST_RAYS: u32 = tracer::MOST_RAYS;

    /// The engine with the usual cutoff.
    #[must_use]
    pub const fn new() -> Self {
        Self { cutoff: Self::CUTOFF }
    }

    /// The engine with another cutoff: the largest sum of the shares in a pixel
    /// of all rays that are not followed. Where none of them would have seen
    /// anything brighter than display white, a pixel is off by that fraction of
    /// display white at most.
    ///
    /// # Errors
    /// Where `cutoff` is not from 0 to 1; with 0 every ray is followed to the
    /// deepest surface.
    pub fn with_cutoff(cutoff: f64) -> Result<Self, InvalidField> {
        if (0.0..=1.0).contains(&cutoff) {
            return Ok(Self { cutoff });
        }
        let found = OutOfRange { found: cutoff.to_string(), expected: "a number from 0 to 1" };
        Err(found.in_field("cutoff"))
    }

    /// The engine for pictures of which that error is asked ([`Sampling`](crate::Sampling)): a fifth
    /// of it is left for rays that are not followed. With the usual cutoff where none is.
    #[must_use]
    pub fn for_error(error: Option<f64>) -> Self {
        error.and_then(|error| Self::with_cutoff(error / 5.0).ok()).unwrap_or_default()
    }

    /// The cutoff.
    #[must_use]
    pub const fn cutoff(&self) -> f64 {
        self.cutoff
    }

    /// All rays that are followed for the pixel at that column and row of the frame, seen at its
    /// centre as where each pixel has one sample, and what they bring it. Places outside of the frame
    /// have rays as well.
    #[must_use]
    pub fn explain_pixel(
        &self,
        scene: &Scene,
        kernel: &KernelSettings,
        pixel: (u32, u32),
    ) -> RayTree {
        tracer::WhittedTracer::new(scene, self.cutoff, &Plan::full(kernel)).explain(scene, pixel)
    }
}

/// Rays of which all that a camera sends are made, as [`View::outermost`](view::View::outermost) has it.
pub(crate) fn outermost_rays(camera: &Camera) -> Vec<Ray> {
    view::View::new(camera).outermost()
}

impl Default for Whitted {
    fn default() -> Self {
        Self::new()
    }
}

/// Of a camera whose coordinates are up to so many times its distance to the target, 2^30,
/// steps are too small for most pictures to show: of one scene, moved nearly so far, no more
/// than a pixel in a thousand is another by a level of 255.
const FARTHEST: f64 = 1_073_741_824.0;

/// Coordinates up to this can be squared, and the result multiplied with
/// another one, in double precision.
const LARGEST: f64 = 1e75;

impl Engine for Whitted {
    fn name(&self) -> &str {
        "whitted"
    }

    fn summary(&self) -> &str {
        "lamps that fall off, shadows, mirrors, glass"
    }

    fn display(&self) -> Display {
        Display::Exposed
    }

    fn warnings(&self, scene: &Scene) -> Vec<String> {
        let mut warnings = Vec::new();
        let camera = &scene.camera;
        let reach = camera.origin().get().coords.amax().max(camera.target().get().coords.amax());
        if reach > LARGEST {
            warnings.push(format!(
                "the camera is farther than {LARGEST:e} from the origin, where squares leave the \
                 range of numbers: scale the scene"
            ));
        }
        let to_target = (camera.target().get() - camera.origin().get()).amax();
        if reach > FARTHEST * to_target && reach <= LARGEST {
            let apart = reach.next_up() - reach;
            warnings.push(format!(
                "the camera is {reach:.1e} from the origin, where coordinates are {apart:.1e} apart, \
                 and {to_target:.1e} from its target: what is near it may look stepped; move the \
                 scene to the origin"
            ));
        }
        let mut groups = BTreeSet::new();
        of_shapes(&scene.shapes, "", &mut warnings);
        in_groups(&scene.groups, &mut groups, &mut warnings);
        warnings
    }

    fn prepare<'s>(&'s self, scene: &'s Scene, plan: &Plan) -> Box<dyn Tracer + 's> {
        Box::new(tracer::WhittedTracer::new(scene, self.cutoff, plan))
    }
}

fn in_groups(groups: &[Placed], seen: &mut BTreeSet<*const Group>, warnings: &mut Vec<String>) {
    for placed in groups {
        if seen.insert(Arc::as_ptr(&placed.group)) {
            let of = placed
                .group
                .name()
                .map_or_else(|| " of a group".to_owned(), |name| format!(" of `{name}`"));
            of_shapes(placed.group.shapes(), &of, warnings);
            in_groups(placed.group.groups(), seen, warnings);
        }
    }
}

/// Spheres that are too small or too large to be met; and transparent shapes that enclose nothing, so
/// that light enters their medium and never leaves it.
fn of_shapes(shapes: &[Shape], of: &str, warnings: &mut Vec<String>) {
    for (i, shape) in shapes.iter().enumerate() {
        if let Geometry::Sphere(sphere) = &shape.geometry
            && let radius = sphere.radius.get()
            && (radius < LEAST_RADIUS || radius * radius == f64::INFINITY)
        {
            warnings.push(format!(
                "shape {}{of}, a sphere, is not seen, since the square of its radius leaves the \
                 range of numbers: scale the scene",
                i + 1
            ));
        }
        if !shape.surface.has_medium() || shape.geometry.is_closed() {
            continue;
        }
        let (number, kind) = (i + 1, shape.geometry.kind());
        let why = match shape.geometry {
            Geometry::Mesh(_) => "not each of its edges has a triangle on either side",
            _ => "it has no inside",
        };
        warnings.push(format!(
            "shape {number}{of}, a {kind}, is transparent but not closed ({why}): what enters its \
             medium there never leaves it; make it thin=\"true\", or close it"
        ));
    }
}
