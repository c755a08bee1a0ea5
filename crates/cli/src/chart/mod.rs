//! `lancer chart`

mod args;
mod rivals;

pub use args::ChartArgs;

use crate::args::is_standard;
use crate::files::{Target, read};
use crate::scene::Wanted;
use crate::{Failure, interrupt, print_line, report};
use args::Picture;
use lancer_film::Size;
use lancer_integrator::{KernelSettings, RenderError, Width};
use lancer_judge::{Caption, Comparison, Ladder, Reference, Series, Subject, csv, draw, html};
use lancer_output::{Format, encode_rgb8};
use lancer_scene::{Exposure, Scene};
use std::ffi::OsString;
use std::io::IsTerminal;
use std::num::NonZeroUsize;
use std::time::Duration;

/// No picture of the comparison may take longer, as far as that can be told.
const LONGEST: Duration = Duration::from_secs(20);

/// Nor may the reference.
const LONGEST_REFERENCE: Duration = Duration::from_secs(300);

/// A median of so many is not one that something else slowed down.
const DRAWS: u32 = 3;

/// `words` are those of the command line, for the caption.
pub(crate) fn run(args: &ChartArgs, words: &[OsString]) -> Result<(), Failure> {
    let outputs = Outputs::new(args)?;
    let lanes = Width::from_environment()
        .map_err(|error| Failure::Usage(format!("LANCER_LANES: {error}")))?;
    let (name, bytes) = read(&args.scene)?;
    let wanted = Wanted {
        path: &args.scene,
        size: args.size,
        max_pixels: args.max_pixels,
        quiet: args.quiet,
    };
    let (scene, _) = wanted.scene(&name, &bytes)?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(args.threads.map_or(0, NonZeroUsize::get))
        .build()
        .map_err(|error| Failure::work(format_args!("could not start the threads: {error}")))?;
    let kernel = KernelSettings { lanes, ..KernelSettings::default() };
    let size = Size::new(scene.camera.px_width.get(), scene.camera.px_height.get());
    let (comparison, notes) = pool.install(|| compared(args, scene, kernel))?;
    let caption = Caption {
        title: format!("{name}, {size}, {}", threads(pool.current_num_threads())),
        notes,
        command: command(words),
    };
    outputs.write(&comparison, &caption)?;
    if !outputs.take_standard_output()
        && let Some(advice) = comparison.advice()
    {
        print_line(&advice)?;
    }
    Ok(())
}

/// What all reach, and what is to be said of it.
fn compared(
    args: &ChartArgs,
    mut scene: Scene,
    kernel: KernelSettings,
) -> Result<(Comparison, Vec<String>), Failure> {
    let told = Told { quiet: args.quiet };
    let cancel = Some(interrupt::watch());
    let exposed = Subject::new(&scene, args.exposure, kernel, cancel).map_err(failure)?;
    scene.camera.exposure = Exposure::Stops(exposed.stops);
    let subject = Subject::new(&scene, None, kernel, cancel).map_err(failure)?;
    told.step("the reference");
    // A tenth of the error of the best picture, which may be half of what it is asked for.
    let reference = subject.reference(0.05 * args.finest, LONGEST_REFERENCE).map_err(failure)?;
    let ladder = Ladder { finest: args.finest, longest: LONGEST, draws: DRAWS };
    let mut series = Vec::new();
    for strategy in args.strategies() {
        told.step(strategy.name());
        series.push(subject.series(strategy, &ladder, &reference).map_err(failure)?);
    }
    let mut notes = vec![note_of_reference(&subject, &reference)];
    if args.peers {
        let threads = NonZeroUsize::new(rayon::current_num_threads());
        let setup = rivals::Setup {
            scene: &scene,
            size: subject.size(),
            threads: threads.unwrap_or(NonZeroUsize::MIN),
            step: &|what| told.step(what),
        };
        let (rivals, said) = rivals::series(&setup)?;
        series.extend(rivals);
        notes.extend(said);
    }
    let comparison = Comparison::new(series);
    notes.extend(note_of_peers(&comparison));
    Ok((comparison, notes))
}

fn failure(error: RenderError) -> Failure {
    match error {
        RenderError::Interrupted => interrupted(),
        other => Failure::work(other),
    }
}

fn interrupted() -> Failure {
    report::say(format_args!("error: interrupted; no chart was written"));
    Failure::Interrupted
}

/// A person at a terminal is told what is being done.
struct Told {
    quiet: bool,
}

impl Told {
    fn step(&self, what: &str) {
        if !self.quiet && std::io::stderr().is_terminal() {
            report::say(format_args!("{what} ..."));
        }
    }
}

fn threads(threads: usize) -> String {
    report::count(threads, "thread")
}

