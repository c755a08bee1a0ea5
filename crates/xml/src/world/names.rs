//! What a scene gives names to.

use super::Out;
use crate::element::{Reader, shorten};
use crate::{Diagnostic, suggest};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::ops::Range;

/// How often a name that is not known is compared with others, and with how
/// many: files with more mistakes are not made better by suggestions.
const MOST_SEARCHES: usize = 100;
const MOST_COMPARED: usize = 1000;

/// The names of things of one kind, in the order of the file.
#[derive(Debug)]
pub(super) struct Names<'a> {
    /// What they are called in messages: "material".
    kind: &'static str,
    places: HashMap<&'a str, usize>,
    names: Vec<Name<'a>>,
    searches: usize,
}

#[derive(Debug)]
struct Name<'a> {
    name: &'a str,
    span: Range<usize>,
    used: bool,
}

impl<'a> Names<'a> {
    pub(super) fn new(kind: &'static str) -> Self {
        Self { kind, places: HashMap::new(), names: Vec::new(), searches: 0 }
    }

    /// Adds the name of an element; says whether it has one of its own.
    pub(super) fn add(&mut self, reader: &Reader<'a, '_>, out: Out<'_>) -> bool {
        let Some(name) = reader.given_name("name", out) else { return false };
        let span = reader.span_of("name");
        match self.places.entry(name) {
            Entry::Vacant(place) => {
                place.insert(self.names.len());
                self.names.push(Name { name, span, used: false });
                true
            }
            Entry::Occupied(place) => {
                let first = &mut self.names[*place.get()];
                // Which of the two is meant is not known.
                first.used = true;
                out.push(
                    Diagnostic::error(
                        span,
                        format!("a second {} is called `{}`", self.kind, shorten(name)),
                        "expected another name",
                    )
                    .related(first.span.clone(), "the first one is here"),
                );
                false
            }
        }
    }

    /// The place among those added of the one that an attribute names.
    pub(super) fn find(
        &mut self,
        reader: &Reader<'a, '_>,
        attribute: &str,
        out: Out<'_>,
    ) -> Option<usize> {
        let name = reader.given_name(attribute, out)?;
        if let Some(&place) = self.places.get(name) {
            self.names[place].used = true;
            return Some(place);
        }
        let mut help = None;
        if self.searches < MOST_SEARCHES {
            self.searches += 1;
            let known = self.names.iter().take(MOST_COMPARED).map(|known| known.name);
            help = match suggest::nearest(name, known) {
                Some(near) => {
                    // Not to be reported as unused on top.
                    self.names[self.places[near]].used = true;
                    Some(format!("did you mean `{near}`?"))
                }
                None => Some(format!(
                    "write <{} name=\"...\"> as a child of <world>",
                    self.kind_element()
                )),
            };
        }
        out.push(
            Diagnostic::error(
                reader.span_of(attribute),
                format!("there is no {} called `{}`", self.kind, shorten(name)),
                format!("expected the name of a <{}>", self.kind_element()),
            )
            .help(help),
        );
        None
    }

    /// The place among those added of a name.
    pub(super) fn place(&self, name: &str) -> Option<usize> {
        self.places.get(name).copied()
    }

    pub(super) fn name(&self, place: usize) -> &'a str {
        self.names[place].name
    }

    fn kind_element(&self) -> &'static str {
        if self.kind == "definition" { "define" } else { self.kind }
    }

    /// Reports those that nothing refers to.
    pub(super) fn report_unused(&self, out: Out<'_>) {
        for unused in self.names.iter().filter(|name| !name.used) {
            out.push(Diagnostic::warning(
                unused.span.clone(),
                format!("the {} `{}` is not used", self.kind, shorten(unused.name)),
                "nothing refers to it",
            ));
        }
    }
}
