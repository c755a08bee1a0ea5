//! A tile of pixels on its way through the stages: rays from the eye, what they
//! meet, what is to be seen there, which lights reach it, the mirrored rays, and
//! so on; in the end the colours are folded, deepest mirrors first.

use super::bundle::{Around, Cone, valid};
use super::camera::PinholeCamera;
use super::lights::{Beacon, Lights, Suspects};
use super::rows::{BATCH, Row, Triples, ZEROS, load, pack, store};
use super::vectors::Vectors;
use super::world::{Candidates, World, custom_normal};
use crate::{RayCounts, Rgb};
use lancer_film::Window;
use lancer_kernel::Culling;
use lancer_kernel::lanes::{Lanes, MOST, Mask, One, Real, Work, lanes_of};
use lancer_math::Vector;
use std::cell::Cell;
use std::ops::Range;

/// A mirror whose share of the pixel is smaller is shown matte.
const LEAST_SHARE: f64 = 0.01;

/// How many mirrors a ray is followed through.
const MOST_MIRRORS: usize = 4;

/// So many rays at least share lists of candidates, if there are as many.
const LEAST_BUNDLE: usize = 64;

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

/// Rays that are to be followed.
struct Rays {
    count: usize,
    origins: Triples,
    directions: Triples,
    /// 255 times how brightly lights glow along them.
    glow: Row,
    /// Their shares of the pixel.
    share: Row,
    /// The places of the surfaces that they leave in the level above; of rays from
    /// the eye those of the pixels in the tile.
    parent: Row,
    bundles: Vec<Bundle>,
}

/// Rays that have something in common.
struct Bundle {
    range: Range<usize>,
    /// They begin in this ball.
    around: Around,
    /// They go along this cone, where that is known.
    cone: Option<Cone>,
}

/// Points whose light is gathered together.
struct Group {
    /// The shapes that they are of, by place in the list of parts.
    parts: Range<usize>,
    around: Around,
}

/// What they meet, sorted by shape.
struct Met {
    distance: Row,
    index: Row,
    /// Shapes, none where nothing is met, and the ranges of their points.
    parts: Vec<(Option<usize>, Range<usize>)>,
    groups: Vec<Group>,
    points: Triples,
    directions: Triples,
    normals: Triples,
    mirrored: Triples,
    glow: Row,
    share: Row,
    /// 1 where the second colour shows, where there is a mirror, and where its own
    /// colour matters; else 0.
    second: Row,
    mirrors: Row,
    wants: Row,
    /// The light that surfaces get, and that along the mirrored rays.
    lit: Row,
    gleam: Row,
}

/// The colours of some surfaces, and what the mirrors among them need.
struct Level {
    count: usize,
    colour: [[f32; BATCH + MOST]; 3],
    gloss: [f32; BATCH + MOST],
    parent: Row,
}

/// All that a tile needs, used again for the next one.
pub(super) struct Buffers {
    rays: Rays,
    met: Met,
    levels: [Level; MOST_MIRRORS + 1],
    candidates: Candidates,
    /// Spheres that may hide lights, and for each light the end of its list.
    suspects: Vec<u32>,
    ends: Vec<usize>,
    /// 0, 1, 2 and so on.
    numbers: Row,
}

impl Buffers {
    fn new() -> Box<Self> {
        const LEVEL: Level = Level {
            count: 0,
            colour: [[0.0; BATCH + MOST]; 3],
            gloss: [0.0; BATCH + MOST],
            parent: ZEROS,
        };
        Box::new(Self {
            rays: Rays {
                count: 0,
                origins: Triples::ZEROS,
                directions: Triples::ZEROS,
                glow: ZEROS,
                share: ZEROS,
                parent: ZEROS,
                bundles: Vec::new(),
            },
            met: Met {
                distance: ZEROS,
                index: ZEROS,
                parts: Vec::new(),
                groups: Vec::new(),
                points: Triples::ZEROS,
                directions: Triples::ZEROS,
                normals: Triples::ZEROS,
                mirrored: Triples::ZEROS,
                glow: ZEROS,
                share: ZEROS,
                second: ZEROS,
                mirrors: ZEROS,
                wants: ZEROS,
                lit: ZEROS,
                gleam: ZEROS,
            },
            levels: [LEVEL; MOST_MIRRORS + 1],
            candidates: Candidates::default(),
            suspects: Vec::new(),
            ends: Vec::new(),
            numbers: std::array::from_fn(|k| k as f64),
        })
    }
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
                let along = rays.directions.load(lanes, i).dot(&way);
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
                let asked = valid::<L>(i, range.end);
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
            *rest = valid::<L>(r * L::WIDTH, rays.count) as u8;
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
            for r in first..registers {
                let i = r * L::WIDTH;
                let same = load(lanes, &met.index, i).eq(lanes.splat(index)).bits();
                let bits = same & u32::from(rest[r]);
                if bits == 0 {
                    continue;
                }
                rest[r] &= !(bits as u8);
                let mask = lanes.mask(bits);
                let directions = rays.directions.load(lanes, i);
                let distance = load(lanes, &met.distance, i);
                let points = rays.origins.load(lanes, i).after(distance, &directions);
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

    /// Normals, cells of checkers, and mirrored directions.
    #[inline(always)]
    fn shade<L: Lanes>(&self, lanes: L, buffers: &mut Buffers, depth: usize) {
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
                        second = super::checker::on_sphere(lanes, &n);
                    }
                    n
                } else {
                    let (mut x, mut y, mut z) = ([0.0; MOST], [0.0; MOST], [0.0; MOST]);
                    let mut bits = 0;
                    let d = directions.load(lanes, i);
                    for k in lanes_of(valid::<L>(i, range.end)) {
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
                    let m = directions.load(lanes, i).mirrored(&n);
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
    fn light<L: Lanes>(&self, lanes: L, buffers: &mut Buffers, counts: &mut RayCounts) {
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
                && range.len() < LEAST_BUNDLE
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
                let valid = lanes.mask(valid::<L>(i, range.end));
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
                    let along = ways.vectors.dot(&n);
                    let in_front = along.ge(zero) & wants;
                    let mut glows = lanes.mask(0);
                    let mut along_mirrored = zero;
                    if some_mirror {
                        along_mirrored = ways.vectors.dot(&met.mirrored.load(lanes, i));
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
    fn colour(&self, buffers: &mut Buffers, depth: usize) {
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
    fn leave<L: Lanes>(&self, lanes: L, buffers: &mut Buffers) {
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
                    let mask = mirrors & lanes.mask(valid::<L>(i, range.end));
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

/// Sums of light in codes of an 8-bit picture, in single precision.
#[inline(always)]
fn in_codes(sums: &mut [f64]) {
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
