//! The user's code as a program on this computer: compiled by the user's compiler, and stepped in lockstep with the
//! simulated board over its standard input and output.

use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::time::Duration;

use anyhow::{Context as _, Result};
use sensedsl_code::{
    ControllerPlan, GENERATED, controllers, headers, modules, native_c, native_rust,
};
use sensedsl_diagnostics::codes::{e0534_no_user_code, e0535_user_code_not_built};
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_files::FileSet;
use sensedsl_job::BoardJob;
use sensedsl_twin::soft::UserCode;

use crate::files::shown;

/// The longest that a step may take on this computer.
const STEP_MAX: Duration = Duration::from_secs(2);
/// The longest answer of a step: more than all values of a board have.
const ANSWER_BYTES_MAX: usize = 65_536;

/// The program of a board's controllers, ready to run.
#[derive(Clone)]
pub(crate) struct Built {
    program: PathBuf,
}

/// Where the words of a compiler go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Words {
    /// To the terminal.
    Above,
    /// Its first error into the diagnostic, for whoever has no terminal.
    Within,
}

/// Compiles the code of a board's controllers; `folder` is that of its firmware. A mistake is a diagnostic at `at`.
///
/// # Errors
/// What could not be written or run.
pub(crate) fn build(
    job: &BoardJob<'_>,
    folder: &Path,
    at: Span,
    words: Words,
) -> Result<Result<Built, Box<Diagnostic>>> {
    let plans = controllers(job);
    let language = Language::of(job);
    for one in &plans {
        let file =
            folder.join(language.user()).join(format!("{}.{}", one.ident, language.ending()));
        if !file.is_file() {
            let report = e0534_no_user_code::no_user_code(at, &one.name, &shown(&file));
            return Ok(Err(report.into()));
        }
    }
    let into = folder.join("build").join("native");
    let (mut command, program) = match language {
        Language::C => in_c(job, &plans, folder, &into)?,
        Language::Sketch => in_sketch(job, &plans, folder, &into)?,
        Language::Rust => in_rust(job, &plans, folder, &into)?,
    };
    let tool = command.get_program().to_string_lossy().into_owned();
    let refused =
        |why: &str| Ok(Err(e0535_user_code_not_built::user_code_not_built(at, why).into()));
    command.stdin(Stdio::null());
    if words == Words::Within {
        command.stderr(Stdio::piped());
    }
    let ended = command.spawn().and_then(Child::wait_with_output);
    match ended {
        Ok(ended) if ended.status.success() => Ok(Ok(Built { program })),
        Ok(ended) => {
            let said = String::from_utf8_lossy(&ended.stderr);
            let first = said.lines().find(|line| line.contains("error")).map(|line| {
                let folder = format!("{}/", folder.display());
                format!(": {}", line.replace(&folder, ""))
            });
            refused(&format!("{tool} ended with {}{}", ended.status, first.unwrap_or_default()))
        }
        Err(why) => refused(&format!("{tool} cannot be run ({why})")),
    }
}

/// What the user's code is written in: as the firmware is.
#[derive(Clone, Copy)]
enum Language {
    C,
    /// C in a folder that the Arduino framework compiles.
    Sketch,
    Rust,
}

impl Language {
    fn of(job: &BoardJob<'_>) -> Self {
        match job.system() {
            Some("embassy") => Self::Rust,
            Some("arduino") => Self::Sketch,
            Some(_) | None => Self::C,
        }
    }

    /// The folder of the user's files in that of the firmware.
    const fn user(self) -> &'static str {
        match self {
            Self::C => "user",
            Self::Sketch | Self::Rust => "src/user",
        }
    }

    const fn ending(self) -> &'static str {
        match self {
            Self::C | Self::Sketch => "c",
            Self::Rust => "rs",
        }
    }
}

/// Writes the files that the tool makes, below a folder.
fn write(files: &FileSet, into: &Path) -> Result<()> {
    for (name, file) in files.iter() {
        write_file(&into.join(name), &file.bytes)?;
    }
    Ok(())
}

/// Writes a file if it is not there yet as it is: a build tool looks at its time.
fn write_file(path: &Path, bytes: &[u8]) -> Result<()> {
    if std::fs::read(path).is_ok_and(|found| found == bytes) {
        return Ok(());
    }
    let folder = path.parent().unwrap_or(path);
    std::fs::create_dir_all(folder).with_context(|| format!("cannot make {}", shown(folder)))?;
    std::fs::write(path, bytes).with_context(|| format!("cannot write {}", shown(path)))
}

/// The compiler's command, and the program that it makes.
fn in_c(
    job: &BoardJob<'_>,
    plans: &[ControllerPlan],
    folder: &Path,
    into: &Path,
) -> Result<(Command, PathBuf)> {
    let generated = into.join("generated");
    write(&native(job, plans), &generated)?;
    let files = plans.iter().map(|one| folder.join("user").join(format!("{}.c", one.ident)));
    Ok(compiled(&generated, files, into))
}

/// The same for a sketch, whose files find their headers in the folder above theirs: copies, beside the headers of now.
fn in_sketch(
    job: &BoardJob<'_>,
    plans: &[ControllerPlan],
    folder: &Path,
    into: &Path,
) -> Result<(Command, PathBuf)> {
    let generated = into.join("src");
    write(&native(job, plans), &generated)?;
    let mut files = Vec::new();
    for one in plans {
        let name = Path::new("src/user").join(format!("{}.c", one.ident));
        let path = folder.join(&name);
        let text = std::fs::read(&path).with_context(|| format!("cannot read {}", shown(&path)))?;
        files.push(into.join(&name));
        write_file(&into.join(name), &text)?;
    }
    Ok(compiled(&generated, files.into_iter(), into))
}

