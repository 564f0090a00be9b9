//! E0215: not an I2C address.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0215",
    title: "not an I2C address",
    explanation: r#"Up to 0x7F an address is the 7-bit form. From 0x80 on it is the 8-bit form of data sheets, the write
address, and then it is even: `0xE6` is 7-bit 0x73. The 7-bit addresses 0x00 to 0x07 are reserved by
the I2C specification (so are 0x78 to 0x7F, which devices use all the same). Only a driver may state one,
for a part that has it all the same (MT6701).

Way out: look the address up in the data sheet; where it lists a read and a write address, take the
write address."#,
});

/// `address` is the address as written, `why` the reason why it is impossible.
pub fn bad_address(span: Span, address: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{address} is not an I2C address: {why}"))
        .help("write the 7-bit address (0x08 to 0x7F) or the even 8-bit write address (0x80 to 0xFE)")
}
