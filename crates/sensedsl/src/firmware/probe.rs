//! Tools that write a program to a board: which are installed, which of them find a board, and the command.

use std::path::Path;

use sensedsl_diagnostics::codes::{e0518_no_probe, e0522_not_flashed};
use sensedsl_diagnostics::{Diagnostic, Span};

use super::{Program, asked};
use crate::cli::Tool;

/// The address of the flash on every STM32.
const FLASH: &str = "0x08000000";

/// All tools, in the order in which they are tried.
const TOOLS: [Tool; 4] = [Tool::StFlash, Tool::ProbeRs, Tool::DfuUtil, Tool::Openocd];

/// A tool's answer about boards on this machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Found {
    /// The tool is not installed.
    NoTool,
    /// It finds no board.
    Nothing,
    /// It finds a board.
    Board,
    /// It cannot be asked.
    Unknown,
}

impl Tool {
    /// The name of the command that writes.
    fn name(self) -> &'static str {
        match self {
            Self::StFlash => "st-flash",
            Self::ProbeRs => "probe-rs",
            Self::DfuUtil => "dfu-util",
            Self::Openocd => "openocd",
        }
    }

    /// Whether it takes raw bytes instead of an ELF file.
    pub(crate) fn takes_raw(self) -> bool {
        match self {
            Self::StFlash | Self::DfuUtil => true,
            Self::ProbeRs | Self::Openocd => false,
        }
    }

    /// Asks the tool for boards.
    fn look(self) -> Found {
        let (command, arguments, has): (_, &[&str], fn(&str) -> bool) = match self {
            Self::StFlash => ("st-info", &["--probe"], stlink_found),
            Self::ProbeRs => ("probe-rs", &["list"], |reported| reported.contains("[0]")),
            Self::DfuUtil => ("dfu-util", &["--list"], |reported| reported.contains("Found DFU:")),
            Self::Openocd => {
                let here = asked("openocd", &["--version"]).is_some();
                return if here { Found::Unknown } else { Found::NoTool };
            }
        };
        match asked(command, arguments) {
            None => Found::NoTool,
            // The package has both commands; one is useless without the other.
            Some(_) if self == Self::StFlash && asked("st-flash", &["--version"]).is_none() => {
                Found::NoTool
            }
            Some(reported) if has(&reported) => Found::Board,
            Some(_) => Found::Nothing,
        }
    }

    /// The question to the tool, and its result.
    fn result(self, found: Found) -> String {
        let how = match self {
            Self::StFlash => "st-info --probe",
            Self::ProbeRs => "probe-rs list",
            Self::DfuUtil => "dfu-util --list",
            Self::Openocd => "openocd",
        };
        match found {
            Found::NoTool => format!("{} (not installed)", self.name()),
            Found::Nothing => format!("{how} (none)"),
            Found::Board | Found::Unknown => how.to_owned(),
        }
    }
}

/// Whether the output reports a board: `Found 1 stlink programmers`.
fn stlink_found(reported: &str) -> bool {
    let count = reported.split("Found ").nth(1).and_then(|rest| rest.split_whitespace().next());
    count.and_then(|count| count.parse::<u32>().ok()).is_some_and(|count| count > 0)
}

/// The tool to flash with: the requested one, or the first that finds a board, or one that cannot be asked if no other
/// is installed.
pub(crate) fn choose(wanted: Option<Tool>, at: Span) -> Result<Tool, Box<Diagnostic>> {
    let tools = wanted.as_ref().map_or(&TOOLS[..], std::slice::from_ref);
    let mut looked = Vec::new();
    for tool in tools {
        let found = tool.look();
        looked.push((*tool, found));
        if found == Found::Board {
            return Ok(*tool);
        }
    }
    let none_asked = looked.iter().all(|(_, found)| *found != Found::Nothing);
    if let Some((tool, _)) = looked.iter().find(|(_, found)| *found == Found::Unknown)
        && none_asked
    {
        return Ok(*tool);
    }
    let list: Vec<String> = looked.iter().map(|(tool, found)| tool.result(*found)).collect();
    let no_tool = looked.iter().all(|(_, found)| *found == Found::NoTool);
    let tell = if no_tool { e0518_no_probe::no_tool } else { e0518_no_probe::no_probe };
    Err(tell(at, &list.join(", ")).into())
}

/// The command that writes an ELF file, or the same program as raw bytes, to the board and starts it.
pub(crate) fn command(
    tool: Tool,
    program: &Program,
    (elf, raw): (&Path, &Path),
    at: Span,
) -> Result<Vec<String>, Box<Diagnostic>> {
    let (elf, raw) = (elf.display().to_string(), raw.display().to_string());
    let mcu = || {
        let unknown = || Box::new(e0522_not_flashed::unknown_mcu(at, &program.board, tool.name()));
        program.mcu.as_deref().ok_or_else(unknown)
    };
    let words: Vec<String> = match tool {
        Tool::StFlash => {
            vec!["--reset".into(), "write".into(), raw, FLASH.into()]
        }
        Tool::ProbeRs => {
            let chip = chip(mcu()?);
            vec!["download".into(), "--chip".into(), chip, "--verify".into(), elf]
        }
        Tool::DfuUtil => {
            let address = format!("{FLASH}:leave");
            ["-a", "0", "-s", &address, "-D", &raw].map(str::to_owned).into()
        }
        Tool::Openocd => {
            let target = format!("target/{}.cfg", target(mcu()?));
            let program = format!("program {{{elf}}} verify reset exit");
            ["-f", "interface/stlink.cfg", "-f", &target, "-c", &program].map(str::to_owned).into()
        }
    };
    Ok(std::iter::once(tool.name().to_owned()).chain(words).collect())
}

/// A part as probe-rs names it, without its temperature grade: `STM32F407VGTx`.
fn chip(mcu: &str) -> String {
    const GRADE: usize = "STM32F407VGT".len();
    if mcu.starts_with("RP235") {
        return "RP235x".to_owned();
    }
    match (mcu.get(..GRADE), mcu.get(GRADE..GRADE + 1), mcu.get(GRADE + 1..)) {
        (Some(part), Some(_), Some(rest)) => format!("{part}x{rest}"),
        _ => mcu.to_owned(),
    }
}

/// The name of the `OpenOCD` file for a family: `stm32f4x`; L0 and L1 have no x.
fn target(mcu: &str) -> String {
    const FAMILY: usize = "STM32F4".len();
    let family = mcu.get(..FAMILY).unwrap_or(mcu).to_ascii_lowercase();
    let bare = family.ends_with("l0") || family.ends_with("l1");
    if bare { family } else { format!("{family}x") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_called_as_the_tools_call_them() {
        assert_eq!(chip("STM32F407VGT6"), "STM32F407VGTx");
        assert_eq!(chip("STM32L552ZET6Q"), "STM32L552ZETxQ");
        assert_eq!(chip("RP2040"), "RP2040");
        assert_eq!(chip("RP2350A"), "RP235x");
        assert_eq!(target("STM32F407VGT6"), "stm32f4x");
        assert_eq!(target("STM32L073RZT6"), "stm32l0");
        assert_eq!(target("STM32L476RGT6"), "stm32l4x");
    }

    #[test]
    fn answers_of_tools_are_understood() {
        assert!(stlink_found("Found 1 stlink programmers\n serial: 30"));
        assert!(!stlink_found("Found 0 stlink programmers\n"));
        assert!(!stlink_found("Couldn't find any ST-Link devices"));
    }
}
