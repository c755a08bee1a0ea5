//! The sections of docs/stability.md that commands write.

use crate::{Failure, sections};

/// Replaces a section, or adds it where there is none of that name.
pub(crate) fn write(name: &str, text: &str) -> Result<(), Failure> {
    sections::write("stability.md", name, text)
}
