//! A4: the same picture every time.

use crate::pictures::{bits, built, eye, file, glass, scene, white};
use lancer_film::Window;
use lancer_integrator::{
    Engine, KernelSettings, Plan, RayCounts, RenderSettings, Rgb, Whitted, Width, render,
};
use lancer_output::{Bits, Format, encode};
use lancer_scene::{Camera, Colour, Light, Scene, Shape, Surface};
use std::num::NonZeroUsize;

/// Glass, mirrors and shadows, where the order of sums would show.
fn crowd(order: impl Fn(&mut Vec<Shape>)) -> Scene {
    let mut rng = fastrand::Rng::with_seed(44);
    let mut shapes: Vec<Shape> = Vec::new();
    for i in 0..60 {
        let centre = [rng.f64() * 6.0 - 3.0, rng.f64() * 6.0, rng.f64() * 3.0];
        let colour = Colour::linear([rng.f64(), rng.f64(), rng.f64()]).expect("in range");
        let surface = match i % 3 {
            0 => glass(1.1 + rng.f64()),
            1 => Surface::new(colour).gloss(0.7).expect("in range"),
            _ => Surface::new(colour),
        };
        // Of two that overlap the smaller is seen; so none are of the same size.
        let size = 0.5 + f64::from(i) / 1000.0;
        let shape = match i % 4 {
            0 => Shape::cube(centre, size, surface),
            1 => Shape::cylinder(
                centre,
                [centre[0], centre[1] + 0.3, centre[2] + size],
                0.4 * size,
                surface,
            ),
            _ => Shape::sphere(centre, 0.6 * size, surface),
        };
        shapes.push(shape.expect("valid"));
    }
    shapes.push(Shape::plane([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], white()).expect("valid"));
    order(&mut shapes);
    let camera = Camera::new([0.0, -6.0, 2.0], [0.0, 0.0, 1.0], 5.0, [72, 56]);
    let mut crowd = scene(camera, 0.1)
        .light(Light::lamp([4.0, -4.0, 6.0], 30.0))
        .light(Light::sun([0.3, 0.4, -1.0], 0.5));
    for shape in shapes {
        crowd = crowd.shape(Ok(shape));
    }
    built(crowd)
}

fn bytes(scene: &Scene, threads: usize, kernel: KernelSettings) -> Vec<u8> {
    let threads = NonZeroUsize::new(threads);
    let settings = RenderSettings { threads, kernel, ..RenderSettings::default() };
    let film = render(scene, &Whitted::new(), &settings).expect("it renders").film;
    encode(&film, Format::Png, Bits::Sixteen).expect("it encodes")
}

/// Pass: the same file for 1, 2, 4 and 16 threads, with and without instructions that
/// multiply and add at once, for any number of lanes.
#[test]
fn a4_threads_and_lanes_change_no_byte() {
    let scene = crowd(|_| {});
    let expected = bytes(&scene, 1, KernelSettings { lanes: Width::SCALAR, ..Default::default() });
    for lanes in Width::available() {
        let kernel = KernelSettings { lanes, ..KernelSettings::default() };
        for threads in [1, 2, 4, 16] {
            assert!(bytes(&scene, threads, kernel) == expected, "{} {threads}", lanes.name());
        }
    }
}

/// Pass: tiles of 8, 32 and 64 pixels, and pixels one by one.
#[test]
fn a4_tiles_of_any_size_have_the_same_bits() {
    let scene = crowd(|_| {});
    let engine = Whitted::new();
    let tracer = engine.prepare(&scene, &Plan::default());
    let frame = lancer_film::Size::new(72, 56).window();
    let in_tiles = |side: u32| {
        let mut pixels: Vec<Rgb> = vec![[0.0; 3]; frame.pixels() as usize];
        let mut counts = RayCounts::default();
        for y in (0..frame.height).step_by(side as usize) {
            for x in (0..frame.width).step_by(side as usize) {
                let (width, height) = (side.min(frame.width - x), side.min(frame.height - y));
                let mut tile = vec![[0.0; 3]; (width * height) as usize];
                tracer.tile(Window { x, y, width, height }, &mut tile, &mut counts);
                for (row, values) in tile.chunks_exact(width as usize).enumerate() {
                    let start = (y as usize + row) * frame.width as usize + x as usize;
                    pixels[start..start + values.len()].copy_from_slice(values);
                }
            }
        }
        let bits: Vec<_> = pixels.into_iter().map(|pixel| pixel.map(f32::to_bits)).collect();
        (bits, counts)
    };
    let one = in_tiles(1);
    for side in [8, 16, 32, 64, 100] {
        assert!(in_tiles(side) == one, "tiles of {side}");
    }
}

/// Pass: another order of the shapes, which is another tree, is the same file.
#[test]
fn a4_the_order_of_shapes_changes_no_byte() {
    let expected = bytes(&crowd(|_| {}), 2, KernelSettings::default());
    for seed in 0..4 {
        let shuffled = crowd(|shapes| fastrand::Rng::with_seed(seed).shuffle(shapes));
        assert!(bytes(&shuffled, 2, KernelSettings::default()) == expected, "seed {seed}");
    }
    let reversed = crowd(|shapes| shapes.reverse());
    assert!(bytes(&reversed, 2, KernelSettings::default()) == expected, "reversed");
}

/// And again, in the same process.
#[test]
fn a4_again_is_the_same() {
    for name in ["little_world", "furnace", "mirror_room", "checker_far"] {
        let scene = file(name, &[]);
        let [a, b] = [0, 1].map(|_| bits(&crate::pictures::by("whitted", &scene)));
        assert!(a == b, "{name}");
    }
    // A product of which the rounding is kept by mistake is 0.1 * 0.1 - 0.1 * 0.1: here
    // a point of a plane whose coordinates are not short.
    let on_plane = scene(eye([0.1, 0.1, 0.1], [0.2, 0.2, 0.0]), 0.0)
        .shape(Shape::plane([0.0; 3], [0.1, 0.1, 0.1], white()))
        .light(Light::lamp([1.0, 1.0, 1.0], 1.0));
    let scene = built(on_plane);
    let scalar = KernelSettings { lanes: Width::SCALAR, ..KernelSettings::default() };
    assert!(bytes(&scene, 1, scalar) == bytes(&scene, 1, KernelSettings::default()));
}
