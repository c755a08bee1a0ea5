//! Times rays on a mesh, both from files of little-endian numbers of single
//! precision: three corners of three coordinates for each triangle, and origin and
//! direction of each ray.
//!
//! ```sh
//! cargo run --release -p lancer-kernel --example trace_rays -- MESH RAYS
//! ```
//!
//! Prints the best of five times, on one thread, for nearest and for any hits.

use lancer_kernel::{Prepared, Which};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{Camera, Colour, Mesh, Scene, Shape, Surface};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [mesh, rays] = &arguments[..] else { return Err("expected MESH RAYS".into()) };
    let corners: Vec<[f64; 3]> = words(mesh)?
        .as_chunks::<3>()
        .0
        .iter()
        .map(|p| p.map(|c| f64::from(f32::from_le_bytes(c))))
        .collect();
    let triangles: Vec<_> =
        (0..corners.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let count = triangles.len();
    let mesh = Mesh::new(corners, triangles)?;
    let scene = Scene::builder()
        .camera(Camera::new([0.0, -4.0, 0.0], [0.0; 3], 1.0, [4, 3]))
        .shape(Shape::mesh(mesh.into(), Surface::new(Colour::RED)))
        .build()?;
    let begun = Instant::now();
    let prepared = Prepared::new(&scene);
    println!("{count} triangles, built in {:.2?}", begun.elapsed());

    let rays: Vec<Ray> = words(rays)?
        .as_chunks::<6>()
        .0
        .iter()
        .map(|ray| {
            let [x, y, z, u, v, w] = ray.map(|c| f64::from(f32::from_le_bytes(c)));
            Ray::new(Point::new(x, y, z), Vector::new(u, v, w))
        })
        .collect();
    let mut hits = vec![None; rays.len()];
    report("nearest", rays.len(), || prepared.nearest_each(&rays, f64::INFINITY, &mut hits));
    let mut answers = vec![false; rays.len()];
    report("any", rays.len(), || prepared.any_each(&rays, f64::INFINITY, Which::All, &mut answers));
    let met = hits.iter().flatten().count();
    println!("{met} of {} rays meet a triangle", rays.len());
    assert!(hits.iter().zip(&answers).all(|(hit, any)| hit.is_some() == *any));

    Ok(())
}

fn words(path: &str) -> Result<Vec<[u8; 4]>, Box<dyn Error>> {
    Ok(std::fs::read(path).map_err(|e| format!("{path}: {e}"))?.as_chunks::<4>().0.to_vec())
}

fn report(name: &str, rays: usize, mut work: impl FnMut()) {
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let begun = (Instant::now(), processor_time());
        work();
        best = best.min(match (begun.1, processor_time()) {
            (Some(begun), Some(now)) => now - begun,
            _ => begun.0.elapsed().as_secs_f64(),
        });
    }
    println!("{name}: {:.2} million rays per second", rays as f64 / best / 1e6);
}

/// In seconds, of this thread, where the system tells: others may be at work.
fn processor_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split(' ').next()?.parse().ok()?;
    Some(nanoseconds / 1e9)
}
