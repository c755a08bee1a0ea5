//! `cargo xtask plan-report`: what each rule of a plan saves.

use crate::bench::clock::{Samples, in_turn, number, seconds};
use crate::bench::{machine, page::Table};
use crate::{Failure, fail, sections};
use clap::Args;
use lancer_film::{Size, exposure_factor};
use lancer_integrator::{
    Absent, Asked, Classic, Culling, Engine, KernelSettings, Plan, RayCounts, Rgb, TILE_SIDE,
    Whitted,
};
use lancer_scene::{Camera, Colour, InvalidField, Light, PixelCount, Scene, Shape, Surface};
use lancer_tests::{generated, paths};

/// How to measure.
#[derive(Debug, Args)]
pub(crate) struct PlanReportArgs {
    /// How often each picture is made
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..))]
    runs: u16,

    /// Put the table into docs/plan.md
    #[arg(long)]
    write: bool,
}

/// A picture that is planned.
struct Subject {
    name: &'static str,
    scene: Scene,
    engine: &'static dyn Engine,
}

/// As for pictures of [`ERROR`].
static WHITTED: Whitted = Whitted::new();

pub(crate) fn run(args: &PlanReportArgs) -> Result<(), Failure> {
    if cfg!(debug_assertions) {
        return Err(fail(
            "times of a debug build say nothing: cargo run --release -p xtask -- plan-report",
        ));
    }
    let subjects = subjects()?;
    let mut ways: Vec<(&str, Way)> = vec![("as planned, ms", Way::Planned)];
    ways.push(("lights that need not be asked", Way::AllLights));
    ways.push(("shapes out of reach", Way::AllShapes));
    ways.push(("the cutoff", Way::AllRays));
    // Sorting is for large batches of rays, which pictures do not ask for.
    let switches = Culling::without_each().into_iter().filter(|(name, _)| *name != "sorted_rays");
    ways.extend(switches.map(|(name, culling)| (name, Way::Without(culling))));
    ways.push(("any (--full-model)", Way::Full));
    let mut head = vec!["without"];
    head.extend(subjects.iter().map(|subject| subject.name));
    let mut rows: Vec<Vec<String>> =
        ways.iter().map(|(name, _)| vec![(*name).to_owned()]).collect();
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(fail)?;
    for subject in &subjects {
        let column = alone
            .install(|| column(subject, &ways, usize::from(args.runs)))
            .map_err(|failure| fail(format_args!("{}: {failure}", subject.name)))?;
        for (row, cell) in rows.iter_mut().zip(column) {
            row.push(cell);
        }
    }
    let mut table = Table::new(&head);
    rows.into_iter().for_each(|row| table.row(row));
    let text = format!(
        "{table}\n`cargo run --release -p xtask -- plan-report --runs {} --write`: {}",
        args.runs,
        machine::description()
    );
    sections::show(&text, ("plan.md", "savings"), args.write)
}

/// What is left out.
#[derive(Debug, Clone, Copy)]
enum Way {
    Planned,
    /// All but lights.
    AllLights,
    /// All but shapes that no ray reaches.
    AllShapes,
    /// All but rays that do not matter.
    AllRays,
    Without(Culling),
    Full,
}

impl Way {
    const fn is_deep(self) -> bool {
        matches!(self, Self::AllRays)
    }

    fn plan(self, scene: &Scene) -> Plan {
        let asked =
            Asked { error: Some(ERROR), factor: Some(exposure_factor(0.0)), ..Asked::default() };
        let kernel = |culling| KernelSettings { culling, ..KernelSettings::default() };
        match self {
            Self::Planned | Self::AllRays => Plan::new(scene, &asked),
            Self::AllLights => Plan { dropped: Vec::new(), ..Plan::new(scene, &asked) },
            Self::AllShapes => Plan { absent: Absent::NONE, ..Plan::new(scene, &asked) },
            Self::Without(culling) => Plan::new(scene, &Asked { kernel: kernel(culling), ..asked }),
            Self::Full => Plan::new(scene, &Asked { full_model: true, ..asked }),
        }
    }
}

