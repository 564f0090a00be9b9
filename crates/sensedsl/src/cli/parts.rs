//! The arguments of `parts`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::common::{Reach, TableFormat, seconds};
use super::names;

#[derive(Debug, Args)]
pub(crate) struct PartsArgs {
    /// The file; - is the standard input
    #[arg(conflicts_with_all = ["list", "table"])]
    pub(crate) file: Option<PathBuf>,
    /// List the parts instead, or those with these words in their numbers or package
    #[arg(long, value_name = "SEARCH", num_args = 0..=1, add = names::parts())]
    pub(crate) list: Option<Option<String>>,
    /// Print the table of a part as CSV instead
    #[arg(long, value_name = "PART", conflicts_with = "list", add = names::parts())]
    pub(crate) table: Option<String>,
    /// Print the target profile of a part instead, with the other parts of its family
    #[arg(long, value_name = "PART", conflicts_with_all = ["file", "list", "table"], add = names::parts())]
    pub(crate) profile: Option<String>,
    /// Compare with this part or board instead: which wires move, and what there is more or less room for
    #[arg(long, value_name = "PART", requires = "file", conflicts_with_all = ["list", "table",
        "family", "package", "max_pins", "core", "min_flash", "min_ram", "sort", "limit", "timeout"], add = names::boards_and_parts())]
    pub(crate) against: Option<String>,
    /// Only parts of this family: STM32F4, G0, RP2040
    #[arg(long)]
    pub(crate) family: Option<String>,
    /// Only parts in this package: LQFP, LQFP48, 48
    #[arg(long)]
    pub(crate) package: Option<String>,
    /// Only parts with at most that many contacts
    #[arg(long, value_name = "N")]
    pub(crate) max_pins: Option<u32>,
    /// Only parts with this core: M0+, Cortex-M4, AVR8
    #[arg(long)]
    pub(crate) core: Option<String>,
    /// Only parts with at least so many KB of flash; flash beside the part is as large as you like
    #[arg(long, value_name = "KB")]
    pub(crate) min_flash: Option<usize>,
    /// Only parts with at least so many KB of RAM
    #[arg(long, value_name = "KB")]
    pub(crate) min_ram: Option<usize>,
    /// What comes first; into a file or a pipe the rows of a file are written as they are found unless
    /// you ask for an order
    #[arg(long, value_enum)]
    pub(crate) sort: Option<PartsOrder>,
    /// Print so many at most
    #[arg(long, value_name = "N", requires = "file")]
    pub(crate) limit: Option<usize>,
    /// Stop after that time with those found so far; so does Ctrl-C
    #[arg(long, value_name = "SECONDS", value_parser = seconds, requires = "file")]
    pub(crate) timeout: Option<f64>,
    /// What the wiring is for: chibios, chibios-21.11, or none for the pins alone
    #[arg(long, value_name = "NAME", add = names::targets())]
    pub(crate) target: Option<String>,
    #[command(flatten)]
    pub(crate) reach: Reach,
    /// How to print it
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TableFormat,
}

/// What comes first among parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PartsOrder {
    /// The cheapest wiring
    Cost,
    /// The fewest contacts
    Pins,
    /// The least flash; parts whose flash is beside them come last
    Flash,
    /// The least RAM
    Ram,
}
