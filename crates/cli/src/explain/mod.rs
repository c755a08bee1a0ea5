//! `lancer explain`

mod args;
mod drawing;
mod json;
mod lines;
mod text;

pub use args::ExplainArgs;

use crate::args::is_standard;
use crate::files::{Target, read};
use crate::scene::Wanted;
use crate::{Failure, report};
use lancer_film::{Size, Window};
use lancer_integrator::{Engine, KernelSettings, RayTree, RenderSettings, Whitted, Width, render};
use lancer_output::to_rgb8;
use lancer_scene::{Exposure, Light, Scene};
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
    let scene = wanted.scene(&name, &bytes)?;
    let engine = args.cutoff.unwrap_or_default();
    if !args.quiet {
        for warning in engine.warnings(&scene) {
            report::say(format_args!("warning: {name}: {warning}"));
        }
    }
    let frame = Size::new(scene.camera.px_width.get(), scene.camera.px_height.get());
    let (x, y) = args.pixel;
    if x >= frame.width || y >= frame.height {
        return Err(Failure::Usage(format!(
            "--pixel {x},{y} is not in the picture, which has {frame} pixels: columns 0 to {}, rows 0 \
             to {}",
            frame.width - 1,
            frame.height - 1
        )));
    }
    let tree = engine.explain_pixel(&scene, &kernel, args.pixel);
    let explained = Explained {
        shown: shown(&scene, &engine, args, kernel)?,
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
    std::io::stdout()
        .write_all(told.as_bytes())
        .map_err(|e| Failure::work(format_args!("cannot write to standard output: {e}")))
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
    args: &ExplainArgs,
    kernel: KernelSettings,
) -> Result<Option<Shown>, Failure> {
    let exposure = args.exposure.unwrap_or(scene.camera.exposure);
    if args.exposure.is_none() && exposure == Exposure::Auto {
        return Ok(None);
    }
    // Exposing and encoding is left to those who do it for pictures.
    let (x, y) = args.pixel;
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
