//! Numbers as other programs read them.

use lancer_math::{Point, Vector};
use std::fmt;

/// A number in the shortest form that reads back as the same bits, with an exponent where
/// it would be long.
#[derive(Clone, Copy)]
pub(crate) struct Number(pub(crate) f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || (1e-5..1e15).contains(&size) {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

/// Numbers with something between them.
pub(crate) fn joined(numbers: &[f64], between: &str) -> String {
    let numbers: Vec<_> = numbers.iter().map(|n| Number(*n).to_string()).collect();
    numbers.join(between)
}

/// `<x, y, z>`, as POV-Ray has it.
pub(crate) fn angled(v: &Vector) -> String {
    format!("<{}>", joined(&[v.x, v.y, v.z], ", "))
}

/// The same of a point.
pub(crate) fn angled_point(p: &Point) -> String {
    angled(&p.coords)
}

/// What a person said, as it may stand in a comment: on one line, and without two dashes.
pub(crate) fn for_comment(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        let c = if c.is_control() { ' ' } else { c };
        if c == '-' && out.ends_with('-') {
            out.push(' ');
        }
        out.push(c);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back() {
        for (number, text) in [
            (0.0, "0"),
            (-0.1, "-0.1"),
            (1e-5, "0.00001"),
            (1.5e-7, "1.5e-7"),
            (-2e300, "-2e300"),
            (123_456_789.0, "123456789"),
        ] {
            assert_eq!(Number(number).to_string(), text);
            assert_eq!(text.parse(), Ok(number));
        }
        assert_eq!(angled(&Vector::new(1.0, -0.5, 1e20)), "<1, -0.5, 1e20>");
        assert_eq!(for_comment("a --- b\n-->"), "a - - - b - ->");
    }
}
