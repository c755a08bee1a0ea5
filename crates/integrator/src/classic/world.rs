use super::plane::Half;
use super::sphere::{Ball, Places};
use super::vectors::after;
use crate::Rgb;
use lancer_kernel::lanes::{Lanes, Mask, One, Real, Vectors, lanes_of};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{Colour, CustomShape, Geometry, Pattern, Scene, Surface};
use std::sync::Arc;

/// The shapes of a scene, made ready to be hit as the original hits them:
/// planes have one side, and a hit may lie behind the ray's origin.
#[derive(Debug, Clone)]
pub struct World {
    pub(super) spheres: Vec<Ball>,
    pub(super) places: Places,
    pub(super) planes: Vec<Half>,
    pub(super) customs: Vec<Arc<dyn CustomShape>>,
    /// Of all spheres, then all planes, then all custom shapes.
    pub(super) looks: Vec<Look>,
    /// The numbers of all of them.
    everything: Candidates,
}

/// What a ray met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// How far along the ray; negative where it is behind the origin.
    pub distance: f64,
    /// The world's number for the shape.
    pub(super) index: usize,
}

/// Spheres and planes that some rays may meet, by their places in the world's
/// lists, in order.
#[derive(Debug, Clone, Default)]
pub(super) struct Candidates {
    pub(super) spheres: Vec<u32>,
    pub(super) planes: Vec<u32>,
}

/// The nearest hits so far.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nearest<R> {
    squared: R,
    pub(super) distance: R,
    /// The world's numbers for the shapes; -1 where there is no hit.
    pub(super) index: R,
}

impl<R: Real> Nearest<R> {
    #[inline(always)]
    fn none<L: Lanes<Real = R>>(lanes: L) -> Self {
        Self {
            squared: lanes.splat(f64::INFINITY),
            distance: lanes.splat(0.0),
            index: lanes.splat(-1.0),
        }
    }

    /// Takes those of the new `distances` in lanes of `mask` that are nearer; of
    /// equally near ones the first stays, and NaN is never nearer.
    #[inline(always)]
    fn consider<L: Lanes<Real = R, Mask = R::Mask>>(
        &mut self,
        lanes: L,
        index: usize,
        distance: R,
        mask: R::Mask,
    ) {
        let squared = distance * distance;
        let nearer = squared.lt(self.squared) & mask;
        self.squared = nearer.select(squared, self.squared);
        self.distance = nearer.select(distance, self.distance);
        self.index = nearer.select(lanes.splat(index as f64), self.index);
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
pub(super) struct Look {
    pub(super) colour: Rgb,
    pub(super) second: Option<Rgb>,
    pub(super) gloss: f32,
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
        let everything = Candidates {
            spheres: (0..).take(spheres.len()).collect(),
            planes: (0..).take(planes.len()).collect(),
        };
        Self {
            places: Places::new(&spheres),
            spheres: spheres.iter().map(Ball::new).collect(),
            planes,
            customs,
            looks: looks.concat(),
            everything,
        }
    }

    pub(super) const fn everything(&self) -> &Candidates {
        &self.everything
    }

    /// The nearest hit, by squared distance, so that one close behind the
    /// origin hides one farther ahead.
    #[must_use]
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let (origin, direction) = (ray.origin.coords.into(), ray.direction.into());
        let nearest = self.meet(One, &self.everything, &origin, &direction, 1);
        (nearest.index >= 0.0)
            .then_some(Hit { distance: nearest.distance, index: nearest.index as usize })
    }

    /// The nearest hits of rays that meet nothing but `candidates` and custom
    /// shapes; `asked` are the lanes, as bits, in which custom shapes are asked.
    #[inline(always)]
    pub(super) fn meet<L: Lanes>(
        &self,
        lanes: L,
        candidates: &Candidates,
        origins: &Vectors<L::Real>,
        directions: &Vectors<L::Real>,
        asked: u32,
    ) -> Nearest<L::Real> {
        let mut nearest = Nearest::none(lanes);
        for &i in &candidates.spheres {
            let i = i as usize;
            let (hits, distance) = self.spheres[i].meet(lanes, origins, directions);
            if hits.any() {
                nearest.consider(lanes, i, distance, hits);
            }
        }
        let first = self.spheres.len();
        for &i in &candidates.planes {
            let i = i as usize;
            let (hits, distance) = self.planes[i].meet(lanes, origins, directions);
            if hits.any() {
                nearest.consider(lanes, first + i, distance, hits);
            }
        }
        let first = first + self.planes.len();
        for (i, custom) in self.customs.iter().enumerate() {
            let mut distances = [f64::NAN; lancer_kernel::lanes::MOST];
            for k in lanes_of(asked) {
                let ray = Ray::new(origins.lane(k).into(), directions.lane(k));
                distances[k] = custom.nearest(&ray).unwrap_or(f64::NAN);
            }
            let all = lanes.mask(u32::MAX);
            nearest.consider(lanes, first + i, lanes.load(&distances), all);
        }
        nearest
    }

    /// The point that was hit, with all that shading needs.
    #[must_use]
    pub fn expand(&self, ray: &Ray, hit: Hit) -> SurfacePoint {
        let point = after(&ray.origin.coords.into(), hit.distance, &ray.direction.into());
        let look = self.looks[hit.index];
        let checked = look.second.is_some();
        let plane = hit.index.wrapping_sub(self.spheres.len());
        let custom = plane.wrapping_sub(self.planes.len());
        let (normal, shows_second) = if let Some(sphere) = self.spheres.get(hit.index) {
            let normal = sphere.normals(One, &point);
            (normal.into(), checked && super::checker::on_sphere(One, &normal).any())
        } else if let Some(plane) = self.planes.get(plane) {
            (plane.normal, checked && plane.shows_second_colour(One, &point).any())
        } else {
            custom_normal(&*self.customs[custom], point.into(), ray.direction, checked)
        };
        let colour = look.second.filter(|_| shows_second).unwrap_or(look.colour);
        let point = Vector::from(point).into();
        SurfacePoint { point, normal, colour, gloss: look.gloss, shape: look.shape }
    }
}

/// The normal of a custom shape on the side that is seen, where it is lit, and
/// whether it shows the second colour of a checker.
pub(super) fn custom_normal(
    custom: &dyn CustomShape,
    point: Vector,
    direction: Vector,
    checked: bool,
) -> (Vector, bool) {
    let point = point.into();
    let normal = custom.normal(&point);
    let normal = if normal.dot(&direction) > 0.0 { -normal } else { normal };
    (normal, checked && custom.shows_second_colour(&point))
}
