//! `sensedsl build`: the firmware of a file, or of a generated folder, built with the user's tree.
//!
//! Everything that the build needs is looked at first; what is missing is said before a file is
//! written or compiled. What make says goes to the terminal as it is.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, Result};
use sensedsl_diagnostics::codes::{e0519_which_board, e0520_no_firmware_here, e0521_build_failed};
use sensedsl_diagnostics::{Diagnostic, SourceMap, Span, visible};

use super::{generate, input, output};
use crate::cli::{BuildArgs, GenerateArgs, On, Place};
use crate::files::{files_below, shown};
use crate::firmware::{self, Make, Program};
use crate::terminal::Terminal;
use crate::{Said, Status};

pub(crate) fn run(args: &BuildArgs, terminal: &Terminal) -> Result<Status> {
    built(&args.place, terminal, &mut |_| Ok(()), &mut |job| {
        for program in &job.programs {
            let elf = program.folder.join(job.build()).join("sense.elf");
            terminal.note(&format!("built {}\n", visible(&shown(&elf))))?;
        }
        if let [program] = job.programs.as_slice() {
            let folder = output::typed(&program.folder, "");
            let mode = if job.production { " --production" } else { "" };
            let folder = folder.trim_end_matches('/');
            terminal.note(&format!("next: sensedsl flash {folder}{mode}\n"))?;
        }
        Ok(Status::Done)
    })
}

/// What is built, when the ground has been looked at.
pub(super) struct Job<'a> {
    pub(super) programs: Vec<Program>,
    pub(super) production: bool,
    /// The command that follows; empty where none does.
    pub(super) after: Vec<String>,
    /// The place of what concerns the whole.
    pub(super) at: Span,
    pub(super) sources: &'a SourceMap,
}

impl Job<'_> {
    /// Where make puts what it builds, in a board's folder.
    pub(super) fn build(&self) -> PathBuf {
        Path::new("build").join(self.mode())
    }

    fn mode(&self) -> &'static str {
        if self.production { "production" } else { "development" }
    }

    /// Says what is wrong.
    pub(super) fn refuse(
        &self,
        why: Diagnostic,
        status: Status,
        terminal: &Terminal,
    ) -> Result<Status> {
        terminal.diagnostics(&[why], self.sources)?;
        Ok(status)
    }
}

/// Further ground to look at: what the caller needs beside the build.
pub(super) type Ground<'a> = dyn FnMut(&mut Job<'_>) -> Result<(), Box<Diagnostic>> + 'a;

