use crate::{
    Camera, Group, InvalidField, InvalidScene, Light, OutOfRange, Placed, Scene, Shadows, Shape,
    Spectrum,
};
use lancer_math::Placement;
use std::sync::Arc;

/// Collects the parts of a scene and, at the end, all that is wrong with them.
///
/// The parts are taken as their constructors return them, so that one
/// [`build`](Self::build) reports every mistake with its place.
#[derive(Debug, Clone, Default)]
pub struct SceneBuilder {
    camera: Option<Camera>,
    camera_given: bool,
    lights: Vec<Light>,
    lights_given: usize,
    shapes: Vec<Shape>,
    shapes_given: usize,
    shadows: Shadows,
    background: Spectrum,
    groups: Vec<Placed>,
    groups_given: usize,
    mistakes: Vec<InvalidField>,
}

impl SceneBuilder {
    /// Sets the camera; a scene has exactly one.
    #[must_use]
    pub fn camera(mut self, camera: Result<Camera, InvalidField>) -> Self {
        if self.camera_given {
            self.mistakes.push(OutOfRange::new("given twice", "exactly one").in_field("camera"));
        }
        self.camera_given = true;
        match camera {
            Ok(camera) => self.camera = Some(camera),
            Err(e) => self.mistakes.push(e.within("camera")),
        }
        self
    }

    /// Adds a light.
    #[must_use]
    pub fn light(mut self, light: Result<Light, InvalidField>) -> Self {
        match light {
            Ok(light) => self.lights.push(light),
            Err(e) => self.mistakes.push(e.within(&format!("lights[{}]", self.lights_given))),
        }
        self.lights_given += 1;
        self
    }

    /// Adds a shape.
    #[must_use]
    pub fn shape(mut self, shape: Result<Shape, InvalidField>) -> Self {
        match shape {
            Ok(shape) => self.shapes.push(shape),
            Err(e) => self.mistakes.push(e.within(&format!("shapes[{}]", self.shapes_given))),
        }
        self.shapes_given += 1;
        self
    }

    /// Says what transparent things do to light on its way to a surface.
    #[must_use]
    pub const fn shadows(mut self, shadows: Shadows) -> Self {
        self.shadows = shadows;
        self
    }

    /// Sets the radiance of what is behind everything; black without it.
    #[must_use]
    pub fn background(mut self, radiance: Result<Spectrum, OutOfRange>) -> Self {
        match radiance {
            Ok(radiance) => self.background = radiance,
            Err(e) => self.mistakes.push(e.in_field("background")),
        }
        self
    }

    /// Adds a group; [`Arc`] lets several places share one.
    #[must_use]
    pub fn group(mut self, placement: Placement, group: impl Into<Arc<Group>>) -> Self {
        let placed = Placed { placement, group: group.into() };
        if !placement.is_finite() {
            let found = OutOfRange::new("not finite", "finite numbers");
            let field = format!("groups[{}].placement", self.groups_given);
            self.mistakes.push(found.in_field(field));
        }
        self.groups.push(placed);
        self.groups_given += 1;
        self
    }

    /// The scene.
    ///
    /// # Errors
    /// Where a part was invalid or the camera is missing; all mistakes are
    /// listed.
    pub fn build(mut self) -> Result<Scene, InvalidScene> {
        if !self.camera_given {
            self.mistakes.push(OutOfRange::new("missing", "exactly one").in_field("camera"));
        }
        // Whether it is too much to be prepared.
        if let Err(e) = Group::measure(self.shapes.len(), &self.groups) {
            self.mistakes.push(e.in_field("groups"));
        }
        match self.camera {
            Some(camera) if self.mistakes.is_empty() => Ok(Scene {
                camera,
                lights: self.lights,
                shadows: self.shadows,
                background: self.background,
                shapes: self.shapes,
                groups: self.groups,
            }),
            _ => Err(InvalidScene { mistakes: self.mistakes }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Colour, Surface};

    fn camera() -> Result<Camera, InvalidField> {
        Camera::new([0.0; 3], [0.0, 1.0, 0.0], 1.0, [4, 3])
    }

    fn mistakes(builder: SceneBuilder) -> String {
        builder.build().expect_err("it has mistakes").to_string()
    }

    #[test]
    fn an_empty_scene_needs_a_camera_alone() {
        let scene = Scene::builder().camera(camera()).build().expect("valid");
        assert!(scene.lights.is_empty() && scene.shapes.is_empty());
        assert_eq!(mistakes(Scene::builder()), "camera is missing, expected exactly one");
    }

    #[test]
    fn two_cameras_are_one_too_many() {
        assert_eq!(
            mistakes(Scene::builder().camera(camera()).camera(camera())),
            "camera is given twice, expected exactly one"
        );
    }

    #[test]
    fn all_mistakes_are_listed_with_their_places() {
        let red = Surface::new(Colour::RED);
        let builder = Scene::builder()
            .camera(Camera::new([0.0; 3], [0.0, 1.0, 0.0], -1.0, [4, 3]))
            .light(Light::lamp([0.0; 3], 1.0))
            .light(Light::lamp([0.0, f64::NAN, 0.0], 1.0))
            .light(Light::sun([0.0; 3], 1.0))
            .light(Light::sun([0.0, 0.0, -1.0], -2.0))
            .shape(Shape::sphere([0.0; 3], 0.0, red))
            .shape(Shape::plane([0.0; 3], [0.0; 3], red))
            .shape(Shape::plane([0.0; 3], [0.0, 0.0, 1.0], red.gloss(1.5)));
        assert_eq!(
            mistakes(builder),
            "camera.width is -1, expected a number greater than 0\n\
             lights[1].point is (0, NaN, 0), expected finite coordinates\n\
             lights[2].direction is (0, 0, 0), expected a vector other than zero\n\
             lights[3].brightness is -2, expected a number of at least 0\n\
             shapes[0].radius is 0, expected a number greater than 0\n\
             shapes[1].normal is (0, 0, 0), expected a vector other than zero\n\
             shapes[2].gloss is 1.5, expected a number from 0 to 1"
        );
    }

    #[test]
    fn pictures_have_pixels() {
        for (pixels, field) in [([0, 3], "px_width"), ([4, 0], "px_height")] {
            assert_eq!(
                mistakes(Scene::builder().camera(Camera::new([0.0; 3], [1.0; 3], 1.0, pixels))),
                format!("camera.{field} is 0, expected a whole number from 1 to 2147483647")
            );
        }
    }
}
