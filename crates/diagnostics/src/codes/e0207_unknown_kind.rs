//! E0207: no such kind of device.

use super::{Code, CodeInfo, Diagnostic, Span};
use crate::diagnostic::Scope;

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0207",
    title: "no such kind of device",
    explanation: r#"`type` says what the device is connected to: analog, i2c, icu, encoder, digital, uart, spi, pwm, dac,
can or stepper.

Way out: use one of these."#,
});

/// The name of a library part in the place of a kind.
pub fn driver_as_kind(span: Span, name: &str, driver: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` is a part, not a kind of connection"))
        .here(format!("write `driver = {driver};` instead of this line"))
        .help(format!("`driver = {driver};` says how it is connected: `sensedsl drivers {driver}` shows it"))
        .change(format!("change to `driver = {driver};`"), span, format!("driver = {driver};"), Scope::Statement)
}

/// `known` lists all kinds; `meant` is the nearest.
pub fn unknown_kind(span: Span, name: &str, known: &str, meant: Option<&str>) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` is not a kind of device"))
        .help(format!("use one of {known}"))
        .meant(meant)
}
