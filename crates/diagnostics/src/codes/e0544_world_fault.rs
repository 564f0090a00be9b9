//! E0544: a fault is on a wire that does not exist.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0544",
    title: "a fault on a wire that is not there",
    explanation: r#"A fault is of a kind that the device's wires can have:

    no_answer     i2c                        the chip does not acknowledge
    stuck_sda     i2c                        something holds SDA low
    hang          i2c                        something holds SCL low
    torn          every sensor               the cable is torn: no signal, no answer
    silent        uart, can, icu, encoder    nothing comes any more
    reset         the board                  the supply breaks down, and the board starts again
    garbage       the link                   bytes arrive that nobody sent

Way out: choose a kind that the device can have, or another device."#,
});

/// The device has no such wire.
pub fn no_such_wire(span: Span, fault: &str, device: &str, kind: &str, needs: &str) -> Diagnostic {
    let what = format!("`{device}` is on {kind}, so it cannot have the fault `{fault}`");
    Diagnostic::new(CODE, span, what).help(format!("`{fault}` is for {needs}"))
}

/// The fault is one of the board or its link, not of a device.
pub fn no_device(span: Span, fault: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the fault `{fault}` is of the board, not of a device"))
        .help("take the line `device` out")
}

/// The fault needs a link, and the board does not have one.
pub fn no_link(span: Span, fault: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the board has no link, so it cannot have the fault `{fault}`"))
        .help("take the fault out, or give the board a link: `link { transport = usb; }`")
}
