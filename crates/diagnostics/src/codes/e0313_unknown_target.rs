//! E0313: no such target.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0313",
    severity: Severity::Error,
    title: "no such target",
    explanation: r#"A target is what the firmware runs on: `chibios` or `embassy` (the newest that is known), one of them with its
version such as `chibios-21.11`, or `none`, the paper's pure pin model.

Way out: use one of these.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `known` lists the targets.
#[must_use]
pub fn unknown_target(span: Span, name: &str, known: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there is no target `{name}`"))
        .help(format!("use one of {known}"))
}
