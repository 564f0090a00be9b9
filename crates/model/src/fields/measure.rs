//! Units of measure as people write them: a word in, the word that hosts and drivers have for it out; and what is said
//! where a property is given one in a way that means something else.

use sensedsl_diagnostics::codes::{e0209_wrong_value, h0709_other_spelling};
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_syntax::Unit;
use sensedsl_syntax::ast::{self, AstNode as _, Operator};

use crate::value::Value;

/// Words for units, in small letters, each with the word that the library and the hosts have.
const SPELLINGS: [(&str, &[&str]); 18] = [
    ("%", &["percent", "pct"]),
    ("A", &["amp", "amps", "ampere", "amperes"]),
    ("Ohm", &["ohms", "\u{3c9}"]),
    ("Pa", &["pascal"]),
    ("V", &["volt", "volts"]),
    ("W", &["watt", "watts"]),
    ("cm", &["centimeter", "centimeters", "centimetre", "centimetres"]),
    ("deg", &["°", "º", "degree", "degrees"]),
    ("deg/s", &["°/s", "deg/sec", "degrees/s", "dps"]),
    ("degC", &["c", "°c", "ºc", "℃", "celsius", "deg c", "deg_c", "degrees celsius"]),
    ("lx", &["lux"]),
    ("m", &["meter", "meters", "metre", "metres"]),
    ("m/s^2", &["m/s2", "m/s²", "m/s/s"]),
    ("mm", &["millimeter", "millimeters", "millimetre", "millimetres"]),
    ("s", &["sec", "second", "seconds"]),
    ("uT", &["\u{b5}t", "\u{3bc}t", "microtesla"]),
    ("ug/m3", &["ug/m³", "ug/m^3", "\u{b5}g/m3", "\u{3bc}g/m3", "\u{b5}g/m³", "\u{3bc}g/m³"]),
    ("us", &["\u{b5}s", "\u{3bc}s", "usec", "microseconds"]),
];

/// The usual word for a unit that is written otherwise.
fn usual(word: &str) -> Option<&'static str> {
    let small = word.trim().to_lowercase();
    let is_it = |(usual, others): &&(&'static str, &[&str])| {
        *usual != word && (others.contains(&small.as_str()) || usual.eq_ignore_ascii_case(word))
    };
    let found = SPELLINGS.iter().find(is_it).map(|(usual, _)| *usual);
    found.filter(|_| Unit::from_name(word).is_none())
}

/// Whether a word is a unit of measure.
fn is_measure(word: &str) -> bool {
    let known = |(usual, _): &(&str, &[&str])| *usual == word;
    Unit::from_name(word).is_some() || usual(word).is_some() || SPELLINGS.iter().any(known)
}

/// A unit as it stands after `quantity =`.
fn written(word: &str) -> String {
    let is_word = word.chars().all(|one| one.is_ascii_alphanumeric());
    if is_word { word.to_owned() } else { format!("\"{word}\"") }
}

/// Reports a unit of several words without quotes, or a range with a minus, which would be computed.
pub(super) fn computed(name: &str, node: &ast::Value) -> Option<Report> {
    let ast::Value::Binary(binary) = node else { return None };
    match (name, binary.operator()?) {
        ("quantity", _) => {
            let text: String = binary.syntax().text().to_string().split_whitespace().collect();
            let unit = format!("\"{}\"", usual(&text).unwrap_or(&text));
            Some(Report::Unquoted { text, unit })
        }
        ("bits" | "supply", Operator::Subtract) => {
            let (ast::Value::Number(first), ast::Value::Number(last)) =
                (binary.left()?, binary.right()?)
            else {
                return None;
            };
            let text = |node: &ast::Number| node.syntax().text().to_string().trim().to_owned();
            let unit = last.unit_token().filter(|_| first.unit_token().is_none());
            let unit = unit.map(|unit| format!(" {}", unit.text())).unwrap_or_default();
            let range = format!("{}{unit}..{}", text(&first), text(&last));
            Some(Report::Minus { range })
        }
        _ => None,
    }
}

/// What is computed and was not meant to be.
pub(super) enum Report {
    /// A unit with an operator in it.
    Unquoted { text: String, unit: String },
    /// A range with a minus.
    Minus { range: String },
}

/// What is said of a property whose value was not to be computed.
pub(super) fn not_computed(name: &str, at: Span, report: &Report) -> Diagnostic {
    match report {
        Report::Unquoted { text, unit } => e0209_wrong_value::unquoted_unit(at, text, unit),
        Report::Minus { range } => e0209_wrong_value::range_with_minus(at, name, range),
    }
}

/// What is said of a unit of measure in the wrong property, or in other words than hosts have.
pub(super) fn misplaced(
    (name, name_span): (&str, Span),
    (value, at): (&Value, Span),
) -> Option<Diagnostic> {
    let (Value::Name(word) | Value::Text(word)) = value else { return None };
    match name {
        "unit" if is_measure(word) => {
            let unit = written(usual(word).unwrap_or(word));
            let whole = name_span.cover(at);
            Some(e0209_wrong_value::measure_as_unit(at, whole, word, &unit))
        }
        "quantity" => {
            let unit = written(usual(word)?);
            Some(h0709_other_spelling::other_spelling(at, word, &unit))
        }
        _ => None,
    }
}

/// Whether a value is a text with the bytes that were meant in it: `"0x59"`, `"A5 5A"`.
pub(super) fn spelled_bytes(value: &Value) -> Option<Vec<u8>> {
    let Value::Text(text) = value else { return None };
    let words: Vec<&str> = text.split([' ', ',']).filter(|word| !word.is_empty()).collect();
    let is_marked = words.iter().any(|word| digits(word).is_some());
    let are_pairs = words.len() >= 2 && words.iter().all(|word| word.len() == 2);
    if !is_marked && !are_pairs {
        return None;
    }
    words.iter().map(|word| u8::from_str_radix(digits(word).unwrap_or(word), 16).ok()).collect()
}

/// The hexadecimal digits behind their mark.
fn digits(word: &str) -> Option<&str> {
    word.strip_prefix("0x").or_else(|| word.strip_prefix("0X"))
}

/// Bytes as a list of the language.
pub(super) fn listed(bytes: &[u8]) -> String {
    let all: Vec<String> = bytes.iter().map(|byte| format!("0x{byte:02X}")).collect();
    format!("[{}]", all.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_have_one_spelling() {
        for (word, meant) in [
            ("°C", Some("degC")),
            ("Celsius", Some("degC")),
            ("C", Some("degC")),
            ("degC", None),
            ("m/s²", Some("m/s^2")),
            ("µT", Some("uT")),
            ("μT", Some("uT")),
            ("Lux", Some("lx")),
            ("ohm", Some("Ohm")),
            ("mm", None),
            ("MM", Some("mm")),
            ("M", Some("m")),
            ("turns", None),
        ] {
            assert_eq!(usual(word), meant, "{word}");
        }
    }

    #[test]
    fn bytes_in_a_text_are_seen() {
        let of = |text: &str| spelled_bytes(&Value::Text(text.to_owned()));
        assert_eq!(of("0x59"), Some(vec![0x59]));
        assert_eq!(of("A5 5A"), Some(vec![0xA5, 0x5A]));
        assert_eq!(of("0xA5, 0x5"), Some(vec![0xA5, 5]));
        for text in ["$GP", "AB", "12", "OK A5", "at 5A", "0xZZ", ""] {
            assert_eq!(of(text), None, "{text}");
        }
        assert_eq!(listed(&[0xA5, 5]), "[0xA5, 0x05]");
    }
}
