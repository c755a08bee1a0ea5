//! Our pictures beside those that other renderers make of exported scenes: an independent
//! check of both. It is left out, and says so, where a program is not installed.

use lancer::peers::{self, Peer, PeerPicture, Setting};
use lancer_export::{Format, export};
use lancer_film::Size;
use lancer_integrator::{RenderSettings, Whitted, render};
use lancer_scene::{Exposure, PixelCount, Scene, Shadows, Spectrum, Stops};
use lancer_tests::paths::{self, Beside};
use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;
use std::time::Duration;

const TWO: NonZeroUsize = NonZeroUsize::MIN.saturating_add(1);

/// No scene here takes a tenth of it.
const TIMEOUT: Duration = Duration::from_secs(60);

/// Half a step of 16 bits, and what single precision loses of colours.
const CODES: f64 = 1.0 / 131_070.0 + 2e-6;

/// Pixels differ by less among their neighbours, in both pictures, or there is an edge.
const SMOOTH: f32 = 0.02;

/// A scene of the folder, so large; clear things let no light through to a surface, since the
/// others know no tinted shadows.
fn scene(name: &str, size: Size) -> Scene {
    let text = fs::read(paths::scenes().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    let path = paths::scenes().join(name);
    let folder = path.parent().expect("it is in a folder");
    let parsed = lancer_xml::parse_with(&text, &lancer_xml::Options::default(), &Beside(folder));
    let mut scene = parsed.scene.unwrap_or_else(|| panic!("{name} is valid"));
    scene.camera.px_width = PixelCount::new(size.width).expect("above 0");
    scene.camera.px_height = PixelCount::new(size.height).expect("above 0");
    scene.shadows = Shadows::Opaque;
    scene
}

/// What we make of it, in exposed linear values from 0 to 1; and the scene with that exposure.
fn ours(scene: &mut Scene) -> Vec<[f32; 3]> {
    let engine = Whitted::with_cutoff(1e-5).expect("in range");
    let settings = RenderSettings { for_display: true, ..RenderSettings::default() };
    let film = render(scene, &engine, &settings).unwrap_or_else(|e| panic!("{e}")).film;
    let stops = film.stops().expect("it is exposed");
    scene.camera.exposure = Exposure::Stops(Stops::new(stops).expect("in range"));
    let factor = libm::exp2(stops) as f32;
    film.pixels().iter().map(|pixel| pixel.map(|c| (c * factor).clamp(0.0, 1.0))).collect()
}

fn peer(format: Format) -> Option<Peer> {
    match peers::find(format) {
        Ok(peer) => Some(peer),
        Err(why) => {
            println!("left out: {why}");
            None
        }
    }
}

/// Pixels in whose neighbourhood nothing happens.
fn smooth(picture: &[[f32; 3]], size: Size) -> Vec<bool> {
    let (width, height) = (size.width as usize, size.height as usize);
    let is_smooth = |index: usize| {
        let (x, y) = (index % width, index / width);
        if x == 0 || y == 0 || x + 1 == width || y + 1 == height {
            return false;
        }
        (0..3).all(|channel| {
            let (mut least, mut most) = (f32::INFINITY, f32::NEG_INFINITY);
            for row in y - 1..=y + 1 {
                for column in x - 1..=x + 1 {
                    let value = picture[row * width + column][channel];
                    (least, most) = (least.min(value), most.max(value));
                }
            }
            most - least < SMOOTH
        })
    };
    (0..picture.len()).map(is_smooth).collect()
}

/// What noise and pixels that only look smooth may make of one of Mitsuba's.
const MITSUBA: f64 = 0.2;

/// How two pictures differ where both are smooth.
struct Difference {
    judged: usize,
    /// Pixels that differ by more than what is allowed.
    beyond: usize,
    largest: f64,
    at: (usize, usize),
}

fn difference(a: &[[f32; 3]], b: &[[f32; 3]], size: Size, allowed: f64) -> Difference {
    let both = smooth(a, size).into_iter().zip(smooth(b, size)).map(|(a, b)| a && b);
    let mut found = Difference { judged: 0, beyond: 0, largest: 0.0, at: (0, 0) };
    for (index, _) in both.enumerate().filter(|(_, smooth)| *smooth) {
        let off = |i: usize| f64::from((a[index][i] - b[index][i]).abs());
        let off = off(0).max(off(1)).max(off(2));
        found.judged += 1;
        found.beyond += usize::from(off > allowed);
        if off > found.largest {
            found.largest = off;
            found.at = (index % size.width as usize, index / size.width as usize);
        }
    }
    found
}

/// Holds a scene against POV-Ray. `allowed` is what may be missing beside the codes; of smooth
/// pixels `beyond` in 10,000 may be off by more, where an edge lies between samples.
fn check(povray: &Peer, name: &str, allowed: f64, beyond: usize) {
    let size = Size::new(200, 150);
    let mut scene = scene(name, size);
    let ours = ours(&mut scene);
    let exported = export(&scene, Format::PovRay, "scene");
    let picture = povray.render(&exported, size, TWO, Setting::Centres, TIMEOUT);
    let PeerPicture { linear, seconds, process_seconds, .. } =
        picture.unwrap_or_else(|e| panic!("{name}: {e}"));
    assert!(seconds <= process_seconds, "{seconds} {process_seconds}");
    let found = difference(&ours, &linear, size, CODES + allowed);
    let Difference { judged, largest, at: (x, y), .. } = found;
    println!("{name}: {judged} pixels, largest difference {largest:.1e} at {x},{y}");
    assert!(judged > ours.len() / 5, "{name}: only {judged} pixels are smooth");
    let index = y * size.width as usize + x;
    assert!(
        found.beyond * 10_000 <= beyond * judged,
        "{name}: {} of {judged} smooth pixels differ by more than {allowed:e}, most at {x},{y}: \
         {:?} and POV-Ray's {:?}",
        found.beyond,
        ours[index],
        linear[index],
    );
}

#[test]
fn pov_ray_sees_matte_things_as_we_do() {
    let Some(povray) = peer(Format::PovRay) else { return };
    // Lights of all kinds, all shapes, checkers, groups in groups, cameras of all kinds.
    for name in [
        "all_shapes.xml",
        "checkers.xml",
        "chain.xml",
        "colours.xml",
        "cornell.xml",
        "emission.xml",
        "falloff.xml",
        "instances.xml",
        "orthographic.xml",
        "spots.xml",
        "straight_down.xml",
    ] {
        check(&povray, name, 0.0, 0);
    }
    // Facets that are nearly in a plane have edges that do not look like any.
    check(&povray, "meshes.xml", 0.0, 20);
}

#[test]
fn pov_ray_sees_mirrors_and_glass_as_we_do() {
    let Some(povray) = peer(Format::PovRay) else { return };
    // It leaves out rays that count for less than 0.0001, and so do we.
    for name in ["readme.xml", "bench/readme-pareto.xml", "facing_mirrors.xml", "two_suns.xml"] {
        check(&povray, name, 2e-4, 0);
    }
    for name in ["glass.xml", "absorption.xml", "first.xml", "underwater.xml"] {
        check(&povray, name, 1e-3, 10);
    }
}

/// Its samples lie anywhere in a pixel and choose one lamp each, so that only means agree.
#[test]
fn mitsuba_sees_matte_things_as_we_do() {
    let Some(mitsuba) = peer(Format::Mitsuba) else { return };
    let size = Size::new(200, 150);
    for name in [
        "all_shapes.xml",
        "checkers.xml",
        "falloff.xml",
        "instances.xml",
        "orthographic.xml",
        "shapes/mesh.xml",
    ] {
        let mut scene = scene(name, size);
        // It would light the scene.
        scene.background = Spectrum::NONE;
        let ours = ours(&mut scene);
        let exported = export(&scene, Format::Mitsuba, "scene");
        let setting = Setting::Samples { count: 64, seed: 1 };
        let picture = mitsuba.render(&exported, size, TWO, setting, TIMEOUT);
        let theirs = picture.unwrap_or_else(|e| panic!("{name}: {e}")).linear;
        let (mut sum, mut most, mut judged) = (0.0, 0, 0);
        for (index, _) in smooth(&ours, size).iter().enumerate().filter(|(_, smooth)| **smooth) {
            let off = |i: usize| f64::from(theirs[index][i].clamp(0.0, 1.0) - ours[index][i]);
            let off = [off(0), off(1), off(2)];
            judged += 1;
            sum += off.iter().sum::<f64>() / 3.0;
            most += usize::from(off.iter().any(|off| off.abs() > MITSUBA));
        }
        let mean = sum / f64::from(judged);
        println!("{name}: {judged} pixels, mean difference {mean:+.1e}, {most} beyond {MITSUBA}");
        assert!(mean.abs() < 1e-3, "{name}: Mitsuba's pixels are brighter by {mean:e}");
        assert!(most * 50 < judged as usize, "{name}: {most} of {judged} pixels differ");
    }
}

#[test]
fn a_peer_that_takes_too_long_is_ended() {
    let Some(povray) = peer(Format::PovRay) else { return };
    let size = Size::new(4000, 3000);
    let exported = export(&scene("readme.xml", size), Format::PovRay, "scene");
    let begun = std::time::Instant::now();
    let late = povray.render(&exported, size, TWO, Setting::Centres, Duration::from_millis(300));
    assert!(matches!(late, Err(peers::PeerError::TimedOut { .. })), "{late:?}");
    assert!(begun.elapsed() < Duration::from_secs(5));
    let broken = lancer_export::Exported { text: "sphere {".to_owned(), ..exported };
    let failed = povray.render(&broken, Size::new(4, 3), TWO, Setting::Centres, TIMEOUT);
    let message = failed.expect_err("no scene").to_string();
    assert!(message.contains("POV-Ray") && message.contains("failed"), "{message}");
}

/// Each scene in the folder can be written in each language.
#[test]
fn every_scene_can_be_exported() {
    let folder = fs::read_dir(paths::scenes()).expect("it can be read");
    let names = folder.map(|entry| entry.expect("it can be read").path());
    let mut count = 0;
    for path in names.filter(|path| path.extension().is_some_and(|e| e == "xml")) {
        let name = path.file_name().map(Path::new).expect("a file").display().to_string();
        let scene = scene(&name, Size::new(40, 30));
        for format in Format::ALL {
            let exported = export(&scene, *format, "scene");
            assert!(!exported.text.contains("NaN") && !exported.text.contains("inf"), "{name}");
            assert_eq!(exported, export(&scene, *format, "scene"), "{name}");
        }
        count += 1;
    }
    assert!(count > 15);
}
