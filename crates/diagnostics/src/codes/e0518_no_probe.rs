//! E0518: there is nothing to flash with.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0518",
    title: "there is nothing to flash with",
    explanation: r#"`flash` looks for a tool and for a board that the tool can reach, in this order: `st-flash` (asked by `st-info
--probe`), `probe-rs` (`probe-rs list`), `dfu-util` (`dfu-util --list`), `picotool` (`picotool info`), `espflash`, the
board's drive, and `openocd`, which cannot be asked and is tried where nothing else is installed. `st-flash` and
`dfu-util` write to STM32, `picotool` to RP2040 and RP2350, `espflash` alone to ESP32. All of them look on USB: for an
ST-LINK, which Nucleo and Discovery boards carry, or for a board whose boot loader runs. A drive takes the program as a
file and needs no tool: that of an ST-LINK, or that of the boot loader of RP2040 and RP2350.

Way out: plug the board in at the connector of its ST-LINK, with a cable that carries data; or start the boot loader of
a board without one. On RP2040 and RP2350: hold BOOTSEL (on some boards BOOT) while you plug the board in. On STM32, for
DFU: hold BOOT0 while you plug the board in, or hold BOOT0 and press NRST. Install a tool for it:

    Debian, Ubuntu    sudo apt install stlink-tools     (or openocd, dfu-util)
    macOS             brew install stlink               (or openocd, dfu-util, picotool)
    Windows           in WSL, where `usbipd attach --wsl` hands over the board
    ESP32, anywhere   cargo install espflash

On Linux, a probe that only root sees needs udev rules, which these packages bring: unplug it and plug it in again. A
drive must be mounted, which a desktop does by itself. `--with TOOL` takes one tool only, `--drive DIR` the drive that
is mounted there.

An Arduino takes its program at its serial port, by `arduino-cli` or `avrdude`: the only USB port that has a device, or
the one that `--port PORT` names."#,
});

/// No USB port has a device, and an Arduino is to be flashed.
pub fn no_port(span: Span) -> Diagnostic {
    Diagnostic::new(CODE, span, "no USB port of this machine has a device")
        .help("plug the board in with a cable that carries data, or name its port with `--port`")
}

/// Several ports have one.
pub fn several_ports(span: Span, ports: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, "several USB ports have a device, and the board is at one of them")
        .help(format!("say which with `--port`: {ports}"))
}

/// A board that no way was found to.
#[derive(Clone, Debug, Default)]
pub struct Board<'a> {
    /// What makes it ready to take a program, if that is known; a clause.
    pub ready: Option<&'a str>,
    /// How the only tool that can write to it is installed, if there is only one; a command in backticks.
    pub installs: Option<&'a str>,
    /// Whether it is then a drive.
    pub has_drive: bool,
    /// The label of such a drive that is there and not mounted.
    pub not_mounted: Option<String>,
}

impl Board<'_> {
    /// What to do for a board with a drive, or with one that is not mounted.
    fn by_drive(&self) -> Option<String> {
        if let Some(label) = &self.not_mounted {
            return Some(format!(
                "there is a drive `{label}` that is not mounted: run `udisksctl mount -b /dev/disk/by-label/{label}`"
            ));
        }
        let ready =
            self.ready.unwrap_or("hold BOOTSEL (on some boards BOOT) while you plug the board in");
        self.has_drive.then(|| {
            format!("{ready}: a drive appears, and `flash` copies the program there; no tool is needed")
        })
    }
}

/// `looked` says what was looked for, and the result.
pub fn no_tool(span: Span, looked: &str, board: &Board<'_>) -> Diagnostic {
    let installs = board.installs.map(|command| format!("install it: {command}"));
    let tools = installs.as_deref().unwrap_or(
        "Debian, Ubuntu: `sudo apt install stlink-tools`; macOS: `brew install stlink`; or install another of them",
    );
    let help = match (board.by_drive(), board.ready) {
        (Some(help), _) => help,
        (None, Some(ready)) => format!("{ready}; and install a tool: {tools}"),
        (None, None) => tools.to_owned(),
    };
    let message = format!("there is no tool to flash with; looked for {looked}");
    Diagnostic::new(CODE, span, message).help(help)
}

/// `looked` says what was asked, and the result.
pub fn no_probe(span: Span, looked: &str, board: &Board<'_>) -> Diagnostic {
    let help = board.by_drive().or_else(|| board.ready.map(str::to_owned));
    let help = help.unwrap_or_else(|| {
        "plug the board in at the connector of its ST-LINK, with a cable that carries data; a board without one: \
         hold BOOT0 while you plug it in, and use dfu-util"
            .to_owned()
    });
    let message = format!("no board was found to flash; looked with {looked}");
    Diagnostic::new(CODE, span, message).help(help)
}
