//! The command line: what may be written, and what it means.

use crate::asked::AskedArgs;
pub use crate::chart::ChartArgs;
pub use crate::explain::ExplainArgs;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};
use lancer_film::{LayerKind, Size, Window};
use lancer_integrator::{Engine, Whitted, engine_by_name, engines};
use lancer_output::{Bits, Format};
use lancer_scene::{Exposure, Stops};
use std::ffi::OsStr;
use std::fmt;
use std::num::NonZeroUsize;
use std::path::PathBuf;

const EXIT_CODES: &str = "\
Exit codes:
  0  done
  1  the scene or the work failed, or the pictures differ
  2  wrong usage";

/// Below the options of `render`.
const ENVIRONMENT_AND_EXIT_CODES: &str = "\
Environment:
  LANCER_LANES  how many numbers are computed with at once: scalar, portable, avx2 or avx512, as
                far as the processor has them; the most that it has by default. The picture is
                the same
  NO_COLOR      if set, warnings and errors have no colours

Exit codes:
  0    done
  1    the scene or the work failed, or the pictures differ
  2    wrong usage
  130  interrupted: the picture is the one so far, or there is none";

/// Lancer, a ray tracer: text scene in, picture out.
#[derive(Debug, Parser)]
#[command(name = "lancer", version, after_help = EXIT_CODES, arg_required_else_help = true)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render a scene to a picture
    #[command(after_help = ENVIRONMENT_AND_EXIT_CODES)]
    Render(RenderArgs),
    /// Report all that is wrong with scenes, without rendering
    #[command(after_help = EXIT_CODES)]
    Check(CheckArgs),
    /// Compare two pictures pixel by pixel
    #[command(after_help = EXIT_CODES)]
    Compare(CompareArgs),
    /// Write a scene in the language of another renderer
    #[command(after_help = EXIT_CODES)]
    Export(ExportArgs),
    /// Chart time against error: a scene with all ways of sampling and their settings
    #[command(after_help = EXIT_CODES)]
    Chart(ChartArgs),
    /// Tell what is done for a scene, what is left out and why, or show the rays of a pixel
    #[command(after_help = EXIT_CODES)]
    Explain(ExplainArgs),
}

/// What to render, how, and where to.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// The scene file; `-` is standard input
    pub scene: PathBuf,

    /// The picture file; `-` is standard output, with nothing else on it
    #[arg(short, long, value_name = "OUT", required_unless_present = "preview")]
    pub output: Option<PathBuf>,

    /// The picture's format; else the file name's extension says it (PPM on standard output)
    #[arg(long, value_name = "FORMAT", value_parser = format_parser(), ignore_case = true)]
    pub format: Option<Format>,

    /// How many bits each component has, in formats that leave the choice (ppm, png, tiff)
    #[arg(long, value_name = "BITS", default_value = "8", value_parser = bits_parser())]
    pub bits: Bits,

    #[arg(long, default_value = AUTO, value_parser = engine_parser(), help = engine_help())]
    #[allow(missing_docs, reason = "the doc comment would replace the computed help")]
    pub engine: EngineName,

    /// Leave nothing out, not even what nobody could see: slower, for comparison
    #[arg(long)]
    pub full_model: bool,

    /// Refuse scenes of which the picture is probably not what is meant: what else is a warning
    #[arg(long, value_name = "WHAT", value_parser = ["lints"])]
    pub deny: Option<String>,

    #[command(flatten)]
    #[allow(missing_docs, reason = "the doc comment would replace the program's own")]
    pub asked: AskedArgs,

    /// How bright the picture is shown: a number of stops (each doubles it), or auto. Else the
    /// camera's own exposure
    #[arg(long, value_name = "STOPS", value_parser = parse_exposure, allow_hyphen_values = true)]
    pub exposure: Option<Exposure>,

    /// Do not follow rays that together could change a pixel by no more than this part of display
    /// white (whitted; by default a fifth of the error that is asked for, and 0.0001 if none is)
    #[arg(long, value_name = "C", value_parser = parse_cutoff, allow_hyphen_values = true)]
    pub cutoff: Option<Whitted>,

    /// Write also what each pixel shows first, and how good it is, as layers of an EXR picture:
    /// depth, normal, albedo, shape, instance, error, samples, with commas between them, or all
    /// (whitted)
    #[arg(long, value_name = "LAYERS", value_parser = parse_layers)]
    pub layers: Option<LayerKinds>,

    /// Make the picture so many pixels large, whatever the scene says
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub size: Option<Size>,

    /// Keep only this part of the picture: column and row of its corner, width and height
    #[arg(long, value_name = "X,Y,W,H", value_parser = parse_crop, allow_hyphen_values = true)]
    pub crop: Option<Window>,

    /// How many threads to use; one for each core by default. The picture is the same
    #[arg(long, value_name = "N", value_parser = parse_threads, allow_hyphen_values = true)]
    pub threads: Option<NonZeroUsize>,

    /// Write times, counts of rays and settings to a JSON file
    #[arg(long, value_name = "FILE")]
    pub stats: Option<PathBuf>,

    /// Show the picture in the terminal
    #[arg(long)]
    pub preview: bool,

    /// Say nothing but errors
    #[arg(short, long)]
    pub quiet: bool,

    /// Refuse pictures of more pixels
    #[arg(long, value_name = "N", default_value_t = lancer_xml::MAX_PIXELS)]
    pub max_pixels: u64,
}

