//! W0605: the wiring uses a shared pin.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0605",
    title: "the wiring uses a shared pin",
    explanation: r#"Something else is on the pin: a LED, a button or another part of the board, or, on a bare MCU, the crystal of its
oscillator. The pin may be used all the same, but either may disturb the other. Such pins are used only where no
others will do, or where the file asks for them.

Way out: look at the board's schematic; `reserve` the pin if it must not be used, `release` it if the part is gone, or
say that you know: `allow W0605 "reason";`."#,
});

/// `part` is the on-board part that shares the pin with the device.
///
/// `board` is the place of the board's name; `is_fixed` is true if the file says that the device is on the pin.
pub fn onboard_part(
    (span, device): (Span, &str),
    pin: &str,
    part: &str,
    board: Span,
    is_fixed: bool,
) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("{device} shares {pin} with {part}"))
        .help(format!("write `reserve {pin};` if it must stay free, or `release {pin};` if {part} is not there"));
    let diagnostic =
        if is_fixed { diagnostic } else { diagnostic.add(board, &format!("reserve {pin};")) };
    diagnostic.add(board, &format!("release {pin};"))
}
