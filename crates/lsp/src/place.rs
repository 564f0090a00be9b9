//! Places: offsets in bytes here, lines and columns of an editor there; paths here, URIs there.

use std::fmt::Write as _;

use line_index::{LineIndex, TextSize};
use sensedsl_model::normal_path;

use crate::protocol::{Position, Range};

/// What a column counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Encoding {
    Utf8,
    /// What every client understands.
    #[default]
    Utf16,
}

impl Encoding {
    /// The best of those that a client offers.
    pub(crate) fn of(offered: &[String]) -> Self {
        if offered.iter().any(|one| one == "utf-8") { Self::Utf8 } else { Self::Utf16 }
    }

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Utf8 => "utf-8",
            Self::Utf16 => "utf-16",
        }
    }

    fn units(self, character: char) -> usize {
        match self {
            Self::Utf8 => character.len_utf8(),
            Self::Utf16 => character.len_utf16(),
        }
    }
}

/// The lines of a text.
#[derive(Clone, Debug)]
pub(crate) struct Lines {
    index: LineIndex,
    encoding: Encoding,
}

impl Lines {
    pub(crate) fn new(text: &str, encoding: Encoding) -> Self {
        Self { index: LineIndex::new(text), encoding }
    }

    /// Where the bytes of a line begin and end, with its line break.
    fn line(&self, text: &str, line: u32) -> Option<std::ops::Range<usize>> {
        let range = self.index.line(line)?;
        let (start, end) = (usize::from(range.start()), usize::from(range.end()));
        Some(start..end.min(text.len()))
    }

    /// The position of an offset; of one within a character, that of the character.
    pub(crate) fn position(&self, text: &str, offset: usize) -> Position {
        let mut offset = offset.min(text.len());
        while !text.is_char_boundary(offset) {
            offset -= 1;
        }
        let size = TextSize::from(u32::try_from(offset).unwrap_or(u32::MAX));
        let line = self.index.try_line_col(size).map_or(0, |found| found.line);
        let start = self.line(text, line).map_or(0, |range| range.start);
        let before = text.get(start..offset).unwrap_or_default();
        let units: usize = before.chars().map(|one| self.encoding.units(one)).sum();
        Position { line, character: u32::try_from(units).unwrap_or(u32::MAX) }
    }

    /// The offset of a position; of one behind the end of its line, or of the text, that end.
    pub(crate) fn offset(&self, text: &str, at: Position) -> usize {
        let Some(range) = self.line(text, at.line) else { return text.len() };
        let line = text.get(range.clone()).unwrap_or_default();
        let line = line.trim_end_matches(['\n', '\r']);
        let mut units = 0;
        for (offset, character) in line.char_indices() {
            if units >= at.character as usize {
                return range.start + offset;
            }
            units += self.encoding.units(character);
        }
        range.start + line.len()
    }

    pub(crate) fn range(&self, text: &str, range: std::ops::Range<usize>) -> Range {
        Range { start: self.position(text, range.start), end: self.position(text, range.end) }
    }

    pub(crate) fn bytes(&self, text: &str, range: Range) -> std::ops::Range<usize> {
        let (start, end) = (self.offset(text, range.start), self.offset(text, range.end));
        start.min(end)..end
    }
}

/// The path that a URI names. That of a file is its path on this machine, that of anything else the URI itself, whose
/// slashes are those of a path, too.
#[must_use]
pub fn path_of(uri: &str) -> String {
    let Some(rest) = uri.strip_prefix("file://") else { return uri.to_owned() };
    let path = normal_path(&percent_decoded(rest));
    // `/c:/robot` is `c:/robot`.
    let is_drive =
        |bytes: &[u8]| matches!(bytes, [b'/', drive, b':', ..] if drive.is_ascii_alphabetic());
    if is_drive(path.as_bytes()) { path.get(1..).unwrap_or_default().to_owned() } else { path }
}

/// The URI of a path, as [`path_of`] understands it.
#[must_use]
pub fn uri_of(path: &str) -> String {
    let has_scheme = path.split_once(':').is_some_and(|(scheme, rest)| {
        scheme.len() > 1
            && rest.starts_with('/')
            && scheme.chars().all(|one| one.is_ascii_alphanumeric() || "+-.".contains(one))
    });
    if has_scheme {
        return path.to_owned();
    }
    let path = path.replace('\\', "/");
    let slash = if path.starts_with('/') { "" } else { "/" };
    let mut uri = format!("file://{slash}");
    for byte in path.bytes() {
        if byte.is_ascii_alphanumeric() || b"/-_.~".contains(&byte) {
            uri.push(char::from(byte));
        } else {
            let _ = write!(uri, "%{byte:02X}");
        }
    }
    uri
}

fn percent_decoded(text: &str) -> String {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let code = after.get(..2).filter(|_| first == b'%');
        let code = code.and_then(|code| std::str::from_utf8(code).ok());
        match code.and_then(|code| u8::from_str_radix(code, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = after.get(2..).unwrap_or_default();
            }
            None => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_go_there_and_back() {
        let text = "aµ\u{1f600}b\r\nc\n\nd";
        for encoding in [Encoding::Utf8, Encoding::Utf16] {
            let lines = Lines::new(text, encoding);
            for (offset, character) in text.char_indices() {
                let at = lines.position(text, offset);
                // A line terminator has no column of its own.
                if !"\r\n".contains(character) {
                    assert_eq!(lines.offset(text, at), offset, "{encoding:?} {at:?}");
                }
            }
        }
        let lines = Lines::new(text, Encoding::Utf16);
        assert_eq!(lines.position(text, 7), Position { line: 0, character: 4 });
        assert_eq!(lines.offset(text, Position { line: 0, character: 99 }), 8);
        assert_eq!(lines.offset(text, Position { line: 99, character: 0 }), text.len());
    }

    #[test]
    fn paths_go_there_and_back() {
        for path in [
            "/home/me/my robot/größe.sense",
            "c:/robots/a%b.sense",
            "vscode-vfs://github/a/b.sense",
        ] {
            assert_eq!(path_of(&uri_of(path)), path);
        }
        assert_eq!(path_of("file:///c%3A/a.sense"), "c:/a.sense");
        assert_eq!(path_of("untitled:Untitled-1"), "untitled:Untitled-1");
        assert_eq!(path_of("file:///a%2"), "/a%2");
    }
}
