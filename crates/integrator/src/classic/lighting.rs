//! How much light reaches a point of a surface, and the glow around lights.

use super::lanes::{LANES, Vectors, each, lanes_of};
use super::naive_unit;
use super::occluders::{Occluders, Ways};
use crate::{RayCounts, SurfacePoint, World};
use lancer_math::{Point, Vector, elementary};
use lancer_scene::{Light, Scene};
use wide::f64x4;

/// The lights of a scene: all suns, then all lamps, the order of their sums.
#[derive(Debug, Clone)]
pub(crate) struct Lighting {
    groups: Vec<Group>,
    /// The sum of all brightnesses.
    total: f64,
}

/// Up to four lamps, or up to four suns.
#[derive(Debug, Clone)]
struct Group {
    /// The lanes that have a light, as bits.
    lights: u32,
    /// Where the lamps are, or unit vectors towards the suns.
    places: Vectors,
    are_lamps: bool,
    brightness: [f64; LANES],
    /// A light's glow is nothing where the square of the cosine between a ray
    /// and the way to the light is below this.
    glow_from: f64x4,
    occluders: Occluders,
}

/// What a point of a surface gets from the lights.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Gathered {
    /// The factor by which the surface's own colour is multiplied.
    pub(crate) lit: f32,
    /// How brightly the lights glow along the mirrored ray, as a fraction of
    /// white.
    pub(crate) glow: f32,
}

/// A light that is visible from the eye.
#[derive(Debug, Clone)]
pub(super) struct Beacon {
    way: Vector,
    length_squared: f64x4,
    brightness: f64x4,
    /// Where the square along a ray is below this, the glow is nothing.
    least: f64x4,
}

impl Beacon {
    /// How brightly it glows along each of the rays.
    #[inline(always)]
    pub(super) fn glow(&self, directions: &Vectors) -> f64x4 {
        let along = directions.dot(&self.way);
        let along_squared = along * along;
        let glows = along.simd_gt(f64x4::ZERO) & along_squared.simd_ge(self.least);
        if !glows.any() {
            return f64x4::ZERO;
        }
        let exponents = (along_squared / self.length_squared - 1.0) * GLOW_STEEPNESS;
        let glow = self.brightness * f64x4::from(elementary::exp_each(exponents.to_array()));
        glows & glow
    }
}

impl Lighting {
    pub(crate) fn new(scene: &Scene, world: &World) -> Self {
        let (mut suns, mut lamps) = (Vec::new(), Vec::new());
        for light in &scene.lights {
            let brightness = light.brightness().get();
            match light {
                Light::Sun { direction, .. } => {
                    suns.push((naive_unit(-direction.get()), brightness));
                }
                // Scenes with spots are refused before they come here.
                Light::Lamp { point, .. } | Light::Spot { point, .. } => {
                    lamps.push((point.get().coords, brightness));
                }
            }
        }
        let suns = suns.chunks(LANES).map(|suns| Group::new(suns, false, world));
        let lamps = lamps.chunks(LANES).map(|lamps| Group::new(lamps, true, world));
        Self {
            groups: suns.chain(lamps).collect(),
            total: scene.lights.iter().map(|light| light.brightness().get()).sum(),
        }
    }

    /// Whether sums of light are so far from overflowing that a colour times
    /// such a sum, with glow on top, is finite.
    pub(super) fn is_finite(&self) -> bool {
        self.total < f64::from(f32::MAX) / 1024.0
    }

    /// What reaches the surface; its own light only if `want_lit`, and the glow
    /// only if there is a `mirrored` direction to look for it.
    ///
    /// Both ask whether the same lights are hidden from the same point, so a
    /// mirrored ray's glow is found where it leaves.
    #[inline]
    pub(crate) fn gather(
        &self,
        world: &World,
        surface: &SurfacePoint,
        want_lit: bool,
        mirrored: Option<&Vector>,
        counts: &mut RayCounts,
    ) -> Gathered {
        let (mut lit, mut glow) = (0.0, 0.0);
        for group in &self.groups {
            let ways = group.ways_from(surface.point);
            let along = ways.vectors.dot(&surface.normal);
            let in_front =
                if want_lit { along.simd_ge(f64x4::ZERO).to_bitmask() & group.lights } else { 0 };
            let glows = mirrored.map_or(Glows::NOWHERE, |ray| group.glows(&ways, ray));
            let asked = in_front | glows.lights;
            counts.shadow += u64::from(asked.count_ones());
            let visible = asked & !group.occluders.hidden(world, &ways, asked);
            if in_front & visible != 0 {
                let cosines = (along / ways.lengths_squared.sqrt()).to_array();
                for k in lanes_of(in_front & visible) {
                    lit += group.brightness[k] * cosines[k];
                }
            }
            glow = group.add_glow(glow, &glows, visible);
        }
        Gathered { lit: lit as f32, glow: glow as f32 }
    }

