//! From the values of a film to the codes of a display.

use crate::srgb_codes::{Codes8, code16};
use lancer_film::{Display, Film};
use rayon::prelude::*;

/// Why a film cannot be shown: it does not know enough of the frame that it is
/// of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NotShowable {
    /// A film of a part of a frame cannot be shown by a rule that looks at the
    /// whole frame.
    #[error(
        "the brightness of the whole frame must be known to show a part of it: render with the \
         frame's peak"
    )]
    PeakUnknown,
    /// A film of radiance cannot be shown without an exposure.
    #[error(
        "the exposure must be known to show radiance: set the film's stops, to a choice or to \
         what is found for the whole frame"
    )]
    ExposureUnknown,
}

/// `head`, and behind it codes from 0 to 255 for each component, row by row.
pub(crate) fn codes8(film: &Film, head: &[u8]) -> Result<Vec<u8>, NotShowable> {
    Ok(match film.display() {
        Display::Brightest { white } => {
            let scale = scale(film, white, 255.0)?;
            // The conversion truncates, and turns NaN and negative numbers into 0.
            components(film, head, |v| [(v * scale) as u8])
        }
        Display::Exposed => {
            let factor = film.exposure().ok_or(NotShowable::ExposureUnknown)?;
            let codes = Codes8::table();
            components(film, head, |v| [codes.code(f64::from(v) * factor)])
        }
    })
}

/// `head`, and behind it codes from 0 to 65535 for each component, row by row, as
/// the bytes that `bytes_of` makes of them.
pub(crate) fn codes16(
    film: &Film,
    head: &[u8],
    bytes_of: fn(u16) -> [u8; 2],
) -> Result<Vec<u8>, NotShowable> {
    Ok(match film.display() {
        Display::Brightest { white } => {
            let scale = scale(film, white, 65535.0)?;
            components(film, head, |v| bytes_of((v * scale) as u16))
        }
        Display::Exposed => {
            let factor = film.exposure().ok_or(NotShowable::ExposureUnknown)?;
            components(film, head, |v| bytes_of(code16(f64::from(v) * factor)))
        }
    })
}

/// Linear values, 1 being display white (for radiance at 0 stops: its exposure
/// is not applied), for each component, row by row, as this machine has them in
/// memory.
pub(crate) fn linear(film: &Film) -> Vec<u8> {
    let display = film.display();
    components(film, &[], |v| linear_value(display, v).to_ne_bytes())
}

/// `head`, and behind it `SIZE` bytes for each component of the film, row by row,
/// made on all threads of the pool that it is called in.
fn components<const SIZE: usize>(
    film: &Film,
    head: &[u8],
    bytes_of: impl Fn(f32) -> [u8; SIZE] + Sync,
) -> Vec<u8> {
    /// So many components are worth another thread's while.
    const BATCH: usize = 1 << 16;
    let values = film.pixels().as_flattened();
    // The system has zeros ready; each thread is the first to touch its part.
    let mut bytes = vec![0; head.len() + SIZE * values.len()];
    let (start, rest) = bytes.split_at_mut(head.len());
    start.copy_from_slice(head);
    let places = rest.as_chunks_mut().0;
    places.par_chunks_mut(BATCH).zip(values.par_chunks(BATCH)).for_each(|(places, values)| {
        for (place, v) in places.iter_mut().zip(values) {
            *place = bytes_of(*v);
        }
    });
    bytes
}

/// The factor of [`Display::Brightest`] from the film's values to codes up to
/// `top`, before truncation.
fn scale(film: &Film, white: f32, top: f32) -> Result<f32, NotShowable> {
    let peak = film.frame_peak().ok_or(NotShowable::PeakUnknown)?;
    Ok(top / if peak > white { peak } else { white })
}

/// The linear value of one component; for radiance the very bits.
pub(crate) fn linear_value(display: Display, v: f32) -> f32 {
    match display {
        Display::Brightest { white } => v / white,
        Display::Exposed => v,
    }
}

