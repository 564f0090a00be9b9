//! W0603: the value type is narrower than the measurement.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0603",
    title: "the value type is narrower than the measurement",
    explanation: r#"The measurement can be larger than the type can hold. Generated code then reports the largest value of
the type, never a wrapped one.

Way out: use the type that the message names, or scale the value down."#,
});

/// `found` is what is measured, `range` its range, `wider` says which type holds it; `holds` is that type as a
/// file has to spell it.
pub fn narrow_type(
    span: Span,
    (found, range): (&str, &str),
    wider: &str,
    holds: Option<&str>,
) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{found} cannot hold every measurement ({range})"))
        .here("larger values are reported as the largest of the type")
        .help(format!("use {wider}"))
        .one_of(holds)
}
