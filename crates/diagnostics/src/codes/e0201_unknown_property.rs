//! E0201: no such property.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0201",
    title: "no such property",
    explanation: r#"The device, board, driver or link has no property of that name. `docs/language.md` lists all
properties of each kind.

Way out: correct the spelling, or remove the line."#,
});

/// A property of the chip in one of its devices.
pub fn property_of_chip(span: Span, name: &str, chip: &str) -> Diagnostic {
    let message = format!("`{name}` belongs to the chip, not to one of its devices");
    Diagnostic::new(CODE, span, message)
        .here("the same for all devices of the chip")
        .help(format!("move the line into `chip {chip}` itself"))
        .remove("remove the line", span)
}

/// `of` describes the owner ("an analog device"); `known` is the nearest known name.
pub fn unknown_property(span: Span, name: &str, of: &str, known: Option<&str>) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("{of} has no property `{name}`"));
    match known {
        Some(word) => diagnostic.meant(known).help(format!("write `{word}`")),
        None => diagnostic
            .here("unknown")
            .help("remove the line, or look the name up in the language reference")
            .remove("remove the line", span),
    }
}
