//! Existing files are not replaced unless requested: the code shared by `import`, `new` and
//! `solve --proof`.

use std::path::Path;

use anyhow::Result;
use sensedsl_diagnostics::codes::e0508_file_exists;
use sensedsl_diagnostics::{Diagnostic, SourceMap, Span};

use crate::files::{is_in_the_way, shown};
use crate::terminal::Terminal;

/// Reports which of these files exist and would be lost; returns whether there are any.
pub(crate) fn refuse(files: &[(&Path, &[u8])], by: &str, terminal: &Terminal) -> Result<bool> {
    let mut refused = false;
    for (path, bytes) in files {
        if is_in_the_way(path, bytes)? {
            say(path, by, terminal)?;
            refused = true;
        }
    }
    Ok(refused)
}

/// Reports that this file exists.
pub(crate) fn say(path: &Path, by: &str, terminal: &Terminal) -> Result<()> {
    show(path, terminal, |at| e0508_file_exists::file_exists(at, &shown(path), by))
}

/// Reports that this folder has a file in it.
pub(crate) fn say_not_empty(folder: &Path, file: &Path, terminal: &Terminal) -> Result<()> {
    show(folder, terminal, |at| {
        e0508_file_exists::folder_not_empty(at, &shown(folder), &shown(file))
    })
}

fn show(path: &Path, terminal: &Terminal, why: impl FnOnce(Span) -> Diagnostic) -> Result<()> {
    let mut sources = SourceMap::default();
    // The place is the file itself; its contents do not matter here.
    let at = Span::new(sources.add(shown(path), ""), 0..0);
    Ok(terminal.diagnostics(&[why(at)], &sources)?)
}
