//! The stages from what rays meet to the rays that leave mirrors there.

use super::buffers::{Buffers, Bundle, Group, Met};
use super::bundle::Around;
use super::checker;
use super::lights::Suspects;
use super::tile::{MOST_MIRRORS, Stage, in_codes};
use super::vectors;
use super::world::custom_normal;
use crate::RayCounts;
use crate::rows::{load, pack, store};
use lancer_kernel::lanes::{Lanes, MOST, Mask, Real, Vectors, lanes_of};

/// A mirror whose share of the pixel is smaller is shown matte.
const LEAST_SHARE: f64 = 0.01;

/// So many points at least share lists of candidates, if there are as many.
const LEAST_GROUP: usize = 64;

impl Stage {
    /// Normals, cells of checkers, and mirrored directions.
    #[inline(always)]
    pub(super) fn shade<L: Lanes>(&self, lanes: L, buffers: &mut Buffers, depth: usize) {
        let Buffers { met, .. } = buffers;
        let (zero, one) = (lanes.splat(0.0), lanes.splat(1.0));
        let Met { parts, points, directions, normals, mirrored, .. } = met;
        for (shape, range) in parts {
            let Some(shape) = *shape else { continue };
            let look = &self.world.looks[shape];
            let checked = look.second.is_some();
            let may_mirror = self.has_mirrors && look.gloss != 0.0 && depth < MOST_MIRRORS;
            let is_full = look.gloss == 1.0 && self.own_colour_is_finite;
            let plane = shape.wrapping_sub(self.world.spheres.len());
            let custom = plane.wrapping_sub(self.world.planes.len());
            let splat = self.world.planes.get(plane).map(
                #[inline(always)]
                |plane| Vectors::splat(lanes, &plane.normal),
            );
            for i in range.clone().step_by(L::WIDTH) {
                let p = points.load(lanes, i);
                let mut second = lanes.mask(0);
                let n = if let Some(n) = splat {
                    if checked {
                        second = self.world.planes[plane].shows_second_colour(lanes, &p);
                    }
                    n
                } else if let Some(sphere) = self.world.spheres.get(shape) {
                    let n = sphere.normals(lanes, &p);
                    if checked {
                        second = checker::on_sphere(lanes, &n);
                    }
                    n
                } else {
                    let (mut x, mut y, mut z) = ([0.0; MOST], [0.0; MOST], [0.0; MOST]);
                    let mut bits = 0;
                    let d = directions.load(lanes, i);
                    for k in lanes_of(lanes.first(range.end - i).bits()) {
                        let custom = &*self.world.customs[custom];
                        let (n, second) = custom_normal(custom, p.lane(k), d.lane(k), checked);
                        (x[k], y[k], z[k]) = (n.x, n.y, n.z);
                        bits |= u32::from(second) << k;
                    }
                    second = lanes.mask(bits);
                    Vectors { x: lanes.load(&x), y: lanes.load(&y), z: lanes.load(&z) }
                };
                normals.store(lanes, i, &n);
                store(lanes, &mut met.second, i, second.select(one, zero));
                let mut mirrors = zero;
                let mut wants = one;
                if may_mirror {
                    let m = vectors::mirrored(&directions.load(lanes, i), &n);
                    mirrored.store(lanes, i, &m);
                    let shown = load(lanes, &met.share, i).ge(lanes.splat(LEAST_SHARE));
                    mirrors = shown.select(one, zero);
                    if is_full {
                        // What a perfect mirror adds of its own is 0 times a finite number.
                        let glow = load(lanes, &met.glow, i).abs();
                        let finite = glow.lt(lanes.splat(f64::INFINITY));
                        wants = (finite & shown).select(zero, one);
                    }
                }
                store(lanes, &mut met.mirrors, i, mirrors);
                store(lanes, &mut met.wants, i, wants);
            }
        }
    }

