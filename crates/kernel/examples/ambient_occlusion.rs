//! Bakes into the vertices of a mesh how much of the sky each of them sees, and
//! writes the mesh as PLY text with these shares as greys.
//!
//! ```sh
//! cargo run --release -p lancer-kernel --example ambient_occlusion > baked.ply
//! ```

use lancer_kernel::{Prepared, Which};
use lancer_math::{Point, Ray, Vector, sin_cos_degrees, unit};
use lancer_scene::{Camera, Colour, InvalidScene, Mesh, Scene, Shape, Surface};
use std::fmt::Write;
use std::sync::Arc;

/// Corners of squares along each side of the mesh.
const SIDE: u32 = 65;

/// Rays from each vertex.
const RAYS: u32 = 64;

/// What is farther away than this hides nothing.
const REACH: f64 = 4.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (positions, triangles) = dunes();
    let mesh = Arc::new(Mesh::new(positions.clone(), triangles.clone())?);
    let prepared = prepare(&mesh)?;
    let seen = bake(&prepared, &positions, &normals(&positions, &triangles));
    print!("{}", ply(&positions, &triangles, &seen));
    Ok(())
}

/// The mesh and a ball that lies on it.
fn prepare(mesh: &Arc<Mesh>) -> Result<Prepared, InvalidScene> {
    let grey = Surface::new(Colour::GREY);
    let scene = Scene::builder()
        .camera(Camera::new([8.0, 8.0, 8.0], [0.0; 3], 1.0, [1, 1]))
        .shape(Shape::mesh(Arc::clone(mesh), grey))
        .shape(Shape::sphere([0.5, 0.3, 1.6], 1.2, grey))
        .build()?;
    Ok(Prepared::new(&scene))
}

fn dunes() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let place = |i: u32| 8.0 * f64::from(i) / f64::from(SIDE - 1) - 4.0;
    let wave = |x: f64| sin_cos_degrees(80.0 * x).0;
    let corners = (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| (place(i), place(j))));
    let positions = corners.map(|(x, y)| [x, y, 0.5 * wave(x + 0.3 * y) * wave(0.7 * y)]);
    let squares = (0..SIDE - 1).flat_map(|j| (0..SIDE - 1).map(move |i| j * SIDE + i));
    let triangles =
        squares.flat_map(|a| [[a, a + 1, a + SIDE + 1], [a, a + SIDE + 1, a + SIDE]]).collect();
    (positions.collect(), triangles)
}

/// Of each vertex the mean normal of its triangles, by their areas.
fn normals(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<Vector> {
    let mut sums = vec![Vector::zeros(); positions.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|i| Vector::from(positions[i as usize]));
        let normal = (b - a).cross(&(c - a));
        triangle.iter().for_each(|&i| sums[i as usize] += normal);
    }
    sums.into_iter().map(|sum| unit(sum).unwrap_or_else(Vector::z)).collect()
}

/// The share of the sky that each point sees, weighted by the cosine.
fn bake(prepared: &Prepared, positions: &[[f64; 3]], normals: &[Vector]) -> Vec<f64> {
    let mut rays = Vec::with_capacity(positions.len() * RAYS as usize);
    for (position, normal) in positions.iter().zip(normals) {
        // A little off the mesh, so that the vertex does not hide the sky from itself.
        let origin = Point::from(*position) + normal * 1e-6;
        let (u, v) = beside(normal);
        for k in 0..RAYS {
            let [x, y, z] = direction(k);
            rays.push(Ray::new(origin, u * x + v * y + normal * z));
        }
    }
    let mut hidden = vec![false; rays.len()];
    // The directions have length 1, so t is a length.
    prepared.any_each(&rays, REACH, Which::All, &mut hidden);
    let share = |of: &[bool]| of.iter().filter(|hidden| !**hidden).count() as f64;
    hidden.chunks(RAYS as usize).map(|of| share(of) / f64::from(RAYS)).collect()
}

/// One of the directions around z, as dense as the cosine: points of a disc along
/// Fermat's spiral (Vogel, *A Better Way to Construct the Sunflower Head*, 1979),
/// lifted onto the half ball.
fn direction(k: u32) -> [f64; 3] {
    let square = (f64::from(k) + 0.5) / f64::from(RAYS);
    let (sine, cosine) = sin_cos_degrees(137.507_764_050_037_85 * f64::from(k));
    let radius = square.sqrt();
    [radius * cosine, radius * sine, (1.0 - square).sqrt()]
}

/// Two directions of length 1 that are perpendicular to a third and each other.
fn beside(normal: &Vector) -> (Vector, Vector) {
    let mut axis = Vector::zeros();
    axis[normal.iamin()] = 1.0;
    let u = unit(normal.cross(&axis)).unwrap_or_else(Vector::x);
    (u, normal.cross(&u))
}

fn ply(positions: &[[f64; 3]], triangles: &[[u32; 3]], seen: &[f64]) -> String {
    let mut text = format!(
        "ply\nformat ascii 1.0\n\
         element vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        positions.len(),
        triangles.len(),
    );
    for ([x, y, z], seen) in positions.iter().zip(seen) {
        let grey = (255.0 * seen).round();
        let _ = writeln!(text, "{x} {y} {z} {grey} {grey} {grey}");
    }
    for [a, b, c] in triangles {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}

#[test]
fn hollows_are_darker_than_crests_and_under_the_ball_it_is_darkest() {
    let (positions, triangles) = dunes();
    let mesh = Arc::new(Mesh::new(positions.clone(), triangles.clone()).expect("valid"));
    let seen = bake(&prepare(&mesh).expect("valid"), &positions, &normals(&positions, &triangles));
    assert!(seen.iter().all(|share| (0.0..=1.0).contains(share)));
    let far = |p: &[f64; 3]| libm::hypot(p[0] - 0.5, p[1] - 0.3) > 3.0;
    let mean = |wanted: &dyn Fn(&[f64; 3]) -> bool| {
        let of: Vec<f64> =
            positions.iter().zip(&seen).filter(|(p, _)| wanted(p)).map(|(_, s)| *s).collect();
        of.iter().sum::<f64>() / of.len() as f64
    };
    let crests = mean(&|p| far(p) && p[2] > 0.3);
    let hollows = mean(&|p| far(p) && p[2] < -0.3);
    let under = mean(&|p| libm::hypot(p[0] - 0.5, p[1] - 0.3) < 0.4);
    assert!(crests > 0.95 && hollows < crests - 0.05, "{crests} {hollows}");
    assert!(under < 0.7 * hollows, "{under} {hollows}");
}
