//! What writes a program to a board: tools, of which some are installed and find a board, and drives that take a file.

use std::path::{Path, PathBuf};

use sensedsl_diagnostics::codes::{
    e0518_no_probe, e0522_not_flashed, e0527_other_drive, e0528_several_drives,
};
use sensedsl_diagnostics::{Diagnostic, Span};

use super::drive::{self, Drive};
use super::{Program, asked};
use crate::cli::Tool;
use crate::files::shown;

/// What the names of ESP32 chips begin with.
const ESP: &str = "ESP32";
/// The address of the flash on every STM32.
const FLASH: &str = "0x08000000";

/// All tools, in the order in which they are tried.
const TOOLS: [Tool; 7] = [
    Tool::StFlash,
    Tool::ProbeRs,
    Tool::DfuUtil,
    Tool::Picotool,
    Tool::Espflash,
    Tool::Drive,
    Tool::Openocd,
];

/// A tool's answer about boards on this machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Found {
    /// The tool is not installed.
    NoTool,
    /// It does not write to boards of this sort.
    Unfit,
    /// It finds no board.
    Nothing,
    /// It finds a board.
    Board,
    /// It cannot be asked.
    Unknown,
}

/// How a program is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// By a tool.
    Tool(Tool),
    /// By copying a file to the drive at this folder.
    Drive(PathBuf),
}

impl Tool {
    /// The name of the command that writes.
    fn name(self) -> &'static str {
        match self {
            Self::StFlash => "st-flash",
            Self::ProbeRs => "probe-rs",
            Self::DfuUtil => "dfu-util",
            Self::Picotool => "picotool",
            Self::Espflash => "espflash",
            Self::Drive => "the board's drive",
            Self::Openocd => "openocd",
        }
    }

    /// Whether it takes raw bytes instead of an ELF file.
    pub(crate) fn takes_raw(self) -> bool {
        match self {
            Self::StFlash | Self::DfuUtil => true,
            Self::ProbeRs | Self::Picotool | Self::Espflash | Self::Drive | Self::Openocd => false,
        }
    }

    /// Whether it writes to boards of this sort.
    fn serves(self, program: &Program) -> bool {
        let is_of = |make: &str| program.mcu.as_deref().is_some_and(|mcu| mcu.starts_with(make));
        match self {
            Self::StFlash | Self::DfuUtil => !(is_of("RP") || is_of("NRF") || is_of(ESP)),
            Self::Picotool => is_of("RP"),
            Self::Espflash => is_of(ESP),
            // The program of an ESP32 goes behind a boot loader, which only its own tool brings.
            Self::ProbeRs | Self::Drive | Self::Openocd => !is_of(ESP),
        }
    }

    /// Asks the tool for boards.
    fn look(self) -> Found {
        let (command, arguments, has): (_, &[&str], fn(&str) -> bool) = match self {
            Self::StFlash => ("st-info", &["--probe"], stlink_found),
            Self::ProbeRs => ("probe-rs", &["list"], |reported| reported.contains("[0]")),
            Self::DfuUtil => ("dfu-util", &["--list"], |reported| reported.contains("Found DFU:")),
            Self::Picotool => {
                ("picotool", &["info"], |reported| reported.contains("Program Information"))
            }
            // It asks the person which port it is, if it cannot tell.
            Self::Espflash => {
                let here = asked("espflash", &["--version"]).is_some();
                return if here { Found::Unknown } else { Found::NoTool };
            }
            // Drives are looked at by themselves.
            Self::Drive => return Found::Nothing,
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
            Self::Picotool => "picotool info",
            Self::Espflash => "espflash",
            Self::Drive => "a drive of the board",
            Self::Openocd => "openocd",
        };
        match found {
            Found::NoTool => format!("{} (not installed)", self.name()),
            Found::Unfit => format!("{} (does not write to such a board)", self.name()),
            Found::Nothing => format!("{how} (none)"),
            Found::Board | Found::Unknown => how.to_owned(),
        }
    }
}

