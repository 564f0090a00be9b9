//! E0228: constants that depend on each other.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0228",
    title: "constants are defined in a circle",
    explanation: r#"The value of a constant needs another constant, and that one needs, maybe by way of others, the first again.

Way out: give one of them a value that needs none of the others."#,
});

/// `circle` is the circle in the form `A -> B -> A`.
pub fn constants_in_a_circle(span: Span, circle: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("constants are defined in a circle: {circle}"))
        .help("give one of them a value that needs none of the others")
}
