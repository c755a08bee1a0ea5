//! `cargo xtask tidy`: what no compiler checks.

use crate::{Failure, fail};
use cargo_metadata::{DependencyKind, Metadata, MetadataCommand, Package};
use clap::CommandFactory;
use lancer_tests::paths;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// A source file with more lines probably has a second subject.
const MOST_LINES: usize = 600;

/// Crates in which these names must not even come indirectly.
const BARRED: &[(&str, &[&str])] = &[
    ("lancer-math", &["image", "rayon", "roxmltree"]),
    ("lancer-scene", &["image", "rayon", "roxmltree"]),
    // What is judged by the oracle must not lean on it.
    ("lancer", &["dashu-float", "lancer-oracle"]),
];

pub(crate) fn run() -> Result<(), Failure> {
    let problems = problems()?;
    for problem in &problems {
        eprintln!("{problem}");
    }
    match problems.len() {
        0 => Ok(()),
        n => Err(fail(format_args!("{n} things are not tidy"))),
    }
}

fn problems() -> Result<Vec<String>, Failure> {
    let metadata = MetadataCommand::new()
        .manifest_path(paths::top().join("Cargo.toml"))
        .no_deps()
        .exec()
        .map_err(fail)?;
    let mut problems = Vec::new();
    arrows(&metadata, &mut problems)?;
    barred(&mut problems)?;
    manifests(&metadata, &mut problems)?;
    sources(&mut problems)?;
    readme(&mut problems)?;
    Ok(problems)
}

fn own(metadata: &Metadata) -> Vec<&Package> {
    metadata.workspace_packages()
}

