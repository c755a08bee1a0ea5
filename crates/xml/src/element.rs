//! Reading one element by its table: what is unknown, missing or given twice
//! is reported here, for all elements alike.

use crate::document::start_of;
use crate::number::{self, NotANumber, trim};
use crate::schema::{Child, Element, Times, parents_of};
use crate::{Diagnostic, suggest};
use lancer_scene::OutOfRange;
use roxmltree::{Attribute, Node};
use std::ops::Range;

/// An element that has been checked against its table.
pub(crate) struct Reader<'a, 'i> {
    node: Node<'a, 'i>,
    element: &'static Element,
}

impl<'a, 'i> Reader<'a, 'i> {
    /// Reports all that is wrong with the element apart from its values.
    pub(crate) fn new(
        node: Node<'a, 'i>,
        element: &'static Element,
        out: &mut Vec<Diagnostic>,
    ) -> Self {
        let reader = Self { node, element };
        reader.check_namespace(out);
        reader.check_attributes(out);
        reader.check_children(out);
        reader
    }

    /// The element's name.
    pub(crate) fn name(&self) -> &'static str {
        self.element.name
    }

    /// Where the element begins.
    pub(crate) fn start(&self) -> Range<usize> {
        start_of(&self.node)
    }

    fn check_namespace(&self, out: &mut Vec<Diagnostic>) {
        let own = self.node.tag_name().namespace();
        let outer = self.node.parent().and_then(|parent| parent.tag_name().namespace());
        if let Some(namespace) = own.filter(|own| Some(*own) != outer) {
            out.push(
                Diagnostic::error(
                    self.start(),
                    format!("<{}> is in the namespace `{}`", self.element.name, shorten(namespace)),
                    "expected no namespace",
                )
                .help("remove `xmlns` and prefixes: the scene language has none".to_owned()),
            );
        }
    }

    fn check_attributes(&self, out: &mut Vec<Diagnostic>) {
        let names = self.element.attributes.iter().map(|attribute| attribute.name);
        let missing = self.element.attributes.iter().filter(|attribute| {
            attribute.required && self.node.attribute(attribute.name).is_none()
        });
        let mut missing: Vec<_> = missing.collect();
        for attribute in self.node.attributes() {
            let known = attribute.namespace().is_none()
                && names.clone().any(|name| name == attribute.name());
            if known {
                continue;
            }
            // What looks like a missing attribute is that one, misspelt.
            let meant = suggest::nearest(attribute.name(), missing.iter().map(|a| a.name));
            missing.retain(|attribute| Some(attribute.name) != meant);
            let what = format!("<{}> has", self.element.name);
            out.push(
                Diagnostic::error(
                    attribute.range_qname(),
                    format!(
                        "unknown attribute `{}` of <{}>",
                        shorten(attribute.name()),
                        self.element.name
                    ),
                    match self.element.attributes {
                        [] => "expected no attribute here",
                        _ => "not an attribute of this element",
                    },
                )
                .help(match meant {
                    Some(name) => Some(format!("did you mean `{name}`?")),
                    None => suggest::help(attribute.name(), names.clone(), &what),
                }),
            );
        }
        for attribute in missing {
            out.push(Diagnostic::error(
                self.start(),
                format!("<{}> lacks the attribute `{}`", self.element.name, attribute.name),
                format!(
                    "expected `{}=\"...\"`, a {}: {}",
                    attribute.name, attribute.values, attribute.meaning
                ),
            ));
        }
    }

    fn check_children(&self, out: &mut Vec<Diagnostic>) {
        for node in self.node.children() {
            if node.is_element() {
                if self.child_named(node.tag_name().name()).is_none() {
                    out.push(self.unknown_child(&node));
                }
            } else if node.is_text() && !trim(node.text().unwrap_or_default()).is_empty() {
                let text = &node.document().input_text()[node.range()];
                let start = node.range().start + text.find(trim(text)).unwrap_or(0);
                let line = trim(trim(text).lines().next().unwrap_or_default());
                out.push(Diagnostic::error(
                    start..start + line.len(),
                    format!("text inside <{}>", self.element.name),
                    if self.element.children.is_empty() {
                        "expected nothing here"
                    } else {
                        "expected elements only"
                    },
                ));
            }
        }
        for child in self.element.children.iter().filter(|child| child.times == Times::Once) {
            let mut found = self.nodes(child.element);
            match (found.next(), found.next()) {
                (None, _) => out.push(Diagnostic::error(
                    self.start(),
                    format!("<{}> lacks its <{}>", self.element.name, child.element.name),
                    expected_child(child),
                )),
                (Some(first), Some(second)) => out.push(
                    Diagnostic::error(
                        start_of(&second),
                        format!("a second <{}> in <{}>", child.element.name, self.element.name),
                        "expected only one",
                    )
                    .related(start_of(&first), "the first one is here"),
                ),
                _ => {}
            }
        }
    }

    fn unknown_child(&self, node: &Node<'_, '_>) -> Diagnostic {
        let name = node.tag_name().name();
        let names = self.element.children.iter().map(|child| child.element.name);
        let elsewhere: Vec<_> =
            parents_of(name).map(|parent| format!("<{}>", parent.name)).collect();
        let help = if elsewhere.is_empty() {
            suggest::help(name, names, &format!("<{}> holds", self.element.name))
        } else {
            Some(format!("<{name}> belongs inside {}", elsewhere.join(" or ")))
        };
        let (kind, label) = match (elsewhere.is_empty(), self.element.children) {
            (false, _) => ("misplaced", "does not belong here"),
            (true, []) => ("unknown", "expected no element here"),
            (true, _) => ("unknown", "not an element of the scene language"),
        };
        Diagnostic::error(
            start_of(node),
            format!("{kind} element <{}> in <{}>", shorten(name), self.element.name),
            label,
        )
        .help(help)
    }

    fn child_named(&self, name: &str) -> Option<&'static Child> {
        self.element.children.iter().find(|child| child.element.name == name)
    }

    fn nodes(&self, element: &'static Element) -> impl Iterator<Item = Node<'a, 'i>> + use<'a, 'i> {
        let children = self.node.children();
        children.filter(move |node| node.is_element() && node.tag_name().name() == element.name)
    }

    /// The first child of that kind, checked; a second one has been reported.
    pub(crate) fn child(
        &self,
        element: &'static Element,
        out: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        self.nodes(element).next().map(|node| Self::new(node, element, out))
    }

    /// All children that the table knows, in order, not checked yet.
    pub(crate) fn children(&self) -> impl Iterator<Item = (Node<'a, 'i>, &'static Element)> + '_ {
        self.node.children().filter(Node::is_element).filter_map(|node| {
            self.child_named(node.tag_name().name()).map(|child| (node, child.element))
        })
    }

    /// The bytes of an attribute's value; of the element's name where there is
    /// none.
    pub(crate) fn span_of(&self, name: &str) -> Range<usize> {
        self.node.attribute_node(name).map_or_else(|| self.start(), |a| a.range_value())
    }

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

    fn value<N, T>(
        &self,
        name: &str,
        read: impl FnOnce(&str) -> Result<N, NotANumber>,
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
            Err(NotANumber { problem, part, help }) => {
                let values = self.element.attributes.iter().find(|a| a.name == name);
                let expected = values.map_or("number", |a| a.values);
                let span = part_of(&attribute, part);
                self.bad_value(&attribute, &problem, span, &format!("expected a {expected}"))
                    .help(help)
            }
        };
        out.push(diagnostic);
        None
    }

    /// The text of an attribute; one that is missing has been reported.
    pub(crate) fn text(&self, name: &str) -> Option<&'a str> {
        self.node.attribute(name)
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

fn expected_child(child: &Child) -> String {
    let attributes: String = child
        .element
        .attributes
        .iter()
        .filter(|attribute| attribute.required)
        .map(|attribute| format!(" {}=\"...\"", attribute.name))
        .collect();
    let close = if child.element.children.is_empty() { "/" } else { "" };
    let meaning =
        if child.meaning.is_empty() { String::new() } else { format!(": {}", child.meaning) };
    format!("expected <{}{attributes}{close}>{meaning}", child.element.name)
}

/// A text that is short enough for a message, without control characters.
pub(crate) fn shorten(text: &str) -> String {
    const MOST: usize = 40;
    let mut short: String = text
        .chars()
        .take(MOST)
        .map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c })
        .collect();
    if text.chars().nth(MOST).is_some() {
        short.push_str("...");
    }
    short
}
