//! Drawings made of lines, convex shapes and words; what they look like as SVG and as pixels.
//!
//! No library draws words in pixels without fonts of the system, which differ, or code in C; so the
//! few shapes that a chart needs are drawn here, and letters come ready-made.

mod raster;
mod svg;

pub use raster::Raster;
pub(crate) use svg::escaped;

/// Red, green and blue, from 0 to 255.
pub(crate) type Colour = [u8; 3];

/// A place in a drawing: to the right and down from the top left corner.
pub(crate) type At = [f64; 2];

/// How words are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Hand {
    /// Beside points.
    Small,
    /// Everything else.
    Plain,
    /// Above all.
    Title,
}

impl Hand {
    /// Height of the letters' box.
    pub(crate) const fn size(self) -> f64 {
        match self {
            Self::Small => 9.5,
            Self::Plain | Self::Title => 12.0,
        }
    }

    /// How much room a letter may take, whoever draws it.
    pub(crate) const fn advance(self) -> f64 {
        match self {
            Self::Small => 6.5,
            Self::Plain | Self::Title => 9.0,
        }
    }

    /// Room for a text.
    pub(crate) fn width(self, text: &str) -> f64 {
        self.advance() * text.chars().count() as f64
    }
}

/// Which part of a text is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// A piece of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Shape {
    Line {
        points: Vec<At>,
        width: f64,
        colour: Colour,
        /// Its dashes and gaps are that long; 0 has none.
        dash: f64,
    },
    Disc {
        centre: At,
        radius: f64,
        colour: Colour,
    },
    /// Only its edge.
    Ring {
        centre: At,
        radius: f64,
        width: f64,
        colour: Colour,
    },
    /// Corners in the order in which a clock's hand passes them.
    Polygon {
        corners: Vec<At>,
        colour: Colour,
    },
    Words {
        at: At,
        text: String,
        hand: Hand,
        anchor: Anchor,
        colour: Colour,
        /// Whether it runs upwards.
        upward: bool,
    },
}

/// Shapes on white, the last one on top.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) shapes: Vec<Shape>,
    /// What is said to those who do not see it.
    pub(crate) title: String,
}
