use std::path::Path;

/// A kind of picture file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Portable pixmap, binary (P6).
    Ppm,
    /// Portable Network Graphics.
    Png,
    /// OpenEXR: linear values, 1 is display white (at 0 stops, for radiance).
    Exr,
    /// Windows bitmap.
    Bmp,
    /// JPEG, lossy.
    Jpeg,
    /// Quite OK Image.
    Qoi,
    /// Truevision TGA.
    Tga,
    /// TIFF.
    Tiff,
    /// WebP, lossless.
    Webp,
}

/// How many bits each component of a pixel has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Bits {
    /// Codes from 0 to 255.
    #[default]
    Eight,
    /// Codes from 0 to 65535.
    Sixteen,
}

impl Format {
    /// All formats, with their names, the first of which is also the usual
    /// extension.
    pub const ALL: &[(Self, &'static [&'static str])] = &[
        (Self::Ppm, &["ppm", "pnm"]),
        (Self::Png, &["png"]),
        (Self::Exr, &["exr"]),
        (Self::Bmp, &["bmp"]),
        (Self::Jpeg, &["jpeg", "jpg"]),
        (Self::Qoi, &["qoi"]),
        (Self::Tga, &["tga"]),
        (Self::Tiff, &["tiff", "tif"]),
        (Self::Webp, &["webp"]),
    ];

    /// The format of that name, in capitals or not.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        Self::ALL.iter().find(|(_, names)| names.contains(&&*name)).map(|(format, _)| *format)
    }

    /// The format that the extension of `path` names.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        Self::from_name(path.extension()?.to_str()?)
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(format, _)| *format == self).map_or("", |(_, names)| names[0])
    }

    /// Whether it can hold 16 bits for each component.
    #[must_use]
    pub const fn has_16_bits(self) -> bool {
        matches!(self, Self::Ppm | Self::Png | Self::Tiff)
    }

    /// The most pixels that a picture may have along a side, where the format has
    /// such a limit.
    #[must_use]
    pub const fn longest_side(self) -> Option<u32> {
        match self {
            Self::Webp => Some(16_384),
            Self::Jpeg | Self::Tga => Some(65_535),
            _ => None,
        }
    }

    /// Whether it holds linear values instead of codes for a display.
    #[must_use]
    pub const fn is_linear(self) -> bool {
        matches!(self, Self::Exr)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extensions_are_recognised() {
        for (path, expected) in [
            ("a.png", Some(Format::Png)),
            ("dir.exr/b.PPM", Some(Format::Ppm)),
            ("c.jpg", Some(Format::Jpeg)),
            ("d.png.bak", None),
            ("png", None),
            (".png", None),
        ] {
            assert_eq!(Format::from_path(Path::new(path)), expected, "{path}");
        }
        for (format, names) in Format::ALL {
            assert_eq!(Format::from_name(names[0]), Some(*format));
            assert_eq!(format.name(), names[0]);
        }
    }
}
