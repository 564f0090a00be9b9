//! E0501: this kind, or what a part asks for, cannot be generated yet.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0501",
    title: "this kind or part cannot be generated yet",
    explanation: r#"The wiring of everything is solved, but the target has no code for this kind on the board's MCU, or not for
what the part asks for: values without a coding, or the start of a part that is on two buses. Nothing was written, so
that a firmware which reads only some of the devices, or reads them wrongly, never looks complete.

Way out: `sensedsl generate --without firmware` writes everything else, the host applications among
it; for firmware, leave the device or the part out of the file."#,
});

/// `what` is what a device needs and no firmware has: `the start of a chip`.
pub fn not_made_yet(span: Span, device: &str, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("no firmware can be generated for {what} yet"))
        .here(format!("`{device}` needs it"))
        .help("`generate --without firmware` writes the rest; or leave this out")
}

/// `kind` is the device's kind, `can` lists the kinds that can be generated.
pub fn no_generator(span: Span, kind: &str, can: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("no firmware can be generated for {kind} yet"))
        .here(format!("solved, but only {can} can be generated"))
        .help("`generate --without firmware` writes the rest; or leave this device out")
}
