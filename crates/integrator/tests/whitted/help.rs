//! What the tests of this folder share.

use lancer_integrator::{
    Engine, Plan, RayCounts, RenderSettings, Rendered, Troubles, Whitted, render,
};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{
    Camera, Colour, CustomShape, InvalidField, Scene, SceneBuilder, Shape, Spectrum, Surface,
};
use std::sync::{Arc, Mutex};

/// Half the last place of a film's single precision, with room for the double
/// precision arithmetic before it.
pub(crate) const FILM: f64 = 1e-7;

/// A camera of one pixel.
pub(crate) fn eye(from: [f64; 3], at: [f64; 3]) -> Result<Camera, InvalidField> {
    Camera::new(from, at, 1.0, [1, 1])
}

/// A camera of one pixel that is so far from `at`, and sees it at so many
/// degrees from the vertical: from above, or from below beyond 90.
pub(crate) fn eye_at(degrees: f64, distance: f64, at: [f64; 3]) -> Result<Camera, InvalidField> {
    let [sine, cosine] = sin_cos(degrees);
    eye([at[0] - distance * sine, at[1], at[2] + distance * cosine], at)
}

/// Independent of the product's own.
pub(crate) fn sin_cos(degrees: f64) -> [f64; 2] {
    let radians = degrees.to_radians();
    [libm::sin(radians), libm::cos(radians)]
}

pub(crate) fn white() -> Surface {
    Surface::new(Colour::WHITE)
}

pub(crate) fn black() -> Surface {
    Surface::new(Colour::BLACK)
}

pub(crate) fn glass(ior: f64) -> Surface {
    Surface::glass(ior).expect("in range")
}

/// Filled with something that bends nothing.
pub(crate) fn smoke(absorption: [f64; 3]) -> Surface {
    glass(1.0).absorption(absorption).expect("in range")
}

/// Black, but shining.
pub(crate) fn shining(radiance: [f64; 3]) -> Surface {
    black().emission(radiance).expect("in range")
}

/// Black between mirroring so much.
pub(crate) fn mirror(gloss: f64) -> Surface {
    black().gloss(gloss).expect("in range")
}

/// A scene with that camera and a grey background.
pub(crate) fn scene(camera: Result<Camera, InvalidField>, background: f64) -> SceneBuilder {
    Scene::builder().camera(camera).background(Spectrum::new([background; 3]))
}

/// An infinite plane at that height; what is below is its inside.
pub(crate) fn floor(height: f64, surface: Surface) -> Result<Shape, InvalidField> {
    Shape::plane([0.0, 0.0, height], [0.0, 0.0, 1.0], surface)
}

/// A horizontal slab that is wide enough for everything.
pub(crate) fn slab(from: f64, to: f64, surface: Surface) -> Result<Shape, InvalidField> {
    Shape::cuboid([-10.0, -10.0, from], [10.0, 10.0, to], surface)
}

pub(crate) fn rendered(builder: SceneBuilder, cutoff: f64) -> Rendered {
    let scene = builder.build().expect("valid");
    let engine = Whitted::with_cutoff(cutoff).expect("in range");
    render(&scene, &engine, &RenderSettings { layers: true, ..RenderSettings::default() })
        .expect("it renders")
}

/// The picture of a scene in which nothing goes wrong.
pub(crate) fn picture(builder: SceneBuilder, cutoff: f64) -> Rendered {
    let rendered = rendered(builder, cutoff);
    assert_eq!(rendered.counts.troubles, Troubles::default());
    rendered
}

/// The only pixel of a picture.
pub(crate) fn pixel_with(builder: SceneBuilder, cutoff: f64) -> [f64; 3] {
    let film = picture(builder, cutoff).film;
    assert_eq!(film.pixels().len(), 1);
    film.pixel(0, 0).map(f64::from)
}

/// The same with the usual cutoff.
pub(crate) fn pixel(builder: SceneBuilder) -> [f64; 3] {
    pixel_with(builder, Whitted::CUTOFF)
}

/// The only pixel of a picture in which all components are alike.
pub(crate) fn grey_with(builder: SceneBuilder, cutoff: f64) -> f64 {
    let [red, green, blue] = pixel_with(builder, cutoff);
    assert!(red == green && green == blue, "({red}, {green}, {blue})");
    red
}

/// The same with the usual cutoff.
pub(crate) fn grey(builder: SceneBuilder) -> f64 {
    grey_with(builder, Whitted::CUTOFF)
}

/// Fails where `found` differs from `expected` by more than that fraction of it.
#[track_caller]
pub(crate) fn assert_near(found: f64, expected: f64, fraction: f64, what: &str) {
    let error = (found - expected).abs();
    // Not for NaN either.
    assert!(error <= fraction * expected.abs(), "{what}: {found} is not {expected}");
}

/// The largest difference of two pictures in a component.
pub(crate) fn largest_difference(a: &Rendered, b: &Rendered) -> f64 {
    let (a, b) = (a.film.pixels(), b.film.pixels());
    assert_eq!(a.len(), b.len());
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(a, b)| f64::from((a - b).abs())).fold(0.0, |most, d| {
        assert!(!d.is_nan());
        f64::max(most, d)
    })
}

/// The fraction that clear surfaces mirror, by the sines and tangents of the
/// angles on both sides (Fresnel's own form); of unpolarised light.
pub(crate) fn fresnel(degrees: f64, n1: f64, n2: f64) -> f64 {
    let a = degrees.to_radians();
    let b = libm::asin(libm::sin(a) * n1 / n2);
    if a == 0.0 {
        let r = (n1 - n2) / (n1 + n2);
        return r * r;
    }
    let s = libm::sin(a - b) / libm::sin(a + b);
    let t = libm::tan(a - b) / libm::tan(a + b);
    (s * s + t * t) / 2.0
}

/// A shape that no ray meets and that remembers all rays that might have.
#[derive(Debug, Clone, Default)]
pub(crate) struct Witness {
    rays: Arc<Mutex<Vec<Ray>>>,
}

impl CustomShape for Witness {
    fn name(&self) -> &str {
        "witness"
    }

    fn nearest(&self, ray: &Ray) -> Option<f64> {
        self.rays.lock().expect("no thread has failed").push(*ray);
        None
    }

    fn normal(&self, _point: &Point) -> Vector {
        Vector::z()
    }
}

/// All rays that are followed for the only pixel of a picture, the eye's own
/// first.
pub(crate) fn rays(builder: SceneBuilder) -> Vec<Ray> {
    let witness = Witness::default();
    let builder = builder.shape(Shape::custom(witness.clone(), black()));
    let scene = builder.build().expect("valid");
    let _ = Whitted::new().prepare(&scene, &Plan::default()).pixel(0, 0, &mut RayCounts::default());
    let mut rays = witness.rays.lock().expect("no thread has failed").clone();
    // It is asked again where surfaces are crossed.
    rays.dedup();
    rays
}

/// Where a ray's line is at that height.
pub(crate) fn at_height(ray: &Ray, z: f64) -> [f64; 2] {
    let t = (z - ray.origin.z) / ray.direction.z;
    [ray.origin.x + t * ray.direction.x, ray.origin.y + t * ray.direction.y]
}
