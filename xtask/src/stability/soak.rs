//! `--rays`: random rays of random scenes by every path, held against longer numbers.

use super::StabilityArgs;
use crate::{Failure, fail};
use lancer_tests::soak::{Id, Kind, Report, band_in_ulps, replay, soak};
use std::time::Instant;

/// So many rays of each kind are asked in turn, whole scenes: a long run tells after each such
/// round what it has found so far.
const ROUND: u64 = 100_000;

/// Asks the rays, prints what was found, and gives it to `write` as a section: after each
/// round what a run of just so many rays would say.
pub(super) fn run(
    args: &StabilityArgs,
    rays: u64,
    write: impl Fn(&str) -> Result<(), Failure>,
) -> Result<bool, Failure> {
    let kinds: Vec<Kind> = match &args.shape {
        None => Kind::all().collect(),
        Some(name) => vec![Kind::by_name(name).ok_or_else(|| {
            let names: Vec<_> = Kind::all().map(Kind::name).collect();
            fail(format_args!("there is no kind `{name}`; there are {}", names.join(", ")))
        })?],
    };
    let begun = Instant::now();
    let count = kinds.len() as u64;
    let shares: Vec<u64> = (0..count).map(|i| rays / count + u64::from(i < rays % count)).collect();
    let mut reports: Vec<Report> = Vec::new();
    println!("seed {}", args.seed);
    let rounds = rays.div_ceil(count).div_ceil(ROUND);
    for round in 0..rounds {
        let part = |kind: Kind, share: u64| {
            let range = (round * ROUND).min(share)..((round + 1) * ROUND).min(share);
            soak(kind, args.seed, range, |failure| {
                let id = failure.id.map_or_else(String::new, |id| id.to_string());
                eprintln!("{id}: {}", failure.what.lines().next().unwrap_or_default());
            })
        };
        let parts = kinds.iter().zip(&shares).map(|(kind, share)| part(*kind, *share));
        reports = if round == 0 {
            parts.collect()
        } else {
            reports.into_iter().zip(parts).map(|(report, part)| report.and(part)).collect()
        };
        let so_far: u64 = shares.iter().map(|&share| share.min((round + 1) * ROUND)).sum();
        if rounds > 1 {
            let failures: u64 = reports.iter().map(Report::failures).sum();
            let took = begun.elapsed().as_secs();
            eprintln!(
                "{so_far} of {rays} rays and those that leave them in {took} s: {failures} failures"
            );
        }
        write(&section(args, so_far, &reports))?;
    }
    print!("{}", Report::head());
    for report in &reports {
        print!("{}", report.rows(args.classes));
    }
    print!("{}", Report::rows_of_classes(&reports));
    let problems: Vec<String> = reports.iter().flat_map(Report::problems).collect();
    for problem in &problems {
        println!("{problem}");
    }
    let took = begun.elapsed().as_secs_f64();
    let asked: u64 = reports.iter().map(Report::rays).sum();
    println!(
        "{asked} rays, {} of them judged by the oracle, on {} threads in {took:.0} s: {:.1} us of a thread each",
        reports.iter().map(Report::judged).sum::<u64>(),
        rayon::current_num_threads(),
        1e6 * took * rayon::current_num_threads() as f64 / asked as f64,
    );
    Ok(problems.is_empty())
}

fn section(args: &StabilityArgs, rays: u64, reports: &[Report]) -> String {
    let shapes: String = reports.iter().map(|report| report.rows(false)).collect();
    format!(
        "`cargo run --release -p xtask -- stability --rays {rays} --seed {}`; the band is {:.0} ulp of the size of the scene seen from a ray.\n\n{}{shapes}\nThe same rays by how they were made:\n\n{}{}",
        args.seed,
        band_in_ulps(),
        Report::head(),
        Report::head(),
        Report::rows_of_classes(reports),
    )
}

/// Asks one ray again.
pub(super) fn again(id: &str) -> Result<(), Failure> {
    let id: Id = id.parse().map_err(fail)?;
    println!("{}", replay(id));
    Ok(())
}