/// The error that pictures are planned for.
const ERROR: f64 = 0.0005;
/// Rays that together matter less than this matter in no picture.
const NOTHING: f64 = 1e-9;

/// A cell for each way: milliseconds as planned, planning and making ready included, and how many
/// times longer the others take.
fn column(subject: &Subject, ways: &[(&str, Way)], runs: usize) -> Result<Vec<String>, Failure> {
    let camera = &subject.scene.camera;
    let frame = Size::new(camera.px_width.get(), camera.px_height.get());
    let mut first: Option<Vec<Rgb>> = None;
    let most = Way::Planned.plan(&subject.scene).most();
    let is_whitted = subject.engine.name() == WHITTED.name();
    let all_rays = Whitted::with_cutoff(NOTHING).map_err(fail)?;
    let samples = in_turn(runs, ways, |(_, way)| {
        let is_deep = is_whitted && way.is_deep();
        let engine: &dyn Engine = if is_deep { &all_rays } else { subject.engine };
        let mut pixels = Vec::with_capacity(frame.pixels() as usize);
        let (took, ()) = seconds(|| {
            let tracer = engine.prepare(&subject.scene, &way.plan(&subject.scene));
            let mut counts = RayCounts::default();
            let mut tile = [[0.0; 3]; (TILE_SIDE * TILE_SIDE) as usize];
            for window in frame.window().strips(TILE_SIDE, TILE_SIDE) {
                let tile = &mut tile[..window.pixels() as usize];
                tracer.tile(window, tile, &mut counts);
                pixels.extend_from_slice(tile);
            }
        });
        let first = first.get_or_insert_with(|| pixels.clone());
        let off = first.iter().flatten().zip(pixels.iter().flatten());
        let worst = off.map(|(a, b)| f64::from((a - b).abs())).fold(0.0, f64::max);
        // Rays that are cut off see nothing brighter than what is in the picture.
        let brightest = first.iter().flatten().fold(1.0, |most: f32, v| most.max(*v));
        let cut = if is_deep { WHITTED.cutoff() * f64::from(brightest) } else { 0.0 };
        if worst > most + cut {
            return Err(fail(format_args!("a pixel is {worst:e} off, and {most:e} are stated")));
        }
        Ok(took)
    })?;
    let planned = &samples[0];
    let ratio = |(without, (_, way)): (&Samples, &(&str, Way))| match way.is_deep() && !is_whitted {
        // It has no cutoff.
        true => "-".to_owned(),
        false => number(without.times(planned)),
    };
    let ratios = samples.iter().zip(ways).skip(1).map(ratio);
    Ok(std::iter::once(planned.milliseconds()).chain(ratios).collect())
}

