use crate::{Camera, Light, Placed, SceneBuilder, Shadows, Shape, Spectrum};

/// A whole scene: who looks, what shines, what is there.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// The lights, in the order in which they were described.
    pub lights: Vec<Light>,
    /// What transparent things do to the light of the lights.
    pub shadows: Shadows,
    /// The radiance of what is behind everything; lights nothing.
    pub background: Spectrum,
    /// The shapes that stand by themselves, in the order in which they were
    /// described.
    pub shapes: Vec<Shape>,
    /// The groups, in that order; their shapes come after those above wherever
    /// order counts.
    pub groups: Vec<Placed>,
}

impl Scene {
    /// An empty description to fill in.
    #[must_use]
    pub fn builder() -> SceneBuilder {
        SceneBuilder::default()
    }

    /// How many shapes it shows, those of groups counted as often as they are
    /// placed.
    #[must_use]
    pub fn shape_count(&self) -> u64 {
        let inside = self.groups.iter().map(|placed| placed.group.shape_count());
        inside.fold(self.shapes.len() as u64, u64::saturating_add)
    }
}
