//! W0628: interrupts are off for longer than a serial port can wait.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0628",
    title: "interrupts are off for longer than a serial port can wait",
    explanation: r#"The processor makes the bits of a part on 1-Wire itself, and keeps interrupts off for the few microseconds in which
a bit must be exact. A serial port that is faster than the message says can receive a whole byte in that time. Where its
hardware holds only one, the next one overwrites it.

Way out: a lower `baud`, a part on I2C, or the part on another board.

If the port only sends, nothing is lost: `allow W0628 "it only sends";`."#,
});

/// `lock` is the time for which the device `name` keeps interrupts off; `most` is the greatest rate that can be received.
pub fn locked_too_long(span: Span, name: &str, lock: &str, port: &str, most: u64) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{name} keeps interrupts off for {lock}, in which {port} can lose a byte"))
        .here("its bits are made with interrupts off")
        .help(format!("write a `baud` of {most} or less for {port}"))
}
