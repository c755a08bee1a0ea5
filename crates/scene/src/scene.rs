use crate::{Camera, Light, SceneBuilder, Shape};

/// A whole scene: who looks, what shines, what is there.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// The lights, in the order in which they were described.
    pub lights: Vec<Light>,
    /// The shapes, in the order in which they were described.
    pub shapes: Vec<Shape>,
}

impl Scene {
    /// An empty description to fill in.
    #[must_use]
    pub fn builder() -> SceneBuilder {
        SceneBuilder::default()
    }
}
