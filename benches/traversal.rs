//! Building over meshes and spheres, and following rays of each class through
//! them.
#![forbid(unsafe_code)]

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use fastrand::Rng;
use lancer_kernel::{Prepared, Which};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::Scene;
use lancer_tests::generated;

const TRIANGLES: usize = 100_000;
const SPHERES: usize = 100_000;

fn main() {
    divan::main();
}

fn terrain() -> Scene {
    generated::of_mesh(generated::terrain(TRIANGLES)).expect("it is valid")
}

/// Rays of a picture of 100x100 pixels from above a corner.
fn primary() -> Vec<Ray> {
    let eye = Point::new(-1.6, -1.6, 1.4);
    let places = (0..100).flat_map(|j| (0..100).map(move |i| (i, j)));
    let target =
        |(i, j): (u32, u32)| Point::new(f64::from(i) / 50.0 - 1.0, f64::from(j) / 50.0 - 1.0, 0.0);
    places.map(|place| Ray::new(eye, (target(place) - eye).normalize())).collect()
}

/// Rays from where the primary ones arrive, to anywhere above, shuffled.
fn bounces(prepared: &Prepared) -> Vec<Ray> {
    let mut rng = Rng::with_seed(1);
    let met =
        primary().into_iter().filter_map(|ray| Some((ray, prepared.nearest(&ray, f64::INFINITY)?)));
    let mut rays: Vec<Ray> = met
        .map(|(ray, hit)| {
            let v = Vector::from_fn(|_, _| 2.0 * rng.f64() - 1.0);
            let surface = prepared.expand(&ray, &hit);
            let normal = if surface.normal.z < 0.0 { -surface.normal } else { surface.normal };
            surface.leave((normal * 1.8 + v).normalize())
        })
        .collect();
    rng.shuffle(&mut rays);
    rays
}

fn nearest(bencher: Bencher<'_, '_>, prepared: &Prepared, rays: &[Ray]) {
    bencher
        .counter(ItemsCount::new(rays.len()))
        .bench(|| rays.iter().filter(|ray| prepared.nearest(ray, f64::INFINITY).is_some()).count());
}

#[divan::bench]
fn primary_rays(bencher: Bencher<'_, '_>) {
    nearest(bencher, &Prepared::new(&terrain()), &primary());
}

#[divan::bench]
fn bounce_rays(bencher: Bencher<'_, '_>) {
    let prepared = Prepared::new(&terrain());
    nearest(bencher, &prepared, &bounces(&prepared));
}

#[divan::bench]
fn shadow_rays(bencher: Bencher<'_, '_>) {
    let prepared = Prepared::new(&terrain());
    let lamp = Point::new(2.0, -1.0, 0.8);
    let to_lamp = |ray: Ray| Ray::new(ray.origin, lamp - ray.origin);
    let rays: Vec<Ray> = bounces(&prepared).into_iter().map(to_lamp).collect();
    bencher
        .counter(ItemsCount::new(rays.len()))
        .bench(|| rays.iter().filter(|ray| prepared.any(ray, 1.0, Which::All)).count());
}

#[divan::bench(args = [16, 64, 65, 128, SPHERES])]
fn rays_among_spheres(bencher: Bencher<'_, '_>, spheres: usize) {
    let scene = generated::spheres(spheres).expect("they are valid");
    nearest(bencher, &Prepared::new(&scene), &primary());
}

#[divan::bench(sample_count = 10)]
fn build_triangles(bencher: Bencher<'_, '_>) {
    let scene = terrain();
    bencher.counter(ItemsCount::new(TRIANGLES)).bench(|| Prepared::new(black_box(&scene)));
}

#[divan::bench(sample_count = 10)]
fn build_spheres(bencher: Bencher<'_, '_>) {
    let scene = generated::spheres(SPHERES).expect("they are valid");
    bencher.counter(ItemsCount::new(SPHERES)).bench(|| Prepared::new(black_box(&scene)));
}
