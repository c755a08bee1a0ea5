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
///
/// Graphics are tried only where the environment names a terminal that has
/// them and its answers can be read: the library asks the terminal and waits,
/// on one that does not answer for ever.
pub(crate) fn show(picture: RgbImage) -> Result<(), Failure> {
    let answers = std::io::stdin().is_terminal();
    let names = ["TERM", "TERM_PROGRAM"].map(|name| std::env::var(name).unwrap_or_default());
    let is = |known: &[&str]| {
        answers && names.iter().any(|name| known.iter().any(|known| name.contains(known)))
    };
    let config = viuer::Config {
        absolute_offset: false,
        // Some terminals do not say how large they are.
        width: (viuer::terminal_size().0 == 0).then_some(80),
        use_kitty: is(&["kitty", "ghostty", "WezTerm"]),
        use_iterm: is(&["iTerm", "WezTerm", "mintty"]),
        use_sixel: is(&["sixel", "foot", "mlterm"]),
        ..viuer::Config::default()
    };
    viuer::print(&DynamicImage::ImageRgb8(picture), &config)
        .map_err(|e| Failure::work(format_args!("cannot show the picture: {e}")))?;
    Ok(())
}
