//! The nearest hit of one shape of each kind.
#![forbid(unsafe_code)]

use divan::Bencher;
use divan::counter::ItemsCount;
use fastrand::Rng;
use lancer_kernel::lanes::Width;
use lancer_kernel::{KernelSettings, Prepared};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{Camera, Colour, InvalidField, Mesh, Scene, Shape, Surface};
use std::sync::Arc;

const RAYS: usize = 1000;

/// How a shape that fits into a ball of radius 1 is made.
type Make = fn(Surface) -> Result<Shape, InvalidField>;

const UP: [f64; 3] = [0.0, 0.0, 1.0];
const CORNERS: [[f64; 3]; 4] =
    [[-0.8, -0.5, -0.3], [0.8, -0.5, -0.3], [0.0, 0.9, -0.3], [0.0, 0.0, 0.9]];

const SHAPES: [(&str, Make); 12] = [
    ("sphere", |s| Shape::sphere([0.0; 3], 0.9, s)),
    ("plane", |s| Shape::plane([0.0; 3], UP, s)),
    ("disc", |s| Shape::disc([0.0; 3], UP, 0.9, s)),
    ("rectangle", |s| Shape::rectangle([-0.7, -0.7, 0.0], [[1.4, 0.0, 0.0], [0.0, 1.4, 0.0]], s)),
    ("triangle", |s| Shape::triangle([CORNERS[0], CORNERS[1], CORNERS[2]], s)),
    ("box", |s| Shape::cube([0.0; 3], 1.1, s)),
    ("tetrahedron", |s| Shape::tetrahedron(CORNERS, s)),
    ("cylinder", |s| Shape::cylinder([0.0, 0.0, -0.7], [0.0, 0.0, 0.7], 0.7, s)),
    ("cone", |s| Shape::cone([0.0, 0.0, -0.7], [0.0, 0.0, 0.9], 0.7, s)),
    ("frustum", |s| Shape::frustum(([0.0, 0.0, -0.7], 0.7), ([0.0, 0.0, 0.7], 0.3), s)),
    ("torus", |s| Shape::torus([0.0; 3], UP, [0.6, 0.3], s)),
    ("mesh", |s| {
        let faces = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        Shape::mesh(Arc::new(Mesh::new(CORNERS.to_vec(), faces).expect("it has areas")), s)
    }),
];

fn main() {
    divan::main();
}

#[divan::bench(args = SHAPES.iter().map(|(name, _)| *name))]
fn nearest(bencher: Bencher<'_, '_>, name: &str) {
    shape(bencher, name, &KernelSettings::default());
}

/// Shapes that are met in lanes, with lanes of each width.
#[divan::bench(args = by_lanes())]
fn nearest_by_lanes(bencher: Bencher<'_, '_>, case: &str) {
    let (name, lanes) = case.split_once(' ').expect("two words");
    let lanes = Width::by_name(lanes).expect("the processor has them");
    shape(bencher, name, &KernelSettings { lanes, ..KernelSettings::default() });
}

fn by_lanes() -> impl Iterator<Item = String> {
    ["sphere", "plane", "mesh"].into_iter().flat_map(|name| {
        Width::available().into_iter().map(move |lanes| format!("{name} {}", lanes.name()))
    })
}

fn shape(bencher: Bencher<'_, '_>, name: &str, settings: &KernelSettings) {
    let (_, make) = SHAPES.iter().find(|(other, _)| *other == name).expect("it is listed");
    let scene = Scene::builder()
        .camera(Camera::new([0.0, -4.0, 0.0], [0.0; 3], 1.0, [4, 3]))
        .shape(make(Surface::new(Colour::GREY)))
        .build()
        .expect("it is valid");
    let prepared = Prepared::with(&scene, settings);
    let rays = rays();
    let mut hits = vec![None; RAYS];
    bencher.counter(ItemsCount::new(RAYS)).bench_local(|| {
        prepared.nearest_each(&rays, f64::INFINITY, &mut hits);
        hits.iter().flatten().map(|hit| hit.t).sum::<f64>()
    });
}

/// From a sphere of radius 3 to points of the ball of radius 1.
fn rays() -> Vec<Ray> {
    let mut rng = Rng::with_seed(1);
    let mut inside = move || loop {
        let v = Vector::from_fn(|_, _| 2.0 * rng.f64() - 1.0);
        if v.norm_squared() <= 1.0 {
            break v;
        }
    };
    let mut ray = || {
        let origin = Point::from(inside().normalize() * 3.0);
        Ray::new(origin, (Point::from(inside()) - origin).normalize())
    };
    (0..RAYS).map(|_| ray()).collect()
}
