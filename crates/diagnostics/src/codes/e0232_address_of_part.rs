//! E0232: an address that the part cannot have.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0232",
    title: "an address that the part cannot have",
    explanation: r#"The driver lists the I2C addresses that its part can be set to. At another one nothing answers, or
another part does.

Way out: write one of the addresses that the message lists, in the 7-bit form; the part's page
(`sensedsl drivers NAME`) says which of its pins choose it. A part that does have another address
gets a driver of the file with its own `addresses`."#,
});

/// `address` is the 7-bit address, `has` lists the addresses of the driver's part, `help` says what to
/// write, `others` are the addresses to choose from.
pub fn address_of_part(
    span: Span,
    address: u8,
    driver: &str,
    (has, help): (&str, &str),
    others: &[u8],
) -> Diagnostic {
    let message = format!("0x{address:02X} is not an address of `{driver}`, whose part can have {has}");
    let others: Vec<String> = others.iter().map(|one| format!("0x{one:02X}")).collect();
    let diagnostic = Diagnostic::new(CODE, span, message).here("nothing answers there").help(help);
    diagnostic.one_of(others.iter().map(String::as_str))
}
