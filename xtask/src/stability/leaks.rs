//! `--leaks`: rays from inside closed meshes.

use super::StabilityArgs;
use crate::{Failure, fail};
use lancer_mesh::MeshFormat;
use lancer_scene::Mesh;
use lancer_tests::paths;
use lancer_tests::soak::{closed, leaks};
use std::fmt::Write;
use std::time::Instant;

/// Asks the rays, prints what was found, and returns it as a section.
pub(super) fn run(args: &StabilityArgs, rays: u64) -> Result<(String, bool), Failure> {
    let meshes = meshes()?;
    let mut table =
        "| mesh | triangles | rays | leaks | disagreements |\n|---|---|---|---|---|\n".to_owned();
    print!("seed {}\n{table}", args.seed);
    let mut is_good = true;
    let begun = Instant::now();
    let count = meshes.len() as u64;
    for (i, (name, mesh)) in (0..).zip(meshes) {
        let share = rays / count + u64::from(i < rays % count);
        let seen = leaks(&mesh, args.seed, share);
        let row = format!(
            "| {name} | {} | {} | {} | {} |\n",
            mesh.triangle_count(),
            seen.rays,
            seen.leaks,
            seen.disagreements,
        );
        print!("{row}");
        table += &row;
        is_good &= (seen.leaks, seen.disagreements) == (0, 0);
        for told in seen.told {
            println!("{told}");
        }
    }
    let took = begun.elapsed().as_secs_f64();
    println!("{rays} rays in {took:.0} s: {:.2} million per second", rays as f64 / took / 1e6);
    let mut section = format!(
        "`cargo run --release -p xtask -- stability --leaks {rays} --seed {}`: rays from inside, a third of them at vertices and a third at edges.\n",
        args.seed,
    );
    _ = write!(section, "\n{table}");
    Ok((section, is_good))
}

/// Those that are made, and one from a file.
fn meshes() -> Result<Vec<(&'static str, Mesh)>, Failure> {
    let mut meshes =
        vec![("ball", closed::ball(24)), ("box", closed::block(16)), ("ring", closed::ring(80))];
    let bytes = std::fs::read(paths::scenes().join("meshes/spot.obj")).map_err(fail)?;
    let spot = lancer_mesh::load(&bytes, MeshFormat::Obj, None).map_err(fail)?;
    if !spot.is_closed() {
        return Err(fail("spot.obj is not closed"));
    }
    meshes.push(("spot.obj", spot));
    Ok(meshes)
}