/// What to check.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// The scene files; `-` is standard input
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,

    /// The engine whose warnings to report
    #[arg(long, default_value = AUTO, value_parser = engine_parser())]
    pub engine: EngineName,

    /// Have warnings about pictures that are probably not what is meant count as errors
    #[arg(long, value_name = "WHAT", value_parser = ["lints"])]
    pub deny: Option<String>,

    /// Say nothing but warnings and errors
    #[arg(short, long)]
    pub quiet: bool,

    /// Refuse pictures of more pixels
    #[arg(long, value_name = "N", default_value_t = lancer_xml::MAX_PIXELS)]
    pub max_pixels: u64,
}

/// What to compare.
#[derive(Debug, Args)]
pub struct CompareArgs {
    /// The first picture
    pub a: PathBuf,

    /// The second picture
    pub b: PathBuf,

    /// The largest difference to accept in any component, in levels of 255
    #[arg(long, value_name = "N", default_value = "0", value_parser = parse_levels, allow_negative_numbers = true)]
    pub max_diff: f64,

    /// Write a picture of the differences: the brighter the red, the larger
    #[arg(long, value_name = "OUT")]
    pub diff: Option<PathBuf>,

    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// What to write in another language.
#[derive(Debug, Args)]
pub struct ExportArgs {
    /// The scene file; `-` is standard input
    pub scene: PathBuf,

    /// The file to write; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,

    #[arg(long, value_name = "FORMAT", value_parser = export_parser(), help = export_help())]
    #[allow(missing_docs, reason = "the doc comment would replace the computed help")]
    pub format: Option<lancer_export::Format>,

    /// How bright its pictures are: a number of stops, or auto for radiance as it is. Else the
    /// camera's own exposure
    #[arg(long, value_name = "STOPS", value_parser = parse_exposure, allow_hyphen_values = true)]
    pub exposure: Option<Exposure>,

    /// Say nothing but errors: not what the format cannot say, which its file lists too
    #[arg(short, long)]
    pub quiet: bool,

    /// Refuse pictures of more pixels
    #[arg(long, value_name = "N", default_value_t = lancer_xml::MAX_PIXELS)]
    pub max_pixels: u64,
}

/// Layers in the order in which they were asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LayerKinds(pub Vec<LayerKind>);

/// The name of a built-in engine.
#[derive(Clone, Copy)]
pub struct EngineName(&'static dyn Engine);

impl EngineName {
    /// The engine itself.
    #[must_use]
    pub fn engine(self) -> &'static dyn Engine {
        self.0
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.0.name()
    }
}

impl fmt::Debug for EngineName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.name())
    }
}

