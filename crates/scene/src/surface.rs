use crate::{Colour, Gloss, OutOfRange};

/// What a shape's surface looks like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Its colour; the first one where the pattern has two.
    pub colour: Colour,
    /// How much of the light it mirrors.
    pub gloss: Gloss,
    /// How colours are laid out on it.
    pub pattern: Pattern,
}

/// How colours are laid out on a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pattern {
    /// One colour everywhere.
    #[default]
    Solid,
    /// A checker of the surface's colour and a second one.
    Checker(Colour),
}

impl Surface {
    /// A matte surface of one colour.
    #[must_use]
    pub const fn new(colour: Colour) -> Self {
        Self { colour, gloss: Gloss::MATTE, pattern: Pattern::Solid }
    }

    /// The same surface with a checker of `second` on it.
    #[must_use]
    pub const fn checker(self, second: Colour) -> Self {
        Self { pattern: Pattern::Checker(second), ..self }
    }

    /// The same surface, mirroring the fraction `gloss` of the light.
    ///
    /// # Errors
    /// Where `gloss` is not in [0, 1].
    pub fn gloss(self, gloss: f64) -> Result<Self, OutOfRange> {
        Ok(Self { gloss: Gloss::new(gloss)?, ..self })
    }
}
