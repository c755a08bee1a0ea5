use std::fmt;

/// Where in a mesh file something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// In a text file, or in the text at the beginning of a binary one.
    Line {
        /// Counted from 1.
        line: usize,
        /// The byte of the line, counted from 1, where one is to blame.
        column: Option<usize>,
    },
    /// In a binary file: how many bytes are before it.
    Byte(u64),
    /// The file as a whole.
    File,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line { line, column: None } => write!(f, "line {line}"),
            Self::Line { line, column: Some(column) } => write!(f, "line {line}, column {column}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
            Self::File => write!(f, "the file"),
        }
    }
}

/// Why a mesh file could not be used.
///
/// Shown as "line 12, column 3: expected a number, found `x`", or, where the
/// place is the whole file, as the message alone. The help is not shown.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct MeshFileError {
    /// What is wrong, in one line.
    pub message: String,
    /// Where.
    pub place: Place,
    /// What to do about it.
    pub help: Option<String>,
}

impl fmt::Display for MeshFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.place {
            Place::File => write!(f, "{}", self.message),
            place => write!(f, "{place}: {}", self.message),
        }
    }
}

impl MeshFileError {
    pub(crate) fn new(place: Place, message: impl Into<String>) -> Self {
        Self { message: message.into(), place, help: None }
    }

    pub(crate) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}
