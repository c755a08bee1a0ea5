//! Where what is seen jumps, signatures of samples change.

use lancer_film::Size;
use lancer_integrator::{
    Engine, Plan, RayCounts, Sample, Sampler, Seen, Stream, TILE_SIDE, Whitted,
};
use lancer_scene::{PixelCount, Scene};
use lancer_tests::golden;

/// Of the pictures, in pixels.
const WIDTH: u32 = 200;
const HEIGHT: u32 = 150;

/// So many samples a pixel, along each side.
const FINE: u32 = 4;

/// Samples of a picture on a grid, row by row.
struct Grid {
    seen: Vec<Seen>,
}

fn sample(place: [f64; 2]) -> Sample {
    let pixel = (place[0] as u32, place[1] as u32);
    Sample { pixel, place, stream: Stream::new(0, pixel, 0, 0) }
}

/// The place of a column and row of the grid.
fn place(x: u32, y: u32) -> [f64; 2] {
    [x, y].map(|at| (f64::from(at) + 0.5) / f64::from(FINE))
}

impl Grid {
    fn new(sampler: &dyn Sampler) -> Self {
        let frame = Size::new(WIDTH * FINE, HEIGHT * FINE).window();
        let mut grid = Self { seen: vec![Seen::default(); frame.pixels() as usize] };
        for window in frame.strips(TILE_SIDE, TILE_SIDE) {
            let places: Vec<_> = (window.y..window.y + window.height)
                .flat_map(|y| (window.x..window.x + window.width).map(move |x| (x, y)))
                .collect();
            let samples: Vec<_> = places.iter().map(|&(x, y)| sample(place(x, y))).collect();
            let mut seen = vec![Seen::default(); samples.len()];
            sampler.see(&samples, &mut seen, &mut RayCounts::default());
            for (&(x, y), seen) in places.iter().zip(seen) {
                grid.seen[(y * frame.width + x) as usize] = seen;
            }
        }
        grid
    }

    /// What is seen at four places in a row, from each but the last ones to the right and
    /// downward; and where the two amid them are.
    fn fours(&self) -> impl Iterator<Item = ([[f64; 2]; 2], [&Seen; 4])> {
        let (width, height) = (WIDTH * FINE, HEIGHT * FINE);
        let right = (0..height).flat_map(move |y| (0..width - 3).map(move |x| (x, y, [1, 0])));
        let down = (0..height - 3).flat_map(move |y| (0..width).map(move |x| (x, y, [0, 1])));
        right.chain(down).map(move |(x, y, [right, down])| {
            let places = [1, 2].map(|k| place(x + k * right, y + k * down));
            let seen = |k| &self.seen[((y + k * down) * width + x + k * right) as usize];
            (places, [0, 1, 2, 3].map(seen))
        })
    }
}

/// The largest difference of a channel on a display.
fn difference(a: &Seen, b: &Seen) -> f32 {
    let each = a.radiance.iter().zip(&b.radiance);
    each.map(|(a, b)| (a.clamp(0.0, 1.0) - b.clamp(0.0, 1.0)).abs()).fold(0.0, f32::max)
}

/// A larger difference between neighbours, beyond twice the slope on either side as far as
/// signatures say that there is one, is a jump.
const JUMP: f32 = 0.02;

/// What neighbours tell.
#[derive(Debug, Default)]
struct Found {
    /// How many differ by a jump.
    jumps: u32,
    /// How many of them have the same signature, and why they differ.
    steps: u32,
    others: u32,
    slopes: u32,
    /// The fraction of neighbours with different signatures.
    changes: f64,
}

impl Found {
    fn of(grid: &Grid, sampler: &dyn Sampler) -> Self {
        let mut found = Self::default();
        let mut pairs = 0.0;
        for (places, [a, b, c, d]) in grid.fours() {
            let is_same = b.signature == c.signature;
            pairs += 1.0;
            found.changes += f64::from(u8::from(!is_same));
            let slope = |a: &Seen, b: &Seen| {
                if a.signature == b.signature { difference(a, b) } else { 0.0 }
            };
            if difference(b, c) > JUMP + 2.0 * slope(a, b).max(slope(c, d)) {
                found.jumps += 1;
                match is_same.then(|| between(sampler, places)) {
                    None => {}
                    Some(Between::Step) => found.steps += 1,
                    Some(Between::Other) => found.others += 1,
                    Some(Between::Slope) => found.slopes += 1,
                }
            }
        }
        found.changes /= pairs;
        found
    }
}

/// What is between two samples of one signature that differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Between {
    /// A step: what is near it differs as much, however near.
    Step,
    /// Something else, smaller than the samples are apart.
    Other,
    /// No more than a steep slope.
    Slope,
}

fn between(sampler: &dyn Sampler, [mut a, mut b]: [[f64; 2]; 2]) -> Between {
    let see = |place| sampler.see_alone(&sample(place), &mut RayCounts::default());
    let [mut seen_a, mut seen_b] = [a, b].map(see);
    let whole = difference(&seen_a, &seen_b);
    for _ in 0..24 {
        let middle = [0, 1].map(|i| (a[i] + b[i]) / 2.0);
        let seen = see(middle);
        if seen.signature != seen_a.signature {
            return Between::Other;
        }
        if difference(&seen_a, &seen) > difference(&seen, &seen_b) {
            (b, seen_b) = (middle, seen);
        } else {
            (a, seen_a) = (middle, seen);
        }
    }
    if difference(&seen_a, &seen_b) > 0.02 * whole { Between::Step } else { Between::Slope }
}

/// Of neighbouring samples that look alike to their signatures and not to the eye, none have a
/// step between them but on meshes, and few have anything else.
#[test]
fn signatures_change_where_pictures_jump() {
    for (name, most_steps, most_changes) in [
        ("readme", 0, 0.07),
        ("two_suns", 0, 0.10),
        ("facing_mirrors", 0, 0.12),
        ("mirror_corridor", 0, 0.20),
        ("glass", 0, 0.19),
        ("sheets", 0, 0.17),
        ("underwater", 0, 0.05),
        ("checkers", 0, 0.10),
        ("spots", 0, 0.01),
        ("all_shapes", 0, 0.08),
        ("meshes", 5, 0.17),
    ] {
        let mut scene = scene(name);
        scene.camera.px_width = PixelCount::new(WIDTH).expect("positive");
        scene.camera.px_height = PixelCount::new(HEIGHT).expect("positive");
        let engine = Whitted::new();
        let tracer = engine.prepare(&scene, &Plan::default());
        let sampler = tracer.sampler().expect("whitted sees samples");
        let found = Found::of(&Grid::new(sampler), sampler);
        println!("{name}: {found:?}");
        assert!(found.jumps > 100, "{name}: {found:?}");
        assert!(found.steps <= most_steps, "{name}: {found:?}");
        assert!(found.others <= 3 + found.jumps / 1000, "{name}: {found:?}");
        // Not by changing everywhere.
        assert!(found.changes <= most_changes, "{name}: {found:?}");
    }
}

fn scene(name: &str) -> Scene {
    let all = golden::all().expect("the settings are valid");
    let whole = format!("{name}.whitted");
    let golden = all.into_iter().find(|golden| golden.name == whole).expect("there is that scene");
    golden.scene().expect("the scene is valid")
}