/// Each tool by the name of its command, with whether it is installed, and the boards that it writes to.
pub(crate) fn installed() -> Vec<(&'static str, bool, &'static str)> {
    let tools = TOOLS.iter().filter(|tool| **tool != Tool::Drive);
    tools
        .map(|tool| {
            let serves = match tool {
                Tool::StFlash => "STM32, by ST-LINK",
                Tool::ProbeRs => "STM32, RP2 and nRF52, by any debug probe",
                Tool::DfuUtil => "STM32, by the MCU's own boot loader on USB",
                Tool::Picotool => "RP2040 and RP2350, by their boot loader",
                Tool::Espflash => "ESP32, by its boot loader",
                Tool::Drive | Tool::Openocd => "STM32, RP2 and nRF52, by ST-LINK or CMSIS-DAP",
            };
            (tool.name(), asked(tool.name(), &["--version"]).is_some(), serves)
        })
        .collect()
}

/// Whether the output reports a board: `Found 1 stlink programmers`.
fn stlink_found(reported: &str) -> bool {
    let count = reported.split("Found ").nth(1).and_then(|rest| rest.split_whitespace().next());
    count.and_then(|count| count.parse::<u32>().ok()).is_some_and(|count| count > 0)
}

/// The way to flash: the requested one, or the first that finds a board, or a tool that cannot be asked if no other is
/// installed.
pub(crate) fn choose(
    wanted: Option<Tool>,
    program: &Program,
    at: Span,
) -> Result<Way, Box<Diagnostic>> {
    let named = wanted.as_slice();
    let all = TOOLS.iter().filter(|tool| tool.serves(program));
    let tools: Vec<Tool> = if named.is_empty() { all.copied().collect() } else { named.to_vec() };
    let (mut looked, mut other) = (Vec::new(), None);
    for tool in tools {
        let found = if tool.serves(program) { tool.look() } else { Found::Unfit };
        if found == Found::Board {
            return Ok(Way::Tool(tool));
        }
        if tool == Tool::Drive {
            match drive_of(program, at)? {
                Ok(drive) => return Ok(Way::Drive(drive)),
                Err(found) => other = found,
            }
        }
        looked.push((tool, found));
    }
    let tools = || looked.iter().filter(|(tool, _)| *tool != Tool::Drive);
    let none_asked = tools().all(|(_, found)| *found != Found::Nothing);
    if let Some((tool, _)) = looked.iter().find(|(_, found)| *found == Found::Unknown)
        && none_asked
    {
        return Ok(Way::Tool(*tool));
    }
    if let Some(drive) = other {
        return Err(not_of_board(&drive, program, at));
    }
    let list: Vec<String> = looked.iter().map(|(tool, found)| tool.result(*found)).collect();
    let no_tool = tools().next().is_some() && tools().all(|(_, found)| *found == Found::NoTool);
    let board = e0518_no_probe::Board {
        ready: program.ready.as_deref(),
        installs: Tool::Espflash.serves(program).then_some("`cargo install espflash`"),
        has_drive: program.build.family().is_some(),
        not_mounted: drive::not_mounted(),
    };
    let tell = if no_tool { e0518_no_probe::no_tool } else { e0518_no_probe::no_probe };
    Err(tell(at, &list.join(", "), &board).into())
}

/// The drive of the board, or that of another one if there is one.
fn drive_of(
    program: &Program,
    at: Span,
) -> Result<Result<PathBuf, Option<Drive>>, Box<Diagnostic>> {
    let (own, other): (Vec<Drive>, Vec<Drive>) =
        drive::mounted().into_iter().partition(|drive| drive.suits(program));
    match own.as_slice() {
        [] => Ok(Err(other.into_iter().next())),
        [drive] => Ok(Ok(drive.path.clone())),
        several => {
            let paths: Vec<String> = several.iter().map(|drive| shown(&drive.path)).collect();
            Err(e0528_several_drives::several(at, &program.board, &paths).into())
        }
    }
}

