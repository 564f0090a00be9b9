//! E0233: a bus clock above the part's maximum.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0233",
    title: "a clock over the greatest of the part",
    explanation: r#"The driver says which clock its part takes at most (`speed_max` of I2C, `clock_max` of SPI), as the data
sheet does. Faster transfers fail, or worse, work on the desk and fail in the robot.

Way out: write the clock that the message names, or a lower one, or leave the line out: the driver
has a clock that the part takes."#,
});

/// `asked` is the requested clock, `most` the greatest that the driver's part allows.
pub fn clock_over_part(span: Span, property: &str, asked: &str, driver: &str, most: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{asked} is too fast for `{driver}`, which takes {most} at most"))
        .here("over the greatest clock of the part")
        .help(format!("write `{property} = {most};`, or remove the line"))
        .one_of([most])
}
