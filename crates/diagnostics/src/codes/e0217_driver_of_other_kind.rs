//! E0217: the driver is for another kind.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0217",
    title: "the driver is for another kind",
    explanation: r#"A driver is written for one kind of connection; an i2c protocol cannot drive a uart.

Way out: change the device's `type`, or take another driver."#,
});

/// `its` is the kind of the driver, `kind` that of the device, which is stated at `stated`.
pub fn driver_of_other_kind(
    span: Span,
    driver: &str,
    its: &str,
    kind: &str,
    stated: Option<Span>,
) -> Diagnostic {
    let message = format!("`{driver}` is {its}, and the device is {kind}");
    let diagnostic = Diagnostic::new(CODE, span, message)
        .help(format!("leave `type` out, which the driver says, or take a driver for {kind}"));
    match stated {
        Some(stated) => diagnostic.remove("leave `type` out", stated),
        None => diagnostic,
    }
}
