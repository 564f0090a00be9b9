//! E0211: a value is out of range.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0211",
    title: "a value is out of range",
    explanation: r#"The value is of the right sort but outside what the hardware, the wire or the operating system can
hold.

Way out: take a value inside the range that the message names."#,
});

/// A time without a unit, which is read as milliseconds; `written` is the time as written.
pub fn bare_time(span: Span, name: &str, written: &str, range: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` cannot be {written} ms"))
        .here("a time without a unit is in milliseconds")
        .help(format!("write `{name} = {written} us;` if microseconds are meant; it must be {range}"))
        .replace(format!("change to `{written} us`"), span, format!("{written} us"))
}

/// A list whose number of entries differs from the number of elements of the array.
pub fn wrong_count(span: Span, name: &str, entries: usize, elements: usize) -> Diagnostic {
    let message = format!("`{name}` has {entries} entries, and the array has {elements} elements");
    Diagnostic::new(CODE, span, message)
        .here(format!("needs {elements}, one for each element"))
        .help("add or remove entries, or change the length of the array")
}

/// `value` is the value as written, `range` the range as text ("1 to 254").
pub fn out_of_range(span: Span, name: &str, value: &str, range: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` cannot be {value}"))
        .here(format!("must be {range}"))
        .help(format!("take a value from the range: {range}"))
}
