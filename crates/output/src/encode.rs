use crate::display::{NotShowable, codes8, codes16, linear};
use crate::{Bits, Format};
use image::codecs::{
    bmp::BmpEncoder, jpeg::JpegEncoder, openexr::OpenExrEncoder, png::PngEncoder, qoi::QoiEncoder,
    tga::TgaEncoder, tiff::TiffEncoder, webp::WebPEncoder,
};
use image::{ExtendedColorType, ImageEncoder};
use lancer_film::{Film, Size, Window};
use std::io::Cursor;

/// Why a film could not become a file.
#[derive(Debug, thiserror::Error)]
pub enum EncodeError {
    /// The film does not know enough of its frame.
    #[error(transparent)]
    NotShowable(#[from] NotShowable),
    /// The format has no such number of bits.
    #[error("the format {} has 8 bits for each component, not 16", .0.name())]
    Bits(Format),
    /// The layers are not those of the film's pixels.
    #[error(
        "the layers are of the window {} (x,y,width,height) of {} pixels, the film of {} of {}",
        .layers.1, .layers.0, .film.1, .film.0
    )]
    OtherWindow {
        /// The frame and the window of the film.
        film: (Size, Window),
        /// Those of the layers.
        layers: (Size, Window),
    },
    /// The encoder refused, because the picture is too large for the format or
    /// memory does not suffice.
    #[error("cannot write this picture as {}: {reason}", .format.name())]
    Encoder {
        /// The format.
        format: Format,
        /// What its encoder said.
        reason: image::ImageError,
    },
}

/// How good JPEG pictures are, out of 100.
const JPEG_QUALITY: u8 = 95;

/// The bytes of a picture file. `bits` means nothing for linear formats; neither
/// does an exposure, they hold the radiance itself.
///
/// # Errors
/// Where the format cannot hold the picture.
pub fn encode(film: &Film, format: Format, bits: Bits) -> Result<Vec<u8>, EncodeError> {
    let size = (film.window().width, film.window().height);
    if format.is_linear() {
        return write(format, &linear(film), size, ExtendedColorType::Rgb32F);
    }
    match (format, bits) {
        // Pixmaps are codes and nothing else, so they are made in their place.
        (Format::Ppm, Bits::Eight) => Ok(codes8(film, &ppm_head(size, 255))?),
        // The most significant byte comes first.
        (Format::Ppm, Bits::Sixteen) => {
            Ok(codes16(film, &ppm_head(size, 65535), u16::to_be_bytes)?)
        }
        (_, Bits::Eight) => write(format, &codes8(film, &[])?, size, ExtendedColorType::Rgb8),
        (_, Bits::Sixteen) if format.has_16_bits() => {
            let bytes = codes16(film, &[], u16::to_ne_bytes)?;
            write(format, &bytes, size, ExtendedColorType::Rgb16)
        }
        (_, Bits::Sixteen) => Err(EncodeError::Bits(format)),
    }
}

/// The bytes of a picture file from a picture of 8 bits.
///
/// # Errors
/// Where the format cannot hold the picture.
pub fn encode_rgb8(image: &image::RgbImage, format: Format) -> Result<Vec<u8>, EncodeError> {
    write(format, image, image.dimensions(), ExtendedColorType::Rgb8)
}

/// The bytes of a picture file from samples; those of a pixmap have 8 bits.
fn write(
    format: Format,
    samples: &[u8],
    (width, height): (u32, u32),
    kind: ExtendedColorType,
) -> Result<Vec<u8>, EncodeError> {
    let mut file = Cursor::new(Vec::new());
    let out = &mut file;
    let result = match format {
        Format::Ppm => return Ok([&*ppm_head((width, height), 255), samples].concat()),
        Format::Png => PngEncoder::new(out).write_image(samples, width, height, kind),
        Format::Exr => OpenExrEncoder::new(out).write_image(samples, width, height, kind),
        Format::Bmp => BmpEncoder::new(out).write_image(samples, width, height, kind),
        Format::Jpeg => JpegEncoder::new_with_quality(out, JPEG_QUALITY)
            .write_image(samples, width, height, kind),
        Format::Qoi => QoiEncoder::new(out).write_image(samples, width, height, kind),
        Format::Tga => TgaEncoder::new(out).write_image(samples, width, height, kind),
        Format::Tiff => TiffEncoder::new(out).write_image(samples, width, height, kind),
        Format::Webp => WebPEncoder::new_lossless(out).write_image(samples, width, height, kind),
    };
    result.map_err(|reason| EncodeError::Encoder { format, reason })?;
    Ok(file.into_inner())
}

