//! Says whether hills hide points from one another: reads two points, six numbers,
//! from each line and answers with a line, `visible` or how far one sees.
//!
//! ```sh
//! echo "-4 -4 2  4 4 2" | cargo run --release -p lancer-kernel --example line_of_sight
//! ```

use lancer_kernel::{Hit, Prepared};
use lancer_math::{Point, Ray, sin_cos_degrees};
use lancer_scene::{Camera, Colour, Mesh, Scene, Shape, Surface};
use std::error::Error;
use std::io::{BufRead, Write, stdin, stdout};

/// Lines are answered so many at a time.
const BATCH: usize = 4096;

fn main() -> Result<(), Box<dyn Error>> {
    let prepared = prepare()?;
    let mut lines = stdin().lock().lines();
    loop {
        let batch = lines.by_ref().take(BATCH).collect::<Result<Vec<String>, _>>()?;
        if batch.is_empty() {
            return Ok(());
        }
        let mut output = stdout().lock();
        for answer in answers(&prepared, &batch) {
            writeln!(output, "{answer}")?;
        }
        output.flush()?;
    }
}

/// Hills of 2 x 128 x 128 triangles from -5 to 5, up to 1.5 high.
fn prepare() -> Result<Prepared, Box<dyn Error>> {
    const SIDE: u32 = 129;
    let place = |i: u32| 10.0 * f64::from(i) / f64::from(SIDE - 1) - 5.0;
    let wave = |degrees: f64| sin_cos_degrees(degrees).0;
    let corners = (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| (place(i), place(j))));
    let positions = corners.map(|(x, y)| [x, y, wave(70.0 * x) * wave(50.0 * y) + 0.5]);
    let squares = (0..SIDE - 1).flat_map(|j| (0..SIDE - 1).map(move |i| j * SIDE + i));
    let triangles =
        squares.flat_map(|a| [[a, a + 1, a + SIDE + 1], [a, a + SIDE + 1, a + SIDE]]).collect();
    let mesh = Mesh::new(positions.collect(), triangles)?;
    let scene = Scene::builder()
        .camera(Camera::new([8.0, 8.0, 8.0], [0.0; 3], 1.0, [1, 1]))
        .shape(Shape::mesh(mesh.into(), Surface::new(Colour::GREY)))
        .build()?;
    Ok(Prepared::new(&scene))
}

/// An answer for each line.
fn answers(prepared: &Prepared, lines: &[String]) -> Vec<String> {
    let pairs: Vec<Option<[Point; 2]>> = lines.iter().map(|line| points(line)).collect();
    // From one point to the other t goes from 0 to 1.
    let rays: Vec<Ray> =
        pairs.iter().flatten().map(|[from, to]| Ray::new(*from, to - from)).collect();
    let mut hits = vec![None; rays.len()];
    prepared.nearest_each(&rays, 1.0, &mut hits);
    let mut met = rays.iter().zip(&hits);
    let answer = |pair: &Option<[Point; 2]>| match pair {
        None => "expected six numbers".to_owned(),
        Some(_) => match met.next() {
            Some((ray, Some(Hit { t, .. }))) => {
                format!("hidden from {:.3} on", t * ray.direction.norm())
            }
            _ => "visible".to_owned(),
        },
    };
    pairs.iter().map(answer).collect()
}

fn points(line: &str) -> Option<[Point; 2]> {
    let numbers: Vec<f64> =
        line.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    let &[a, b, c, x, y, z] = numbers.first_chunk().filter(|_| numbers.len() == 6)?;
    Some([Point::new(a, b, c), Point::new(x, y, z)])
}

#[test]
fn hills_hide_what_is_behind_them() {
    let prepared = prepare().expect("valid");
    let lines = ["-4 -4 3  4 4 3", "-4 -4 0.7  4 4 0.7", "1 2 3", "0.1 0.1 5 0.1 0.1 -5"];
    let lines = lines.map(str::to_owned);
    let found = answers(&prepared, &lines);
    assert_eq!(found[0], "visible");
    assert!(found[1].starts_with("hidden from"), "{}", found[1]);
    assert_eq!(found[2], "expected six numbers");
    assert!(found[3].starts_with("hidden from 4."), "{}", found[3]);
    // One by one the same.
    for (line, found) in lines.iter().zip(&found) {
        assert_eq!(answers(&prepared, std::slice::from_ref(line))[0], *found);
    }
}
