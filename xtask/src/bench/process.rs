//! The whole process: start, read, render, write an uncompressed picture.

use super::clock::{Samples, in_turn, seconds};
use super::page::{Section, Table};
use crate::{Failure, fail};
use cargo_metadata::Message;
use lancer_integrator::Width;
use lancer_tests::paths;
use std::cell::RefCell;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What is in the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Build {
    /// All, as users have it.
    Whole,
    /// As [`lancer_kernel::LEAN`] has it.
    Lean,
}

/// The program, built anew where it is not up to date.
pub(crate) fn program(build: Build) -> Result<PathBuf, Failure> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    if build == Build::Lean {
        // In a folder of its own, so that neither build undoes the other.
        let flags = std::env::var("RUSTFLAGS").unwrap_or_default() + " --cfg lancer_lean";
        command.env("RUSTFLAGS", flags);
        command.env("CARGO_TARGET_DIR", paths::top().join("target/lean"));
    }
    let mut build = command
        .args(["build", "--release", "--locked", "--package", "lancer", "--bin", "lancer"])
        .args(["--message-format", "json-render-diagnostics"])
        .current_dir(paths::top())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(fail)?;
    let said = build.stdout.take().ok_or_else(|| fail("cargo says nothing"))?;
    let mut program = None;
    for message in Message::parse_stream(BufReader::new(said)) {
        if let Message::CompilerArtifact(artifact) = message.map_err(fail)? {
            program = artifact.executable.map(PathBuf::from).or(program);
        }
    }
    if !build.wait().map_err(fail)?.success() {
        return Err(fail("the program does not build"));
    }
    program.ok_or_else(|| fail("cargo does not say where the program is"))
}

/// The options with which pictures are those of the pixels' centres, so that it is known how
/// many rays they take.
pub(super) fn centres(engine: &str) -> &'static [&'static str] {
    if engine == "whitted" { &["--samples", "1"] } else { &[] }
}

/// What the stages of the program take.
#[derive(Default)]
struct Stages {
    render: Samples,
    encode: Samples,
    write: Samples,
    rest: Samples,
}

/// Adds what the whole process takes.
pub(super) fn measure(section: &mut Section, runs: usize) -> Result<(), Failure> {
    let program = program(Build::Whole)?;
    let folder = tempfile::tempdir().map_err(fail)?;
    let lanes: Vec<_> =
        ["avx2", "avx512"].iter().filter_map(|name| Width::by_name(name).ok()).collect();
    let works: Vec<_> = ["classic", "whitted"]
        .iter()
        .flat_map(|engine| {
            lanes.iter().map(move |lanes| (*engine, lanes.name(), RefCell::default()))
        })
        .collect();
    let samples = in_turn(runs, &works, |(engine, lanes, stages)| {
        one(&program, folder.path(), engine, lanes, &mut stages.borrow_mut())
    })?;

    section.add(
        "The whole process, `lancer render scenes/readme.xml -o out.ppm`, from its start to its end on all cores, in milliseconds; with \
         what it says itself of its stages. The rest is starting, reading, parsing and ending.",
    );
    let mut table = Table::new(&["engine", "lanes", "whole", "render", "encode", "write", "rest"]);
    for ((engine, lanes, stages), whole) in works.iter().zip(&samples) {
        let Stages { render, encode, write, rest } = &*stages.borrow();
        let mut row = vec![(*engine).to_owned(), (*lanes).to_owned(), whole.milliseconds()];
        row.extend([render, encode, write, rest].map(Samples::milliseconds));
        table.row(row);
    }
    section.add(table);
    Ok(())
}

fn one(
    program: &Path,
    folder: &Path,
    engine: &str,
    lanes: &str,
    stages: &mut Stages,
) -> Result<f64, Failure> {
    let flags = [&["--engine", engine][..], centres(engine)].concat();
    let mut command = render_readme(program, folder, &flags);
    command.env("LANCER_LANES", lanes);
    let (seconds, [render, encode, write]) = run(command, folder)?;
    stages.render.push(render);
    stages.encode.push(encode);
    stages.write.push(write);
    stages.rest.push(seconds - render - encode - write);
    Ok(seconds)
}

/// Renders the README's scene to a picture and statistics in a folder.
pub(crate) fn render_readme(program: &Path, folder: &Path, flags: &[&str]) -> Command {
    let mut command = Command::new(program);
    command
        .arg("render")
        .arg(paths::scenes().join("readme.xml"))
        .arg("-o")
        .arg(folder.join("out.ppm"))
        .arg("--quiet")
        .args(flags)
        .arg("--stats")
        .arg(folder.join("stats.json"));
    command
}

/// The seconds that this takes from start to end, and those for rendering, encoding and writing, as
/// the program says them.
pub(crate) fn run(mut command: Command, folder: &Path) -> Result<(f64, [f64; 3]), Failure> {
    let (whole, status) = seconds(|| command.status());
    if !status.map_err(fail)?.success() {
        return Err(fail("the program fails"));
    }
    let stats = std::fs::read(folder.join("stats.json")).map_err(fail)?;
    let stats: serde_json::Value = serde_json::from_slice(&stats).map_err(fail)?;
    let stage = |name: &str| {
        let seconds = stats["seconds"][name].as_f64();
        seconds.ok_or_else(|| fail(format_args!("the statistics do not tell the time of {name}")))
    };
    Ok((whole, [stage("render")?, stage("encode")?, stage("write")?]))
}