    /// The lights that are visible from the eye, in the order of sums.
    pub(super) fn beacons(&self, eye: Point, world: &World) -> Vec<Beacon> {
        let beacons = |group: &Group| {
            let ways = group.ways_from(eye);
            let visible = group.lights & !group.occluders.hidden(world, &ways, group.lights);
            let lengths_squared = ways.lengths_squared.to_array();
            let least = (group.glow_from * ways.lengths_squared).to_array();
            let beacon = |k: usize| Beacon {
                way: ways.vectors.lane(k),
                length_squared: f64x4::splat(lengths_squared[k]),
                brightness: f64x4::splat(group.brightness[k]),
                least: f64x4::splat(least[k]),
            };
            lanes_of(visible).map(beacon).collect::<Vec<_>>()
        };
        self.groups.iter().flat_map(beacons).collect()
    }
}

/// Which lights of a group glow along a ray, unless hidden, and how brightly.
struct Glows {
    lights: u32,
    exponents: f64x4,
}

impl Glows {
    const NOWHERE: Self = Self { lights: 0, exponents: f64x4::ZERO };
}

impl Group {
    fn new(lights: &[(Vector, f64)], are_lamps: bool, world: &World) -> Self {
        let place = |k: usize| lights.get(k).map_or_else(Vector::zeros, |light| light.0);
        let brightness = |k: usize| lights.get(k).map_or(0.0, |light| light.1);
        let places: Vec<_> = lights.iter().map(|light| light.0).collect();
        Self {
            lights: (1 << lights.len()) - 1,
            places: Vectors::each(place),
            are_lamps,
            brightness: std::array::from_fn(brightness),
            glow_from: each(|k| glow_from(brightness(k))),
            occluders: if are_lamps {
                Occluders::of_lamps(&places, world)
            } else {
                Occluders::of_suns(&places, world)
            },
        }
    }

    #[inline(always)]
    fn ways_from(&self, origin: Point) -> Ways {
        if self.are_lamps {
            let vectors = self.places.minus(&origin);
            let lengths_squared = vectors.norm_squared();
            Ways { origin, vectors, lengths_squared, reaches: lengths_squared }
        } else {
            Ways {
                origin,
                vectors: self.places,
                lengths_squared: f64x4::ONE,
                reaches: f64x4::splat(f64::INFINITY),
            }
        }
    }

    #[inline(always)]
    fn glows(&self, ways: &Ways, ray: &Vector) -> Glows {
        let along = ways.vectors.dot(ray);
        let along_squared = along * along;
        // Neither what glows too faintly, nor NaN.
        let glows = along.simd_gt(f64x4::ZERO)
            & along_squared.simd_ge(self.glow_from * ways.lengths_squared);
        let cosines_squared = along_squared / ways.lengths_squared;
        Glows {
            lights: glows.to_bitmask() & self.lights,
            exponents: (cosines_squared - 1.0) * GLOW_STEEPNESS,
        }
    }

    /// `sum` and the glow of the visible lights, added one by one.
    #[inline(always)]
    fn add_glow(&self, mut sum: f64, glows: &Glows, visible: u32) -> f64 {
        let glowing = glows.lights & visible;
        if glowing != 0 {
            let glow = elementary::exp_each(glows.exponents.to_array());
            for k in lanes_of(glowing) {
                sum += self.brightness[k] * glow[k];
            }
        }
        sum
    }
}

/// The steepness of the glow: e^(-100 sin^2) of the angle to the light.
const GLOW_STEEPNESS: f64 = 100.0;

/// The square of the cosine from which on a light of that brightness glows.
///
/// The original's glow has no end. Here, by definition, it is nothing where it
/// would be less than 2^-50 of a code of an 8-bit picture. In pictures of 8
/// and 16 bits that cannot be seen, but for a sum that lies on a tie of rounding:
/// added in single precision it changes no bit of a component of 2^-25 or more,
/// and smaller ones are shown as 0. Formats with linear values hold 0 for it.
fn glow_from(brightness: f64) -> f64 {
    // brightness < 2^bits, and 255 < 2^8.
    let bits = (brightness.to_bits() >> 52) as i32 - 1022;
    1.0 - f64::from(50 + 8 + bits) * std::f64::consts::LN_2 / GLOW_STEEPNESS
}
