//! `cargo xtask firmware --embassy`: the complete firmware of a design with all kinds, for every built-in board that
//! the target covers, checked by the Rust compiler on this computer.
//!
//! That covers everything except code generation and linking, which are the same for all chips with the same core and
//! are tested for one chip each.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail, ensure};
use sensedsl_board::catalog;
use sensedsl_files::FileSet;

use super::cells::{self, Made, Notes};
use super::table::wrapped;
use crate::{head, say};

const USAGE: &str = "cargo xtask firmware --embassy [--boards A,B] [--scratch FOLDER] [--write]";
const TARGET: &str = "embassy";
/// The page that a complete run writes.
const PAGE: &str = "docs/embassy-boards.md";

/// The options of a call.
#[derive(Default)]
struct Options {
    boards: Option<BTreeSet<String>>,
    scratch: Option<PathBuf>,
    write: bool,
}

/// A board and its result.
struct Done {
    board: &'static str,
    mcu: &'static str,
    notes: Notes,
    /// The message of the compiler or the generator; `None` if there is no error.
    refused: Option<String>,
}

impl Done {
    /// The kinds without code, and why.
    fn gaps(&self) -> Vec<String> {
        self.notes.refused.iter().map(|(kind, why)| format!("{kind}: {why}")).collect()
    }
}

/// Runs the command.
pub(super) fn run(arguments: &[String]) -> Result<()> {
    let options = read(arguments)?;
    let scratch = options.scratch.clone().unwrap_or_else(|| {
        std::env::temp_dir().join(format!("sensedsl-embassy-{}", std::process::id()))
    });
    let host = host()?;
    let mut done = Vec::new();
    for entry in catalog::all() {
        if options.boards.as_ref().is_some_and(|wanted| !wanted.contains(entry.name)) {
            continue;
        }
        let Some(made) = cells::all_on(entry.name, entry.mcu, TARGET) else { continue };
        let (notes, refused) = match made {
            Made::Files(files, notes) => {
                let refused = check(&files, &scratch, (&host, flags(entry.mcu)))?;
                (notes, refused)
            }
            Made::NotOffered => (Notes::default(), Some("no kind fits".to_owned())),
            Made::NoWiring(why, _) | Made::Refused(why) => (Notes::default(), Some(why)),
        };
        let one = Done { board: entry.name, mcu: entry.mcu, notes, refused };
        let state = one.refused.as_deref().unwrap_or("taken");
        let (taken, gaps) = (one.notes.taken.join(" "), one.gaps().join("; "));
        say(&format!("{} ({taken}): {state} {gaps}\n", one.board))?;
        done.push(one);
    }
    if options.scratch.is_none() {
        std::fs::remove_dir_all(&scratch).with_context(|| scratch.display().to_string())?;
    }
    ensure!(!done.is_empty(), "{TARGET} covers no such board");
    if options.write {
        std::fs::write(PAGE, page(&done)?).context(PAGE)?;
    }
    let refused = done.iter().filter(|one| one.refused.is_some()).count();
    ensure!(refused == 0, "{refused} of {} boards are refused", done.len());
    Ok(())
}

fn read(arguments: &[String]) -> Result<Options> {
    let mut options = Options::default();
    let mut words = arguments.iter();
    while let Some(word) = words.next() {
        let mut next = || words.next().context(USAGE);
        match word.as_str() {
            "--boards" => options.boards = Some(next()?.split(',').map(str::to_owned).collect()),
            "--scratch" => options.scratch = Some(next()?.into()),
            "--write" => options.write = true,
            _ => bail!(USAGE),
        }
    }
    ensure!(!(options.write && options.boards.is_some()), "--write is for all boards");
    Ok(options)
}

/// The target triple of this computer.
fn host() -> Result<String> {
    let output = Command::new("rustc").arg("-vV").output().context("rustc")?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let host = text.lines().find_map(|line| line.strip_prefix("host: "));
    Ok(host.context("rustc -vV names no host")?.to_owned())
}

/// The compiler flags for an MCU: the HAL of RP2350 uses registers that the core's crate has only for ARMv8-M.
fn flags(mcu: &str) -> Option<&'static str> {
    mcu.starts_with("RP235").then_some("--cfg armv8m --cfg armv8m_main")
}

