//! Generated files before they are written: paths and contents, and the printing of templates. No disk access.
//!
//! # Example
//!
//! ```
//! use sensedsl_files::FileSet;
//!
//! let mut board = FileSet::default();
//! board.add("generated/sense_hw.c", "/* pins */\n");
//! board.add_once("user/user.c", "/* yours */\n");
//! let mut project = FileSet::default();
//! project.merge_under("firmware/Rover", board);
//!
//! let files: Vec<_> = project.iter().map(|(path, file)| (path, file.once)).collect();
//! assert_eq!(
//!     files,
//!     [("firmware/Rover/generated/sense_hw.c", false), ("firmware/Rover/user/user.c", true)]
//! );
//! ```

mod fileset;
mod template;

pub use fileset::{FileEntry, FileSet};
pub use template::{block, print};
