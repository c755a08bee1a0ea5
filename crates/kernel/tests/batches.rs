//! Batches of rays against the same rays one by one, and what scenes of many shapes
//! take.

use fastrand::Rng;
use lancer_kernel::lanes::Width;
use lancer_kernel::{Culling, Hit, KernelSettings, Prepared, Which};
use lancer_math::{Placement, Point, Ray, Vector};
use lancer_scene::{Camera, Colour, Group, Mesh, Placed, Scene, SceneBuilder, Shape, Surface};
use std::sync::Arc;
use std::time::Instant;

fn builder() -> SceneBuilder {
    Scene::builder().camera(Camera::new([0.0; 3], [1.0, 0.0, 0.0], 1.0, [1, 1]))
}

/// Spheres in a cube of as many units, every third of glass, over a plane.
fn spheres(count: u32) -> Scene {
    let mut rng = Rng::with_seed(1);
    let side = libm::cbrt(f64::from(count));
    let glass = Surface::glass(1.5).expect("in range");
    let mut builder = builder();
    for i in 0..count {
        let centre = std::array::from_fn(|_| side * rng.f64());
        let surface = if i % 3 == 0 { glass } else { Surface::new(Colour::GREY) };
        builder = builder.shape(Shape::sphere(centre, 0.1 + 0.3 * rng.f64(), surface));
    }
    builder.shape(Shape::plane([0.0; 3], [0.0, 0.0, 1.0], glass)).build().expect("valid")
}

fn rays(count: u32, side: f64, seed: u64) -> Vec<Ray> {
    let mut rng = Rng::with_seed(seed);
    let mut point = || Point::from(Vector::from_fn(|_, _| side * (1.2 * rng.f64() - 0.1)));
    let ray = |_| {
        let origin = point();
        Ray::new(origin, point() - origin)
    };
    (0..count).map(ray).collect()
}

#[test]
fn a_batch_is_answered_as_its_rays_are() {
    for count in [0, 1, 8, 17, 400, 20_000] {
        let scene = spheres(count);
        let mut first: Option<Vec<Option<Hit>>> = None;
        for (width, culling) in Width::available()
            .into_iter()
            .flat_map(|width| [Culling::ALL, Culling::NONE].map(|culling| (width, culling)))
        {
            let prepared = Prepared::with(&scene, &KernelSettings { lanes: width, culling });
            let rays = rays(3000, libm::cbrt(f64::from(count)), 7);
            let mut hits = vec![None; rays.len()];
            prepared.nearest_each(&rays, f64::INFINITY, &mut hits);
            for (ray, hit) in rays.iter().zip(&hits) {
                assert_eq!(prepared.nearest(ray, f64::INFINITY), *hit, "{count}, {ray:?}");
            }
            for which in [Which::All, Which::Opaque, Which::Transparent] {
                let mut answers = vec![false; rays.len()];
                prepared.any_each(&rays, 1.0, which, &mut answers);
                for (ray, answer) in rays.iter().zip(&answers) {
                    assert_eq!(prepared.any(ray, 1.0, which), *answer, "{count}, {ray:?}");
                    let all = prepared.all(ray, (0.0, 1.0), which);
                    assert_eq!(*answer, !all.is_empty(), "{count}, {ray:?}");
                }
            }
            match &first {
                Some(first) => assert_eq!(&hits, first, "{count}, {}", width.name()),
                None => first = Some(hits),
            }
        }
        let met = first.into_iter().flatten().flatten().count();
        assert!(count < 400 || met > 2000, "{met} hits among {count}");
    }
}

#[test]
fn any_number_of_threads_prepares_the_same() {
    let scene = spheres(30_000);
    let rays = rays(2000, 31.0, 3);
    let answers = [1, 2, 3, 7].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let prepared = pool.install(|| Prepared::new(&scene));
        let mut hits = vec![None; rays.len()];
        prepared.nearest_each(&rays, f64::INFINITY, &mut hits);
        (prepared.bytes(), hits)
    });
    assert!(answers.iter().all(|answer| *answer == answers[0]));
}

#[test]
fn memory_for_spheres_is_flat() {
    for count in [1000, 10_000, 100_000] {
        let each = Prepared::new(&spheres(count)).bytes() as f64 / f64::from(count);
        assert!((48.0..80.0).contains(&each), "{each} bytes for each of {count} spheres");
    }
}

/// A strip of so many triangles.
fn strip(triangles: u32) -> Mesh {
    let corner = |i: u32| [f64::from(i), f64::from(i % 2), f64::from(i % 3) * 0.1];
    let positions = (0..triangles + 2).map(corner).collect();
    Mesh::new(positions, (0..triangles).map(|i| [i, i + 1, i + 2]).collect()).expect("valid")
}

fn grid(inside: &Arc<Group>, size: f64) -> Group {
    let place = |i: u32| {
        let [x, y, z] = [i % 10, i / 10 % 10, i / 100].map(|k| size * f64::from(k));
        let turned = Placement::rotate(Vector::new(0.1, 0.2, 1.0), f64::from(i)).expect("an axis");
        turned.then(&Placement::translate(Vector::new(x, y, z)))
    };
    let placed = (0..1000).map(|i| Placed { placement: place(i), group: Arc::clone(inside) });
    Group::new(None, Vec::new(), placed.collect()).expect("few enough")
}

/// A mesh of 1,000 triangles in 1,000 places, and all that in 1,000 places: a
/// thousand million triangles.
#[test]
fn what_is_shown_many_times_is_kept_once() {
    let mesh = Shape::mesh(Arc::new(strip(1000)), Surface::new(Colour::GREY)).expect("valid");
    let one = Arc::new(Group::new(None, vec![mesh], Vec::new()).expect("few enough"));
    let many = Arc::new(grid(&one, 500.0));
    let scene = builder().group(Placement::IDENTITY, grid(&many, 6000.0)).build().expect("valid");
    assert_eq!(scene.shape_count(), 1_000_000);
    let begun = Instant::now();
    let prepared = Prepared::new(&scene);
    let took = begun.elapsed();
    assert!(prepared.bytes() < 2_000_000, "{} bytes", prepared.bytes());
    assert!(took.as_secs() < 10, "{took:?}");
    let rays = rays(5000, 60_000.0, 11);
    let mut hits = vec![None; rays.len()];
    prepared.nearest_each(&rays, f64::INFINITY, &mut hits);
    let met: Vec<(&Ray, Hit)> =
        rays.iter().zip(&hits).filter_map(|(ray, hit)| hit.map(|hit| (ray, hit))).collect();
    assert!(met.len() > 100, "{}", met.len());
    for (ray, hit) in met {
        let found = prepared.expand(ray, &hit);
        assert!((found.point - ray.at(hit.t)).norm() < 1e-6);
        assert!(hit.item < 1_000_000 && found.shape == 0);
    }
}
