//! E0225: a design has too many parts.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0225",
    title: "a design has too many parts",
    explanation: r#"Identifiers go from 1 to 254, so a design has at most 254 devices. What is far beyond is not read: boards,
drivers and devices, all together, and their properties and rules. `docs/limits.md` has the limits.

Way out: remove what does not belong to the design, or split it into designs with links of their own."#,
});

/// `what` is what there is too much of, `most` the greatest number allowed.
pub fn too_many_items(span: Span, what: &str, most: usize) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the design has more than {most} {what}"))
        .here("not read from here on")
        .help("remove some: identifiers go from 1 to 254, so a design has at most 254 devices")
}
