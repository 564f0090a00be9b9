//! Foreign text made safe to print: characters that move a cursor, colour a terminal, change the text direction or are
//! invisible are replaced by their codes (`\u{1b}`).
//!
//! Everything that is printed for people passes through here: names, cells, labels, paths, lines of a source.

use std::borrow::Cow;
use std::fmt::Write as _;

/// Whether a character does something other than appear in print: controls, direction marks, zero-width joiners and
/// spaces, Unicode line ends, noncharacters.
#[must_use]
pub const fn is_hidden(character: char) -> bool {
    matches!(character,
        '\0'..='\u{1f}' | '\u{7f}'..='\u{9f}'
        // Text direction.
        | '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
        // Zero width.
        | '\u{ad}' | '\u{34f}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}' | '\u{180e}'
        | '\u{200b}'..='\u{200d}' | '\u{2060}'..='\u{2065}' | '\u{206a}'..='\u{206f}'
        | '\u{3164}' | '\u{feff}' | '\u{ffa0}' | '\u{fff9}'..='\u{fffb}'
        // Line ends.
        | '\u{2028}' | '\u{2029}'
        // Tags, and what XML does not allow.
        | '\u{e0000}'..='\u{e0fff}' | '\u{fffe}' | '\u{ffff}'
    )
}

/// One line: hidden characters, including line ends, are shown as their codes.
#[must_use]
pub fn visible(text: &str) -> Cow<'_, str> {
    escaped(text, |_| false)
}

/// Several lines: line ends and tabs are kept.
#[must_use]
pub fn visible_lines(text: &str) -> Cow<'_, str> {
    escaped(text, |character| matches!(character, '\n' | '\t'))
}

/// JSON from a serialiser, which leaves direction marks and other terminal controls as they are: they become JSON
/// escapes, so that readers get the same text.
#[must_use]
pub fn visible_json(json: &str) -> Cow<'_, str> {
    let is_left = |character: char| character > '\u{1f}' && is_hidden(character);
    if !json.contains(is_left) {
        return Cow::Borrowed(json);
    }
    let mut out = String::with_capacity(json.len());
    for character in json.chars() {
        if is_left(character) {
            for unit in character.encode_utf16(&mut [0; 2]) {
                // Writing to a String cannot fail.
                let _ = write!(out, "\\u{unit:04x}");
            }
        } else {
            out.push(character);
        }
    }
    Cow::Owned(out)
}

/// The code that a hidden character is shown as: `\u{202e}`.
pub(crate) fn code(character: char) -> String {
    character.escape_unicode().to_string()
}

fn escaped(text: &str, stays: impl Fn(char) -> bool) -> Cow<'_, str> {
    let is_shown_as_code = |character: char| is_hidden(character) && !stays(character);
    if !text.contains(is_shown_as_code) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        if is_shown_as_code(character) {
            out.push_str(&code(character));
        } else {
            out.push(character);
        }
    }
    Cow::Owned(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_seen_is_shown_by_its_code() {
        assert!(matches!(visible("cm, °C, é, 試"), Cow::Borrowed(_)));
        assert_eq!(visible("a\u{1b}[31m\u{202e}\n"), "a\\u{1b}[31m\\u{202e}\\u{a}");
        assert_eq!(visible("\u{9b}2J\u{feff}\u{ffff}"), "\\u{9b}2J\\u{feff}\\u{ffff}");
        assert_eq!(visible_lines("a\n\tb\r\u{2029}"), "a\n\tb\\u{d}\\u{2029}");
    }

    #[test]
    fn json_says_the_same_in_escapes() {
        let text = "\u{202e}\u{9b}\u{e0041}é";
        let json = serde_json::to_string_pretty(&[text]).unwrap();
        let safe = visible_json(&json);
        assert!(!safe.chars().any(|c| is_hidden(c) && c != '\n'), "{safe}");
        assert_eq!(serde_json::from_str::<[String; 1]>(&safe).unwrap(), [text]);
    }
}
