//! The stable text form of a scene, for snapshots and for reading.

use crate::{Camera, Colour, Geometry, Light, Pattern, Scene, Shape, Surface};
use std::fmt;

/// A scene as text, a line for each part, every number in the shortest form
/// that reads back as the same bits. The form changes only with the model.
impl fmt::Display for Scene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.camera)?;
        for light in &self.lights {
            writeln!(f, "{light}")?;
        }
        for shape in &self.shapes {
            writeln!(f, "{shape}")?;
        }
        Ok(())
    }
}

impl fmt::Display for Camera {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (o, t) = (self.origin().get(), self.target().get());
        write!(
            f,
            "camera origin {} {} {} target {} {} {} width {} pixels {} x {}",
            o.x,
            o.y,
            o.z,
            t.x,
            t.y,
            t.z,
            self.width.get(),
            self.px_width.get(),
            self.px_height.get()
        )
    }
}

impl fmt::Display for Light {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lamp { point, brightness } => {
                let p = point.get();
                write!(f, "lamp point {} {} {} brightness {}", p.x, p.y, p.z, brightness.get())
            }
            Self::Sun { direction, brightness } => {
                let d = direction.get();
                write!(f, "sun direction {} {} {} brightness {}", d.x, d.y, d.z, brightness.get())
            }
        }
    }
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.geometry {
            Geometry::Sphere(sphere) => {
                let (c, r) = (sphere.centre.get(), sphere.radius.get());
                write!(f, "sphere centre {} {} {} radius {r}", c.x, c.y, c.z)?;
            }
            Geometry::Plane(plane) => {
                let (o, n) = (plane.origin.get(), plane.normal.get());
                write!(f, "plane origin {} {} {}", o.x, o.y, o.z)?;
                write!(f, " normal {} {} {}", n.x, n.y, n.z)?;
            }
            Geometry::Custom(custom) => write!(f, "custom {}", custom.name())?,
        }
        write!(f, " {}", self.surface)
    }
}

impl fmt::Display for Surface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "colour {} gloss {}", self.colour, self.gloss.get())?;
        match self.pattern {
            Pattern::Solid => Ok(()),
            Pattern::Checker(second) => write!(f, " checker {second}"),
        }
    }
}

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.r, self.g, self.b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_is_in_the_dump() {
        let scene = Scene::builder()
            .camera(Camera::new([0.0, -1.5, 1e-7], [0.0, 1.0, 0.1], 2.0, [40, 30]))
            .light(Light::sun([0.0, 0.0, -1.0], 0.25))
            .light(Light::lamp([1.0, 2.0, 3.0], 1.0))
            .shape(Shape::sphere(
                [0.0; 3],
                0.1,
                Surface::new(Colour::PINK).checker(Colour::PINK.complement()).gloss(0.1),
            ))
            .shape(Shape::plane([0.0; 3], [0.0, 0.0, 2.0], Surface::new(Colour::BROWN)))
            .build()
            .expect("valid");
        assert_eq!(
            scene.to_string(),
            "camera origin 0 -1.5 0.0000001 target 0 1 0.1 width 2 pixels 40 x 30\n\
             sun direction 0 0 -1 brightness 0.25\n\
             lamp point 1 2 3 brightness 1\n\
             sphere centre 0 0 0 radius 0.1 colour #ff7de1 gloss 0.1 checker #00821e\n\
             plane origin 0 0 0 normal 0 0 2 colour #8a4829 gloss 0\n"
        );
    }
}
