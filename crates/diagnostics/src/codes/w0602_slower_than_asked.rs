//! W0602: the device is slower than asked for.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0602",
    title: "the device is slower than asked for",
    explanation: r#"The device needs longer for a measurement than the cycle time allows. It is asked at the given pace, but
a new value comes only when the measurement is done; the last value is not sent twice.

Way out: give a `delay` of at least the time the message names, or set the device to a shorter range."#,
});

/// `needs_ms` is what the device needs, `delay_ms` what was asked for; `name` is the place of the device's name, `delay`
/// that of its cycle time, if it is stated.
pub fn slower_than_asked(
    span: Span,
    (device, name, delay): (&str, Span, Option<Span>),
    needs_ms: &str,
    delay_ms: &str,
    source: Option<Span>,
) -> Diagnostic {
    Diagnostic::new(
        CODE,
        span,
        format!("{device} needs {needs_ms} ms for a measurement and is asked every {delay_ms} ms"),
    )
    .here("asked here")
    .help(format!("write `delay = {needs_ms} ms;` or more: there are no new values sooner"))
    .label(source, format!("waits {needs_ms} ms"))
    .longer_delay(name, delay, needs_ms)
}
