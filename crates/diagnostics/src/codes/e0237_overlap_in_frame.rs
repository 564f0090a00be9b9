//! E0237: two commands take the same bits of a frame.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0237",
    title: "two commands take the same bits of a frame",
    explanation: r#"A frame is sent as a whole: all commands of one identifier stand in it. Where two of them take the same bits the later
one would overwrite the earlier one. Sensors may read the same bits: nothing is lost by that.

Way out: two parts of one type need a `node` each, the number that is set in the part. Otherwise give each command bits
of its own (`byte`, or `bit` and `bits`), another frame, or another value of the selector with `mux`."#,
});

/// `name` and `other` are the commands, `frame` is the frame in words.
pub fn overlap_in_frame(span: Span, name: &str, other: &str, other_span: Span, frame: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{name} and {other} take the same bits of frame {frame}"))
        .here("here")
        .label(other_span, "and here")
        .help("give two parts a `node` each, or give each command bits of its own (`byte`, or `bit` and `bits`) or another frame")
}
