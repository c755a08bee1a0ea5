use image::{DynamicImage, ImageReader, Limits};
use std::io::Cursor;

/// A picture that was read from a file.
#[derive(Debug, Clone)]
pub struct Picture {
    /// Its width in pixels.
    pub width: u32,
    /// Its height in pixels.
    pub height: u32,
    samples: Samples,
}

/// Red, green, blue and opacity for each pixel.
#[derive(Debug, Clone)]
enum Samples {
    Eight(Vec<u8>),
    Sixteen(Vec<u16>),
    Float(Vec<f32>),
}

/// Why a picture could not be read.
#[derive(Debug, thiserror::Error)]
pub enum DecodeError {
    /// The first bytes are not those of any format.
    #[error("not a picture in any format that can be read")]
    Unknown,
    /// The format is known, but the picture is broken.
    #[error("the picture is broken: {0}")]
    Broken(#[from] image::ImageError),
}

/// The most memory that decoding may take, in bytes.
const MOST_MEMORY: u64 = 8 << 30;

/// Reads a picture file; its format is recognised by its first bytes, TGA
/// (which has no such mark) by being nothing else.
///
/// # Errors
/// Where the bytes are no picture, or one in an unknown format.
pub fn decode(bytes: &[u8]) -> Result<Picture, DecodeError> {
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(image::ImageError::IoError)?;
    let known = reader.format().is_some();
    if !known {
        reader.set_format(image::ImageFormat::Tga);
    }
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_MEMORY);
    reader.limits(limits);
    let image = match reader.decode() {
        Err(_) if !known => return Err(DecodeError::Unknown),
        image => image?,
    };
    let (width, height) = (image.width(), image.height());
    let samples = match image {
        DynamicImage::ImageLuma16(_)
        | DynamicImage::ImageLumaA16(_)
        | DynamicImage::ImageRgb16(_)
        | DynamicImage::ImageRgba16(_) => Samples::Sixteen(image.into_rgba16().into_raw()),
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            Samples::Float(image.into_rgba32f().into_raw())
        }
        _ => Samples::Eight(image.into_rgba8().into_raw()),
    };
    Ok(Picture { width, height, samples })
}

impl Picture {
    /// Red, green, blue and opacity of pixel number `index`, row by row, in
    /// levels of 255: 255 is display white. Codes of 8 and of 16 bits that mean
    /// the same give the same levels.
    ///
    /// # Panics
    /// Where there is no such pixel.
    #[must_use]
    pub fn levels(&self, index: usize) -> [f64; 4] {
        fn four<T: Copy>(samples: &[T], index: usize, level: impl Fn(T) -> f64) -> [f64; 4] {
            std::array::from_fn(|channel| level(samples[index * 4 + channel]))
        }
        match &self.samples {
            Samples::Eight(samples) => four(samples, index, f64::from),
            Samples::Sixteen(samples) => four(samples, index, |v| f64::from(v) / 257.0),
            Samples::Float(samples) => four(samples, index, |v| f64::from(v) * 255.0),
        }
    }
}
