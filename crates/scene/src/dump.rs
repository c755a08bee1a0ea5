//! The stable text form of a scene, for snapshots and for reading.

use crate::{
    Camera, Exposure, Falloff, Geometry, Group, Light, Pattern, Placed, Projection, Scene, Shadows,
    Shape, Spectrum, Surface,
};
use lancer_math::{Point, Vector};
use std::collections::BTreeSet;
use std::fmt::{Display, Formatter, Result};
use std::sync::Arc;

/// Three numbers with spaces between them.
struct Triple([f64; 3]);

impl Display for Triple {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "{} {} {}", self.0[0], self.0[1], self.0[2])
    }
}

fn xyz(p: Point) -> Triple {
    Triple([p.x, p.y, p.z])
}

fn vector(v: Vector) -> Triple {
    Triple([v.x, v.y, v.z])
}

fn rgb(s: Spectrum) -> Triple {
    Triple(s.get())
}

/// A scene as text, a line for each part, every number in the shortest form
/// that reads back as the same bits. What has its usual value is left out. The
/// form changes only with the model.
impl Display for Scene {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        writeln!(f, "{}", self.camera)?;
        if self.shadows == Shadows::Opaque {
            writeln!(f, "shadows opaque")?;
        }
        if !self.background.is_none() {
            writeln!(f, "background {}", rgb(self.background))?;
        }
        for light in &self.lights {
            writeln!(f, "{light}")?;
        }
        for shape in &self.shapes {
            writeln!(f, "{shape}")?;
        }
        let mut told = BTreeSet::new();
        for placed in &self.groups {
            write_placed(f, placed, 0, &mut told)?;
        }
        Ok(())
    }
}

/// A group where it stands, indented by what is around it; one with a name is
/// told in full where it is first met.
fn write_placed(
    f: &mut Formatter<'_>,
    placed: &Placed,
    indent: usize,
    told: &mut BTreeSet<*const Group>,
) -> Result {
    let group = &placed.group;
    write!(f, "{:indent$}", "")?;
    match group.name() {
        Some(name) => write!(f, "use {name:?}")?,
        None => write!(f, "group")?,
    }
    if !placed.placement.is_identity() {
        let origin = placed.placement.point(&Point::origin());
        let [x, y, z] = [Vector::x(), Vector::y(), Vector::z()]
            .map(|axis| vector(placed.placement.vector(&axis)));
        write!(f, " x {x} y {y} z {z} at {}", xyz(origin))?;
    }
    writeln!(f)?;
    if group.name().is_some() && !told.insert(Arc::as_ptr(group)) {
        return Ok(());
    }
    for shape in group.shapes() {
        writeln!(f, "{:1$}{shape}", "", indent + 2)?;
    }
    for inner in group.groups() {
        write_placed(f, inner, indent + 2, told)?;
    }
    Ok(())
}

impl Display for Camera {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(
            f,
            "camera origin {} target {}",
            xyz(self.origin().get()),
            xyz(self.target().get())
        )?;
        match self.projection {
            Projection::Pinhole(width) => write!(f, " width {}", width.get())?,
            Projection::FieldOfView(angle) => write!(f, " fov {}", angle.get())?,
            Projection::Orthographic(width) => write!(f, " orthographic width {}", width.get())?,
        }
        let up = self.up.get();
        if up != Vector::z() {
            write!(f, " up {}", vector(up))?;
        }
        if self.roll.get() != 0.0 {
            write!(f, " roll {}", self.roll.get())?;
        }
        if let Some(aperture) = self.aperture {
            write!(f, " aperture {}", aperture.get())?;
        }
        if let Some(focus) = self.focus {
            write!(f, " focus {}", focus.get())?;
        }
        if let Exposure::Stops(stops) = self.exposure {
            write!(f, " exposure {}", stops.get())?;
        }
        write!(f, " pixels {} x {}", self.px_width.get(), self.px_height.get())
    }
}

impl Display for Light {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Lamp { point, .. } => write!(f, "lamp point {}", xyz(point.get()))?,
            Self::Sun { direction, .. } => write!(f, "sun direction {}", vector(direction.get()))?,
            Self::Spot { point, axis, beam, .. } => {
                write!(f, "spot point {} axis {}", xyz(point.get()), vector(axis.get()))?;
                write!(f, " inner {} outer {}", beam.inner().get(), beam.outer().get())?;
            }
        }
        if let Some(radius) = self.radius() {
            write!(f, " radius {}", radius.get())?;
        }
        write!(f, " brightness {}", self.brightness().get())?;
        match self {
            Self::Lamp { falloff: Falloff::None, .. }
            | Self::Spot { falloff: Falloff::None, .. } => write!(f, " falloff none"),
            _ => Ok(()),
        }
    }
}

impl Display for Shape {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "{} {}", self.geometry, self.surface)
    }
}

