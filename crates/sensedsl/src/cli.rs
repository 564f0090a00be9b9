//! The arguments of all commands.

mod build;
mod common;
mod convert;
mod doctor;
mod monitor;
mod names;
mod parts;
mod simulate;
mod sinks;
mod test;

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use sensedsl_generate::host::HOSTS;
use sensedsl_model::kind::KindName;

pub(crate) use build::{BuildArgs, FlashArgs, Place, Tool};
pub(crate) use common::{On, Reach, TableFormat, seconds};
pub(crate) use convert::{ConvertArgs, ConvertTo};
pub(crate) use doctor::{DoctorArgs, DoctorFormat, Purpose};
pub(crate) use monitor::{MonitorArgs, MonitorFormat, Speed};
use names::{BOARD, DRIVER, TEMPLATE};
pub(crate) use parts::{PartsArgs, PartsOrder};
pub(crate) use simulate::SimulateArgs;
pub(crate) use sinks::SinkArgs;
pub(crate) use test::{TestArgs, TestFormat};

/// From a list of sensors and actuators to the best wiring, its firmware and its host application
///
/// A short text says what is connected; this tool finds how: the pins with the provably lowest
/// opportunity cost, the `ChibiOS` firmware for them, and the host application that decodes the data.
#[derive(Debug, Parser)]
#[command(name = "sensedsl", version, max_term_width = 100)]
pub(crate) struct Cli {
    /// Say nothing but errors and the result
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,
    /// Say more
    #[arg(short, long, global = true, conflicts_with = "quiet")]
    pub(crate) verbose: bool,
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Make a small project that checks, solves and generates
    New(NewArgs),
    /// Say what is wrong with a file and whether there is a wiring
    Check(CheckArgs),
    /// Find the best wiring
    Solve(SolveArgs),
    /// Write firmware, host applications, wiring sheet and picture
    Generate(GenerateArgs),
    /// Build the firmware of a file, or of a generated folder, with your tree of `ChibiOS`
    Build(BuildArgs),
    /// Build the firmware and write it to the board
    Flash(FlashArgs),
    /// Run a board without hardware: its sensors measure a simulated world
    Simulate(SimulateArgs),
    /// Run the tests of a file: boards in a simulated world, held to rules
    Test(TestArgs),
    /// Show what a board measures as it comes, and set its actuators
    Monitor(MonitorArgs),
    /// Make a table, a summary or a page with plots of a record
    Convert(ConvertArgs),
    /// Explain a diagnostic, why a device is on its pin, or what the hardware has to do in a second
    Explain(ExplainArgs),
    /// Say what can still be added to a wiring, and what blocks the next device
    Capacity(CapacityArgs),
    /// Say what changes on the bench from one wiring to another
    Diff(DiffArgs),
    /// Say which MCU parts and boards can carry the devices, cheapest wiring first
    Parts(PartsArgs),
    /// List the built-in boards, or print one's table
    Boards(BoardsArgs),
    /// List the library of drivers, or tell all about one: wires, values, notes, an example
    Drivers(DriversArgs),
    /// Make a board table, or a file, of what other tools know about pins
    Import(ImportArgs),
    /// Lay files out canonically, comments kept; write identifiers into them
    Fmt(FmtArgs),
    /// Serve an editor: the language server, on the standard input and output
    Lsp,
    /// Show the studio in a browser: text, wiring and a robot that runs in a page, with the files of a folder
    Studio(StudioArgs),
    /// Say what this machine has of what you want to do, and what to install
    Doctor(DoctorArgs),
    /// Print a completion script for a shell
    Completions(CompletionsArgs),
    /// Print the manual page, or write one for each command into a folder
    Man(ManArgs),
}

#[derive(Debug, Args)]
pub(crate) struct NewArgs {
    /// The folder to make
    pub(crate) dir: PathBuf,
    /// A built-in board
    #[arg(long, default_value = "STM32F407G-DISC1", value_parser = BOARD, hide_possible_values = true)]
    pub(crate) board: String,
    /// A whole robot with a simulated world, instead of a few sensors: arm, balancer,
    /// `line_follower`, quadcopter, rover, thermostat or `weather_station`
    #[arg(long, value_name = "NAME", value_parser = TEMPLATE, hide_possible_values = true)]
    pub(crate) template: Option<String>,
    /// Write into a folder that is not empty, and replace the files of an earlier `new`
    #[arg(long)]
    pub(crate) force: bool,
}

