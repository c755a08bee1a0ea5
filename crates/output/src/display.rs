//! From the values of a film to the codes of a display.

use lancer_film::{Display, Film};

/// A film of a part of a frame cannot be shown by a rule that looks at the
/// whole frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "the brightness of the whole frame must be known to show a part of it: render with the \
     frame's peak"
)]
pub struct PeakUnknown;

/// The factor from the film's values to codes up to `top`, before truncation.
fn scale(film: &Film, top: f32) -> Result<f32, PeakUnknown> {
    match film.display() {
        Display::Brightest { white } => {
            let peak = film.frame_peak().ok_or(PeakUnknown)?;
            Ok(top / if peak > white { peak } else { white })
        }
    }
}

/// Codes from 0 to 255 for each component, row by row.
pub(crate) fn codes8(film: &Film) -> Result<Vec<u8>, PeakUnknown> {
    let scale = scale(film, 255.0)?;
    // The conversion truncates, and turns NaN and negative numbers into 0.
    Ok(film.pixels().iter().flatten().map(|v| (v * scale) as u8).collect())
}

/// Codes from 0 to 65535 for each component, row by row.
pub(crate) fn codes16(film: &Film) -> Result<Vec<u16>, PeakUnknown> {
    let scale = scale(film, 65535.0)?;
    Ok(film.pixels().iter().flatten().map(|v| (v * scale) as u16).collect())
}

/// Linear values, 1 being display white, for each component, row by row.
pub(crate) fn linear(film: &Film) -> impl Iterator<Item = f32> {
    let white = film.display().white();
    film.pixels().iter().flatten().map(move |v| v / white)
}

/// The film as a display of 8 bits shows it.
///
/// # Errors
/// Where the film's rule needs to know more of the frame than the film does.
///
/// # Panics
/// Never: the buffer has the size that the film says.
pub fn to_rgb8(film: &Film) -> Result<image::RgbImage, PeakUnknown> {
    let window = film.window();
    let image = image::RgbImage::from_raw(window.width, window.height, codes8(film)?);
    Ok(image.expect("three codes for each pixel"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lancer_film::Size;

    fn film(values: &[[f32; 3]]) -> Film {
        let frame = Size::new(values.len() as u32, 1);
        let mut film =
            Film::new(frame, frame.window(), Display::Brightest { white: 255.0 }).expect("it fits");
        film.put(frame.window(), values);
        film
    }

    #[test]
    fn dark_pictures_are_truncated_and_not_scaled() {
        let film = film(&[[0.0, 0.999, 1.0], [254.999, 127.5, 3.0]]);
        assert_eq!(codes8(&film), Ok(vec![0, 0, 1, 254, 127, 3]));
        assert_eq!(codes16(&film), Ok(vec![0, 256, 257, 65534, 32767, 771]));
        assert_eq!(linear(&film).nth(2), Some(1.0 / 255.0));
    }

    #[test]
    fn bright_pictures_are_scaled_to_their_brightest_component() {
        let film = film(&[[1020.0, 510.0, 0.0], [4.0, 3.9, 255.0]]);
        assert_eq!(codes8(&film), Ok(vec![255, 127, 0, 1, 0, 63]));
        assert_eq!(codes16(&film), Ok(vec![65535, 32767, 0, 257, 250, 16383]));
    }

    #[test]
    fn what_is_not_a_number_is_black() {
        let film = film(&[[f32::NAN, -1.0, 255.0]]);
        assert_eq!(codes8(&film), Ok(vec![0, 0, 255]));
    }

    #[test]
    fn an_infinite_component_makes_the_picture_black_as_in_the_original() {
        let film = film(&[[f32::INFINITY, 255.0, 0.0]]);
        assert_eq!(codes8(&film), Ok(vec![0, 0, 0]));
    }

    #[test]
    fn a_crop_needs_the_peak_of_the_frame() {
        let frame = Size::new(4, 1);
        let window = lancer_film::Window { x: 1, y: 0, width: 1, height: 1 };
        let mut crop =
            Film::new(frame, window, Display::Brightest { white: 255.0 }).expect("it fits");
        crop.put(window, &[[100.0; 3]]);
        assert_eq!(codes8(&crop), Err(PeakUnknown));
        crop.set_frame_peak(510.0);
        assert_eq!(codes8(&crop), Ok(vec![50; 3]));
    }
}
