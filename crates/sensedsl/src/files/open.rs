//! Opening of files to read. In: a path. Out: a regular file, or a pipe if the user names one.
//!
//! The entry at the path is checked before it is opened, because opening a device can have effects, and again after
//! that, because it may have changed in between. Nothing here waits for long: a pipe that has no writer is refused
//! after a moment.

use std::fs::{self, File, FileType};
use std::io::{self, Read};
use std::path::Path;

use sensedsl_model::ReadError;

use super::read::why;

/// A file that was opened.
pub(super) struct Opened {
    pub(super) file: File,
    /// The bytes that were read from a pipe to see whether somebody writes to it.
    head: Vec<u8>,
}

impl Opened {
    /// The contents from the start.
    pub(super) fn reader(self) -> impl Read {
        io::Cursor::new(self.head).chain(self.file)
    }
}

/// Opens a file for reading; a pipe only if the user names it.
pub(super) fn open(path: &Path, by_user: bool) -> Result<Opened, ReadError> {
    readable(fs::metadata(path).map_err(|error| why(&error))?.file_type(), by_user)?;
    let file = open_at_once(path).map_err(|error| why(&error))?;
    let kind = file.metadata().map_err(|error| why(&error))?.file_type();
    readable(kind, by_user)?;
    if kind.is_file() { Ok(Opened { file, head: Vec::new() }) } else { pipe(file) }
}

/// Refuses anything that is neither a file nor a pipe named by the user.
fn readable(kind: FileType, by_user: bool) -> Result<(), ReadError> {
    match () {
        () if kind.is_file() || (by_user && is_pipe(kind)) => Ok(()),
        () if kind.is_dir() => Err(ReadError::NotAFile("a folder")),
        () if is_pipe(kind) => Err(ReadError::NotAFile("a pipe")),
        () => Err(ReadError::NotAFile("a device")),
    }
}

#[cfg(unix)]
fn is_pipe(kind: FileType) -> bool {
    std::os::unix::fs::FileTypeExt::is_fifo(&kind)
}

#[cfg(not(unix))]
fn is_pipe(_: FileType) -> bool {
    false
}

/// Opens a file without waiting.
#[cfg(unix)]
fn open_at_once(path: &Path) -> io::Result<File> {
    use std::os::unix::fs::OpenOptionsExt as _;

    let flags = rustix::fs::OFlags::NONBLOCK | rustix::fs::OFlags::NOCTTY;
    let mut options = fs::OpenOptions::new();
    options.read(true).custom_flags(flags.bits().cast_signed());
    options.open(path)
}

#[cfg(not(unix))]
fn open_at_once(path: &Path) -> io::Result<File> {
    File::open(path)
}

/// Waits a moment for a program that writes to a pipe; from then on, reading waits for that program.
#[cfg(unix)]
fn pipe(mut file: File) -> Result<Opened, ReadError> {
    use rustix::event::{PollFd, PollFlags, Timespec, poll};

    const WAIT: Timespec = Timespec { tv_sec: 0, tv_nsec: 500_000_000 };
    poll(&mut [PollFd::new(&file, PollFlags::IN)], Some(&WAIT))
        .map_err(|error| why(&error.into()))?;
    let mut head = vec![0];
    match file.read(&mut head) {
        // Only our end of it is open.
        Ok(0) => return Err(ReadError::NotAFile("a pipe to which no program writes")),
        Ok(_) => {}
        // A program has it open and has not written yet.
        Err(error) if error.kind() == io::ErrorKind::WouldBlock => head.clear(),
        Err(error) => return Err(why(&error)),
    }
    rustix::fs::fcntl_setfl(&file, rustix::fs::OFlags::empty())
        .map_err(|error| why(&error.into()))?;
    Ok(Opened { file, head })
}

#[cfg(not(unix))]
fn pipe(file: File) -> Result<Opened, ReadError> {
    Ok(Opened { file, head: Vec::new() })
}