    /// The light on surfaces and along mirrored rays.
    #[inline(always)]
    pub(super) fn light<L: Lanes>(&self, lanes: L, buffers: &mut Buffers, counts: &mut RayCounts) {
        let Buffers { met, suspects, ends, .. } = buffers;
        let zero = lanes.splat(0.0);
        met.groups.clear();
        let mut parts = 0;
        while parts < met.parts.len() {
            let (shape, mut range) = met.parts[parts].clone();
            let first = parts;
            parts += 1;
            if shape.is_none() {
                continue;
            }
            while let Some((Some(_), next)) = met.parts.get(parts)
                && range.len() < LEAST_GROUP
            {
                range.end = next.end;
                parts += 1;
            }
            let around = Around::new(lanes, &met.points, range.clone());
            met.groups.push(Group { parts: first..parts, around });
            suspects.clear();
            ends.clear();
            if self.culling.shadow_candidates {
                for light in &self.lights.all {
                    around.suspects(lanes, &self.world, light, suspects);
                    ends.push(suspects.len());
                }
            }
            for i in range.clone().step_by(L::WIDTH) {
                let p = met.points.load(lanes, i);
                let n = met.normals.load(lanes, i);
                let valid = lanes.first(range.end - i);
                let matters = load(lanes, &met.wants, i).gt(zero) & valid;
                let wants = if self.culling.full_mirrors { matters } else { valid };
                let mirrors = load(lanes, &met.mirrors, i).gt(zero) & valid;
                let some_mirror = mirrors.any();
                let (mut lit, mut gleam) = (zero, zero);
                let mut begin = 0;
                for (k, light) in self.lights.all.iter().enumerate() {
                    let spheres = if let Some(end) = ends.get(k) {
                        let list = &suspects[begin..*end];
                        begin = *end;
                        list
                    } else {
                        &self.world.everything().spheres
                    };
                    let planes = light.planes(&self.world, around.largest);
                    let list = Suspects { spheres, planes };
                    let ways = light.ways_from(lanes, &p);
                    let along = vectors::dot(&ways.vectors, &n);
                    let in_front = along.ge(zero) & wants;
                    let mut glows = lanes.mask(0);
                    let mut along_mirrored = zero;
                    if some_mirror {
                        along_mirrored = vectors::dot(&ways.vectors, &met.mirrored.load(lanes, i));
                        glows = light.glows(lanes, along_mirrored, ways.lengths_squared) & mirrors;
                    }
                    counts.shadow += u64::from(((in_front & matters) | glows).bits().count_ones());
                    let asked = in_front | glows;
                    if !asked.any() {
                        continue;
                    }
                    let hidden = light.hidden(lanes, &self.world, &ways, list, asked.bits());
                    let reached = in_front & !hidden;
                    if reached.any() {
                        lit = reached.select(light.lit(lanes, along, &ways, lit), lit);
                    }
                    let hidden = if self.culling.shared_glow {
                        hidden
                    } else {
                        light.hidden(lanes, &self.world, &ways, list, glows.bits())
                    };
                    let glows = glows & !hidden;
                    if glows.any() {
                        let squared = ways.lengths_squared;
                        gleam = light.add_glow(lanes, along_mirrored, squared, glows, gleam);
                    }
                }
                store(lanes, &mut met.lit, i, lit);
                store(lanes, &mut met.gleam, i, gleam);
            }
        }
    }

    /// The surfaces' own colours and the glow on the way to them.
    #[inline(always)]
    pub(super) fn colour(&self, buffers: &mut Buffers, depth: usize) {
        let Buffers { met, levels, .. } = buffers;
        let level = &mut levels[depth];
        for (shape, range) in &met.parts {
            let range = range.clone();
            let glow = &met.glow[range.clone()];
            let Some(shape) = *shape else {
                for colour in &mut level.colour {
                    for (colour, glow) in colour[range.clone()].iter_mut().zip(glow) {
                        *colour = *glow as f32;
                    }
                }
                continue;
            };
            let look = &self.world.looks[shape];
            level.gloss[range.clone()].fill(look.gloss);
            let lit = &met.lit[range.clone()];
            for (k, colour) in level.colour.iter_mut().enumerate() {
                let colour = &mut colour[range.clone()];
                let first = look.colour[k];
                match look.second {
                    None => {
                        for ((colour, lit), glow) in colour.iter_mut().zip(lit).zip(glow) {
                            *colour = first * *lit as f32 + *glow as f32;
                        }
                    }
                    Some(second) => {
                        let shows = &met.second[range.clone()];
                        let each = colour.iter_mut().zip(lit).zip(glow).zip(shows);
                        for (((colour, lit), glow), shows) in each {
                            let own = if *shows > 0.0 { second[k] } else { first };
                            *colour = own * *lit as f32 + *glow as f32;
                        }
                    }
                }
            }
        }
    }

    /// The rays that leave mirrors.
    #[inline(always)]
    pub(super) fn leave<L: Lanes>(&self, lanes: L, buffers: &mut Buffers) {
        let Buffers { rays, met, numbers, .. } = buffers;
        rays.count = 0;
        rays.bundles.clear();
        for group in &met.groups {
            let begin = rays.count;
            for (shape, range) in &met.parts[group.parts.clone()] {
                let gloss = shape.map_or(0.0, |shape| self.world.looks[shape].gloss);
                if gloss == 0.0 {
                    continue;
                }
                let start = rays.count;
                for i in range.clone().step_by(L::WIDTH) {
                    let mirrors = load(lanes, &met.mirrors, i).gt(lanes.splat(0.0));
                    let mask = mirrors & lanes.first(range.end - i);
                    let count = rays.count;
                    rays.origins.pack(lanes, count, &met.points.load(lanes, i), mask);
                    rays.directions.pack(lanes, count, &met.mirrored.load(lanes, i), mask);
                    pack(lanes, &mut rays.glow, count, load(lanes, &met.gleam, i), mask);
                    pack(lanes, &mut rays.share, count, load(lanes, &met.share, i), mask);
                    rays.count +=
                        pack(lanes, &mut rays.parent, count, load(lanes, numbers, i), mask);
                }
                for share in &mut rays.share[start..rays.count] {
                    *share = f64::from(*share as f32 * gloss);
                }
            }
            if rays.count > begin {
                let (range, around) = (begin..rays.count, group.around);
                rays.bundles.push(Bundle { range, around, cone: None });
            }
        }
        in_codes(&mut rays.glow[..rays.count]);
    }
}
