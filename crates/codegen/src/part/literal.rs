//! Literals of C.

/// `0x3bU`
pub(super) fn byte(byte: &u8) -> String {
    format!("0x{byte:02x}U")
}

/// Bytes of an array.
pub(super) fn bytes(bytes: &[u8]) -> Vec<String> {
    bytes.iter().map(byte).collect()
}

/// A whole number of a signed type; the least one is not spelled as it is written.
pub(super) fn signed(number: i64) -> String {
    if number == i64::MIN { "INT64_MIN".to_owned() } else { format!("INT64_C({number})") }
}

/// Characters of a text.
pub(super) fn text(text: &str) -> String {
    let plain = |byte: u8| {
        let is_plain = (byte.is_ascii_graphic() || byte == b' ') && !b"\"\\?".contains(&byte);
        if is_plain { char::from(byte).to_string() } else { format!("\\{byte:03o}") }
    };
    format!("\"{}\"", text.bytes().map(plain).collect::<String>())
}
