//! E0235: an expected voltage that an analog input cannot measure.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0235",
    title: "a voltage over the supply on an analog input",
    explanation: r#"An analog input measures from 0 V to the supply of the MCU (3.3 V, or 5 V on Arduino boards). `max` says
that the device goes higher, and nothing in the file divides it: the value would stay at its end,
and the pin might be destroyed.

Way out: two resistors, which the file must then state: `level = 12.6 V; divider = [33 kOhm, 10 kOhm];` (from the
device to the pin, and from there to ground). The shown value is multiplied by what they divide."#,
});

/// `max` is the expected voltage, `supply` the greatest that the input measures, `help` names resistors that help.
pub fn analog_over_supply(span: Span, device: &str, max: &str, supply: &str, help: &str) -> Diagnostic {
    let message = format!("{device} goes up to {max}, but its input measures {supply} at most");
    Diagnostic::new(CODE, span, message).here("over the supply, and not divided").help(help)
}
