//! Closed meshes from inside: no ray may come out between their triangles.

use super::id::mix;
use super::sample::{any_direction, between, power_of_ten};
use fastrand::Rng;
use lancer_kernel::lanes::Width;
use lancer_kernel::{Culling, Hit, KernelSettings, Prepared, Which};
use lancer_math::{Placement, Point, Ray, Vector};
use lancer_scene::{Camera, Colour, Mesh, Scene, Shape, Surface};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::fmt::Write;
use std::sync::Arc;

/// So many rays begin at each point inside.
const RAYS: u64 = 4096;

/// So many points are inside of each copy of a mesh: copies are turned and moved.
const POINTS: u64 = 16;

/// What was seen of one mesh.
#[derive(Debug, Default, Clone)]
pub struct Leaks {
    /// How many rays were asked.
    pub rays: u64,
    /// How many of them met nothing.
    pub leaks: u64,
    /// How many had other answers on some path.
    pub disagreements: u64,
    /// The first few of both.
    pub told: Vec<String>,
}

impl Leaks {
    fn and(mut self, other: Self) -> Self {
        self.rays += other.rays;
        self.leaks += other.leaks;
        self.disagreements += other.disagreements;
        let room = 5_usize.saturating_sub(self.told.len());
        self.told.extend(other.told.into_iter().take(room));
        self
    }
}

/// Sends so many rays from inside a closed mesh to its vertices, its edges and anywhere,
/// as often each, in batches with every number of lanes.
#[must_use]
pub fn leaks(mesh: &Mesh, seed: u64, rays: u64) -> Leaks {
    let of_copy = RAYS * POINTS;
    let copies = (0..rays.div_ceil(of_copy)).into_par_iter();
    let of = |copy: u64| Copied::new(mesh, mix(seed ^ mix(copy)), copy > 0);
    copies
        .map(|copy| of(copy).ask(mix(seed ^ mix(copy)), of_copy.min(rays - copy * of_copy)))
        .reduce(Leaks::default, Leaks::and)
}

/// The mesh, turned and moved, and prepared in all ways.
struct Copied {
    mesh: Arc<Mesh>,
    ways: Vec<(String, Prepared)>,
}

impl Copied {
    fn new(mesh: &Mesh, seed: u64, is_moved: bool) -> Self {
        let mut rng = Rng::with_seed(seed);
        let placement = if is_moved { moved(mesh, &mut rng) } else { Placement::IDENTITY };
        // Half of them with numbers that are singles.
        let is_single = rng.bool();
        let corner = |p: Point| {
            let p = placement.point(&p);
            [p.x, p.y, p.z].map(|c| if is_single { f64::from(c as f32) } else { c })
        };
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        let mut known = std::collections::BTreeMap::new();
        for triangle in 0..mesh.triangle_count() {
            triangles.push(mesh.corners(triangle).map(|p| {
                *known.entry([p.x, p.y, p.z].map(f64::to_bits)).or_insert_with(|| {
                    positions.push(corner(p));
                    positions.len() as u32 - 1
                })
            }));
        }
        let mesh = Arc::new(Mesh::new(positions, triangles).expect("a mesh"));
        let shape = Shape::mesh(Arc::clone(&mesh), Surface::new(Colour::GREY));
        let camera = Camera::new([0.0; 3], [0.0, 1.0, 0.0], 1.0, [4, 3]);
        let scene = Scene::builder().camera(camera).shape(shape).build().expect("a scene");
        let way = |lanes: Width, culling| {
            let prepared = Prepared::with(&scene, &KernelSettings { lanes, culling });
            (lanes.name().to_owned(), prepared)
        };
        let mut ways: Vec<_> =
            Width::available().into_iter().rev().map(|lanes| way(lanes, Culling::ALL)).collect();
        ways.push(("no shortcuts".to_owned(), way(Width::best(), Culling::NONE).1));
        Self { mesh, ways }
    }

    fn ask(&self, seed: u64, rays: u64) -> Leaks {
        let blocks = 0..rays.div_ceil(RAYS);
        let block = |block: u64| {
            let count = RAYS.min(rays - block * RAYS);
            self.block(mix(seed ^ mix(block)), count)
        };
        blocks.map(block).fold(Leaks::default(), Leaks::and)
    }