/// The core that a project is for, where its HAL does not compile for a computer: one of RISC-V.
fn foreign(files: &FileSet) -> Option<String> {
    let (_, config) = files.iter().find(|(path, _)| path.ends_with(".cargo/config.toml"))?;
    let config = str::from_utf8(&config.bytes).ok()?.parse::<toml::Table>().ok()?;
    let triple = config.get("build")?.get("target")?.as_str()?;
    triple.starts_with("riscv").then(|| triple.to_owned())
}

/// The first error of the compiler, or its first warning about our files.
fn check(
    files: &FileSet,
    scratch: &Path,
    (host, flags): (&str, Option<&str>),
) -> Result<Option<String>> {
    let project = scratch.join("project");
    if project.exists() {
        std::fs::remove_dir_all(&project).with_context(|| project.display().to_string())?;
    }
    for (path, file) in files.iter() {
        let path = project.join(path);
        let parent = path.parent().context("a path without a folder")?;
        std::fs::create_dir_all(parent).with_context(|| parent.display().to_string())?;
        std::fs::write(&path, &file.bytes).with_context(|| path.display().to_string())?;
    }
    let manifest = find(&project).context("no Cargo.toml was generated")?;
    let mut cargo = Command::new(env!("CARGO"));
    let foreign = foreign(files);
    let triple = foreign.as_deref().unwrap_or(host);
    cargo.args(["check", "--locked", "--quiet", "--message-format", "short", "--target", triple]);
    cargo.arg("--target-dir").arg(scratch.join("target")).arg("--manifest-path").arg(&manifest);
    for name in ["CARGO_BUILD_TARGET", "CARGO_ENCODED_RUSTFLAGS", "RUSTFLAGS", "RUSTC_WRAPPER"] {
        cargo.env_remove(name);
    }
    if let Some(flags) = flags {
        cargo.env("RUSTFLAGS", flags);
    }
    if foreign.is_some() {
        // Debian's compiler has the source of `core`.
        cargo.arg("-Zbuild-std=core").env("RUSTC", "/usr/bin/rustc").env("RUSTC_BOOTSTRAP", "1");
    }
    let output = cargo.env("CARGO_INCREMENTAL", "0").output().context("cargo")?;
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    let is_reported = |line: &&str| line.contains("error") || line.contains("warning");
    let first = text.lines().find(is_reported).map(str::to_owned);
    Ok(match (output.status.success(), first) {
        (true, first) => first,
        (false, first) => Some(first.unwrap_or_else(|| "cargo failed and says nothing".to_owned())),
    })
}

/// The manifest of the project's only board.
fn find(project: &Path) -> Option<PathBuf> {
    let mut folders = std::fs::read_dir(project).ok()?;
    let manifest = folders.find_map(|entry| Some(entry.ok()?.path().join("Cargo.toml")));
    manifest.filter(|path| path.is_file())
}

fn page(done: &[Done]) -> Result<String> {
    let mut page = head(PAGE, "\n| board | ")?;
    page.push_str("| board | MCU | kinds | no room for | |\n| --- | --- | --- | --- | --- |\n");
    for one in done {
        let state = if one.refused.is_some() { "**refused**" } else { "taken" };
        let (board, mcu, notes) = (one.board, one.mcu, &one.notes);
        let link = if notes.rules.is_empty() { "" } else { " \\*" };
        let (taken, left_out) = (notes.taken.join(" "), notes.left_out.join(" "));
        // Writing to a string cannot fail.
        let _ = writeln!(page, "| {board}{link} | {mcu} | {taken} | {left_out} | {state} |");
    }
    let taken = done.iter().filter(|one| one.refused.is_none()).count();
    let _ = writeln!(page, "\n{taken} of {} boards are taken.", done.len());
    let mut gaps: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for one in done {
        for gap in one.gaps().into_iter().chain(one.refused.clone()) {
            // A family's name may begin with the MCU's: "RP2040 and RP2350".
            let is_family = gap.contains(&format!("on {} and ", one.mcu));
            let gap = gap.replace('|', "/");
            let gap = if is_family { gap } else { gap.replace(one.mcu, "the MCU") };
            gaps.entry(gap).or_default().push(one.board);
        }
    }
    if !gaps.is_empty() {
        page.push_str("\n## What is not there\n\n");
    }
    for (gap, boards) in gaps {
        page.push_str(&wrapped(&format!("- {gap}: {}", boards.join(", "))));
    }
    Ok(page)
}
