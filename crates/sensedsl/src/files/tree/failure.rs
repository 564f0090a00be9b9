//! Why an output folder was not written: what stopped a run in, what its command has to say about the folder out.

use std::io;
use std::path::PathBuf;

use super::away::Away;
use crate::files::lock::NoLock;

/// The reason why a tree was not written, or not completely.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The folder is as it was.
    Before(io::Error),
    /// The next run completes it.
    After(io::Error),
}

/// The reason why a folder cannot be written at all.
#[derive(Debug)]
pub(crate) enum Trouble {
    /// Another run is writing it.
    Busy,
    /// The disk is full, or does not allow writing there.
    Unwritten(io::Error),
    /// An earlier run left something here that no longer belongs to anything.
    #[cfg_attr(
        not(target_os = "linux"),
        allow(dead_code, reason = "only Linux exchanges two names at once")
    )]
    Orphan(PathBuf),
    /// It looks like an unfinished run, but not one of this machine.
    Strange(PathBuf),
    /// The folder is reached through a link that leads elsewhere.
    Linked(Away),
    /// Something that an earlier run left can be neither completed nor removed now.
    Unrecovered(io::Error),
    /// Something is wrong with the machine.
    Failed(anyhow::Error),
}

impl From<NoLock> for Trouble {
    fn from(why: NoLock) -> Self {
        match why {
            NoLock::Busy => Self::Busy,
            NoLock::Failed(error) => Self::Unwritten(error),
            NoLock::Strange(what) => Self::Strange(what),
        }
    }
}

impl From<anyhow::Error> for Trouble {
    fn from(error: anyhow::Error) -> Self {
        Self::Failed(error)
    }
}
