//! One build: files in, sizes and the compiler's warnings about our own files out.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};
use sensedsl_codegen::fileset::FileSet;

/// What our files are compiled with; the tree's own warnings are not looked at.
const WARNINGS: &str = "-Wall -Wextra -Wundef -Wstrict-prototypes -Wconversion";
/// As in the generated Makefile, without what debuggers need: the program is the same.
const OPTIONS: &str = "-O2 -fomit-frame-pointer";
/// The folders of our files, as the compiler names them.
const OURS: [&str; 4] = ["generated/", "cfg/", "user/", "uproxy/"];

/// A program that was built.
#[derive(Clone, Debug)]
pub(super) struct Built {
    pub(super) text: u64,
    pub(super) data: u64,
    /// Without the heap, which is whatever is left.
    pub(super) bss: u64,
    /// Of our files, each once.
    pub(super) warnings: BTreeSet<String>,
}

impl Built {
    pub(super) fn sizes(&self) -> String {
        let Self { text, data, bss, warnings } = self;
        let count =
            if warnings.is_empty() { String::new() } else { format!(", {} W", warnings.len()) };
        format!("{text}/{data}/{bss}{count}")
    }
}

/// Writes and builds the firmware of one board, and removes what was built.
pub(super) fn build(files: &FileSet, tree: &Path, folder: &Path) -> Result<Built> {
    let mut board = None;
    for (path, entry) in files.iter() {
        let to = folder.join(path);
        if let Some(parent) = to.parent() {
            std::fs::create_dir_all(parent)?;
        }
        std::fs::write(&to, &entry.bytes).with_context(|| to.display().to_string())?;
        if path.ends_with("/Makefile") {
            board = to.parent().map(Path::to_path_buf);
        }
    }
    let board = board.context("no Makefile was generated")?;
    let output = make(&board, tree).output().context("make")?;
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    if !output.status.success() {
        let error = said.lines().find(|line| line.contains("error") || line.contains("***"));
        bail!("{}", error.or(said.lines().next()).unwrap_or("make failed and says nothing").trim());
    }
    let mut built = sizes(&board.join("build/development/sense.elf"))?;
    built.warnings = ours(&said);
    std::fs::remove_dir_all(folder)?;
    Ok(built)
}

fn make(board: &Path, tree: &Path) -> Command {
    let mut make = Command::new("make");
    make.current_dir(board).arg("--silent").arg(format!("CHIBIOS={}", tree.display()));
    make.arg(format!("CWARN={WARNINGS}")).arg(format!("USE_OPT={OPTIONS}"));
    // Without the linker's map and the compiler's listings, which nobody reads.
    make.arg("./build/development/sense.elf");
    if which("ccache") {
        make.arg("CC=ccache arm-none-eabi-gcc")
            .arg("AS=ccache arm-none-eabi-gcc -x assembler-with-cpp");
        make.env("CCACHE_NOHASHDIR", "1").env("CCACHE_SLOPPINESS", "time_macros");
    }
    make
}

fn which(tool: &str) -> bool {
    let paths = std::env::var_os("PATH").unwrap_or_default();
    let mut candidates = std::env::split_paths(&paths).map(|path: PathBuf| path.join(tool));
    candidates.any(|path| path.is_file())
}

/// Text, data and bss by section.
fn sizes(program: &Path) -> Result<Built> {
    let output = Command::new("arm-none-eabi-size").arg("-B").arg(program).output()?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let numbers = text.lines().nth(1).unwrap_or_default().split_whitespace();
    let numbers: Vec<u64> = numbers.take(3).filter_map(|number| number.parse().ok()).collect();
    let [text, data, bss] = *numbers.as_slice() else { bail!("size says nothing of {program:?}") };
    let output = Command::new("arm-none-eabi-size").arg("-A").arg(program).output()?;
    let sections = String::from_utf8_lossy(&output.stdout).into_owned();
    let heap = sections.lines().filter(|line| line.starts_with(".heap"));
    let heap = heap.filter_map(|line| line.split_whitespace().nth(1)?.parse::<u64>().ok()).sum();
    Ok(Built { text, data, bss: bss.saturating_sub(heap), warnings: BTreeSet::new() })
}

/// Warnings whose place is in our files.
fn ours(said: &str) -> BTreeSet<String> {
    let of_ours = |line: &&str| {
        let place = line.strip_prefix("./").unwrap_or(line);
        OURS.iter().any(|folder| place.starts_with(folder)) && line.contains(": warning: ")
    };
    said.lines().filter(of_ours).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_warnings_of_our_files_count() {
        let said = "generated/sense_hw.c:3:1: warning: unused [-Wunused]\n\
                    /t/os/hal/hal.c:1:1: warning: conversion\n\
                    ./uproxy/core/up_i2c.c:9:2: warning: conversion\n\
                    generated/sense_hw.c:3:1: note: here\n";
        assert_eq!(ours(said).len(), 2);
    }
}
