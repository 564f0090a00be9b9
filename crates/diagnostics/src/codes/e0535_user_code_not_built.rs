//! E0535: the code of a controller does not compile for this computer.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0535",
    title: "the code of a controller does not compile for this computer",
    explanation: r#"To run without a board, the code of controllers is compiled for this computer: by the compiler that `CC` names, or
`cc`; code in Rust by `cargo`. What the compiler says stands above the message, or its first error in it.

Way out: mend what the compiler names. Code that needs the MCU, such as its registers or the operating system, cannot run
here: keep it out of the controllers' files, or between `#ifndef SENSE_NATIVE` and `#endif`."#,
});

/// `why` is a sentence without its end.
pub fn user_code_not_built(span: Span, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the controllers' code was not built: {why}"))
        .help("mend what the compiler names; `CC` names another compiler")
}
