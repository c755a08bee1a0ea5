//! The lights of a scene, which shapes can hide them, and whether they do.

use super::naive_unit;
use super::plane::Half;
use super::sphere::Ways;
use super::vectors::dot;
use super::world::World;
use lancer_kernel::Culling;
use lancer_kernel::lanes::{Lanes, MOST, Mask, One, Real, Vectors, lanes_of};
use lancer_math::{Point, Ray, Vector, elementary};
use lancer_scene::Scene;

/// The lights of a scene: all suns, then all lamps, the order of their sums.
#[derive(Debug, Clone)]
pub(super) struct Lights {
    pub(super) all: Vec<Light>,
    /// The sum of all brightnesses.
    total: f64,
}

/// A light, with the shapes that may hide it.
#[derive(Debug, Clone)]
pub(super) struct Light {
    /// Where the lamp is, or the unit vector towards the sun.
    pub(super) place: Vector,
    pub(super) is_lamp: bool,
    brightness: f64,
    /// Its glow is nothing where the square of the cosine between a ray and the
    /// way to it is below this.
    glow_from: f64,
    /// It is a sun that a plane hides from everywhere.
    is_hidden: bool,
    /// By sphere, whether the lamp is inside.
    inside: Vec<bool>,
    /// The planes that may hide it from a point whose coordinates are all at most
    /// `proven_within` in size.
    planes: Vec<Half>,
    proven_within: f64,
}

/// What may hide a light from some points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Suspects<'a> {
    /// Places in the world's list of spheres.
    pub(super) spheres: &'a [u32],
    pub(super) planes: &'a [Half],
}

/// A light that is visible from the eye.
#[derive(Debug, Clone)]
pub(super) struct Beacon {
    pub(super) light: usize,
    /// The way from the eye, and the square of its length.
    pub(super) way: Vector,
    pub(super) length_squared: f64,
}

impl Lights {
    pub(super) fn new(scene: &Scene, world: &World, culling: &Culling) -> Self {
        let (mut suns, mut lamps) = (Vec::new(), Vec::new());
        for light in &scene.lights {
            let brightness = light.brightness().get();
            match light {
                lancer_scene::Light::Sun { direction, .. } => {
                    suns.push(Light::sun(naive_unit(-direction.get()), brightness, world));
                }
                // Scenes with spots are refused before they come here.
                lancer_scene::Light::Lamp { point, .. }
                | lancer_scene::Light::Spot { point, .. } => {
                    lamps.push(Light::lamp(point.get().coords, brightness, world, culling));
                }
            }
        }
        suns.append(&mut lamps);
        Self { all: suns, total: scene.lights.iter().map(|light| light.brightness().get()).sum() }
    }

    /// Whether sums of light are so far from overflowing that a colour times
    /// such a sum, with glow on top, is finite.
    pub(super) fn is_finite(&self) -> bool {
        self.total < f64::from(f32::MAX) / 1024.0
    }

    /// The lights that are visible from the eye, in the order of sums.
    pub(super) fn beacons(&self, eye: Point, world: &World) -> Vec<Beacon> {
        let mut beacons = Vec::new();
        for (i, light) in self.all.iter().enumerate() {
            let ways = light.ways_from(One, &eye.coords.into());
            let suspects = Suspects { spheres: &world.everything().spheres, planes: &world.planes };
            if !light.hidden(One, world, &ways, suspects, 1).any() {
                let (way, length_squared) = (ways.vectors.into(), ways.lengths_squared);
                beacons.push(Beacon { light: i, way, length_squared });
            }
        }
        beacons
    }
}

impl Light {
    fn sun(towards: Vector, brightness: f64, world: &World) -> Self {
        Self {
            place: towards,
            is_lamp: false,
            brightness,
            glow_from: glow_from(brightness),
            is_hidden: world.planes.iter().any(|plane| plane.hides_sun(&towards)),
            inside: Vec::new(),
            planes: Vec::new(),
            proven_within: f64::INFINITY,
        }
    }

