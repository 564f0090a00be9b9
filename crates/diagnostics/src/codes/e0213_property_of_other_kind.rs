//! E0213: the property belongs to another kind.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0213",
    title: "the property belongs to another kind",
    explanation: r#"The property exists, but not for a device of this kind: an `address` means something to i2c only, a
`baud` to uart only.

In a driver these are the properties of how a part is started and of how its values stand in bytes: `identity` needs
a bus with registers, and `init` something that takes bytes.

Way out: remove the line, or change the device's `type`."#,
});

/// `kinds` lists the kinds that have the property, and `instead` what this kind has in its place.
pub fn property_of_other_kind(
    span: Span,
    name: &str,
    kind: &str,
    kinds: &str,
    instead: &[&str],
) -> Diagnostic {
    let help = match instead {
        [] if kind.ends_with("device") => {
            "remove the line, or change the device's `type`".to_owned()
        }
        [] => "remove the line".to_owned(),
        words => format!("name each wire: write `{} = …;`", words.join(" = …;` or `")),
    };
    Diagnostic::new(CODE, span, format!("`{name}` means nothing for {kind}"))
        .here(format!("only for {kinds}"))
        .help(help)
        .remove("remove the line", span)
}
