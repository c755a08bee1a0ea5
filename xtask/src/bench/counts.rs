//! How many instructions small renders take, counted by valgrind: a slowdown
//! is seen on a machine that is not quiet.

use super::{machine, process};
use crate::{Failure, fail};
use lancer_tests::paths;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::process::Command;

/// By what part a count may grow before it needs a reason. Counts of the same
/// program differ by about a hundred-thousandth: by the system's random seeds,
/// and by how often the thread that waits looks up.
const MOST_GROWTH: f64 = 0.03;

/// What is counted: a scene, an engine, a size. Starting up and ending are a
/// few per cent of each.
const RENDERS: [(&str, &str, &str); 3] = [
    ("readme", "classic", "160x120"),
    ("readme", "whitted", "160x120"),
    ("meshes", "whitted", "90x60"),
];

/// Valgrind knows no AVX-512.
const LANES: [&str; 2] = ["scalar", "avx2"];

/// What stands in xtask/counts.toml.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
struct Record {
    /// The compiler that made the program.
    rustc: String,
    counts: Vec<Count>,
}

#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
struct Count {
    render: String,
    lanes: String,
    instructions: u64,
    /// Why it has grown, where it has.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
}

pub(super) fn run(bless: bool, reason: Option<&str>) -> Result<(), Failure> {
    let path = paths::top().join("xtask/counts.toml");
    let record = std::fs::read_to_string(&path).ok();
    let record: Option<Record> =
        record.map(|text| toml::from_str(&text)).transpose().map_err(fail)?;
    let rustc = machine::rustc();
    if let Some(why) = why_not(record.as_ref(), &rustc, bless) {
        println!("instruction counts: not checked: {why}");
        return Ok(());
    }
    let program = process::program(process::Build::Whole)?;
    let mut counts = Vec::new();
    for (scene, engine, size) in RENDERS {
        for lanes in LANES {
            let instructions = count(&program, [scene, engine, size], lanes)?;
            let render = format!("{scene} {engine} {size}");
            counts.push(Count { render, lanes: lanes.to_owned(), instructions, reason: None });
        }
    }
    let mut counted = Record { rustc, counts };
    let grown = compare(record.as_ref(), &counted);
    if !bless {
        return match grown.as_slice() {
            [] => Ok(()),
            _ => Err(fail(format_args!(
                "more instructions by over {} %: {}; if that is worth it: cargo xtask bench --counts --bless --reason \"...\"",
                MOST_GROWTH * 100.0,
                grown.join(", ")
            ))),
        };
    }
    if !grown.is_empty() && reason.is_none() {
        return Err(fail(format_args!("{} grew: say why with --reason", grown.join(", "))));
    }
    keep_reasons(record.as_ref(), &mut counted, &grown, reason);
    let text = toml::to_string_pretty(&counted).map_err(fail)?;
    std::fs::write(path, format!("# Written by `cargo xtask bench --counts --bless`.\n{text}"))
        .map_err(fail)
}

/// Why counts would say nothing here.
fn why_not(record: Option<&Record>, rustc: &str, bless: bool) -> Option<String> {
    if let Err(e) = Command::new("valgrind").arg("--version").output() {
        return Some(format!("valgrind does not start: {e}"));
    }
    match record {
        _ if bless => None,
        None => Some("xtask/counts.toml is not there".to_owned()),
        Some(record) if record.rustc != rustc => {
            Some(format!("the record is of {}, this is {rustc}", record.rustc))
        }
        Some(_) => None,
    }
}