    /// Leaves out the planes that do not hide the lamp.
    fn lamp(lamp: Vector, brightness: f64, world: &World, culling: &Culling) -> Self {
        let mut proven_within = f64::INFINITY;
        let mut planes = world.planes.clone();
        if culling.idle_planes {
            planes.retain(|plane| match never_hides(plane, &lamp) {
                None => true,
                Some(within) => {
                    proven_within = proven_within.min(within);
                    false
                }
            });
        }
        Self {
            place: lamp,
            is_lamp: true,
            brightness,
            glow_from: glow_from(brightness),
            is_hidden: false,
            inside: world.spheres.iter().map(|sphere| sphere.holds(&lamp)).collect(),
            planes,
            proven_within,
        }
    }

    /// The planes that may hide it from points with coordinates up to that size.
    #[inline(always)]
    pub(super) fn planes<'a>(&'a self, world: &'a World, largest: f64) -> &'a [Half] {
        if !self.is_lamp {
            &[]
        } else if largest <= self.proven_within {
            &self.planes
        } else {
            &world.planes
        }
    }

    #[inline(always)]
    pub(super) fn ways_from<L: Lanes>(
        &self,
        lanes: L,
        origins: &Vectors<L::Real>,
    ) -> Ways<L::Real> {
        let place = Vectors::splat(lanes, &self.place);
        if self.is_lamp {
            let vectors = place - *origins;
            let lengths_squared = dot(&vectors, &vectors);
            Ways { origins: *origins, vectors, lengths_squared }
        } else {
            Ways { origins: *origins, vectors: place, lengths_squared: lanes.splat(1.0) }
        }
    }

    /// From where it is hidden, at least in the lanes that are `asked` for, as
    /// bits.
    ///
    /// The original asks for the nearest hit along the ray to the light and
    /// whether it is nearer than the light; any hit that is nearer answers the
    /// same. Nothing is divided, so the lengths of the ways need not be known.
    #[inline(always)]
    pub(super) fn hidden<L: Lanes>(
        &self,
        lanes: L,
        world: &World,
        ways: &Ways<L::Real>,
        suspects: Suspects<'_>,
        asked: u32,
    ) -> L::Mask {
        if self.is_hidden {
            return lanes.mask(u32::MAX);
        }
        let mut hidden = lanes.mask(0);
        for &i in suspects.spheres {
            let i = i as usize;
            let hides = if self.is_lamp {
                world.spheres[i].hides_lamp(lanes, ways, self.inside[i])
            } else {
                world.spheres[i].hides_sun(lanes, ways)
            };
            hidden = hidden | hides;
            if asked & !hidden.bits() == 0 {
                return hidden;
            }
        }
        if self.is_lamp {
            for plane in suspects.planes {
                hidden = hidden | plane.hides_lamp(lanes, ways);
            }
        }
        if !world.customs.is_empty() {
            let by_customs = self.hidden_by_customs::<L>(world, ways, asked & !hidden.bits());
            hidden = hidden | lanes.mask(by_customs);
        }
        hidden
    }

    #[inline(always)]
    fn hidden_by_customs<L: Lanes>(&self, world: &World, ways: &Ways<L::Real>, asked: u32) -> u32 {
        let mut hidden = 0;
        for k in lanes_of(asked) {
            let length_squared = ways.lengths_squared.lane(k);
            let reach = if self.is_lamp { length_squared } else { f64::INFINITY };
            let direction = ways.vectors.lane(k) / length_squared.sqrt();
            let ray = Ray::new(ways.origins.lane(k).into(), direction);
            for custom in &world.customs {
                let nearer = custom.nearest(&ray).is_some_and(
                    #[inline(always)]
                    |distance| distance * distance < reach,
                );
                hidden |= u32::from(nearer) << k;
            }
        }
        hidden
    }

    /// `sum` and what it gives to surfaces where it is at a cosine of `along` by
    /// the length of the way.
    #[inline(always)]
    pub(super) fn lit<L: Lanes>(
        &self,
        lanes: L,
        along: L::Real,
        ways: &Ways<L::Real>,
        sum: L::Real,
    ) -> L::Real {
        lanes.splat(self.brightness).mul_add(along / ways.lengths_squared.sqrt(), sum)
    }

