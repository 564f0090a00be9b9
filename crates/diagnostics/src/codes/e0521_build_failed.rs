//! E0521: the build failed.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0521",
    title: "the build failed",
    explanation: r#"Everything that the build needs was there, and make or cargo ended with an error, which stands above the message. Where
it names a file in `user/` or `src/user/`, the mistake is in your own code. A `_Static_assert` of `generated/sense_hw.c` says that
your ChibiOS tree is not what the wiring was computed for (other clocks, another DMA stream). Where the linker says
`overflowed by` or `cannot move location counter backwards`, the program is larger than the MCU's memory: `--production`
leaves the shell out, which saves a third or more.

Cargo downloads the crates of a first build; without a network it names the one that it could not get.

Way out: mend what the first error names. `make -C FOLDER CHIBIOS=… USE_VERBOSE_COMPILE=yes` shows the whole
commands. An error in a file that SenseDSL wrote, with an unchanged tree, is a bug of SenseDSL."#,
});

/// `how` says how `tool` ended.
pub fn build_failed(span: Span, board: &str, tool: &str, how: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("the firmware of {board} was not built: {tool} ended with {how}"))
        .help("mend what the first error above names; nothing was flashed")
}
