//! W0613: a level above the supply that the part tolerates.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0613",
    title: "a level over the supply that the part stands",
    explanation: r#"The driver says which supply its part stands, and the file says that its wires carry a higher voltage. A part
without level shifters is destroyed by that.

Way out: pull the bus up to the part's supply and write that level, or leave the line out. Where the
module has level shifters, say so: `allow W0613 "the module shifts levels";`."#,
});

/// `level` is the level, `most` the greatest supply that the driver's part tolerates.
pub fn level_over_part(span: Span, level: &str, driver: &str, most: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{level} on the wires of `{driver}`, whose supply is {most} at most"))
        .here("over the supply of the part")
        .help(format!("write `level = {most};` or less, or remove the line"))
        .one_of([most])
        .remove("remove the line", span)
}