fn subjects() -> Result<Vec<Subject>, Failure> {
    let of = |name, file, size| -> Result<Subject, Failure> {
        Ok(Subject { name, scene: sized(file, size)?, engine: &WHITTED })
    };
    let built = |name, scene: Result<Scene, lancer_scene::InvalidScene>| {
        Ok::<_, Failure>(Subject { name, scene: scene.map_err(fail)?, engine: &WHITTED })
    };
    let mut million = generated::spheres(1_000_000).map_err(fail)?;
    (million.camera.px_width, million.camera.px_height) = (pixels(400)?, pixels(300)?);
    Ok(vec![
        of("README", "readme.xml", [1000, 750])?,
        Subject { engine: &Classic, ..of("README, classic", "readme.xml", [1000, 750])? },
        of("glass", "glass.xml", [400, 300])?,
        of("meshes", "meshes.xml", [720, 480])?,
        Subject { name: "a million spheres", scene: million, engine: &WHITTED },
        built("a full mirror", room(&[Light::lamp([2.0, -3.0, 5.0], 20.0)], 1.0))?,
        built("lights below the floor", {
            let below = (0..3).map(|k| Light::lamp([f64::from(k), 0.0, -3.0], 20.0));
            let lights: Vec<_> =
                std::iter::once(Light::lamp([2.0, -3.0, 5.0], 20.0)).chain(below).collect();
            room(&lights, 0.1)
        })?,
        built("spots that look away", {
            let away = (0..12).map(|k| {
                let at = [f64::from(k) - 6.0, -7.0, 3.0];
                Light::spot(at, [0.0, -1.0, 0.6], [10.0, 25.0], 30.0)
            });
            let lights: Vec<_> =
                std::iter::once(Light::lamp([2.0, -3.0, 5.0], 20.0)).chain(away).collect();
            room(&lights, 0.1)
        })?,
        built("shapes all around", all_around())?,
        built("lights of brightness 0", {
            let off = (0..12).map(|k| Light::lamp([f64::from(k) - 6.0, -3.0, 4.0], 0.0));
            let lights: Vec<_> =
                std::iter::once(Light::lamp([2.0, -3.0, 5.0], 20.0)).chain(off).collect();
            room(&lights, 0.1)
        })?,
        built("dim lights", {
            let far = (0..20).map(|k| Light::lamp([f64::from(k), 0.0, 200.0], 0.01));
            let lights: Vec<_> =
                std::iter::once(Light::lamp([2.0, -3.0, 5.0], 20.0)).chain(far).collect();
            room(&lights, 0.1)
        })?,
    ])
}

fn pixels(count: u32) -> Result<PixelCount, Failure> {
    PixelCount::new(count).map_err(fail)
}

fn sized(file: &str, [width, height]: [u32; 2]) -> Result<Scene, Failure> {
    let folder = paths::scenes();
    let bytes = std::fs::read(folder.join(file)).map_err(fail)?;
    let beside = paths::Beside(&folder);
    let parsed = lancer_xml::parse_with(&bytes, &lancer_xml::Options::default(), &beside);
    let mut scene = parsed.into_result().map_err(fail)?;
    (scene.camera.px_width, scene.camera.px_height) = (pixels(width)?, pixels(height)?);
    Ok(scene)
}

/// Balls on a floor, with some lights and that gloss.
fn room(
    lights: &[Result<Light, InvalidField>],
    gloss: f64,
) -> Result<Scene, lancer_scene::InvalidScene> {
    let camera = Camera::new([0.0, -6.0, 2.0], [0.0, -5.0, 1.7], 1.0, [640, 480]);
    let look = || Surface::new(Colour::WHITE).gloss(gloss);
    let mut scene = Scene::builder().camera(camera);
    scene = scene.shape(Shape::plane([0.0; 3], [0.0, 0.0, 1.0], look()));
    for k in 0..5 {
        scene = scene.shape(Shape::sphere([f64::from(k) - 2.0, 0.0, 0.5], 0.5, look()));
    }
    lights.iter().cloned().fold(scene, lancer_scene::SceneBuilder::light).build()
}

/// A hundred thousand balls and boxes on a floor, and the eye amid them.
fn all_around() -> Result<Scene, lancer_scene::InvalidScene> {
    let mut rng = fastrand::Rng::with_seed(6);
    let camera = Camera::new([0.0, 0.0, 4.0], [0.0, 1.0, 3.8], 1.0, [400, 300]);
    let look = || Surface::new(Colour::WHITE);
    let mut scene = Scene::builder()
        .camera(camera)
        .light(Light::sun([0.3, 0.2, -1.0], 1.0))
        .shape(Shape::plane([0.0; 3], [0.0, 0.0, 1.0], look()));
    for _ in 0..50_000 {
        let mut place = || 200.0 * rng.f64() - 100.0;
        let (ball, cube) = ([place(), place(), 0.4], [place(), place(), 0.4]);
        scene = scene.shape(Shape::sphere(ball, 0.4, look()));
        scene = scene.shape(Shape::cube(cube, 0.8, look()));
    }
    scene.build()
}
