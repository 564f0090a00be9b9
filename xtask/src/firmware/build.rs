//! One build. In: files. Out: sizes, and the compiler's warnings about our own files.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};
use sensedsl_files::FileSet;

/// The warnings for our files; those about the tree are ignored.
const WARNINGS: &str = "-Wall -Wextra -Wundef -Wstrict-prototypes -Wconversion";
/// The options of the generated Makefile, without debug information, and without link-time optimisation, which would
/// take most of the time: programs are about a tenth larger than a user's.
const OPTIONS: &str = "-Os -fomit-frame-pointer";
/// The folders of our files, in the compiler's spelling.
const OURS: [&str; 4] = ["generated/", "cfg/", "user/", "uproxy/"];

/// A program that was built.
#[derive(Clone, Debug)]
pub(super) struct Built {
    pub(super) text: u64,
    pub(super) data: u64,
    /// The size without the heap, which takes all memory that is left.
    pub(super) bss: u64,
    /// Warnings about our files, each once.
    pub(super) warnings: BTreeSet<String>,
    /// Whether it is without the shell, because with the shell it is larger than the MCU's memory.
    pub(super) is_production: bool,
}

/// The result of a build.
pub(super) enum Came {
    Built(Built),
    /// It is larger than the MCU's memory in both modes; the text is the linker's message about the smaller one.
    TooLarge(String),
}

impl Built {
    pub(super) fn sizes(&self) -> String {
        let Self { text, data, bss, warnings, is_production } = self;
        let count =
            if warnings.is_empty() { String::new() } else { format!(", {} W", warnings.len()) };
        let mode = if *is_production { " P" } else { "" };
        format!("{text}/{data}/{bss}{mode}{count}")
    }

    /// The inverse of `sizes`, for a program without warnings.
    pub(super) fn from_sizes(sizes: &str) -> Option<Self> {
        let (numbers, is_production) = match sizes.strip_suffix(" P") {
            Some(numbers) => (numbers, true),
            None => (sizes, false),
        };
        let numbers: Result<Vec<u64>, _> = numbers.split('/').map(str::parse).collect();
        let [text, data, bss] = *numbers.ok()?.as_slice() else { return None };
        Some(Self { text, data, bss, warnings: BTreeSet::new(), is_production })
    }
}

/// Writes and builds the firmware of one board. Results of an earlier build in the folder are reused if their sources
/// have not changed: mostly the kernel.
pub(super) fn build(files: &FileSet, tree: &Path, folder: &Path) -> Result<Came> {
    let board = write(files, folder)?;
    let mut too_large = String::new();
    for mode in ["development", "production"] {
        let output = make(&board, tree, mode)?.output().context("make")?;
        let log = String::from_utf8_lossy(&output.stderr).into_owned();
        if output.status.success() {
            let mut built = sizes(&board.join(format!("build/{mode}/sense.elf")))?;
            built.warnings = ours(&log);
            built.is_production = mode == "production";
            return Ok(Came::Built(built));
        }
        let Some(overflow) = log.lines().find_map(overflow) else {
            let words = ["error: ", "undefined reference", "***"];
            let is_error = |line: &&str| words.iter().any(|word| line.contains(word));
            let error = log.lines().find(is_error).or(log.lines().next());
            bail!("{}", error.unwrap_or("make failed and says nothing").trim());
        };
        too_large = overflow;
    }
    Ok(Came::TooLarge(too_large))
}

/// The linker's message about a program that is larger than the memory. If the tree's linker file fills the rest with
/// the heap, the message is about a location counter that would have to move backwards.
fn overflow(line: &str) -> Option<String> {
    if let Some((_, back)) = line.split_once("cannot move location counter backwards (from ") {
        let (from, to) = back.trim_end_matches(')').split_once(" to ")?;
        let number = |text: &str| u64::from_str_radix(text, 16).ok();
        let bytes = number(from)?.checked_sub(number(to)?)?;
        return Some(format!("the memory for variables overflowed by {bytes} bytes"));
    }
    let (_, rest) = line.split_once("region `")?;
    let (region, bytes) = rest.split_once("' overflowed by ")?;
    Some(format!("{region} overflowed by {bytes}"))
}

/// Makes the folder hold these files and earlier build results, and nothing else; returns the folder of the Makefile.
fn write(files: &FileSet, folder: &Path) -> Result<PathBuf> {
    let mut board = None;
    for (path, entry) in files.iter() {
        let to = folder.join(path);
        if path.ends_with("/Makefile") {
            board = to.parent().map(Path::to_path_buf);
        }
        if std::fs::read(&to).is_ok_and(|bytes| bytes == entry.bytes) {
            continue;
        }
        if let Some(parent) = to.parent() {
            std::fs::create_dir_all(parent)?;
        }
        std::fs::write(&to, &entry.bytes).with_context(|| to.display().to_string())?;
    }
    let board = board.context("no Makefile was generated")?;
    let wanted: BTreeSet<PathBuf> = files.iter().map(|(path, _)| folder.join(path)).collect();
    remove_others(&board, &wanted)?;
    Ok(board)
}

