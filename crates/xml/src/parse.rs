//! From bytes to a scene and all that is wrong with it.

use crate::document::{decode, tree};
use crate::files::{Files, NoFiles};
use crate::world::{Out, world};
use crate::{Diagnostic, Severity, Source};
use lancer_scene::Scene;
use std::ops::Range;

/// The pixel budget of [`Options::default`]: a picture may have so many.
pub const MAX_PIXELS: u64 = 100_000_000;

/// How a file is to be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// A camera whose picture has more pixels is an error. None: no limit.
    pub max_pixels: Option<u64>,
}

impl Default for Options {
    fn default() -> Self {
        Self { max_pixels: Some(MAX_PIXELS) }
    }
}

/// What a file says.
#[derive(Debug, Clone)]
pub struct Parsed {
    /// The text that the diagnostics speak of.
    pub source: Source,
    /// All that is wrong, in the order of the file.
    pub diagnostics: Vec<Diagnostic>,
    /// The scene; there is none if a diagnostic is an error.
    pub scene: Option<Scene>,
}

/// A file that holds no valid scene.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{}", self.list())]
pub struct InvalidFile {
    /// The text that the diagnostics speak of.
    pub text: Source,
    /// All that is wrong, in the order of the file; one at least is an error.
    pub diagnostics: Vec<Diagnostic>,
}

impl InvalidFile {
    fn list(&self) -> String {
        let lines = self.diagnostics.iter().map(|diagnostic| {
            let (line, column) = self.text.location(diagnostic.span.start);
            format!("{line}:{column}: {}", diagnostic.message)
        });
        lines.collect::<Vec<_>>().join("\n")
    }
}

impl Parsed {
    /// The scene, warnings left aside.
    ///
    /// # Errors
    /// Where the file holds no valid scene.
    pub fn into_result(self) -> Result<Scene, InvalidFile> {
        self.scene.ok_or(InvalidFile { text: self.source, diagnostics: self.diagnostics })
    }
}

/// Reads the bytes of a scene file that names no other files.
#[must_use]
pub fn parse(bytes: &[u8], options: &Options) -> Parsed {
    parse_with(bytes, options, &NoFiles)
}

/// Reads the bytes of a scene file; those that it names come from `files`.
#[must_use]
pub fn parse_with(bytes: &[u8], options: &Options, files: &dyn Files) -> Parsed {
    let (source, not_text) = decode(bytes);
    let mut diagnostics = Vec::new();
    let scene = if let Some(diagnostic) = not_text {
        diagnostics.push(diagnostic);
        None
    } else {
        mended_world(&source, options, files, &mut diagnostics)
    };
    diagnostics.sort_by_key(|diagnostic| diagnostic.span.start);
    let scene = scene.filter(|_| diagnostics.iter().all(|d| d.severity != Severity::Error));
    Parsed { source, diagnostics, scene }
}

/// How many mistakes are blanked out to find those behind them.
const MOST_MENDED: usize = 50;

/// The scene, found even where the XML has mistakes that can be left out.
fn mended_world(
    source: &Source,
    options: &Options,
    files: &dyn Files,
    out: Out<'_>,
) -> Option<Scene> {
    let mut text = std::borrow::Cow::Borrowed(source.text());
    let mut mended: Vec<Range<usize>> = Vec::new();
    for _ in 0..=MOST_MENDED {
        let problem = match tree(&text, source) {
            Ok(document) => {
                let mut found = Vec::new();
                let scene = world(document.root_element(), options, files, &mut found);
                // What is wrong with a blank has been said.
                let blank = |span: &Range<usize>| {
                    mended.iter().any(|mend| span.start < mend.end && mend.start < span.end)
                };
                out.extend(found.into_iter().filter(|diagnostic| !blank(&diagnostic.span)));
                return scene;
            }
            Err(problem) => *problem,
        };
        out.push(problem.diagnostic);
        let mend = problem.mend?;
        text.to_mut().replace_range(mend.clone(), &" ".repeat(mend.len()));
        mended.push(mend);
    }
    None
}
