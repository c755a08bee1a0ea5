use crate::{Colour, Degrees, Fraction, InvalidField, Ior, Length, Spectrum};

/// What a shape's surface looks like, and what is behind it.
///
/// With g the gloss, t the transparency and F the fraction that Fresnel's
/// equations let a clear surface mirror, the surface shows
/// emission + g mirror + (1-g) (t (F mirror + (1-F) refracted) + (1-t) matte).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Its matte colour; the first one where the pattern has two.
    pub colour: Colour,
    /// The fraction of light that it mirrors whatever the angle.
    pub gloss: Fraction,
    /// How colours are laid out on it.
    pub pattern: Pattern,
    /// The fraction, of what it does not mirror so, that behaves as a clear
    /// surface; the rest is matte.
    pub transparency: Fraction,
    /// What is behind a surface that is not wholly matte.
    pub medium: Medium,
    /// Whether it is a sheet: two faces so near that light passes without
    /// being bent, and no medium behind.
    pub thin: bool,
    /// What it shines by itself; seen directly and in mirrors, and lighting
    /// nothing.
    pub emission: Spectrum,
    /// Where transparent solids overlap, the medium is that of the one with the
    /// highest priority.
    pub priority: i32,
}

/// What fills a transparent solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// Its index of refraction.
    pub ior: Ior,
    /// How much of red, green and blue it takes away: after a length d the
    /// fraction exp(-absorption * d) is left (Beer and Lambert).
    pub absorption: Spectrum,
}

impl Medium {
    /// Around everything.
    pub const AIR: Self = Self { ior: Ior::AIR, absorption: Spectrum::NONE };
}

/// How colours are laid out on a surface.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Pattern {
    /// One colour everywhere.
    #[default]
    Solid,
    /// A checker of the surface's colour and a second one.
    Checker(Checker),
}

/// Cells of two colours by turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Checker {
    /// The second colour.
    pub second: Colour,
    /// The side of cells on flat shapes, and along axes.
    pub length: Length,
    /// The side of cells around axes; divides 180.
    pub angle: Degrees,
}

impl Surface {
    /// A matte surface of one colour.
    #[must_use]
    pub const fn new(colour: Colour) -> Self {
        Self {
            colour,
            gloss: Fraction::NONE,
            pattern: Pattern::Solid,
            transparency: Fraction::NONE,
            medium: Medium { ior: Ior::GLASS, absorption: Spectrum::NONE },
            thin: false,
            emission: Spectrum::NONE,
            priority: 0,
        }
    }

    /// A clear surface of a medium with that index of refraction.
    ///
    /// # Errors
    /// Where `ior` is not a finite number above 0.
    pub fn glass(ior: f64) -> Result<Self, InvalidField> {
        let ior = Ior::new(ior).map_err(|e| e.in_field("ior"))?;
        Ok(Self {
            transparency: Fraction::ALL,
            medium: Medium { ior, ..Medium::AIR },
            ..Self::new(Colour::WHITE)
        })
    }

    /// The same surface with a checker of `second` on it, in cells of 1, and of
    /// 30 degrees around axes.
    #[must_use]
    pub fn checker(self, second: Colour) -> Self {
        Self { pattern: Pattern::Checker(Checker::new(second)), ..self }
    }

    /// The same surface, mirroring the fraction `gloss` of the light.
    ///
    /// # Errors
    /// Where `gloss` is not in [0, 1].
    pub fn gloss(self, gloss: f64) -> Result<Self, InvalidField> {
        let gloss = Fraction::new(gloss).map_err(|e| e.in_field("gloss"))?;
        Ok(Self { gloss, ..self })
    }

    /// The same surface, of which the fraction `transparency` is clear.
    ///
    /// # Errors
    /// Where it is not in [0, 1].
    pub fn transparency(self, transparency: f64) -> Result<Self, InvalidField> {
        let transparency = Fraction::new(transparency).map_err(|e| e.in_field("transparency"))?;
        Ok(Self { transparency, ..self })
    }

    /// The same surface, with a medium behind it that takes away so much of
    /// red, green and blue for each unit of length.
    ///
    /// # Errors
    /// Where a number is negative or not finite.
    pub fn absorption(self, absorption: [f64; 3]) -> Result<Self, InvalidField> {
        let absorption = Spectrum::new(absorption).map_err(|e| e.in_field("absorption"))?;
        Ok(Self { medium: Medium { absorption, ..self.medium }, ..self })
    }

    /// The same surface, showing that radiance of its own.
    ///
    /// # Errors
    /// Where a number is negative or not finite.
    pub fn emission(self, radiance: [f64; 3]) -> Result<Self, InvalidField> {
        let emission = Spectrum::new(radiance).map_err(|e| e.in_field("emission"))?;
        Ok(Self { emission, ..self })
    }

    /// The same surface as a thin sheet.
    #[must_use]
    pub const fn thin(self) -> Self {
        Self { thin: true, ..self }
    }

    /// The same surface, of that priority where solids overlap.
    #[must_use]
    pub const fn priority(self, priority: i32) -> Self {
        Self { priority, ..self }
    }

    /// Whether any light passes.
    #[must_use]
    pub fn is_transparent(&self) -> bool {
        self.transparency > Fraction::NONE && self.gloss < Fraction::ALL
    }

    /// Whether it can be the border of a medium.
    #[must_use]
    pub fn has_medium(&self) -> bool {
        self.is_transparent() && !self.thin
    }
}

impl Checker {
    /// Cells of 1, and of 30 degrees around axes.
    ///
    /// # Panics
    /// Never: both are in range.
    #[must_use]
    pub fn new(second: Colour) -> Self {
        let length = Length::new(1.0).expect("it is above 0");
        let angle = Degrees::dividing_180(30.0).expect("it divides 180");
        Self { second, length, angle }
    }
}
