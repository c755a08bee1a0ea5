//! Colours as the language writes them.

use crate::element::shorten;
use crate::number::{Wrong, decimal, trim};
use crate::suggest;
use lancer_scene::{Colour, Spectrum};
use std::ops::Range;

/// What colours there are, for a help line.
const FORMS: &str = "a colour is one of the 13 names of the language or the 148 of CSS (`red`, \
                     `dark green`, `teal`), `#rrggbb`, `rgb(r, g, b)` or `linear(r, g, b)`";

/// Why a text is no colour.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum NoColour {
    /// No name and no form that is known.
    Unknown { help: String },
    /// A form that is known, with something wrong in it.
    Malformed(Wrong),
}

impl From<Wrong> for NoColour {
    fn from(wrong: Wrong) -> Self {
        Self::Malformed(wrong)
    }
}

/// A colour of a surface. `also` are words that may stand in its place.
pub(crate) fn colour(text: &str, also: &[&'static str]) -> Result<Colour, NoColour> {
    match read(text, also)? {
        Form::Colour(colour) => Ok(colour),
        Form::Linear(numbers, parts) => Colour::linear(numbers).map_err(|_| {
            let at = numbers.iter().position(|c| *c > 1.0).unwrap_or(0);
            let part = parts[at].clone();
            Wrong::new(format!("holds {}", shorten(&text[part.clone()])), part)
                .expected("a number from 0 to 1")
                .help("a surface throws back at most all light; `emission` has no such limit")
                .into()
        }),
    }
}

/// A radiance, which has no upper end where it is given in linear numbers.
pub(crate) fn radiance(text: &str) -> Result<Spectrum, NoColour> {
    let numbers = match read(text, &[])? {
        Form::Colour(colour) => colour.shares(),
        Form::Linear(numbers, _) => numbers,
    };
    // Finite and at least 0, as `read` has seen.
    Spectrum::new(numbers).map_err(|_| unknown(text, &[]))
}

enum Form {
    Colour(Colour),
    /// Numbers of at least 0, and where they stand.
    Linear([f64; 3], [Range<usize>; 3]),
}

fn read(text: &str, also: &[&'static str]) -> Result<Form, NoColour> {
    if let Some(colour) = Colour::from_name(text) {
        return Ok(Form::Colour(colour));
    }
    if let Some(digits) = text.strip_prefix('#') {
        return Ok(Form::Colour(hexadecimal(digits)?));
    }
    match text.split_once('(') {
        Some(("rgb", _)) => {
            let parts = components(text, "rgb(".len(), "rgb")?;
            let [r, g, b] = parts.map(|part| code(text, part));
            Ok(Form::Colour(Colour::rgb(r?, g?, b?)))
        }
        Some(("linear", _)) => {
            let parts = components(text, "linear(".len(), "linear")?;
            let [r, g, b] = parts.clone().map(|part| share(text, part));
            Ok(Form::Linear([r?, g?, b?], parts))
        }
        Some((form, _)) => Err(NoColour::Unknown {
            help: match suggest::nearest(form, ["rgb", "linear"]) {
                Some(name) => format!("did you mean `{name}(r, g, b)`?"),
                None => FORMS.to_owned(),
            },
        }),
        None => Err(unknown(text, also)),
    }
}

fn unknown(text: &str, also: &[&'static str]) -> NoColour {
    let names = Colour::names().chain(also.iter().copied());
    let help = match suggest::nearest(text, names) {
        Some(name) => format!("did you mean `{name}`?"),
        None => FORMS.to_owned(),
    };
    NoColour::Unknown { help }
}

/// The colour of six digits behind a `#`.
fn hexadecimal(digits: &str) -> Result<Colour, Wrong> {
    let is_digit = |c: char| c.is_ascii_hexdigit();
    if let Some((at, c)) = digits.char_indices().find(|(_, c)| !is_digit(*c)) {
        let part = 1 + at..1 + at + c.len_utf8();
        return Err(Wrong::new("has a character that is no hexadecimal digit", part)
            .expected("six digits of 0 to 9 and a to f"));
    }
    if digits.len() != 6 {
        let count = digits.len();
        let digit = if count == 1 { "digit" } else { "digits" };
        let wrong = Wrong::new(format!("has {count} hexadecimal {digit}"), 0..1 + count)
            .expected("six: `#rrggbb`");
        return Err(match count {
            3 => {
                let twice: String = digits.chars().flat_map(|c| [c, c]).collect();
                wrong.help(format!("write `#{twice}`"))
            }
            8 => wrong.help(format!("write `#{}`: colours have no opacity here", &digits[..6])),
            _ => wrong,
        });
    }
    let code = |at: usize| u8::from_str_radix(&digits[at..at + 2], 16).unwrap_or_default();
    Ok(Colour::rgb(code(0), code(2), code(4)))
}

/// Where the three numbers between the bracket before byte `start` and the last
/// one are.
fn components(text: &str, start: usize, form: &str) -> Result<[Range<usize>; 3], Wrong> {
    let Some(length) = text[start..].find(')') else {
        return Err(Wrong::new("has a bracket that is not closed", start - 1..start)
            .expected(format!("`{form}(r, g, b)`")));
    };
    let end = start + length;
    if end + 1 < text.len() {
        return Err(Wrong::new("has something behind its colour", end + 1..text.len())
            .expected("nothing more"));
    }
    let mut parts = [const { 0..0 }; 3];
    let mut count = 0;
    let mut at = start;
    for part in text[start..end].split(',') {
        if let Some(place) = parts.get_mut(count) {
            *place = at..at + part.len();
        }
        count += 1;
        at += part.len() + 1;
    }
    if count == 3 {
        return Ok(parts);
    }
    let count = if trim(&text[start..end]).is_empty() { 0 } else { count };
    let number = if count == 1 { "number" } else { "numbers" };
    let wrong = Wrong::new(format!("has {count} {number} in its brackets"), start..end)
        .expected(format!("three: `{form}(r, g, b)`"));
    let has_space = trim(&text[start..end]).contains(' ');
    Err(match count {
        1 if has_space => wrong.help("separate the numbers with commas"),
        4 => wrong.help("a fourth number, for opacity, means nothing here"),
        _ => wrong,
    })
}

fn number(text: &str, part: Range<usize>, expected: &str) -> Result<f64, Wrong> {
    decimal(&text[part.clone()]).map_err(|wrong| Wrong {
        problem: match wrong.problem.as_str() {
            "is empty" => "lacks a number".to_owned(),
            _ => "holds something that is not a number".to_owned(),
        },
        expected: Some(expected.to_owned()),
        ..wrong.moved(part.start)
    })
}

/// The whole number from 0 to 255 at `part` of `text`.
fn code(text: &str, part: Range<usize>) -> Result<u8, Wrong> {
    let expected = "a whole number from 0 to 255";
    let value = number(text, part.clone(), expected)?;
    let part = trimmed(text, part);
    if value.fract() == 0.0 && (0.0..=255.0).contains(&value) {
        return Ok(value as u8);
    }
    let wrong =
        Wrong::new(format!("holds {}", shorten(&text[part.clone()])), part).expected(expected);
    Err(if (0.0..1.0).contains(&value) {
        wrong.help("fractions from 0 to 1 of linear light are `linear(r, g, b)`")
    } else {
        wrong
    })
}

/// The number of at least 0 at `part` of `text`.
fn share(text: &str, part: Range<usize>) -> Result<f64, Wrong> {
    let value = number(text, part.clone(), "a number of at least 0")?;
    if value >= 0.0 {
        return Ok(value);
    }
    let part = trimmed(text, part);
    Err(Wrong::new(format!("holds {}", shorten(&text[part.clone()])), part)
        .expected("a number of at least 0"))
}

fn trimmed(text: &str, part: Range<usize>) -> Range<usize> {
    let inside = trim(&text[part.clone()]);
    let start = part.start + text[part].find(inside).unwrap_or(0);
    start..start + inside.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_four_forms_are_read() {
        for (text, expected) in [
            ("dark green", Colour::DARK_GREEN),
            ("darkgreen", Colour::rgb(0, 100, 0)),
            ("#0a10fF", Colour::rgb(10, 16, 255)),
            ("rgb(0, 128,255)", Colour::rgb(0, 128, 255)),
            ("rgb( 1 ,2, 3 )", Colour::rgb(1, 2, 3)),
            ("linear(0, 0.25, 1)", Colour::linear([0.0, 0.25, 1.0]).expect("in range")),
        ] {
            assert_eq!(colour(text, &[]), Ok(expected), "{text}");
        }
        let bright = Spectrum::new([2.0, 0.0, 30.0]).expect("in range");
        assert_eq!(radiance("linear(2, 0, 30)"), Ok(bright));
        let white = Spectrum::new([1.0; 3]).expect("in range");
        assert_eq!(radiance("white"), Ok(white));
    }

    #[test]
    fn what_is_malformed_is_pointed_at() {
        for (text, problem, part) in [
            ("#fff", "has 3 hexadecimal digits", "#fff"),
            ("#", "has 0 hexadecimal digits", "#"),
            ("#ff00000", "has 7 hexadecimal digits", "#ff00000"),
            ("#ff00zz", "has a character that is no hexadecimal digit", "z"),
            ("#ff00\u{e9}0", "has a character that is no hexadecimal digit", "\u{e9}"),
            ("rgb(300, 0, 0)", "holds 300", "300"),
            ("rgb(0, -1 , 0)", "holds -1", "-1"),
            ("rgb(0, 0.5, 0)", "holds 0.5", "0.5"),
            ("rgb(0, 50%, 0)", "holds something that is not a number", "%"),
            ("rgb(0, x, 0)", "holds something that is not a number", "x"),
            ("rgb(0,,0)", "lacks a number", ""),
            ("rgb(1,2)", "has 2 numbers in its brackets", "1,2"),
            ("rgb(1 2 3)", "has 1 number in its brackets", "1 2 3"),
            ("rgb()", "has 0 numbers in its brackets", ""),
            ("rgb(1,2,3,4)", "has 4 numbers in its brackets", "1,2,3,4"),
            ("rgb(1, 2, 3", "has a bracket that is not closed", "("),
            ("rgb(1, 2, 3) x", "has something behind its colour", " x"),
            ("linear(2, 0, 0)", "holds 2", "2"),
            ("linear(0, 0, -0.5)", "holds -0.5", "-0.5"),
            ("linear(0, 1e999, 0)", "holds something that is not a number", "1e999"),
        ] {
            match colour(text, &[]) {
                Err(NoColour::Malformed(wrong)) => {
                    assert_eq!((wrong.problem.as_str(), &text[wrong.part]), (problem, part));
                }
                other => panic!("{text}: {other:?}"),
            }
        }
    }

    #[test]
    fn what_is_unknown_is_answered_with_the_nearest_or_with_the_forms() {
        for (text, expected) in [
            ("bleu", "did you mean `blue`?"),
            ("Red", "did you mean `red`?"),
            ("steel blue", "did you mean `steelblue`?"),
            ("nome", "did you mean `none`?"),
            ("RGB(1, 2, 3)", "did you mean `rgb(r, g, b)`?"),
            ("rgba(1, 2, 3, 4)", "did you mean `rgb(r, g, b)`?"),
            ("hsl(1, 2, 3)", FORMS),
            ("translucent", FORMS),
            ("", FORMS),
        ] {
            let help = expected.to_owned();
            assert_eq!(colour(text, &["none"]), Err(NoColour::Unknown { help }), "{text}");
        }
    }
}
