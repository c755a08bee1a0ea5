//! Other renderers: which are installed, and what they make of an exported scene.
//!
//! A peer is run in a folder of its own, which is gone afterwards; what takes longer than it may
//! is ended. Pictures come back in linear values.

mod child;
mod mitsuba;
mod povray;

use lancer_export::{Exported, Format};
use lancer_film::Size;
use std::fmt;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Duration;

/// A renderer that is installed.
#[derive(Debug, Clone)]
pub struct Peer {
    /// The language that it reads.
    format: Format,
    /// What is started: itself, or a Python that has it.
    command: PathBuf,
    /// What it says of itself, as "POV-Ray 3.7.0.10.unofficial".
    version: String,
}

/// How a peer is to sample a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Setting {
    /// POV-Ray without antialiasing: a sample at each pixel's centre.
    Centres,
    /// POV-Ray with antialiasing, without jitter: `+A`, `+AM`, `+R`.
    Antialiased {
        /// What colours must differ by for more samples to be taken, in linear values.
        threshold: f64,
        /// 1, or 2 for the method that subdivides pixels.
        method: u8,
        /// How many samples a side are taken at most (method 1), or how often pixels are halved.
        depth: u8,
    },
    /// Mitsuba with so many samples for each pixel, of the draw with that number.
    Samples {
        /// How many.
        count: u32,
        /// Which draw.
        seed: u32,
    },
}

impl Setting {
    /// Which peers know it.
    #[must_use]
    pub const fn format(&self) -> Format {
        match self {
            Self::Centres | Self::Antialiased { .. } => Format::PovRay,
            Self::Samples { .. } => Format::Mitsuba,
        }
    }
}

/// As a user of the peer writes it.
impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Centres => f.write_str("-A"),
            Self::Antialiased { threshold, method, depth } => {
                write!(f, "+A{threshold:?} +AM{method} +R{depth}")
            }
            Self::Samples { count, .. } => write!(f, "spp={count}"),
        }
    }
}

/// What a peer has made.
#[derive(Debug, Clone)]
pub struct PeerPicture {
    /// How long it rendered, by its own clock, without reading the scene or compiling: seconds.
    pub seconds: f64,
    /// How long its process took, with all that: seconds.
    pub process_seconds: f64,
    /// The width in pixels.
    pub width: u32,
    /// The height in pixels.
    pub height: u32,
    /// Linear red, green and blue, row by row from the top. POV-Ray's are clipped to [0, 1] and
    /// multiples of 1 / 65535.
    pub linear: Vec<[f32; 3]>,
}

/// Why there is no picture of a peer's.
#[derive(Debug, thiserror::Error)]
pub enum PeerError {
    /// It is not installed.
    #[error("{program} was not found ({why}); {remedy}")]
    Missing {
        /// What was looked for.
        program: &'static str,
        /// What came of it.
        why: String,
        /// How it is installed.
        remedy: &'static str,
    },
    /// The scene or the setting is meant for another one.
    #[error("{name} does not read that: it is meant for {wanted}")]
    Mismatch {
        /// The peer.
        name: String,
        /// Whom it is meant for.
        wanted: &'static str,
    },
    /// It took longer than it may, and was ended.
    #[error("{name} took longer than {seconds} seconds, and was ended")]
    TimedOut {
        /// The peer.
        name: String,
        /// What it may take.
        seconds: f64,
    },
    /// The user has interrupted the program.
    #[error("interrupted")]
    Interrupted,
    /// It failed, or made something unexpected.
    #[error("{name} failed: {why}")]
    Failed {
        /// The peer.
        name: String,
        /// What it said last.
        why: String,
    },
}

/// The peers that are installed, in a fixed order.
#[must_use]
pub fn installed() -> Vec<Peer> {
    Format::ALL.iter().filter_map(|format| find(*format).ok()).collect()
}

/// The peer that reads that language: `povray` on the path, or a Python with the package
/// `mitsuba`, which is `python3` or what the variable `LANCER_PYTHON` names.
///
/// # Errors
/// Where it is not installed.
pub fn find(format: Format) -> Result<Peer, PeerError> {
    match format {
        Format::PovRay => povray::find(),
        Format::Mitsuba => mitsuba::find(),
    }
}

impl Peer {
    /// Its name, with its version.
    #[must_use]
    pub fn version(&self) -> &str {
        &self.version
    }

    /// The language that it reads.
    #[must_use]
    pub const fn format(&self) -> Format {
        self.format
    }

    /// Has it render an exported scene in that size.
    ///
    /// # Errors
    /// Where the scene or the setting is not for it, or it fails, or takes longer than `timeout`.
    pub fn render(
        &self,
        exported: &Exported,
        size: Size,
        threads: NonZeroUsize,
        setting: Setting,
        timeout: Duration,
    ) -> Result<PeerPicture, PeerError> {
        for wanted in [exported.format, setting.format()] {
            if wanted != self.format {
                let name = self.version.clone();
                return Err(PeerError::Mismatch { name, wanted: wanted.program() });
            }
        }
        match self.format {
            Format::PovRay => povray::render(self, exported, size, threads, setting, timeout),
            Format::Mitsuba => mitsuba::render(self, exported, size, threads, setting, timeout),
        }
    }

    fn failed(&self, why: impl fmt::Display) -> PeerError {
        PeerError::Failed { name: self.version.clone(), why: why.to_string() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_written_as_users_write_them() {
        let setting = Setting::Antialiased { threshold: 0.03, method: 2, depth: 4 };
        assert_eq!(setting.to_string(), "+A0.03 +AM2 +R4");
        // A whole number is none that POV-Ray takes.
        let finest = Setting::Antialiased { threshold: 0.0, method: 1, depth: 9 };
        assert_eq!(finest.to_string(), "+A0.0 +AM1 +R9");
        assert_eq!(Setting::Samples { count: 16, seed: 3 }.to_string(), "spp=16");
        assert_eq!(Setting::Centres.format(), Format::PovRay);
    }

    #[test]
    fn what_is_meant_for_another_is_refused() {
        let peer =
            Peer { format: Format::PovRay, command: "false".into(), version: "POV-Ray".to_owned() };
        let exported = Exported {
            format: Format::PovRay,
            text: String::new(),
            files: Vec::new(),
            omissions: Vec::new(),
        };
        let render = |setting| {
            let seconds = Duration::from_secs(5);
            peer.render(&exported, Size::new(1, 1), NonZeroUsize::MIN, setting, seconds)
        };
        let refused = render(Setting::Samples { count: 1, seed: 0 });
        assert!(matches!(refused, Err(PeerError::Mismatch { .. })), "{refused:?}");
        let failed = render(Setting::Centres);
        assert!(matches!(failed, Err(PeerError::Failed { .. })), "{failed:?}");
    }
}
