//! How good a picture is asked for: what may be written about it, and what it means.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use lancer_integrator::{Sampling, StopAt, Strategy, Whitted};
use std::fmt;
use std::str::FromStr;
use std::time::Duration;

/// When a picture is good enough. Whichever comes first ends it.
#[derive(Debug, Clone, Copy, Default, Args)]
pub struct AskedArgs {
    /// Take samples until the error of the picture is about this: root mean square, where 1 is
    /// display white (whitted; 0.0005 by default, unless --samples or --time is given)
    #[arg(long, value_name = "E", value_parser = parse_error, allow_hyphen_values = true)]
    pub error: Option<f64>,

    /// Make the best picture that can be rendered in this time: seconds, or such as 500ms, 2m
    /// (whitted)
    #[arg(long, value_name = "T", value_parser = parse_time, allow_hyphen_values = true)]
    pub time: Option<Duration>,

    /// Take so many samples in each pixel; a single one is at its centre (whitted)
    #[arg(long, value_name = "N", value_parser = parse_samples, allow_hyphen_values = true)]
    pub samples: Option<u32>,

    /// Place the samples by other random numbers: any whole number (whitted; 0 by default)
    #[arg(long, value_name = "N", value_parser = parse_seed, allow_hyphen_values = true)]
    pub seed: Option<u64>,

    /// Where samples go: edges, where they take most from the error; sobol, stratified, random:
    /// as many in each pixel (whitted)
    #[arg(long, value_name = "STRATEGY", value_parser = strategy_parser(), hide_possible_values = true)]
    pub strategy: Option<Strategy>,

    /// Take the samples that an earlier picture had, which stopped at this place (`stop_at` in its
    /// statistics), with the same seed, strategy and number of samples (whitted)
    #[arg(long, value_name = "R:P", value_parser = parse_stop, allow_hyphen_values = true)]
    pub stop_at: Option<Stop>,
}

/// A place in the sequence of samples. The sequence depends on the error that is asked for,
/// so that is said with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// The place.
    pub at: StopAt,
    /// The error that was asked for, if one was.
    pub error: Option<f64>,
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.at)?;
        self.error.map_or(Ok(()), |error| write!(f, "@{error}"))
    }
}

impl FromStr for Stop {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (at, error) = match text.split_once('@') {
            Some((at, error)) => (at, Some(parse_error(error)?)),
            None => (text, None),
        };
        Ok(Self { at: at.parse().map_err(str::to_owned)?, error })
    }
}

impl AskedArgs {
    /// The first of the options that was given.
    pub(crate) fn first_given(&self) -> Option<&'static str> {
        let given = [
            (self.error.is_some(), "--error"),
            (self.time.is_some(), "--time"),
            (self.samples.is_some(), "--samples"),
            (self.seed.is_some(), "--seed"),
            (self.strategy.is_some(), "--strategy"),
            (self.stop_at.is_some(), "--stop-at"),
        ];
        given.into_iter().find_map(|(is_given, name)| is_given.then_some(name))
    }

    /// What they ask of the renderer, or why they contradict one another.
    pub(crate) fn sampling(&self) -> Result<Sampling, String> {
        let error = match (self.error, self.stop_at) {
            (Some(error), Some(stop)) if stop.error != Some(error) => {
                return Err(format!(
                    "--error {error} --stop-at {stop}: that place is one of a picture of which \
                     another error was asked; leave --error out"
                ));
            }
            (_, Some(stop)) => stop.error,
            (None, None) if self.samples.is_none() && self.time.is_none() => Some(Sampling::ERROR),
            (error, None) => error,
        };
        Ok(Sampling {
            strategy: self.strategy.unwrap_or_default(),
            seed: self.seed.unwrap_or_default(),
            samples: self.samples,
            error,
            time: self.time,
            stop_at: self.stop_at.map(|stop| stop.at),
        })
    }
}

/// The engine for pictures that good, unless its cutoff is given.
pub(crate) fn whitted(cutoff: Option<Whitted>, sampling: &Sampling) -> Whitted {
    cutoff.unwrap_or_else(|| Whitted::for_error(sampling.error))
}

fn parse_error(text: &str) -> Result<f64, String> {
    let error = text.parse::<f64>().ok().filter(|error| *error > 0.0 && *error <= 1.0);
    error.ok_or_else(|| {
        "expected a number above 0, up to 1 (display white), such as 0.002".to_owned()
    })
}

/// The units of time, in seconds; those first that others end with.
const UNITS: [(&str, f64); 4] = [("ms", 1e-3), ("s", 1.0), ("m", 60.0), ("h", 3600.0)];

fn parse_time(text: &str) -> Result<Duration, String> {
    let (number, unit) = UNITS
        .iter()
        .find_map(|(name, unit)| Some((text.strip_suffix(name)?, *unit)))
        .unwrap_or((text, 1.0));
    let plain = |c: char| c.is_ascii_digit() || c == '.';
    let seconds = number.chars().all(plain).then(|| number.parse::<f64>().ok()).flatten();
    seconds
        .and_then(|seconds| Duration::try_from_secs_f64(seconds * unit).ok())
        .filter(|time| !time.is_zero())
        .ok_or_else(|| {
            "expected a time above 0, such as 10 (seconds), 500ms, 1.5m or 2h".to_owned()
        })
}

