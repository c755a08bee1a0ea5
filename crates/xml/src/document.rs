//! From bytes to well-formed XML, or the one reason why they are not.

use crate::element::shorten;
use crate::{Diagnostic, Source};
use roxmltree::{Document, Error, ParsingOptions};

/// How deeply elements may be nested. The language itself needs four levels.
pub const DEEPEST: usize = 100;

/// How many elements, texts and comments a file may have.
pub const MOST_NODES: u32 = 50_000_000;

/// The text of a file; where it is not UTF-8, a replacement and why.
pub(crate) fn decode(bytes: &[u8]) -> (Source, Option<Diagnostic>) {
    let error = match std::str::from_utf8(bytes) {
        Ok(text) => return (Source::new(text.to_owned()), None),
        Err(error) => error,
    };
    let source = Source::new(String::from_utf8_lossy(bytes).into_owned());
    let diagnostic = if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        Diagnostic::error(0..0, "the file is UTF-16, not UTF-8", "its first bytes say so")
    } else {
        let start = error.valid_up_to();
        // A replacement character takes three bytes.
        let span = start..(start + 3).min(source.text().len());
        Diagnostic::error(span, "the file is not UTF-8", "this is no UTF-8 character")
    };
    let help = "save the file with the encoding UTF-8".to_owned();
    (source, Some(diagnostic.help(help)))
}

/// The XML tree of `source`.
pub(crate) fn tree(source: &Source) -> Result<Document<'_>, Box<Diagnostic>> {
    let options = ParsingOptions { nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(source.text(), options)
        .map_err(|error| Box::new(explain(&error, source)))?;
    match too_deep(&document) {
        None => Ok(document),
        Some(node) => Err(Box::new(
            Diagnostic::error(
                start_of(&node),
                format!("elements are nested more than {DEEPEST} levels deep"),
                "this one is too deep",
            )
            .help("a scene needs four levels: world, lights, lamp, point".to_owned()),
        )),
    }
}

/// The first bytes of an element: `<` and its name.
pub(crate) fn start_of(node: &roxmltree::Node<'_, '_>) -> std::ops::Range<usize> {
    let range = node.range();
    let text = node.document().input_text();
    let name = text[range.clone()]
        .find(|c: char| c.is_ascii_whitespace() || c == '>' || c == '/')
        .map_or(range.end, |length| range.start + length);
    range.start..name
}

fn too_deep<'a, 'i>(document: &'a Document<'i>) -> Option<roxmltree::Node<'a, 'i>> {
    // Parents come before their children.
    let mut depths: Vec<u8> = Vec::new();
    for node in document.descendants() {
        let above = node.parent().map_or(0, |parent| depths[parent.id().get_usize()]);
        let depth = above + u8::from(node.is_element());
        if usize::from(depth) > DEEPEST {
            return Some(node);
        }
        depths.push(depth);
    }
    None
}

