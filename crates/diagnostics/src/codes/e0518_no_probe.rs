//! E0518: there is nothing to flash with.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0518",
    title: "there is nothing to flash with",
    explanation: r#"`flash` looks for a tool and for a board that the tool can reach, in this order: `st-flash` (asked by `st-info
--probe`), `probe-rs` (`probe-rs list`), `dfu-util` (`dfu-util --list`), `openocd`, which cannot be asked and is
tried where nothing else is installed. All of them look on USB: for an ST-LINK, which Nucleo and Discovery
boards carry, or for a board in DFU mode.

Way out: plug the board in at the connector of its ST-LINK, with a cable that carries data; or hold BOOT0 while
you plug in a board without one, for DFU. Install a tool:

    Debian, Ubuntu    sudo apt install stlink-tools     (or openocd, dfu-util)
    macOS             brew install stlink               (or openocd, dfu-util)
    Windows           in WSL, where `usbipd attach --wsl` hands over the board

On Linux, a probe that only root sees needs udev rules, which these packages bring: unplug it and plug it in
again. `--with TOOL` takes one tool only."#,
});

/// `looked` says what was looked for, and the result.
pub fn no_tool(span: Span, looked: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("there is no tool to flash with; looked for {looked}")).help(
        "Debian, Ubuntu: `sudo apt install stlink-tools`; macOS: `brew install stlink`; or install another of them",
    )
}

/// `looked` says what was asked, and the result.
pub fn no_probe(span: Span, looked: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("no board was found to flash; looked with {looked}")).help(
        "plug the board in at the connector of its ST-LINK, with a cable that carries data; a board without one: \
         hold BOOT0 while you plug it in, and use dfu-util",
    )
}
