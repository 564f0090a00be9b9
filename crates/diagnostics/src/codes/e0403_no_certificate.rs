//! E0403: an answer without a certificate.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0403",
    severity: Severity::Error,
    title: "no certificate was found",
    explanation: r#"`solve --proof` looks for a proof that a separate checker can follow, independently of the search that
found the wiring. For some large requests, with several boards above all, there is none within the effort
that is allowed for it. This says nothing against the wiring; no file was written.

Way out: solve without `--proof`, allow more time where `--timeout` is given, or bind devices to boards.
"#,
};

const CODE: Code = Code(&INFO);

/// Why there is none.
#[must_use]
pub fn no_certificate(span: Span, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("no certificate: {why}"))
        .help("`solve` without `--proof` gives the wiring, proved by its own search")
}
