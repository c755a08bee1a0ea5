//! The same scene elsewhere, larger or turned, for tests of what must not change.

use lancer_math::{Placement, Point, Vector};
use lancer_scene::{
    Brightness, Camera, Cone, Cuboid, Degrees, Direction, Disc, Falloff, Geometry, Group,
    InvalidField, Length, Light, Medium, Mesh, MeshError, OutOfRange, Pattern, Placed, Plane,
    Position, Projection, Rectangle, Scene, Shape, Spectrum, Sphere, Surface, Tetrahedron, Torus,
    Triangle,
};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Why there is no such scene.
#[derive(Debug, thiserror::Error)]
pub enum Unmovable {
    /// A number leaves its range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// The same, where it has a name.
    #[error(transparent)]
    Invalid(#[from] InvalidField),
    /// The same, of a mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// The scene with all lengths times `factor`: the sizes of cells too, absorption and the
/// brightness of lamps so that the picture is the same.
///
/// # Errors
/// Where a number leaves its range.
pub fn scaled(scene: &Scene, factor: f64) -> Result<Scene, Unmovable> {
    mapped(scene, &|p| p * factor, factor)
}

/// The scene, moved.
///
/// # Errors
/// Where a number leaves its range.
pub fn translated(scene: &Scene, offset: Vector) -> Result<Scene, Unmovable> {
    mapped(scene, &|p| p + offset, 1.0)
}

/// The scene with everything that a translation moves at multiples of `step`, so that the
/// sums with multiples of it are exact.
///
/// # Errors
/// Where corners that were different come together.
pub fn snapped(scene: &Scene, step: f64) -> Result<Scene, Unmovable> {
    mapped(scene, &|p| p.map(|c| libm::rint(c / step) * step), 1.0)
}

/// The scene with all shapes in a group that `isometry` places, and with it the camera and the
/// lights. Where it mirrors, so is the picture, left and right.
///
/// # Errors
/// Where a number leaves its range.
pub fn placed(scene: &Scene, isometry: &Placement) -> Result<Scene, Unmovable> {
    let group = Group::new(None, scene.shapes.clone(), scene.groups.clone())?;
    let groups = vec![Placed { placement: *isometry, group: Arc::new(group) }];
    let turned = |d: Direction| Direction::new(isometry.vector(&d.get()).into());
    let point = |p: Position| Position::new(isometry.point(&p.get()).into());
    let light = |light: &Light| {
        let mut light = *light;
        match &mut light {
            Light::Lamp { point: at, .. } => *at = point(*at)?,
            Light::Sun { direction, .. } => *direction = turned(*direction)?,
            Light::Spot { point: at, axis, .. } => {
                *at = point(*at)?;
                *axis = turned(*axis)?;
            }
        }
        Ok(light)
    };
    let old = &scene.camera;
    let mut camera = Camera::from_values(
        point(old.origin())?,
        point(old.target())?,
        old.projection,
        old.px_width,
        old.px_height,
    )?;
    let [x, y, z] = [Vector::x(), Vector::y(), Vector::z()].map(|axis| isometry.vector(&axis));
    let mirrors = x.cross(&y).dot(&z) < 0.0;
    camera.up = turned(old.up)?;
    camera.roll = Degrees::new(if mirrors { -old.roll.get() } else { old.roll.get() })?;
    camera.exposure = old.exposure;
    (camera.aperture, camera.focus) = (old.aperture, old.focus);
    let lights = scene.lights.iter().map(light).collect::<Result<_, OutOfRange>>()?;
    Ok(Scene { camera, lights, groups, shapes: Vec::new(), ..scene.clone() })
}

/// The same triangles in other places, which come from the old ones.
///
/// # Errors
/// Where no triangle has an area any more.
pub fn mapped_mesh(mesh: &Mesh, map: &dyn Fn(Vector) -> Vector) -> Result<Mesh, MeshError> {
    let count = mesh.triangle_count();
    let corners = (0..count).flat_map(|i| mesh.corners(i));
    let positions = corners.map(|p| map(p.coords).into()).collect();
    let triangles: Vec<[u32; 3]> =
        (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let moved = Mesh::new(positions, triangles)?;
    if !mesh.has_normals() {
        return Ok(moved);
    }
    let normals = (0..count).filter_map(|i| mesh.corner_normals(i)).flatten();
    moved.with_normals(normals.map(|n| [n.x as f32, n.y as f32, n.z as f32]).collect(), None)
}

/// Where points go, and what lengths are multiplied with.
struct Map<'a> {
    point: &'a dyn Fn(Vector) -> Vector,
    factor: f64,
    /// The scaled group for each one, so that what was shared stays so and keeps its number.
    groups: BTreeMap<*const Group, Arc<Group>>,
}

fn mapped(
    scene: &Scene,
    point: &dyn Fn(Vector) -> Vector,
    factor: f64,
) -> Result<Scene, Unmovable> {
    let mut map = Map { point, factor, groups: BTreeMap::new() };
    let old = &scene.camera;
    let projection = match old.projection {
        Projection::Pinhole(width) => Projection::Pinhole(map.length(width)?),
        Projection::FieldOfView(angle) => Projection::FieldOfView(angle),
        Projection::Orthographic(width) => Projection::Orthographic(map.length(width)?),
    };
    let (origin, target) = (map.position(old.origin())?, map.position(old.target())?);
    let mut camera = Camera::from_values(origin, target, projection, old.px_width, old.px_height)?;
    (camera.up, camera.roll, camera.exposure) = (old.up, old.roll, old.exposure);
    let length = |length: Option<Length>| length.map(|length| map.length(length)).transpose();
    (camera.aperture, camera.focus) = (length(old.aperture)?, length(old.focus)?);
    let lights = scene.lights.iter().map(|light| map.light(light)).collect::<Result<_, _>>()?;
    let shapes = scene.shapes.iter().map(|shape| map.shape(shape)).collect::<Result<_, _>>()?;
    let groups = scene.groups.iter().map(|placed| map.placed(placed)).collect::<Result<_, _>>()?;
    Ok(Scene { camera, lights, shapes, groups, ..scene.clone() })
}

impl Map<'_> {
    fn position(&self, p: Position) -> Result<Position, OutOfRange> {
        Position::new((self.point)(p.get().coords).into())
    }

    fn at(&self, p: Point) -> Result<Position, OutOfRange> {
        Position::new((self.point)(p.coords).into())
    }

    fn length(&self, length: Length) -> Result<Length, OutOfRange> {
        Length::new(length.get() * self.factor)
    }

    fn light(&self, light: &Light) -> Result<Light, OutOfRange> {
        let mut light = *light;
        match &mut light {
            Light::Lamp { point, radius, brightness, falloff }
            | Light::Spot { point, radius, brightness, falloff, .. } => {
                *point = self.position(*point)?;
                *radius = radius.map(|radius| self.length(radius)).transpose()?;
                if *falloff == Falloff::Square {
                    *brightness = Brightness::new(brightness.get() * self.factor * self.factor)?;
                }
            }
            Light::Sun { .. } => {}
        }
        Ok(light)
    }

    fn surface(&self, surface: &Surface) -> Result<Surface, OutOfRange> {
        let mut surface = *surface;
        if let Pattern::Checker(checker) = &mut surface.pattern {
            checker.length = self.length(checker.length)?;
        }
        let absorption = surface.medium.absorption.get().map(|c| c / self.factor);
        surface.medium = Medium { absorption: Spectrum::new(absorption)?, ..surface.medium };
        Ok(surface)
    }

    fn shape(&self, shape: &Shape) -> Result<Shape, Unmovable> {
        let geometry = match &shape.geometry {
            Geometry::Sphere(sphere) => Geometry::Sphere(Sphere {
                centre: self.position(sphere.centre)?,
                radius: self.length(sphere.radius)?,
            }),
            Geometry::Plane(plane) => {
                Geometry::Plane(Plane { origin: self.position(plane.origin)?, ..*plane })
            }
            Geometry::Disc(disc) => Geometry::Disc(Disc {
                centre: self.position(disc.centre)?,
                radius: self.length(disc.radius)?,
                ..*disc
            }),
            Geometry::Rectangle(rectangle) => {
                let [a, b] =
                    rectangle.sides().map(|s| Direction::new((s.get() * self.factor).into()));
                Geometry::Rectangle(Rectangle::new(self.at(rectangle.corner())?, [a?, b?])?)
            }
            Geometry::Triangle(triangle) => {
                let [a, b, c] = triangle.corners().map(|corner| self.at(corner));
                Geometry::Triangle(Triangle::new([a?, b?, c?])?)
            }
            Geometry::Cuboid(cuboid) => {
                Geometry::Cuboid(Cuboid::new(self.at(cuboid.min())?, self.at(cuboid.max())?)?)
            }
            Geometry::Tetrahedron(solid) => {
                let [a, b, c, d] = solid.corners().map(|corner| self.at(corner));
                Geometry::Tetrahedron(Tetrahedron::new([a?, b?, c?, d?])?)
            }
            Geometry::Cone(cone) => Geometry::Cone(Cone::new(
                (self.at(cone.base())?, cone.base_radius() * self.factor),
                (self.at(cone.top())?, cone.top_radius() * self.factor),
                cone.open,
            )?),
            Geometry::Torus(torus) => Geometry::Torus(Torus::new(
                self.position(torus.centre)?,
                torus.axis,
                Length::new(torus.ring() * self.factor)?,
                Length::new(torus.tube() * self.factor)?,
            )?),
            Geometry::Mesh(mesh) => Geometry::Mesh(Arc::new(mapped_mesh(mesh, self.point)?)),
            Geometry::Custom(custom) => Geometry::Custom(Arc::clone(custom)),
        };
        Ok(Shape { geometry, surface: self.surface(&shape.surface)? })
    }

    /// Points go where they go, and what is inside keeps its places but for the factor.
    fn placed(&mut self, placed: &Placed) -> Result<Placed, Unmovable> {
        let offset = placed.placement.point(&Point::origin()).coords;
        let turned = placed.placement.then(&Placement::translate(-offset));
        let placement = turned.then(&Placement::translate((self.point)(offset)));
        let group =
            if self.factor == 1.0 { Arc::clone(&placed.group) } else { self.group(&placed.group)? };
        Ok(Placed { placement, group })
    }

    fn group(&mut self, group: &Arc<Group>) -> Result<Arc<Group>, Unmovable> {
        if let Some(known) = self.groups.get(&Arc::as_ptr(group)) {
            return Ok(Arc::clone(known));
        }
        let shapes = group.shapes().iter().map(|s| self.shape(s)).collect::<Result<_, _>>()?;
        let groups = group.groups().iter().map(|p| self.placed(p)).collect::<Result<_, _>>()?;
        let name = group.name().map(str::to_owned);
        let scaled = Arc::new(Group::new(name, shapes, groups)?);
        self.groups.insert(Arc::as_ptr(group), Arc::clone(&scaled));
        Ok(scaled)
    }
}
