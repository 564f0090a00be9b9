//! E0228: constants that depend on each other.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0228",
    severity: Severity::Error,
    title: "constants are defined in a circle",
    explanation: r#"The value of a constant needs another constant, and that one needs, maybe by way of others, the first again.

Way out: give one of them a value that needs none of the others.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `circle` is the circle in the form `A -> B -> A`.
#[must_use]
pub fn constants_in_a_circle(span: Span, circle: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("constants are defined in a circle: {circle}"))
        .help("give one of them a value that needs none of the others")
}
