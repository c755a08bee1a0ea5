//! `cargo xtask stability --cost`: what it costs that answers are right: the same work with
//! Lancer's forms and with the textbook's and a fixed smallest distance, in turn in one run.

mod groups;
mod listed;
mod tree;

use crate::bench::clock::{Samples, in_turn, number, seconds};
use crate::bench::page::Table;
use crate::{Failure, fail};
use lancer_integrator::{KernelSettings, RenderSettings, Whitted, render};
use lancer_kernel::Prepared;
use lancer_kernel::lanes::{Width, dispatch};
use lancer_math::{Point, Ray, Vector};
use lancer_scene::{PixelCount, Scene};
use lancer_tests::{generated, paths};
use listed::Ask;
use std::fmt::Write;
use std::num::NonZeroUsize;
use tree::{Follow, Tree};

const RUNS: usize = 60;
const PIXELS: [u32; 2] = [800, 600];

/// Measures: the section of the page.
pub(super) fn run() -> Result<String, Failure> {
    let mut text = format!(
        "Written by `cargo run --release -p xtask -- stability --cost --write`: nanoseconds per ray on one thread, the least of {RUNS} runs \
         in turn.\n\n",
    );
    let mut table = Table::new(&["work", "textbook, ns", "Lancer, ns", "ratio"]);
    let (extra, rays) = readme(&mut table)?;
    mesh(&mut table)?;
    let _ = writeln!(text, "{table}");
    let frame = whole_frame(&mut scene()?)?;
    let part = extra / frame;
    let _ = writeln!(
        text,
        "The textbook's forms are written for this comparison, in lanes like Lancer's, with hits nearer than 1e-9 left out. The groups of rays are those of the \
         engine's tiles; Lancer asks the shapes that it has not left out for the group, the textbook only those that rays of the group do meet, which somebody \
         must have told it. Those of the mesh are a plain tree of boxes, the same for both, one ray at a time, with Möller's and Trumbore's test or with \
         Lancer's; Lancer's own hierarchy is another.\n\n\
         In the whole picture of the README, {} x {} pixels in {} ms on one thread by `whitted`, it is {} ms for all of these {} rays: **with the textbook's \
         forms for these it would be {} times as fast**. Not compared: the points of hits, which \
         Lancer puts back onto surfaces with a bound, and transparent things.",
        PIXELS[0],
        PIXELS[1],
        number(frame * 1e3),
        number(extra * 1e3),
        rays,
        number(1.0 / (1.0 - part)),
    );
    println!("{text}");
    Ok(text)
}

fn scene() -> Result<Scene, Failure> {
    let bytes = std::fs::read(paths::scenes().join("readme.xml")).map_err(fail)?;
    lancer_xml::parse(&bytes, &lancer_xml::Options::default()).into_result().map_err(fail)
}

/// How many seconds more Lancer's forms take for all rays, and how many rays these are.
fn readme(table: &mut Table) -> Result<(f64, usize), Failure> {
    let scene = scene()?;
    let prepared = Prepared::with(&scene, &KernelSettings::default());
    let groups = groups::groups(&scene, &prepared, PIXELS);
    let names = ["README, rays from the eye", "README, rays to lamps", "README, mirrored rays"];
    let (mut extra, mut rays) = (0.0, 0);
    for ((groups, name), any) in groups.iter().zip(names).zip([false, true, false]) {
        let mut met = Vec::new();
        let samples = in_turn(RUNS, &[None, Some(&prepared)], |&ours| {
            let (time, count) = seconds(|| dispatch(Width::best(), Ask { groups, ours, any }));
            met.push(count);
            Ok(time)
        })?;
        let count = groups.iter().map(groups::Group::len).sum::<usize>() * listed::REPEATS;
        // Nearly: the fixed distance loses some.
        let differ = met[0].abs_diff(met[1]) as usize;
        if differ * 1000 > count {
            return Err(fail(format_args!("{name}: {} hits and {}", met[0], met[1])));
        }
        let [usual, ours] = [&samples[0], &samples[1]];
        let times = [usual, ours].map(Samples::least);
        // Of the whole picture.
        let all = count / listed::REPEATS * groups::ONE_IN as usize;
        extra += (times[1] - times[0]) / count as f64 * all as f64;
        rays += all;
        row(table, name, count, times);
    }
    Ok((extra, rays))
}

fn row(table: &mut Table, name: &str, rays: usize, times: [f64; 2]) {
    let ratio = times[1] / times[0];
    let [usual, ours] = times.map(|time| number(time * 1e9 / rays as f64));
    table.row(vec![name.to_owned(), usual, ours, number(ratio)]);
}

/// Hills, from above and from the side.
fn mesh(table: &mut Table) -> Result<(), Failure> {
    let tree = Tree::new(&generated::terrain(100_000));
    // Few, so that the least of many runs is one that nothing disturbed.
    let side = 80;
    let place = |i: i32| f64::from(i) / f64::from(side) * 1.8 - 0.9;
    let grid = (0..side).flat_map(|y| (0..side).map(move |x| (place(x), place(y))));
    let rays: Vec<Ray> = grid
        .map(|(x, y)| {
            let eye = Point::new(0.3, -2.5, 1.8);
            Ray::new(eye, (Point::new(x, y, 0.0) - eye).normalize())
        })
        .collect();
    let flat: Vec<Ray> = rays
        .iter()
        .map(|ray| Ray::new(ray.at(2.0), Vector::new(ray.direction.x, 0.3, -0.03)))
        .collect();
    for (name, rays) in [("100,000 triangles, from the eye", &rays), ("flat over them", &flat)] {
        let mut met = Vec::new();
        let samples = in_turn(RUNS, &[false, true], |&ours| {
            let follow = Follow { tree: &tree, rays, ours };
            let (time, count) = seconds(|| dispatch(Width::best(), follow));
            met.push(count);
            Ok(time)
        })?;
        if met[0].abs_diff(met[1]) * 1000 > rays.len() {
            return Err(fail(format_args!("{name}: {} hits and {}", met[0], met[1])));
        }
        row(table, name, rays.len(), [&samples[0], &samples[1]].map(Samples::least));
    }
    Ok(())
}

/// Seconds of the whole picture on one thread.
fn whole_frame(scene: &mut Scene) -> Result<f64, Failure> {
    let [width, height] = PIXELS.map(PixelCount::new);
    (scene.camera.px_width, scene.camera.px_height) = (width.map_err(fail)?, height.map_err(fail)?);
    let settings = RenderSettings { threads: Some(NonZeroUsize::MIN), ..RenderSettings::default() };
    let samples = in_turn(RUNS, &[()], |()| {
        let (time, rendered) = seconds(|| render(scene, &Whitted::new(), &settings));
        rendered.map_err(fail)?;
        Ok(time)
    })?;
    Ok(samples[0].least())
}
