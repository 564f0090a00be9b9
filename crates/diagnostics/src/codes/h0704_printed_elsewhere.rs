//! H0704: the name of a pin is printed beside another.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "H0704",
    title: "the name of a pin is printed beside another",
    explanation: r#"The MCU has a pin of that name, and the board has the same name printed beside another pin. The MCU's name counts.

Way out: if the other pin is meant, write its name in the MCU."#,
});

/// `other` is the pin beside which the name is printed.
pub fn printed_elsewhere(span: Span, pin: &str, board: &str, other: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{pin} is taken for the MCU's pin; {board} has {pin} printed beside {other}"))
        .help(format!("write {other} if that pin is meant"))
}