#[derive(Debug, Args)]
pub(crate) struct StudioArgs {
    /// The folder with the designs, or one of its files
    #[arg(default_value = ".")]
    pub(crate) folder: PathBuf,
    /// The port of this machine; 0 takes one that is free
    #[arg(long, default_value_t = 0)]
    pub(crate) port: u16,
    /// Start the browser
    #[arg(long)]
    pub(crate) open: bool,
    /// A folder with the studio's page, instead of the one in this program
    #[arg(long)]
    pub(crate) site: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// The files; - is the standard input
    #[arg(required = true)]
    pub(crate) files: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) on: On,
    /// How to say it
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: CheckFormat,
    /// Let the Rust compiler judge the wiring, too, by the types of Embassy's HAL; needs cargo
    #[arg(long)]
    pub(crate) typecheck: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum CheckFormat {
    /// For people
    #[default]
    Human,
    /// For scripts
    Json,
    /// SARIF 2.1.0, for code scanning
    Sarif,
    /// Annotations of GitHub Actions
    Github,
    /// `JUnit` XML, a case for each file, for build servers
    Junit,
}

#[derive(Debug, Args)]
pub(crate) struct SolveArgs {
    /// The file; - is the standard input
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) on: On,
    /// How to print it
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: SolveFormat,
    /// Any wiring will do
    #[arg(long, conflicts_with_all = ["all", "limit", "count"])]
    pub(crate) any: bool,
    /// Leave out the devices that are in error and print the wiring of the others; the exit status
    /// stays 1
    #[arg(long, conflicts_with_all = ["all", "limit", "count", "proof"])]
    pub(crate) partial: bool,
    /// All wirings, best first
    #[arg(long, conflicts_with = "count")]
    pub(crate) all: bool,
    /// At most that many wirings, best first
    #[arg(long, value_name = "N", conflicts_with = "count")]
    pub(crate) limit: Option<u64>,
    /// The exact number of wirings
    #[arg(long)]
    pub(crate) count: bool,
    /// Move as few wires as possible from this earlier answer (JSON)
    #[arg(long, value_name = "WIRING")]
    pub(crate) keep: Option<PathBuf>,
    /// With --keep: refuse a wiring that moves more wires
    #[arg(long, value_name = "N", requires = "keep")]
    pub(crate) max_moves: Option<u32>,
    /// Let the wiring cost so much more than the cheapest if the parts then use fewer sides of
    /// connectors, or shorter runs of contacts
    #[arg(long, value_name = "N", default_value_t = 0, conflicts_with_all = ["any", "all", "limit", "count", "proof"])]
    pub(crate) neat: u32,
    /// Stop after that time with the best wiring so far and a bound for what may be missed
    #[arg(long, value_name = "SECONDS", value_parser = seconds, conflicts_with_all = ["all", "limit", "count"])]
    pub(crate) timeout: Option<f64>,
    /// Write a certificate beside the answer, for sensedsl-verify: that the wiring is valid and none
    /// is better, or that there is none. With `-` it is the result, in place of the answer
    #[arg(long, value_name = "FILE", conflicts_with_all = ["any", "all", "limit", "count"])]
    pub(crate) proof: Option<PathBuf>,
    /// With --proof: replace a file that is not a certificate
    #[arg(long, requires = "proof")]
    pub(crate) force: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum SolveFormat {
    /// A table for people
    #[default]
    Human,
    /// For scripts; one object a line with --all and --limit
    Json,
    /// For spreadsheets
    Csv,
    /// The wiring sheet
    Markdown,
    /// The wiring sheet as a page to print
    Html,
    /// A picture of the board
    Svg,
    /// A netlist for KiCad
    Kicad,
    /// A diagram for the simulator Wokwi
    Wokwi,
    /// The problem itself, as a program for SWI-Prolog
    Prolog,
    /// The problem itself, as a model for the Alloy Analyzer that confirms the answer
    Alloy,
}

