//! The picture in the terminal itself.

use crate::Failure;
use image::{DynamicImage, RgbImage};
use std::io::IsTerminal;

/// Whether there is a terminal to show a picture in.
pub(crate) fn is_possible() -> bool {
    std::io::stdout().is_terminal()
}

/// Shows the picture below the cursor, no larger than the terminal: by the
/// terminal's own graphics where it has any, else in blocks of colour.
pub(crate) fn show(picture: RgbImage) -> Result<(), Failure> {
    let config = viuer::Config { absolute_offset: false, ..viuer::Config::default() };
    viuer::print(&DynamicImage::ImageRgb8(picture), &config)
        .map_err(|e| Failure::work(format_args!("cannot show the picture: {e}")))?;
    Ok(())
}
