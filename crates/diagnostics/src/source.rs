//! Files by number, places in them, and their lines and columns.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::OnceLock;

/// A file of a [`SourceMap`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(u32);

/// A place: a byte range of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The file.
    pub file: FileId,
    /// The first byte.
    pub start: u32,
    /// The byte after the last.
    pub end: u32,
}

impl Span {
    /// The span of `range` in `file`; a range beyond 4 GiB is clipped.
    #[must_use]
    pub fn new(file: FileId, range: Range<usize>) -> Self {
        let cut = |offset: usize| u32::try_from(offset).unwrap_or(u32::MAX);
        Self { file, start: cut(range.start), end: cut(range.end) }
    }

    /// The byte range.
    #[must_use]
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }

    /// The smallest span that covers both; `self` if they are in different files.
    #[must_use]
    pub fn cover(self, other: Self) -> Self {
        if self.file != other.file {
            return self;
        }
        Self { start: self.start.min(other.start), end: self.end.max(other.end), ..self }
    }
}

/// A place in the way people and editors count, with line and column from 1; the column counts characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LineColumn {
    /// The line.
    pub line: u32,
    /// The character in the line.
    pub column: u32,
}

#[derive(Clone, Debug)]
struct File {
    name: String,
    text: String,
    /// Made when a place in the file is first looked up.
    index: OnceLock<Index>,
}

/// The starts of lines and the characters before each block, so that no place is searched for from the start of its
/// file or its line.
#[derive(Clone, Debug)]
struct Index {
    lines: Vec<u32>,
    /// The number of characters before each block of the text.
    characters: Vec<u32>,
}

/// The size of a block, after which the number of characters is stored again.
const BLOCK_BYTES: usize = 256;

impl Index {
    fn new(text: &str) -> Self {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let lines = std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).map(small).collect();
        let mut before = 0;
        let blocks = text.as_bytes().chunks(BLOCK_BYTES).map(|block| {
            let here = before;
            before += characters(block);
            small(here)
        });
        let mut blocks: Vec<u32> = blocks.collect();
        // A text that fills its last block ends at the start of another one.
        blocks.push(small(before));
        Self { lines, characters: blocks }
    }

    /// The number of characters before a byte.
    fn characters_before(&self, text: &str, offset: usize) -> usize {
        let block = offset / BLOCK_BYTES;
        let before = self.characters.get(block).map_or(0, |before| *before as usize);
        before + characters(text.as_bytes().get(block * BLOCK_BYTES..offset).unwrap_or_default())
    }
}

/// The number of characters that begin in a piece of UTF-8.
fn characters(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| **byte & 0xc0 != 0x80).count()
}

fn small(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

impl File {
    fn index(&self) -> &Index {
        self.index.get_or_init(|| Index::new(&self.text))
    }
}

/// All files that were read, in the order in which they were read.
#[derive(Clone, Debug, Default)]
pub struct SourceMap {
    files: Vec<File>,
    /// The first file with each name.
    names: BTreeMap<String, FileId>,
}

impl SourceMap {
    /// Adds a file under the name that people see.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<String>) -> FileId {
        let file = FileId(small(self.files.len()));
        let name = name.into();
        self.names.entry(name.clone()).or_insert(file);
        self.files.push(File { name, text: text.into(), index: OnceLock::new() });
        file
    }

    fn file(&self, file: FileId) -> Option<&File> {
        self.files.get(file.0 as usize)
    }

    /// The file's name; empty for a file of another map.
    #[must_use]
    pub fn name(&self, file: FileId) -> &str {
        self.file(file).map_or("", |file| &file.name)
    }

    /// The file's text; empty for a file of another map.
    #[must_use]
    pub fn text(&self, file: FileId) -> &str {
        self.file(file).map_or("", |file| &file.text)
    }

    /// The file with this name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<FileId> {
        self.names.get(name).copied()
    }

    /// The line and column of a byte offset; an offset past the end counts as the end.
    #[must_use]
    pub fn line_column(&self, file: FileId, offset: u32) -> LineColumn {
        let Some(file) = self.file(file) else { return LineColumn { line: 1, column: 1 } };
        let (text, index) = (file.text.as_str(), file.index());
        let offset = boundary(text, offset as usize);
        let line = index.lines.partition_point(|start| *start as usize <= offset);
        let start = index.lines.get(line.saturating_sub(1)).map_or(0, |start| *start as usize);
        let column =
            index.characters_before(text, offset) - index.characters_before(text, start) + 1;
        LineColumn { line: small(line), column: small(column) }
    }

    /// The start of line `line` (from 1); past the last line, the end of the text.
    pub(crate) fn line_start(&self, file: FileId, line: u32) -> usize {
        let Some(file) = self.file(file) else { return 0 };
        let at = (line as usize).saturating_sub(1);
        file.index().lines.get(at).map_or(file.text.len(), |start| *start as usize)
    }
}

/// The character boundary at or before an offset.
pub(crate) fn boundary(text: &str, offset: usize) -> usize {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let mut map = SourceMap::default();
        let file = map.add("x", "a\nµb\n");
        assert_eq!(map.line_column(file, 4), LineColumn { line: 2, column: 2 });
        assert_eq!(map.line_column(file, 3), LineColumn { line: 2, column: 1 });
        assert_eq!(map.line_column(file, 999), LineColumn { line: 3, column: 1 });
    }

    #[test]
    fn the_end_of_a_text_that_fills_its_blocks_has_a_place() {
        let mut map = SourceMap::default();
        let file = map.add("x", "a\n".repeat(BLOCK_BYTES));
        let end = small(2 * BLOCK_BYTES);
        assert_eq!(map.line_column(file, end), LineColumn { line: 257, column: 1 });
    }

    #[test]
    fn places_are_those_that_counting_gives() {
        let text = "aµ😀\r\n\n".repeat(200) + &"ä".repeat(1_000) + "\nend";
        let mut map = SourceMap::default();
        let file = map.add("x", text.as_str());
        for offset in 0..=text.len() {
            let before = &text[..boundary(&text, offset)];
            let column = before.rsplit('\n').next().unwrap().chars().count() + 1;
            let expected =
                LineColumn { line: small(before.matches('\n').count() + 1), column: small(column) };
            assert_eq!(map.line_column(file, small(offset)), expected, "{offset}");
        }
    }
}