impl Display for Geometry {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "{}", self.kind())?;
        let corners = |f: &mut Formatter<'_>, corners: &[Point]| {
            corners.iter().try_for_each(|corner| write!(f, " {}", xyz(*corner)))
        };
        match self {
            Self::Sphere(sphere) => {
                write!(f, " centre {} radius {}", xyz(sphere.centre.get()), sphere.radius.get())
            }
            Self::Plane(plane) => {
                write!(f, " origin {}", xyz(plane.origin.get()))?;
                write!(f, " normal {}", vector(plane.normal.get()))
            }
            Self::Disc(disc) => {
                write!(f, " centre {} radius {}", xyz(disc.centre.get()), disc.radius.get())?;
                write!(f, " normal {}", vector(disc.normal.get()))
            }
            Self::Rectangle(rectangle) => {
                let [first, second] = rectangle.sides().map(|side| vector(side.get()));
                write!(f, " corner {} sides {first} and {second}", xyz(rectangle.corner()))
            }
            Self::Triangle(triangle) => corners(f, &triangle.corners()),
            Self::Cuboid(cuboid) => {
                write!(f, " from {} to {}", xyz(cuboid.min()), xyz(cuboid.max()))
            }
            Self::Tetrahedron(tetrahedron) => corners(f, &tetrahedron.corners()),
            Self::Cone(cone) => {
                write!(f, " base {} radius {}", xyz(cone.base()), cone.base_radius())?;
                write!(f, " top {} radius {}", xyz(cone.top()), cone.top_radius())?;
                if cone.open { write!(f, " open") } else { Ok(()) }
            }
            Self::Torus(torus) => {
                write!(f, " centre {} axis", xyz(torus.centre.get()))?;
                write!(f, " {} ring", vector(torus.axis.get()))?;
                write!(f, " {} tube {}", torus.ring(), torus.tube())
            }
            Self::Mesh(mesh) => {
                let (min, max) = mesh.bounds();
                write!(f, " of {} triangles", mesh.triangle_count())?;
                write!(f, " from {} to {}", xyz(min), xyz(max))?;
                if mesh.has_normals() { write!(f, " smooth") } else { Ok(()) }
            }
            Self::Custom(_) => Ok(()),
        }
    }
}

impl Display for Surface {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "colour {} gloss {}", self.colour, self.gloss.get())?;
        if let Pattern::Checker(checker) = self.pattern {
            write!(f, " checker {}", checker.second)?;
            if (checker.length.get(), checker.angle.get()) != (1.0, 30.0) {
                write!(f, " of {} and {} degrees", checker.length.get(), checker.angle.get())?;
            }
        }
        if self.transparency.get() > 0.0 {
            write!(f, " transparency {}", self.transparency.get())?;
            write!(f, " ior {}", self.medium.ior.get())?;
        }
        if !self.medium.absorption.is_none() {
            write!(f, " absorption {}", rgb(self.medium.absorption))?;
        }
        if self.thin {
            write!(f, " thin")?;
        }
        if !self.emission.is_none() {
            write!(f, " emission {}", rgb(self.emission))?;
        }
        if self.priority != 0 {
            write!(f, " priority {}", self.priority)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Colour;
    use lancer_math::Placement;

    #[test]
    fn every_part_is_in_the_dump() {
        let pink = Surface::new(Colour::PINK).checker(Colour::PINK.complement());
        let glass = Surface::glass(1.5).and_then(|glass| glass.absorption([0.0, 1.0, 0.5]));
        let glass = glass.expect("valid");
        let ball = Shape::sphere([0.0; 3], 0.1, pink.gloss(0.1)).expect("valid");
        let tube = Shape::cylinder([0.0; 3], [0.0, 0.0, 2.0], 1.0, glass).expect("valid");
        let pair = Group::new(Some("pair".to_owned()), vec![ball.clone(), tube], Vec::new());
        let pair = Arc::new(pair.expect("small"));
        let camera = Camera::new([0.0, -1.5, 1e-7], [0.0, 1.0, 0.1], 2.0, [40, 30]);
        let scene = Scene::builder()
            .camera(camera.and_then(|camera| {
                let camera = camera.field_of_view(50.0)?.up([0.0, 0.5, 2.0])?.roll(3.0)?;
                camera.aperture(0.25)?.focus(7.0)?.stops(-1.5)
            }))
            .background(Spectrum::new([0.25, 0.5, 1.0]))
            .light(Light::sun([0.0, 0.0, -1.0], 0.25))
            .light(Light::lamp([1.0, 2.0, 3.0], 1.0).map(Light::without_falloff))
            .light(
                Light::spot([0.0; 3], [1.0, 0.0, 0.0], [10.0, 20.0], 3.0)
                    .and_then(|spot| spot.with_radius(0.5)),
            )
            .shape(Ok(ball))
            .shape(Shape::plane([0.0; 3], [0.0, 0.0, 2.0], Surface::new(Colour::BROWN)))
            .shape(Shape::torus([0.0; 3], [0.0, 0.0, 2.0], [2.0, 0.5], glass))
            .group(Placement::IDENTITY, Arc::clone(&pair))
            .group(Placement::translate(Vector::new(1.0, 0.0, 0.0)), pair)
            .build()
            .expect("valid");
        assert_eq!(
            scene.to_string(),
            "camera origin 0 -1.5 0.0000001 target 0 1 0.1 fov 50 up 0 0.5 2 roll 3 \
             aperture 0.25 focus 7 exposure -1.5 pixels 40 x 30\n\
             background 0.25 0.5 1\n\
             sun direction 0 0 -1 brightness 0.25\n\
             lamp point 1 2 3 brightness 1 falloff none\n\
             spot point 0 0 0 axis 1 0 0 inner 10 outer 20 radius 0.5 brightness 3\n\
             sphere centre 0 0 0 radius 0.1 colour #ff7de1 gloss 0.1 checker #00821e\n\
             plane origin 0 0 0 normal 0 0 2 colour #8a4829 gloss 0\n\
             torus centre 0 0 0 axis 0 0 2 ring 2 tube 0.5 colour #ffffff gloss 0 \
             transparency 1 ior 1.5 absorption 0 1 0.5\n\
             use \"pair\"\n  \
               sphere centre 0 0 0 radius 0.1 colour #ff7de1 gloss 0.1 checker #00821e\n  \
               cylinder base 0 0 0 radius 1 top 0 0 2 radius 1 colour #ffffff gloss 0 \
             transparency 1 ior 1.5 absorption 0 1 0.5\n\
             use \"pair\" x 1 0 0 y 0 1 0 z 0 0 1 at 1 0 0\n"
        );
        assert_eq!(scene.shape_count(), 7);
    }
}