    /// Where it glows, if it is not hidden: for rays that go so far `along` a way
    /// to it.
    #[inline(always)]
    pub(super) fn glows<L: Lanes>(
        &self,
        lanes: L,
        along: L::Real,
        lengths_squared: L::Real,
    ) -> L::Mask {
        // Neither what glows too faintly, nor NaN.
        along.gt(lanes.splat(0.0)) & (along * along).ge(lengths_squared * self.glow_from)
    }

    /// `sum` and its glow in those lanes.
    #[inline(always)]
    pub(super) fn add_glow<L: Lanes>(
        &self,
        lanes: L,
        along: L::Real,
        lengths_squared: L::Real,
        glows: L::Mask,
        sum: L::Real,
    ) -> L::Real {
        let cosines_squared = along * along / lengths_squared;
        let glow = exp(lanes, (cosines_squared - 1.0) * GLOW_STEEPNESS, glows);
        glows.select(lanes.splat(self.brightness).mul_add(glow, sum), sum)
    }

    /// Whether rays within a cone may see it glow, by the largest cosine between
    /// one of them and the way to it.
    pub(super) fn may_glow(&self, largest_cosine: f64) -> bool {
        let fades = largest_cosine * largest_cosine < self.glow_from - 1e-6;
        // NaN may.
        !(largest_cosine <= 0.0 || fades)
    }
}

/// [`elementary::exp`] in each lane, at least in those that are asked for.
#[inline(always)]
fn exp<L: Lanes>(lanes: L, x: L::Real, asked: L::Mask) -> L::Real {
    let usual = x.gt(lanes.splat(-708.0)) & x.lt(lanes.splat(709.0));
    if (asked & !usual).any() {
        let mut each = [0.0; MOST];
        x.store(&mut each);
        for x in &mut each[..L::WIDTH] {
            *x = elementary::exp(*x);
        }
        return lanes.load(&each);
    }
    let rounded = x * std::f64::consts::LOG2_E + 6_755_399_441_055_744.0;
    let k = rounded - 6_755_399_441_055_744.0;
    let r = (x - k * 6.931_471_803_691_238e-1) - k * 1.908_214_929_270_587_7e-10;
    let r2 = r * r;
    let r4 = r2 * r2;
    let p23 = r * (1.0 / 6.0) + 1.0 / 2.0;
    let p45 = r * (1.0 / 120.0) + 1.0 / 24.0;
    let p67 = r * (1.0 / 5040.0) + 1.0 / 720.0;
    let p89 = r * (1.0 / 362_880.0) + 1.0 / 40_320.0;
    let pab = r * (1.0 / 39_916_800.0) + 1.0 / 3_628_800.0;
    let pcd = r * (1.0 / 6_227_020_800.0) + 1.0 / 479_001_600.0;
    let low = p23 + r2 * p45;
    let middle = p67 + r2 * p89;
    let high = pab + r2 * pcd;
    let tail = low + r4 * (middle + r4 * high);
    let power = (r + r2 * tail) + 1.0;
    power * k.exp2_of_whole()
}

/// Whether the plane hides a lamp from no point whose coordinates are at most
/// so large: it does not if the lamp is on its lit side.
///
/// Let h > 0 be the lamp's height over the plane and a that of the shaded
/// point. The ray to the lamp goes against the normal only if a > h; then it
/// meets the plane beyond the lamp, since a > a - h. In floating-point numbers
/// with unit roundoff u that holds as long as h is more than the sum of the
/// rounding errors: the heights err by at most 4 u (|point| + |lamp| + |origin|)
/// each, the slope of the way by another 5 u (|point| + |lamp|). Together that
/// is less than 64 u (|point| + |lamp| + |origin|), which bounds how large
/// |point| may be.
fn never_hides(plane: &Half, lamp: &Vector) -> Option<f64> {
    let height = lamp.dot(&plane.normal) - plane.offset;
    let size = lamp.norm() + plane.origin.coords.norm();
    // A point with coordinates up to c is at most 2 c from the origin.
    let within = (height / (32.0 * f64::EPSILON) - size) / 2.0;
    (within > size).then_some(within)
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
