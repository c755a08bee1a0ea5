//! The README's scene: engines, lanes, threads; the ratio to a transcription
//! without any shortcut; the whole process.

use super::clock::{Samples, in_turn, number, seconds};
use super::page::{Section, Table};
use super::{BenchArgs, WHITTED, picture, process, same_bits, scene, sized};
use crate::{Failure, fail};
use lancer_film::Film;
use lancer_integrator::{Classic, Direct, Engine, KernelSettings, Width};
use lancer_scene::Scene;
use lancer_tests::plain::{self, Plain};
use std::cell::RefCell;

pub(super) const TITLE: &str = "The README's scene";

/// Lanes that are slow here, and the transcription, render a picture that is so
/// many times smaller along each side.
const SMALLER: u32 = 5;

/// A way to render the scene.
struct Way {
    engine: &'static dyn Engine,
    lanes: Width,
    threads: usize,
    /// Whether the picture is a smaller one.
    small: bool,
}

/// Works that take turns.
enum Work {
    Picture(Way),
    Transcription,
}

pub(super) fn measure(args: &BenchArgs) -> Result<Section, Failure> {
    let mut section = Section::new(TITLE);
    let scene = scene("readme.xml")?;
    let (width, height) = (scene.camera.px_width.get(), scene.camera.px_height.get());
    let small = sized(&scene, width / SMALLER, height / SMALLER)?;
    let (works, samples) = rendered(&scene, &small, args.runs())?;

    let of = |engine: &str, lanes: &str, threads: usize, is_small: bool| -> &Samples {
        let is_it = |work: &Work| match work {
            Work::Picture(way) => {
                (way.engine.name(), way.lanes.name()) == (engine, lanes)
                    && (way.threads, way.small) == (threads, is_small)
            }
            Work::Transcription => false,
        };
        &samples[works.iter().position(is_it).expect("it was measured")]
    };
    section.add(format_args!(
        "Rendering alone, {width}x{height}, in milliseconds. Lanes marked * rendered {}x{}, times {}. Every film of an engine was the same to \
         the last bit.",
        small.camera.px_width.get(),
        small.camera.px_height.get(),
        SMALLER * SMALLER,
    ));
    let mut table = Table::new(&[
        "engine",
        "lanes",
        "1 thread",
        "2 threads",
        "times faster with 2",
        "times classic's, 1 thread",
        "2 threads",
    ]);
    for engine in engines() {
        for lanes in Width::available() {
            let small = is_slow(lanes);
            let scale = if small { f64::from(SMALLER * SMALLER) } else { 1.0 };
            let [one, two] = [1, 2].map(|n| of(engine.name(), lanes.name(), n, small));
            let classic = [1, 2].map(|n| of("classic", lanes.name(), n, small));
            table.row(vec![
                engine.name().to_owned(),
                format!("{}{}", lanes.name(), if small { "*" } else { "" }),
                number(one.median() * scale * 1e3),
                number(two.median() * scale * 1e3),
                number(one.times(two)),
                number(one.times(classic[0])),
                number(two.times(classic[1])),
            ]);
        }
    }
    section.add(table);

    section.add(format_args!(
        "How many times longer than `classic` on one thread the plain transcription of the original takes ({}x{} pixels):",
        small.camera.px_width.get(),
        small.camera.px_height.get(),
    ));
    let mut table = Table::new(&["lanes", "times"]);
    let plain = &samples[samples.len() - 1];
    for lanes in Width::available() {
        let ratio = plain.times(of("classic", lanes.name(), 1, true));
        table.row(vec![lanes.name().to_owned(), number(ratio)]);
    }
    section.add(table);
    process::measure(&mut section, args.runs())?;
    Ok(section)
}

fn engines() -> [&'static dyn Engine; 3] {
    [&Classic, &Direct, &WHITTED]
}

/// Whether a full picture with these lanes would take too long.
fn is_slow(lanes: Width) -> bool {
    ["scalar", "portable"].contains(&lanes.name())
}

/// Renders in all ways in turn, and the transcription at the end of each turn.
fn rendered(
    scene: &Scene,
    small: &Scene,
    runs: usize,
) -> Result<(Vec<Work>, Vec<Samples>), Failure> {
    let mut works = Vec::new();
    for engine in engines() {
        for lanes in Width::available() {
            for threads in [1, 2] {
                works.push(Work::Picture(Way { engine, lanes, threads, small: is_slow(lanes) }));
            }
            if engine.name() == "classic" && !is_slow(lanes) {
                works.push(Work::Picture(Way { engine, lanes, threads: 1, small: true }));
            }
        }
    }
    works.push(Work::Transcription);

    // The first film of each engine and size.
    let films: RefCell<Vec<(&str, Film)>> = RefCell::default();
    let samples = in_turn(runs, &works, |work| {
        let Work::Picture(way) = work else {
            return Ok(seconds(|| plain::render(small, Plain::Classic)).0);
        };
        let kernel = KernelSettings { lanes: way.lanes, ..KernelSettings::default() };
        let of = if way.small { small } else { scene };
        let (seconds, film) = picture(of, way.engine, kernel, way.threads)?;
        let mut films = films.borrow_mut();
        let name = way.engine.name();
        match films.iter().find(|(engine, f)| *engine == name && f.frame() == film.frame()) {
            None => films.push((name, film)),
            Some((_, first)) if same_bits(first, &film) => {}
            Some(_) => {
                let (lanes, threads) = (way.lanes.name(), way.threads);
                return Err(fail(format_args!(
                    "{name} differs with {lanes} and {threads} threads"
                )));
            }
        }
        Ok(seconds)
    })?;
    Ok((works, samples))
}
