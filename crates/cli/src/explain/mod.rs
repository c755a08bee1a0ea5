//! `lancer explain`

mod args;
mod drawing;
mod json;
mod lines;
mod plan;
mod text;

pub use args::ExplainArgs;

use crate::args::is_standard;
use crate::files::{Target, read};
use crate::render::WHITTED;
use crate::scene::Wanted;
use crate::{Failure, lints, report};
use lancer_film::{Quality, Size, Window};
use lancer_integrator::{
    Engine, Facts, KernelSettings, RayTree, RenderSettings, Sampling, Whitted, Width, render,
};
use lancer_output::to_rgb8;
use lancer_scene::{Exposure, Light, PixelCount, Scene};
use lancer_xml::Source;
use std::io::Write;

pub(crate) fn run(args: &ExplainArgs) -> Result<(), Failure> {
    let targets = Targets::new(args)?;
    let lanes = Width::from_environment()
        .map_err(|error| Failure::Usage(format!("LANCER_LANES: {error}")))?;
    let kernel = KernelSettings { lanes, ..KernelSettings::default() };
    let (name, bytes) = read(&args.scene)?;
    let wanted = Wanted {
        path: &args.scene,
        size: args.size,
        max_pixels: args.max_pixels,
        quiet: args.quiet,
    };
    let (scene, source) = wanted.scene(&name, &bytes)?;
    let Some(pixel) = args.pixel else {
        return explain_plan(args, (&name, &source), &scene, kernel);
    };
    let engine = args.cutoff.unwrap_or_default();
    if !args.quiet {
        lints::tell(&engine.warnings(&scene), &name, &source, false);
    }
    let frame = Size::new(scene.camera.px_width.get(), scene.camera.px_height.get());
    let (x, y) = pixel;
    if x >= frame.width || y >= frame.height {
        return Err(Failure::Usage(format!(
            "--pixel {x},{y} is not in the picture, which has {frame} pixels: columns 0 to {}, rows 0 \
             to {}",
            frame.width - 1,
            frame.height - 1
        )));
    }
    let tree = engine.explain_pixel(&scene, &kernel, pixel);
    let explained = Explained {
        shown: shown(&scene, &engine, (args, pixel), kernel)?,
        name,
        frame,
        cutoff: engine.cutoff(),
        lights: scene.lights.iter().map(kind).collect(),
        tree,
    };
    if let Some(target) = &targets.obj {
        target.write(lines::obj(&explained).as_bytes())?;
    }
    if let Some(target) = &targets.svg {
        target.write(drawing::svg(&explained).as_bytes())?;
    }
    let told = match args.json {
        true => json::json(&explained),
        false => text::text(&explained, if args.all { usize::MAX } else { text::MOST_LINES }),
    };
    print(&told)
}

fn print(text: &str) -> Result<(), Failure> {
    std::io::stdout()
        .write_all(text.as_bytes())
        .map_err(|e| Failure::work(format_args!("cannot write to standard output: {e}")))
}

/// The longer side of the picture whose rays are counted, and its pixels that one sample settles.
const SMALL: u32 = 96;
/// Its error.
const ROUGH: f64 = 0.01;

/// Tells what is done for the scene, and what is left out; and what is probably not meant.
fn explain_plan(
    args: &ExplainArgs,
    (name, source): (&str, &Source),
    scene: &Scene,
    kernel: KernelSettings,
) -> Result<(), Failure> {
    let engine = args.cutoff.unwrap_or_else(|| Whitted::for_error(Some(args.error)));
    let sampling = Sampling { error: Some(args.error), ..Sampling::default() };
    let settings = RenderSettings {
        exposure: args.exposure,
        sampling: Some(sampling),
        kernel,
        full_model: args.full_model,
        ..RenderSettings::default()
    };
    let plan = settings.plan(scene, &engine);
    let facts = Facts::of(scene);
    if !args.quiet {
        let found = lints::of_scene(scene, &facts, &engine, &plan);
        let found = [engine.warnings(scene), found].concat();
        lints::tell(&found, name, source, false);
    }
    let mut small = scene.clone();
    let [width, height] = [scene.camera.px_width.get(), scene.camera.px_height.get()];
    let shrunk = |side: u32| {
        let side = u64::from(side) * u64::from(SMALL) / u64::from(width.max(height).max(SMALL));
        PixelCount::new(side.max(1) as u32).map_err(Failure::work)
    };
    (small.camera.px_width, small.camera.px_height) = (shrunk(width)?, shrunk(height)?);
    // Rough, so that it does not take long.
    let rough = Sampling { error: Some(args.error.max(ROUGH)), ..sampling };
    let rough = RenderSettings { sampling: Some(rough), quality: true, ..settings };
    let rendered = render(&small, &engine, &rough).map_err(Failure::work)?;
    let pixels = rendered.quality.as_ref().map_or(&[][..], Quality::pixels);
    let settled = pixels.iter().filter(|pixel| pixel.samples == 1).count();
    let planned = plan::Planned {
        name,
        scene,
        facts: &facts,
        plan: &plan,
        parts: &plan.parts(scene, &facts, &engine),
        engine: WHITTED,
        cutoff: engine.cutoff(),
        error: args.error,
        strategy: sampling.strategy,
        settled: settled as f64 / pixels.len().max(1) as f64,
        counts: rendered.counts,
    };
    print(&if args.json { plan::json(&planned) } else { plan::text(&planned) })
}

