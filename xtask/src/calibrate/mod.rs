//! `cargo xtask calibrate`: what renders say of their own error, held against the true one.

mod scenes;
mod summary;

use crate::bench::machine;
use crate::{Failure, fail, sections};
use clap::Args;
use lancer_integrator::{KernelSettings, Sampling};
use lancer_judge::{Caption, Reference, Subject, Trial, scatter};
use lancer_scene::{PixelCount, Scene};
use lancer_tests::paths;
use scenes::SCENES;
use std::fs;
use std::time::{Duration, Instant};
use summary::{Run, Share, report};

/// What to calibrate.
#[derive(Debug, Args)]
pub(crate) struct CalibrateArgs {
    /// Only scenes with this in their name
    #[arg(long, value_name = "NAME", conflicts_with = "write")]
    scene: Option<String>,

    /// How wide pictures are, in pixels
    #[arg(long, value_name = "N", default_value_t = 240,
          value_parser = clap::value_parser!(u32).range(16..=4000))]
    width: u32,

    /// How many seconds a reference may take, about
    #[arg(long, value_name = "S", default_value_t = 60,
          value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    longest: u64,

    /// Another seed gives another draw of the pictures
    #[arg(long, default_value_t = 0)]
    seed: u64,

    /// How many threads to use; one for each core by default
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Put the tables into docs/accuracy.md, and draw docs/accuracy/predicted.svg
    #[arg(long)]
    write: bool,
}

/// What is asked for.
const LEVELS: [f64; 4] = [0.004, 0.002, 0.001, 0.0005];

/// What a picture's pixels differ by within one, exposed, that is not called smooth: one step of
/// 8 bits.
const ROUGH: f32 = 1.0 / 255.0;

pub(crate) fn run(args: &CalibrateArgs) -> Result<(), Failure> {
    let threads = args.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(fail)?;
    let wanted = |name: &str| args.scene.as_ref().is_none_or(|part| name.contains(part.as_str()));
    let chosen: Vec<_> = SCENES.iter().filter(|(name, _)| wanted(name)).collect();
    if chosen.is_empty() {
        let names: Vec<_> = SCENES.iter().map(|(name, _)| *name).collect();
        return Err(fail(format_args!("there are {}", names.join(", "))));
    }
    let begun = Instant::now();
    let mut runs = Vec::new();
    for (scenes, (name, narrower)) in (1..).zip(&chosen) {
        let scene = sized(&scenes::load(name)?, args.width / narrower)?;
        runs.extend(pool.install(|| calibrated(name, &scene, args))?);
        // After each, so that nothing is lost where it is ended.
        if args.write {
            write(args, &runs, (scenes, chosen.len()))?;
        }
    }
    println!("{}\n{:.0} s", report(&runs, &LEVELS), begun.elapsed().as_secs_f64());
    Ok(())
}

/// Puts the tables into the page, and draws the picture in it.
fn write(args: &CalibrateArgs, runs: &[Run], (scenes, of): (usize, usize)) -> Result<(), Failure> {
    let mut command =
        format!("calibrate --width {} --longest {} --seed {}", args.width, args.longest, args.seed);
    command += &args.threads.map(|threads| format!(" --threads {threads}")).unwrap_or_default();
    let command = format!("cargo run --release -p xtask -- {command} --write");
    let so_far =
        if scenes < of { format!(" after {scenes} of {of} scenes") } else { String::new() };
    let section = format!(
        "{}\n![Predicted against true error](accuracy/predicted.svg)\n\n`{command}`{so_far}: {}",
        report(runs, &LEVELS),
        machine::description()
    );
    let points = |level: &f64| {
        let own = runs.iter().filter(|run| run.asked == *level);
        let points = own.map(|run| [run.predicted, run.truth]).collect();
        (format!("asked: {level}"), points)
    };
    let levels: Vec<_> = LEVELS.iter().map(points).collect();
    let caption = Caption {
        title: format!("Predicted and true errors of {} pictures", runs.len()),
        notes: Vec::new(),
        command,
    };
    let folder = paths::top().join("docs/accuracy");
    fs::create_dir_all(&folder).map_err(fail)?;
    fs::write(folder.join("predicted.svg"), scatter(&levels, &caption).svg()).map_err(fail)?;
    sections::write("accuracy.md", "calibration", &section)
}

/// The same scene with that width, in its own shape.
fn sized(scene: &Scene, width: u32) -> Result<Scene, Failure> {
    let mut scene = scene.clone();
    let shape = f64::from(scene.camera.px_height.get()) / f64::from(scene.camera.px_width.get());
    let height = libm::rint(f64::from(width) * shape).max(1.0) as u32;
    scene.camera.px_width = PixelCount::new(width).map_err(fail)?;
    scene.camera.px_height = PixelCount::new(height).map_err(fail)?;
    Ok(scene)
}

/// A picture for each level, and what it is like.
fn calibrated(name: &str, scene: &Scene, args: &CalibrateArgs) -> Result<Vec<Run>, Failure> {
    let subject = Subject::new(scene, None, KernelSettings::default(), None).map_err(fail)?;
    let begun = Instant::now();
    let finest = LEVELS.into_iter().fold(f64::INFINITY, f64::min);
    // As far as that can be had: its own error, which it knows, is taken out of what it finds.
    let reference =
        subject.reference(0.1 * finest, Duration::from_secs(args.longest)).map_err(fail)?;
    println!(
        "{name}, {}: {} samples a pixel, off by {:.1e}, in {:.1} s",
        subject.size(),
        reference.samples,
        reference.error,
        begun.elapsed().as_secs_f64()
    );
    let picture = |error| {
        subject
            .picture(Sampling { seed: args.seed, error: Some(error), ..Sampling::default() })
            .map_err(fail)
    };
    // Any picture is as good as that.
    let fewest = picture(1.0)?.accuracy.samples;
    let judged = |asked| {
        let run = judged(name, asked, fewest, &picture(asked)?, &reference);
        let run = run.ok_or_else(|| fail("the sizes of pictures differ"))?;
        println!("{run}");
        Ok(run)
    };
    LEVELS.into_iter().map(judged).collect()
}

/// The error of a picture that is off from a reference by `found`, which has nothing to do with
/// the reference's own.
fn without(found: f64, own: f64) -> f64 {
    (found * found - own * own).max(0.0).sqrt()
}

fn judged(
    name: &str,
    asked: f64,
    fewest: u64,
    trial: &Trial,
    reference: &Reference,
) -> Option<Run> {
    let errors = trial.picture.pixel_errors(&reference.picture)?;
    let pixels = trial.quality.pixels();
    let least = pixels.iter().map(|pixel| pixel.samples).min()?;
    let covered = |is_counted: &dyn Fn(usize) -> bool| {
        let all = errors.iter().zip(pixels).enumerate().filter(|(i, _)| is_counted(*i));
        let mut share = Share::default();
        for (_, (error, pixel)) in all {
            share.add(*error <= f64::from(pixel.interval));
        }
        share
    };
    Some(Run {
        scene: name.to_owned(),
        asked,
        predicted: trial.accuracy.predicted,
        truth: without(trial.picture.error(&reference.picture)?, reference.error),
        reference: reference.error,
        samples_a_pixel: trial.accuracy.samples as f64 / pixels.len() as f64,
        needed_more: trial.accuracy.samples > fewest,
        refined: covered(&|i| pixels[i].samples > least),
        rough: covered(&|i| reference.spreads[i] > ROUGH),
        seconds: trial.seconds,
        forecast: trial.accuracy.forecast.map(|forecast| forecast.all.as_secs_f64()),
    })
}
