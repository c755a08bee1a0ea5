//! The rays from the eye, four pixels at a time.
//!
//! They all start at one point, so what depends on that alone is computed
//! once. Each lane gives what [`World::nearest`] and the glow of a single ray
//! would, bit for bit.

use super::camera::PinholeCamera;
use super::lanes::{LANES, Vectors};
use super::lighting::{Beacon, Lighting};
use super::plane::Facing;
use super::sphere::Ahead;
use super::world::{Hit, World};
use lancer_math::{Ray, Vector};
use wide::f64x4;

/// A scene as it is seen from the eye.
#[derive(Debug, Clone)]
pub(super) struct Eye {
    camera: PinholeCamera,
    spheres: Vec<Ahead>,
    planes: Vec<Facing>,
    /// The lights that are visible from the eye.
    beacons: Vec<Beacon>,
}

/// What the rays of four neighbouring pixels meet.
pub(super) struct Views {
    directions: Vectors,
    hits: [Option<Hit>; LANES],
    /// How brightly the lights glow along each ray, as a fraction of white.
    pub(super) glow: [f32; LANES],
}

impl Views {
    /// The ray of one of the pixels, and what it meets.
    #[inline(always)]
    pub(super) fn lane(&self, eye: &Eye, k: usize) -> (Ray, Option<Hit>) {
        let direction: Vector = self.directions.lane(k);
        (Ray::new(eye.camera.origin(), direction), self.hits[k])
    }
}

/// The nearest hits so far.
pub(super) struct Nearest {
    pub(super) squared: f64x4,
    pub(super) distance: f64x4,
    /// The world's numbers for the shapes; -1 where there is no hit.
    pub(super) index: f64x4,
}

impl Nearest {
    /// Takes those of the new `distances` in lanes of `mask` that are nearer; of
    /// equally near ones the first stays.
    #[inline(always)]
    pub(super) fn consider(&mut self, index: f64x4, distance: f64x4, mask: f64x4) {
        let squared = distance * distance;
        let nearer = squared.simd_lt(self.squared) & mask;
        self.squared = nearer.bitselect(squared, self.squared);
        self.distance = nearer.bitselect(distance, self.distance);
        self.index = nearer.bitselect(index, self.index);
    }
}

impl Eye {
    pub(super) fn new(camera: PinholeCamera, world: &World, lighting: &Lighting) -> Self {
        let origin = camera.origin();
        Self {
            spheres: world.spheres.iter().map(|sphere| sphere.ahead_of(&origin)).collect(),
            planes: world.planes.iter().map(|plane| plane.facing(&origin)).collect(),
            beacons: lighting.beacons(origin, world),
            camera,
        }
    }

    /// What the pixels from column `x` of row `y` on see.
    #[inline]
    pub(super) fn look(&self, world: &World, x: u32, y: u32) -> Views {
        let directions = self.camera.directions(x, y);
        let mut nearest = Nearest {
            squared: f64x4::splat(f64::INFINITY),
            distance: f64x4::ZERO,
            index: f64x4::splat(-1.0),
        };
        let mut index = f64x4::ZERO;
        for sphere in &self.spheres {
            sphere.meet(&directions, index, &mut nearest);
            index += f64x4::ONE;
        }
        for plane in &self.planes {
            plane.meet(&directions, index, &mut nearest);
            index += f64x4::ONE;
        }
        let (distance, index) = (nearest.distance.to_array(), nearest.index.to_array());
        let squared = nearest.squared.to_array();
        let hits = std::array::from_fn(|k| {
            let hit = (index[k] >= 0.0)
                .then_some(Hit { distance: distance[k], index: index[k] as usize });
            if world.customs.is_empty() {
                return hit;
            }
            let ray = Ray::new(self.camera.origin(), directions.lane(k));
            world.nearest_custom(&ray, hit, squared[k])
        });
        Views { directions, hits, glow: self.glow(&directions) }
    }

    #[inline(always)]
    fn glow(&self, directions: &Vectors) -> [f32; LANES] {
        let mut sum = f64x4::ZERO;
        for beacon in &self.beacons {
            sum += beacon.glow(directions);
        }
        sum.to_array().map(|sum| sum as f32)
    }
}
