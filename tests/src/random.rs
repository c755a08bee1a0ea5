//! Random scenes, one for each seed.

use fastrand::Rng;
use lancer_scene::{Camera, Colour, InvalidField, Light, Scene, Shape, Surface};

/// A scene of up to nine spheres, six planes and seven lights, some of them in
/// awkward places: planes through lamps and barely below them, lamps behind
/// planes, eyes inside spheres, perfect mirrors, very bright and very dim
/// lights.
///
/// # Panics
/// Never: the values are in range.
#[must_use]
pub fn scene(seed: u64, pixels: [u32; 2]) -> Scene {
    let mut rng = Rng::with_seed(seed);
    let rng = &mut rng;
    let eye = point(rng, 4.0);
    let mut builder =
        Scene::builder().camera(Camera::new(eye, point(rng, 3.0), 0.5 + 3.0 * rng.f64(), pixels));
    let mut lamps = Vec::new();
    for _ in 0..rng.usize(0..8) {
        let brightness = match rng.u8(0..8) {
            0 => 0.0,
            1 => 1e-12,
            2 => 1e6,
            _ => 2.0 * rng.f64(),
        };
        builder = builder.light(if rng.u8(0..4) == 0 {
            Light::sun(point(rng, 1.0), brightness)
        } else {
            lamps.push(point(rng, 6.0));
            Light::lamp(lamps[lamps.len() - 1], brightness)
        });
    }
    for _ in 0..rng.usize(0..10) {
        let centre = if rng.u8(0..12) == 0 { eye } else { point(rng, 5.0) };
        builder = builder.shape(sphere(rng, centre));
    }
    if rng.u8(0..6) == 0 {
        // A lamp just above a plane, or just below or on it, by anything from
        // rounding upwards; and far points on another plane to see it from.
        let height = (rng.f64() - 0.3) / (1_u64 << rng.u8(10..56)) as f64;
        let plane = [0.0, 0.0, 0.1];
        let normal = [0.1 * rng.f64(), 0.1 * rng.f64(), 1.0];
        builder = builder
            .light(Light::lamp([plane[0], plane[1], plane[2] + height], 1.0))
            .shape(Shape::plane(plane, normal, surface(rng)))
            .shape(Shape::plane([0.0, 0.0, -0.1], [0.0, 0.0, 1.0], surface(rng)));
    }
    for _ in 0..rng.usize(0..7) {
        let origin = match lamps.first() {
            Some(lamp) if rng.u8(0..6) == 0 => *lamp,
            _ => point(rng, 8.0),
        };
        let normal = match rng.u8(0..6) {
            0 => [1.0, 0.0, 0.0],
            1 => [-2.0, 0.0, 0.0],
            2 => [0.0, 0.0, 1.0],
            _ => point(rng, 1.0),
        };
        builder = builder.shape(Shape::plane(origin, normal, surface(rng)));
    }
    builder.build().expect("all values are in range")
}

/// Many spheres of all sizes on and over a floor between walls, all `size` times
/// as large.
///
/// # Panics
/// Never: the values are in range.
#[must_use]
pub fn crowd(seed: u64, pixels: [u32; 2], spheres: usize, size: f64) -> Scene {
    let mut rng = Rng::with_seed(seed);
    let rng = &mut rng;
    let scaled = |p: [f64; 3]| p.map(|c| c * size);
    let (eye, target) = (scaled([0.3, -9.0, 2.0]), scaled([0.0, -8.0, 1.9]));
    let mut builder = Scene::builder()
        .camera(Camera::new(eye, target, 1.2 * size, pixels))
        .light(Light::sun([0.2, 0.3, -1.0], 0.3))
        .light(Light::lamp(scaled([2.0, -1.0, 5.0]), 0.8))
        .light(Light::lamp(scaled([-4.0, -6.0, 3.0]), 0.6));
    for _ in 0..spheres {
        let radius = 0.5 * rng.f64() * rng.f64() * rng.f64() + 0.01;
        let centre = scaled(point(rng, 5.0).map(f64::abs));
        let centre = [centre[0] - 2.5 * size, centre[1] - 2.5 * size, centre[2]];
        builder = builder.shape(Shape::sphere(centre, radius * size, surface(rng)));
    }
    for (origin, normal) in [
        ([0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        ([0.0, 6.0, 0.0], [0.1, -1.0, 0.0]),
        ([-7.0, 0.0, 0.0], [1.0, 0.0, 0.1]),
    ] {
        builder = builder.shape(Shape::plane(scaled(origin), normal, surface(rng)));
    }
    builder.build().expect("all values are in range")
}

fn sphere(rng: &mut Rng, centre: [f64; 3]) -> Result<Shape, InvalidField> {
    Shape::sphere(centre, 0.1 + 2.0 * rng.f64(), surface(rng))
}

fn surface(rng: &mut Rng) -> Surface {
    let (_, colour) = Colour::NAMED[rng.usize(0..Colour::NAMED.len())];
    let surface = Surface::new(colour);
    let surface = match rng.u8(0..3) {
        0 => surface.checker(colour.complement()),
        _ => surface,
    };
    let gloss = match rng.u8(0..4) {
        0 => 0.0,
        1 => 1.0,
        _ => rng.f64(),
    };
    surface.gloss(gloss).expect("it is from 0 to 1")
}

fn point(rng: &mut Rng, size: f64) -> [f64; 3] {
    std::array::from_fn(|_| size * (2.0 * rng.f64() - 1.0))
}
