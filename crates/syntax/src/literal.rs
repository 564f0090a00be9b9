//! The meaning of a number or string token. Total: broken tokens yield `None` or the part that can
//! be understood; the lexer has already reported them.

/// The value of an integer token, or `None` if it does not fit or has no digits.
pub(crate) fn integer(text: &str) -> Option<u64> {
    let (digits, base) = split_base(text);
    let mut value: u64 = 0;
    let mut seen = false;
    for character in digits.chars().filter(|&character| character != '_') {
        let digit = character.to_digit(base)?;
        value = value.checked_mul(u64::from(base))?.checked_add(u64::from(digit))?;
        seen = true;
    }
    seen.then_some(value)
}

/// The value of a float token, or `None` if it is not finite or incomplete.
pub(crate) fn float(text: &str) -> Option<f64> {
    let plain: String = text.chars().filter(|&character| character != '_').collect();
    plain.parse().ok().filter(|value: &f64| value.is_finite())
}

/// The digits of an integer token and their base.
pub(crate) fn split_base(text: &str) -> (&str, u32) {
    if let Some(digits) = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        (digits, 16)
    } else if let Some(digits) = text.strip_prefix("0b").or_else(|| text.strip_prefix("0B")) {
        (digits, 2)
    } else {
        (text, 10)
    }
}

/// The content of a string token: without quotes, with escapes replaced, and unknown escapes
/// unchanged.
pub(crate) fn unescape(token: &str) -> String {
    let mut rest = token.strip_prefix('"').unwrap_or(token);
    let mut content = String::with_capacity(rest.len());
    while let Some(character) = rest.chars().next() {
        match character {
            '"' => break,
            '\\' => {
                let (escape, meaning) = escape(rest);
                match meaning {
                    Some(meaning) => content.push(meaning),
                    None => content.push_str(escape),
                }
                rest = rest.get(escape.len()..).unwrap_or_default();
            }
            _ => {
                content.push(character);
                rest = rest.get(character.len_utf8()..).unwrap_or_default();
            }
        }
    }
    content
}

/// The escape that `text` begins with, and the character it stands for, if the escape exists.
///
/// `text` begins with `\`. The escape never extends over a quote that it does not itself name, or
/// over the end of the line, so that a broken escape does not swallow the end of its string.
pub(crate) fn escape(text: &str) -> (&str, Option<char>) {
    let after = text.get(1..).unwrap_or_default();
    let Some(name) = after.chars().next().filter(|character| !matches!(character, '\n' | '\r'))
    else {
        return (text.get(..1).unwrap_or_default(), None);
    };
    let short = text.get(..1 + name.len_utf8()).unwrap_or_default();
    match name {
        '\\' | '"' => (short, Some(name)),
        'n' => (short, Some('\n')),
        'r' => (short, Some('\r')),
        't' => (short, Some('\t')),
        'u' => unicode_escape(text).unwrap_or((short, None)),
        _ => (short, None),
    }
}

/// `\u{HEX}` with one to six digits.
fn unicode_escape(text: &str) -> Option<(&str, Option<char>)> {
    let digits = text.strip_prefix("\\u{")?;
    let length = digits.bytes().take_while(u8::is_ascii_hexdigit).count();
    digits.get(length..)?.strip_prefix('}')?;
    let code = digits.get(..length).filter(|digits| digits.len() <= 6);
    let meaning = code.and_then(|code| u32::from_str_radix(code, 16).ok()).and_then(char::from_u32);
    Some((text.get(.."\\u{}".len() + length)?, meaning))
}