/// What stands before the codes, up to `top`, of a binary portable pixmap: the three
/// lines that the simplest readers expect (the library writes two, and no 16 bits).
fn ppm_head((width, height): (u32, u32), top: u16) -> Vec<u8> {
    format!("P6\n{width} {height}\n{top}\n").into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{compare, decode};
    use lancer_film::{Display, Size};

    fn film() -> Film {
        let frame = Size::new(5, 3);
        let mut film =
            Film::new(frame, frame.window(), Display::Brightest { white: 255.0 }).expect("it fits");
        let values: Vec<_> =
            (0..15_u8).map(|i| [f32::from(i) * 17.3, 255.0 - f32::from(i), 0.25]).collect();
        film.put(frame.window(), &values);
        film
    }

    #[test]
    fn lossless_formats_hold_the_same_codes() {
        let reference = decode(&encode(&film(), Format::Ppm, Bits::Eight).expect("it encodes"));
        let reference = reference.expect("it decodes");
        for (format, _) in Format::ALL {
            if format.is_linear() || *format == Format::Jpeg {
                continue;
            }
            let bytes = encode(&film(), *format, Bits::Eight).expect("it encodes");
            let picture = decode(&bytes).expect("it decodes");
            let comparison = compare(&reference, &picture).expect("same size");
            assert_eq!(comparison.differing, 0, "{format:?}");
        }
    }

    #[test]
    fn sixteen_bits_are_kept_or_refused() {
        let reference = encode(&film(), Format::Ppm, Bits::Sixteen).expect("it encodes");
        assert!(reference.starts_with(b"P6\n5 3\n65535\n"));
        let reference = decode(&reference).expect("it decodes");
        for (index, value) in film().pixels().iter().enumerate() {
            let codes = value.map(|v| f64::from((v * 257.0) as u16) / 257.0);
            assert_eq!(reference.levels(index)[..3], codes);
        }
        for (format, _) in Format::ALL.iter().filter(|(format, _)| !format.is_linear()) {
            match encode(&film(), *format, Bits::Sixteen) {
                Ok(bytes) => {
                    let picture = decode(&bytes).expect("it decodes");
                    let comparison = compare(&reference, &picture).expect("same size");
                    assert_eq!(comparison.differing, 0, "{format:?}");
                }
                Err(error) => assert!(matches!(error, EncodeError::Bits(_)), "{error}"),
            }
        }
    }

    #[test]
    fn exr_holds_radiance_before_exposure() {
        let frame = Size::new(2, 1);
        let mut film = Film::new(frame, frame.window(), Display::Exposed).expect("it fits");
        film.put(frame.window(), &[[0.1, 7.0, 1e-30], [3e30, 0.0, 0.7]]);
        let without = encode(&film, Format::Exr, Bits::Eight).expect("it encodes");
        film.set_stops(-5.5);
        assert_eq!(encode(&film, Format::Exr, Bits::Eight).expect("it encodes"), without);
        let image = image::load_from_memory(&without).expect("it decodes").into_rgb32f();
        assert!(image.pixels().map(|pixel| pixel.0).eq(film.pixels().iter().copied()));
    }

    #[test]
    fn a_film_without_exposure_is_refused_by_formats_of_codes() {
        let frame = Size::new(1, 1);
        let film = Film::new(frame, frame.window(), Display::Exposed).expect("it fits");
        for bits in [Bits::Eight, Bits::Sixteen] {
            let error = encode(&film, Format::Png, bits).expect_err("it says so");
            assert!(error.to_string().starts_with("the exposure must be known"), "{error}");
        }
    }

    #[test]
    fn exr_holds_linear_values_with_white_at_one() {
        let bytes = encode(&film(), Format::Exr, Bits::Eight).expect("it encodes");
        let image = image::load_from_memory(&bytes).expect("it decodes").into_rgb32f();
        for (pixel, value) in image.pixels().zip(film().pixels()) {
            assert_eq!(pixel.0, value.map(|v| v / 255.0));
        }
    }
}
