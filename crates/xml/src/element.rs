//! Reading one element by its table: what is unknown, missing or given twice
//! is reported here, for all elements alike.

use crate::document::start_of;
use crate::number::trim;
use crate::schema::{Attribute, Child, Element, Need, Slip, Times, parents_of};
use crate::{Diagnostic, suggest};
use roxmltree::Node;
use std::ops::Range;

/// An element that has been checked against its table.
pub(crate) struct Reader<'a, 'i> {
    pub(crate) node: Node<'a, 'i>,
    pub(crate) element: &'static Element,
    /// The attributes that unknown ones were taken for.
    meant: Vec<&'static str>,
}

impl<'a, 'i> Reader<'a, 'i> {
    /// Reports all that is wrong with the element apart from its values.
    pub(crate) fn new(
        node: Node<'a, 'i>,
        element: &'static Element,
        out: &mut Vec<Diagnostic>,
    ) -> Self {
        let mut reader = Self { node, element, meant: Vec::new() };
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

    fn check_attributes(&mut self, out: &mut Vec<Diagnostic>) {
        for attribute in self.node.attributes() {
            let name = attribute.name();
            let mut all = self.element.all_attributes();
            if attribute.namespace().is_none() && all.any(|known| known.name == name) {
                continue;
            }
            let names = self.element.all_attributes().map(|known| known.name);
            let slip = self.slip(name);
            // What looks like a missing attribute is that one, misspelt.
            let meant = match slip {
                Some(Slip::Meant(meant)) => Some(meant),
                Some(Slip::Instead(_)) => None,
                None => suggest::nearest(name, names.clone().filter(|name| !self.has(name))),
            };
            self.meant.extend(meant);
            let what = format!("<{}> has", self.element.name);
            out.push(
                Diagnostic::error(
                    attribute.range_qname(),
                    format!("unknown attribute `{}` of <{}>", shorten(name), self.element.name),
                    match names.clone().next() {
                        None => "expected no attribute here",
                        Some(_) => "not an attribute of this element",
                    },
                )
                .help(match (slip, meant) {
                    (Some(Slip::Instead(help)), _) => Some(help.to_owned()),
                    (_, Some(name)) => Some(format!("did you mean `{name}`?")),
                    _ => suggest::help(name, names, &what),
                }),
            );
        }
        for attribute in self.element.attributes {
            if attribute.need == Need::Required {
                self.demand(attribute, out);
            }
        }
        self.check_one_of(out);
    }

    fn slip(&self, name: &str) -> Option<Slip> {
        let slips = self.element.slips;
        slips.iter().find(|(slip, _)| *slip == name).map(|(_, what)| *what)
    }

    /// Whether the attribute is there, or one that was taken for it.
    fn has_or_means(&self, name: &str) -> bool {
        self.has(name) || self.meant.contains(&name)
    }

    /// Reports an attribute that is missing.
    pub(crate) fn demand(&self, attribute: &Attribute, out: &mut Vec<Diagnostic>) {
        if self.has_or_means(attribute.name) {
            return;
        }
        out.push(Diagnostic::error(
            self.start(),
            format!("<{}> lacks the attribute `{}`", self.element.name, attribute.name),
            format!(
                "expected `{}=\"...\"`, {}: {}",
                attribute.name,
                with_article(attribute.values),
                // The first of what may be several sentences.
                attribute.meaning.split(". ").next().unwrap_or_default()
            ),
        ));
    }

    fn check_one_of(&self, out: &mut Vec<Diagnostic>) {
        let sets = self.element.one_of;
        let begun = |set: &&&[&str]| set.iter().any(|name| self.has_or_means(name));
        let mut begun = sets.iter().filter(begun);
        match (begun.next(), begun.next()) {
            (Some(first), Some(second)) => {
                let given = |set: &[&'static str]| {
                    set.iter().copied().find(|name| self.has_or_means(name)).unwrap_or_default()
                };
                let (first, second) = (given(first), given(second));
                out.push(
                    Diagnostic::error(
                        self.name_span_of(second),
                        format!("<{}> has both `{first}` and `{second}`", self.element.name),
                        "expected only one of them",
                    )
                    .related(self.name_span_of(first), "the other one is here"),
                );
            }
            (Some(set), None) => {
                let named = |a: &&'static Attribute| set.contains(&a.name);
                self.element.all_attributes().filter(named).for_each(|a| self.demand(a, out));
            }
            (None, _) if sets.is_empty() => {}
            (None, _) => {
                let list = |set: &&[&str]| {
                    let names: Vec<_> = set.iter().map(|name| format!("`{name}`")).collect();
                    listed(&names, "and")
                };
                let choices: Vec<_> = sets.iter().map(list).collect();
                let choices = choices.join(" or ");
                out.push(Diagnostic::error(
                    self.start(),
                    format!("<{}> lacks the attribute {choices}", self.element.name),
                    format!("expected {choices}"),
                ));
            }
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
                    if self.element.all_children().next().is_none() {
                        "expected nothing here"
                    } else {
                        "expected elements only"
                    },
                ));
            }
        }
        for child in self.element.children.iter().filter(|child| child.times != Times::Any) {
            let mut found = self.nodes(child.element);
            match (found.next(), found.next()) {
                (None, _) if child.times == Times::Once => out.push(Diagnostic::error(
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
        let names = self.element.all_children().map(|child| child.element.name);
        let elsewhere: Vec<_> =
            parents_of(name).map(|parent| format!("<{}>", parent.name)).collect();
        let help = if let Some(Slip::Instead(help)) = self.slip(name) {
            Some(help.to_owned())
        } else if elsewhere.is_empty() {
            suggest::help(name, names, &format!("<{}> holds", self.element.name))
        } else {
            Some(format!("<{name}> belongs inside {}", listed(&elsewhere, "or")))
        };
        let (kind, label) = match (elsewhere.is_empty(), self.element.all_children().next()) {
            (false, _) => ("misplaced", "does not belong here"),
            (true, None) => ("unknown", "expected no element here"),
            (true, Some(_)) => ("unknown", "not an element of the scene language"),
        };
        Diagnostic::error(
            start_of(node),
            format!("{kind} element <{}> in <{}>", shorten(name), self.element.name),
            label,
        )
        .help(help)
    }

    fn child_named(&self, name: &str) -> Option<&'static Child> {
        self.element.all_children().find(|child| child.element.name == name)
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

    /// Where the first child of that kind begins; where there is none, the
    /// element itself.
    pub(crate) fn start_of(&self, element: &'static Element) -> Range<usize> {
        self.nodes(element).next().map_or_else(|| self.start(), |node| start_of(&node))
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

    /// The bytes of an attribute's name; of the element's where there is none.
    pub(crate) fn name_span_of(&self, name: &str) -> Range<usize> {
        self.node.attribute_node(name).map_or_else(|| self.start(), |a| a.range_qname())
    }

    /// Whether it has that attribute.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.node.has_attribute(name)
    }
}

/// "a number", "an angle", "three numbers".
pub(crate) fn with_article(values: &str) -> String {
    match values.chars().next() {
        Some('`') => values.to_owned(),
        _ if values.starts_with("three ") => values.to_owned(),
        Some('a' | 'e' | 'i' | 'o') => format!("an {values}"),
        _ => format!("a {values}"),
    }
}

/// "a, b or c".
pub(crate) fn listed(items: &[String], word: &str) -> String {
    match items {
        [most @ .., last] if !most.is_empty() => format!("{} {word} {last}", most.join(", ")),
        _ => items.concat(),
    }
}

fn expected_child(child: &Child) -> String {
    let first = child.element.one_of.first().copied().unwrap_or_default();
    let attributes: String = child
        .element
        .attributes
        .iter()
        .filter(|a| a.need == Need::Required || first.contains(&a.name))
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
