//! `lancer compare`

use crate::args::CompareArgs;
use crate::files::{Target, read};
use crate::{Failure, print_line};
use lancer_output::{
    Comparison, Format, Picture, compare, decode, difference_picture, encode_rgb8,
};
use serde::Serialize;
use std::path::Path;

/// What `--json` prints. Differences are in levels of 255; one that is infinite
/// is null.
#[derive(Serialize)]
struct Verdict {
    same: bool,
    max_diff: f64,
    pixels: u64,
    differing: u64,
    largest: Option<f64>,
    largest_at: Option<(u32, u32)>,
    rmse: Option<f64>,
    mean_signed: Option<f64>,
}

pub(crate) fn run(args: &CompareArgs) -> Result<(), Failure> {
    let diff = args.diff.as_deref().map(|path| diff_target(path, args)).transpose()?;
    let (a, b) = (picture(&args.a)?, picture(&args.b)?);
    let result = compare(&a, &b).map_err(Failure::work)?;
    if let Some((target, format)) = diff {
        let image = difference_picture(&a, &b).map_err(Failure::work)?;
        target.write(&encode_rgb8(&image, format).map_err(Failure::work)?)?;
    }
    let same = result.largest <= args.max_diff;
    print_line(&if args.json { json(&result, same, args)? } else { sentence(&result) })?;
    if same { Ok(()) } else { Err(Failure::Told) }
}

fn diff_target(path: &Path, args: &CompareArgs) -> Result<(Target, Format), Failure> {
    let format = Format::from_path(path).filter(|format| !format.is_linear()).ok_or_else(|| {
        Failure::Usage(format!("cannot tell a format of 8 bits from the name {}", path.display()))
    })?;
    let target = Target::new(path)?;
    if target.is_standard_output() || target.replaces(&args.a) || target.replaces(&args.b) {
        return Err(Failure::Usage("--diff needs a file of its own".to_owned()));
    }
    Ok((target, format))
}

fn picture(path: &Path) -> Result<Picture, Failure> {
    let (name, bytes) = read(path)?;
    decode(&bytes).map_err(|e| Failure::work(format_args!("{name}: {e}")))
}

fn sentence(result: &Comparison) -> String {
    let Comparison { pixels, differing, largest, rmse, mean_signed, .. } = result;
    match result.largest_at {
        None => format!("identical: all {pixels} pixels are the same"),
        Some((x, y)) => format!(
            "{differing} of {pixels} pixels differ; in levels of 255: largest difference {largest} \
             at {x},{y}, RMSE {rmse:.6}, mean {mean_signed:+.6}"
        ),
    }
}

fn json(result: &Comparison, same: bool, args: &CompareArgs) -> Result<String, Failure> {
    let finite = |value: f64| value.is_finite().then_some(value);
    serde_json::to_string_pretty(&Verdict {
        same,
        max_diff: args.max_diff,
        pixels: result.pixels,
        differing: result.differing,
        largest: finite(result.largest),
        largest_at: result.largest_at,
        rmse: finite(result.rmse),
        mean_signed: finite(result.mean_signed),
    })
    .map_err(Failure::work)
}
