//! From bytes to well-formed XML, or the one reason why they are not.

use crate::element::shorten;
use crate::{Diagnostic, Source};
use roxmltree::{Document, Error, ParsingOptions};
use std::ops::Range;

/// How deeply elements may be nested. The language itself needs four levels, and
/// one for each group around a shape.
pub const DEEPEST: usize = 100;

/// How many elements, texts and comments a file may have.
pub const MOST_NODES: u32 = 20_000_000;

/// How many attributes one element may have. The parser compares each with
/// each; the language itself needs fourteen.
pub const MOST_ATTRIBUTES: usize = 1000;

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

/// Why a text is no XML tree.
#[derive(Debug)]
pub(crate) struct NoTree {
    pub(crate) diagnostic: Diagnostic,
    /// The bytes without which it may be one: blanked out, they let the rest
    /// of the mistakes be found.
    pub(crate) mend: Option<Range<usize>>,
}

impl From<Diagnostic> for Box<NoTree> {
    fn from(diagnostic: Diagnostic) -> Self {
        Self::new(NoTree { diagnostic, mend: None })
    }
}

/// The XML tree of `text`, which is the source's text but for bytes that were
/// blanked out.
pub(crate) fn tree<'t>(text: &'t str, source: &Source) -> Result<Document<'t>, Box<NoTree>> {
    if let Some(tag) = crowded_tag(text) {
        return Err(Diagnostic::error(
            tag,
            format!("an element has more than {MOST_ATTRIBUTES} attributes"),
            "this one",
        )
        .into());
    }
    let options = ParsingOptions { nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let diagnostic = explain(&error, text, source);
        let mend = mendable(&error, text, &diagnostic);
        Box::new(NoTree { diagnostic, mend })
    })?;
    match too_deep(&document) {
        None => Ok(document),
        Some(node) => Err(Diagnostic::error(
            start_of(&node),
            format!("elements are nested more than {DEEPEST} levels deep"),
            "this one is too deep",
        )
        .help("a scene needs four levels: world, lights, lamp, point; and one for each group around a shape".to_owned())
        .into()),
    }
}

/// What to blank out so that mistakes behind this one are found, too.
fn mendable(error: &Error, text: &str, diagnostic: &Diagnostic) -> Option<Range<usize>> {
    let at = diagnostic.span.start;
    match error {
        Error::DuplicatedAttribute(..) => {
            let quote = at + text[at..].find(['"', '\''])?;
            let mark = text[quote..].chars().next()?;
            let end = quote + 1 + text[quote + 1..].find(mark)? + 1;
            Some(at..end)
        }
        Error::UnknownEntityReference(..) | Error::NonXmlChar(..) => Some(diagnostic.span.clone()),
        _ => None,
    }
    .filter(|mend| !mend.is_empty())
}

/// The beginning of the first tag with too many attributes.
fn crowded_tag(text: &str) -> Option<Range<usize>> {
    let mut rest = 0;
    while let Some(open) = text[rest..].find('<').map(|i| rest + i) {
        // Comments and the like may hold anything.
        let skip = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")]
            .into_iter()
            .find(|(begin, _)| text[open..].starts_with(begin));
        if let Some((begin, end)) = skip {
            let inside = open + begin.len();
            rest = inside + text[inside..].find(end)? + end.len();
            continue;
        }
        let (mut quote, mut values, mut close) = (None, 0, text.len());
        for (i, byte) in text.bytes().enumerate().skip(open + 1) {
            match (quote, byte) {
                (Some(mark), _) if mark == byte => quote = None,
                (Some(_), _) => {}
                (None, b'"' | b'\'') => {
                    quote = Some(byte);
                    values += 1;
                }
                (None, b'>') => {
                    close = i;
                    break;
                }
                (None, _) => {}
            }
        }
        if values > MOST_ATTRIBUTES {
            let name = text[open..].find(char::is_whitespace).unwrap_or(1);
            return Some(open..open + name);
        }
        rest = close;
    }
    None
}

/// The first bytes of an element: `<` and its name.
pub(crate) fn start_of(node: &roxmltree::Node<'_, '_>) -> Range<usize> {
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
fn explain(error: &Error, text: &str, source: &Source) -> Diagnostic {
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
            let in_comment = |at: usize| text[..at].rfind("<!--") > text[..at].rfind("-->");
            let mut places = text.match_indices("<!DOCTYPE").map(|(at, _)| at);
            let at = places.find(|at| !in_comment(*at)).unwrap_or(0);
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
        Error::UnknownEntityReference(name, _) => {
            let mut diagnostic = error_at(
                &format!("`&{};` is not defined", shorten(name)),
                "XML knows `&lt;` `&gt;` `&amp;` `&quot;` `&apos;`",
            );
            let reference = format!("&{name};");
            if let Some(start) = text[at..].find(&reference).map(|i| at + i) {
                diagnostic.span = start..start + reference.len();
            }
            diagnostic
        }
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
        Error::InvalidName(_) => error_at("a name was expected", "this cannot begin a name")
            .help("is a `>` missing before it?".to_owned()),
        Error::InvalidChar(expected, found, _) => error_at(
            &format!("`{}` was expected", char::from(*expected)),
            &format!("found `{}`", char::from(*found).escape_default()),
        )
        .help((*found == b'<').then(|| "inside a value write `&lt;` for `<`".to_owned())),
        Error::InvalidChar2(expected, found, _) => error_at(
            &format!("{expected} was expected"),
            &format!("found `{}`", char::from(*found).escape_default()),
        )
        .help(match *expected {
            "a whitespace" => Some("is a quote missing before it?".to_owned()),
            "a quote" => Some("write values in quotes: `size=\"1\"`".to_owned()),
            _ => None,
        }),
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
