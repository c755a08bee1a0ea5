//! Chores of the repository: `cargo xtask --help`.
#![forbid(unsafe_code)]

mod bench;
mod calibrate;
mod chart;
mod docs;
mod gallery;
mod goldens;
mod lean;
mod plan_report;
mod sections;
mod stability;
mod tidy;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

#[derive(Debug, Parser)]
#[command(name = "cargo xtask", about = "Chores of the repository")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Render golden pictures anew and say what changed by how much
    RegenGoldens {
        /// The goldens to render: NAME.ENGINE, or NAME for all of a scene; all if none is named
        names: Vec<String>,
    },
    /// Write docs/format.md, the reference of the scene language, from the tables in the code, and
    /// scenes/README.md from the settings beside the scenes
    Docs {
        /// Only say whether it is up to date
        #[arg(long)]
        check: bool,
    },
    /// Check what no compiler checks: dependency arrows, lints, file sizes, the README's commands
    Tidy,
    /// Measure how fast this is (build with --release), or count instructions
    Bench(bench::BenchArgs),
    /// Ask many rays and compare with what is exactly so (build with --release)
    Stability(stability::StabilityArgs),
    /// Hold the errors that renders predict against true ones (build with --release)
    Calibrate(calibrate::CalibrateArgs),
    /// Draw the charts of the docs anew (build with --release)
    Chart(chart::ChartArgs),
    /// Measure what each rule of a plan saves (build with --release)
    PlanReport(plan_report::PlanReportArgs),
    /// Measure what a scene pays for what it does not use, against a build without that
    Lean(lean::LeanArgs),
}

/// Why a chore was not done.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct Failure(String);

fn fail(reason: impl std::fmt::Display) -> Failure {
    Failure(reason.to_string())
}

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::RegenGoldens { names } => goldens::regenerate(&names),
        Command::Docs { check } => {
            docs::format_reference(check).and_then(|()| gallery::scenes_page(check))
        }
        Command::Tidy => tidy::run(),
        Command::Bench(args) => bench::run(&args),
        Command::Stability(args) => stability::run(&args),
        Command::Calibrate(args) => calibrate::run(&args),
        Command::Chart(args) => chart::run(&args),
        Command::PlanReport(args) => plan_report::run(&args),
        Command::Lean(args) => lean::run(&args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::FAILURE
        }
    }
}
