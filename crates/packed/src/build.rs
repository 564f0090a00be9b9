//! What a build script does: files of its package in, `files.pack` in the folder of its outputs out.

#![expect(clippy::disallowed_methods, reason = "build scripts read files and the environment")]
#![expect(clippy::print_stdout, reason = "build scripts tell cargo by printing what they read")]

use std::path::{Path, PathBuf};
use std::{env, fs, io};

use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;

use crate::format::{LEVEL, STORED, pack_at};

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
    fs::write(out()?.join("files.pack"), pack_at(level(), files))
}

/// Copies a deflated file of the package, of at most so many bytes when it is inflated, into the folder of its outputs.
///
/// # Errors
///
/// Fails if the file cannot be read, is not deflated, or the outcome cannot be written.
pub fn copy_deflated(path: &str, bytes_max: usize) -> io::Result<()> {
    println!("cargo::rerun-if-changed={path}");
    let mut bytes = fs::read(path)?;
    if level() == STORED {
        let inflated = decompress_to_vec_with_limit(&bytes, bytes_max);
        let inflated = inflated
            .map_err(|error| io::Error::other(format!("{path} is not deflated: {error}")))?;
        bytes = compress_to_vec(&inflated, STORED);
    }
    let name = Path::new(path).file_name().unwrap_or_default();
    fs::write(out()?.join(name), bytes)
}

/// The folder of the outputs.
fn out() -> io::Result<PathBuf> {
    env::var_os("OUT_DIR").map(PathBuf::from).ok_or_else(|| io::Error::other("no OUT_DIR"))
}

/// How much is deflated. A page's module is compressed as a whole on its way, which makes less of the texts than to
/// compress what is deflated.
fn level() -> u8 {
    let is_page = env::var_os("CARGO_CFG_TARGET_FAMILY").is_some_and(|family| family == "wasm");
    if is_page { STORED } else { LEVEL }
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
