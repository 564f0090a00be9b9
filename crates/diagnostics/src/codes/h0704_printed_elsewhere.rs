//! H0704: the name of a pin is printed beside another.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "H0704",
    severity: Severity::Hint,
    title: "the name of a pin is printed beside another",
    explanation: r#"The MCU has a pin of that name, and the board has the same name printed beside another pin. The MCU's name counts.

Way out: if the other pin is meant, write its name in the MCU.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `other` is the pin beside which the name is printed.
#[must_use]
pub fn printed_elsewhere(span: Span, pin: &str, board: &str, other: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{pin} is taken for the MCU's pin; {board} has {pin} printed beside {other}"))
        .help(format!("write {other} if that pin is meant"))
}
