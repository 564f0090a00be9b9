//! E0101: something else was expected here.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0101",
    title: "something else was expected here",
    explanation: r#"The text does not follow the grammar here. A file consists of `board`, `sensor`, `actuator`,
`chip`, `driver`, `const` and `use`. Braces hold properties, one `name = value;` per line:

    sensor IRFront returns uint16 {
        id = 17;
        type = analog;
    }

Way out: write what the message expects, or remove what is there."#,
});

/// `expected` and `found` are descriptions ("a property name", "`}`").
pub fn unexpected_token(span: Span, expected: &str, found: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("expected {expected}, found {found}"))
        .here(format!("expected {expected}"))
        .help(match found {
            found if found.starts_with('`') => format!("write {expected} here, or remove {found}"),
            _ => format!("write {expected} here"),
        })
}

/// `span` is the `(` of a list with commas.
pub fn parentheses_around_list(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "a list is written in brackets, not in parentheses")
        .here("expected `[`")
        .help("write a list as `[1, 2]`")
}

/// A pin is in the place of the type; `head` is the head with a type, and `kind` a type of device that fits the pin.
pub fn pin_in_head(span: Span, head: &str, kind: &str, pin: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, "a pin stands in the block, and a type behind the name")
        .here("expected a type")
        .help(format!("write for example `{head} {{ type = {kind}; pin = {pin}; }}`"))
}

/// `=` between the sides of a comparison.
pub fn single_equals(span: Span) -> Diagnostic {
    unexpected_token(span, "`==`, which compares", "`=`").replace("change to `==`", span, "==")
}

/// `==` after the name of a property.
pub fn doubled_equals(span: Span) -> Diagnostic {
    unexpected_token(span, "`=`, which gives a property its value", "`==`").replace("change to `=`", span, "=")
}
