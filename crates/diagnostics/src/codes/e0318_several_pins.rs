//! E0318: a name stands for several pins.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0318",
    title: "a name stands for several pins",
    explanation: r#"A pin may be named as the MCU names it (`PA5`), as the board is printed (`D13`, `"CN7.3"`) or by the part that is on
it (`LED`). The board has several pins of that name.

Way out: write the name of one of them."#,
});

/// `pins` are the pins, in order.
pub fn several_pins(span: Span, name: &str, board: &str, pins: &[&str]) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{board} has several pins called {name}"))
        .help(format!("write one of {}", pins.join(", ")))
        .one_of(pins.iter().copied())
}
