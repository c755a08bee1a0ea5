//! The words of a text file, with their places.

use crate::{MeshFileError, Place};

/// A word, which white space ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Word<'a> {
    pub(crate) bytes: &'a [u8],
    line: usize,
    column: usize,
}

impl<'a> Word<'a> {
    pub(crate) fn place(&self) -> Place {
        Place::Line { line: self.line, column: Some(self.column) }
    }

    /// An error at this word.
    pub(crate) fn error(&self, expected: &str) -> MeshFileError {
        MeshFileError::new(
            self.place(),
            format!("expected {expected}, found {}", quoted(self.bytes)),
        )
    }

    /// The part of the word that begins at a byte of it.
    pub(crate) fn part(&self, start: usize, length: usize) -> Word<'a> {
        let bytes = self.bytes.get(start..start + length).unwrap_or_default();
        Word { bytes, column: self.column + start, ..*self }
    }

    /// A finite number, rounded to double precision.
    pub(crate) fn number(&self) -> Result<f64, MeshFileError> {
        std::str::from_utf8(self.bytes)
            .ok()
            .and_then(|text| text.parse::<f64>().ok())
            .filter(|value| value.is_finite())
            .ok_or_else(|| self.error("a finite number"))
    }
}

/// At most 40 bytes of a text as it can be shown in a message.
pub(crate) fn quoted(bytes: &[u8]) -> String {
    let short = &bytes[..bytes.len().min(40)];
    let text: String = String::from_utf8_lossy(short)
        .chars()
        .map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c })
        .collect();
    format!("`{text}{}`", if short.len() < bytes.len() { "..." } else { "" })
}

/// A place in a text that moves forward word by word.
///
/// Lines end with a line feed, a carriage return, or both. Nothing need be
/// UTF-8, since comments and names often are not.
#[derive(Debug, Clone)]
pub(crate) struct Words<'a> {
    bytes: &'a [u8],
    next: usize,
    line: usize,
    line_start: usize,
    /// Whether `#` begins a comment and `\` at its end continues a line, as in OBJ.
    is_obj: bool,
}

impl<'a> Words<'a> {
    pub(crate) fn new(bytes: &'a [u8], is_obj: bool) -> Self {
        Self { bytes, next: 0, line: 1, line_start: 0, is_obj }
    }

    /// The line it is on, counted from 1.
    pub(crate) fn line(&self) -> usize {
        self.line
    }

    /// An error on the line it is on.
    pub(crate) fn error(&self, message: impl Into<String>) -> MeshFileError {
        MeshFileError::new(Place::Line { line: self.line, column: None }, message)
    }

    /// How many bytes here are the end of a line.
    fn line_end(&self, at: usize) -> Option<usize> {
        match self.bytes.get(at)? {
            b'\n' => Some(1),
            b'\r' if self.bytes.get(at + 1) == Some(&b'\n') => Some(2),
            b'\r' => Some(1),
            _ => None,
        }
    }

    fn start_line(&mut self, at: usize) {
        self.next = at;
        self.line_start = at;
        self.line += 1;
    }

    /// The next word of this line, or of those that continue it.
    pub(crate) fn next_in_line(&mut self) -> Option<Word<'a>> {
        loop {
            match self.bytes.get(self.next)? {
                b'\n' | b'\r' => return None,
                c if c.is_ascii_whitespace() || *c == 0x0b => self.next += 1,
                b'\\' if self.is_obj && self.line_end(self.next + 1).is_some() => {
                    let end = self.line_end(self.next + 1).unwrap_or(1);
                    self.start_line(self.next + 1 + end);
                }
                b'#' if self.is_obj => {
                    while self.bytes.get(self.next).is_some_and(|c| !matches!(c, b'\n' | b'\r')) {
                        self.next += 1;
                    }
                    return None;
                }
                _ => break,
            }
        }
        let start = self.next;
        while let Some(c) = self.bytes.get(self.next) {
            let continued = self.is_obj && *c == b'\\' && self.line_end(self.next + 1).is_some();
            if c.is_ascii_whitespace() || *c == 0x0b || continued {
                break;
            }
            self.next += 1;
        }
        let column = start - self.line_start + 1;
        Some(Word { bytes: &self.bytes[start..self.next], line: self.line, column })
    }

    /// Goes to the next line that begins one; false at the end of the file.
    pub(crate) fn next_line(&mut self) -> bool {
        while self.next_in_line().is_some() {}
        let Some(end) = self.line_end(self.next) else { return false };
        self.start_line(self.next + end);
        true
    }

    /// The next word of the file.
    pub(crate) fn next_word(&mut self) -> Option<Word<'a>> {
        loop {
            if let Some(word) = self.next_in_line() {
                return Some(word);
            }
            if !self.next_line() {
                return None;
            }
        }
    }

    /// The next word of this line, which must be there.
    pub(crate) fn expect_in_line(&mut self, expected: &str) -> Result<Word<'a>, MeshFileError> {
        self.next_in_line()
            .ok_or_else(|| self.error(format!("expected {expected}, found the end of the line")))
    }
}
