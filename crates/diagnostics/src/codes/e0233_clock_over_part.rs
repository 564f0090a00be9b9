//! E0233: a bus clock above the part's maximum.

use crate::codes::{Code, CodeInfo};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

/// The registry entry.
pub const INFO: CodeInfo = CodeInfo {
    code: "E0233",
    severity: Severity::Error,
    title: "a clock over the greatest of the part",
    explanation: r#"The driver says which clock its part takes at most (`speed_max` of I2C, `clock_max` of SPI), as the data
sheet does. Faster transfers fail, or worse, work on the desk and fail in the robot.

Way out: write the clock that the message names, or a lower one, or leave the line out: the driver
has a clock that the part takes.
"#,
};

/// The code.
pub const CODE: Code = Code(&INFO);

/// `asked` is the requested clock, `most` the greatest that the driver's part allows.
#[must_use]
pub fn clock_over_part(span: Span, property: &str, asked: &str, driver: &str, most: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{asked} is too fast for `{driver}`, which takes {most} at most"))
        .here("over the greatest clock of the part")
        .help(format!("write `{property} = {most};`, or remove the line"))
}
