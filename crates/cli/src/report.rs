//! Diagnostics as a person reads them.

use lancer_xml::{Diagnostic, Parsed, Severity, Source};
use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, MietteSpanContents,
    SourceCode, SourceSpan, SpanContents,
};
use std::fmt;
use std::io::{IsTerminal, Write};
use std::ops::Range;

/// Writes a line to standard error; if nobody listens, so be it. Names of files
/// in it may hold anything.
pub(crate) fn say(line: fmt::Arguments<'_>) {
    let line = line.to_string();
    let line: String =
        line.chars().map(|c| if c == '\n' || is_printable(c) { c } else { '?' }).collect();
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Nobody reads more diagnostics of one file.
const MOST_SHOWN: usize = 1000;

/// How many errors and warnings were reported.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Tally {
    pub(crate) errors: usize,
    pub(crate) warnings: usize,
}

impl Tally {
    fn count(diagnostics: &[Diagnostic]) -> Self {
        let errors = diagnostics.iter().filter(|d| d.severity == Severity::Error).count();
        Self { errors, warnings: diagnostics.len() - errors }
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (errors, warnings) = (count(self.errors, "error"), count(self.warnings, "warning"));
        match (self.errors, self.warnings) {
            (0, _) => f.write_str(&warnings),
            (_, 0) => f.write_str(&errors),
            _ => write!(f, "{errors} and {warnings}"),
        }
    }
}

/// "1 light", "2 lights".
pub(crate) fn count(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

/// Shows all that is wrong with a file on standard error.
pub(crate) fn show(name: &str, parsed: &Parsed, quiet: bool) -> Tally {
    let tally = Tally::count(&parsed.diagnostics);
    let least = if quiet { Severity::Error } else { Severity::Warning };
    let text = Printable::new(name, &parsed.source);
    let handler = GraphicalReportHandler::new_themed(theme()).with_links(false).with_width(100);
    let mut shown = parsed.diagnostics.iter().filter(|d| d.severity >= least);
    for diagnostic in shown.by_ref().take(MOST_SHOWN) {
        let _ = std::io::stderr().write_all(render(&handler, diagnostic, &text).as_bytes());
    }
    match shown.count() {
        0 => {}
        more => say(format_args!("... and {more} more like these\n")),
    }
    tally
}

/// All that is wrong with a file as text, without colours.
#[must_use]
pub fn to_text(name: &str, parsed: &Parsed) -> String {
    let text = Printable::new(name, &parsed.source);
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
        .with_links(false)
        .with_width(100);
    parsed.diagnostics.iter().map(|diagnostic| render(&handler, diagnostic, &text)).collect()
}

fn theme() -> GraphicalTheme {
    let colours = std::io::stderr().is_terminal()
        && std::env::var_os("NO_COLOR").is_none()
        && std::env::var_os("TERM").is_none_or(|term| term != "dumb");
    if colours { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() }
}

fn render(handler: &GraphicalReportHandler, diagnostic: &Diagnostic, text: &Printable) -> String {
    let mut out = String::new();
    let shown = Shown { diagnostic, text };
    if handler.render_report(&mut out, &shown).is_err() {
        // Better the bare message than none.
        out = format!("{}\n", diagnostic.message);
    }
    out.push('\n');
    out
}

/// A diagnostic in the form that the printing library takes.
struct Shown<'a> {
    diagnostic: &'a Diagnostic,
    text: &'a Printable,
}

impl fmt::Debug for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.diagnostic.fmt(f)
    }
}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.diagnostic.message)
    }
}

impl std::error::Error for Shown<'_> {}

impl miette::Diagnostic for Shown<'_> {
    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.diagnostic.severity {
            Severity::Error => miette::Severity::Error,
            Severity::Warning => miette::Severity::Warning,
        })
    }

    fn help(&self) -> Option<Box<dyn fmt::Display + '_>> {
        self.diagnostic.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(self.text)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let primary = LabeledSpan::new_primary_with_span(
            Some(self.diagnostic.label.clone()),
            self.text.span(&self.diagnostic.span),
        );
        let related = self.diagnostic.related.as_ref().map(|(span, label)| {
            LabeledSpan::new_with_span(Some(label.clone()), self.text.span(span))
        });
        Some(Box::new(std::iter::once(primary).chain(related)))
    }
}

/// The text of a file in a form that is safe and short enough to print.
struct Printable {
    name: String,
    source: Source,
    /// The source's text, with control characters replaced by as many bytes.
    text: String,
}

/// How many bytes of a long line are shown on either side of a place, and how
/// many of a long place.
const MOST_BYTES: usize = 80;

/// Neither a control character nor one that changes the direction of the text
/// around it.
pub(crate) fn is_printable(c: char) -> bool {
    !c.is_control()
        && !matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

impl Printable {
    fn new(name: &str, source: &Source) -> Self {
        let mut text = String::with_capacity(source.text().len());
        for c in source.text().chars() {
            if matches!(c, '\n' | '\t') || is_printable(c) {
                text.push(c);
            } else if c == '\r' {
                // The printing library would take it for the end of a line.
                text.push(' ');
            } else {
                text.extend(std::iter::repeat_n('?', c.len_utf8()));
            }
        }
        let name = name.chars().map(|c| if is_printable(c) { c } else { '?' }).collect();
        Self { name, source: source.clone(), text }
    }

    /// A span that is inside the text and not too long.
    fn span(&self, span: &Range<usize>) -> SourceSpan {
        let start = self.boundary(span.start);
        let end = self.boundary(span.end.min(start + MOST_BYTES)).max(start);
        (start..end).into()
    }

    /// The last boundary of characters that is not after `offset`.
    fn boundary(&self, offset: usize) -> usize {
        (0..=offset.min(self.text.len()))
            .rev()
            .find(|&offset| self.text.is_char_boundary(offset))
            .unwrap_or(0)
    }

    /// The lines around a span, or where they are long a part of its own.
    fn excerpt(&self, span: &SourceSpan, before: usize, after: usize) -> Range<usize> {
        let (start, end) = (span.offset(), span.offset() + span.len());
        if before + after == 0 {
            return start..end;
        }
        let first = self.source.location(start).0.saturating_sub(before).max(1);
        let last = self.source.location(end).0 + after;
        let (first, last) = (self.source.line(first), self.source.line(last));
        let long = |line: Range<usize>| line.len() > 3 * MOST_BYTES;
        let here = self.source.line(self.source.location(start).0);
        if long(here.clone()) || long(first.clone()) || long(last.clone()) {
            let near = self.boundary(start.saturating_sub(MOST_BYTES)).max(here.start);
            near..self.boundary(end + MOST_BYTES).min(here.end).max(end)
        } else {
            first.start..last.end
        }
    }
}

impl SourceCode for Printable {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        context_lines_before: usize,
        context_lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let excerpt = self.excerpt(span, context_lines_before, context_lines_after);
        let (line, column) = self.source.location(excerpt.start);
        let data = &self.text[excerpt.clone()];
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.clone(),
            data.as_bytes(),
            excerpt.into(),
            line - 1,
            column - 1,
            data.lines().count(),
        )))
    }
}