#[derive(Debug, Default, Args)]
pub(crate) struct GenerateArgs {
    /// The file; - is the standard input
    pub(crate) file: PathBuf,
    /// The folder to write to
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) on: On,
    /// Only these host applications
    #[arg(long, value_name = "NAME", num_args = 1.., value_delimiter = ',', help = hosts())]
    pub(crate) host: Vec<String>,
    /// Everything but this
    #[arg(long, value_name = "PART", value_enum, num_args = 1.., value_delimiter = ',')]
    pub(crate) without: Vec<LeftOut>,
    /// Write nothing; exit 1 if the folder is not what would be written
    #[arg(long)]
    pub(crate) check: bool,
    /// Believe the folder's list of generated files, although this machine did not write it
    #[arg(long)]
    pub(crate) adopt: bool,
    /// Move as few wires as possible from this earlier answer (JSON)
    #[arg(long, value_name = "WIRING")]
    pub(crate) keep: Option<PathBuf>,
    /// Let the wiring cost so much more than the cheapest if the parts then use fewer sides of
    /// connectors, or shorter runs of contacts
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) neat: u32,
}

/// What `--host` takes.
fn hosts() -> String {
    let names: Vec<&str> = HOSTS.iter().map(|host| host.name()).collect();
    format!("Only these host applications: {}", names.join(", "))
}

/// What `generate` can leave out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LeftOut {
    /// The firmware
    Firmware,
    /// The host applications
    Host,
}

#[derive(Debug, Args)]
pub(crate) struct ExplainArgs {
    /// A code such as E0203, or the word `wiring` or `timing`; none lists all codes
    #[arg(add = names::subjects())]
    pub(crate) subject: Option<String>,
    /// With `wiring` and `timing`: the file
    pub(crate) file: Option<PathBuf>,
    /// With `wiring`: the name of a device or a chip
    pub(crate) device: Option<String>,
    /// With `wiring`: list every pin that could be, with its signal and what it would cost
    #[arg(long, requires = "device")]
    pub(crate) all: bool,
    #[command(flatten)]
    pub(crate) on: On,
    /// With `wiring`: let the wiring cost so much more than the cheapest if it is neater
    #[arg(long, value_name = "N", default_value_t = 0, requires = "device")]
    pub(crate) neat: u32,
    /// With `wiring` and `timing`: how to print it
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableFormat,
    /// With `wiring` and `timing`: stop after that time with what is known by then
    #[arg(long, value_name = "SECONDS", value_parser = seconds, requires = "file")]
    pub(crate) timeout: Option<f64>,
}

#[derive(Debug, Args)]
pub(crate) struct CapacityArgs {
    /// The file; - is the standard input
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) on: On,
    /// How to print it
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableFormat,
    /// Let the wires that are there move
    #[arg(long)]
    pub(crate) rearrange: bool,
    /// Stop after that time with what is known by then
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) timeout: Option<f64>,
}

#[derive(Debug, Args)]
pub(crate) struct DiffArgs {
    /// The wiring that is there: an answer in JSON, or a file to solve
    pub(crate) old: PathBuf,
    /// The wiring that it is to become: an answer in JSON, or a file to solve
    pub(crate) new: PathBuf,
    #[command(flatten)]
    pub(crate) on: On,
    /// How to print it
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableFormat,
}

#[derive(Debug, Args)]
pub(crate) struct BoardsArgs {
    /// A board: prints its table as CSV, or its picture
    #[arg(value_parser = BOARD, hide_possible_values = true)]
    pub(crate) name: Option<String>,
    /// How to print that board: its pins, or a picture of its contacts and what is free
    #[arg(long, value_enum, default_value_t, requires = "name")]
    pub(crate) format: BoardFormat,
    /// Only boards that have all of these words: "can usb 3v3", "nucleo dac", f411
    #[arg(long, value_name = "TEXT", conflicts_with = "name")]
    pub(crate) search: Option<String>,
}

/// How `boards NAME` prints a board.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum BoardFormat {
    /// Its table, to start one's own from
    #[default]
    Csv,
    /// A picture
    Svg,
}