/// The arrows in ARCHITECTURE.md, a line `crate -> crate, crate` each in the
/// block marked `arrows`, are the dependencies in the manifests.
fn arrows(metadata: &Metadata, problems: &mut Vec<String>) -> Result<(), Failure> {
    let text = fs::read_to_string(paths::top().join("ARCHITECTURE.md")).map_err(fail)?;
    let block = text
        .split("```arrows\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next())
        .ok_or_else(|| fail("ARCHITECTURE.md has no block marked `arrows`"))?;
    let drawn: BTreeSet<(String, BTreeSet<String>)> = block
        .lines()
        .filter_map(|line| line.split_once("->"))
        .map(|(from, to)| {
            let to = to.split(',').map(str::trim).filter(|name| !name.is_empty());
            (from.trim().to_owned(), to.map(str::to_owned).collect())
        })
        .collect();
    let names: BTreeSet<_> = own(metadata).iter().map(|p| p.name.to_string()).collect();
    let real: BTreeSet<(String, BTreeSet<String>)> = own(metadata)
        .iter()
        .map(|package| {
            let to = package
                .dependencies
                .iter()
                .filter(|d| d.kind == DependencyKind::Normal && names.contains(&d.name));
            (package.name.to_string(), to.map(|d| d.name.clone()).collect())
        })
        .collect();
    for (from, to) in real.difference(&drawn) {
        let to: Vec<_> = to.iter().map(String::as_str).collect();
        problems.push(format!("ARCHITECTURE.md: should say `{from} -> {}`", to.join(", ")));
    }
    for (from, _) in drawn.difference(&real) {
        problems.push(format!("ARCHITECTURE.md: the arrows of `{from}` are not in its manifest"));
    }
    Ok(())
}

/// What a crate pulls in, whether directly or not, by the lock file.
fn barred(problems: &mut Vec<String>) -> Result<(), Failure> {
    let lock = fs::read_to_string(paths::top().join("Cargo.lock")).map_err(fail)?;
    let lock: toml::Table = lock.parse().map_err(fail)?;
    let packages = lock.get("package").and_then(toml::Value::as_array);
    let packages = packages.ok_or_else(|| fail("Cargo.lock lists no packages"))?;
    let name_of = |package: &toml::Value| {
        package.get("name").and_then(toml::Value::as_str).unwrap_or_default().to_owned()
    };
    for (name, barred) in BARRED {
        let (mut reached, mut open) = (BTreeSet::new(), vec![(*name).to_owned()]);
        while let Some(next) = open.pop() {
            for package in packages.iter().filter(|package| name_of(package) == next) {
                let dependencies = package.get("dependencies").and_then(toml::Value::as_array);
                // "name", or "name version" where there are several.
                let names = dependencies.into_iter().flatten().filter_map(toml::Value::as_str);
                for name in names.filter_map(|entry| entry.split(' ').next()) {
                    if reached.insert(name.to_owned()) {
                        open.push(name.to_owned());
                    }
                }
            }
        }
        if reached.is_empty() {
            problems.push(format!("Cargo.lock knows nothing of {name}"));
        }
        for name_reached in barred.iter().filter(|barred| reached.contains(**barred)) {
            problems.push(format!("{name} must not pull in {name_reached}"));
        }
    }
    Ok(())
}

/// Shared lints in each manifest; `unsafe` forbidden and a doc in each crate.
fn manifests(metadata: &Metadata, problems: &mut Vec<String>) -> Result<(), Failure> {
    for package in own(metadata) {
        let manifest = fs::read_to_string(&package.manifest_path).map_err(fail)?;
        if !manifest.contains("[lints]\nworkspace = true") {
            problems.push(format!("{}: does not take the workspace's lints", package.name));
        }
        for target in &package.targets {
            let is_root = target.is_lib() || target.is_bin();
            if !is_root {
                continue;
            }
            let root = fs::read_to_string(&target.src_path).map_err(fail)?;
            if !root.contains("#![forbid(unsafe_code)]") {
                problems.push(format!("{}: does not forbid unsafe code", target.src_path));
            }
            if !root.starts_with("//!") {
                problems.push(format!("{}: has no crate-level doc", target.src_path));
            }
            let product = package.manifest_path.as_str().contains("/crates/");
            if target.is_lib() && product && !root.contains("//! ```\n//! ") {
                problems.push(format!("{}: its doc has no example to run", target.src_path));
            }
        }
    }
    Ok(())
}

/// What must not be left in a source file.
const LEFTOVERS: &[&str] = &["todo!(", "dbg!(", "unimplemented!(", "FIXME", "#[ignore"];

fn sources(problems: &mut Vec<String>) -> Result<(), Failure> {
    let mut files = Vec::new();
    for folder in ["benches", "crates", "tests", "xtask"] {
        collect(&paths::top().join(folder), &mut files)?;
    }
    // This file names them.
    let this = paths::top().join(file!());
    for file in files {
        let text = fs::read_to_string(&file).map_err(fail)?;
        let name = file.strip_prefix(paths::top()).unwrap_or(&file).display().to_string();
        let lines = text.lines().count();
        if lines > MOST_LINES {
            problems.push(format!("{name}: {lines} lines; is there a second subject in it?"));
        }
        if file == this {
            continue;
        }
        for word in LEFTOVERS {
            if text.contains(word) {
                problems.push(format!("{name}: has `{word}`"));
            }
        }
    }
    Ok(())
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Failure> {
    for entry in fs::read_dir(folder).map_err(fail)? {
        let path = entry.map_err(fail)?.path();
        if path.is_dir() {
            collect(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    Ok(())
}

/// Each command in the README's `sh` blocks is one that exists, with arguments
/// that it takes and scenes that are there.
fn readme(problems: &mut Vec<String>) -> Result<(), Failure> {
    let text = fs::read_to_string(paths::top().join("README.md")).map_err(fail)?;
    let first = fs::read_to_string(paths::scenes().join("first.xml")).map_err(fail)?;
    if !text.contains(&first) {
        problems.push("README.md: its scene is not scenes/first.xml".to_owned());
    }
    let commands: Vec<&str> = text
        .split("```sh\n")
        .skip(1)
        .filter_map(|rest| rest.split("```").next())
        .flat_map(str::lines)
        .map(|line| line.split('#').next().unwrap_or_default().trim())
        .filter(|line| !line.is_empty())
        .collect();
    for wanted in ["cargo run --release -- render", "cargo test"] {
        if !commands.iter().any(|command| command.starts_with(wanted)) {
            problems.push(format!("README.md: no command begins with `{wanted}`"));
        }
    }
    for command in commands {
        if let Err(reason) = check_command(command) {
            problems.push(format!("README.md: `{command}`: {reason}"));
        }
    }
    Ok(())
}

fn check_command(command: &str) -> Result<(), String> {
    let words: Vec<&str> = command.split_whitespace().collect();
    let arguments = match words[..] {
        ["cargo", "run", "--release", "--", ref arguments @ ..]
        | ["lancer", ref arguments @ ..] => arguments,
        ["cargo", "xtask", ref arguments @ ..] => return parses::<crate::Cli>(arguments),
        ["cargo", "test", ..] => return Ok(()),
        _ => return Err("not a command that this check knows".to_owned()),
    };
    for scene in arguments.iter().filter(|word| word.starts_with("scenes/")) {
        if !paths::top().join(scene).is_file() {
            return Err(format!("there is no {scene}"));
        }
    }
    parses::<lancer::args::Cli>(arguments)
}

fn parses<C: CommandFactory>(arguments: &[&str]) -> Result<(), String> {
    let command = C::command().no_binary_name(true);
    match command.try_get_matches_from(arguments) {
        Err(e) if e.use_stderr() => Err(e.to_string()),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_repository_is_tidy() {
        let problems = problems().unwrap_or_else(|failure| panic!("{failure}"));
        assert!(problems.is_empty(), "{}", problems.join("\n"));
    }

    #[test]
    fn commands_that_do_not_exist_are_found() {
        assert!(check_command("cargo run --release -- render scenes/readme.xml -o a.png").is_ok());
        assert!(check_command("cargo run --release -- render scenes/gone.xml -o a.png").is_err());
        assert!(check_command("cargo run --release -- draw scenes/readme.xml").is_err());
        assert!(check_command("cargo xtask regen-goldens readme").is_ok());
        assert!(check_command("cargo xtask polish").is_err());
    }
}
