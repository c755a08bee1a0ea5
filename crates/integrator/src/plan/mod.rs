//! What is done for a scene, and what is left out because nobody could see it.
//!
//! [`Facts`] are told from the description alone. [`Plan::new`] is the one place where it is
//! decided what follows from them; engines are given the plan and do not ask the scene again.
//! What it leaves out is left out by proof: it changes no bit of the picture, but for dim
//! lights, which change it by no more than is stated. [`Plan::full`] leaves nothing out.

mod beams;
mod facts;
mod half_space;
mod lights;
mod lints;
mod parts;
mod sight;
#[cfg(feature = "serde")]
mod written;

pub use facts::{Facts, LightCounts};
pub(crate) use lints::TOGETHER;
pub use lints::{About, Lint, lints};
pub use parts::Part;

use lancer_kernel::{Absent, Culling, KernelSettings};
use lancer_scene::Scene;
use sight::Sight;

/// For what a picture is planned.
#[derive(Debug, Clone, Copy, Default)]
pub struct Asked {
    /// How rays are followed.
    pub kernel: KernelSettings,
    /// The error that is asked for, in exposed linear units. Without it nothing is left out that
    /// would change anything.
    pub error: Option<f64>,
    /// What radiance is multiplied with to be shown; not known where the exposure depends on the
    /// picture.
    pub factor: Option<f64>,
    /// Whether nothing is to be left out.
    pub full_model: bool,
}

/// What is done for a picture: plain data, which the feature `serde` writes and reads.
#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(into = "written::Written", try_from = "written::Written"))]
pub struct Plan {
    /// How rays are followed.
    pub kernel: KernelSettings,
    /// The lights that are not asked, in their order.
    pub dropped: Vec<Dropped>,
    /// The shapes that no ray reaches.
    pub absent: Absent,
}

/// A light that is not asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dropped {
    /// Its number among the scene's lights, from 0.
    pub light: usize,
    /// Reason.
    pub why: Reason,
    /// By how much a pixel may be darker for that, in exposed linear units; 0 where it is proven that
    /// no pixel changes.
    pub most: f64,
}

/// Reason a light is not asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// Its brightness is 0.
    NoLight,
    /// An opaque plane is between it and all that the eye sees: the scene's own shape of that
    /// number, from 0.
    Behind(usize),
    /// Its beam meets nothing that may be seen.
    Aside,
    /// It is too dim, or too far, to matter.
    Dim,
}

impl Plan {
    /// The plan for a scene.
    #[must_use]
    pub fn new(scene: &Scene, asked: &Asked) -> Self {
        if asked.full_model {
            let culling = Culling::NONE;
            return Self::full(&KernelSettings { culling, ..asked.kernel });
        }
        let sight = Sight::new(scene);
        let dropped = lights::dropped(scene, asked, &sight);
        Self { kernel: asked.kernel, absent: sight.absent(&dropped), dropped }
    }

    /// Nothing of the scene is left out.
    #[must_use]
    pub const fn full(kernel: &KernelSettings) -> Self {
        Self { kernel: *kernel, dropped: Vec::new(), absent: Absent::NONE }
    }

    /// Whether the light of that number is asked.
    #[must_use]
    pub fn asks(&self, light: usize) -> bool {
        self.dropped.iter().all(|dropped| dropped.light != light)
    }

    /// By how much a pixel may be off for what is left out, at most, in exposed linear units.
    #[must_use]
    pub fn most(&self) -> f64 {
        // Not a sum, which is -0 for none.
        self.dropped.iter().map(|dropped| dropped.most).fold(0.0, |sum, most| sum + most)
    }
}

#[cfg(test)]
mod reach_tests;
#[cfg(test)]
mod tests;
