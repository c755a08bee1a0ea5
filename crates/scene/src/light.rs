use crate::{Brightness, Direction, InvalidField, Position};

/// A source of white light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Light {
    /// Shines from a point in all directions.
    Lamp {
        /// Where it is.
        point: Position,
        /// How strong it is.
        brightness: Brightness,
    },
    /// Shines from infinitely far away.
    Sun {
        /// The direction in which the light travels; any length.
        direction: Direction,
        /// How strong it is.
        brightness: Brightness,
    },
}

impl Light {
    /// A lamp at `point`.
    ///
    /// # Errors
    /// Where a number is not finite or `brightness` is negative.
    pub fn lamp(point: [f64; 3], brightness: f64) -> Result<Self, InvalidField> {
        Ok(Self::Lamp {
            point: Position::new(point).map_err(|e| e.in_field("point"))?,
            brightness: Brightness::new(brightness).map_err(|e| e.in_field("brightness"))?,
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

    /// How strong it is.
    #[must_use]
    pub const fn brightness(&self) -> Brightness {
        match self {
            Self::Lamp { brightness, .. } | Self::Sun { brightness, .. } => *brightness,
        }
    }
}