/// Builds what is named, and hands it on.
pub(super) fn built(
    place: &Place,
    terminal: &Terminal,
    ground: &mut Ground<'_>,
    then: &mut dyn FnMut(&Job<'_>) -> Result<Status>,
) -> Result<Status> {
    let path = named(place)?;
    if !path.is_dir() {
        return of_file(place, &path, terminal, ground, then);
    }
    if place.output.is_some() {
        anyhow::bail!("-o says where a file is generated into; {} is a folder", shown(&path));
    }
    let mut sources = SourceMap::default();
    let at = Span::new(sources.add(shown(&path), ""), 0..0);
    let programs = firmware::in_folder(&path)?;
    let mut job =
        Job { programs, production: place.production, after: Vec::new(), at, sources: &sources };
    let (make, tree) = match look(place, &mut job, ground) {
        Ok(ready) => ready,
        Err(why) => return job.refuse(*why, Status::Misused, terminal),
    };
    make_all(&job, make, &tree, terminal)?;
    then(&job)
}

/// Generates first; the ground is looked at before anything is written.
fn of_file(
    place: &Place,
    file: &Path,
    terminal: &Terminal,
    ground: &mut Ground<'_>,
    then: &mut dyn FnMut(&Job<'_>) -> Result<Status>,
) -> Result<Status> {
    let beside = || file.parent().unwrap_or(Path::new("")).join("build");
    let args = GenerateArgs {
        file: file.to_path_buf(),
        output: place.output.clone().unwrap_or_else(beside),
        on: On { board: None, target: None, reach: place.reach.clone() },
        host: Vec::new(),
        without: Vec::new(),
        check: false,
        keep: None,
    };
    generate::made(&args, terminal, &mut |made| {
        let boards = made.assignment.used(made.design);
        let program = |name: &str, mcu: Option<&str>| {
            let makefile = made.files.get(&format!("firmware/{name}/Makefile"))?;
            let wants = firmware::Wants::of(&String::from_utf8_lossy(&makefile.bytes));
            let folder = args.output.join("firmware").join(name);
            Some(Program { board: name.to_owned(), folder, mcu: mcu.map(str::to_owned), wants })
        };
        let programs = boards.filter_map(|(_, on)| program(&on.name.value, on.mcu.as_deref()));
        let at = input::place(made.design);
        let mut job = Job {
            programs: programs.collect(),
            production: place.production,
            after: Vec::new(),
            at,
            sources: made.sources,
        };
        let (make, tree) = match look(place, &mut job, ground) {
            Ok(ready) => ready,
            Err(why) => return job.refuse(*why, Status::Misused, terminal),
        };
        let changes = match made.update(&args, terminal)? {
            Ok(changes) => changes,
            Err(status) => return Ok(status),
        };
        let written = changes.missing.len() + changes.different.len();
        let folder = shown(&args.output);
        terminal.note(&format!("wrote {written} files to {}\n", visible(&folder)))?;
        make_all(&job, make, &tree, terminal)?;
        then(&job)
    })
}

/// What the command line names: a file, a folder, or what stands in this folder.
fn named(place: &Place) -> Result<PathBuf> {
    if let Some(path) = &place.path {
        return Ok(path.clone());
    }
    let here = Path::new(".");
    if !firmware::in_folder(here)?.is_empty() {
        return Ok(here.to_path_buf());
    }
    let found = files_below(here, &|_| true)?;
    let mut files = found.iter().filter(|file| file.extension().is_some_and(|one| one == "sense"));
    match (files.next(), files.next()) {
        (Some(file), None) => Ok(file.clone()),
        // The folder is told as one without firmware.
        _ => Ok(here.to_path_buf()),
    }
}

/// Looks at everything that building needs, and leaves only the boards that are asked for.
fn look(
    place: &Place,
    job: &mut Job<'_>,
    ground: &mut Ground<'_>,
) -> Result<(Make, PathBuf), Box<Diagnostic>> {
    let at = job.at;
    if job.programs.is_empty() {
        let path = place.path.as_deref().unwrap_or(Path::new("."));
        let why = if path.join(".sensedsl-files").exists() {
            "it was generated without firmware"
        } else {
            "`generate` did not write it"
        };
        return Err(e0520_no_firmware_here::no_firmware_here(at, &shown(path), why).into());
    }
    if let Some(wanted) = &place.board {
        let all: Vec<String> = job.programs.iter().map(|one| one.board.clone()).collect();
        job.programs.retain(|program| program.board == *wanted);
        if job.programs.is_empty() {
            let all: Vec<&str> = all.iter().map(String::as_str).collect();
            return Err(e0519_which_board::unknown(at, wanted, &all).into());
        }
    }
    let by_variable = std::env::var_os("CHIBIOS").map(PathBuf::from);
    let named = place.chibios.clone().or(by_variable);
    let programs: Vec<&Program> = job.programs.iter().collect();
    let tree = firmware::tree(named.as_deref(), &programs, at)?;
    let make = firmware::tools(at)?;
    ground(job)?;
    Ok((make, tree))
}

/// Calls make for one board after the other.
fn make_all(job: &Job<'_>, make: Make, tree: &Path, terminal: &Terminal) -> Result<()> {
    for program in &job.programs {
        let mut command = Command::new(make.0);
        command.args(["--no-print-directory", "-C"]).arg(&program.folder);
        let jobs = std::thread::available_parallelism().map_or(1, usize::from);
        command.arg(format!("-j{jobs}")).arg(format!("CHIBIOS={}", tree.display()));
        command.arg(format!("UP_MODE={}", job.mode())).stdin(Stdio::null());
        if terminal.is_quiet() {
            command.arg("--silent").stdout(Stdio::null());
        }
        let status = command.status().with_context(|| format!("cannot run {}", make.0))?;
        if !status.success() {
            let how = firmware::ending(status);
            let why = e0521_build_failed::build_failed(job.at, &program.board, &how);
            let status = job.refuse(why, Status::Wrong, terminal)?;
            anyhow::bail!(Said(status));
        }
    }
    Ok(())
}
