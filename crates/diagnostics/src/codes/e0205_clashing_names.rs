//! E0205: two names become one in generated code.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0205",
    title: "two names become one in generated code",
    explanation: r#"Generated code spells names in the manner of its language: `IRFront` becomes `IR_FRONT` for a C
constant and `ir_front` for a Python variable. Two names that differ only in case or in underscores
become the same there.

Way out: rename one of them so that they differ in letters or digits."#,
});

/// `form` is the spelling in which both are equal, `free` a name that is not in use.
pub fn clashing_names(
    span: Span,
    (name, other): (&str, &str),
    form: &str,
    first: Span,
    free: Option<&str>,
) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` and `{other}` both become `{form}` in generated code"))
        .here("clashes")
        .label(first, format!("with `{other}`"))
        .help("rename one so that they differ in more than case and underscores")
        .one_of(free)
}
