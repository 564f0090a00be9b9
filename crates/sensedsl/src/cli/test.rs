//! The arguments of `test`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::common::Reach;
use super::names;

#[derive(Debug, Args)]
pub(crate) struct TestArgs {
    /// The file; worlds are beside it
    pub(crate) file: PathBuf,
    /// The tests to run; all of them unless you name some
    pub(crate) names: Vec<String>,
    /// Where the boards run: soft, in this program; image, the one that `build` made, on an emulated MCU,
    /// or the path of one; or the port of a real board (/dev/ttyACM0, tcp:HOST:PORT)
    #[arg(long, value_name = "WHERE", default_value = "soft")]
    pub(crate) on: String,
    /// The rate of a serial link to a real board; as the file says unless you do
    #[arg(long, value_name = "RATE")]
    pub(crate) baud: Option<u32>,
    /// How to print what came of it
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: TestFormat,
    /// The folder of the board's firmware, whose `user` has the code of controllers, or one with such a
    /// folder for each board; build/firmware beside the file unless you say
    #[arg(long, value_name = "FOLDER")]
    pub(crate) code: Option<PathBuf>,
    /// What chance begins with; wins over the tests and their worlds
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
    /// Draw the signals around the first rule that did not hold (SVG)
    #[arg(long, value_name = "FILE")]
    pub(crate) picture: Option<PathBuf>,
    /// What the wiring is for: chibios or embassy; as the file says unless you do
    #[arg(long, value_name = "NAME", add = names::targets())]
    pub(crate) target: Option<String>,
    #[command(flatten)]
    pub(crate) reach: Reach,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum TestFormat {
    /// For people
    #[default]
    Human,
    /// For scripts
    Json,
    /// `JUnit` XML, a suite for each test and a case for each rule, for build servers
    Junit,
}
