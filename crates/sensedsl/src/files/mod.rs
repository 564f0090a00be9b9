//! The machine's files: reading, writing, and the names under which people see them.
//!
//! `read` reads. `write` writes single files, `tree` whole folders, both in such a way that a run
//! which is stopped at any moment leaves nothing half done. `ops` has the changes of which writing
//! a tree consists, `lock` keeps two runs apart, and `state` knows what this machine has written. `growing` is a
//! file that is written while the program runs, `record` opens one.

#[cfg(test)]
mod fault;
mod growing;
pub(crate) mod lock;
mod open;
mod ops;
mod read;
mod record;
pub(crate) mod state;
pub(crate) mod tree;
mod write;

use std::path::Path;

use sensedsl_diagnostics::{Diagnostic, SourceMap, Span};
use sensedsl_model::{FileRequest, FileUse, ReadError};

pub(crate) use growing::Growing;
pub(crate) use read::{Disk, files_below, read_if_there, real_folder};
pub(crate) use record::{RecordFile, no_record, open_record};
pub(crate) use write::{
    begins_with, is_in_the_way, is_part_of, is_stream, remove_file, write_streamed, write_together,
    write_whole,
};

/// The name under which people see a file: with `/` on every system, as designs and generated files write it.
pub(crate) fn shown(path: impl AsRef<Path>) -> String {
    let path = path.as_ref();
    let name = path.display().to_string();
    if path == Path::new("-") {
        "<stdin>".into()
    } else if cfg!(windows) {
        plain(&name)
    } else {
        name
    }
}

/// A path of Windows as people write it there: without the prefix of absolute paths that the system gives back.
fn plain(name: &str) -> String {
    name.strip_prefix(r"\\?\").unwrap_or(name).replace('\\', "/")
}

/// A file from the command line that was not read, as an error with its diagnostic.
#[derive(Debug)]
pub(crate) struct Refused {
    pub(crate) diagnostic: Box<Diagnostic>,
    pub(crate) sources: SourceMap,
}

impl Refused {
    /// Makes the error for a problem with the whole file.
    pub(crate) fn new(path: &Path, report: impl FnOnce(Span, &str) -> Diagnostic) -> Self {
        let (shown, mut sources) = (shown(path), SourceMap::default());
        let file = sources.add(shown.as_str(), "");
        let diagnostic = Box::new(report(Span::new(file, 0..0), &shown));
        Self { diagnostic, sources }
    }

    /// Reports that a file was not read.
    pub(crate) fn unread(path: &Path, what: FileUse, unread: &ReadError) -> Self {
        Self::new(path, |at, shown| {
            unread.diagnostic(at, &FileRequest { path: shown, what, by_user: true })
        })
    }
}

impl std::fmt::Display for Refused {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.diagnostic.message)
    }
}

impl std::error::Error for Refused {}

/// The contents of a file that the command line names.
pub(crate) fn read_bytes(path: &Path, what: FileUse) -> Result<Vec<u8>, Refused> {
    read::read(path, what, true).map_err(|unread| Refused::unread(path, what, &unread))
}

/// The text of a file that the command line names.
pub(crate) fn read_text(path: &Path, what: FileUse) -> Result<String, Refused> {
    read::text(read_bytes(path, what)?).map_err(|unread| Refused::unread(path, what, &unread))
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn paths_of_windows_are_written_one_way() {
        assert_eq!(plain(r"\\?\C:\robot\car.sense"), "C:/robot/car.sense");
        assert_eq!(plain(r"build/firmware\Rover\Makefile"), "build/firmware/Rover/Makefile");
    }
}