fn note_of_reference(subject: &Subject<'_>, reference: &Reference) -> String {
    format!(
        "Errors are held against {} stratified samples a pixel, which are off by {} themselves; \
         exposure {} stops. Times are medians of {DRAWS} draws.",
        reference.samples,
        lancer_judge::error(reference.error),
        subject.stops.get(),
    )
}

/// By how much peers are slower, from the least to the most.
fn note_of_peers(comparison: &Comparison) -> Vec<String> {
    let times = comparison.times_faster();
    let peers = comparison.series().iter().filter(|series| series.is_peer);
    peers
        .filter_map(|Series { name, .. }| {
            let own = times.iter().filter(|(peer, ..)| peer == name).map(|(.., times)| *times);
            let (least, most) = own.fold(None, |range: Option<(f64, f64)>, times| {
                let (least, most) = range.unwrap_or((times, times));
                Some((least.min(times), most.max(times)))
            })?;
            Some(format!(
                "{name} takes {least:.0} to {most:.0} times as long as the front for an error no \
                 smaller."
            ))
        })
        .collect()
}

/// The command line, with quotation marks where a shell needs them.
fn command(words: &[OsString]) -> String {
    let quoted = |word: &OsString| {
        let word = word.to_string_lossy().into_owned();
        let is_plain =
            |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | ',' | '/' | '-' | '_' | '=');
        if !word.is_empty() && word.chars().all(is_plain) {
            word
        } else {
            format!("'{}'", word.replace('\'', "'\\''"))
        }
    };
    let words = words.iter().skip(1).map(quoted);
    std::iter::once("lancer".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}

/// Where the chart goes, found to be possible before the work begins.
struct Outputs {
    picture: Option<(Target, Picture)>,
    table: Option<Target>,
}

impl Outputs {
    fn new(args: &ChartArgs) -> Result<Self, Failure> {
        let picture = match &args.output {
            None => None,
            Some(path) => {
                let kind = Picture::from_path(path).ok_or_else(|| {
                    Failure::Usage(format!(
                        "cannot tell the format from the name {}: charts end in .svg, .png or \
                         .html",
                        path.display()
                    ))
                })?;
                Some((Target::new(path)?, kind))
            }
        };
        let table = args.csv.as_deref().map(Target::new).transpose()?;
        let targets = [picture.as_ref().map(|(target, _)| target), table.as_ref()];
        if let [Some(picture), Some(table)] = targets
            && picture.same_as(table)
        {
            return Err(Failure::Usage("the chart and --csv need two different files".to_owned()));
        }
        if !is_standard(&args.scene)
            && targets.into_iter().flatten().any(|target| target.replaces(&args.scene))
        {
            return Err(Failure::Usage(format!(
                "this would overwrite the scene {}",
                args.scene.display()
            )));
        }
        Ok(Self { picture, table })
    }

    fn take_standard_output(&self) -> bool {
        self.table.as_ref().is_some_and(Target::is_standard_output)
    }

    fn write(&self, comparison: &Comparison, caption: &Caption) -> Result<(), Failure> {
        if let Some((target, kind)) = &self.picture {
            let bytes = match kind {
                Picture::Svg => draw(comparison, caption).svg().into_bytes(),
                Picture::Html => html(comparison, caption).into_bytes(),
                Picture::Png => {
                    let raster = draw(comparison, caption).raster();
                    let image =
                        image::RgbImage::from_raw(raster.width, raster.height, raster.bytes)
                            .ok_or_else(|| Failure::work("the chart is too large"))?;
                    encode_rgb8(&image, Format::Png).map_err(Failure::work)?
                }
            };
            target.write(&bytes)?;
        }
        match &self.table {
            Some(target) => target.write(csv(comparison).as_bytes()),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lancer_judge::Point;

    #[test]
    fn the_command_can_be_copied() {
        let words = ["/usr/bin/lancer", "chart", "a scene's.xml", "--size", "40x30", ""];
        let command = command(&words.map(OsString::from));
        assert_eq!(command, "lancer chart 'a scene'\\''s.xml' --size 40x30 ''");
    }

    #[test]
    fn peers_are_compared_in_words() {
        let comparison = Comparison::new(vec![
            Series::new("edges", vec![Point::new("a", 0.1, 0.01), Point::new("b", 0.2, 0.001)]),
            Series::peer("P", vec![Point::new("c", 5.0, 0.02), Point::new("d", 60.0, 0.001)]),
            Series::peer("Q", vec![Point::new("e", 5.0, 0.0001)]),
        ]);
        assert_eq!(
            note_of_peers(&comparison),
            ["P takes 50 to 300 times as long as the front for an error no smaller."]
        );
    }
}
