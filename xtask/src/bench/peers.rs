//! Other renderers on a scene like the README's, in turn with ours.

use super::clock::{Samples, in_turn, number};
use super::page::{Section, Table};
use super::python::Script;
use super::{BenchArgs, picture, scene};
use crate::{Failure, fail};
use lancer_integrator::{KernelSettings, engine_by_name};
use lancer_tests::paths;
use std::path::Path;
use std::process::Command;

pub(super) const TITLE: &str = "Other renderers";

const PIXELS: [u32; 2] = [2000, 1500];

/// How to install it.
const MITSUBA: &str = "pip install mitsuba numpy, and LLVM for it: on Debian apt-get install libllvm19, and \
     DRJIT_LIBLLVM_PATH where it takes an older one";

/// Works that take turns.
enum Work {
    Lancer(&'static str),
    PovRay,
    Mitsuba,
}

pub(super) fn measure(args: &BenchArgs) -> Result<Section, Failure> {
    let mut section = Section::new(TITLE);
    let [width, height] = PIXELS;
    section.add(format_args!(
        "The README's scene (ours) and scenes like it (xtask/peers/readme.pov, xtask/peers/mitsuba_readme.py), {width}x{height}, one sample for each \
         pixel, two threads, in milliseconds: our rendering time, POV-Ray's own trace time, and Mitsuba's time for a picture after a \
         first one (it also follows light from matte surface to matte surface, so it does more). How many times longer than ours each took:",
    ));
    let folder = tempfile::tempdir().map_err(fail)?;
    let mut works = vec![Work::Lancer("classic"), Work::Lancer("whitted")];
    match Command::new("povray").arg("--version").output() {
        Ok(_) => works.push(Work::PovRay),
        Err(e) => section.add(format_args!(
            "POV-Ray was not measured: `povray` does not start: {e}; on Debian: apt-get install povray."
        )),
    }
    let mut mitsuba = match Script::start("mitsuba_readme.py", folder.path(), MITSUBA) {
        Ok(script) => {
            works.push(Work::Mitsuba);
            Some(script)
        }
        Err(missing) => {
            section.add(format_args!("Mitsuba was not measured: {missing}."));
            None
        }
    };
    let readme = scene("readme.xml")?;
    let samples = in_turn(args.runs(), &works, |work| match work {
        Work::Lancer(name) => {
            let engine = engine_by_name(name).ok_or_else(|| fail("it is built in"))?;
            Ok(picture(&readme, engine, KernelSettings::default(), 2)?.0)
        }
        Work::PovRay => pov_ray(folder.path()),
        Work::Mitsuba => match &mut mitsuba {
            Some(script) => script.seconds("render"),
            None => Err(fail("it has not started")),
        },
    })?;

    let mut table = Table::new(&["program", "ms", "times `classic`", "times `whitted`"]);
    for (work, own) in works.iter().zip(&samples) {
        let name = match work {
            Work::Lancer(engine) => format!("Lancer, {engine}"),
            Work::PovRay => "POV-Ray".to_owned(),
            Work::Mitsuba => "Mitsuba, llvm".to_owned(),
        };
        let times = |ours: &Samples| number(own.times(ours));
        table.row(vec![name, own.milliseconds(), times(&samples[0]), times(&samples[1])]);
    }
    section.add(table);
    Ok(section)
}

/// Its trace time, in seconds, as it says it.
fn pov_ray(folder: &Path) -> Result<f64, Failure> {
    let output = Command::new("povray")
        .arg(format!("+I{}", paths::top().join("xtask/peers/readme.pov").display()))
        .arg(format!("+O{}", folder.join("pov.png").display()))
        .args([format!("+W{}", PIXELS[0]), format!("+H{}", PIXELS[1])])
        .args(["-A", "-D", "+WT2"])
        .output()
        .map_err(fail)?;
    let said = String::from_utf8_lossy(&output.stderr);
    trace_seconds(&said).ok_or_else(|| fail(format_args!("POV-Ray says no trace time:\n{said}")))
}

fn trace_seconds(said: &str) -> Option<f64> {
    let line = said.lines().find(|line| line.trim_start().starts_with("Trace Time:"))?;
    line.split_once('(')?.1.split_once(" seconds")?.0.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trace_times_are_read() {
        let said = "\
Parse Time:       0 hours  0 minutes  0 seconds (0.047 seconds)
              using 1 thread(s) with 0.030 CPU-seconds total
Trace Time:       0 hours  0 minutes  3 seconds (3.046 seconds)
              using 2 thread(s) with 5.990 CPU-seconds total";
        assert_eq!(trace_seconds(said), Some(3.046));
        assert_eq!(trace_seconds("Fatal error"), None);
    }
}
