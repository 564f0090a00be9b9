//! The files that a target generates: paths and contents, without a disk.

use std::collections::BTreeMap;

/// One file to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileEntry {
    /// The content.
    pub bytes: Vec<u8>,
    /// True for a user's file: created if absent, never changed again.
    pub once: bool,
}

/// Files by their path relative to the output directory, with `/` as the separator.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FileSet {
    files: BTreeMap<String, FileEntry>,
}

impl FileSet {
    /// Adds a generated file. Two files with the same path are a mistake of the caller: the later one wins.
    pub fn add(&mut self, path: impl Into<String>, text: impl Into<String>) {
        let bytes = text.into().into_bytes();
        self.files.insert(path.into(), FileEntry { bytes, once: false });
    }

    /// Adds a file that belongs to the user once it exists.
    pub fn add_once(&mut self, path: impl Into<String>, text: impl Into<String>) {
        let bytes = text.into().into_bytes();
        self.files.insert(path.into(), FileEntry { bytes, once: true });
    }

    /// Adds the files of `other` below the folder `prefix`.
    pub fn merge_under(&mut self, prefix: &str, other: Self) {
        for (path, entry) in other.files {
            self.files.insert(format!("{prefix}/{path}"), entry);
        }
    }

    /// All files in path order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &FileEntry)> {
        self.files.iter().map(|(path, entry)| (path.as_str(), entry))
    }

    /// The file at `path`.
    #[must_use]
    pub fn get(&self, path: &str) -> Option<&FileEntry> {
        self.files.get(path)
    }

    /// The number of files.
    #[must_use]
    pub fn len(&self) -> usize {
        self.files.len()
    }

    /// True if there are no files.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }
}
