use crate::{Degrees, Direction, InvalidField, Length, OutOfRange, PixelCount, Position};
use lancer_math::{Vector, sin_cos_degrees};

/// A camera that looks from a point at a point, with z up unless it says
/// otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    origin: Position,
    target: Position,
    /// How space is brought onto the picture.
    pub projection: Projection,
    /// Which way is up in the picture; need not be perpendicular to the view.
    pub up: Direction,
    /// How far the camera is turned about its axis, clockwise as seen from
    /// behind it: the picture turns counterclockwise.
    pub roll: Degrees,
    /// The diameter of its lens, which lies around `origin` across the view; around the
    /// start of each ray where they are parallel. `None` for a pinhole, to which
    /// everything is sharp.
    pub aperture: Option<Length>,
    /// How far from the lens, along the axis, the plane is that is seen sharply; `None`
    /// for the plane through `target`.
    pub focus: Option<Length>,
    /// How radiance becomes brightness on a display.
    pub exposure: Exposure,
    /// The width of the picture in pixels.
    pub px_width: PixelCount,
    /// The height of the picture in pixels.
    pub px_height: PixelCount,
}

/// How space is brought onto the picture, whose pixels are square.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Through a point: `target` lies in the image plane, at its centre, and the
    /// plane is so wide.
    Pinhole(Length),
    /// Through a point: the picture's left and right edge are so many degrees
    /// apart; above 0 and below 180.
    FieldOfView(Degrees),
    /// Along parallel rays from the plane through `origin` across the view, so
    /// wide.
    Orthographic(Length),
}

/// How radiance becomes brightness on a display.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Exposure {
    /// By what is in the picture.
    #[default]
    Auto,
    /// Times 2 to so many stops.
    Stops(Stops),
}

/// A number of stops: each doubles the brightness; from -1000 to 1000.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct Stops(f64);

impl Stops {
    /// # Errors
    /// Where `value` is not from -1000 to 1000.
    pub fn new(value: f64) -> Result<Self, OutOfRange> {
        if (-1000.0..=1000.0).contains(&value) {
            Ok(Self(value + 0.0))
        } else {
            Err(OutOfRange::new(value, "a number of stops from -1000 to 1000"))
        }
    }

    /// The number itself.
    #[must_use]
    pub const fn get(self) -> f64 {
        self.0
    }
}

impl Camera {
    /// A pinhole camera at `origin` that looks at `target`, with an image plane
    /// `width` wide there and a picture of `pixels` (width, height).
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
        let projection = Projection::Pinhole(width);
        Self::from_values(origin, target, projection, px_width, px_height)
            .map_err(|e| e.in_field("target"))
    }

    /// The same from values that are known to be in range.
    ///
    /// # Errors
    /// Where `target` is the same point as `origin`.
    pub fn from_values(
        origin: Position,
        target: Position,
        projection: Projection,
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
        Ok(Self {
            origin,
            target,
            projection,
            up: Direction::Z,
            roll: Degrees::ZERO,
            aperture: None,
            focus: None,
            exposure: Exposure::Auto,
            px_width,
            px_height,
        })
    }

    /// The same camera with a field of view of so many degrees from left to
    /// right.
    ///
    /// # Errors
    /// Where it is not above 0 and below 180.
    pub fn field_of_view(self, degrees: f64) -> Result<Self, InvalidField> {
        let view = Degrees::view(degrees).map_err(|e| e.in_field("fov"))?;
        Ok(Self { projection: Projection::FieldOfView(view), ..self })
    }

    /// The same camera with parallel rays and a picture `width` wide.
    ///
    /// # Errors
    /// Where `width` is not a finite number above 0.
    pub fn orthographic(self, width: f64) -> Result<Self, InvalidField> {
        let width = Length::new(width).map_err(|e| e.in_field("width"))?;
        Ok(Self { projection: Projection::Orthographic(width), ..self })
    }

    /// The same camera with another upward direction.
    ///
    /// # Errors
    /// Where it is zero or not finite.
    pub fn up(self, xyz: [f64; 3]) -> Result<Self, InvalidField> {
        let up = Direction::new(xyz).map_err(|e| e.in_field("up"))?;
        Ok(Self { up, ..self })
    }

    /// The same camera, turned clockwise about its axis as seen from behind it.
    ///
    /// # Errors
    /// Where `degrees` is not finite.
    pub fn roll(self, degrees: f64) -> Result<Self, InvalidField> {
        let roll = Degrees::new(degrees).map_err(|e| e.in_field("roll"))?;
        Ok(Self { roll, ..self })
    }

    /// The same camera with a thin lens of that diameter, or with 0 with a pinhole. What
    /// is at a distance of z along the axis is blurred to a disc that is as wide as the lens
    /// times |z - focus| / z, seen in the plane in focus; times |z - focus| / focus where rays
    /// are parallel.
    ///
    /// # Errors
    /// Where `diameter` is not a finite number of at least 0.
    pub fn aperture(self, diameter: f64) -> Result<Self, InvalidField> {
        let aperture = Length::or_none(diameter).map_err(|e| e.in_field("aperture"))?;
        Ok(Self { aperture, ..self })
    }

    /// The same camera, focused on the plane at that distance along its axis.
    ///
    /// # Errors
    /// Where `distance` is not a finite number above 0.
    pub fn focus(self, distance: f64) -> Result<Self, InvalidField> {
        let focus = Length::new(distance).map_err(|e| e.in_field("focus"))?;
        Ok(Self { focus: Some(focus), ..self })
    }

    /// The same camera, exposed by so many stops.
    ///
    /// # Errors
    /// Where `stops` is not from -1000 to 1000.
    pub fn stops(self, stops: f64) -> Result<Self, InvalidField> {
        let stops = Stops::new(stops).map_err(|e| e.in_field("exposure"))?;
        Ok(Self { exposure: Exposure::Stops(stops), ..self })
    }

    /// Where the eye is.
    #[must_use]
    pub const fn origin(&self) -> Position {
        self.origin
    }

    /// The centre of the picture; never the eye itself.
    #[must_use]
    pub const fn target(&self) -> Position {
        self.target
    }

    /// The width of the plane of the picture: through `target`, or through
    /// `origin` where rays are parallel.
    #[must_use]
    pub fn plane_width(&self) -> f64 {
        match self.projection {
            Projection::Pinhole(width) | Projection::Orthographic(width) => width.get(),
            Projection::FieldOfView(angle) => {
                let (sine, cosine) = sin_cos_degrees(angle.get() / 2.0);
                let distance: Vector = self.target.get() - self.origin.get();
                2.0 * distance.norm() * (sine / cosine)
            }
        }
    }
}
