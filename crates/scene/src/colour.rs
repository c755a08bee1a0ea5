use crate::{OutOfRange, colour_names};
use lancer_math::srgb;
use std::fmt;

/// A colour of a surface: how much of each kind of light it throws back.
///
/// What is given in codes from 0 to 255 means sRGB (IEC 61966-2-1), as on a
/// screen; the engines of the original take those codes as they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Colour {
    /// Red, green and blue in codes of sRGB.
    Codes([u8; 3]),
    /// Red, green and blue as shares of the light, from 0 to 1.
    Linear(LinearColour),
}

/// Shares of red, green and blue light, each from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearColour([f64; 3]);

macro_rules! named_colours {
    ($($constant:ident $name:literal $r:literal $g:literal $b:literal;)*) => {
        impl Colour {
            $(
                #[doc = concat!("`", $name, "`: ", $r, " ", $g, " ", $b, ".")]
                pub const $constant: Self = Self::Codes([$r, $g, $b]);
            )*

            /// The colours that the original program has names for, in its
            /// order.
            pub const NAMED: &[(&'static str, Self)] = &[$(($name, Self::$constant)),*];
        }
    };
}

named_colours! {
    RED "red" 255 0 0;
    GREEN "green" 0 255 0;
    BLUE "blue" 0 0 255;
    WHITE "white" 255 255 255;
    BLACK "black" 0 0 0;
    GREY "grey" 150 150 150;
    YELLOW "yellow" 252 231 0;
    CYAN "cyan" 0 252 240;
    ORANGE "orange" 252 140 0;
    PURPLE "purple" 181 0 252;
    PINK "pink" 255 125 225;
    BROWN "brown" 138 72 41;
    DARK_GREEN "dark green" 7 105 0;
}

impl Colour {
    /// The colour with those codes of sRGB.
    #[must_use]
    pub const fn rgb(r: u8, g: u8, b: u8) -> Self {
        Self::Codes([r, g, b])
    }

    /// The colour that throws back those shares of red, green and blue light.
    ///
    /// # Errors
    /// Where one is not from 0 to 1.
    pub fn linear(rgb: [f64; 3]) -> Result<Self, OutOfRange> {
        if rgb.iter().all(|c| (0.0..=1.0).contains(c)) {
            Ok(Self::Linear(LinearColour(rgb.map(|c| c + 0.0))))
        } else {
            let found = format!("({}, {}, {})", rgb[0], rgb[1], rgb[2]);
            Err(OutOfRange::new(found, "numbers from 0 to 1"))
        }
    }

    /// The colour of that name in the scene language: one of the original's
    /// thirteen, else one of CSS (Color Module Level 4).
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        let original = Self::NAMED.iter().find(|(n, _)| *n == name).map(|(_, colour)| *colour);
        let css = || colour_names::CSS.iter().find(|(n, _)| *n == name);
        original.or_else(|| css().map(|(_, codes)| Self::Codes(*codes)))
    }

    /// All names that [`from_name`](Self::from_name) knows, the original's
    /// first.
    pub fn names() -> impl Iterator<Item = &'static str> + Clone {
        let original = Self::NAMED.iter().map(|(name, _)| *name);
        let css = colour_names::CSS.iter().map(|(name, _)| *name);
        original.chain(css.filter(|name| !Self::NAMED.iter().any(|(n, _)| n == name)))
    }

    /// What is left of white: 255 minus each code, or 1 minus each share.
    #[must_use]
    pub fn complement(self) -> Self {
        match self {
            Self::Codes(codes) => Self::Codes(codes.map(|c| 255 - c)),
            Self::Linear(LinearColour(rgb)) => Self::Linear(LinearColour(rgb.map(|c| 1.0 - c))),
        }
    }

    /// The shares of red, green and blue light, from 0 to 1.
    #[must_use]
    pub fn shares(self) -> [f64; 3] {
        match self {
            Self::Codes(codes) => codes.map(srgb::decode8),
            Self::Linear(LinearColour(rgb)) => rgb,
        }
    }

    /// Red, green and blue in codes of sRGB, rounded to the nearest.
    #[must_use]
    pub fn codes(self) -> [u8; 3] {
        match self {
            Self::Codes(codes) => codes,
            // Within 0 to 255, since encoding stays within 0 to 1.
            Self::Linear(LinearColour(rgb)) => {
                rgb.map(|c| libm::round(255.0 * srgb::encode(c)) as u8)
            }
        }
    }
}

/// `#rrggbb`, or `linear(r, g, b)`: as the scene language writes it.
impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Codes([r, g, b]) => write!(f, "#{r:02x}{g:02x}{b:02x}"),
            Self::Linear(LinearColour([r, g, b])) => write!(f, "linear({r}, {g}, {b})"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_found() {
        assert_eq!(Colour::NAMED.len(), 13);
        assert_eq!(colour_names::CSS.len(), 148);
        for &(name, colour) in Colour::NAMED {
            assert_eq!(Colour::from_name(name), Some(colour));
        }
        assert_eq!(Colour::from_name("Red"), None);
        assert_eq!(Colour::from_name("dark green"), Some(Colour::rgb(7, 105, 0)));
        assert_eq!(Colour::from_name("darkgreen"), Some(Colour::rgb(0, 100, 0)));
        let mut names: Vec<_> = Colour::names().collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
        assert!(names.iter().all(|name| Colour::from_name(name).is_some()));
    }

    #[test]
    fn where_both_have_a_name_the_original_wins() {
        // CSS has 0 128 0 and 128 128 128.
        assert_eq!(Colour::from_name("green"), Some(Colour::rgb(0, 255, 0)));
        assert_eq!(Colour::from_name("grey"), Some(Colour::rgb(150, 150, 150)));
        assert_eq!(Colour::from_name("gray"), Some(Colour::rgb(128, 128, 128)));
    }

    #[test]
    fn complement_undoes_itself() {
        assert_eq!(Colour::PURPLE.complement(), Colour::rgb(74, 255, 3));
        assert_eq!(Colour::PURPLE.complement().complement(), Colour::PURPLE);
        let linear = Colour::linear([0.25, 1.0, 0.0]).expect("in range");
        assert_eq!(linear.complement().shares(), [0.75, 0.0, 1.0]);
    }

    #[test]
    fn codes_are_srgb() {
        // IEC 61966-2-1, worked out with 30 digits elsewhere.
        let grey = Colour::rgb(128, 128, 128).shares()[0];
        assert!((grey - 0.215_860_500_113_899_26).abs() < 1e-15, "{grey}");
        assert_eq!(Colour::WHITE.shares(), [1.0; 3]);
        for code in 0..=255 {
            let colour = Colour::linear(Colour::rgb(code, 0, 255).shares()).expect("in range");
            assert_eq!(colour.codes(), [code, 0, 255]);
        }
        assert!(Colour::linear([0.0, 1.1, 0.0]).is_err());
    }
}
