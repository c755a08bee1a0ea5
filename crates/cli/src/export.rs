//! `lancer export`

use crate::args::{ExportArgs, is_standard};
use crate::files::{Target, read};
use crate::scene::Wanted;
use crate::{Failure, report};
use lancer_export::{Exported, Format, export};
use std::path::Path;

pub(crate) fn run(args: &ExportArgs) -> Result<(), Failure> {
    let format = format(args)?;
    let target = Target::new(&args.output)?;
    if !is_standard(&args.scene) && target.replaces(&args.scene) {
        return Err(Failure::Usage(format!(
            "this would overwrite the scene {}",
            args.scene.display()
        )));
    }
    let (name, bytes) = read(&args.scene)?;
    let wanted =
        Wanted { path: &args.scene, size: None, max_pixels: args.max_pixels, quiet: args.quiet };
    let (mut scene, _) = wanted.scene(&name, &bytes)?;
    if let Some(exposure) = args.exposure {
        scene.camera.exposure = exposure;
    }
    let exported = export(&scene, format, &stem(&args.output));
    write(&exported, &target, args)?;
    if !args.quiet {
        for omission in &exported.omissions {
            report::say(format_args!("note: {name}: {omission}"));
        }
    }
    Ok(())
}

/// What was asked for, or else what the file's name says.
fn format(args: &ExportArgs) -> Result<Format, Failure> {
    args.format.or_else(|| Format::from_path(&args.output)).ok_or_else(|| {
        let formats: Vec<_> = Format::ALL.iter().map(|format| format.name()).collect();
        Failure::Usage(format!(
            "cannot tell the format from the name {}: give --format {}",
            args.output.display(),
            formats.join(" or ")
        ))
    })
}

/// What the names of other files begin with.
fn stem(output: &Path) -> String {
    output.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}

/// Files that the scene file names come first, so that it never names one that is not there.
fn write(exported: &Exported, target: &Target, args: &ExportArgs) -> Result<(), Failure> {
    let beside: Vec<Target> = if exported.files.is_empty() {
        Vec::new()
    } else if is_standard(&args.output) {
        return Err(Failure::Usage(format!(
            "in the format {} this scene needs {} beside it: write it to a file",
            exported.format.name(),
            report::count(exported.files.len(), "other file")
        )));
    } else {
        let named = exported.files.iter().map(|file| args.output.with_file_name(&file.name));
        named.map(|path| Target::new(&path)).collect::<Result<_, _>>()?
    };
    if beside.iter().any(|file| file.same_as(target) || file.replaces(&args.scene)) {
        return Err(Failure::Usage(
            "files beside the scene would overwrite it: give another name".to_owned(),
        ));
    }
    for (file, target) in exported.files.iter().zip(&beside) {
        target.write(&file.bytes)?;
    }
    target.write(exported.text.as_bytes())
}
