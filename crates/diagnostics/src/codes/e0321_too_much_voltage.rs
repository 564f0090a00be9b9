//! E0321: a device puts more voltage on a pin than it tolerates.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0321",
    title: "too much voltage for the pins",
    explanation: r#"The device puts a voltage (`level`, its own or its driver's) on its wire that none of the pins it could have tolerates. An
analog input measures only up to the MCU's supply; a digital input tolerates what its data sheet says (on STM32: FT pins 5 V).

Way out: two resistors, which the file must then state (`divider = [5.6 kOhm, 10 kOhm];`: from the device to the pin, and from
there to ground); a level shifter, where wires are driven from both ends; or other pins."#,
});

/// `span` is the place of the device, `stated` that of its level; `most` is what the pins tolerate, `help` says what to
/// do.
pub fn too_much_voltage(
    (span, device): (Span, &str),
    (stated, level): (Span, &str),
    most: &str,
    help: &str,
) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{device} puts {level} on its wire, but its pins tolerate {most}"))
        .label(stated, "stated here")
        .help(help)
}
