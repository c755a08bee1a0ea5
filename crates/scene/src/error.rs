use std::fmt;

/// A value outside the range that its type allows.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{found}, expected {expected}")]
pub struct OutOfRange {
    /// The value, as text.
    pub found: String,
    /// What would have been accepted, as a phrase ("a number greater than 0").
    pub expected: &'static str,
}

impl OutOfRange {
    pub(crate) fn new(found: impl fmt::Display, expected: &'static str) -> Self {
        Self { found: found.to_string(), expected }
    }

    /// Says which field the value was meant for.
    #[must_use]
    pub fn in_field(self, field: impl Into<String>) -> InvalidField {
        InvalidField { field: field.into(), problem: self }
    }
}

/// A field whose value is outside its range.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{field} is {problem}")]
pub struct InvalidField {
    /// The field's name, with its path inside the scene where that is known:
    /// `radius`, `shapes[3].radius`.
    pub field: String,
    /// What is wrong with its value.
    pub problem: OutOfRange,
}

impl InvalidField {
    pub(crate) fn within(self, outer: &str) -> Self {
        Self { field: format!("{outer}.{}", self.field), ..self }
    }
}

/// Everything that is wrong with a scene that was being built; never empty.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct InvalidScene {
    /// The mistakes, in the order in which the builder met them.
    pub mistakes: Vec<InvalidField>,
}

impl fmt::Display for InvalidScene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, mistake) in self.mistakes.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{mistake}")?;
        }
        Ok(())
    }
}
