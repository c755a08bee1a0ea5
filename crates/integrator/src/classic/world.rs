use super::checker;
use super::lanes::LANES;
use super::plane::{Half, Halves};
use super::sphere::{Ball, Balls};
use crate::Rgb;
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{Colour, CustomShape, Geometry, Pattern, Scene, Surface};
use std::sync::Arc;

/// The shapes of a scene, made ready to be hit as the original hits them:
/// planes have one side, and a hit may lie behind the ray's origin.
#[derive(Debug, Clone)]
pub struct World {
    balls: Vec<Balls>,
    pub(super) spheres: Vec<Ball>,
    halves: Vec<Halves>,
    pub(super) planes: Vec<Half>,
    pub(super) customs: Vec<Arc<dyn CustomShape>>,
    /// Of all spheres, then all planes, then all custom shapes.
    looks: Vec<Look>,
}

/// What a ray met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// How far along the ray; negative where it is behind the origin.
    pub distance: f64,
    /// The world's number for the shape.
    pub(super) index: usize,
}

/// The nearest hit so far.
struct Nearest {
    squared: f64,
    hit: Hit,
}

impl Nearest {
    /// Of equally near hits the first one stays; NaN is never nearer.
    #[inline(always)]
    fn consider(&mut self, index: usize, distance: f64) {
        let squared = distance * distance;
        if squared < self.squared {
            self.squared = squared;
            self.hit = Hit { distance, index };
        }
    }
}

/// A point of a surface with what shading needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Where it is.
    pub point: Point,
    /// The unit normal there.
    pub normal: Vector,
    /// The surface's own colour there, 0 to 255.
    pub colour: Rgb,
    /// The fraction of light that it mirrors, 0 to 1.
    pub gloss: f32,
    /// The place of the shape in the scene's list.
    pub shape: usize,
}

/// The surface of a shape, in the numbers that shading computes with.
#[derive(Debug, Clone, Copy)]
struct Look {
    colour: Rgb,
    second: Option<Rgb>,
    gloss: f32,
    shape: usize,
}

impl Look {
    fn new(surface: &Surface, shape: usize) -> Self {
        let rgb = |c: Colour| c.codes().map(f32::from);
        let second = match surface.pattern {
            Pattern::Solid => None,
            Pattern::Checker(checker) => Some(rgb(checker.second)),
        };
        Self { colour: rgb(surface.colour), second, gloss: surface.gloss.get() as f32, shape }
    }
}

impl World {
    /// The shapes of `scene`: all spheres, then all planes, then all custom
    /// shapes, each in the scene's order. The first of several shapes hit at
    /// the same distance is the one seen. Shapes of other kinds are left out.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let (mut spheres, mut planes, mut customs) = (Vec::new(), Vec::new(), Vec::new());
        let mut looks = [Vec::new(), Vec::new(), Vec::new()];
        for (i, shape) in scene.shapes.iter().enumerate() {
            let look = Look::new(&shape.surface, i);
            match &shape.geometry {
                Geometry::Sphere(sphere) => {
                    spheres.push(*sphere);
                    looks[0].push(look);
                }
                Geometry::Plane(plane) => {
                    planes.push(Half::new(plane));
                    looks[1].push(look);
                }
                Geometry::Custom(custom) => {
                    customs.push(Arc::clone(custom));
                    looks[2].push(look);
                }
                // Scenes with other shapes are refused before they come here.
                _ => {}
            }
        }
        Self {
            balls: Balls::pack(&spheres),
            spheres: spheres.iter().map(Ball::new).collect(),
            halves: Halves::pack(&planes),
            planes,
            customs,
            looks: looks.concat(),
        }
    }

    /// The nearest hit, by squared distance, so that one close behind the
    /// origin hides one farther ahead.
    #[inline]
    #[must_use]
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let mut nearest =
            Nearest { squared: f64::INFINITY, hit: Hit { distance: 0.0, index: usize::MAX } };
        for (i, balls) in self.balls.iter().enumerate() {
            balls.distances(ray, |lane, distance| nearest.consider(i * LANES + lane, distance));
        }
        let first = self.spheres.len();
        for (i, halves) in self.halves.iter().enumerate() {
            halves.distances(ray, nearest.squared, |lane, distance| {
                nearest.consider(first + i * LANES + lane, distance);
            });
        }
        let hit = (nearest.hit.index != usize::MAX).then_some(nearest.hit);
        if self.customs.is_empty() { hit } else { self.nearest_custom(ray, hit, nearest.squared) }
    }

    /// The nearest hit, where that of spheres and planes is known.
    #[cold]
    pub(super) fn nearest_custom(&self, ray: &Ray, hit: Option<Hit>, squared: f64) -> Option<Hit> {
        let none = Hit { distance: 0.0, index: usize::MAX };
        let mut nearest = Nearest { squared, hit: hit.unwrap_or(none) };
        let first = self.spheres.len() + self.planes.len();
        for (i, custom) in self.customs.iter().enumerate() {
            if let Some(distance) = custom.nearest(ray) {
                nearest.consider(first + i, distance);
            }
        }
        (nearest.hit.index != usize::MAX).then_some(nearest.hit)
    }

    /// The point that was hit, with all that shading needs.
    #[inline]
    #[must_use]
    pub fn expand(&self, ray: &Ray, hit: Hit) -> SurfacePoint {
        let point = ray.at(hit.distance);
        let look = self.looks[hit.index];
        let checked = look.second.is_some();
        let plane = hit.index.wrapping_sub(self.spheres.len());
        let custom = plane.wrapping_sub(self.planes.len());
        let (normal, shows_second) = if let Some(sphere) = self.spheres.get(hit.index) {
            let normal = sphere.normal(&point);
            (normal, checked && checker::on_sphere(normal))
        } else if let Some(plane) = self.planes.get(plane) {
            (plane.normal, checked && plane.shows_second_colour(&point))
        } else {
            let custom = &self.customs[custom];
            let normal = custom.normal(&point);
            // Lit on the side that is seen.
            let normal = if normal.dot(&ray.direction) > 0.0 { -normal } else { normal };
            (normal, checked && custom.shows_second_colour(&point))
        };
        let colour = look.second.filter(|_| shows_second).unwrap_or(look.colour);
        SurfacePoint { point, normal, colour, gloss: look.gloss, shape: look.shape }
    }
}
