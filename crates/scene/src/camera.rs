use crate::{InvalidField, Length, OutOfRange, PixelCount, Position};

/// A pinhole camera that looks from a point at a point, with z up.
///
/// `target` lies in the image plane, at its centre; the plane is `width` wide
/// and `width * px_height / px_width` high, and its lower edge is horizontal.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    origin: Position,
    target: Position,
    /// The width of the image plane, in scene lengths.
    pub width: Length,
    /// The width of the picture in pixels.
    pub px_width: PixelCount,
    /// The height of the picture in pixels.
    pub px_height: PixelCount,
}

impl Camera {
    /// A camera at `origin` that looks at `target`, with an image plane
    /// `width` wide and a picture of `pixels` (width, height).
    ///
    /// # Errors
    /// Where a number is not finite, `width` or a side of the picture is not
    /// positive, or `target` is the same point as `origin`.
    pub fn new(
        origin: [f64; 3],
        target: [f64; 3],
        width: f64,
        pixels: [u32; 2],
    ) -> Result<Self, InvalidField> {
        let origin = Position::new(origin).map_err(|e| e.in_field("origin"))?;
        let target = Position::new(target).map_err(|e| e.in_field("target"))?;
        let width = Length::new(width).map_err(|e| e.in_field("width"))?;
        let px_width = PixelCount::new(pixels[0]).map_err(|e| e.in_field("px_width"))?;
        let px_height = PixelCount::new(pixels[1]).map_err(|e| e.in_field("px_height"))?;
        Self::from_values(origin, target, width, px_width, px_height)
            .map_err(|e| e.in_field("target"))
    }

    /// The same from values that are known to be in range.
    ///
    /// # Errors
    /// Where `target` is the same point as `origin`.
    pub fn from_values(
        origin: Position,
        target: Position,
        width: Length,
        px_width: PixelCount,
        px_height: PixelCount,
    ) -> Result<Self, OutOfRange> {
        if origin == target {
            let p = target.get();
            return Err(OutOfRange::new(
                format!("({}, {}, {})", p.x, p.y, p.z),
                "a point other than the origin",
            ));
        }
        Ok(Self { origin, target, width, px_width, px_height })
    }

    /// Where the eye is.
    #[must_use]
    pub const fn origin(&self) -> Position {
        self.origin
    }

    /// The centre of the image plane; never the eye itself.
    #[must_use]
    pub const fn target(&self) -> Position {
        self.target
    }
}
