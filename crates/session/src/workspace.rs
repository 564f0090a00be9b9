//! Open files: edits in, snapshots out.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use sensedsl_diagnostics::{SourceMap, Span};
use sensedsl_model::{FileRequest, FileUse, Files, ReadError, Request, normal_path, resolve};

use crate::Snapshot;

/// What to read a file for. The default is the file's own board and the newest target.
#[derive(Clone, Copy, Debug, Default)]
pub struct On<'a> {
    /// A table or a built-in board that overrides the file's.
    pub board: Option<&'a str>,
    /// The target; none for the default.
    pub target: Option<&'a str>,
}

/// The open texts, by path. They override files with the same path.
#[derive(Clone, Debug, Default)]
pub struct Workspace {
    texts: BTreeMap<String, String>,
}

/// An edit at a place that is not in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EditOutOfRange {
    /// The file.
    pub path: String,
    /// The bytes that were to be replaced.
    pub range: Range<usize>,
}

impl fmt::Display for EditOutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { path, range } = self;
        write!(f, "{path} has no text at bytes {} to {}", range.start, range.end)
    }
}

impl std::error::Error for EditOutOfRange {}

impl Workspace {
    /// Opens a file with this text, or replaces the text of an open one.
    pub fn open(&mut self, path: &str, text: impl Into<String>) {
        self.texts.insert(normal_path(path), text.into());
    }

    /// Closes a file, so that its stored text counts again.
    pub fn close(&mut self, path: &str) {
        self.texts.remove(&normal_path(path));
    }

    /// The text of an open file.
    #[must_use]
    pub fn text(&self, path: &str) -> Option<&str> {
        self.texts.get(&normal_path(path)).map(String::as_str)
    }

    /// Replaces a range of bytes in an open file.
    ///
    /// # Errors
    /// The file is not open, or the range does not begin and end between two of its characters.
    pub fn edit(
        &mut self,
        path: &str,
        range: Range<usize>,
        with: &str,
    ) -> Result<(), EditOutOfRange> {
        let text = self.texts.get_mut(&normal_path(path));
        match text.filter(|text| text.get(range.clone()).is_some()) {
            Some(text) => {
                text.replace_range(range, with);
                Ok(())
            }
            None => Err(EditOutOfRange { path: path.to_owned(), range }),
        }
    }

    /// Reads a file, the files it uses and its tables: open texts first, everything else from
    /// `files`.
    #[must_use]
    pub fn snapshot(&self, path: &str, on: On<'_>, files: &dyn Files) -> Snapshot {
        let over = Overlay { workspace: self, files };
        let wanted = FileRequest { path, what: FileUse::Sense, by_user: true };
        match over.read(&wanted) {
            Ok(text) => {
                let request = Request { path, text: &text, board: on.board, target: on.target };
                Snapshot::new(resolve(&request, &over))
            }
            Err(unread) => {
                let mut sources = SourceMap::default();
                let at = Span::new(sources.add(path, ""), 0..0);
                Snapshot::unread(unread.diagnostic(at, &wanted), sources)
            }
        }
    }
}

/// Files with the open texts in front of them.
struct Overlay<'a> {
    workspace: &'a Workspace,
    files: &'a dyn Files,
}

impl Files for Overlay<'_> {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        match self.workspace.text(wanted.path) {
            Some(text) if text.len() > wanted.what.bytes_max() => Err(ReadError::TooLarge),
            Some(text) => Ok(text.to_owned()),
            None => self.files.read(wanted),
        }
    }
}
