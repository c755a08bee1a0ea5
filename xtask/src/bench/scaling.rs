//! Scenes of growing size: building, memory, rays.

use super::BenchArgs;
use super::clock::{in_turn, seconds};
use super::page::{Section, Table};
use super::rays::{self, View};
use crate::{Failure, fail};
use lancer_kernel::{Hit, Prepared};
use lancer_math::{Bounds, Point, Ray, Vector};
use lancer_scene::{InvalidScene, Scene};
use lancer_tests::generated;
use rayon::ThreadPool;

pub(super) const TITLE: &str = "Scaling";

/// A row of the table.
struct Case {
    name: String,
    /// How many shapes or triangles there are to build from.
    count: usize,
    scene: Result<Scene, InvalidScene>,
}

pub(super) fn measure(args: &BenchArgs) -> Result<Section, Failure> {
    let mut section = Section::new(TITLE);
    section.add(
        "Generated scenes. Building in millions of shapes or triangles per second; memory is what the prepared scene holds, in bytes for each of \
         them, without the positions of meshes, which are those of the scene; millions of rays per second for the nearest hit, coherent (a picture of 1024x1024 \
         pixels) and random (a million from anywhere to anywhere, in no order), by threads.",
    );
    let mut table = Table::new(&[
        "scene",
        "build, 1",
        "build, 2",
        "bytes",
        "coherent, 1",
        "coherent, 2",
        "random, 1",
        "random, 2",
    ]);
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(fail)?;
    let two = rayon::ThreadPoolBuilder::new().num_threads(2).build().map_err(fail)?;
    let pools = [one, two];
    let sizes = (1..=7).map(|power| 10_usize.pow(power)).filter(|size| *size <= args.up_to);
    let mut add = |case: Case| -> Result<(), Failure> {
        eprintln!("{} ...", case.name);
        table.row(row(case, &pools, args.runs())?);
        Ok(())
    };
    for count in sizes.clone() {
        add(Case { name: format!("{count} spheres"), count, scene: generated::spheres(count) })?;
    }
    for count in sizes.filter(|size| *size >= 1000) {
        let mesh = generated::terrain(count);
        let count = mesh.triangle_count();
        add(Case { name: format!("{count} triangles"), count, scene: generated::of_mesh(mesh) })?;
    }
    for levels in 1..=4 {
        let places = 10_usize.pow(levels);
        if args.up_to >= 100_000 {
            add(Case {
                name: format!("100000 triangles in {places} places, {levels} levels"),
                count: 100_000,
                scene: generated::nested(levels),
            })?;
        }
    }
    section.add(table);
    Ok(section)
}

fn row(case: Case, pools: &[ThreadPool; 2], runs: usize) -> Result<Vec<String>, Failure> {
    let scene = case.scene.map_err(fail)?;
    let prepared = Prepared::new(&scene);
    let bytes = prepared.bytes();
    // Each takes long where there is much to build.
    let repeats = if case.count > 1_000_000 { 1 } else { runs };
    let built =
        in_turn(repeats, pools, |pool| Ok(pool.install(|| seconds(|| Prepared::new(&scene))).0))?;

    let bounds = Bounds { min: Point::new(-1.0, -1.0, -0.6), max: Point::new(1.0, 1.0, 0.6) };
    let view = View::outside(&bounds, Vector::new(3.0, -4.0, 2.5), Vector::z());
    let coherent = view.rays([1024, 1024]);
    let random = rays::random(&bounds, 1_000_000);
    let mut hits: Vec<Option<Hit>> = vec![None; coherent.len().max(random.len())];
    let works: [(usize, &[Ray]); 4] = [(1, &coherent), (2, &coherent), (1, &random), (2, &random)];
    let samples = in_turn(runs, &works, |(threads, rays)| {
        let hits = &mut hits[..rays.len()];
        Ok(seconds(|| rays::nearest_on(*threads, &prepared, rays, hits)).0)
    })?;
    let mut row = vec![case.name];
    row.extend(built.iter().map(|seconds| seconds.millions(case.count)));
    row.push((bytes / case.count).to_string());
    row.extend(works.iter().zip(&samples).map(|((_, rays), samples)| samples.millions(rays.len())));
    Ok(row)
}
