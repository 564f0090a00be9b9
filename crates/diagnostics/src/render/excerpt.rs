//! A source text in a form that is safe to show: hidden characters as their codes, and places moved accordingly.

use std::borrow::Cow;
use std::ops::Range;

use crate::visible::{code, is_hidden};

/// A text to show.
pub(super) struct Excerpt<'a> {
    pub(super) text: Cow<'a, str>,
    /// For each hidden character: its end in the file, and its end in the shown text.
    ends: Vec<(usize, usize)>,
}

impl<'a> Excerpt<'a> {
    /// A byte order mark at the start of the file stays.
    pub(super) fn new(text: &'a str, is_file_start: bool) -> Self {
        let is_shown_as_code = |at: usize, character: char| {
            (at > 0 || !is_file_start || character != '\u{feff}')
                && is_shown_as_code(text, at, character)
        };
        let mut excerpt = Self { text: Cow::Borrowed(text), ends: Vec::new() };
        if !text.char_indices().any(|(at, character)| is_shown_as_code(at, character)) {
            return excerpt;
        }
        let mut shown = String::with_capacity(text.len());
        for (at, character) in text.char_indices() {
            if is_shown_as_code(at, character) {
                shown.push_str(&code(character));
                excerpt.ends.push((at + character.len_utf8(), shown.len()));
            } else {
                shown.push(character);
            }
        }
        excerpt.text = Cow::Owned(shown);
        excerpt
    }

    /// Whether anything is shown as its code.
    pub(super) fn is_changed(&self) -> bool {
        !self.ends.is_empty()
    }

    /// The range of the shown text for a range of the file.
    pub(super) fn shown(&self, range: Range<usize>) -> Range<usize> {
        self.moved(range.start)..self.moved(range.end)
    }

    fn moved(&self, offset: usize) -> usize {
        let before = self.ends.partition_point(|(end, _)| *end <= offset);
        let last = before.checked_sub(1).and_then(|last| self.ends.get(last));
        last.map_or(offset, |(end, shown)| shown + (offset - end))
    }
}

/// Whether a character is shown as its code; line ends and tabs are not.
fn is_shown_as_code(text: &str, at: usize, character: char) -> bool {
    let next = || text.as_bytes().get(at + 1);
    match character {
        '\n' | '\t' => false,
        '\r' => next() != Some(&b'\n'),
        _ => is_hidden(character),
    }
}