/// The drive at a folder that the user names.
pub(crate) fn drive_at(
    path: &Path,
    program: &Program,
    at: Span,
) -> Result<PathBuf, Box<Diagnostic>> {
    match Drive::at(path) {
        None => Err(e0527_other_drive::no_drive(at, &shown(path)).into()),
        Some(drive) if drive.suits(program) => Ok(drive.path),
        Some(drive) => Err(not_of_board(&drive, program, at)),
    }
}

fn not_of_board(drive: &Drive, program: &Program, at: Span) -> Box<Diagnostic> {
    let family = program.build.family().map(|family| family.chip);
    let chip = family.or(program.mcu.as_deref());
    let chip = chip.map_or_else(|| "another chip".to_owned(), |chip| format!("an {chip}"));
    let path = shown(&drive.path);
    e0527_other_drive::other_drive(at, (&path, &drive.owner()), (&program.board, &chip)).into()
}

/// The command that writes an ELF file, or the same program as raw bytes, to the board and starts it.
pub(crate) fn command(
    tool: Tool,
    program: &Program,
    (elf, raw): (&Path, &Path),
    at: Span,
) -> Result<Vec<String>, Box<Diagnostic>> {
    let (elf, raw) = (shown(elf), shown(raw));
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
        Tool::Picotool => ["load", "-u", "-v", "-x", "-t", "elf", &elf].map(str::to_owned).into(),
        Tool::Espflash => {
            let chip = mcu()?.to_ascii_lowercase().replace('-', "");
            ["flash", "--chip", &chip, &elf].map(str::to_owned).into()
        }
        // A file is copied there.
        Tool::Drive => Vec::new(),
        Tool::Openocd => {
            let mcu = mcu()?;
            let interface = if mcu.starts_with("STM32") { "stlink" } else { "cmsis-dap" };
            let interface = format!("interface/{interface}.cfg");
            let target = format!("target/{}.cfg", target(mcu));
            let program = format!("program {{{elf}}} verify reset exit");
            ["-f", &interface, "-f", &target, "-c", &program].map(str::to_owned).into()
        }
    };
    Ok(std::iter::once(tool.name().to_owned()).chain(words).collect())
}

/// A part as probe-rs names it, without its temperature grade or its package: `STM32F407VGTx`, `nRF52840_xxAA`.
fn chip(mcu: &str) -> String {
    const GRADE: usize = "STM32F407VGT".len();
    if mcu.starts_with("RP235") {
        return "RP235x".to_owned();
    }
    if let Some((number, (_, variant))) = mcu.strip_prefix("NRF").and_then(|rest| {
        let (number, package) = rest.split_once('-')?;
        Some((number, package.split_at_checked(2)?))
    }) {
        return format!("nRF{number}_xx{variant}");
    }
    match (mcu.get(..GRADE), mcu.get(GRADE..GRADE + 1), mcu.get(GRADE + 1..)) {
        (Some(part), Some(_), Some(rest)) => format!("{part}x{rest}"),
        _ => mcu.to_owned(),
    }
}

/// The name of the `OpenOCD` file for a family: `stm32f4x`; L0 and L1 have no x.
fn target(mcu: &str) -> String {
    if mcu.starts_with("RP") {
        return if mcu.starts_with("RP235") { "rp2350" } else { "rp2040" }.to_owned();
    }
    if mcu.starts_with("NRF") {
        return "nrf52".to_owned();
    }
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
        assert_eq!(chip("NRF52832-QFAA"), "nRF52832_xxAA");
        assert_eq!(target("NRF52840-QIAA"), "nrf52");
        assert_eq!(target("STM32F407VGT6"), "stm32f4x");
        assert_eq!(target("STM32L073RZT6"), "stm32l0");
        assert_eq!(target("STM32L476RGT6"), "stm32l4x");
        assert_eq!(target("RP2040"), "rp2040");
        assert_eq!(target("RP2350A"), "rp2350");
    }

    #[test]
    fn answers_of_tools_are_understood() {
        assert!(stlink_found("Found 1 stlink programmers\n serial: 30"));
        assert!(!stlink_found("Found 0 stlink programmers\n"));
        assert!(!stlink_found("Couldn't find any ST-Link devices"));
    }
}
