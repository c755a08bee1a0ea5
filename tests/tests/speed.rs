//! Lanes gain what they should: a kernel that is not inlined into what is
//! compiled for them would be slower by far. The only test in this process, since
//! what it measures is the processor's time of all of it.

use lancer_integrator::{Engine, KernelSettings, RenderSettings, Whitted, Width, render};
use lancer_scene::{PixelCount, Scene};
use lancer_tests::paths::scenes;
use std::num::NonZeroUsize;

/// How much faster the widest lanes are at least; eight are nearly five times.
const AT_LEAST: f64 = 2.0;

#[test]
fn the_widest_lanes_are_faster_than_one() {
    let widest = Width::best();
    if !["avx2", "avx512"].contains(&widest.name()) {
        println!("skipped: lanes {} have no fused products of their own", widest.name());
        return;
    }
    let bytes = std::fs::read(scenes().join("readme.xml")).expect("the scene is there");
    let parsed = lancer_xml::parse(&bytes, &lancer_xml::Options::default());
    let mut scene = parsed.into_result().expect("the scene is valid");
    scene.camera.px_width = PixelCount::new(240).expect("positive");
    scene.camera.px_height = PixelCount::new(180).expect("positive");

    // The least of several, in turn: other work can only add to it.
    let mut least = [f64::INFINITY; 2];
    for _ in 0..7 {
        for (least, lanes) in least.iter_mut().zip([widest, Width::SCALAR]) {
            *least = least.min(seconds(&scene, &Whitted::new(), lanes));
        }
    }
    let ratio = least[1] / least[0];
    println!("{}: {ratio:.2} times faster than scalar", widest.name());
    assert!(ratio > AT_LEAST, "{} is only {ratio:.2} times faster than scalar", widest.name());
}

/// The processor's time for a picture on one thread.
fn seconds(scene: &Scene, engine: &dyn Engine, lanes: Width) -> f64 {
    let kernel = KernelSettings { lanes, ..KernelSettings::default() };
    let threads = NonZeroUsize::new(1);
    let settings = RenderSettings { kernel, threads, ..RenderSettings::default() };
    let begun = clock();
    render(scene, engine, &settings).expect("it renders");
    clock() - begun
}

/// How long the processor has worked for this process, in seconds.
#[cfg(unix)]
fn clock() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 / 1e9
}

/// Where no clock tells that, how late it is.
#[cfg(not(unix))]
fn clock() -> f64 {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    now.map_or(0.0, |since| since.as_secs_f64())
}
