//! Numbers as the language writes them.

use lancer_scene::OutOfRange;
use std::ops::Range;

/// Why a text is no value of its kind, and which part of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Wrong {
    /// What is wrong: "`x` of <point> {problem}".
    pub(crate) problem: String,
    /// The bytes of the text that are wrong.
    pub(crate) part: Range<usize>,
    /// What was expected there, where that is not what the table says.
    pub(crate) expected: Option<String>,
    pub(crate) help: Option<String>,
}

impl Wrong {
    pub(crate) fn new(problem: impl Into<String>, part: Range<usize>) -> Self {
        Self { problem: problem.into(), part, expected: None, help: None }
    }

    pub(crate) fn expected(self, expected: impl Into<String>) -> Self {
        Self { expected: Some(expected.into()), ..self }
    }

    pub(crate) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// The same in a longer text, of which this one begins `by` bytes from the
    /// beginning.
    pub(crate) fn moved(self, by: usize) -> Self {
        Self { part: self.part.start + by..self.part.end + by, ..self }
    }
}

/// The characters that XML counts as white space.
pub(crate) fn trim(text: &str) -> &str {
    text.trim_matches([' ', '\t', '\r', '\n'])
}

fn digits(text: &str) -> usize {
    text.bytes().take_while(u8::is_ascii_digit).count()
}

/// How many bytes at the beginning of `text` are a decimal number.
fn decimal_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let sign = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let whole = digits(&text[sign..]);
    let mut end = sign + whole;
    let mut fraction = 0;
    if bytes.get(end) == Some(&b'.') {
        fraction = digits(&text[end + 1..]);
        end += 1 + fraction;
    }
    if whole + fraction == 0 {
        return 0;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(&text[end + 1 + sign..]);
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    end
}

/// A finite decimal number, with white space around it allowed.
pub(crate) fn decimal(text: &str) -> Result<f64, Wrong> {
    let trimmed = trim(text);
    let start = text.find(trimmed).unwrap_or(0);
    let all = start..start + trimmed.len();
    let wrong = |problem: &str, part: Range<usize>, help: Option<&str>| {
        Err(Wrong { help: help.map(str::to_owned), ..Wrong::new(problem, part) })
    };
    if trimmed.is_empty() {
        return wrong("is empty", 0..text.len(), None);
    }
    let unsigned = trimmed.trim_start_matches(['+', '-']).to_ascii_lowercase();
    if ["nan", "inf", "infinity"].contains(&unsigned.as_str()) {
        return wrong("is not a finite number", all, None);
    }
    let length = decimal_length(trimmed);
    let rest = &trimmed[length..];
    if length == 0 {
        let help =
            trimmed.starts_with(['\u{2212}', '\u{2013}']).then_some("write the minus sign as `-`");
        return wrong("is not a number", all, help);
    }
    if !rest.is_empty() {
        let help = if rest.starts_with(',') {
            Some("write a decimal fraction with a point: `1.5`")
        } else if rest.trim_start().starts_with(|c: char| c.is_ascii_digit()) {
            Some("one attribute holds one number")
        } else {
            None
        };
        return wrong("has something behind its number", start + length..all.end, help);
    }
    match trimmed.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => wrong("is too large", all, Some("the largest number is about 1.8e308")),
    }
}

/// A whole number of pixels, with white space around it allowed. Range checks
/// are left to the caller; what is too large for the type is given as its
/// largest value, which no range allows.
pub(crate) fn whole(text: &str) -> Result<u32, Wrong> {
    let value = decimal(text)?;
    let trimmed = trim(text);
    let start = text.find(trimmed).unwrap_or(0);
    if !trimmed.bytes().all(|b| b.is_ascii_digit()) && (value.fract() != 0.0 || value >= 0.0) {
        return Err(not_whole(trimmed, start, value));
    }
    // Saturates: negative numbers give 0, huge ones the largest.
    Ok(value as u32)
}

/// A whole number that may be negative, with white space around it allowed.
pub(crate) fn integer(text: &str) -> Result<i32, Wrong> {
    let value = decimal(text)?;
    let trimmed = trim(text);
    let start = text.find(trimmed).unwrap_or(0);
    match trimmed.parse() {
        Ok(whole) => Ok(whole),
        Err(_) if value.fract() == 0.0 && value.abs() >= 2_147_483_648.0 => {
            let wrong = Wrong::new("is too large", start..start + trimmed.len());
            Err(wrong.expected("a whole number from -2147483648 to 2147483647"))
        }
        Err(_) => Err(not_whole(trimmed, start, value)),
    }
}

fn not_whole(trimmed: &str, start: usize, value: f64) -> Wrong {
    let wrong = Wrong::new("is not a whole number", start..start + trimmed.len());
    if value.fract() == 0.0 && value.abs() < 1e9 {
        wrong.help(format!("write it in digits alone: `{value}`"))
    } else {
        wrong
    }
}

/// The words between white space, each with its first byte.
pub(crate) fn words(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let white = [' ', '\t', '\r', '\n'];
    let mut rest = 0;
    std::iter::from_fn(move || {
        let start = rest + text[rest..].find(|c| !white.contains(&c))?;
        let end = text[start..].find(white).map_or(text.len(), |length| start + length);
        rest = end;
        Some((start, &text[start..end]))
    })
}

