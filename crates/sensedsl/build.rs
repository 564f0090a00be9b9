//! Puts the studio's page into the program: the files of the folder that `SENSEDSL_STUDIO` names, or none. Leaves out of
//! a program that is handed out what it has no use for.

#![expect(clippy::disallowed_methods, reason = "a build script reads files and the environment")]

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-env-changed=SENSEDSL_STUDIO");
    println!("cargo::rerun-if-changed=build.rs");
    leave_out_unwinding()?;
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

/// The profile `dist`, which is the one that optimises this package for size, aborts where others unwind: its tables for
/// unwinding are a tenth of the program and never read. The compiler has no option for it, because it keeps those of the
/// standard library; linkers for Linux know it by a script, of which GNU's and LLVM's were tried.
fn leave_out_unwinding() -> io::Result<()> {
    let is = |name: &str, value: &str| env::var(name).is_ok_and(|is| is == value);
    if is("OPT_LEVEL", "z")
        && is("CARGO_CFG_TARGET_OS", "linux")
        && is("CARGO_CFG_TARGET_ARCH", "x86_64")
    {
        let script = out_folder()?.join("no_unwinding.ld");
        fs::write(
            &script,
            "SECTIONS { /DISCARD/ : { *(.eh_frame) *(.eh_frame_hdr) } } INSERT AFTER .text;\n",
        )?;
        println!("cargo::rustc-link-arg-bins=-Wl,--no-eh-frame-hdr,-T,{}", script.display());
    }
    Ok(())
}

fn out_folder() -> io::Result<PathBuf> {
    env::var_os("OUT_DIR").map(PathBuf::from).ok_or_else(|| io::Error::other("no OUT_DIR"))
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
    fs::write(out_folder()?.join("studio.rs"), table)
}
