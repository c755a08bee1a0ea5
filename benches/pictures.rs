//! Small pictures with lanes of each width, on one thread.
#![forbid(unsafe_code)]

use divan::Bencher;
use divan::counter::ItemsCount;
use lancer_integrator::{KernelSettings, RenderSettings, Width, engine_by_name, render};
use lancer_scene::PixelCount;
use lancer_tests::paths::{Beside, scenes};
use lancer_xml::Options;
use std::num::NonZeroUsize;

fn main() {
    divan::main();
}

/// The names of the lanes that this processor has.
fn lanes() -> Vec<&'static str> {
    Width::available().iter().map(Width::name).collect()
}

#[divan::bench(args = lanes(), sample_count = 20)]
fn readme_classic(bencher: Bencher<'_, '_>, lanes: &str) {
    picture(bencher, lanes, "readme", "classic");
}

#[divan::bench(args = lanes(), sample_count = 10)]
fn readme_whitted(bencher: Bencher<'_, '_>, lanes: &str) {
    picture(bencher, lanes, "readme", "whitted");
}

#[divan::bench(args = lanes(), sample_count = 10)]
fn glass_whitted(bencher: Bencher<'_, '_>, lanes: &str) {
    picture(bencher, lanes, "glass", "whitted");
}

#[divan::bench(args = lanes(), sample_count = 10)]
fn meshes_whitted(bencher: Bencher<'_, '_>, lanes: &str) {
    picture(bencher, lanes, "meshes", "whitted");
}

fn picture(bencher: Bencher<'_, '_>, lanes: &str, scene: &str, engine: &str) {
    let folder = scenes();
    let bytes = std::fs::read(folder.join(scene).with_extension("xml")).expect("it is there");
    let parsed = lancer_xml::parse_with(&bytes, &Options::default(), &Beside(&folder));
    let mut scene = parsed.into_result().expect("it is valid");
    scene.camera.px_width = PixelCount::new(240).expect("it is positive");
    scene.camera.px_height = PixelCount::new(160).expect("it is positive");
    let engine = engine_by_name(engine).expect("it is built in");
    let lanes = Width::by_name(lanes).expect("the processor has them");
    let kernel = KernelSettings { lanes, ..KernelSettings::default() };
    let threads = NonZeroUsize::new(1);
    let settings = RenderSettings { kernel, threads, ..RenderSettings::default() };
    let pixels = ItemsCount::new(240_u32 * 160);
    bencher.counter(pixels).bench(|| render(&scene, engine, &settings).expect("it renders"));
}
