//! Texts that are part of a program and take little room in it.
//!
//! Paths and texts go in when a package is built: [`pack`] deflates them, and with the feature
//! `build` a build script reads them from folders of its package. Out come the texts in the program,
//! each by its path. Texts that are alike deflate well together, so they are packed in groups; a
//! group is inflated when one of its texts is first asked for, and stays.
//!
//! # Example
//!
//! ```
//! use sensedsl_packed::{Pack, pack};
//!
//! let files = [("a/one.txt".to_owned(), "1".to_owned()), ("a/two.txt".to_owned(), "2".to_owned())];
//! // A program has the bytes by `include_bytes!`.
//! let bytes: &'static [u8] = pack(files.to_vec()).leak();
//! static PACK: std::sync::OnceLock<Pack> = std::sync::OnceLock::new();
//! let pack = PACK.get_or_init(|| Pack::new(bytes));
//! assert_eq!(pack.text("a/two.txt"), "2");
//! assert_eq!(pack.folder("a").count(), 2);
//! ```

#[cfg(feature = "build")]
mod build;
mod format;

use std::sync::OnceLock;

#[cfg(feature = "build")]
pub use build::{build, copy_deflated};
pub use format::pack;
use format::{Group, folder_of};

/// Packed texts.
#[derive(Debug)]
pub struct Pack {
    bytes: &'static [u8],
    groups: OnceLock<Vec<Group>>,
}

impl Pack {
    /// The texts of what [`pack`] made. Damaged bytes have none, or not all.
    #[must_use]
    pub const fn new(bytes: &'static [u8]) -> Self {
        Self { bytes, groups: OnceLock::new() }
    }

    /// The text of a path; an empty one if there is no such path.
    #[must_use]
    pub fn text(&self, path: &str) -> &'static str {
        let groups = self.groups();
        let after = groups.partition_point(|group| group.first <= path);
        let files = after.checked_sub(1).and_then(|at| groups.get(at)).map(Group::files);
        let files = files.unwrap_or_default();
        let found = files.binary_search_by_key(&path, |(path, _)| path);
        found.ok().and_then(|at| files.get(at)).map_or("", |(_, text)| text)
    }

    /// The paths and texts below a folder, in the order of the paths.
    pub fn folder(&self, folder: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
        let folder = folder_of(folder);
        let groups = self.groups().iter().filter(move |group| folder_of(group.first) == folder);
        groups.flat_map(Group::files).copied()
    }

    fn groups(&self) -> &[Group] {
        self.groups.get_or_init(|| format::groups(self.bytes).unwrap_or_default())
    }
}
