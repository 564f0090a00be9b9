//! Bytes in, text out, with the parts of it that are guesses.
//!
//! UTF-8 is read as it is, and UTF-16 is recognised by its byte order mark or its zero bytes.
//! Anything else is taken for Windows-1252, the superset of Latin-1 that spreadsheets write. This
//! is done byte by byte, so that a wrong byte in a UTF-8 file costs only one character.

use std::ops::Range;

/// Most places with a wrong encoding that are kept, to be reported one by one.
const GUESSES_MAX: usize = 100;

/// A text, with the places that are guesses.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Decoded {
    pub(crate) text: String,
    pub(crate) guesses: Vec<Guess>,
    /// The number of guesses that are not kept.
    pub(crate) more: usize,
    /// The encoding of the whole text, if it is not UTF-8.
    pub(crate) wide: Option<&'static str>,
}

/// Bytes that are not UTF-8.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Guess {
    /// The place in the text of the characters that they were read as.
    pub(crate) range: Range<usize>,
    /// The offset of the first byte in the file.
    pub(crate) offset: usize,
    /// The bytes.
    pub(crate) bytes: Vec<u8>,
}

/// Decodes a text; none if the bytes are not text.
pub(crate) fn decode(bytes: &[u8]) -> Option<Decoded> {
    if let Some(decoded) = utf16(bytes) {
        return Some(decoded);
    }
    let control = |byte: &u8| *byte < 0x20 && !matches!(byte, b'\t' | b'\n' | b'\r' | 0x0c | 0x1a);
    if bytes.iter().any(control) {
        return None;
    }
    if let Ok(text) = std::str::from_utf8(bytes) {
        return Some(Decoded { text: text.to_owned(), ..Decoded::default() });
    }
    let mut decoded = Decoded::default();
    let mut offset = 0;
    for chunk in bytes.utf8_chunks() {
        decoded.text.push_str(chunk.valid());
        offset += chunk.valid().len();
        let invalid = chunk.invalid();
        if !invalid.is_empty() {
            let start = decoded.text.len();
            decoded.text.extend(invalid.iter().map(|byte| windows_1252(*byte)));
            let range = start..decoded.text.len();
            decoded.guess(Guess { range, offset, bytes: invalid.to_vec() });
            offset += invalid.len();
        }
    }
    Some(decoded)
}

impl Decoded {
    /// Adds a guess, or extends the previous one if they touch.
    fn guess(&mut self, guess: Guess) {
        let listed = self.guesses.len();
        match self.guesses.last_mut() {
            Some(last) if last.range.end == guess.range.start => {
                last.range.end = guess.range.end;
                last.bytes.extend(guess.bytes);
            }
            Some(_) | None if listed < GUESSES_MAX => self.guesses.push(guess),
            Some(_) | None => self.more += 1,
        }
    }
}

fn utf16(bytes: &[u8]) -> Option<Decoded> {
    let (wide, skip) = match bytes {
        [0xff, 0xfe, ..] => ("UTF-16LE", 2),
        [0xfe, 0xff, ..] => ("UTF-16BE", 2),
        // Without a mark, the first letters of a table are ASCII.
        [1..=255, 0, 1..=255, 0, ..] => ("UTF-16LE", 0),
        [0, 1..=255, 0, 1..=255, ..] => ("UTF-16BE", 0),
        _ => return None,
    };
    let unit = |pair: &[u8]| match *pair {
        [low, high] if wide == "UTF-16LE" => u16::from_le_bytes([low, high]),
        [high, low] => u16::from_be_bytes([high, low]),
        // Half a character, at the end.
        _ => 0xfffd,
    };
    let units = bytes.get(skip..)?.chunks(2).map(unit);
    let mut decoded = Decoded { wide: Some(wide), ..Decoded::default() };
    let mut offset = skip;
    for character in char::decode_utf16(units) {
        let start = decoded.text.len();
        let read = character.as_ref().copied().unwrap_or(char::REPLACEMENT_CHARACTER);
        if read.is_control() && !matches!(read, '\t' | '\n' | '\r') {
            return None;
        }
        decoded.text.push(read);
        if read == char::REPLACEMENT_CHARACTER {
            let of = bytes.get(offset..bytes.len().min(offset + 2)).unwrap_or_default().to_vec();
            let range = start..decoded.text.len();
            decoded.guess(Guess { range, offset, bytes: of });
        }
        offset += 2 * read.len_utf16();
    }
    Some(decoded)
}

/// The character of a byte in code page 1252; a byte without one is lost.
fn windows_1252(byte: u8) -> char {
    const FROM_0X80: [char; 32] = [
        '€', '\u{fffd}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{fffd}', 'Ž',
        '\u{fffd}', '\u{fffd}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ',
        '\u{fffd}', 'ž', 'Ÿ',
    ];
    let special = byte.checked_sub(0x80).and_then(|at| FROM_0X80.get(usize::from(at)));
    special.copied().unwrap_or(char::from(byte))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf8_is_no_guess() {
        let text = "Pin,Größe\n";
        let expected = Decoded { text: text.into(), ..Decoded::default() };
        assert_eq!(decode(text.as_bytes()), Some(expected));
    }

    #[test]
    fn latin_1_is_guessed_at_its_place() {
        let decoded = decode(b"I\xb2C1,\xc3\xa4,\x80").unwrap();
        assert_eq!(decoded.text, "I²C1,ä,€");
        let places: Vec<_> = decoded.guesses.iter().map(|guess| guess.offset).collect();
        assert_eq!(places, [1, 8]);
        assert_eq!(&decoded.text[decoded.guesses[0].range.clone()], "²");
    }

    #[test]
    fn utf_16_comes_both_ways() {
        let text = "Pin;µ\n😀";
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        for (mark, bytes) in
            [(&b"\xff\xfe"[..], &little), (b"", &little), (b"\xfe\xff", &big), (b"", &big)]
        {
            let decoded = decode(&[mark, bytes].concat()).unwrap();
            assert_eq!(decoded.text, text);
            assert!(decoded.wide.is_some() && decoded.guesses.is_empty());
        }
    }

    #[test]
    fn half_a_character_is_found() {
        let decoded = decode(b"\xff\xfeP\0i\0\x00\xd8n\0").unwrap();
        assert_eq!((decoded.text.as_str(), decoded.guesses.len()), ("Pi\u{fffd}n", 1));
    }

    #[test]
    fn what_is_no_text_is_none() {
        assert_eq!(decode(b"\x7fELF\x02\x01\x00"), None);
    }
}
