//! E0241: a part is asked before it may be asked again.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0241",
    title: "a part is asked too often",
    explanation: r#"A part such as a DHT22 must be left alone for some time after each reading: asked sooner, it does not answer, or
gives its last value again. The `wait` of its driver is that time, and `delay` must not be shorter.

Way out: give the device, or its chip, the `delay` that the message names, or leave it out."#,
});

/// `needs_ms` is the time that the part needs, `delay_ms` what was asked for; `name` is the place of the device's name,
/// `delay` that of its cycle time, if it is stated.
pub fn asked_too_often(
    span: Span,
    (device, name, delay): (&str, Span, Option<Span>),
    needs_ms: &str,
    delay_ms: &str,
    source: Option<Span>,
) -> Diagnostic {
    Diagnostic::new(
        CODE,
        span,
        format!("{device} can be read every {needs_ms} ms, and is to be read every {delay_ms} ms"),
    )
    .here("read too often")
    .help(format!("write `delay = {needs_ms} ms;` or more, or leave it out"))
    .label(source, format!("left alone for {needs_ms} ms"))
    .longer_delay(name, delay, needs_ms)
}
