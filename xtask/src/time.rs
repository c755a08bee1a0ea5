//! `cargo xtask time`: how fast the engine is, as a ratio to a plain
//! transcription of the original in the same run.

use crate::{Failure, fail};
use lancer_integrator::{Classic, RenderSettings, render};
use lancer_scene::{PixelCount, Scene};
use lancer_tests::paths;
use lancer_tests::plain::{self, Plain};
use lancer_xml::Options;
use std::num::NonZeroUsize;
use std::time::Instant;

/// The transcription is slow, so it renders the scene this many times smaller
/// along each side.
const SMALLER: u32 = 5;

pub(crate) fn run(runs: usize, threads: usize) -> Result<(), Failure> {
    let runs = runs.max(1);
    let threads = NonZeroUsize::new(threads).ok_or_else(|| fail("at least one thread"))?;
    let bytes = std::fs::read(paths::scenes().join("readme.xml")).map_err(fail)?;
    let scene = lancer_xml::parse(&bytes, &Options::default()).into_result().map_err(fail)?;
    let (width, height) = (scene.camera.px_width.get(), scene.camera.px_height.get());
    let mut small = scene.clone();
    small.camera.px_width = PixelCount::new(width / SMALLER).map_err(fail)?;
    small.camera.px_height = PixelCount::new(height / SMALLER).map_err(fail)?;

    let one = NonZeroUsize::MIN;
    let (mut many, mut single, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..runs {
        many.push(seconds(|| picture(&scene, threads))?);
        let ours = seconds(|| picture(&small, one))?;
        let plain = seconds(|| {
            std::hint::black_box(plain::render(&small, Plain::Classic));
            Ok(())
        })?;
        single.push(ours);
        ratios.push(plain / ours);
    }
    let scale = f64::from(SMALLER * SMALLER);
    println!("README scene, {width}x{height}, classic, {runs} runs");
    println!("  {threads} threads: {}", milliseconds(&mut many, 1.0));
    println!(
        "  1 thread, from {SMALLER} times smaller pictures: {}",
        milliseconds(&mut single, scale)
    );
    println!("  times faster than a plain transcription: {:.1} (median)", median(&mut ratios));
    Ok(())
}

fn picture(scene: &Scene, threads: NonZeroUsize) -> Result<(), Failure> {
    let settings = RenderSettings { threads: Some(threads), ..RenderSettings::default() };
    std::hint::black_box(render(scene, &Classic, &settings).map_err(fail)?);
    Ok(())
}

fn seconds(work: impl FnOnce() -> Result<(), Failure>) -> Result<f64, Failure> {
    let begun = Instant::now();
    work()?;
    Ok(begun.elapsed().as_secs_f64())
}

fn milliseconds(times: &mut [f64], scale: f64) -> String {
    let middle = median(times) * scale * 1e3;
    // Sorted by now.
    let (least, most) = (times[0] * scale * 1e3, times[times.len() - 1] * scale * 1e3);
    format!("median {middle:.0} ms (from {least:.0} to {most:.0})")
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
