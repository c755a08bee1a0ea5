//! `--rays`: random rays of random scenes by every path, held against longer numbers.

use super::StabilityArgs;
use crate::{Failure, fail};
use lancer_tests::soak::{Id, Kind, Report, band_in_ulps, replay, soak};
use std::time::Instant;

/// Asks the rays, prints what was found, and returns it as a section.
pub(super) fn run(args: &StabilityArgs, rays: u64) -> Result<(String, bool), Failure> {
    let kinds: Vec<Kind> = match &args.shape {
        None => Kind::all().collect(),
        Some(name) => vec![Kind::by_name(name).ok_or_else(|| {
            let names: Vec<_> = Kind::all().map(Kind::name).collect();
            fail(format_args!("there is no kind `{name}`; there are {}", names.join(", ")))
        })?],
    };
    let begun = Instant::now();
    let count = kinds.len() as u64;
    let mut reports: Vec<Report> = Vec::new();
    let mut is_good = true;
    print!("seed {}\n{}", args.seed, Report::head());
    for (i, kind) in (0..).zip(kinds) {
        let share = rays / count + u64::from(i < rays % count);
        let report = soak(kind, args.seed, share, |failure| {
            let id = failure.id.map_or_else(String::new, |id| id.to_string());
            eprintln!("{id}: {}", failure.what.lines().next().unwrap_or_default());
        });
        print!("{}", report.rows(args.classes));
        for problem in report.problems() {
            is_good = false;
            println!("{problem}");
        }
        reports.push(report);
    }
    let classes = Report::rows_of_classes(&reports);
    print!("{classes}");
    let took = begun.elapsed().as_secs_f64();
    let asked: u64 = reports.iter().map(Report::rays).sum();
    let summary = format!(
        "{asked} rays, {} of them judged by the oracle, on {} threads in {took:.0} s: {:.1} us of a thread each",
        reports.iter().map(Report::judged).sum::<u64>(),
        rayon::current_num_threads(),
        1e6 * took * rayon::current_num_threads() as f64 / asked as f64,
    );
    println!("{summary}");
    let shapes: String = reports.iter().map(|report| report.rows(false)).collect();
    let section = format!(
        "`cargo run --release -p xtask -- stability --rays {rays} --seed {}`; the band is {:.0} ulp of the size of the scene seen from a ray.\n\n{}{shapes}\nThe same rays by how they were made:\n\n{}{classes}",
        args.seed,
        band_in_ulps(),
        Report::head(),
        Report::head(),
    );
    Ok((section, is_good))
}

/// Asks one ray again.
pub(super) fn again(id: &str) -> Result<(), Failure> {
    let id: Id = id.parse().map_err(fail)?;
    println!("{}", replay(id));
    Ok(())
}
