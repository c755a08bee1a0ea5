//! Rays to measure with, and how they are asked about. Their coordinates are
//! numbers of single precision, so that other programs can have the same ones.

use fastrand::Rng;
use lancer_kernel::{Hit, Prepared, Which};
use lancer_math::{Bounds, Point, Ray, Vector, unit};

/// Where rays from an eye go.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    pub(super) eye: Point,
    pub(super) target: Point,
    pub(super) up: Vector,
    /// How wide the picture is at distance 1.
    pub(super) width: f64,
}

impl View {
    /// From outside, at a distance from which all that the bounds hold fills
    /// the picture.
    pub(super) fn outside(bounds: &Bounds, from: Vector, up: Vector) -> Self {
        let target = lancer_math::Point::from((bounds.min.coords + bounds.max.coords) / 2.0);
        let diagonal = (bounds.max - bounds.min).norm();
        let from = unit(from).unwrap_or_else(Vector::x);
        Self { eye: target + from * (1.5 * diagonal), target, up, width: 0.6 }
    }

    /// The rays of a picture, row by row.
    pub(super) fn rays(&self, [width, height]: [u32; 2]) -> Vec<Ray> {
        let forward = unit(self.target - self.eye).unwrap_or_else(Vector::x);
        let right = unit(forward.cross(&self.up)).unwrap_or_else(Vector::y);
        let up = right.cross(&forward);
        let pixel = self.width / f64::from(width);
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let direction = |(x, y): (u32, u32)| {
            let across = (f64::from(x) + 0.5 - f64::from(width) / 2.0) * pixel;
            let upward = (f64::from(height) / 2.0 - f64::from(y) - 0.5) * pixel;
            unit(forward + right * across + up * upward).unwrap_or(forward)
        };
        places.map(|place| single(self.eye, direction(place))).collect()
    }
}

/// A ray from each point that one of `rays` meets, in a direction that is likelier
/// the nearer it is to the normal, as a matte surface scatters light; `lift`
/// off the surface, in no order.
pub(super) fn bounces(prepared: &Prepared, rays: &[Ray], lift: f64) -> Vec<Ray> {
    let mut rng = Rng::with_seed(2);
    let mut hits = vec![None; rays.len()];
    nearest(prepared, rays, &mut hits);
    let met = rays.iter().zip(&hits).filter_map(|(ray, hit)| Some((ray, hit.as_ref()?)));
    let mut bounces: Vec<Ray> = met
        .map(|(ray, hit)| {
            let surface = prepared.expand(ray, hit);
            let facing = ray.direction.dot(&surface.normal) < 0.0;
            let normal = if facing { surface.normal } else { -surface.normal };
            single(surface.point + normal * lift, scattered(&mut rng, normal))
        })
        .collect();
    rng.shuffle(&mut bounces);
    bounces
}

/// From the point on the disc below it (Malley's method; pbr-book, 4th
/// edition, A.5.3).
fn scattered(rng: &mut Rng, normal: Vector) -> Vector {
    let (x, y) = loop {
        let (x, y) = (2.0 * rng.f64() - 1.0, 2.0 * rng.f64() - 1.0);
        if x * x + y * y < 1.0 {
            break (x, y);
        }
    };
    let other = if normal.x.abs() < 0.6 { Vector::x() } else { Vector::y() };
    let first = unit(normal.cross(&other)).unwrap_or(other);
    let second = normal.cross(&first);
    first * x + second * y + normal * (1.0 - x * x - y * y).sqrt()
}

/// Rays from anywhere in a box to anywhere.
pub(super) fn random(bounds: &Bounds, count: usize) -> Vec<Ray> {
    let mut rng = Rng::with_seed(3);
    let ray = |_| {
        let size = bounds.max - bounds.min;
        let part = Vector::new(rng.f64(), rng.f64(), rng.f64());
        let direction = loop {
            let v = Vector::from_fn(|_, _| 2.0 * rng.f64() - 1.0);
            if v.norm_squared() < 1.0 {
                break unit(v).unwrap_or_else(Vector::x);
            }
        };
        single(bounds.min + size.component_mul(&part), direction)
    };
    (0..count).map(ray).collect()
}

/// With numbers of single precision.
fn single(origin: Point, direction: Vector) -> Ray {
    Ray::new(origin.map(|c| f64::from(c as f32)), direction.map(|c| f64::from(c as f32)))
}

/// The nearest hit of each ray.
pub(super) fn nearest(prepared: &Prepared, rays: &[Ray], hits: &mut [Option<Hit>]) {
    prepared.nearest_each(rays, f64::INFINITY, hits);
}

/// Whether each ray meets something.
pub(super) fn any(prepared: &Prepared, rays: &[Ray], answers: &mut [bool]) {
    prepared.any_each(rays, f64::INFINITY, Which::All, answers);
}

/// The nearest hits, found by so many threads.
pub(super) fn nearest_on(
    threads: usize,
    prepared: &Prepared,
    rays: &[Ray],
    hits: &mut [Option<Hit>],
) {
    let share = rays.len().div_ceil(threads).max(1);
    std::thread::scope(|scope| {
        for (rays, hits) in rays.chunks(share).zip(hits.chunks_mut(share)) {
            scope.spawn(move || nearest(prepared, rays, hits));
        }
    });
}