/// So many finite decimal numbers with white space between them, each of which
/// `range`, given its place among them, accepts.
pub(crate) fn list<const N: usize>(
    text: &str,
    range: impl Fn(usize, f64) -> Result<f64, OutOfRange>,
) -> Result<[f64; N], Wrong> {
    let mut numbers = [0.0; N];
    let mut count = 0;
    for (start, word) in words(text) {
        let number = decimal(word).map_err(|wrong| {
            let problem = match wrong.problem.as_str() {
                _ if N == 1 => wrong.problem,
                "has something behind its number" => "has something behind a number".to_owned(),
                problem => format!("has an entry that {problem}"),
            };
            let wrong = Wrong { problem, ..wrong }.moved(start);
            match word.contains(',') && N > 1 {
                true => wrong.help("separate the numbers with spaces"),
                false => wrong,
            }
        })?;
        if let Some(place) = numbers.get_mut(count) {
            *place = range(count, number).map_err(|OutOfRange { expected, .. }| {
                let verb = if N == 1 { "is" } else { "holds" };
                Wrong::new(format!("{verb} {word}"), start..start + word.len()).expected(expected)
            })?;
        }
        count += 1;
    }
    match count {
        _ if count == N => Ok(numbers),
        0 => Err(Wrong::new("is empty", 0..text.len())),
        1 => Err(Wrong::new("has 1 number", 0..text.len())),
        _ => Err(Wrong::new(format!("has {count} numbers"), 0..text.len())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_rust_reads_them() {
        for text in ["0", "-0", "1.5", "+2", ".5", "5.", "1e3", "1E-3", "-1.25e+02", " 7\n"] {
            let expected: f64 = trim(text).parse().expect("Rust reads it");
            assert_eq!(decimal(text).map(f64::to_bits), Ok(expected.to_bits()), "{text:?}");
        }
    }

    #[test]
    fn rubbish_is_pointed_at() {
        for (text, problem, part) in [
            ("", "is empty", ""),
            ("  ", "is empty", "  "),
            ("abc", "is not a number", "abc"),
            (".", "is not a number", "."),
            ("-", "is not a number", "-"),
            ("0x10", "has something behind its number", "x10"),
            ("1.5m", "has something behind its number", "m"),
            ("1e", "has something behind its number", "e"),
            (" 1.5 2 ", "has something behind its number", " 2"),
            ("1,5", "has something behind its number", ",5"),
            ("NaN", "is not a finite number", "NaN"),
            ("-Infinity", "is not a finite number", "-Infinity"),
            ("1e309", "is too large", "1e309"),
            ("\u{2212}1", "is not a number", "\u{2212}1"),
        ] {
            let error = decimal(text).expect_err("rubbish");
            assert_eq!((error.problem.as_str(), &text[error.part]), (problem, part), "{text:?}");
        }
    }

    #[test]
    fn whole_numbers_have_no_fraction() {
        assert_eq!(whole("800"), Ok(800));
        assert_eq!(whole("-5"), Ok(0), "below the range of any pixel count");
        assert_eq!(whole("99999999999"), Ok(u32::MAX), "above it");
        for text in ["800.5", "800.0", "8e2", "-1.5"] {
            assert!(whole(text).is_err(), "{text}");
        }
    }
    #[test]
    fn whole_numbers_may_be_negative_where_that_is_meant() {
        assert_eq!(integer(" -5 "), Ok(-5));
        assert_eq!(integer("+7"), Ok(7));
        assert_eq!(integer("2147483647"), Ok(i32::MAX));
        for (text, problem) in [
            ("1.5", "is not a whole number"),
            ("2e3", "is not a whole number"),
            ("-3000000000", "is too large"),
            ("2147483648", "is too large"),
            ("1e300", "is too large"),
            ("high", "is not a number"),
        ] {
            assert_eq!(integer(text).map_err(|wrong| wrong.problem), Err(problem.to_owned()));
        }
    }

    #[test]
    fn lists_are_pointed_into() {
        let list = |text| {
            list::<3>(text, |i, value| {
                let expected = "a number of at least 0";
                if i == 2 && value < 0.0 {
                    Err(OutOfRange { found: value.to_string(), expected })
                } else {
                    Ok(value)
                }
            })
        };
        assert_eq!(list(" 1 -2\n3e0\t"), Ok([1.0, -2.0, 3.0]));
        for (text, problem, part) in [
            ("", "is empty", ""),
            (" \t", "is empty", " \t"),
            ("1", "has 1 number", "1"),
            ("1 2 3 4", "has 4 numbers", "1 2 3 4"),
            ("1 2 -3", "holds -3", "-3"),
            ("1 x 3", "has an entry that is not a number", "x"),
            ("1, 2, 3", "has something behind a number", ","),
            ("1 2 \u{2212}3", "has an entry that is not a number", "\u{2212}3"),
        ] {
            let wrong = list(text).expect_err("rubbish");
            assert_eq!((wrong.problem.as_str(), &text[wrong.part]), (problem, part), "{text:?}");
        }
    }
}
