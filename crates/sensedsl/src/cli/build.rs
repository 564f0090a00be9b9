//! The arguments of `build` and `flash`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::common::Reach;

/// What is built, from what, and with what.
#[derive(Clone, Debug, Args)]
pub(crate) struct Place {
    /// A file, or a folder that `generate` wrote; without it, this folder or the only file in it
    #[arg(value_name = "FILE|DIR")]
    pub(crate) path: Option<PathBuf>,
    /// With a file: the folder to generate into; `build` beside the file unless you say otherwise
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Only the board of that name in the file
    #[arg(long, value_name = "NAME")]
    pub(crate) board: Option<String>,
    /// Without the shell: frames only
    #[arg(long)]
    pub(crate) production: bool,
    /// The source tree of `ChibiOS`; unless you say, the variable CHIBIOS names it
    #[arg(long, value_name = "PATH")]
    pub(crate) chibios: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) reach: Reach,
}

#[derive(Debug, Args)]
pub(crate) struct BuildArgs {
    #[command(flatten)]
    pub(crate) place: Place,
}

#[derive(Debug, Args)]
pub(crate) struct FlashArgs {
    #[command(flatten)]
    pub(crate) place: Place,
    /// Flash with this; unless you say, with the first that is installed and finds a board
    #[arg(long, value_enum, value_name = "TOOL")]
    pub(crate) with: Option<Tool>,
    /// Copy the program to the drive that is mounted at this folder
    #[arg(long, value_name = "DIR", conflicts_with = "with")]
    pub(crate) drive: Option<PathBuf>,
    /// The serial port of an Arduino; unless you say, the only USB port that has a device
    #[arg(long, value_name = "PORT", conflicts_with_all = ["with", "drive"])]
    pub(crate) port: Option<String>,
}

/// What writes a program to a board, in the order in which they are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Tool {
    /// By ST-LINK
    StFlash,
    /// By any probe that probe-rs knows
    ProbeRs,
    /// By the MCU's own boot loader on USB
    DfuUtil,
    /// By the boot loader of RP2040 and RP2350
    Picotool,
    /// By the boot loader of ESP32
    Espflash,
    /// By copying a file to the drive of the boot loader, or of an ST-LINK
    Drive,
    /// By a probe, through `OpenOCD`
    Openocd,
}
