//! H0703: a protocol was taken from the address.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "H0703",
    title: "a protocol was taken from the address",
    explanation: r#"An i2c device without `driver` and without a protocol of its own, at an address from 0xE0 to 0xFE, is
taken to be a Devantech SRF08 ultrasonic ranger, as in the paper's example.

Way out: nothing to do if it is one; write `driver = srf08;` to say so, or give the device's own `register`,
`length` and `trigger`."#,
});

/// `device` is the device's name.
pub fn default_protocol(span: Span, device: &str, driver: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{device} has no protocol; its address says that it is a `{driver}`"))
        .help(format!("write `driver = {driver};` to say so, or give `register` and `length`"))
        .add(span, &format!("driver = {driver};"))
}
