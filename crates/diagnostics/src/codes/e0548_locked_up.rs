//! E0548: the firmware no longer runs.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0548",
    title: "the firmware locked up",
    explanation: r#"The processor of the emulated board does nothing more: a fault, a failed check of the kernel, a sleep from which nothing
wakes it, or a program that the watchdog resets again and again. On real hardware the board would stand still, or start
without end.

Way out: `arm-none-eabi-addr2line -e sense.elf ADDRESS` tells the line of the source at the address that the message has."#,
});

/// `pc` is where it stopped, `why` the reason.
pub fn locked_up(span: Span, pc: u64, why: &str, seconds: &str) -> Diagnostic {
    let what = format!("the firmware locked up after {seconds} s at 0x{pc:08X}: {why}");
    Diagnostic::new(CODE, span, what)
        .help(format!("`arm-none-eabi-addr2line -e sense.elf 0x{pc:08X}` tells the line"))
}
