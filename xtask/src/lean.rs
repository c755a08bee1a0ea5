//! `cargo xtask lean`: what is in the program, and not used by a scene, costs it.

use crate::bench::clock::in_turn;
use crate::bench::process::{self, Build};
use crate::bench::{machine, page::Table};
use crate::{Failure, fail, sections};
use clap::Args;
use lancer_tests::paths;
use std::path::{Path, PathBuf};
use std::process::Command;

/// How to measure.
#[derive(Debug, Args)]
pub(crate) struct LeanArgs {
    /// How often each picture is made
    #[arg(long, default_value_t = 15, value_parser = clap::value_parser!(u16).range(1..))]
    runs: u16,

    /// Put the table into docs/plan.md
    #[arg(long)]
    write: bool,
}

/// How the README's scene is rendered, and what that is called.
const WAYS: [(&str, &[&str]); 2] = [
    ("a sample for each pixel", &["--samples", "1"]),
    ("an error of 0.0005", &["--error", "0.0005"]),
];

/// A picture made by one of the builds.
struct Work<'a> {
    program: &'a Path,
    flags: &'static [&'static str],
    picture: PathBuf,
}

pub(crate) fn run(args: &LeanArgs) -> Result<(), Failure> {
    let (whole, lean) = (process::program(Build::Whole)?, process::program(Build::Lean)?);
    let folder = tempfile::tempdir().map_err(fail)?;
    let mut table = Table::new(&["README's scene", "lean, ms", "whole, ms", "whole / lean"]);
    for (name, flags) in WAYS {
        let work = |program, file| Work { program, flags, picture: folder.path().join(file) };
        let works = [work(&whole, "whole.ppm"), work(&lean, "lean.ppm")];
        let stats = folder.path().join("stats.json");
        let samples = in_turn(usize::from(args.runs), &works, |work| seconds(work, &stats))?;
        let [whole, lean] = works.map(|work| std::fs::read(work.picture));
        if whole.map_err(fail)? != lean.map_err(fail)? {
            return Err(fail("the pictures of both builds are not the same"));
        }
        let ratio = samples[0].times(&samples[1]);
        table.row(vec![
            name.to_owned(),
            samples[1].milliseconds(),
            samples[0].milliseconds(),
            format!("{ratio:.3}"),
        ]);
    }
    let text = format!(
        "{table}\n`cargo run --release -p xtask -- lean --runs {} --write`: {}",
        args.runs,
        machine::description()
    );
    println!("{text}");
    if args.write { sections::write("plan.md", "unused", &text) } else { Ok(()) }
}

/// How long rendering takes on one thread, as the program says it.
fn seconds(work: &Work<'_>, stats: &Path) -> Result<f64, Failure> {
    let mut command = Command::new(work.program);
    command
        .arg("render")
        .arg(paths::scenes().join("readme.xml"))
        .arg("-o")
        .arg(&work.picture)
        .args(["--quiet", "--threads", "1"])
        .args(work.flags)
        .arg("--stats")
        .arg(stats);
    if !command.status().map_err(fail)?.success() {
        return Err(fail("the program fails"));
    }
    process::stage(stats, "render")
}
