//! `lancer render`

use crate::args::{RenderArgs, is_standard};
use crate::drawing::Drawing;
use crate::files::{Target, read};
use crate::scene::Wanted;
use crate::stats::{Sampled, Seconds, Stats, Stopwatch, parts};
use crate::{Failure, asked, lints, preview, report};
use lancer_film::Size;
use lancer_integrator::{Engine, Rendered, Sampling, Trouble, Whitted, Why, Width};
use lancer_output::{Format, encode, encode_exr_with_layers, to_rgb8};
use lancer_scene::Scene;
use lancer_xml::Source;
use std::io::IsTerminal;
use std::num::NonZeroUsize;

pub(crate) fn run(args: &RenderArgs) -> Result<(), Failure> {
    let outputs = Outputs::new(args)?;
    let sampling = sampling(args)?;
    let whitted = sampling.as_ref().map(|sampling| asked::whitted(args.cutoff, sampling));
    let engine = whitted.as_ref().map_or(args.engine.engine(), |whitted| whitted);
    let lanes = Width::from_environment()
        .map_err(|error| Failure::Usage(format!("LANCER_LANES: {error}")))?;
    let mut seconds = Seconds::default();
    let mut stopwatch = Stopwatch::start();

    let (name, bytes) = read(&args.scene)?;
    seconds.read = stopwatch.lap();

    let (scene, source, warnings) = scene(&name, &bytes, args, engine)?;
    let frame = Size::new(scene.camera.px_width.get(), scene.camera.px_height.get());
    let kept = args.crop.unwrap_or_else(|| frame.window());
    if let Some((_, format)) = &outputs.picture
        && let Some(most) = format.longest_side()
        && kept.width.max(kept.height) > most
    {
        return Err(Failure::Work(format!(
            "pictures in the format {} have at most {most} pixels along a side: choose another \
             format, such as png",
            format.name()
        )));
    }
    if let Some(crop) = args.crop.filter(|crop| !crop.fits(frame)) {
        return Err(Failure::Usage(format!(
            "--crop {crop} reaches out of the picture, which has {frame} pixels"
        )));
    }
    seconds.parse = stopwatch.lap();

    start_threads(args)?;
    let drawing = Drawing { args, scene: &scene, engine, sampling, lanes, outputs: &outputs };
    if args.deny.is_some() && drawing.lints(&name, &source) + warnings > 0 {
        return Err(Failure::Work(format!("{name} is refused by --deny lints")));
    }
    let rendered = drawing.draw()?;
    let lint = lints::of_picture(&rendered.film);
    if !args.quiet {
        tell_troubles(&name, &rendered);
        if let Some(lint) = lint {
            report::say(format_args!("warning: {name}: {lint}"));
            if args.deny.is_none() {
                drawing.lints(&name, &source);
            }
        }
    }
    seconds.render = stopwatch.lap();

    if let Some((target, format)) = &outputs.picture {
        let Rendered { film, layers, quality, .. } = &rendered;
        let bytes = match &args.layers {
            Some(kinds) => {
                encode_exr_with_layers(film, layers.as_ref(), quality.as_ref(), &kinds.0)
            }
            None => encode(film, *format, args.bits),
        };
        let bytes = bytes.map_err(Failure::work)?;
        seconds.encode = stopwatch.lap();
        target.write(&bytes)?;
        seconds.write = stopwatch.lap();
    }
    seconds.total = stopwatch.total();

    let sampled = sampling.as_ref().zip(rendered.accuracy.as_ref()).map(|(sampling, accuracy)| {
        Sampled::new(sampling, accuracy, kept.pixels(), seconds.render)
    });
    let stats = Stats {
        version: env!("CARGO_PKG_VERSION"),
        scene: name,
        output: args.output.as_ref().map(|path| path.display().to_string()),
        engine: args.engine.name(),
        width: frame.width,
        height: frame.height,
        crop: args.crop.map(parts),
        lights: scene.lights.len(),
        shapes: scene.shape_count(),
        threads: rendered.threads,
        lanes: lanes.name(),
        rays: rendered.counts.into(),
        frame_peak: rendered.film.frame_peak(),
        exposure: rendered.film.stops(),
        cutoff: whitted.map(|whitted| whitted.cutoff()),
        sampling: sampled,
        troubles: rendered.counts.troubles.into(),
        seconds,
    };
    if let Some(target) = &outputs.stats {
        target.write(stats.to_json().as_bytes())?;
    }
    if args.preview {
        preview::show(to_rgb8(&rendered.film).map_err(Failure::work)?)?;
    }
    let was_cut_short = rendered.accuracy.is_some_and(|known| known.stopped == Why::Interrupted);
    if was_cut_short {
        report::say(format_args!("interrupted: this is the picture so far"));
    }
    if !args.quiet {
        report::say(format_args!("{}", stats.summary(kept)));
    }
    if was_cut_short {
        return Err(Failure::Interrupted);
    }
    match lint.filter(|_| args.deny.is_some()) {
        Some(lint) => Err(Failure::Work(format!("{}: {lint}", stats.scene))),
        None => Ok(()),
    }
}

/// Where everything goes, found to be possible before the work begins.
pub(crate) struct Outputs {
    picture: Option<(Target, Format)>,
    stats: Option<Target>,
}

