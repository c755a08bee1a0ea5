//! The `lancer` program: arguments, files, progress and diagnostics on a
//! terminal. It is the only crate that opens files or prints.
//!
//! ```
//! use clap::Parser;
//! use lancer::args::{Cli, Command};
//!
//! let cli = Cli::try_parse_from(["lancer", "render", "scene.xml", "-o", "picture.png"])?;
//! let Command::Render(render) = cli.command else { panic!("it says render") };
//! assert_eq!(render.engine.name(), "whitted");
//! # Ok::<(), clap::Error>(())
//! ```
#![forbid(unsafe_code)]

pub mod args;
pub mod asked;
mod chart;
mod check;
mod compare;
mod drawing;
mod explain;
mod export;
mod files;
mod interrupt;
mod lints;
pub mod peers;
mod preview;
mod render;
pub mod report;
mod scene;
mod stats;

use args::{Cli, Command};
use clap::Parser;
use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

/// Why a command did not do what was asked.
#[derive(Debug, thiserror::Error)]
enum Failure {
    /// The arguments make no sense: exit code 2.
    #[error("{0}")]
    Usage(String),
    /// The scene or the work failed: exit code 1.
    #[error("{0}")]
    Work(String),
    /// The same, and the user has been told already.
    #[error("")]
    Told,
    /// It was interrupted, and the user has been told already: exit code 130, by custom 128 and
    /// the number of the signal.
    #[error("")]
    Interrupted,
}

/// The exit code after an interruption.
const INTERRUPTED: u8 = 130;

impl Failure {
    /// The work failed, and that is why.
    fn work(reason: impl std::fmt::Display) -> Self {
        Self::Work(reason.to_string())
    }
}

/// Runs the program with the process's arguments.
#[must_use]
pub fn main() -> ExitCode {
    let words: Vec<_> = std::env::args_os().collect();
    ExitCode::from(run(&words))
}

/// Runs the program with a command line, whose first word is its own name, and returns the exit
/// code.
#[must_use]
pub fn run(words: &[OsString]) -> u8 {
    let cli = match Cli::try_parse_from(words) {
        Ok(cli) => cli,
        Err(error) => {
            // Help and the version are no errors; if nobody listens, so be it.
            let _ = error.print();
            return if error.use_stderr() { 2 } else { 0 };
        }
    };
    let result = match &cli.command {
        Command::Render(args) => render::run(args),
        Command::Check(args) => check::run(args),
        Command::Compare(args) => compare::run(args),
        Command::Export(args) => export::run(args),
        Command::Chart(args) => chart::run(args, words),
        Command::Explain(args) => explain::run(args),
    };
    let (message, code) = match result {
        Ok(()) => return 0,
        Err(Failure::Told) => return 1,
        Err(Failure::Interrupted) => return INTERRUPTED,
        Err(Failure::Work(message)) => (message, 1),
        Err(Failure::Usage(message)) => (message, 2),
    };
    report::say(format_args!("error: {message}"));
    code
}

/// Writes a line to standard output.
fn print_line(line: &str) -> Result<(), Failure> {
    writeln!(std::io::stdout(), "{line}")
        .map_err(|e| Failure::work(format_args!("cannot write to standard output: {e}")))
}
