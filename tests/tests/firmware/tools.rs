//! Folders of the firmware's tests.

use std::path::{Path, PathBuf};

/// An empty folder for this test.
pub(crate) fn scratch(name: &str) -> PathBuf {
    empty(&format!("firmware/{name}"))
}

/// An empty folder that stays after the run.
pub(crate) fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}
