//! E0315: there is no board.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0315",
    title: "there is no board",
    explanation: r#"Devices are connected to a board: `board NAME { … }`. Devices outside any board may go on any board of
the file, but there must be one.

Way out: put the devices into a board."#,
});

/// `span` is the first device, or the file.
pub fn no_board(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "the file has no board")
        .help("put the devices into `board STM32F4DiscoveryBoard { … }`")
}
