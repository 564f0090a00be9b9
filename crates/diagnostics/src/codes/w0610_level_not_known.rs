//! W0610: it is not known whether a pin tolerates a voltage.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0610",
    title: "it is not known whether a pin tolerates a voltage",
    explanation: r#"The device puts more than the MCU's supply on its wire, and the tool does not know what the pin tolerates.

Way out: look the pin up in the MCU's data sheet (FT: it tolerates 5 V; TT, TTa, TC: it does not). Then write what you found
into the column `Voltage` of the board's table, put a `divider` in between, or say that you know: `allow W0610 "reason";`."#,
});

/// `level` is the level of the device at the pin.
pub fn level_not_known(span: Span, device: &str, level: &str, pin: &str) -> Diagnostic {
    let text = format!("{device} puts {level} on {pin}, and the tool does not know whether that pin tolerates it");
    Diagnostic::new(CODE, span, text)
        .help("look it up in the MCU's data sheet (FT tolerates 5 V), or put a `divider` in between")
}
