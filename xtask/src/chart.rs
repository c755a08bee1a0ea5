//! `cargo xtask chart`: the charts of the docs, made by the program's own command.

use crate::bench::machine;
use crate::{Failure, fail, sections};
use clap::Args;
use lancer_tests::paths;
use std::ffi::OsString;
use std::fmt::Write;

/// Which charts to draw.
#[derive(Debug, Args)]
pub(crate) struct ChartArgs {
    /// Only charts with this in their name
    name: Option<String>,
}

/// A chart: its name, what it shows, and the words of the command behind `lancer chart`.
struct Chart {
    name: &'static str,
    about: &'static str,
    words: &'static str,
}

const CHARTS: &[Chart] = &[
    Chart {
        name: "readme",
        about: "The README's scene with lamps that all the programs have",
        words: "scenes/bench/readme-pareto.xml --size 400x300 --exposure 0 --threads 2 --peers",
    },
    Chart {
        name: "glass",
        about: "Glass",
        words: "scenes/glass.xml --size 120x90 --threads 2 --finest 0.002",
    },
    Chart {
        name: "soft_shadow",
        about: "A lamp that is a ball",
        words: "scenes/soft_shadow.xml --size 200x150 --threads 2 --finest 0.001",
    },
];

pub(crate) fn run(args: &ChartArgs) -> Result<(), Failure> {
    std::env::set_current_dir(paths::top()).map_err(fail)?;
    std::fs::create_dir_all("docs/accuracy").map_err(fail)?;
    let wanted = |chart: &&Chart| args.name.as_ref().is_none_or(|part| chart.name.contains(part));
    let charts: Vec<_> = CHARTS.iter().filter(wanted).collect();
    if charts.is_empty() {
        let names: Vec<_> = CHARTS.iter().map(|chart| chart.name).collect();
        return Err(fail(format_args!("there are {}", names.join(", "))));
    }
    for Chart { name, about, words } in charts {
        let file = format!("accuracy/{name}.svg");
        let command = format!("lancer chart {words} -o docs/{file}");
        println!("{command}");
        let words: Vec<_> = command.split_whitespace().map(OsString::from).collect();
        if lancer::run(&words) != 0 {
            return Err(fail(format_args!("there is no chart {name}")));
        }
        let mut section = String::new();
        // Writing to a string does not fail.
        let _ = write!(section, "![{about}]({file})\n\n{about}: {}", machine::description());
        sections::write("accuracy.md", name, &section)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[test]
    fn the_commands_are_ones_that_exist() {
        for Chart { name, words, .. } in CHARTS {
            let scene = words.split(' ').next().expect("a word");
            assert!(paths::top().join(scene).is_file(), "{name}");
            let words = ["lancer", "chart", "-o", "a.svg"].into_iter().chain(words.split(' '));
            let parsed = lancer::args::Cli::try_parse_from(words);
            assert!(parsed.is_ok(), "{name}: {:?}", parsed.err());
        }
    }
}
