//! `cargo run --release -p xtask -- bench`: how fast this is, in tables; and
//! how many instructions it takes, held against what is on record.

pub(crate) mod clock;
mod counts;
mod culling;
mod embree;
mod judge;
pub(crate) mod machine;
pub(crate) mod page;
mod peers;
mod pictures;
pub(crate) mod process;
mod python;
mod rays;
mod scaling;
mod triangles;

use crate::{Failure, fail};
use clap::Args;
use lancer_film::Film;
use lancer_integrator::{Engine, KernelSettings, RenderSettings, Whitted, render};
use lancer_scene::{PixelCount, Scene};
use lancer_tests::paths::{self, Beside};
use lancer_xml::Options;
use page::Section;
use std::num::NonZeroUsize;

/// What to measure.
#[derive(Debug, Args)]
pub(crate) struct BenchArgs {
    /// The README's scene by engines, lanes and threads, and the whole process; what is measured if
    /// nothing else is asked for
    #[arg(long)]
    pictures: bool,

    /// What each exact shortcut gains, and that it changes no bit
    #[arg(long)]
    culling: bool,

    /// Scenes of growing size: building, memory, rays
    #[arg(long)]
    scaling: bool,

    /// Meshes, with Embree on the same rays where it is installed; more of them if LANCER_MESHES
    /// names their folder
    #[arg(long)]
    triangles: bool,

    /// POV-Ray and Mitsuba on a scene like the README's, where they are installed
    #[arg(long)]
    peers: bool,

    /// All of these
    #[arg(long, conflicts_with = "counts")]
    all: bool,

    /// How often each work is repeated
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..))]
    runs: u16,

    /// The most shapes or triangles of a scene that grows
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    up_to: usize,

    /// Put the tables into docs/performance.md, in place of those of the same parts
    #[arg(long)]
    write: bool,

    /// Count the instructions of small renders instead, and compare them with xtask/counts.toml
    /// (needs valgrind)
    #[arg(long, conflicts_with_all = ["pictures", "culling", "scaling", "triangles", "peers", "write"])]
    counts: bool,

    /// Put the new counts on record
    #[arg(long, requires = "counts")]
    bless: bool,

    /// Why counts have grown
    #[arg(long, requires = "bless", value_name = "WHY")]
    reason: Option<String>,
}

impl BenchArgs {
    fn runs(&self) -> usize {
        usize::from(self.runs)
    }

    /// The flags of the parts that are measured.
    fn parts(&self) -> Vec<(&'static str, Part)> {
        let parts: [(&str, bool, Part); 5] = [
            ("--pictures", self.pictures, pictures::measure),
            ("--culling", self.culling, culling::measure),
            ("--scaling", self.scaling, scaling::measure),
            ("--triangles", self.triangles, triangles::measure),
            ("--peers", self.peers, peers::measure),
        ];
        let none = !parts.iter().any(|(_, chosen, _)| *chosen);
        let chosen = |(i, chosen): (usize, bool)| chosen || self.all || (none && i == 0);
        let parts = parts.into_iter().enumerate();
        parts.filter(|(i, p)| chosen((*i, p.1))).map(|(_, p)| (p.0, p.2)).collect()
    }
}

/// Measures and fills a section.
type Part = fn(&BenchArgs) -> Result<Section, Failure>;

pub(crate) fn run(args: &BenchArgs) -> Result<(), Failure> {
    if args.counts {
        return counts::run(args.bless, args.reason.as_deref());
    }
    if cfg!(debug_assertions) {
        return Err(fail(
            "times of a debug build say nothing: cargo run --release -p xtask -- bench",
        ));
    }
    let mut sections = Vec::new();
    for (flag, measure) in args.parts() {
        let mut section = measure(args)?;
        let up_to = match flag {
            "--scaling" => format!(" --up-to {}", args.up_to),
            _ => String::new(),
        };
        section.add(format_args!(
            "`cargo run --release -p xtask -- bench {flag} --runs {}{up_to}`: {}",
            args.runs,
            machine::description()
        ));
        sections.push(section);
    }
    if args.write { page::write(&sections) } else { Ok(()) }
}

/// The usual engine.
static WHITTED: Whitted = Whitted::new();

/// A scene of the folder `scenes`.
fn scene(name: &str) -> Result<Scene, Failure> {
    let folder = paths::scenes();
    let bytes = std::fs::read(folder.join(name)).map_err(fail)?;
    let parsed = lancer_xml::parse_with(&bytes, &Options::default(), &Beside(&folder));
    parsed.into_result().map_err(fail)
}

/// The same scene with another number of pixels.
fn sized(scene: &Scene, width: u32, height: u32) -> Result<Scene, Failure> {
    let mut scene = scene.clone();
    scene.camera.px_width = PixelCount::new(width).map_err(fail)?;
    scene.camera.px_height = PixelCount::new(height).map_err(fail)?;
    Ok(scene)
}

/// How long a picture takes, in seconds, and the picture.
fn picture(
    scene: &Scene,
    engine: &dyn Engine,
    kernel: KernelSettings,
    threads: usize,
) -> Result<(f64, Film), Failure> {
    let threads = NonZeroUsize::new(threads);
    let settings = RenderSettings { kernel, threads, ..RenderSettings::default() };
    let (seconds, rendered) = clock::seconds(|| render(scene, engine, &settings));
    Ok((seconds, rendered.map_err(fail)?.film))
}

/// Whether films are the same to the last bit.
fn same_bits(a: &Film, b: &Film) -> bool {
    let bits =
        |film: &Film| -> Vec<_> { film.pixels().iter().map(|p| p.map(f32::to_bits)).collect() };
    bits(a) == bits(b)
}
