//! The arguments of `simulate`.

use std::path::PathBuf;

use clap::Args;

use super::common::{Reach, seconds};
use super::names;

#[derive(Debug, Default, Args)]
pub(crate) struct SimulateArgs {
    /// The file; - is the standard input
    pub(crate) file: PathBuf,
    /// What the sensors measure, and what breaks (TOML), or a recorded run (`.mcap`); without it all
    /// of them move within their ranges
    #[arg(long, value_name = "FILE")]
    pub(crate) world: Option<PathBuf>,
    /// What a sensor measures, in the unit that is shown: --set Front=20, --set 'Front=0.2 m'; wins
    /// over the world
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<String>,
    /// Run this image on an emulated MCU: an ELF file or a raw one
    #[arg(long, value_name = "IMAGE")]
    pub(crate) firmware: Option<PathBuf>,
    /// The folder of the board's firmware, whose `user` has the code of controllers; build/firmware/BOARD
    /// beside the file unless you say
    #[arg(long, value_name = "FOLDER", conflicts_with = "firmware")]
    pub(crate) code: Option<PathBuf>,
    /// The board of that name in the file; the first one unless you say
    #[arg(long, value_name = "NAME")]
    pub(crate) board: Option<String>,
    /// What the image was generated for: chibios or embassy; as the file says unless you do
    #[arg(long, value_name = "NAME", add = names::targets())]
    pub(crate) target: Option<String>,
    /// Compare every report with the world, as fast as possible; exit 1 where they disagree
    #[arg(long)]
    pub(crate) judge: bool,
    /// With --judge, write a case for each device to a file, as `JUnit` XML for a build server
    #[arg(long, value_name = "FILE", requires = "judge")]
    pub(crate) junit: Option<PathBuf>,
    /// Print what the board reports, and make no pseudo-terminal
    #[arg(long, conflicts_with = "judge")]
    pub(crate) stdout: bool,
    /// Be at that port in place of a pseudo-terminal: PORT of this machine, or HOST:PORT; 0 is a port
    /// that is free. Hosts then open tcp:HOST:PORT
    #[arg(long, value_name = "PORT", conflicts_with_all = ["judge", "stdout"])]
    pub(crate) tcp: Option<String>,
    /// Stop after that time; 10 with --judge, and where --stdout is not a terminal, or as long as a
    /// recorded run
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) seconds: Option<f64>,
    /// What chance begins with; the same seed gives the same bytes
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
    /// Ask the board how it is at the end, and print it
    #[arg(long)]
    pub(crate) health: bool,
    /// Write all bytes that the board sends to a file
    #[arg(long, value_name = "FILE")]
    pub(crate) frames: Option<PathBuf>,
    /// Record what the board reports and what its actuators are set to (MCAP): for `convert`, for `--world`
    #[arg(long, value_name = "FILE")]
    pub(crate) trace: Option<PathBuf>,
    /// At the end, draw what the world's plants did (SVG): the path on the map, and the signals over time
    #[arg(long, value_name = "FILE", requires = "world")]
    pub(crate) picture: Option<PathBuf>,
    /// Make an adapter (slcan) of each CAN bus on a pseudo-terminal, and leave the devices on it to
    /// whoever opens it
    #[cfg(unix)]
    #[arg(long, conflicts_with_all = ["judge", "stdout"])]
    pub(crate) can: bool,
    /// Write all that comes out of the MCU's pads and buses to a file (CSV), with its time
    #[arg(long, value_name = "FILE", requires = "firmware")]
    pub(crate) wires: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) reach: Reach,
}

/// `NAME=VALUE`, as it is written.
fn assignment(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok(text.to_owned())
        }
        Some(_) | None => Err("a sensor and its value, such as Front=20".into()),
    }
}
