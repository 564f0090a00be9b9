//! W0608: a table without usages gets none from its MCU.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "W0608",
    title: "what a pin can be used for is not known",
    explanation: r#"A board table without a column of usages takes them from its MCU: the part that a line `# mcu = ...` above
its head names. Either no known part is named there, so that all its pins are good for `digital` devices
alone, or the part does not have this pin.

Way out: name the part, as `sensedsl parts --list` spells it; correct the pin's name; or write the usages into the
table, in columns of any name."#,
});

/// The table's MCU is not a known part.
pub fn no_part(span: Span, mcu: Option<&str>) -> Diagnostic {
    let why = match mcu {
        Some(mcu) => format!("{mcu} is not a known part"),
        None => "it does not say which MCU it describes".to_owned(),
    };
    Diagnostic::new(CODE, span, format!("the table lists no usages, and {why}"))
        .help("write a line `# mcu = PART` above the head, or the usages into columns")
}

/// The MCU does not have the pin.
pub fn no_pin(span: Span, pin: &str, mcu: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("{mcu} has no pin {pin}"))
        .help("what the pin can be used for is not known: it serves `digital` devices alone")
}
