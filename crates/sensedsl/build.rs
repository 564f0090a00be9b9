//! Puts the studio's page into the program: the files of the folder that `SENSEDSL_STUDIO` names, or none.

#![expect(clippy::disallowed_methods, reason = "a build script reads files and the environment")]

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-env-changed=SENSEDSL_STUDIO");
    println!("cargo::rerun-if-changed=build.rs");
    let mut files = Vec::new();
    if let Some(folder) = env::var_os("SENSEDSL_STUDIO") {
        let folder = fs::canonicalize(folder)?;
        println!("cargo::rerun-if-changed={}", folder.display());
        below(&folder, &mut files)?;
        files.sort();
        return write(&folder, &files);
    }
    write(Path::new(""), &files)
}

/// All files of a folder and the folders in it.
fn below(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() { below(&path, files)? } else { files.push(path) }
    }
    Ok(())
}

/// Writes the table that the program includes.
fn write(folder: &Path, files: &[PathBuf]) -> io::Result<()> {
    let mut table = String::from(
        "/// The page's files: the path of each, and its bytes.\nconst FILES: &[(&str, &[u8])] = &[\n",
    );
    for path in files {
        let Ok(name) = path.strip_prefix(folder) else { continue };
        let name = name.to_string_lossy().replace('\\', "/");
        table.push_str(&format!("    ({name:?}, include_bytes!({path:?})),\n"));
    }
    table.push_str("];\n");
    let out = env::var_os("OUT_DIR").ok_or_else(|| io::Error::other("no OUT_DIR"))?;
    fs::write(PathBuf::from(out).join("studio.rs"), table)
}
