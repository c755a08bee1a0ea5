//! Golden pictures: what scenes must look like, to the last bit.
//!
//! Beside `scenes/NAME.xml` stands `scenes/NAME.toml`, which says how its
//! goldens are made:
//!
//! ```toml
//! about = "What the scene shows, as a sentence."
//!
//! [[golden]]
//! engine = "classic"
//! size = [400, 300]      # the scene's own size where this is missing
//! # max-diff = 1         # in levels of 255; only with a reason
//! # reason = "..."
//! ```
//!
//! Each is a picture `tests/goldens/NAME.ENGINE.png`. Scenes may stand in folders,
//! which are then part of their names; `scenes/bench`, `scenes/invalid` and `scenes/stability`, which
//! has right values instead of goldens, are not looked into.

use crate::paths::{Beside, all_with_extension, goldens, name_of, scenes};
use lancer_integrator::{RenderSettings, Sampling, engine_by_name, render};
use lancer_output::{
    Bits, Comparison, Format, Picture, compare, decode, difference_picture, encode, encode_rgb8,
};
use lancer_scene::{PixelCount, Scene};
use serde::Deserialize;
use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// A golden may have so many bytes.
pub const MOST_BYTES: u64 = 200_000;

/// How one golden picture of a scene is made.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Settings {
    /// The engine's name.
    pub engine: String,
    /// Width and height in pixels, if not the scene's own.
    pub size: Option<[u32; 2]>,
    /// So many samples in each pixel; one at its centre where this is missing.
    pub samples: Option<u32>,
    /// The largest difference to accept, in levels of 255.
    #[serde(default)]
    pub max_diff: f64,
    /// Why that is not 0.
    pub reason: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SettingsFile {
    about: String,
    golden: Vec<Settings>,
}

/// A golden picture and what it is made from.
#[derive(Debug, Clone)]
pub struct Golden {
    /// NAME.ENGINE
    pub name: String,
    /// What the scene shows, as a sentence.
    pub about: String,
    scene: PathBuf,
    settings: Settings,
}

/// What is wrong with the goldens or with one of them, as a sentence.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{0}")]
pub struct Problem(String);

fn problem(what: impl std::fmt::Display) -> Problem {
    Problem(what.to_string())
}

/// The goldens of all scenes, found by walking `scenes/`.
///
/// # Errors
/// Where a scene has no settings, settings have no scene or are wrong, or a
/// golden belongs to nothing.
pub fn all() -> Result<Vec<Golden>, Vec<Problem>> {
    let (mut found, mut problems) = (Vec::new(), Vec::new());
    let without_goldens = ["bench", "invalid", "stability"].map(|folder| scenes().join(folder));
    let walk = |extension| {
        let mut files = all_with_extension(&scenes(), extension);
        files.retain(|file| !without_goldens.iter().any(|folder| file.starts_with(folder)));
        files
    };
    for scene in walk("xml") {
        match of_scene(&scene) {
            Ok(goldens) => found.extend(goldens),
            Err(problem) => problems.push(problem),
        }
    }
    for settings in walk("toml") {
        if !settings.with_extension("xml").is_file() {
            problems.push(problem(format!("{} has no scene beside it", settings.display())));
        }
    }
    for picture in all_with_extension(&goldens(), "png") {
        if !found.iter().any(|golden: &Golden| golden.path() == picture) {
            problems.push(problem(format!(
                "{} is the golden of no scene: delete it",
                picture.display()
            )));
        }
    }
    if problems.is_empty() { Ok(found) } else { Err(problems) }
}

fn of_scene(scene: &Path) -> Result<Vec<Golden>, Problem> {
    let path = scene.with_extension("toml");
    let text = fs::read_to_string(&path)
        .map_err(|e| problem(format!("cannot read {}: {e}", path.display())))?;
    let file: SettingsFile =
        toml::from_str(&text).map_err(|e| problem(format!("{}: {e}", path.display())))?;
    if file.golden.is_empty() {
        return Err(problem(format!("{} has no golden", path.display())));
    }
    let mut goldens: Vec<Golden> = Vec::new();
    for settings in file.golden {
        if settings.max_diff != 0.0 && settings.reason.is_none() {
            return Err(problem(format!("{}: max-diff needs a reason", path.display())));
        }
        let name = format!("{}.{}", name_of(scene, &scenes()), settings.engine);
        if goldens.iter().any(|golden| golden.name == name) {
            return Err(problem(format!("{}: two goldens are {name}", path.display())));
        }
        let about = file.about.clone();
        goldens.push(Golden { name, about, scene: scene.to_owned(), settings });
    }
    Ok(goldens)
}

