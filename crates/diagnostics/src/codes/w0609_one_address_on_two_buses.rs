//! W0609: two devices with one address are on two buses.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0609",
    title: "one address on two buses",
    explanation: r#"Two i2c devices of a board have the same address, so they are wired to two buses, as two chips must be. Where
both mean one chip, the second bus leads nowhere.

Way out: if it is one chip, write a `chip` with both devices in it. If they are two
chips, give one of them another address where it has an address pin, or fix `unit` or the pins of both, which also ends the warning."#,
});

/// The second device and its unit come first, then the first one and its unit; `address` is the address on the wire.
pub fn one_address_on_two_buses(
    (span, device, unit): (Span, &str, &str),
    (first_span, first, first_unit): (Span, &str, &str),
    address: u8,
) -> Diagnostic {
    let text = format!(
        "`{first}` and `{device}` have the same address, 0x{address:02X}, so they are wired as two chips: \
         {first_unit} and {unit}"
    );
    Diagnostic::new(CODE, span, text)
        .label(first_span, format!("on {first_unit}"))
        .help(format!(
            "if it is one chip, put both into a `chip NAME {{ driver = …; address = 0x{address:02X}; }}`; \
             if they are two, fix the `unit` of both, or give one of them another address"
        ))
}
