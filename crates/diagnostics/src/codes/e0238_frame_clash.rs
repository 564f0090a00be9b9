//! E0238: an identifier of a CAN bus is used in two ways.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0238",
    title: "an identifier of a CAN bus is used in two ways",
    explanation: r#"On a CAN bus an identifier has one sender: two that begin to send it at the same time destroy each other's frames, and
the bus ends in an error state. So a board does not send a frame that it also listens to.

Way out: check the identifiers in the part's document. A command and its answer have different ones."#,
});

/// A frame that the board both sends and receives.
pub fn frame_clash(span: Span, name: &str, frame: &str, other: &str, other_span: Span) -> Diagnostic {
    let message = format!("{name} is sent in frame {frame}, in which {other} is received");
    Diagnostic::new(CODE, span, message)
        .here("sent here")
        .label(other_span, "received here")
        .help("an identifier has one sender: take the identifier that the part's document gives for this command")
}
