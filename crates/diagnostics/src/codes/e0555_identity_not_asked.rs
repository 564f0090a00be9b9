//! E0555: the board read a part but not its identity.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0555",
    title: "the identity of a part was not read",
    explanation: r#"The driver of a part names the register that tells it from other parts (`identity`), and generated firmware
reads that register before anything else. In a run of `simulate --judge` the board read the part and not that register.
With another part at the same address it would report wrong values as good ones.

Way out: build the firmware of this very file (`sensedsl build FILE`)."#,
});

/// `name` is the part's name.
pub fn not_asked(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the board read `{name}` and not its identity"))
        .help("another part at the same address would not be noticed: build the firmware of this file with `sensedsl build`")
}
