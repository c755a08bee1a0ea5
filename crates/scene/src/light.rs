use crate::{Brightness, Degrees, Direction, InvalidField, Length, OutOfRange, Position};

/// A source of white light. None of them can be seen itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Light {
    /// Shines from a point in all directions.
    Lamp {
        /// Where it is.
        point: Position,
        /// That of the ball around `point` from whose whole surface it shines equally
        /// in all directions; `None` where it shines from the point alone.
        radius: Option<Length>,
        /// How strong it is at distance 1.
        brightness: Brightness,
        /// How it weakens with distance.
        falloff: Falloff,
    },
    /// Shines from infinitely far away.
    Sun {
        /// The direction in which the light travels; any length.
        direction: Direction,
        /// How strong it is.
        brightness: Brightness,
    },
    /// Shines from a point into a cone.
    Spot {
        /// Where it is.
        point: Position,
        /// That of the ball from whose surface it shines, as a lamp does; what the beam
        /// leaves of its light goes by the direction from `point`.
        radius: Option<Length>,
        /// The direction of the middle of its light; any length.
        axis: Direction,
        /// The beam.
        beam: Beam,
        /// How strong it is on its axis at distance 1.
        brightness: Brightness,
        /// How it weakens with distance.
        falloff: Falloff,
    },
}

/// How the light of a lamp weakens with distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Falloff {
    /// With its square, as light does.
    #[default]
    Square,
    /// Not at all, as in the original program.
    None,
}

/// The cone of a spot lamp: full light up to the inner angle from its axis,
/// none from the outer one on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beam {
    inner: Degrees,
    outer: Degrees,
}

impl Beam {
    /// # Errors
    /// Where an angle is not from 0 to 180 degrees, or `inner` is above
    /// `outer`.
    pub fn new(inner: f64, outer: f64) -> Result<Self, InvalidField> {
        let inner = Degrees::from_axis(inner).map_err(|e| e.in_field("inner"))?;
        let outer = Degrees::from_axis(outer).map_err(|e| e.in_field("outer"))?;
        if inner > outer {
            let found = OutOfRange::new(inner.get(), "an angle of at most the outer one");
            return Err(found.in_field("inner"));
        }
        Ok(Self { inner, outer })
    }

    /// The angle from the axis up to which there is full light.
    #[must_use]
    pub const fn inner(self) -> Degrees {
        self.inner
    }

    /// The angle from the axis from which on there is none.
    #[must_use]
    pub const fn outer(self) -> Degrees {
        self.outer
    }
}

/// What transparent things do to the light of lamps and suns on its straight
/// way to a surface. Both are approximations: light that is bent on its way,
/// and so gathers in bright lines, is not followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Shadows {
    /// They let through, unbent, what their faces and their media leave of it.
    #[default]
    Tinted,
    /// They let nothing through.
    Opaque,
}

impl Light {
    /// A lamp at `point` whose light falls off with the square of the distance.
    ///
    /// # Errors
    /// Where a number is not finite or `brightness` is negative.
    pub fn lamp(point: [f64; 3], brightness: f64) -> Result<Self, InvalidField> {
        Ok(Self::Lamp {
            point: Position::new(point).map_err(|e| e.in_field("point"))?,
            radius: None,
            brightness: Brightness::new(brightness).map_err(|e| e.in_field("brightness"))?,
            falloff: Falloff::Square,
        })
    }

    /// A sun whose light travels along `direction`.
    ///
    /// # Errors
    /// Where a number is not finite, `direction` is zero or `brightness` is
    /// negative.
    pub fn sun(direction: [f64; 3], brightness: f64) -> Result<Self, InvalidField> {
        Ok(Self::Sun {
            direction: Direction::new(direction).map_err(|e| e.in_field("direction"))?,
            brightness: Brightness::new(brightness).map_err(|e| e.in_field("brightness"))?,
        })
    }

    /// A spot lamp at `point` that shines along `axis`; the angles, in degrees
    /// from the axis, are where its light begins to fade and where it ends.
    ///
    /// # Errors
    /// Where a number is not finite, `axis` is zero, `brightness` is negative,
    /// an angle is not from 0 to 180, or the inner one is above the outer one.
    pub fn spot(
        point: [f64; 3],
        axis: [f64; 3],
        [inner, outer]: [f64; 2],
        brightness: f64,
    ) -> Result<Self, InvalidField> {
        Ok(Self::Spot {
            point: Position::new(point).map_err(|e| e.in_field("point"))?,
            radius: None,
            axis: Direction::new(axis).map_err(|e| e.in_field("axis"))?,
            beam: Beam::new(inner, outer)?,
            brightness: Brightness::new(brightness).map_err(|e| e.in_field("brightness"))?,
            falloff: Falloff::Square,
        })
    }

    /// The same light, as strong far away as near; suns are so anyway.
    #[must_use]
    pub const fn without_falloff(mut self) -> Self {
        match &mut self {
            Self::Lamp { falloff, .. } | Self::Spot { falloff, .. } => *falloff = Falloff::None,
            Self::Sun { .. } => {}
        }
        self
    }

    /// The same light from a ball of that radius around its point, or with 0 from the
    /// point alone; suns have none. What a surface gets from a ball that is wholly above
    /// its horizon, and that nothing hides, is what it gets from the point.
    ///
    /// # Errors
    /// Where `radius` is not a finite number of at least 0.
    pub fn with_radius(mut self, radius: f64) -> Result<Self, InvalidField> {
        let new = Length::or_none(radius).map_err(|e| e.in_field("radius"))?;
        match &mut self {
            Self::Lamp { radius, .. } | Self::Spot { radius, .. } => *radius = new,
            Self::Sun { .. } => {}
        }
        Ok(self)
    }

    /// The radius of the ball that it shines from, if it does so.
    #[must_use]
    pub const fn radius(&self) -> Option<Length> {
        match self {
            Self::Lamp { radius, .. } | Self::Spot { radius, .. } => *radius,
            Self::Sun { .. } => None,
        }
    }

    /// How strong it is.
    #[must_use]
    pub const fn brightness(&self) -> Brightness {
        match self {
            Self::Lamp { brightness, .. }
            | Self::Sun { brightness, .. }
            | Self::Spot { brightness, .. } => *brightness,
        }
    }
}
