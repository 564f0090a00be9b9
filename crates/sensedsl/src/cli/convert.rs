//! The arguments of `convert`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::common::seconds;

#[derive(Debug, Args)]
pub(crate) struct ConvertArgs {
    /// A record that `monitor --record` has written
    pub(crate) record: PathBuf,
    /// Write to that file; its ending (csv, ndjson, parquet, html) says the form unless --to does
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// The form; CSV unless you say
    #[arg(long, value_enum, value_name = "FORM")]
    pub(crate) to: Option<ConvertTo>,
    /// Say how regularly and how late the values of each device came, in place of converting them
    #[arg(long, conflicts_with_all = ["to", "device"])]
    pub(crate) summary: bool,
    /// That board alone
    #[arg(long, value_name = "NAME")]
    pub(crate) board: Option<String>,
    /// That device alone; several times for several
    #[arg(long, value_name = "NAME")]
    pub(crate) device: Vec<String>,
    /// From that second of the run on
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) from: Option<f64>,
    /// Before that second of the run
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) until: Option<f64>,
    /// Replace a file that is there
    #[arg(long)]
    pub(crate) force: bool,
}

/// The form of a converted record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ConvertTo {
    /// A row for each value
    Csv,
    /// CSV with a row for each moment and a column for each device
    Wide,
    /// A JSON object for each value, one a line
    Ndjson,
    /// A table for pandas, Polars, `DuckDB`
    Parquet,
    /// A page with plots and the summary
    Html,
}
