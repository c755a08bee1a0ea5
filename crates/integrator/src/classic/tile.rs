//! A tile of pixels on its way through the stages: rays from the eye, what they
//! meet, what is to be seen there, which lights reach it, the mirrored rays, and
//! so on; in the end the colours are folded, deepest mirrors first.

use super::buffers::{Buffers, Bundle, Level};
use super::bundle::{Around, Cone};
use super::camera::PinholeCamera;
use super::lights::{Beacon, Lights};
use super::vectors::{after, dot};
use super::world::World;
use crate::rows::{BATCH, load, pack, store};
use crate::{RayCounts, Rgb};
use lancer_film::Window;
use lancer_kernel::Culling;
use lancer_kernel::lanes::{Lanes, MOST, Mask, One, Real, Vectors, Work};
use lancer_math::Vector;
use std::cell::Cell;

/// How many mirrors a ray is followed through.
pub(super) const MOST_MIRRORS: usize = 4;

/// What the original's engines know of a scene.
#[derive(Debug)]
pub(crate) struct Stage {
    pub(super) camera: PinholeCamera,
    pub(super) world: World,
    pub(super) lights: Lights,
    /// The lights that are visible from the eye; none where there is no glow.
    pub(super) beacons: Vec<Beacon>,
    /// Whether mirrors show anything.
    pub(super) has_mirrors: bool,
    pub(super) own_colour_is_finite: bool,
    pub(super) culling: Culling,
}

thread_local! {
    static BUFFERS: Cell<Option<Box<Buffers>>> = const { Cell::new(None) };
}

/// A tile of at most [`BATCH`] pixels, to be dispatched.
pub(crate) struct Tile<'a> {
    pub(crate) stage: &'a Stage,
    pub(crate) window: Window,
    pub(crate) pixels: &'a mut [Rgb],
    pub(crate) counts: &'a mut RayCounts,
}

impl Work for Tile<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        // A shape of the user's own may render a picture to answer.
        let mut buffers = BUFFERS.take().unwrap_or_else(Buffers::new);
        self.stage.tile(lanes, self.window, &mut buffers, self.counts);
        let level = &buffers.levels[0];
        let count = level.count.min(BATCH);
        let [red, green, blue] = &level.colour;
        let colours = red[..count].iter().zip(&green[..count]).zip(&blue[..count]);
        for (((red, green), blue), place) in colours.zip(&level.parent[..count]) {
            if let Some(pixel) = self.pixels.get_mut(*place as u32 as usize) {
                *pixel = [*red, *green, *blue];
            }
        }
        BUFFERS.set(Some(buffers));
    }
}

impl Stage {
    #[inline(always)]
    fn tile<L: Lanes>(
        &self,
        lanes: L,
        window: Window,
        buffers: &mut Buffers,
        counts: &mut RayCounts,
    ) {
        self.look(lanes, window, buffers);
        counts.primary += window.pixels();
        let mut depth = 0;
        loop {
            self.meet(lanes, buffers);
            self.sort(lanes, buffers, depth);
            self.shade(lanes, buffers, depth);
            self.light(lanes, buffers, counts);
            self.colour(buffers, depth);
            if self.has_mirrors && depth < MOST_MIRRORS {
                self.leave(lanes, buffers);
                counts.reflected += buffers.rays.count as u64;
            } else {
                buffers.rays.count = 0;
            }
            if buffers.rays.count == 0 {
                break;
            }
            depth += 1;
        }
        while depth > 0 {
            fold(&mut buffers.levels, depth);
            depth -= 1;
        }
    }

    /// The rays from the eye and the glow of the lights that it sees.
    #[inline(always)]
    fn look<L: Lanes>(&self, lanes: L, window: Window, buffers: &mut Buffers) {
        let Buffers { rays, numbers, .. } = buffers;
        rays.count = window.pixels() as usize;
        let eye = Vectors::splat(lanes, &self.camera.origin().coords);
        let width = window.width as usize;
        for row in 0..window.height {
            let start = row as usize * width;
            for column in (0..width).step_by(L::WIDTH) {
                let columns = load(lanes, numbers, column) + f64::from(window.x);
                let directions = self.camera.directions(lanes, columns, window.y + row);
                let i = start + column;
                rays.origins.store(lanes, i, &eye);
                rays.directions.store(lanes, i, &directions);
                store(lanes, &mut rays.share, i, lanes.splat(1.0));
                store(lanes, &mut rays.glow, i, lanes.splat(0.0));
            }
        }
        let everything = 0..rays.count;
        rays.parent = *numbers;
        rays.bundles.clear();
        let cone = Cone::of_corners(self.corners(window));
        let around = Around::point(self.camera.origin().coords);
        rays.bundles.push(Bundle { range: everything.clone(), around, cone: Some(cone) });
        for beacon in &self.beacons {
            let light = &self.lights.all[beacon.light];
            let is_faint = !light.may_glow(cone.largest_cosine(&beacon.way));
            if is_faint && self.culling.tile_candidates {
                continue;
            }
            let way = Vectors::splat(lanes, &beacon.way);
            let length_squared = lanes.splat(beacon.length_squared);
            for i in everything.clone().step_by(L::WIDTH) {
                let along = dot(&rays.directions.load(lanes, i), &way);
                let glows = light.glows(lanes, along, length_squared);
                if glows.any() {
                    let sum = load(lanes, &rays.glow, i);
                    let sum = light.add_glow(lanes, along, length_squared, glows, sum);
                    store(lanes, &mut rays.glow, i, sum);
                }
            }
        }
        in_codes(&mut rays.glow[..rays.count]);
    }

