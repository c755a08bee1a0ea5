//! `lancer check`

use crate::args::CheckArgs;
use crate::report::{self, Tally, count};
use crate::{Failure, files, lints, print_line};
use lancer_integrator::{Facts, RenderSettings};
use lancer_xml::Options;

pub(crate) fn run(args: &CheckArgs) -> Result<(), Failure> {
    let options = Options { max_pixels: Some(args.max_pixels) };
    let mut failed = false;
    for path in &args.scenes {
        // One file that cannot be read does not keep the others from being read.
        let (name, bytes) = match files::read(path) {
            Ok(read) => read,
            Err(failure) => {
                report::say(format_args!("error: {failure}"));
                failed = true;
                continue;
            }
        };
        let parsed = lancer_xml::parse_with(&bytes, &options, &files::BesideScene(path));
        let mut tally = report::show(&name, &parsed, false);
        if let Some(scene) = &parsed.scene {
            let engine = args.engine.engine();
            for refusal in engine.refusals(scene) {
                report::say(format_args!(
                    "error: {name}: the engine {} cannot show this scene: {refusal}",
                    engine.name()
                ));
                tally.errors += 1;
            }
            let mut found = engine.warnings(scene);
            if tally.errors == 0 {
                let plan = RenderSettings::default().plan(scene, engine);
                found.extend(lints::of_scene(scene, &Facts::of(scene), engine, &plan));
            }
            let found = lints::tell(&found, &name, &parsed.source, false).warnings;
            match &args.deny {
                Some(_) => tally.errors += found,
                None => tally.warnings += found,
            }
        }
        failed |= tally.errors > 0;
        if args.quiet {
            continue;
        }
        match &parsed.scene {
            Some(scene) if tally.errors == 0 => {
                let and =
                    if tally == Tally::default() { String::new() } else { format!("; {tally}") };
                print_line(&format!(
                    "{name}: valid, {}x{} pixels, {}, {}{and}",
                    scene.camera.px_width.get(),
                    scene.camera.px_height.get(),
                    count(scene.lights.len(), "light"),
                    count(scene.shape_count() as usize, "shape"),
                ))?;
            }
            _ => report::say(format_args!("{name}: {tally}")),
        }
    }
    if failed { Err(Failure::Told) } else { Ok(()) }
}
