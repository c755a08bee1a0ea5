//! What may be written about charts.

use crate::args::{EngineName, engine_parser, parse_exposure, parse_size, parse_threads};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use lancer_film::Size;
use lancer_integrator::Strategy;
use lancer_scene::Exposure;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// What to compare on a chart.
#[derive(Debug, Args)]
#[group(id = "chart_output", required = true, multiple = true, args = ["output", "csv"])]
pub struct ChartArgs {
    /// The scene file; `-` is standard input
    pub scene: PathBuf,

    /// The chart's file: .svg, .png, or .html with all figures in a table
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,

    /// Write the figures as comma-separated values; `-` is standard output
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,

    /// The engines to compare, with commas between them: those that see any place of the picture
    #[arg(long, value_name = "ENGINES", value_delimiter = ',', default_value = "whitted",
          value_parser = sampling_engine_parser())]
    pub engines: Vec<EngineName>,

    /// The strategies to compare, with commas between them; all by default: edges, sobol,
    /// stratified, random
    #[arg(long, value_name = "STRATEGIES", value_delimiter = ',',
          value_parser = strategy_parser(), hide_possible_values = true)]
    pub strategies: Vec<Strategy>,

    /// Go down to this error: root mean square, where 1 is display white
    #[arg(long, value_name = "E", default_value = "0.0005", value_parser = parse_finest,
          allow_hyphen_values = true)]
    pub finest: f64,

    /// Run other renderers on the scene, too, as far as they are installed: POV-Ray, Mitsuba
    #[arg(long)]
    pub peers: bool,

    /// How bright the picture is shown: a number of stops (each doubles it), or auto. Else the
    /// camera's own exposure
    #[arg(long, value_name = "STOPS", value_parser = parse_exposure, allow_hyphen_values = true)]
    pub exposure: Option<Exposure>,

    /// Make the pictures so many pixels large, whatever the scene says
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub size: Option<Size>,

    /// How many threads to use; one for each core by default
    #[arg(long, value_name = "N", value_parser = parse_threads, allow_hyphen_values = true)]
    pub threads: Option<NonZeroUsize>,

    /// Say nothing but errors and what is recommended
    #[arg(short, long)]
    pub quiet: bool,

    /// Refuse pictures of more pixels
    #[arg(long, value_name = "N", default_value_t = lancer_xml::MAX_PIXELS)]
    pub max_pixels: u64,
}

impl ChartArgs {
    /// Those to compare, each once, in a fixed order.
    pub(crate) fn strategies(&self) -> impl Iterator<Item = Strategy> {
        let is_wanted = |s: &&Strategy| self.strategies.is_empty() || self.strategies.contains(s);
        Strategy::ALL.iter().filter(is_wanted).copied()
    }
}

/// What a chart is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Picture {
    Svg,
    Png,
    Html,
}

impl Picture {
    /// What a file's name says.
    pub(crate) fn from_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "svg" => Some(Self::Svg),
            "png" => Some(Self::Png),
            "html" | "htm" => Some(Self::Html),
            _ => None,
        }
    }
}

/// The only engine with more than a sample in each pixel.
const SAMPLED: &str = "whitted";

fn sampling_engine_parser() -> impl TypedValueParser<Value = EngineName> {
    engine_parser().try_map(|engine| match engine.name() {
        SAMPLED => Ok(engine),
        name => Err(format!("the engine {name} sees nothing but pixels' centres")),
    })
}

fn strategy_parser() -> impl TypedValueParser<Value = Strategy> {
    PossibleValuesParser::new(Strategy::ALL.iter().map(|strategy| strategy.name()))
        .try_map(|name| Strategy::from_name(&name).ok_or("no such strategy"))
}

fn parse_finest(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|error| (1e-6..=0.1).contains(error))
        .ok_or_else(|| "expected an error from 0.000001 to 0.1".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Cli, Command};
    use clap::Parser;

    fn chart(words: &[&str]) -> Result<ChartArgs, String> {
        let words = ["lancer", "chart", "a.xml"].iter().chain(words);
        match Cli::try_parse_from(words).map_err(|error| error.to_string())?.command {
            Command::Chart(args) => Ok(args),
            _ => Err("it says chart".to_owned()),
        }
    }

    #[test]
    fn a_chart_needs_somewhere_to_go() {
        assert!(chart(&[]).is_err());
        assert!(chart(&["-o", "a.svg"]).is_ok() && chart(&["--csv", "-"]).is_ok());
        assert!(chart(&["-o", "a.svg", "--csv", "a.csv"]).is_ok());
        for (name, kind) in [
            ("a.SVG", Some(Picture::Svg)),
            ("b.htm", Some(Picture::Html)),
            ("c.jpg", None),
            ("-", None),
        ] {
            assert_eq!(Picture::from_path(Path::new(name)), kind, "{name}");
        }
    }

    #[test]
    fn lists_and_numbers_are_read_or_refused() {
        let all: Vec<_> = chart(&["-o", "a.svg"]).expect("fine").strategies().collect();
        assert_eq!(all, Strategy::ALL);
        let some = chart(&["-o", "a.svg", "--strategies", "sobol,edges,sobol"]).expect("fine");
        assert_eq!(some.strategies().collect::<Vec<_>>(), [Strategy::Edges, Strategy::Sobol]);
        for bad in [
            ["--strategies", "edges,"],
            ["--strategies", "halton"],
            ["--engines", "classic"],
            ["--engines", "whitted,none"],
            ["--finest", "0"],
            ["--finest", "-1"],
            ["--finest", "NaN"],
            ["--finest", "1"],
            ["--size", "0x3"],
            ["--threads", "0"],
            ["--exposure", "bright"],
        ] {
            assert!(chart(&["-o", "a.svg", bad[0], bad[1]]).is_err(), "{bad:?}");
        }
        let message = chart(&["-o", "a.svg", "--engines", "classic"]).expect_err("refused");
        assert!(message.contains("nothing but pixels' centres"), "{message}");
    }
}
