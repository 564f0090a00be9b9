//! How library code reads files: which file is wanted and why, and its text or the reason why it
//! was not read.
//!
//! The caller of the library has access to the machine. It checks the path, what is at that path,
//! and the budgets, and answers with a text or an [`ReadError`]. The diagnostic is the same for all
//! callers.

use sensedsl_diagnostics::codes::{
    e0111_file_unreadable, e0112_file_too_large, e0118_not_a_file, e0218_used_file_missing,
    e0223_outside_folder, e0302_table_unreadable,
};
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_limits::{
    ANSWER_BYTES_MAX, CONFIG_BYTES_MAX, IMAGE_BYTES_MAX, SENSE_BYTES_MAX, SOURCE_BYTES_MAX,
    TABLE_BYTES_MAX, TOTAL_BYTES_MAX, WORLD_BYTES_MAX,
};

/// How library code reads files; provided by the binary or by a test.
pub trait Files {
    /// The text of a file.
    ///
    /// # Errors
    /// Why the file was not read.
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError>;
}

/// Reads nothing: every file that is not open is missing.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _: &FileRequest<'_>) -> Result<String, ReadError> {
        Err(ReadError::Missing)
    }
}

/// A requested file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileRequest<'a> {
    /// Its path, as seen from the working directory.
    pub path: &'a str,
    /// What the file is used for.
    pub what: FileUse,
    /// True if the command line names it, not a file: it may be anywhere, and may be a pipe.
    pub by_user: bool,
}

/// What a file is used for, which decides how large it may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileUse {
    /// A text in the language.
    Sense,
    /// A board table.
    Table,
    /// An earlier answer of `solve`.
    Answer,
    /// A file that `import` reads.
    Source,
    /// A world for `simulate`, or samples of one.
    World,
    /// An image of firmware.
    Image,
    /// A generated `schema.json`.
    Schema,
    /// A configuration of `monitor`.
    Config,
}

impl FileUse {
    /// Most bytes that are read.
    #[must_use]
    pub const fn bytes_max(self) -> usize {
        match self {
            Self::Sense => SENSE_BYTES_MAX,
            Self::Table => TABLE_BYTES_MAX,
            Self::Answer => ANSWER_BYTES_MAX,
            Self::Source => SOURCE_BYTES_MAX,
            Self::World => WORLD_BYTES_MAX,
            Self::Image => IMAGE_BYTES_MAX,
            // As much as an answer: both have an entry for each device.
            Self::Schema => ANSWER_BYTES_MAX,
            Self::Config => CONFIG_BYTES_MAX,
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Sense => "a `.sense` file",
            Self::Table => "a board table",
            Self::Answer => "an answer of `solve`",
            Self::Source => "a source of `import`",
            Self::World => "a world, or samples of one",
            Self::Image => "an image of firmware",
            Self::Schema => "a `schema.json`",
            Self::Config => "a configuration of `monitor`",
        }
    }
}

/// Why a file was not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReadError {
    /// There is no such file.
    Missing,
    /// The system's reason, in words.
    Why(String),
    /// What is at the path instead of a file: `a pipe`.
    NotAFile(&'static str),
    /// It has more bytes than [`FileUse::bytes_max`].
    TooLarge,
    /// All files together have too many bytes.
    AllTooLarge,
    /// It is outside the project's folder, which is this one.
    Outside(String),
}

impl From<&str> for ReadError {
    fn from(why: &str) -> Self {
        Self::Why(why.to_owned())
    }
}

impl ReadError {
    /// The reason in words.
    #[must_use]
    pub fn why(&self) -> String {
        match self {
            Self::Missing => "there is no such file".to_owned(),
            Self::Why(why) => why.clone(),
            Self::NotAFile(what) => format!("it is {what}, not a file"),
            Self::TooLarge => "it is too large".to_owned(),
            Self::AllTooLarge => {
                format!("all files of one call have at most {} MiB", TOTAL_BYTES_MAX >> 20)
            }
            Self::Outside(_) => "it is outside of the project's folder".to_owned(),
        }
    }

    /// The diagnostic, at the place that names the file.
    pub fn diagnostic(&self, at: Span, wanted: &FileRequest<'_>) -> Diagnostic {
        let FileRequest { path, what, by_user } = *wanted;
        match (self, what) {
            (Self::NotAFile(found), _) if !by_user => e0118_not_a_file::not_a_file(at, path, found),
            (Self::TooLarge, what) => {
                e0112_file_too_large::file_too_large(at, path, what.name(), what.bytes_max())
            }
            (Self::AllTooLarge, _) => {
                e0112_file_too_large::all_too_large(at, path, TOTAL_BYTES_MAX)
            }
            (Self::Outside(folder), _) => e0223_outside_folder::outside_folder(at, path, folder),
            (_, FileUse::Table) => e0302_table_unreadable::table_unreadable(at, path, &self.why()),
            (_, FileUse::Sense) if !by_user => {
                e0218_used_file_missing::used_file_missing(at, path, &self.why())
            }
            (_, _) => e0111_file_unreadable::file_unreadable(at, path, &self.why()),
        }
    }
}

/// Whether a path stays inside a folder, judging by its text: it is relative, and no `..` leads
/// out. Only the machine knows where symbolic links lead.
#[must_use]
pub fn stays_inside(relative: &str) -> bool {
    if relative.starts_with(['/', '\\']) || relative.get(1..2) == Some(":") {
        return false;
    }
    let mut depth = 0_usize;
    relative.split(['/', '\\']).all(|part| match part {
        "" | "." => true,
        ".." => {
            let inside = depth > 0;
            depth = depth.saturating_sub(1);
            inside
        }
        _ => {
            depth += 1;
            true
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_that_lead_out_are_told() {
        for inside in ["a.sense", "./a", "a/../b", "a/b/../../c", "..a", "a//b"] {
            assert!(stays_inside(inside), "{inside}");
        }
        for outside in ["../a", "a/../../b", "/etc/passwd", "C:\\a", "a\\..\\..\\b", "\\\\host\\a"]
        {
            assert!(!stays_inside(outside), "{outside}");
        }
    }
}
