//! W0607: a part is not fully known.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0607",
    title: "a part is not known in full",
    explanation: r#"The board is a bare MCU part of which not all is known: its package, so that a pin may not be brought out;
the places of its pins; or which of several packages is meant, so that only pins that all of them have are
offered.

Way out: write the whole part number, or make a board table from `sensedsl parts --table NAME`."#,
});

/// `what` is what is not known.
pub fn part_not_certain(span: Span, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, what)
        .help("write the whole part number, or make a board table of the part")
}
