//! E0313: no such target.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0313",
    title: "no such target",
    explanation: r#"A target is what the firmware runs on: `chibios` or `embassy` (the newest that is known), one of them with its
version such as `chibios-21.11`, or `none`, the paper's pure pin model.

Way out: use one of these."#,
});

/// `known` lists the targets; `meant` is the nearest.
pub fn unknown_target(span: Span, name: &str, known: &str, meant: Option<&str>) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there is no target `{name}`"))
        .help(format!("use one of {known}"))
        .meant(meant)
}
