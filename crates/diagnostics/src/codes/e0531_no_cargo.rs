//! E0531: there is no cargo.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0531",
    severity: Severity::Error,
    title: "there is no cargo",
    explanation: r#"`check --typecheck` lets the Rust compiler judge the wiring, and cargo builds firmware for Embassy. The check runs on
your computer and needs nothing for the board's core.

Way out: install Rust from https://rustup.rs, open a new terminal, and try again.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `cargo` does not run, and `what` needs it.
#[must_use]
pub fn no_cargo(span: Span, cargo: &str, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{cargo}` does not run, and {what} needs it"))
        .help("install Rust from https://rustup.rs and open a new terminal")
}
