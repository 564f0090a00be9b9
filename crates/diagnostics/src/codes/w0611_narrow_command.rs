//! W0611: the type of an actuator cannot hold its range.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0611",
    title: "the type of an actuator cannot hold its range",
    explanation: r#"The part takes more values than the type can hold, so that a part of its range cannot be commanded: a pwm
output goes from 0 to 10000, and a `uint8` ends at 255 of them; a motor's bridge goes from -10000 to
10000, and an unsigned type never turns it backwards.

Way out: use the type that the message names. Where the rest of the range is not wanted, say why:
`allow W0611 "only the first part of the range";`."#,
});

/// `holds` is the range of the type `found`, `takes` what the device takes, `wider` the scalar type that holds that,
/// and `write` the type as the file has to spell it.
pub fn narrow_command(
    span: Span,
    (found, holds): (&str, &str),
    (device, takes): (&str, &str),
    (wider, write): (&str, &str),
) -> Diagnostic {
    let message = format!("{found} holds {holds}, but {device} takes {takes}");
    Diagnostic::new(CODE, span, message)
        .here("the rest of the range cannot be commanded")
        .help(format!("use {wider}"))
        .one_of([write])
}