/// How a picture compares with its golden.
#[derive(Debug)]
pub enum Verdict {
    /// It is the same, within the tolerance of the settings.
    Same,
    /// It differs.
    Differs(Comparison),
    /// There is no golden, or one of another size, or one that is too large.
    Unusable(String),
}

impl Golden {
    /// Where the picture is.
    #[must_use]
    pub fn path(&self) -> PathBuf {
        goldens().join(format!("{}.png", self.name))
    }

    /// The scene in the size of the golden.
    ///
    /// # Errors
    /// Where the scene or the size is invalid.
    pub fn scene(&self) -> Result<Scene, Problem> {
        let bytes = fs::read(&self.scene).map_err(problem)?;
        let files = Beside(self.scene.parent().unwrap_or(Path::new(".")));
        let parsed = lancer_xml::parse_with(&bytes, &lancer_xml::Options::default(), &files);
        let mut scene =
            parsed.into_result().map_err(|e| problem(format!("{}: {e}", self.scene.display())))?;
        if let Some([width, height]) = self.settings.size {
            scene.camera.px_width = PixelCount::new(width).map_err(problem)?;
            scene.camera.px_height = PixelCount::new(height).map_err(problem)?;
        }
        Ok(scene)
    }

    /// The scene's name: its path in `scenes/` without the extension.
    #[must_use]
    pub fn scene_name(&self) -> String {
        name_of(&self.scene, &scenes())
    }

    /// The engine's name.
    #[must_use]
    pub fn engine(&self) -> &str {
        &self.settings.engine
    }

    /// Renders the picture on one thread: the PNG's bytes.
    ///
    /// # Errors
    /// Where there is no such scene or engine.
    pub fn render(&self) -> Result<Vec<u8>, Problem> {
        let engine = engine_by_name(self.engine())
            .ok_or_else(|| problem(format!("{}: no such engine", self.name)))?;
        let samples = self.settings.samples;
        let settings = RenderSettings {
            threads: Some(NonZeroUsize::MIN),
            sampling: samples.map(|_| Sampling { samples, ..Sampling::default() }),
            ..RenderSettings::default()
        };
        let rendered = render(&self.scene()?, engine, &settings).map_err(problem)?;
        encode(&rendered.film, Format::Png, Bits::Eight).map_err(problem)
    }

    /// Compares a picture with the golden.
    #[must_use]
    pub fn judge(&self, actual: &[u8]) -> Verdict {
        let expected = match fs::read(self.path()) {
            Ok(bytes) if bytes.len() as u64 > MOST_BYTES => {
                return Verdict::Unusable(format!(
                    "it has {} bytes, more than {MOST_BYTES}: make it smaller",
                    bytes.len()
                ));
            }
            Ok(bytes) => bytes,
            Err(e) => return Verdict::Unusable(format!("it cannot be read: {e}")),
        };
        match pictures(&expected, actual).and_then(|(a, b)| compare(&a, &b).map_err(problem)) {
            Ok(comparison) if comparison.largest <= self.settings.max_diff => Verdict::Same,
            Ok(comparison) => Verdict::Differs(comparison),
            Err(problem) => Verdict::Unusable(problem.to_string()),
        }
    }

    /// Leaves the expected and the actual picture and their difference in a
    /// folder, as far as there are such.
    ///
    /// # Errors
    /// Where they cannot be written.
    pub fn leave_evidence(&self, actual: &[u8], folder: &Path) -> Result<(), Problem> {
        let write = |kind: &str, bytes: &[u8]| {
            let path = folder.join(format!("{}.{kind}.png", self.name));
            fs::create_dir_all(path.parent().unwrap_or(folder)).map_err(problem)?;
            fs::write(path, bytes).map_err(problem)
        };
        write("actual", actual)?;
        let Ok(expected) = fs::read(self.path()) else { return Ok(()) };
        write("expected", &expected)?;
        let (a, b) = pictures(&expected, actual)?;
        if let Ok(difference) = difference_picture(&a, &b) {
            write("difference", &encode_rgb8(&difference, Format::Png).map_err(problem)?)?;
        }
        Ok(())
    }
}

fn pictures(a: &[u8], b: &[u8]) -> Result<(Picture, Picture), Problem> {
    Ok((decode(a).map_err(problem)?, decode(b).map_err(problem)?))
}
