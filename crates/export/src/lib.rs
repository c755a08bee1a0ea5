//! Scenes in the languages of other renderers, and what those cannot say.
//!
//! A scene becomes text, without a file being opened or a program run:
//!
//! ```
//! use lancer_export::{Format, export};
//! use lancer_scene::{Camera, Colour, Light, Scene, Shape, Surface};
//!
//! let scene = Scene::builder()
//!     .camera(Camera::new([0.0, -5.0, 1.0], [0.0, 0.0, 1.0], 4.0, [400, 300]))
//!     .light(Light::lamp([2.0, -3.0, 4.0], 20.0))
//!     .shape(Shape::sphere([0.0, 0.0, 1.0], 1.0, Surface::new(Colour::RED)))
//!     .build()?;
//! let exported = export(&scene, Format::PovRay, "ball");
//! assert!(exported.text.contains("sphere { <0, 0, 1>, 1"));
//! // Only that it depends on the picture how bright it is shown.
//! assert_eq!(exported.omissions.len(), 1);
//! # Ok::<(), lancer_scene::InvalidScene>(())
//! ```
#![forbid(unsafe_code)]

mod frame;
mod mitsuba;
mod omission;
mod pov;
mod text;

pub use omission::Omission;

use lancer_scene::{Exposure, Scene};
use omission::Omissions;
use std::path::Path;

/// A language that scenes can be written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// That of POV-Ray 3.7.
    PovRay,
    /// The XML of Mitsuba 3.
    Mitsuba,
}

impl Format {
    /// All of them.
    pub const ALL: &[Self] = &[Self::PovRay, Self::Mitsuba];

    /// The name by which users choose it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::PovRay => "pov",
            Self::Mitsuba => "mitsuba",
        }
    }

    /// The program that reads it, and from which version on.
    #[must_use]
    pub const fn program(self) -> &'static str {
        match self {
            Self::PovRay => "POV-Ray 3.7",
            Self::Mitsuba => "Mitsuba 3",
        }
    }

    /// The language of that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|format| format.name() == name)
    }

    /// The language that a file's name is usual for: `.pov` or `.xml`, whatever the case.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        let is = |usual: &str| extension.eq_ignore_ascii_case(usual);
        match () {
            () if is("pov") => Some(Self::PovRay),
            () if is("xml") => Some(Self::Mitsuba),
            () => None,
        }
    }
}

/// A scene in another language.
#[derive(Debug, Clone, PartialEq)]
pub struct Exported {
    /// Which one.
    pub format: Format,
    /// The scene file.
    pub text: String,
    /// Other files that it names, which belong in its folder.
    pub files: Vec<Attachment>,
    /// What the language cannot say, or can say only nearly.
    pub omissions: Vec<Omission>,
}

/// A file that a scene file names.
#[derive(Debug, Clone, PartialEq)]
pub struct Attachment {
    /// Its name, without a folder.
    pub name: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// Writes a scene in that language. The names of other files that it needs, if any, begin
/// with `stem`, in which `_` stands for what such names should not have.
///
/// What is shown is radiance times 2 to the camera's stops, as it is on a display: a
/// program that writes linear values from 0 to 1 makes the picture that engine `whitted`
/// makes, before it is encoded. With automatic exposure it is the radiance.
#[must_use]
pub fn export(scene: &Scene, format: Format, stem: &str) -> Exported {
    let mut omissions = Omissions::default();
    let exposure = match scene.camera.exposure {
        Exposure::Stops(stops) => libm::exp2(stops.get()),
        Exposure::Auto => {
            omissions.add(
                "camera",
                "its exposure depends on the picture, and is left out: radiance is shown as it is",
                "give the camera an exposure in stops",
            );
            1.0
        }
    };
    let (text, files) = match format {
        Format::PovRay => (pov::write(scene, exposure, &mut omissions), Vec::new()),
        Format::Mitsuba => mitsuba::write(scene, exposure, &plain(stem), &mut omissions),
    };
    let omissions = omissions.finish();
    let text = match format {
        Format::PovRay => pov::head(scene, &omissions) + &text,
        Format::Mitsuba => mitsuba::head(&omissions) + &text,
    };
    Exported { format, text, files, omissions }
}

/// A name that means the same in a file system, in XML and to Mitsuba.
fn plain(stem: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || "-. ".contains(c) { c } else { '_' };
    if stem.is_empty() { "scene".to_owned() } else { stem.chars().map(plain).collect() }
}

#[cfg(test)]
mod tests;
