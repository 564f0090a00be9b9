//! W0601: a property has no effect.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0601",
    title: "a property has no effect",
    explanation: r#"The hardware triggers icu and encoder inputs itself: every edge is seen when it happens, so neither a
cycle time nor a priority is used for reading. Such a device is reported at the pace of its `delay`
only where the language reference says so. The `order` of the bytes says nothing of a value of one byte. Firmware in
Rust keeps no parameter over a reset, so `store = true` of a `code` device does nothing there.

Way out: remove the line, or say that you know: `allow W0601 "reason";`."#,
});

/// `why` is the reason why the property of the kind is not used.
pub fn unused_property(span: Span, name: &str, kind: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` has no effect for {kind}: {why}"))
        .help("remove the line, or `allow W0601 \"…\";` if it is meant as a note")
        .remove("remove the line", span)
}

/// A parameter is not kept over a reset by the system that the firmware is for.
pub fn not_stored(span: Span, name: &str, system: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`store` of `{name}` has no effect: {system} keeps no parameter over a reset"))
        .help("let the host set it again, take another target, or `allow W0601 \"…\";`")
}
