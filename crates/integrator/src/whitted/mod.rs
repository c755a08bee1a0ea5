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
mod warnings;

use crate::{Engine, Lint, Plan, RayTree, Tracer};
use lancer_film::Display;
use lancer_kernel::KernelSettings;
use lancer_math::Ray;
use lancer_scene::{Camera, InvalidField, OutOfRange, Scene};

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

    fn warnings(&self, scene: &Scene) -> Vec<Lint> {
        warnings::of(scene)
    }

    fn prepare<'s>(&'s self, scene: &'s Scene, plan: &Plan) -> Box<dyn Tracer + 's> {
        Box::new(tracer::WhittedTracer::new(scene, self.cutoff, plan))
    }
}