/// What is around the user's code in C on this computer.
fn native(job: &BoardJob<'_>, plans: &[ControllerPlan]) -> FileSet {
    let mut all = headers(&job.board.name.value, plans, &GENERATED);
    all.add("native.c", native_c(job));
    all
}

/// The command that compiles C, and the program that it makes.
fn compiled(
    generated: &Path,
    files: impl Iterator<Item = PathBuf>,
    into: &Path,
) -> (Command, PathBuf) {
    let program = into.join("controllers");
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let flags = std::env::var("CFLAGS").unwrap_or_default();
    let mut command = Command::new(compiler);
    command.args(["-std=gnu11", "-O1", "-g", "-Wall", "-DSENSE_NATIVE", "-I"]).arg(generated);
    command.args(flags.split_whitespace());
    command.args(files);
    command.arg(generated.join("native.c")).arg("-o").arg(&program).arg("-lm");
    (command, program)
}

/// The same for Rust: a package of its own, with copies of the user's files.
fn in_rust(
    job: &BoardJob<'_>,
    plans: &[ControllerPlan],
    folder: &Path,
    into: &Path,
) -> Result<(Command, PathBuf)> {
    let mut all = FileSet::default();
    all.add("Cargo.toml", NATIVE_MANIFEST);
    all.add("src/main.rs", native_rust(job));
    all.merge_under("src/controls", modules(&job.board.name.value, plans));
    write(&all, into)?;
    for one in plans {
        let name = format!("{}.rs", one.ident);
        let path = folder.join("src/user").join(&name);
        let text = std::fs::read(&path).with_context(|| format!("cannot read {}", shown(&path)))?;
        write_file(&into.join("src/user").join(name), &text)?;
    }
    let mut command = Command::new(std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned()));
    command.args(["build", "--quiet", "--offline", "--manifest-path"]).arg(into.join("Cargo.toml"));
    // What is set for another project does not count here.
    command.env_remove("CARGO_TARGET_DIR").env_remove("CARGO_BUILD_TARGET").env_remove("RUSTFLAGS");
    Ok((command, into.join("target/debug/controllers")))
}

/// The package of the user's code in Rust on this computer. It is no part of the firmware's workspace.
const NATIVE_MANIFEST: &str = "[package]
name = \"controllers\"
version = \"0.0.0\"
edition = \"2024\"

[workspace]

[profile.dev]
opt-level = 1
";

/// The program while it runs.
pub(crate) struct Running {
    built: Built,
    child: Option<Talk>,
}

/// The ends of a running program.
struct Talk {
    child: Child,
    requests: ChildStdin,
    answers: Receiver<Vec<u8>>,
    /// Bytes that have come and that no step has taken.
    held: Vec<u8>,
}

impl Running {
    /// Starts the program.
    ///
    /// # Errors
    /// Why it does not start.
    pub(crate) fn new(built: Built) -> Result<Self, String> {
        let mut running = Self { built, child: None };
        running.restart()?;
        Ok(running)
    }
}

impl Talk {
    fn new(program: &Path) -> Result<Self, String> {
        let spawned = Command::new(program).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = spawned.map_err(|why| format!("it cannot be started ({why})"))?;
        let (Some(requests), Some(mut output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err("it has no input or output".to_owned());
        };
        let (sender, answers) = sync_channel(16);
        std::thread::spawn(move || {
            let mut bytes = vec![0; ANSWER_BYTES_MAX];
            while let Ok(count @ 1..) = output.read(&mut bytes) {
                let Some(read) = bytes.get(..count) else { return };
                if sender.send(read.to_vec()).is_err() {
                    return;
                }
            }
        });
        Ok(Self { child, requests, answers, held: Vec::new() })
    }

    /// Takes as many bytes of answers as there is room for.
    fn take(&mut self, answer: &mut [u8]) -> Result<(), String> {
        while self.held.len() < answer.len() {
            match self.answers.recv_timeout(STEP_MAX) {
                Ok(bytes) => self.held.extend(bytes),
                Err(RecvTimeoutError::Timeout) => {
                    return Err(format!("a step took longer than {} s", STEP_MAX.as_secs()));
                }
                Err(RecvTimeoutError::Disconnected) => return Err(self.why()),
            }
        }
        let length = answer.len();
        let taken = self.held.drain(..length);
        for (to, from) in answer.iter_mut().zip(taken) {
            *to = from;
        }
        Ok(())
    }

    /// How the program ended.
    fn why(&mut self) -> String {
        self.child
            .wait()
            .map_or_else(|why| why.to_string(), |status| format!("it ended with {status}"))
    }
}

impl Drop for Talk {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl UserCode for Running {
    fn restart(&mut self) -> Result<(), String> {
        self.child = None;
        self.child = Some(Talk::new(&self.built.program)?);
        Ok(())
    }

    fn step(&mut self, which: u8, request: &[u8], answer: &mut [u8]) -> Result<(), String> {
        let Some(talk) = &mut self.child else { return Err("it was not started".to_owned()) };
        let sent = talk.requests.write_all(&[&[which], request].concat());
        if sent.and_then(|()| talk.requests.flush()).is_err() {
            return Err(talk.why());
        }
        talk.take(answer)
    }
}
