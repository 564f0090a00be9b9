//! E0231: no identifier is left for a device without one.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0231",
    title: "no identifier is left",
    explanation: r#"A device without `id` gets the number behind the greatest that stands in the file. Identifiers go up to 254, so a
large `id` leaves few behind it, and a chip's values count up from the chip's own.

Way out: give devices smaller identifiers; `sensedsl fmt --ids` writes all of them into the file."#,
});

/// `last` is the greatest possible identifier.
pub fn no_identifier_left(span: Span, device: &str, last: u8) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{device}` has no `id`, and none is left behind {last}"))
        .here("identifiers go up to 254")
        .help("write an `id` that is free here, or a smaller one in the device that has the greatest")
}
