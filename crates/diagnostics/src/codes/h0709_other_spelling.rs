//! H0709: a unit in another spelling than hosts have.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "H0709",
    title: "a unit is usually written otherwise",
    explanation: r#"A `quantity` is a text, and a host shows it as it is. But some words are understood: a value of `degC` becomes a
temperature in ROS 2 and Home Assistant, and `failsafe = 20 degC;` is converted. `°C` and `celsius` are only shown.

Way out: write the word that the message names."#,
});

/// `unit` is the usual word, between quotes where it needs them.
pub fn other_spelling(span: Span, word: &str, unit: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the usual word for `{word}` is `{}`", unit.trim_matches('"')))
        .here(format!("write `{unit}`"))
        .help(format!("write `quantity = {unit};`, so that hosts know what it is"))
        .replace(format!("change to `{unit}`"), span, unit)
}
