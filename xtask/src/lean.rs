//! `cargo xtask lean`: what is in the program, and not used by a scene, costs it.

use crate::bench::clock::in_turn;
use crate::bench::process::{self, Build};
use crate::bench::{machine, page::Table};
use crate::{Failure, fail, sections};
use clap::Args;

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

pub(crate) fn run(args: &LeanArgs) -> Result<(), Failure> {
    let programs = [process::program(Build::Whole)?, process::program(Build::Lean)?];
    let [whole, lean] = [(); 2].map(|()| tempfile::tempdir().map_err(fail));
    let folders = [whole?, lean?];
    let works = [0, 1].map(|k| (programs[k].as_path(), folders[k].path()));
    // Flags of the compiler that something overrides would make two builds of the same.
    let (program, folder) = works[1];
    let refused = process::render_readme(program, folder, &["--engine", "classic"]).output();
    if refused.map_err(fail)?.status.success() {
        return Err(fail("the lean build has the engine classic: RUSTFLAGS did not reach it"));
    }
    let mut table = Table::new(&["README's scene", "lean, ms", "whole, ms", "whole / lean"]);
    for (name, flags) in WAYS {
        let samples = in_turn(usize::from(args.runs), &works, |(program, folder)| {
            let flags = [&["--threads", "1"], flags].concat();
            let command = process::render_readme(program, folder, &flags);
            let (_, [render, _, _]) = process::run(command, folder)?;
            Ok(render)
        })?;
        let [whole, lean] = works.map(|(_, folder)| std::fs::read(folder.join("out.ppm")));
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
    sections::show(&text, ("plan.md", "unused"), args.write)
}
