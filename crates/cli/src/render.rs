//! `lancer render`

use crate::args::{RenderArgs, is_standard};
use crate::files::{Target, read};
use crate::stats::{Seconds, Stats, Stopwatch, parts};
use crate::{Failure, interrupt, preview, report};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use lancer_film::Size;
use lancer_integrator::{RenderError, RenderSettings, Rendered, render};
use lancer_output::{Format, encode, to_rgb8};
use lancer_scene::{PixelCount, Scene};
use lancer_xml::Options;
use std::io::IsTerminal;

pub(crate) fn run(args: &RenderArgs) -> Result<(), Failure> {
    let outputs = Outputs::new(args)?;
    let mut seconds = Seconds::default();
    let mut stopwatch = Stopwatch::start();

    let (name, bytes) = read(&args.scene)?;
    seconds.read = stopwatch.lap();

    let scene = scene(&name, &bytes, args)?;
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

    let rendered = draw(&scene, args, &outputs)?;
    seconds.render = stopwatch.lap();

    if let Some((target, format)) = &outputs.picture {
        let bytes = encode(&rendered.film, *format, args.bits).map_err(Failure::work)?;
        seconds.encode = stopwatch.lap();
        if interrupt::happened() {
            return Err(interrupted());
        }
        target.write(&bytes)?;
        seconds.write = stopwatch.lap();
    }
    seconds.total = stopwatch.total();

    let stats = Stats {
        version: env!("CARGO_PKG_VERSION"),
        scene: name,
        output: args.output.as_ref().map(|path| path.display().to_string()),
        engine: args.engine.name(),
        width: frame.width,
        height: frame.height,
        crop: args.crop.map(parts),
        lights: scene.lights.len(),
        shapes: scene.shapes.len(),
        threads: rendered.threads,
        rays: rendered.counts.into(),
        frame_peak: rendered.film.frame_peak(),
        seconds,
    };
    if let Some(target) = &outputs.stats {
        target.write(stats.to_json().as_bytes())?;
    }
    if args.preview {
        preview::show(to_rgb8(&rendered.film).map_err(Failure::work)?)?;
    }
    if talks(args) {
        report::say(format_args!("{}", stats.summary()));
    }
    Ok(())
}

/// Progress and a summary are for a person at a terminal.
fn talks(args: &RenderArgs) -> bool {
    !args.quiet && std::io::stderr().is_terminal()
}

/// Where everything goes, found to be possible before the work begins.
struct Outputs {
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
    fn shows_codes(&self, args: &RenderArgs) -> bool {
        args.preview || self.picture.as_ref().is_some_and(|(_, format)| !format.is_linear())
    }
}

/// The scene that the file describes, in the size asked for.
fn scene(name: &str, bytes: &[u8], args: &RenderArgs) -> Result<Scene, Failure> {
    // With --size it does not matter how large the file's own picture is.
    let max_pixels = args.size.is_none().then_some(args.max_pixels);
    let parsed = lancer_xml::parse(bytes, &Options { max_pixels });
    let tally = report::show(name, &parsed, args.quiet);
    let Some(mut scene) = parsed.scene else {
        report::say(format_args!("{name}: {tally}"));
        return Err(Failure::Told);
    };
    if let Some(size) = args.size {
        if size.pixels() > args.max_pixels {
            return Err(Failure::Usage(format!(
                "--size {size} has {} pixels, more than --max-pixels {}",
                size.pixels(),
                args.max_pixels
            )));
        }
        let side = |value| PixelCount::new(value).map_err(Failure::work);
        scene.camera.px_width = side(size.width)?;
        scene.camera.px_height = side(size.height)?;
    }
    if !args.quiet {
        for warning in args.engine.engine().warnings(&scene) {
            report::say(format_args!("warning: {name}: {warning}"));
        }
    }
    Ok(scene)
}

fn draw(scene: &Scene, args: &RenderArgs, outputs: &Outputs) -> Result<Rendered, Failure> {
    let bar = progress_bar(args);
    let progress = |done, all| {
        bar.set_length(all);
        bar.set_position(done);
    };
    let settings = RenderSettings {
        window: args.crop,
        frame_peak: outputs.shows_codes(args),
        threads: args.threads,
        progress: Some(&progress),
        cancel: Some(interrupt::watch()),
    };
    let result = render(scene, args.engine.engine(), &settings);
    bar.finish_and_clear();
    result.map_err(|error| match error {
        RenderError::Interrupted => interrupted(),
        other => Failure::work(other),
    })
}

fn interrupted() -> Failure {
    Failure::work("interrupted; no picture was written")
}

fn progress_bar(args: &RenderArgs) -> ProgressBar {
    if !talks(args) {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{wide_bar} {percent:>3} % {eta:>4} left");
    ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::stderr_with_hz(10))
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
