/// A colour in the original program's terms: 8 bits of red, green and blue,
/// with no gamma implied.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Colour {
    /// Red, 0 to 255.
    pub r: u8,
    /// Green, 0 to 255.
    pub g: u8,
    /// Blue, 0 to 255.
    pub b: u8,
}

macro_rules! named_colours {
    ($($constant:ident $name:literal $r:literal $g:literal $b:literal;)*) => {
        impl Colour {
            $(
                #[doc = concat!("`", $name, "`: ", $r, " ", $g, " ", $b, ".")]
                pub const $constant: Self = Self { r: $r, g: $g, b: $b };
            )*

            /// The colours that the scene language has names for, in the order
            /// in which the original program lists them.
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
    /// The colour of that name in the scene language.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::NAMED.iter().find(|(n, _)| *n == name).map(|(_, colour)| *colour)
    }

    /// What is left of white: (255 - r, 255 - g, 255 - b).
    #[must_use]
    pub const fn complement(self) -> Self {
        Self { r: 255 - self.r, g: 255 - self.g, b: 255 - self.b }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_found() {
        assert_eq!(Colour::NAMED.len(), 13);
        for &(name, colour) in Colour::NAMED {
            assert_eq!(Colour::from_name(name), Some(colour));
        }
        assert_eq!(Colour::from_name("Red"), None);
        assert_eq!(Colour::from_name("dark green"), Some(Colour { r: 7, g: 105, b: 0 }));
    }

    #[test]
    fn complement_undoes_itself() {
        assert_eq!(Colour::PURPLE.complement(), Colour { r: 74, g: 255, b: 3 });
        assert_eq!(Colour::PURPLE.complement().complement(), Colour::PURPLE);
    }
}