fn parse_samples(text: &str) -> Result<u32, String> {
    let samples = text.bytes().all(|b| b.is_ascii_digit()).then(|| text.parse().ok()).flatten();
    samples
        .filter(|samples| (1..=Sampling::MOST).contains(samples))
        .ok_or_else(|| format!("expected a whole number from 1 to {}", Sampling::MOST))
}

fn parse_seed(text: &str) -> Result<u64, String> {
    let seed = text.bytes().all(|b| b.is_ascii_digit()).then(|| text.parse().ok()).flatten();
    seed.ok_or_else(|| format!("expected a whole number from 0 to {}", u64::MAX))
}

fn parse_stop(text: &str) -> Result<Stop, String> {
    text.parse()
}

pub(crate) fn strategy_parser() -> impl TypedValueParser<Value = Strategy> {
    PossibleValuesParser::new(Strategy::ALL.iter().map(|strategy| strategy.name()))
        .try_map(|name| Strategy::from_name(&name).ok_or("no such strategy"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_times_and_counts_are_read_or_refused() {
        assert_eq!(parse_error("0.002"), Ok(0.002));
        assert_eq!(parse_error("1"), Ok(1.0));
        for bad in ["", "0", "-1", "1.1", "NaN", "inf", "1e-400", "0.1%"] {
            assert!(parse_error(bad).is_err(), "{bad}");
        }
        for (text, milliseconds) in
            [("2", 2000), ("2s", 2000), ("500ms", 500), (".5s", 500), ("1.5m", 90_000)]
        {
            assert_eq!(parse_time(text), Ok(Duration::from_millis(milliseconds)), "{text}");
        }
        for bad in ["", "0", "0ms", "-1", "s", "NaN", "inf", "1e3", "2 s", "1d", "1m30s"] {
            assert!(parse_time(bad).is_err(), "{bad}");
        }
        assert!(parse_time(&"9".repeat(40)).is_err());
        assert_eq!((parse_samples("1"), parse_seed("0")), (Ok(1), Ok(0)));
        assert_eq!(parse_seed("18446744073709551615"), Ok(u64::MAX));
        for bad in ["", "-1", "1.5", "18446744073709551616"] {
            assert!(parse_samples(bad).is_err() && parse_seed(bad).is_err(), "{bad}");
        }
        assert!(parse_samples("0").is_err() && parse_samples("1048577").is_err());
    }

    #[test]
    fn a_place_to_stop_at_is_written_as_it_is_read() {
        for text in ["0:0", "12:345", "3:120@0.0005", "1:2@0.000001"] {
            assert_eq!(parse_stop(text).map(|stop| stop.to_string()), Ok(text.to_owned()));
        }
        for bad in ["", "1", "1:", ":1", "1:2@", "1:2@0", "-1:2", "1:2:3", "1:2@x"] {
            assert!(parse_stop(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn an_error_is_asked_for_unless_something_else_is() {
        let asked = |asked: &AskedArgs| asked.sampling().map(|sampling| sampling.error);
        let none = AskedArgs::default();
        assert_eq!(asked(&none), Ok(Some(Sampling::ERROR)));
        assert_eq!(asked(&AskedArgs { seed: Some(3), ..none }), Ok(Some(Sampling::ERROR)));
        assert_eq!(asked(&AskedArgs { samples: Some(3), ..none }), Ok(None));
        let time = AskedArgs { time: Some(Duration::from_secs(1)), ..none };
        assert_eq!(asked(&time), Ok(None));
        assert_eq!(asked(&AskedArgs { error: Some(0.1), ..time }), Ok(Some(0.1)));
        // The place tells what was asked.
        let at = |text| AskedArgs { stop_at: parse_stop(text).ok(), ..none };
        assert_eq!((asked(&at("1:2")), asked(&at("1:2@0.1"))), (Ok(None), Ok(Some(0.1))));
        assert_eq!(asked(&AskedArgs { error: Some(0.1), ..at("1:2@0.1") }), Ok(Some(0.1)));
        assert!(asked(&AskedArgs { error: Some(0.2), ..at("1:2@0.1") }).is_err());
    }

    #[test]
    fn the_cutoff_follows_the_error() {
        let with = |error| whitted(None, &Sampling { error, ..Sampling::default() }).cutoff();
        assert_eq!(with(Some(Sampling::ERROR)), Whitted::CUTOFF);
        assert_eq!((with(None), with(Some(1.0))), (Whitted::CUTOFF, 0.2));
        let given = Whitted::with_cutoff(0.5).expect("it is in range");
        assert_eq!(whitted(Some(given), &Sampling::default()).cutoff(), 0.5);
    }
}
