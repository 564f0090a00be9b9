//! E0219: files use each other in a circle.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0219",
    title: "files use each other in a circle",
    explanation: r#"A file may use another one only if that does not, directly or by others, use the first.

Way out: move what both need into a third file."#,
});

/// `circle` lists the files of the circle, in order.
pub fn use_cycle(span: Span, circle: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("these files use each other in a circle: {circle}"))
        .help("move what both need into a third file")
}
