//! E0531: there is no cargo.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0531",
    title: "there is no cargo",
    explanation: r#"`check --typecheck` lets the Rust compiler judge the wiring, and cargo builds firmware for Embassy. The check runs on
your computer and needs nothing for the board's core.

Way out: install Rust from https://rustup.rs, open a new terminal, and try again."#,
});

/// `cargo` does not run, and `what` needs it.
pub fn no_cargo(span: Span, cargo: &str, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{cargo}` does not run, and {what} needs it"))
        .help("install Rust from https://rustup.rs and open a new terminal")
}
