//! The arguments of `monitor`.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::common::{Reach, seconds};
use super::sinks::SinkArgs;

#[derive(Debug, Args)]
pub(crate) struct MonitorArgs {
    /// The board's serial port, or tcp:HOST:PORT; a record; a file with bytes of a board, or - for the standard input;
    /// `simulate` for a board in this program. Without it the board is looked for on all USB ports
    #[arg(value_name = "DEVICE")]
    pub(crate) device: Option<String>,
    /// The design
    #[arg(value_name = "FILE", conflicts_with = "schema")]
    pub(crate) file: Option<PathBuf>,
    /// The design's generated `schema.json`, in place of the design
    #[arg(long, value_name = "FILE")]
    pub(crate) schema: Option<PathBuf>,
    /// That board of the file alone; all that answer unless you say
    #[arg(long, value_name = "NAME")]
    pub(crate) board: Option<String>,
    /// The port of one of several boards: --at Left=/dev/ttyACM0 --at Right=/dev/ttyACM1
    #[arg(long, value_name = "NAME=DEVICE", value_parser = assignment, conflicts_with = "device")]
    pub(crate) at: Vec<(String, String)>,
    /// How to show values; a screen where people see it, otherwise lines
    #[arg(long, value_enum)]
    pub(crate) format: Option<MonitorFormat>,
    /// With `simulate`: what its sensors measure, as for the command of that name: a text (TOML), or
    /// a recorded run (`.mcap`)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["at", "replay"])]
    pub(crate) world: Option<PathBuf>,
    /// Write the run down in a new file that monitor, convert, and all programs for MCAP read
    #[arg(long, value_name = "FILE")]
    pub(crate) record: Option<PathBuf>,
    /// Print at the end how many values came, how regularly, how late, and within what limits
    #[arg(long)]
    pub(crate) summary: bool,
    /// Hold the run to the rules of the tests in this file, and say when one is broken; exit 1 then
    #[arg(long, value_name = "FILE")]
    pub(crate) watch: Option<PathBuf>,
    /// Play a record again
    #[arg(long, value_name = "RECORD", conflicts_with_all = ["device", "at", "baud", "set"])]
    pub(crate) replay: Option<PathBuf>,
    /// How many times as fast as it was a record is played; `max` is as fast as it can be shown
    #[arg(long, value_name = "N", value_parser = speed, default_value = "1")]
    pub(crate) speed: Speed,
    /// Pass what the board sends on to a pseudo-terminal, for a program that expects the board there
    #[cfg(unix)]
    #[arg(long)]
    pub(crate) pty: bool,
    /// Set an actuator as soon as the board is there, and hold it: --set Servo=20, --set 'Servo=raw 1500'
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
    /// Ask the board how it and its devices are, that often
    #[arg(long, value_name = "SECONDS", value_parser = seconds, num_args = 0..=1, require_equals = true, default_missing_value = "1")]
    pub(crate) health: Option<f64>,
    /// The rate of a serial link; as the design says unless you do
    #[arg(long, value_name = "RATE")]
    pub(crate) baud: Option<u32>,
    /// End when the device goes, in place of waiting for it
    #[arg(long)]
    pub(crate) no_reconnect: bool,
    /// Stop after that time
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) seconds: Option<f64>,
    #[command(flatten)]
    pub(crate) sinks: SinkArgs,
    #[command(flatten)]
    pub(crate) reach: Reach,
}

/// How values are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MonitorFormat {
    /// On a terminal a screen with plots and commands; elsewhere the last values, at the end
    Table,
    /// A line a value, for people
    Lines,
    /// A JSON object a value, one a line
    Ndjson,
    /// A row an element, with a header
    Csv,
}

impl MonitorArgs {
    /// The record that is named, as a device or by its option.
    pub(crate) fn record_file(&self) -> Option<&Path> {
        let device = self.device.as_deref().map(Path::new);
        let is_record = |path: &&Path| path.extension().is_some_and(|end| end == "mcap");
        self.replay.as_deref().or_else(|| device.filter(is_record))
    }
}

/// How fast a record is played.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Speed {
    /// So many times as fast as it was.
    Times(f64),
    /// As fast as it can be shown.
    Most,
}

fn speed(text: &str) -> Result<Speed, String> {
    let times = text.parse().ok().filter(|times: &f64| times.is_finite() && *times > 0.0);
    match (text, times) {
        ("max", _) => Ok(Speed::Most),
        (_, Some(times)) => Ok(Speed::Times(times)),
        (_, None) => Err("a number above 0, or `max`".into()),
    }
}

/// `NAME=VALUE`.
fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        Some(_) | None => Err("a name and its value, such as Servo=20".into()),
    }
}