/// Removes the source files of an earlier design.
fn remove_others(folder: &Path, wanted: &BTreeSet<PathBuf>) -> Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() && !path.ends_with("build") {
            remove_others(&path, wanted)?;
        } else if path.is_file() && !wanted.contains(&path) {
            std::fs::remove_file(&path)?;
        }
    }
    Ok(())
}

/// Leaves out sources of the tree that would compile to nothing. The tree can do that itself if it can read the
/// switches, but it does not follow our includes, so the preprocessor reads them here.
fn modules(board: &Path, tree: &Path, mode: &str) -> Result<Vec<String>> {
    let shell = if mode == "production" { "FALSE" } else { "TRUE" };
    let makefile = std::fs::read_to_string(board.join("Makefile"))?;
    let base = makefile.lines().find_map(|line| line.strip_prefix("BASE_CFG := $(CHIBIOS)/"));
    let base = tree.join(base.context("the Makefile names no configuration")?);
    let read = |name: &str, define: &str| {
        let mut compiler = Command::new("arm-none-eabi-gcc");
        let path = base.join(name);
        compiler.args(["-E", "-dM", "-DTRUE=TRUE", "-DFALSE=FALSE", "-I", "."]);
        compiler.arg(format!("-D{define}=\"{}\"", path.display()));
        compiler.arg(format!("-DUP_SHELL={shell}")).arg(format!("cfg/{name}")).current_dir(board);
        let output = compiler.output().context("arm-none-eabi-gcc")?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let is_switch = |line: &&str| line.ends_with(" TRUE") && !line.contains('"');
        let switches: Vec<&str> = text.lines().filter(is_switch).collect();
        anyhow::ensure!(!switches.is_empty(), "{name} switches nothing on");
        Ok(switches.join(" ").replace('#', ""))
    };
    let kernel = read("chconf.h", "UP_BASE_CHCONF")?;
    Ok(vec![
        "USE_SMART_BUILD=yes".to_owned(),
        format!("HALCONF={}", read("halconf.h", "UP_BASE_HALCONF")?),
        format!("CHCONF={kernel}"),
        format!("CHLIBCONF={kernel}"),
    ])
}

fn make(board: &Path, tree: &Path, mode: &str) -> Result<Command> {
    let mut make = Command::new("make");
    make.current_dir(board).arg("--silent").arg(format!("CHIBIOS={}", tree.display()));
    make.arg(format!("CWARN={WARNINGS}")).arg(format!("USE_OPT={OPTIONS}"));
    make.arg("USE_LTO=no");
    // This leaves out the linker's map and the compiler's listings, which nobody reads.
    make.arg(format!("UP_MODE={mode}")).arg(format!("./build/{mode}/sense.elf"));
    make.args(modules(board, tree, mode)?);
    if which("ccache") {
        make.arg("CC=ccache arm-none-eabi-gcc")
            .arg("AS=ccache arm-none-eabi-gcc -x assembler-with-cpp");
        make.env("CCACHE_NOHASHDIR", "1").env("CCACHE_SLOPPINESS", "time_macros");
    }
    Ok(make)
}

fn which(tool: &str) -> bool {
    let paths = std::env::var_os("PATH").unwrap_or_default();
    let mut candidates = std::env::split_paths(&paths).map(|path: PathBuf| path.join(tool));
    candidates.any(|path| path.is_file())
}

/// The sizes of text, data and bss, by section.
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
    Ok(Built {
        text,
        data,
        bss: bss.saturating_sub(heap),
        warnings: BTreeSet::new(),
        is_production: false,
    })
}

/// The warnings that are about our files.
fn ours(log: &str) -> BTreeSet<String> {
    let of_ours = |line: &&str| {
        let place = line.strip_prefix("./").unwrap_or(line);
        OURS.iter().any(|folder| place.starts_with(folder)) && line.contains(": warning: ")
    };
    log.lines().filter(of_ours).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_that_are_too_large_are_told() {
        let back = "ld:rules_memory.ld:314 cannot move location counter backwards (from 200011e8 to 20001000)";
        let reported = "the memory for variables overflowed by 488 bytes";
        assert_eq!(overflow(back).as_deref(), Some(reported));
        let region = "ld: region `flash0' overflowed by 12 bytes";
        assert_eq!(overflow(region).as_deref(), Some("flash0 overflowed by 12 bytes"));
        assert_eq!(overflow("collect2: error: ld returned 1 exit status"), None);
    }

    #[test]
    fn only_warnings_of_our_files_count() {
        let log = "generated/sense_hw.c:3:1: warning: unused [-Wunused]\n\
                    /t/os/hal/hal.c:1:1: warning: conversion\n\
                    ./uproxy/core/up_i2c.c:9:2: warning: conversion\n\
                    generated/sense_hw.c:3:1: note: here\n";
        assert_eq!(ours(log).len(), 2);
    }
}
