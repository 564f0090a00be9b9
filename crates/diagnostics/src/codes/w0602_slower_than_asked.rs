//! W0602: the device is slower than asked for.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "W0602",
    severity: Severity::Warning,
    title: "the device is slower than asked for",
    explanation: r#"The device needs longer for a measurement than the cycle time allows. It is asked at the given pace, but
a new value comes only when the measurement is done; the last value is not sent twice.

Way out: give a `delay` of at least the time the message names, or set the device to a shorter range.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `needs_ms` is what the device needs, `delay_ms` what was asked for.
#[must_use]
pub fn slower_than_asked(
    span: Span,
    device: &str,
    needs_ms: &str,
    delay_ms: &str,
    source: Option<Span>,
) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        CODE,
        span,
        format!("{device} needs {needs_ms} ms for a measurement and is asked every {delay_ms} ms"),
    )
    .here("asked here")
    .help(format!("write `delay = {needs_ms};` or more: there are no new values sooner"));
    match source {
        Some(source) => diagnostic.label(source, format!("waits {needs_ms} ms")),
        None => diagnostic,
    }
}