    #[inline(always)]
    fn corners(&self, window: Window) -> [Vector; 4] {
        let (left, right) = (window.x, window.x + window.width - 1);
        let (top, bottom) = (window.y, window.y + window.height - 1);
        let corner = |x, y| self.camera.directions(One, f64::from(x), y).into();
        [corner(left, top), corner(right, top), corner(left, bottom), corner(right, bottom)]
    }

    /// The nearest hits.
    #[inline(always)]
    fn meet<L: Lanes>(&self, lanes: L, buffers: &mut Buffers) {
        let Buffers { rays, met, candidates, .. } = buffers;
        for Bundle { range, around, cone } in &rays.bundles {
            let candidates = if self.culling.tile_candidates {
                let cone = match cone {
                    Some(cone) => *cone,
                    None => Cone::new(lanes, &rays.directions, range.clone()),
                };
                cone.candidates(lanes, &self.world, around, candidates);
                &*candidates
            } else {
                self.world.everything()
            };
            for i in range.clone().step_by(L::WIDTH) {
                let origins = rays.origins.load(lanes, i);
                let directions = rays.directions.load(lanes, i);
                let asked = lanes.first(range.end - i).bits();
                let nearest = self.world.meet(lanes, candidates, &origins, &directions, asked);
                store(lanes, &mut met.distance, i, nearest.distance);
                store(lanes, &mut met.index, i, nearest.index);
            }
        }
    }

    /// Sorts the hits by shape and finds their points.
    #[inline(always)]
    fn sort<L: Lanes>(&self, lanes: L, buffers: &mut Buffers, depth: usize) {
        let Buffers { rays, met, levels, .. } = buffers;
        let level = &mut levels[depth];
        level.count = rays.count;
        let registers = rays.count.div_ceil(L::WIDTH);
        // Lanes that have no place yet.
        let mut rest = [0_u8; BATCH + MOST];
        for (r, rest) in rest.iter_mut().enumerate().take(registers) {
            *rest = lanes.first(rays.count - r * L::WIDTH).bits() as u8;
        }
        met.parts.clear();
        let (mut first, mut count) = (0, 0);
        while first < registers {
            if rest[first] == 0 {
                first += 1;
                continue;
            }
            let index = met.index[first * L::WIDTH + rest[first].trailing_zeros() as usize];
            let start = count;
            for (r, rest) in rest.iter_mut().enumerate().take(registers).skip(first) {
                let i = r * L::WIDTH;
                let same = load(lanes, &met.index, i).eq(lanes.splat(index)).bits();
                let bits = same & u32::from(*rest);
                if bits == 0 {
                    continue;
                }
                *rest &= !(bits as u8);
                let mask = lanes.mask(bits);
                let directions = rays.directions.load(lanes, i);
                let distance = load(lanes, &met.distance, i);
                let points = after(&rays.origins.load(lanes, i), distance, &directions);
                met.points.pack(lanes, count, &points, mask);
                met.directions.pack(lanes, count, &directions, mask);
                pack(lanes, &mut met.glow, count, load(lanes, &rays.glow, i), mask);
                pack(lanes, &mut met.share, count, load(lanes, &rays.share, i), mask);
                pack(lanes, &mut level.parent, count, load(lanes, &rays.parent, i), mask);
                count += bits.count_ones() as usize;
            }
            let shape = (index >= 0.0).then_some(index as usize);
            met.parts.push((shape, start..count));
        }
    }
}

/// Sums of light in codes of an 8-bit picture, in single precision.
#[inline(always)]
pub(super) fn in_codes(sums: &mut [f64]) {
    for sum in sums {
        *sum = f64::from(255.0 * *sum as f32);
    }
}

/// Adds what the mirrors of a level show to the level above.
#[inline(always)]
fn fold(levels: &mut [Level; MOST_MIRRORS + 1], depth: usize) {
    let (above, below) = levels.split_at_mut(depth);
    let (Some(above), Some(below)) = (above.last_mut(), below.first()) else { return };
    for i in 0..below.count.min(BATCH) {
        // In range; this shows it.
        let parent = (below.parent[i] as u32 as usize).min(BATCH - 1);
        let gloss = above.gloss[parent];
        for (own, shown) in above.colour.iter_mut().zip(&below.colour) {
            own[parent] = shown[i] * gloss + own[parent] * (1.0 - gloss);
        }
    }
}
