//! E0209: a value of another sort is needed.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0209",
    title: "a value of another sort is needed",
    explanation: r#"A property takes one sort of value: a whole number, a time, a frequency, a name, a text between
quotes, or a list of bytes.

A text between quotes stands for the bytes of its letters: `"0x59"` is four of them. `31..18` and `3.0 V..3.6 V` are
ranges; with a minus they would be computed. A unit with `/` or `^` in it is a text: `quantity = "ug/m3";`.

Way out: write a value of the sort that the message names."#,
});

/// `takes` is what the property accepts, with an example; `found` is what is there.
pub fn wrong_value(span: Span, name: &str, takes: &str, found: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` takes {takes}, not {found}"))
        .here(format!("this is {found}"))
        .help(format!("write {takes}"))
}

/// A number between quotes.
pub fn quoted_number(span: Span, name: &str, takes: &str, number: &str) -> Diagnostic {
    wrong_value(span, name, takes, "a text")
        .help(format!("write it without quotes: `{number}`"))
        .replace("remove the quotes", span, number)
}

/// A text that spells bytes out; `list` has them.
pub fn spelled_bytes(span: Span, name: &str, letters: usize, list: &str) -> Diagnostic {
    let message = format!("`{name}` would be the {letters} letters of this text, not the bytes that they spell");
    Diagnostic::new(CODE, span, message)
        .here("a text stands for the bytes of its letters")
        .help(format!("write `{list}`, without quotes"))
        .replace(format!("change to `{list}`"), span, list)
}

/// A unit that would be computed; `unit` is it between quotes.
pub fn unquoted_unit(span: Span, text: &str, unit: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`quantity` takes a text, and `{text}` would be computed"))
        .here("put it between quotes")
        .help(format!("write `quantity = {unit};`"))
        .replace(format!("change to `{unit}`"), span, unit)
}

/// A range that would be computed.
pub fn range_with_minus(span: Span, name: &str, range: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` takes a range, and this is a difference"))
        .here("a range has two dots")
        .help(format!("write `{range}`"))
        .replace(format!("change to `{range}`"), span, range)
}

/// A unit of measure where a peripheral belongs; `whole` is the property.
pub fn measure_as_unit(span: Span, whole: Span, word: &str, unit: &str) -> Diagnostic {
    let message = format!("`unit` takes a peripheral such as ADC1, and `{word}` is a unit of measure");
    Diagnostic::new(CODE, span, message)
        .here("this is a unit of measure")
        .help(format!("write `quantity = {unit};`"))
        .replace(format!("change to `quantity = {unit}`"), whole, format!("quantity = {unit}"))
}
