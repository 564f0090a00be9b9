//! `sensedsl build`: the firmware of a file, or of a generated folder, built by make with the user's tree of ChibiOS,
//! or by cargo.
//!
//! Everything that the build needs is checked first, and anything missing is reported before a file is written or
//! compiled. The output of make and cargo goes to the terminal unchanged.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, Result};
use sensedsl_diagnostics::codes::{e0519_which_board, e0520_no_firmware_here, e0521_build_failed};
use sensedsl_diagnostics::{Diagnostic, SourceMap, Span, visible};
use sensedsl_model::design::Board;

use super::{generate, input, output};
use crate::cli::{BuildArgs, GenerateArgs, On, Place};
use crate::files::{files_below, shown};
use crate::firmware::arduino::{self, Sketch};
use crate::firmware::cargo::{self, Cargo};
use crate::firmware::{self, Build, Make, Program, uf2};
use crate::status::{Reported, Status};
use crate::terminal::Terminal;

pub(crate) fn run(args: &BuildArgs, terminal: &Terminal) -> Result<Status> {
    built(&args.place, terminal, &mut |_| Ok(()), &mut |job| {
        for program in &job.programs {
            let elf = job.elf(program);
            terminal.note(&format!("built {}\n", visible(&shown(&elf))))?;
            if let Some(file) = job.uf2(program) {
                terminal.note(&format!("built {}\n", visible(&shown(&file))))?;
            }
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

/// A build whose requirements have been checked.
pub(super) struct Job<'a> {
    pub(super) programs: Vec<Program>,
    pub(super) production: bool,
    /// What is done after the build; `None` if that is all.
    pub(super) after: Option<After>,
    /// Whether that takes raw bytes that the build does not make.
    pub(super) makes_raw: bool,
    /// The place for diagnostics that concern the whole.
    pub(super) at: Span,
    pub(super) sources: &'a SourceMap,
}

/// What is done with a program that has been built.
#[derive(Clone, Debug)]
pub(super) enum After {
    /// A command runs.
    Run(Vec<String>),
    /// A file is copied to the drive at a folder.
    Copy {
        /// The file.
        file: PathBuf,
        /// The folder.
        drive: PathBuf,
    },
}

impl<'a> Job<'a> {
    fn new(programs: Vec<Program>, place: &Place, at: Span, sources: &'a SourceMap) -> Self {
        let production = place.production;
        Self { programs, production, after: None, makes_raw: false, at, sources }
    }

    /// The ELF file that the build makes.
    pub(super) fn elf(&self, program: &Program) -> PathBuf {
        match &program.build {
            Build::Make(_) => program.folder.join("build").join(self.mode()).join("sense.elf"),
            Build::Sketch(sketch) => program.folder.join(sketch.elf()),
            Build::Cargo(project) => {
                program.folder.join("target").join(&project.triple).join("release/firmware")
            }
        }
    }

    /// The same program as a UF2 file, if the board's boot loader takes one.
    pub(super) fn uf2(&self, program: &Program) -> Option<PathBuf> {
        program.build.family().map(|_| self.elf(program).with_extension("uf2"))
    }

    /// The same program as raw bytes.
    pub(super) fn raw(&self, program: &Program) -> PathBuf {
        self.elf(program).with_extension("bin")
    }

    fn mode(&self) -> &'static str {
        if self.production { "production" } else { "development" }
    }

    /// Reports the error.
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

/// A further check, of what the caller needs in addition to the build.
pub(super) type FurtherCheck<'a> = dyn FnMut(&mut Job<'_>) -> Result<(), Box<Diagnostic>> + 'a;

/// Builds the named firmware, and passes it on.
pub(super) fn built(
    place: &Place,
    terminal: &Terminal,
    ground: &mut FurtherCheck<'_>,
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
    let mut job = Job::new(programs, place, at, &sources);
    let builders = match look(place, &mut job, ground) {
        Ok(ready) => ready,
        Err(why) => return job.refuse(*why, Status::Misused, terminal),
    };
    build_all(&job, &builders, terminal)?;
    then(&job)
}

/// Generates first; all requirements are checked before anything is written.
fn of_file(
    place: &Place,
    file: &Path,
    terminal: &Terminal,
    ground: &mut FurtherCheck<'_>,
    then: &mut dyn FnMut(&Job<'_>) -> Result<Status>,
) -> Result<Status> {
    let beside = || file.parent().unwrap_or(Path::new("")).join("build");
    let args = GenerateArgs {
        file: file.to_path_buf(),
        output: place.output.clone().unwrap_or_else(beside),
        on: On { reach: place.reach.clone(), ..On::default() },
        ..GenerateArgs::default()
    };
    generate::made(&args, terminal, &mut |made| {
        let boards = made.assignment.used(made.design);
        let program = |on: &Board| {
            let name = &on.name.value;
            let mut file = |path: &str| {
                let file = made.files.get(&format!("firmware/{name}/{path}"));
                Ok(file.map(|file| String::from_utf8_lossy(&file.bytes).into_owned()))
            };
            let build = Build::of(&mut file).ok()??;
            let folder = args.output.join("firmware").join(name);
            let mcu = on.mcu.clone();
            // Facts of a table of the user's are those of another board.
            let ready = on.facts.as_ref().filter(|_| on.built_in);
            let ready = ready.and_then(|facts| facts.ready.clone());
            Some(Program { board: name.clone(), folder, mcu, ready, build })
        };
        let programs = boards.filter_map(|(_, on)| program(on));
        let at = input::place(made.design);
        let mut job = Job::new(programs.collect(), place, at, made.sources);
        let builders = match look(place, &mut job, ground) {
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
        build_all(&job, &builders, terminal)?;
        then(&job)
    })
}

/// The path that the command line names: a file, a folder, or, without one, this folder or the file in it.
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
        // This folder is reported as one without firmware.
        _ => Ok(here.to_path_buf()),
    }
}

/// The build tools, as far as they are needed.
struct Builders {
    make: Option<(Make, PathBuf)>,
    cargo: Option<Cargo>,
    sketches: Option<arduino::Builder>,
}

/// Checks everything that building needs, and keeps only the boards that are asked for.
fn look(
    place: &Place,
    job: &mut Job<'_>,
    ground: &mut FurtherCheck<'_>,
) -> Result<Builders, Box<Diagnostic>> {
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
    let (mut made, mut triples, mut has_sketch) = (Vec::new(), Vec::new(), false);
    for program in &job.programs {
        match &program.build {
            Build::Make(wants) => made.push((program, wants)),
            Build::Cargo(project) => triples.push(project.triple.as_str()),
            Build::Sketch(_) => has_sketch = true,
        }
    }
    let mut builders = Builders { make: None, cargo: None, sketches: None };
    if !made.is_empty() {
        let by_variable = std::env::var_os("CHIBIOS").map(PathBuf::from);
        let named = place.chibios.clone().or(by_variable);
        let tree = firmware::tree(named.as_deref(), &made, at)?;
        builders.make = Some((firmware::tools(at)?, tree));
    }
    if !triples.is_empty() {
        builders.cargo = Some(cargo::cargo(&triples, at)?);
    }
    if has_sketch {
        builders.sketches = Some(arduino::builder(at)?);
    }
    ground(job)?;
    Ok(builders)
}

/// Builds one board after another.
fn build_all(job: &Job<'_>, builders: &Builders, terminal: &Terminal) -> Result<()> {
    for program in &job.programs {
        let Some(mut command) = command(job, program, builders, terminal) else { continue };
        let name = shown(command.get_program());
        let status = command.status().with_context(|| format!("cannot run {name}"))?;
        if !status.success() {
            let how = firmware::ending(status);
            let why = e0521_build_failed::build_failed(
                job.at,
                &program.board,
                program.build.tool(),
                &how,
            );
            let status = job.refuse(why, Status::Wrong, terminal)?;
            anyhow::bail!(Reported(status));
        }
        make_uf2(job, program)?;
    }
    Ok(())
}

/// Makes the UF2 file of a program, if the board's boot loader takes one.
fn make_uf2(job: &Job<'_>, program: &Program) -> Result<()> {
    let (Some(family), Some(file)) = (program.build.family(), job.uf2(program)) else {
        return Ok(());
    };
    let elf = job.elf(program);
    let bytes = std::fs::read(&elf).with_context(|| shown(&elf))?;
    let bytes = uf2::of_elf(&bytes, family).with_context(|| shown(&elf))?;
    std::fs::write(&file, bytes).with_context(|| shown(&file))
}

/// The command that builds a board; `None` if the tool for it was not found.
fn command(
    job: &Job<'_>,
    program: &Program,
    builders: &Builders,
    terminal: &Terminal,
) -> Option<Command> {
    let mut command = match &program.build {
        Build::Make(_) => {
            let (make, tree) = builders.make.as_ref()?;
            let mut command = Command::new(make.0);
            command.args(["--no-print-directory", "-C"]).arg(&program.folder);
            let jobs = std::thread::available_parallelism().map_or(1, usize::from);
            command.arg(format!("-j{jobs}")).arg(format!("CHIBIOS={}", shown(tree)));
            command.arg(format!("UP_MODE={}", job.mode()));
            if terminal.is_quiet() {
                command.arg("--silent").stdout(Stdio::null());
            }
            command
        }
        Build::Sketch(sketch) => sketch_command(program, sketch, builders, terminal)?,
        Build::Cargo(_) => {
            let mut command = Command::new(&builders.cargo.as_ref()?.0);
            // In a target folder shared by several boards, one would get the program of another: all are called
            // `firmware`.
            command.args(["build", "--release", "--locked", "--target-dir", "target"]);
            command.current_dir(&program.folder);
            if terminal.is_quiet() {
                command.arg("--quiet");
            }
            command
        }
    };
    command.stdin(Stdio::null());
    Some(command)
}

/// The command that builds a sketch.
fn sketch_command(
    program: &Program,
    sketch: &Sketch,
    builders: &Builders,
    terminal: &Terminal,
) -> Option<Command> {
    let jobs = std::thread::available_parallelism().map_or(1, usize::from);
    let mut command = match builders.sketches.as_ref()? {
        arduino::Builder::Cli => {
            let mut command = Command::new("arduino-cli");
            command.args(["compile", "--fqbn", &sketch.fqbn, "--output-dir"]);
            command.arg(program.folder.join("build")).arg(&program.folder);
            command
        }
        arduino::Builder::Make(make, core) => {
            let mut command = Command::new(make.0);
            command.args(["--no-print-directory", "-C"]).arg(&program.folder);
            command.arg(format!("-j{jobs}")).arg(format!("ARDUINO_CORE={}", shown(core)));
            if terminal.is_quiet() {
                command.arg("--silent");
            }
            command
        }
    };
    if terminal.is_quiet() {
        command.stdout(Stdio::null());
    }
    Some(command)
}