/// The instructions of a whole process.
fn count(program: &Path, [scene, engine, size]: [&str; 3], lanes: &str) -> Result<u64, Failure> {
    let folder = tempfile::tempdir().map_err(fail)?;
    let scene: PathBuf = paths::scenes().join(format!("{scene}.xml"));
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .arg("render")
        .arg(&scene)
        .arg("-o")
        .arg(folder.path().join("out.ppm"))
        .args(["--engine", engine, "--size", size, "--threads", "1", "--quiet"])
        .args(process::centres(engine))
        .env("LANCER_LANES", lanes)
        .output()
        .map_err(fail)?;
    let said = String::from_utf8_lossy(&output.stderr);
    let counted =
        said.lines().find_map(|line| line.split_once("Collected :")?.1.trim().parse().ok());
    match counted {
        Some(counted) if output.status.success() => Ok(counted),
        _ => Err(fail(format_args!("valgrind counts nothing:\n{said}"))),
    }
}

/// Prints the counts beside those on record; which of them grew too much.
fn compare(record: Option<&Record>, counted: &Record) -> Vec<String> {
    let mut grown = Vec::new();
    for count in &counted.counts {
        let name = format!("{} {}", count.render, count.lanes);
        let millions = count.instructions as f64 / 1e6;
        let Some(old) = find(record, count) else {
            println!("{name}: {millions:.2} million instructions, none on record");
            continue;
        };
        let growth = count.instructions as f64 / old.instructions as f64 - 1.0;
        println!("{name}: {millions:.2} million instructions, {:+.2} %", growth * 100.0);
        if growth > MOST_GROWTH {
            grown.push(name);
        }
    }
    grown
}

fn find<'a>(record: Option<&'a Record>, count: &Count) -> Option<&'a Count> {
    let same = |old: &&Count| (&old.render, &old.lanes) == (&count.render, &count.lanes);
    record?.counts.iter().find(same)
}

/// Reasons stay beside counts until these shrink.
fn keep_reasons(
    record: Option<&Record>,
    counted: &mut Record,
    grown: &[String],
    reason: Option<&str>,
) {
    for count in &mut counted.counts {
        let name = format!("{} {}", count.render, count.lanes);
        let old = find(record, count);
        count.reason = match old {
            _ if grown.contains(&name) => reason.map(str::to_owned),
            Some(old) if count.instructions >= old.instructions => old.reason.clone(),
            _ => None,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(instructions: u64, reason: Option<&str>) -> Record {
        let (render, lanes) = ("a".to_owned(), "b".to_owned());
        let count = Count { render, lanes, instructions, reason: reason.map(str::to_owned) };
        Record { rustc: "rustc 1".to_owned(), counts: vec![count] }
    }

    #[test]
    fn only_growth_beyond_the_bound_counts() {
        let old = record(1_000_000, None);
        assert!(compare(Some(&old), &record(1_029_999, None)).is_empty());
        assert!(compare(Some(&old), &record(900_000, None)).is_empty());
        assert_eq!(compare(Some(&old), &record(1_030_001, None)), ["a b"]);
        assert!(compare(None, &record(1, None)).is_empty());
    }

    #[test]
    fn reasons_are_kept_until_counts_shrink() {
        let old = record(100, Some("checked more"));
        for (new, grown, reason) in [
            (100, vec![], Some("checked more")),
            (99, vec![], None),
            (120, vec!["a b".to_owned()], Some("anew")),
        ] {
            let mut counted = record(new, None);
            keep_reasons(Some(&old), &mut counted, &grown, Some("anew"));
            assert_eq!(counted.counts[0].reason.as_deref(), reason, "{new}");
        }
    }

    #[test]
    fn the_record_is_of_what_is_counted() {
        let text = std::fs::read_to_string(paths::top().join("xtask/counts.toml"));
        let record: Record = toml::from_str(&text.expect("it is there")).expect("it is valid");
        let recorded: Vec<_> =
            record.counts.iter().map(|c| (c.render.as_str(), c.lanes.as_str())).collect();
        let names: Vec<_> = RENDERS.iter().map(|(s, e, z)| format!("{s} {e} {z}")).collect();
        let counted: Vec<_> =
            names.iter().flat_map(|name| LANES.map(|lanes| (name.as_str(), lanes))).collect();
        assert_eq!(recorded, counted);
    }
}
