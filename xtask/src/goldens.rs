//! `cargo xtask regen-goldens`

use crate::{Failure, fail};
use lancer_tests::golden::{self, Golden, Verdict};
use lancer_tests::paths;
use std::fs;

/// Renders the named goldens (all if none is named) and rewrites those that
/// are no longer the same.
pub(crate) fn regenerate(names: &[String]) -> Result<(), Failure> {
    if std::env::var_os("CI").is_some() {
        return Err(fail("goldens are blessed by people who look at them, not where CI is set"));
    }
    let goldens = golden::all().map_err(|problems| {
        for problem in &problems {
            eprintln!("{problem}");
        }
        fail("the goldens are not in order")
    })?;
    let is_named = |golden: &Golden, name: &String| {
        golden.name == *name || golden.name.rsplit_once('.').is_some_and(|(scene, _)| scene == name)
    };
    for name in names {
        if !goldens.iter().any(|golden| is_named(golden, name)) {
            let all: Vec<_> = goldens.iter().map(|golden| golden.name.as_str()).collect();
            return Err(fail(format_args!("no golden `{name}`; there are {}", all.join(", "))));
        }
    }
    fs::create_dir_all(paths::goldens()).map_err(fail)?;
    for golden in &goldens {
        if !names.is_empty() && !names.iter().any(|name| is_named(golden, name)) {
            continue;
        }
        let actual = golden.render().map_err(fail)?;
        let verdict = golden.judge(&actual);
        let size = actual.len();
        match &verdict {
            Verdict::Same => println!("{}: unchanged", golden.name),
            Verdict::Differs(c) => println!(
                "{}: {} of {} pixels changed, by at most {} levels of 255; RMSE {:.4}, mean {:+.4}",
                golden.name, c.differing, c.pixels, c.largest, c.rmse, c.mean_signed
            ),
            Verdict::Unusable(reason) => println!("{}: new ({reason})", golden.name),
        }
        if !matches!(verdict, Verdict::Same) {
            if size as u64 > golden::MOST_BYTES {
                return Err(fail(format_args!(
                    "{} would have {size} bytes, more than {}: give it a smaller size",
                    golden.name,
                    golden::MOST_BYTES
                )));
            }
            let path = golden.path();
            fs::create_dir_all(path.parent().unwrap_or(&path)).map_err(fail)?;
            fs::write(path, actual).map_err(fail)?;
        }
    }
    Ok(())
}
