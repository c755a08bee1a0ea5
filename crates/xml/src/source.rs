use std::ops::Range;

/// The text of a file, in which diagnostics have their places.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    text: String,
    /// Where each line starts, in bytes.
    lines: Vec<usize>,
}

impl Source {
    pub(crate) fn new(text: String) -> Self {
        let starts = text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i + 1);
        let lines = std::iter::once(0).chain(starts).collect();
        Self { text, lines }
    }

    /// The text. Where the file was not UTF-8, what was not is replaced.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The line and column of a byte, both counted from 1, columns in
    /// characters. What is past the end counts as the end.
    #[must_use]
    pub fn location(&self, offset: usize) -> (usize, usize) {
        let offset = self.floor_boundary(offset);
        let line = self.lines.partition_point(|&start| start <= offset);
        let start = self.lines[line - 1];
        (line, self.text[start..offset].chars().count() + 1)
    }

    /// The bytes of a line, counted from 1, without its end.
    #[must_use]
    pub fn line(&self, number: usize) -> Range<usize> {
        let start = self.lines.get(number.wrapping_sub(1)).copied().unwrap_or(self.text.len());
        let end = self.lines.get(number).map_or(self.text.len(), |next| next - 1);
        start..end.max(start)
    }

    /// The byte of a line and column, both counted from 1, columns in
    /// characters.
    pub(crate) fn offset(&self, line: usize, column: usize) -> usize {
        let range = self.line(line);
        let skipped = column.saturating_sub(1);
        let line = &self.text[range.clone()];
        line.char_indices().nth(skipped).map_or(range.end, |(i, _)| range.start + i)
    }

    fn floor_boundary(&self, offset: usize) -> usize {
        let mut offset = offset.min(self.text.len());
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        offset
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_counted_in_characters_from_one() {
        let source = Source::new("ab\né\u{1f600}x\n".to_owned());
        for (offset, expected) in
            [(0, (1, 1)), (2, (1, 3)), (3, (2, 1)), (5, (2, 2)), (9, (2, 3)), (11, (3, 1))]
        {
            assert_eq!(source.location(offset), expected, "byte {offset}");
            assert_eq!(source.offset(expected.0, expected.1), offset);
        }
        assert_eq!(source.location(7), (2, 2), "inside a character");
        assert_eq!(source.location(999), (3, 1), "past the end");
        assert_eq!(source.line(2), 3..10);
        assert_eq!(source.line(9), 11..11);
    }
}
