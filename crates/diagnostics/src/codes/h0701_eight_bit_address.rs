//! H0701: an 8-bit I2C address was understood.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "H0701",
    title: "an 8-bit I2C address was understood",
    explanation: r#"Data sheets of some makers give I2C addresses with the read/write bit: 0xE6 for writing, 0xE7 for
reading. Operating systems take the 7-bit address, 0x73. From 0x80 on the language takes the 8-bit form
and shifts it.

Way out: nothing to do; write the 7-bit form if you prefer it."#,
});

/// `eight_bit` is the address as written.
pub fn eight_bit_address(span: Span, eight_bit: u8) -> Diagnostic {
    let seven_bit = eight_bit >> 1;
    Diagnostic::new(CODE, span, format!("0x{eight_bit:02X} is the 8-bit form, on the bus it is 0x{seven_bit:02X}"))
        .help(format!("nothing to do; `address = 0x{seven_bit:02X};` says the same"))
        .replace("write the 7-bit form", span, format!("0x{seven_bit:02X}"))
}
