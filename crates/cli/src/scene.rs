//! The scene that a file describes, in the size asked for.

use crate::files::BesideScene;
use crate::{Failure, report};
use lancer_film::Size;
use lancer_scene::{PixelCount, Scene};
use lancer_xml::{Options, Source};
use std::path::Path;

/// What commands that make pictures say about a scene's file.
pub(crate) struct Wanted<'a> {
    /// The file, or `-`; other files are beside it.
    pub(crate) path: &'a Path,
    /// The picture's pixels, whatever the scene says.
    pub(crate) size: Option<Size>,
    /// Larger pictures are refused.
    pub(crate) max_pixels: u64,
    /// Whether only errors are told.
    pub(crate) quiet: bool,
}

impl Wanted<'_> {
    /// The scene, and its text; what is wrong with it is told under that name.
    pub(crate) fn scene(&self, name: &str, bytes: &[u8]) -> Result<(Scene, Source), Failure> {
        // With a size it does not matter how large the file's own picture is.
        let max_pixels = self.size.is_none().then_some(self.max_pixels);
        let parsed =
            lancer_xml::parse_with(bytes, &Options { max_pixels }, &BesideScene(self.path));
        let tally = report::show(name, &parsed, self.quiet);
        let Some(mut scene) = parsed.scene else {
            report::say(format_args!("{name}: {tally}"));
            return Err(Failure::Told);
        };
        if let Some(size) = self.size {
            if size.pixels() > self.max_pixels {
                return Err(Failure::Usage(format!(
                    "--size {size} has {} pixels, more than --max-pixels {}",
                    size.pixels(),
                    self.max_pixels
                )));
            }
            let side = |value| PixelCount::new(value).map_err(Failure::work);
            scene.camera.px_width = side(size.width)?;
            scene.camera.px_height = side(size.height)?;
        }
        Ok((scene, parsed.source))
    }
}
