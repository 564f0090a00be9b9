//! What a build script does: files of its package in, `files.pack` in the folder of its outputs out.

#![expect(clippy::disallowed_methods, reason = "build scripts read files and the environment")]
#![expect(clippy::print_stdout, reason = "build scripts tell cargo by printing what they read")]

use std::path::Path;
use std::{env, fs, io};

use crate::format::pack;

/// Packs the files with one of these endings below folders of the package. The program has them by
/// `include_bytes!(concat!(env!("OUT_DIR"), "/files.pack"))`.
///
/// # Errors
///
/// Fails if a file cannot be read, is no UTF-8, or the outcome cannot be written.
pub fn build(folders: &[&str], endings: &[&str]) -> io::Result<()> {
    let mut files = Vec::new();
    for folder in folders {
        println!("cargo::rerun-if-changed={folder}");
        below(folder, endings, &mut files)?;
    }
    let out = env::var_os("OUT_DIR").ok_or_else(|| io::Error::other("no OUT_DIR"))?;
    fs::write(Path::new(&out).join("files.pack"), pack(files))
}

/// All files of a folder and the folders in it: path within the package, and text.
fn below(folder: &str, endings: &[&str], files: &mut Vec<(String, String)>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let name = name.to_str().ok_or_else(|| io::Error::other("a name is no UTF-8"))?;
        let path = format!("{folder}/{name}");
        if entry.file_type()?.is_dir() {
            below(&path, endings, files)?;
        } else if endings.iter().any(|ending| has_ending(&path, ending)) {
            let text = fs::read_to_string(&path);
            let text =
                text.map_err(|error| io::Error::new(error.kind(), format!("{path}: {error}")));
            files.push((path, text?));
        }
    }
    Ok(())
}

fn has_ending(path: &str, ending: &str) -> bool {
    Path::new(path).extension().is_some_and(|known| known == ending)
}
