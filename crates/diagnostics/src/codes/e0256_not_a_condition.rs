//! E0256: a quantity where something true or false is needed, or the other way round.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0256",
    title: "this is not a condition",
    explanation: r#"After `always`, `never`, `eventually`, `when` and `then`, and on both sides of `and` and `or`, stands what is true or
false at each moment: a comparison such as `Front < 20 cm`, a range such as `Left in 0 % .. 100 %`, `rising(…)` and
`falling(…)` of a condition, or a device that is itself true or false. Comparisons and `+ - * /` take numbers.

Way out: compare the value with something."#,
});

/// A number where a condition must stand.
pub fn quantity(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "this is a number, not true or false")
        .help("compare it with something: `Front < 20 cm`")
}

/// A condition where a number must stand.
pub fn condition(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "this is true or false, not a number")
        .help("compare numbers; join conditions with `and`, `or` and `not`")
}
