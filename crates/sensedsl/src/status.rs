//! How a command ended: its result in, the exit status of the program out.
//!
//! Every command and `main` need it, so that neither is built on the other.

use std::process::ExitCode;

/// The result of a command, if nothing went wrong with the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Status {
    /// Exit status 0.
    Done,
    /// Exit status 1.
    Wrong,
    /// Exit status 2.
    Misused,
}

/// A command has ended early, and has reported the reason.
#[derive(Debug)]
pub(crate) struct Reported(pub(crate) Status);

impl std::fmt::Display for Reported {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("what is wrong was told before")
    }
}

impl std::error::Error for Reported {}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        match status {
            Status::Done => Self::SUCCESS,
            Status::Wrong => Self::from(1),
            Status::Misused => Self::from(2),
        }
    }
}