/// The film as a display of 8 bits shows it.
///
/// # Errors
/// Where the film's rule needs to know more of the frame than the film does.
///
/// # Panics
/// Never: the buffer has the size that the film says.
pub fn to_rgb8(film: &Film) -> Result<image::RgbImage, NotShowable> {
    let window = film.window();
    let image = image::RgbImage::from_raw(window.width, window.height, codes8(film, &[])?);
    Ok(image.expect("three codes for each pixel"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lancer_film::Size;

    fn codes8(film: &Film) -> Result<Vec<u8>, NotShowable> {
        super::codes8(film, &[])
    }

    fn codes16(film: &Film) -> Result<Vec<u16>, NotShowable> {
        let bytes = super::codes16(film, &[], u16::to_ne_bytes)?;
        Ok(bytes.as_chunks().0.iter().map(|code| u16::from_ne_bytes(*code)).collect())
    }

    fn linear(film: &Film) -> Vec<f32> {
        super::linear(film).as_chunks().0.iter().map(|v| f32::from_ne_bytes(*v)).collect()
    }

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
        assert_eq!(linear(&film)[2], 1.0 / 255.0);
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
        assert_eq!(codes8(&crop), Err(NotShowable::PeakUnknown));
        crop.set_frame_peak(510.0);
        assert_eq!(codes8(&crop), Ok(vec![50; 3]));
    }

    fn exposed(values: &[[f32; 3]], stops: f64) -> Film {
        let frame = Size::new(values.len() as u32, 1);
        let mut film = Film::new(frame, frame.window(), Display::Exposed).expect("it fits");
        film.put(frame.window(), values);
        film.set_stops(stops);
        film
    }

    #[test]
    fn radiance_is_encoded_and_rounded() {
        let film = exposed(&[[0.0, 0.5, 1.0], [0.25, 0.002, 0.18]], 0.0);
        // 187.516, 136.96, 6.589 and 117.65 before rounding.
        assert_eq!(codes8(&film), Ok(vec![0, 188, 255, 137, 7, 118]));
        assert_eq!(codes16(&film), Ok(vec![0, 48192, 65535, 35199, 1693, 30235]));
        assert_eq!(linear(&film), [0.0, 0.5, 1.0, 0.25, 0.002, 0.18]);
    }

    #[test]
    fn a_stop_doubles_what_is_shown_and_not_what_is_kept() {
        let values: Vec<_> = (0..200_u8).map(|i| [0.01 * f32::from(i), 0.3, 7.0]).collect();
        let halves: Vec<_> = values.iter().map(|pixel| pixel.map(|v| v / 2.0)).collect();
        for stops in [-3.0, -0.578_125, 0.0, 4.25] {
            let (one, other) = (exposed(&values, stops), exposed(&halves, stops + 1.0));
            assert_eq!(codes8(&one), codes8(&other));
            assert_eq!(codes16(&one), codes16(&other));
            assert_eq!(linear(&one), values.as_flattened());
        }
    }

    #[test]
    fn a_bad_pixel_is_black_or_white_and_alone() {
        let good = [[0.2, 0.4, 0.8], [0.6, 0.1, 0.3]];
        for stops in [0.0, -2.5, 1000.0, -1000.0] {
            let expected = (codes8(&exposed(&good, stops)), codes16(&exposed(&good, stops)));
            let expected = (expected.0.expect("it shows"), expected.1.expect("it shows"));
            for bad in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, -0.0] {
                let film = exposed(&[good[0], [bad; 3], good[1]], stops);
                let eight = codes8(&film).expect("it shows");
                let sixteen = codes16(&film).expect("it shows");
                let (top8, top16) = if bad == f32::INFINITY { (255, 65535) } else { (0, 0) };
                assert_eq!((&eight[..3], &eight[6..]), expected.0.split_at(3), "{bad}");
                assert_eq!((&sixteen[..3], &sixteen[6..]), expected.1.split_at(3), "{bad}");
                assert_eq!((&eight[3..6], &sixteen[3..6]), (&[top8; 3][..], &[top16; 3][..]));
            }
        }
    }

    #[test]
    fn radiance_needs_an_exposure() {
        let frame = Size::new(1, 1);
        let film = Film::new(frame, frame.window(), Display::Exposed).expect("it fits");
        assert_eq!(codes8(&film), Err(NotShowable::ExposureUnknown));
        assert_eq!(codes16(&film), Err(NotShowable::ExposureUnknown));
        assert!(NotShowable::ExposureUnknown.to_string().contains("set the film's stops"));
        assert_eq!(linear(&film).len(), 3, "linear values need none");
    }

    /// As many components as keep several threads busy, none of them alike.
    #[test]
    fn any_number_of_threads_makes_the_same_bytes() {
        let frame = Size::new(511, 391);
        let values: Vec<_> =
            (0..511 * 391).map(|i| [0.001 * i as f32, 1.0 / (1 + i) as f32, 0.18]).collect();
        for display in [Display::Brightest { white: 255.0 }, Display::Exposed] {
            let mut film = Film::new(frame, frame.window(), display).expect("it fits");
            film.put(frame.window(), &values);
            film.set_stops(-1.5);
            let all = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
                pool.expect("they start").install(|| {
                    [
                        super::codes8(&film, b"head").expect("it shows"),
                        super::codes16(&film, b"another", u16::to_be_bytes).expect("it shows"),
                        super::linear(&film),
                    ]
                })
            };
            let one = all(1);
            assert!(one[0].starts_with(b"head") && one[1].starts_with(b"another"));
            for threads in [2, 3, 7] {
                assert!(all(threads) == one, "{threads} threads, {display:?}");
            }
            // The definition, without batches.
            let slowly: Vec<_> =
                film.pixels().iter().flatten().map(|v| linear_value(display, *v)).collect();
            assert_eq!(linear(&film), slowly);
        }
    }
}