    /// Rays that begin at one point.
    fn block(&self, seed: u64, count: u64) -> Leaks {
        let rng = &mut Rng::with_seed(seed);
        let from = inside(&self.mesh, rng);
        let rays: Vec<Ray> = (0..count).map(|k| self.ray(from, k, rng)).collect();
        let mut seen = Leaks { rays: count, ..Leaks::default() };
        let mut first: Vec<Option<Hit>> = Vec::new();
        let mut hits = vec![None; rays.len()];
        let mut any = vec![false; rays.len()];
        for (name, prepared) in &self.ways {
            prepared.nearest_each(&rays, f64::INFINITY, &mut hits);
            prepared.any_each(&rays, f64::INFINITY, Which::All, &mut any);
            if first.is_empty() {
                first.clone_from(&hits);
            }
            for ((ray, hit), (expected, any)) in rays.iter().zip(&hits).zip(first.iter().zip(&any))
            {
                seen.hold(name, ray, hit.as_ref(), expected.as_ref(), *any);
            }
        }
        for (ray, hit) in rays.iter().zip(&first) {
            if hit.is_some_and(|hit| slips_through(&self.ways[0].1, ray, &hit)) {
                seen.leaked("it enters what it is in", ray, hit.as_ref());
            }
        }
        // One by one, with the most lanes.
        let (_, prepared) = &self.ways[0];
        for (ray, expected) in rays.iter().zip(&first) {
            let hit = prepared.nearest(ray, f64::INFINITY);
            let any = prepared.any(ray, f64::INFINITY, Which::All);
            seen.hold("one by one", ray, hit.as_ref(), expected.as_ref(), any);
        }
        seen
    }

    fn ray(&self, from: Point, number: u64, rng: &mut Rng) -> Ray {
        let corners = self.mesh.corners(rng.usize(..self.mesh.triangle_count()));
        let [a, b] = [corners[0], corners[1]];
        let direction = match number % 6 {
            0 | 1 => a - from,
            2 => a + (b - a) * 0.5 - from,
            3 => a + (b - a) * rng.f64() - from,
            4 => any_direction(rng),
            _ => {
                let (u, v) = (rng.f64(), rng.f64());
                a + (b - a) * u + (corners[2] - a) * (v * (1.0 - u)) - from
            }
        };
        Ray::new(from, direction)
    }
}

impl Leaks {
    fn hold(
        &mut self,
        name: &str,
        ray: &Ray,
        hit: Option<&Hit>,
        expected: Option<&Hit>,
        any: bool,
    ) {
        if hit.is_none() {
            self.leaked(name, ray, hit);
        }
        if hit != expected || any != hit.is_some() {
            self.disagreements += 1;
            self.tell(format!("{name}: {hit:?} ({any}), not {expected:?}:"), ray);
        }
    }

    fn leaked(&mut self, why: &str, ray: &Ray, hit: Option<&Hit>) {
        self.leaks += 1;
        self.tell(format!("{why}: {hit:?}:"), ray);
    }

    fn tell(&mut self, mut what: String, ray: &Ray) {
        if self.told.len() < 5 {
            _ = write!(what, " {:?}", ray.origin.coords.map(f64::to_bits));
            _ = write!(what, " {:?}", ray.direction.map(f64::to_bits));
            self.told.push(what);
        }
    }
}

/// Whether a ray from inside has gone through the surface before that hit: it enters
/// there, and as often as it leaves. Where it leaves and enters at once, the hit
/// may be either.
fn slips_through(prepared: &Prepared, ray: &Ray, hit: &Hit) -> bool {
    prepared.expand(ray, hit).normal.dot(&ray.direction) <= 0.0
        && prepared.all(ray, (0.0, f64::INFINITY), Which::All).len().is_multiple_of(2)
}

/// Turned, stretched a little, and put up to a thousand sizes away.
fn moved(mesh: &Mesh, rng: &mut Rng) -> Placement {
    let (min, max) = mesh.bounds();
    let size = (max - min).norm();
    let turn = Placement::rotate(any_direction(rng), between(rng, 0.0, 360.0)).expect("an axis");
    let factors = Vector::from([(); 3].map(|()| power_of_ten(rng, -0.3, 0.3)));
    let stretch = Placement::scale(factors).expect("not flat");
    let away = any_direction(rng) * (size * power_of_ten(rng, -3.0, 3.0));
    turn.then(&stretch).then(&Placement::translate(away))
}

/// A random point that the mesh goes around.
fn inside(mesh: &Mesh, rng: &mut Rng) -> Point {
    let (min, max) = mesh.bounds();
    loop {
        let share = Vector::from([(); 3].map(|()| rng.f64()));
        let point = min + (max - min).component_mul(&share);
        // On the surface it is a half.
        if turns_around(mesh, point).abs() > 0.9 {
            return point;
        }
    }
}

/// How often the mesh goes around a point: the sum of the solid angles of its
/// triangles (van Oosterom and Strackee, *The solid angle of a plane triangle*,
/// 1983).
fn turns_around(mesh: &Mesh, point: Point) -> f64 {
    let angle = |corners: [Point; 3]| {
        let [a, b, c] = corners.map(|corner| corner - point);
        let [x, y, z] = [a, b, c].map(|v| v.norm());
        let below = x * y * z + a.dot(&b) * z + b.dot(&c) * x + c.dot(&a) * y;
        2.0 * libm::atan2(a.dot(&b.cross(&c)), below)
    };
    (0..mesh.triangle_count()).map(|t| angle(mesh.corners(t))).sum::<f64>() / (4.0 * PI)
}