impl Outputs {
    fn new(args: &RenderArgs) -> Result<Self, Failure> {
        let usage = |message: String| Err(Failure::Usage(message));
        let picture = match &args.output {
            None => None,
            Some(path) => {
                let standard = is_standard(path);
                let by_name = if standard { Some(Format::Ppm) } else { Format::from_path(path) };
                let Some(format) = args.format.or(by_name) else {
                    let formats: Vec<_> = Format::ALL.iter().map(|(f, _)| f.name()).collect();
                    return usage(format!(
                        "cannot tell the format from the name {}: give --format, or one of the \
                         extensions {}",
                        path.display(),
                        formats.join(", ")
                    ));
                };
                if args.bits == lancer_output::Bits::Sixteen
                    && !format.has_16_bits()
                    && !format.is_linear()
                {
                    return usage(format!(
                        "--bits 16: the format {} has 8 bits for each component; ppm, png and \
                         tiff have 16",
                        format.name()
                    ));
                }
                if args.layers.is_some() && format != Format::Exr {
                    return usage(format!(
                        "--layers: the format {} has none; write an EXR picture",
                        format.name()
                    ));
                }
                if standard && std::io::stdout().is_terminal() {
                    return usage(
                        "standard output is a terminal: send the picture to a file or a pipe, or \
                         use --preview"
                            .to_owned(),
                    );
                }
                Some((Target::new(path)?, format))
            }
        };
        let stats = args.stats.as_deref().map(Target::new).transpose()?;
        let picture_target = picture.as_ref().map(|(target, _)| target);

        let targets = [picture_target, stats.as_ref()];
        if let [Some(picture), Some(stats)] = targets
            && picture.same_as(stats)
        {
            return usage("the picture and --stats need two different files".to_owned());
        }
        if !is_standard(&args.scene)
            && targets.into_iter().flatten().any(|target| target.replaces(&args.scene))
        {
            return usage(format!("this would overwrite the scene {}", args.scene.display()));
        }
        if args.preview {
            if targets.into_iter().flatten().any(Target::is_standard_output) {
                return usage("--preview and `-` both need standard output".to_owned());
            }
            if !preview::is_possible() {
                return usage("--preview needs a terminal on standard output".to_owned());
            }
        }
        Ok(Self { picture, stats })
    }

    /// Whether values are turned into codes for a display.
    pub(crate) fn shows_codes(&self, args: &RenderArgs) -> bool {
        args.preview || self.picture.as_ref().is_some_and(|(_, format)| !format.is_linear())
    }
}

/// The scene that the file describes, and how much the engine warns about, which is told.
fn scene(
    name: &str,
    bytes: &[u8],
    args: &RenderArgs,
    engine: &dyn Engine,
) -> Result<(Scene, Source, usize), Failure> {
    let wanted = Wanted {
        path: &args.scene,
        size: args.size,
        max_pixels: args.max_pixels,
        quiet: args.quiet,
    };
    let (scene, source) = wanted.scene(name, bytes)?;
    // Where nobody listens the scene is not looked through.
    let is_heard = !args.quiet || args.deny.is_some();
    let warnings = if is_heard { engine.warnings(&scene) } else { Vec::new() };
    let warnings = lints::tell(&warnings, name, &source, args.quiet).warnings;
    Ok((scene, source, warnings))
}

/// What is asked about samples, of the engine that has them; others take nothing that is about
/// samples, exposure, layers or a cutoff.
fn sampling(args: &RenderArgs) -> Result<Option<Sampling>, Failure> {
    if args.engine.name() == WHITTED {
        return args.asked.sampling().map(Some).map_err(Failure::Usage);
    }
    let given = [
        args.exposure.is_some().then_some("--exposure"),
        args.layers.is_some().then_some("--layers"),
        args.cutoff.is_some().then_some("--cutoff"),
        args.asked.first_given(),
    ];
    match given.into_iter().flatten().next() {
        None => Ok(None),
        Some(what) => {
            let name = args.engine.name();
            Err(Failure::Usage(format!(
                "{what} means nothing to the engine {name}, only to {WHITTED}"
            )))
        }
    }
}

pub(crate) const WHITTED: &str = "whitted";

/// Says where the picture is wrong.
fn tell_troubles(name: &str, rendered: &Rendered) {
    let tell = |trouble: &Trouble, what: &str, remedy: &str| {
        if let Some((x, y)) = trouble.first {
            let count = trouble.count;
            report::say(format_args!(
                "warning: {name}: {what} ({count} times, first in pixel {x},{y}): {remedy}"
            ));
        }
    };
    let troubles = &rendered.counts.troubles;
    tell(
        &troubles.media,
        "rays left a medium that they had not entered, or entered one twice",
        "close the transparent shape there, or make it thin=\"true\"",
    );
    let (deepest, most) = (Whitted::DEEPEST, Whitted::MOST_RAYS);
    tell(
        &troubles.given_up,
        &format!(
            "in some pixels rays still mattered after {deepest} surfaces, or {most} rays, and were given up"
        ),
        "raise --cutoff, or let mirrors and media take away more",
    );
    tell(
        &troubles.not_finite,
        "colours were no finite numbers and are black",
        "look for brightnesses, coordinates or emissions that are far too large",
    );
}

/// Starts the threads that everything from here on is done with, so many as the
/// arguments say.
fn start_threads(args: &RenderArgs) -> Result<(), Failure> {
    let threads = args.threads.map_or(0, NonZeroUsize::get);
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global()
        .map_err(|error| Failure::work(format_args!("could not start the threads: {error}")))
}
