//! The place to which the path of an output folder leads through links.
//!
//! A link that the user made is followed. One that came with a project must not lead the output out
//! of it. The two look alike, so a link within the project, or within the program's working folder,
//! must stay below the folder that contains it.

use std::fs;
use std::path::{Path, PathBuf};

use crate::files::real_folder;

/// A link that leads elsewhere.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Away {
    pub(crate) link: PathBuf,
    pub(crate) target: PathBuf,
}

/// The first link on the way to an output folder that leads out of its own folder.
pub(super) fn leads_away(output: &Path, project: &Path) -> Option<Away> {
    let within = [real_folder(Path::new("")), real_folder(project)];
    let mut ways: Vec<&Path> = output.ancestors().filter(|way| *way != Path::new("")).collect();
    ways.reverse();
    ways.into_iter().find_map(|link| {
        if !fs::symlink_metadata(link).is_ok_and(|found| found.is_symlink()) {
            return None;
        }
        let stands_in = real_folder(link.parent().unwrap_or(Path::new("")));
        let target = fs::canonicalize(link).ok()?;
        let is_theirs = within.iter().any(|folder| stands_in.starts_with(folder));
        let leaves = !target.starts_with(&stands_in);
        (is_theirs && leaves).then(|| Away { link: link.to_path_buf(), target })
    })
}
