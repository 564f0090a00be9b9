//! E0563: this program was built without a sink.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0563",
    title: "this program cannot pass values on that way",
    explanation: r#"`monitor` passes values on in ways that are features of this program, so that nobody has to compile what he does not
use. This one was built without the one that is asked for.

Way out: install `sensedsl` with the feature:

    cargo install --path crates/sensedsl --features ros2

Features are listed with commas between them."#,
});

/// `name` is the table, `feature` the feature that has it.
pub fn not_built(span: Span, name: &str, feature: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("this sensedsl was built without `{name}`"))
        .here("not in this program")
        .help(format!(
            "install it with `cargo install --path crates/sensedsl --features {feature}`, or remove `{name}`"
        ))
}