/// The word for the least engine that shows all of a scene. The others show it as the original
/// program did, which is another picture whatever is in it: so there is but one, and what it does
/// not need is left out by its plan.
pub(crate) const AUTO: &str = "auto";

pub(crate) fn engine_parser() -> impl TypedValueParser<Value = EngineName> {
    let names = std::iter::once(AUTO).chain(engines().iter().map(|engine| engine.name()));
    PossibleValuesParser::new(names).try_map(|name| {
        let engine = if name == AUTO { engines().first().copied() } else { engine_by_name(&name) };
        engine.map(EngineName).ok_or("no such engine")
    })
}

fn engine_help() -> String {
    let engines = engines().iter().map(|e| format!("{}, {}", e.name(), e.summary()));
    let engines = engines.collect::<Vec<_>>().join("; ");
    format!(
        "The engine: auto, the least one that shows all that is in the scene (whitted); {engines}"
    )
}

fn format_parser() -> impl TypedValueParser<Value = Format> {
    let value = |names: &[&'static str]| PossibleValue::new(names[0]).aliases(names[1..].to_vec());
    PossibleValuesParser::new(Format::ALL.iter().map(|(_, names)| value(names)))
        .try_map(|name| Format::from_name(&name).ok_or("no such format"))
}

fn export_parser() -> impl TypedValueParser<Value = lancer_export::Format> {
    PossibleValuesParser::new(lancer_export::Format::ALL.iter().map(|format| format.name()))
        .try_map(|name| lancer_export::Format::from_name(&name).ok_or("no such format"))
}

fn export_help() -> String {
    let formats = lancer_export::Format::ALL.iter();
    let formats: Vec<_> = formats.map(|f| format!("{}, for {}", f.name(), f.program())).collect();
    format!(
        "The format: {}; else the file name's extension says it (.pov, or .xml)",
        formats.join("; ")
    )
}

fn bits_parser() -> impl TypedValueParser<Value = Bits> {
    PossibleValuesParser::new(["8", "16"])
        .map(|bits| if bits == "16" { Bits::Sixteen } else { Bits::Eight })
}

/// Numbers of pixels along a side that picture formats can count.
fn side(text: &str) -> Option<u32> {
    number(text).filter(|side| (1..=i32::MAX as u32).contains(side))
}

/// A number in digits alone.
pub(crate) fn number(text: &str) -> Option<u32> {
    text.bytes().all(|b| b.is_ascii_digit()).then(|| text.parse().ok()).flatten()
}

pub(crate) fn parse_size(text: &str) -> Result<Size, String> {
    text.split_once(['x', 'X'])
        .and_then(|(width, height)| Some(Size::new(side(width)?, side(height)?)))
        .ok_or_else(|| {
            "expected a width and a height of 1 to 2147483647 pixels, such as 400x300".to_owned()
        })
}

fn parse_crop(text: &str) -> Result<Window, String> {
    let parts: Vec<&str> = text.split(',').collect();
    let window = match parts[..] {
        [x, y, width, height] => number(x)
            .zip(number(y))
            .and_then(|(x, y)| Some(Window { x, y, width: side(width)?, height: side(height)? })),
        _ => None,
    };
    window.ok_or_else(|| {
        "expected column, row, width and height in pixels, such as 100,50,64,48".to_owned()
    })
}

/// More threads than this are surely a slip.
const MOST_THREADS: usize = 1024;

pub(crate) fn parse_threads(text: &str) -> Result<NonZeroUsize, String> {
    number(text)
        .and_then(|threads| NonZeroUsize::new(threads as usize))
        .filter(|threads| threads.get() <= MOST_THREADS)
        .ok_or_else(|| format!("expected a whole number from 1 to {MOST_THREADS}"))
}

pub(crate) fn parse_exposure(text: &str) -> Result<Exposure, String> {
    if text == "auto" {
        return Ok(Exposure::Auto);
    }
    let stops = text.parse().ok().and_then(|stops| Stops::new(stops).ok());
    stops
        .map(Exposure::Stops)
        .ok_or_else(|| "expected auto, or a number of stops from -1000 to 1000".to_owned())
}

pub(crate) fn parse_cutoff(text: &str) -> Result<Whitted, String> {
    let cutoff = text.parse().ok().and_then(|cutoff| Whitted::with_cutoff(cutoff).ok());
    cutoff.ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

fn parse_layers(text: &str) -> Result<LayerKinds, String> {
    let mut kinds = Vec::new();
    for name in text.split(',') {
        let found: &[LayerKind] = match LayerKind::from_name(name) {
            Some(kind) => &[kind],
            None if name == "all" => LayerKind::ALL,
            None => {
                let names: Vec<_> = LayerKind::ALL.iter().map(|kind| kind.name()).collect();
                return Err(format!("`{name}` is none of {}, all", names.join(", ")));
            }
        };
        for kind in found {
            if !kinds.contains(kind) {
                kinds.push(*kind);
            }
        }
    }
    Ok(LayerKinds(kinds))
}

fn parse_levels(text: &str) -> Result<f64, String> {
    text.parse::<f64>()
        .ok()
        .filter(|levels| *levels >= 0.0)
        .ok_or_else(|| "expected a number of at least 0".to_owned())
}

/// Whether a path means standard input or output.
#[must_use]
pub fn is_standard(path: &std::path::Path) -> bool {
    path.as_os_str() == OsStr::new("-")
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn sizes_crops_and_counts_are_read_or_refused() {
        assert_eq!(parse_size("400x300"), Ok(Size::new(400, 300)));
        for bad in ["", "400", "400x", "x300", "0x3", "-4x3", "4x3x2", "4294967296x1", "4.0x3"] {
            assert!(parse_size(bad).is_err(), "{bad}");
        }
        assert_eq!(parse_crop("1,2,3,4"), Ok(Window { x: 1, y: 2, width: 3, height: 4 }));
        for bad in ["", "1,2,3", "1,2,3,4,5", "1,2,0,4", "-1,2,3,4", "1, 2,3,4", "a,b,c,d"] {
            assert!(parse_crop(bad).is_err(), "{bad}");
        }
        assert!(parse_threads("0").is_err() && parse_threads("100000").is_err());
        assert!(parse_levels("-1").is_err() && parse_levels("NaN").is_err());
        assert_eq!(parse_levels("0.5"), Ok(0.5));
        assert_eq!(parse_exposure("auto"), Ok(Exposure::Auto));
        assert_eq!(parse_exposure("-1.5").ok(), Stops::new(-1.5).ok().map(Exposure::Stops));
        for bad in ["", "Auto", "1001", "NaN", "inf", "1 stop"] {
            assert!(parse_exposure(bad).is_err(), "{bad}");
        }
        assert!(parse_cutoff("-1").is_err() && parse_cutoff("2").is_err());
        assert!(parse_cutoff("1e-7").is_ok_and(|whitted| whitted.cutoff() == 1e-7));
        let layers = parse_layers("normal,depth,normal").map(|layers| layers.0);
        assert_eq!(layers, Ok(vec![LayerKind::Normal, LayerKind::Depth]));
        assert_eq!(parse_layers("all").map(|layers| layers.0.len()), Ok(7));
        assert!(parse_layers("").is_err() && parse_layers("depth,colour").is_err());
    }

    #[test]
    fn a_render_needs_somewhere_to_go() {
        assert!(Cli::try_parse_from(["lancer", "render", "a.xml"]).is_err());
        assert!(Cli::try_parse_from(["lancer", "render", "a.xml", "--preview"]).is_ok());
        assert!(Cli::try_parse_from(["lancer", "render", "-", "-o", "-"]).is_ok());
    }
}