/// What a parser's error means and what to do about it.
fn explain(error: &Error, source: &Source) -> Diagnostic {
    let text = source.text();
    let position = error.pos();
    let at = source.offset(position.row as usize, position.col as usize);
    let char_at = |at: usize| at..at + text[at..].chars().next().map_or(0, char::len_utf8);
    let error_at = |message: &str, label: &str| {
        Diagnostic::error(char_at(at), format!("not well-formed XML: {message}"), label)
    };
    // The last character that is no white space: at the very end there is
    // nothing to point at.
    let last = text.trim_end().char_indices().last().map_or(0, |(i, _)| i);
    match error {
        Error::DtdDetected => {
            let at = text.find("<!DOCTYPE").unwrap_or(0);
            Diagnostic::error(
                at..(at + "<!DOCTYPE".len()).min(text.len()),
                "document type declarations and entities are refused",
                "begins here",
            )
            .help(
                "a scene needs none: remove the declaration and write its entities out".to_owned(),
            )
        }
        Error::NodesLimitReached => Diagnostic::error(
            0..0,
            format!("the file has more than {MOST_NODES} elements and texts"),
            "in this file",
        ),
        Error::AttributesLimitReached | Error::NamespacesLimitReached => {
            Diagnostic::error(0..0, "the file has too many attributes", "in this file")
        }
        Error::NoRootNode => {
            Diagnostic::error(char_at(last), "the file has no element", "expected <world>")
                .help("a scene file is <world> with a <camera>, <lights> and <shapes>".to_owned())
        }
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => Diagnostic::error(
            char_at(last),
            "not well-formed XML: the file ends too early",
            "something is still open here",
        )
        .help("is a closing tag such as </world>, a quote or a `-->` missing?".to_owned()),
        Error::UnexpectedCloseTag(expected, found, _) => error_at(
            &format!("</{}> where </{}> was expected", shorten(found), shorten(expected)),
            "this closes another element than the open one",
        ),
        Error::DuplicatedAttribute(name, _) => {
            let first = text[..at].rfind(&format!("{name}=")).filter(|&first| {
                !text[first..at].contains('>') && text[..first].ends_with(char::is_whitespace)
            });
            let mut diagnostic =
                error_at(&format!("`{}` is given twice", shorten(name)), "again here")
                    .help(format!("keep one `{}`", shorten(name)));
            diagnostic.span = at..(at + name.len()).min(text.len());
            match first {
                Some(first) => diagnostic.related(first..first + name.len(), "first here"),
                None => diagnostic,
            }
        }
        Error::UnknownEntityReference(name, _) => error_at(
            &format!("`&{};` is not defined", shorten(name)),
            "XML knows `&lt;` `&gt;` `&amp;` `&quot;` `&apos;`",
        ),
        Error::MalformedEntityReference(_) => {
            error_at("`&` begins an entity", "not followed by a name and `;`")
                .help("write `&amp;` for the character itself".to_owned())
        }
        Error::InvalidAttributeValue(_) => error_at("`<` inside an attribute's value", "here")
            .help("is the closing quote of the value before it missing?".to_owned()),
        Error::UnexpectedDeclaration(_) => error_at(
            "the XML declaration must be the first thing in the file",
            "something stands before it",
        ),
        Error::UnknownNamespace(prefix, _) => {
            error_at(&format!("the prefix `{}:` is not declared", shorten(prefix)), "here")
                .help("names of the scene language have no prefix".to_owned())
        }
        Error::NonXmlChar(c, _) => {
            error_at(&format!("the character U+{:04X} is not allowed", u32::from(*c)), "here")
        }
        Error::InvalidComment(_) => error_at("a comment must not hold `--`", "in this comment"),
        Error::InvalidName(_) => error_at("a name was expected", "this cannot begin a name"),
        Error::InvalidChar(expected, found, _) => error_at(
            &format!("`{}` was expected", char::from(*expected)),
            &format!("found `{}`", char::from(*found).escape_default()),
        ),
        Error::InvalidChar2(expected, found, _) => error_at(
            &format!("{expected} was expected"),
            &format!("found `{}`", char::from(*found).escape_default()),
        )
        .help((*expected == "a whitespace").then(|| "is a quote missing before it?".to_owned())),
        Error::UnknownToken(_) if text[..at].trim().is_empty() => {
            Diagnostic::error(char_at(at), "the file is not XML", "expected <world>")
                .help("a scene file is <world> with a <camera>, <lights> and <shapes>".to_owned())
        }
        Error::UnknownToken(_) => {
            error_at("something stands behind the root element", "expected nothing more")
        }
        Error::InvalidString(expected, _) => {
            error_at(&format!("`{expected}` was expected"), "here")
        }
        other => {
            // The parser's message ends in its own notion of the place.
            let message = other.to_string();
            let message = message.split(" at ").next().unwrap_or(&message).to_owned();
            error_at(&shorten(&message), "here")
        }
    }
}
