//! E0523: the compiler has no core library for the processor.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0523",
    title: "the compiler has no core library for the processor",
    explanation: r#"Firmware for Embassy is built with Rust's core library for the board's processor, which rustup downloads once. It is
looked for before anything is written or built.

Way out: `rustup target add` with the target that the message names. A rustc that did not come from rustup can build the
library from its sources: set `CARGO_UNSTABLE_BUILD_STD=core` and `RUSTC_BOOTSTRAP=1`, and the library is not looked
for."#,
});

/// `target` is the target triple.
pub fn no_core_library(span: Span, target: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("rustc has no core library for `{target}`"))
        .help(format!("run `rustup target add {target}`"))
}
