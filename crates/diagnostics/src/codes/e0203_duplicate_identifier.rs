//! E0203: two devices have the same identifier.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0203",
    title: "two devices have the same identifier",
    explanation: r#"The `id` is the one byte by which the host tells the values apart, so it is unique in the whole
file, whichever board a device is on.

Way out: give one of the devices another number from 1 to 254."#,
});

/// `free` is the least identifier that is not in use; `is_written` is false for an identifier that is counted, whose place
/// is that of a name.
pub fn duplicate_identifier(
    (span, is_written): (Span, bool),
    id: u8,
    first: Span,
    free: Option<u8>,
) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("identifier {id} is taken"))
        .here("taken again here")
        .label(first, format!("{id} is used here"));
    let Some(free) = free else {
        return diagnostic.help("all 254 identifiers are taken: use a second board with a file of its own");
    };
    let diagnostic = diagnostic.help(format!("take another one, {free} is free"));
    if is_written {
        diagnostic.replace(format!("change to {free}"), span, free.to_string())
    } else {
        diagnostic
    }
}
