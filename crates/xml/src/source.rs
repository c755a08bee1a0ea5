use std::ops::Range;

/// The text of a file, in which diagnostics have their places.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    text: String,
    /// Where each line starts, in bytes.
    lines: Vec<usize>,
    /// How many characters begin before each multiple of [`STRIDE`] bytes, so
    /// that columns of long lines need not be counted from their beginning.
    characters: Vec<usize>,
}

/// How far apart the counts of characters are.
const STRIDE: usize = 1024;

impl Source {
    pub(crate) fn new(text: String) -> Self {
        let starts = text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i + 1);
        let lines = std::iter::once(0).chain(starts).collect();
        let mut count = 0;
        let characters = text.as_bytes().chunks(STRIDE).map(|chunk| {
            let before = count;
            count += begun_in(chunk);
            before
        });
        let characters = characters.collect();
        Self { text, lines, characters }
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
        (line, self.characters_before(offset) - self.characters_before(start) + 1)
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

    fn characters_before(&self, offset: usize) -> usize {
        let block = offset / STRIDE;
        let Some(before) = self.characters.get(block) else {
            // The end of a text that fills its last block.
            return self.characters.last().copied().unwrap_or(0)
                + begun_in(&self.text.as_bytes()[offset.saturating_sub(STRIDE)..]);
        };
        before + begun_in(&self.text.as_bytes()[block * STRIDE..offset])
    }

    fn floor_boundary(&self, offset: usize) -> usize {
        let mut offset = offset.min(self.text.len());
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        offset
    }
}

/// How many characters begin in these bytes of UTF-8.
fn begun_in(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&byte| byte & 0b1100_0000 != 0b1000_0000).count()
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
        for length in [1023, 1024, 1025, 3000, 4096] {
            let text: String = "aé\u{1f600}\u{2212}".chars().cycle().take(length).collect();
            let source = Source::new(format!("x\n{text}"));
            for (column, (offset, _)) in text.char_indices().enumerate() {
                assert_eq!(source.location(offset + 2), (2, column + 1));
            }
            assert_eq!(source.location(usize::MAX), (2, length + 1));
        }
        let full = Source::new("y".repeat(2048));
        assert_eq!(full.location(2048), (1, 2049));
        assert_eq!(source.location(7), (2, 2), "inside a character");
        assert_eq!(source.location(999), (3, 1), "past the end");
        assert_eq!(source.line(2), 3..10);
        assert_eq!(source.line(9), 11..11);
    }
}
