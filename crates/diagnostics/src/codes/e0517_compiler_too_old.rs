//! E0517: the compiler is too old.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0517",
    title: "the compiler is too old",
    explanation: r#"`arm-none-eabi-gcc` must be of version 9 or later. Up to version 8, GCC may give an instruction of a Cortex-M0 a
register that it cannot take, so ChibiOS does not build on such an MCU; GCC 9 is the first without that mistake
(https://bugs.launchpad.net/gcc-arm-embedded/+bug/1803508). The generated code itself is C11, and is tested with
version 12.

Way out: install a newer one. Debian 12, Ubuntu 22.04 and the cask of Homebrew have version 10 or later; Arm has
builds for every system at https://developer.arm.com/downloads/-/arm-gnu-toolchain-downloads."#,
});

/// `found` is the version found, `needed` the first one that is sufficient.
pub fn compiler_too_old(span: Span, found: &str, needed: u32) -> Diagnostic {
    Diagnostic::new(
        CODE,
        span,
        format!("`arm-none-eabi-gcc` is version {found}, this firmware needs {needed} or later"),
    )
    .help(
        "install a newer one: Debian 12, Ubuntu 22.04 or later, `brew install --cask gcc-arm-embedded`, or \
         Arm's own from https://developer.arm.com/downloads/-/arm-gnu-toolchain-downloads",
    )
}
