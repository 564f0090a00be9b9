//! H0702: it is not known what firmware can do on the board.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "H0702",
    title: "only the pins are checked",
    explanation: r#"Nothing says which MCU the table describes, or there is no target profile for its family. So only the pins
are checked: timers, DMA streams, interrupt lines and drivers are not, there is no link, and no firmware can be generated.

Way out: begin the table with a line such as `# mcu = STM32F407VGT6`, or take a board of a family with a profile
(`sensedsl boards` tells which have firmware). `--target none` says that the pins are all that matters."#,
});

/// `why` is the reason why there is no target.
pub fn target_none(span: Span, table: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("only the pins of {table} are checked: {why}"))
        .help("begin the table with a line such as `# mcu = STM32F407VGT6`")
}

/// There is no target profile for the MCU; `covered` lists the beginnings of the MCU names that have one.
pub fn no_profile(span: Span, table: &str, mcu: &str, covered: &str) -> Diagnostic {
    let message =
        format!("only the pins of {table} are checked: there is no target profile for {mcu}");
    Diagnostic::new(CODE, span, message).help(format!(
        "there are profiles for {covered}; `--target none` says that the pins are all that matters"
    ))
}
