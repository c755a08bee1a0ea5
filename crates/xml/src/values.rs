//! Reading the values of attributes: what is no value, or out of range, is
//! reported here, for all attributes alike.

use crate::colour::{self, NoColour};
use crate::element::{Reader, listed, shorten, with_article};
use crate::number::{self, Wrong, trim};
use crate::{Diagnostic, suggest};
use lancer_scene::{Colour, OutOfRange, Spectrum};
use roxmltree::Attribute;
use std::ops::Range;

impl<'a> Reader<'a, '_> {
    /// A decimal number that `range` accepts.
    pub(crate) fn number<T>(
        &self,
        name: &str,
        range: impl FnOnce(f64) -> Result<T, OutOfRange>,
        out: &mut Vec<Diagnostic>,
    ) -> Option<T> {
        self.value(name, number::decimal, range, out)
    }

    /// A whole number that `range` accepts.
    pub(crate) fn whole<T>(
        &self,
        name: &str,
        range: impl FnOnce(u32) -> Result<T, OutOfRange>,
        out: &mut Vec<Diagnostic>,
    ) -> Option<T> {
        self.value(name, number::whole, range, out)
    }

    /// A whole number that may be negative.
    pub(crate) fn integer(&self, name: &str, out: &mut Vec<Diagnostic>) -> Option<i32> {
        self.value(name, number::integer, Ok, out)
    }

    /// So many decimal numbers, each of which `range`, given its place among
    /// them, accepts.
    pub(crate) fn numbers<const N: usize>(
        &self,
        name: &str,
        range: impl Fn(usize, f64) -> Result<f64, OutOfRange>,
        out: &mut Vec<Diagnostic>,
    ) -> Option<[f64; N]> {
        self.value(name, |text| number::list(text, range), Ok, out)
    }

    /// Three numbers of at least 0.
    pub(crate) fn spectrum(&self, name: &str, out: &mut Vec<Diagnostic>) -> Option<Spectrum> {
        let numbers = self.numbers(name, |_, value| at_least_0(value), out)?;
        Spectrum::new(numbers).ok()
    }

    /// One of the words that are listed, each with what it means.
    pub(crate) fn keyword<T: Copy>(
        &self,
        name: &str,
        words: &[(&'static str, T)],
        out: &mut Vec<Diagnostic>,
    ) -> Option<T> {
        let text = self.text(name)?;
        if let Some((_, meaning)) = words.iter().find(|(word, _)| *word == text) {
            return Some(*meaning);
        }
        let words = words.iter().map(|(word, _)| *word);
        let all: Vec<_> = words.clone().map(|word| format!("`{word}`")).collect();
        out.push(
            Diagnostic::error(
                self.span_of(name),
                format!("`{name}` of <{}> is `{}`", self.name(), shorten(text)),
                format!("expected {}", listed(&all, "or")),
            )
            .help(suggest::nearest(text, words).map(|word| format!("did you mean `{word}`?"))),
        );
        None
    }

    /// `true` or `false`.
    pub(crate) fn flag(&self, name: &str, out: &mut Vec<Diagnostic>) -> Option<bool> {
        self.keyword(name, &[("true", true), ("false", false)], out)
    }

    /// A name that somebody gave to something; not empty.
    pub(crate) fn given_name(&self, name: &str, out: &mut Vec<Diagnostic>) -> Option<&'a str> {
        let text = self.text(name)?;
        if trim(text).is_empty() {
            out.push(Diagnostic::error(
                self.span_of(name),
                format!("`{name}` of <{}> is empty", self.name()),
                format!("expected a {}", self.values_of(name)),
            ));
            return None;
        }
        Some(text)
    }

    /// A colour of a surface. `also` are words that may stand in its place.
    pub(crate) fn colour(
        &self,
        name: &str,
        also: &[&'static str],
        out: &mut Vec<Diagnostic>,
    ) -> Option<Colour> {
        self.coloured(name, |text| colour::colour(text, also), out)
    }

    /// A radiance in the form of a colour.
    pub(crate) fn radiance(&self, name: &str, out: &mut Vec<Diagnostic>) -> Option<Spectrum> {
        self.coloured(name, colour::radiance, out)
    }

    fn coloured<T>(
        &self,
        name: &str,
        read: impl FnOnce(&str) -> Result<T, NoColour>,
        out: &mut Vec<Diagnostic>,
    ) -> Option<T> {
        let attribute = self.node.attribute_node(name)?;
        match read(attribute.value()) {
            Ok(colour) => Some(colour),
            Err(NoColour::Malformed(wrong)) => {
                out.push(self.wrong(&attribute, wrong));
                None
            }
            Err(NoColour::Unknown { help }) => {
                out.push(
                    Diagnostic::error(
                        attribute.range_value(),
                        format!("unknown colour `{}`", shorten(attribute.value())),
                        format!("expected {}", with_article(self.values_of(name))),
                    )
                    .help(help),
                );
                None
            }
        }
    }

    fn value<N, T>(
        &self,
        name: &str,
        read: impl FnOnce(&str) -> Result<N, Wrong>,
        range: impl FnOnce(N) -> Result<T, OutOfRange>,
        out: &mut Vec<Diagnostic>,
    ) -> Option<T> {
        let attribute = self.node.attribute_node(name)?;
        let diagnostic = match read(attribute.value()).map(range) {
            Ok(Ok(value)) => return Some(value),
            Ok(Err(OutOfRange { expected, .. })) => self.bad_value(
                &attribute,
                &format!("is {}", shorten(trim(attribute.value()))),
                attribute.range_value(),
                &format!("expected {expected}"),
            ),
            Err(wrong) => self.wrong(&attribute, wrong),
        };
        out.push(diagnostic);
        None
    }

    /// The text of an attribute; one that is missing has been reported.
    pub(crate) fn text(&self, name: &str) -> Option<&'a str> {
        self.node.attribute(name)
    }

    /// What the table says that the values of an attribute are.
    fn values_of(&self, name: &str) -> &'static str {
        self.element.all_attributes().find(|a| a.name == name).map_or("value", |a| a.values)
    }

    fn wrong(&self, attribute: &Attribute<'_, '_>, wrong: Wrong) -> Diagnostic {
        let Wrong { problem, part, expected, help } = wrong;
        let expected = expected.unwrap_or_else(|| with_article(self.values_of(attribute.name())));
        let span = part_of(attribute, part);
        self.bad_value(attribute, &problem, span, &format!("expected {expected}")).help(help)
    }

    fn bad_value(
        &self,
        attribute: &Attribute<'_, '_>,
        problem: &str,
        span: Range<usize>,
        label: &str,
    ) -> Diagnostic {
        let message = format!("`{}` of <{}> {problem}", attribute.name(), self.element.name);
        Diagnostic::error(span, message, label)
    }
}

/// The place of a part of an attribute's value; of all of it where entities
/// make the value and its text differ.
fn part_of(attribute: &Attribute<'_, '_>, part: Range<usize>) -> Range<usize> {
    let all = attribute.range_value();
    if all.len() == attribute.value().len() {
        all.start + part.start..all.start + part.end
    } else {
        all
    }
}

/// A number that is finite, as all that are read, and at least 0.
pub(crate) fn at_least_0(value: f64) -> Result<f64, OutOfRange> {
    if value >= 0.0 {
        // -0 becomes 0.
        Ok(value + 0.0)
    } else {
        Err(OutOfRange { found: value.to_string(), expected: "a number of at least 0" })
    }
}

/// A number other than 0, whose inverse is finite.
pub(crate) fn other_than_0(value: f64) -> Result<f64, OutOfRange> {
    if value != 0.0 && (1.0 / value).is_finite() {
        Ok(value)
    } else {
        Err(OutOfRange { found: value.to_string(), expected: "a number other than 0" })
    }
}
