//! The texts of the repository, for tests of features that must be right in all of them.
#![expect(clippy::disallowed_methods, reason = "a test reads its data")]

use std::fs;
use std::path::{Path, PathBuf};

use sensedsl_model::{FileRequest, Files, ReadError};

/// A folder of the repository.
pub(crate) fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name).canonicalize().unwrap()
}

/// The files of a folder with that ending, in order, with their texts.
pub(crate) fn texts(name: &str, ending: &str) -> Vec<(String, String)> {
    let entries = fs::read_dir(folder(name)).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|one| one == ending)).collect();
    files.sort();
    let read = |path: PathBuf| {
        let text = fs::read(&path).unwrap();
        (path.to_str().unwrap().to_owned(), String::from_utf8_lossy(&text).into_owned())
    };
    files.into_iter().map(read).collect()
}

/// All good texts.
pub(crate) fn good() -> Vec<(String, String)> {
    let all = ["examples", "tests/corpus/ok", "tests/robots", "tests/firmware/designs"];
    all.into_iter().flat_map(|name| texts(name, "sense")).collect()
}

/// The files of the disk.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Disk;

impl Files for Disk {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        fs::read_to_string(wanted.path).map_err(|_| ReadError::Missing)
    }
}

/// Whether all texts are wanted, which takes minutes: other runs take a sample of them.
pub(crate) fn is_exhaustive() -> bool {
    std::env::var("SENSEDSL_THOROUGH").as_deref() == Ok("2")
}

/// All of them in an exhaustive run, otherwise one of so many.
pub(crate) fn some<T>(all: Vec<T>, step: usize) -> impl Iterator<Item = T> {
    all.into_iter().step_by(if is_exhaustive() { 1 } else { step })
}
