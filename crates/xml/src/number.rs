//! Numbers as the language writes them.

use std::ops::Range;

/// Why a text is not a number, and which part of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct NotANumber {
    /// What is wrong: "`x` of <point> {problem}".
    pub(crate) problem: String,
    /// The bytes of the text that are wrong.
    pub(crate) part: Range<usize>,
    pub(crate) help: Option<String>,
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
pub(crate) fn decimal(text: &str) -> Result<f64, NotANumber> {
    let trimmed = trim(text);
    let start = text.find(trimmed).unwrap_or(0);
    let all = start..start + trimmed.len();
    let wrong = |problem: &str, part: Range<usize>, help: Option<&str>| {
        Err(NotANumber { problem: problem.to_owned(), part, help: help.map(str::to_owned) })
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
pub(crate) fn whole(text: &str) -> Result<u32, NotANumber> {
    let value = decimal(text)?;
    let trimmed = trim(text);
    let start = text.find(trimmed).unwrap_or(0);
    if !trimmed.bytes().all(|b| b.is_ascii_digit()) && (value.fract() != 0.0 || value >= 0.0) {
        return Err(NotANumber {
            problem: "is not a whole number".to_owned(),
            part: start..start + trimmed.len(),
            help: (value.fract() == 0.0 && value < 1e9)
                .then(|| format!("write it in digits alone: `{value}`")),
        });
    }
    // Saturates: negative numbers give 0, huge ones the largest.
    Ok(value as u32)
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
}