#[derive(Debug, Args)]
pub(crate) struct DriversArgs {
    /// A driver, or what else its part is called: mpu6050, GY-521
    #[arg(value_parser = DRIVER, hide_possible_values = true)]
    pub(crate) name: Option<String>,
    /// Print a driver to begin with, for a part that the library does not have, with a board to try it on;
    /// `--kind` says how the part is connected: i2c unless you say, spi, uart, onewire, can, analog, digital, icu,
    /// encoder or pwm
    #[arg(long, value_name = "NAME", conflicts_with_all = ["name", "search"])]
    pub(crate) new: Option<String>,
    /// Print the driver itself, as the library has it: to learn from, or to begin with
    #[arg(long, requires = "name", conflicts_with = "format")]
    pub(crate) source: bool,
    /// Only drivers of this kind: i2c, uart, pwm
    #[arg(long, value_parser = kind(), conflicts_with = "name", hide_possible_values = true)]
    pub(crate) kind: Option<KindName>,
    /// Only drivers with these words in what is known of their part
    #[arg(long, value_name = "TEXT", conflicts_with = "name")]
    pub(crate) search: Option<String>,
    /// How to print it
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableFormat,
}

#[derive(Debug, Args)]
pub(crate) struct ImportArgs {
    /// A spreadsheet (CSV, XLSX, ODS), an MCU (XML) or project (.ioc) of CubeMX, a board of ArduPilot,
    /// Betaflight, Zephyr, MicroPython or an Arduino core, messages of CAN (.dbc); - is the standard
    /// input
    pub(crate) source: PathBuf,
    /// Where to write the result; the table of a project goes beside it, as .csv
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Replace files that exist
    #[arg(long, requires = "output")]
    pub(crate) force: bool,
    /// What the source is
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: ImportFormat,
    /// The sheet of a workbook
    #[arg(long, value_name = "NAME")]
    pub(crate) sheet: Option<String>,
    /// Of messages of CAN take the place of this node: what it sends become actuators, what it
    /// receives sensors; without it everything becomes a sensor
    #[arg(long, value_name = "NAME")]
    pub(crate) node: Option<String>,
    /// Of a project print the table of its pins, not the file with its devices
    #[arg(long)]
    pub(crate) table: bool,
    #[command(flatten)]
    pub(crate) reach: Reach,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum ImportFormat {
    /// By its content
    #[default]
    Auto,
    /// A table as text, a row a pin or a row a signal
    Csv,
    /// A workbook of Excel
    Xlsx,
    /// A workbook of LibreOffice
    Ods,
    /// An MCU of CubeMX
    Cubemx,
    /// A project of CubeMX
    Ioc,
    /// A board of ArduPilot
    Hwdef,
    /// Alternate functions of MicroPython, or the pins of one of its boards
    Micropython,
    /// A flight controller of Betaflight: a dump of its resources, or its config.h
    Betaflight,
    /// A board or an overlay of Zephyr
    Zephyr,
    /// A variant of an Arduino core: its header, or PeripheralPins.c
    Arduino,
    /// Messages of a CAN bus
    Dbc,
}

#[derive(Debug, Args)]
pub(crate) struct FmtArgs {
    /// The files, changed in place; - reads the standard input and prints
    #[arg(required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Change nothing; exit 1 if a file is not laid out canonically, or with --ids lacks identifiers
    #[arg(long)]
    pub(crate) check: bool,
    /// Write the identifiers that the tool gives by itself into files without mistakes
    #[arg(long)]
    pub(crate) ids: bool,
    /// Write what a file of an older version meant: bare numbers for devices with a scale were codes, and
    /// get `raw` before them. For once; the numbers of a file of today mean what is shown
    #[arg(long)]
    pub(crate) migrate: bool,
    #[command(flatten)]
    pub(crate) reach: Reach,
}

#[derive(Debug, Args)]
pub(crate) struct CompletionsArgs {
    /// The shell
    pub(crate) shell: clap_complete::Shell,
}

#[derive(Debug, Args)]
pub(crate) struct ManArgs {
    /// The folder for one page a command
    pub(crate) dir: Option<PathBuf>,
}

/// The name of a kind.
fn kind() -> impl TypedValueParser<Value = KindName> {
    PossibleValuesParser::new(KindName::wired().map(KindName::name))
        .try_map(|word| KindName::from_name(&word).ok_or("not a kind"))
}