/// A pixel's rays, and what they belong to.
struct Explained {
    /// The scene's.
    name: String,
    frame: Size,
    cutoff: f64,
    /// What kinds of lights there are, in the order of the file.
    lights: Vec<&'static str>,
    tree: RayTree,
    shown: Option<Shown>,
}

impl Explained {
    /// What that light, counted from 1, is called.
    fn light(&self, number: usize) -> String {
        let kind = number.checked_sub(1).and_then(|index| self.lights.get(index));
        format!("{} {number}", kind.copied().unwrap_or("light"))
    }

    /// The pixel and its scene; names of files may hold anything.
    fn title(&self) -> String {
        let [x, y] = self.tree.pixel;
        let printable = |c| if report::is_printable(c) { c } else { '?' };
        let name: String = self.name.chars().map(printable).collect();
        format!("pixel {x},{y} of {name} ({} pixels)", self.frame)
    }
}

/// How a pixel is shown.
struct Shown {
    stops: f64,
    /// Red, green and blue as codes of sRGB.
    codes: [u8; 3],
}

const fn kind(light: &Light) -> &'static str {
    match light {
        Light::Lamp { .. } => "lamp",
        Light::Sun { .. } => "sun",
        Light::Spot { .. } => "spot",
    }
}

/// How the pixel is shown, by what was asked for or else by the camera. Only who asks for an automatic
/// exposure has the picture looked at for it.
fn shown(
    scene: &Scene,
    engine: &Whitted,
    (args, (x, y)): (&ExplainArgs, (u32, u32)),
    kernel: KernelSettings,
) -> Result<Option<Shown>, Failure> {
    let exposure = args.exposure.unwrap_or(scene.camera.exposure);
    if args.exposure.is_none() && exposure == Exposure::Auto {
        return Ok(None);
    }
    // Exposing and encoding is left to those who do it for pictures.
    let window = Window { x, y, width: 1, height: 1 };
    let settings = RenderSettings {
        window: Some(window),
        for_display: true,
        exposure: Some(exposure),
        kernel,
        ..RenderSettings::default()
    };
    let rendered = render(scene, engine, &settings).map_err(Failure::work)?;
    let picture = to_rgb8(&rendered.film).map_err(Failure::work)?;
    let codes = picture.get_pixel(0, 0).0;
    Ok(rendered.film.stops().map(|stops| Shown { stops, codes }))
}

/// Where files go, found to be possible before the work begins.
struct Targets {
    obj: Option<Target>,
    svg: Option<Target>,
}

impl Targets {
    fn new(args: &ExplainArgs) -> Result<Self, Failure> {
        let target = |path: &Option<_>| path.as_deref().map(Target::new).transpose();
        let (obj, svg) = (target(&args.obj)?, target(&args.svg)?);
        let all = || [&obj, &svg].into_iter().flatten();
        if all().any(Target::is_standard_output) {
            return Err(Failure::Usage(
                "standard output has the rays already: write --obj and --svg to files".to_owned(),
            ));
        }
        if !is_standard(&args.scene) && all().any(|target| target.replaces(&args.scene)) {
            return Err(Failure::Usage(format!(
                "this would overwrite the scene {}",
                args.scene.display()
            )));
        }
        if obj.as_ref().zip(svg.as_ref()).is_some_and(|(a, b)| a.same_as(b)) {
            return Err(Failure::Usage("--obj and --svg need two different files".to_owned()));
        }
        Ok(Self { obj, svg })
    }
}
