//! E0516: a tool for building is missing.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0516",
    title: "a tool for building is missing",
    explanation: r#"Firmware is built with GNU make, the compiler `arm-none-eabi-gcc` and its C library, newlib. All are looked for
before anything is built.

Way out: install them.

    Debian, Ubuntu    sudo apt install make gcc-arm-none-eabi libnewlib-arm-none-eabi
    macOS             brew install make && brew install --cask gcc-arm-embedded
    Windows           in WSL (`wsl --install`), as on Ubuntu

Arduino sketches are built by `arduino-cli` with the core `arduino:avr`, or by what Debian and Ubuntu have:

    Debian, Ubuntu    sudo apt install make gcc-avr avr-libc arduino-core-avr avrdude
    elsewhere         install arduino-cli, then: arduino-cli core install arduino:avr

The formula `arm-none-eabi-gcc` of Homebrew has no newlib; the cask has. A tool that is installed and not found
is in a folder that PATH does not name."#,
});

/// `tool` is the missing tool, `what` what it is needed for.
pub fn tool_missing(span: Span, tool: &str, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{tool}` is missing: {what}")).help(INSTALL)
}

/// The same for what builds and writes sketches.
pub fn missing_for_sketch(span: Span, tool: &str, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{tool}` is missing: {what}")).help(INSTALL_ARDUINO)
}

/// How to install what sketches need.
const INSTALL_ARDUINO: &str = "Debian, Ubuntu: `sudo apt install make gcc-avr avr-libc arduino-core-avr \
    avrdude`; elsewhere install arduino-cli, then `arduino-cli core install arduino:avr`";

/// How to install all of them.
const INSTALL: &str = "Debian, Ubuntu, WSL on Windows: `sudo apt install make gcc-arm-none-eabi \
    libnewlib-arm-none-eabi`; macOS: `brew install make && brew install --cask gcc-arm-embedded`";
