//! The arguments that several commands have: words of the command line in, their values out.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::names;

/// Which files may be read beside the one that is named.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct Reach {
    /// Let files name others in this folder, too, not only in their project's folder
    #[arg(long, value_name = "FOLDER")]
    pub(crate) allow_outside: Vec<PathBuf>,
}

/// Which board and target to solve for.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct On {
    /// A board table or built-in board that wins over what the file says
    #[arg(long, value_name = "TABLE", add = names::boards_and_tables())]
    pub(crate) board: Option<String>,
    /// What the wiring is for: chibios, embassy, arduino, one with its version, or none for the pins alone
    #[arg(long, value_name = "NAME", add = names::targets())]
    pub(crate) target: Option<String>,
    #[command(flatten)]
    pub(crate) reach: Reach,
}

impl On {
    /// The board and the target in the session's form.
    pub(crate) fn asked(&self) -> sensedsl_session::On<'_> {
        sensedsl_session::On { board: self.board.as_deref(), target: self.target.as_deref() }
    }
}

/// For people or for scripts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum TableFormat {
    /// A table for people
    #[default]
    Human,
    /// For scripts
    Json,
}

/// A number of seconds that a clock can be set to.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    const SECONDS_MAX: f64 = 1e6;
    match text.parse::<f64>() {
        Ok(seconds) if (0.0..=SECONDS_MAX).contains(&seconds) => Ok(seconds),
        Ok(_) | Err(_) => Err("a time in seconds from 0 to 1000000, such as 2.5".into()),
    }
}
