//! The compiled fuzzer: how it is built, called and listened to.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, Result, bail};

use super::output_of;

/// Calls that tell the fuzzer what values are compared with.
const COMPARES: &str = "-Cllvm-args=-sanitizer-coverage-trace-compares";
/// Coverage as LLVM has it, by flags that a stable compiler takes.
const COVERAGE: &[&str] = &[
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=4",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
    // Each function is counted once.
    "-Ccodegen-units=1",
    "--cfg",
    "fuzzing",
    "-Clinker=clang",
];

/// The program that holds the decoders in C and C++.
const DECODERS: &str = "sensedsl-fuzz-decoders";

/// The program of a target.
fn program(target: &str) -> &'static str {
    if target == "decoders" { DECODERS } else { "sensedsl-fuzz" }
}

/// Programs that have been built.
#[derive(Debug)]
pub(super) struct Engine {
    programs: PathBuf,
    logs: PathBuf,
}

/// What a program has said.
#[derive(Debug)]
pub(super) struct Log {
    pub(super) path: PathBuf,
    pub(super) text: String,
    pub(super) succeeded: bool,
}

impl Engine {
    /// Builds the programs of these targets, quickly or to run quickly.
    pub(super) fn build<'t>(
        fuzz: &Path,
        targets: impl Iterator<Item = &'t str>,
        is_brief: bool,
    ) -> Result<Self> {
        let version = output_of("rustc", &["-vV"]).context("rustc does not run")?;
        let host = version.lines().find_map(|line| line.strip_prefix("host: "));
        let host = host.context("rustc does not say for what it compiles")?;
        if output_of("clang", &["--version"]).is_none() {
            bail!("clang is missing, with its runtimes (Debian: clang and libclang-rt-14-dev)");
        }
        let profile = if is_brief { "brief" } else { "release" };
        let folder = fuzz.join("target");
        let programs: BTreeSet<&str> = targets.map(program).collect();
        for program in programs {
            // Streams of frames are made, not found by comparing, and the calls would cost more
            // than the decoders.
            let more = (program != DECODERS).then_some(COMPARES);
            let flags: Vec<&str> = COVERAGE.iter().copied().chain(more).collect();
            let mut cargo = Command::new(env!("CARGO"));
            cargo.current_dir(fuzz).args(["build", "--quiet", "--locked", "--package", program]);
            // A target that is named keeps the flags away from build scripts and macros.
            cargo.args(["--profile", profile, "--target", host, "--target-dir"]).arg(&folder);
            cargo.env_remove("RUSTFLAGS").env("CARGO_ENCODED_RUSTFLAGS", flags.join("\x1f"));
            let library = format!("libclang_rt.fuzzer-{}.a", std::env::consts::ARCH);
            let library = output_of("clang", &[&format!("--print-file-name={library}")]);
            if let Some(library) = library.filter(|path| Path::new(path).is_absolute()) {
                cargo.env("CUSTOM_LIBFUZZER_PATH", library);
            }
            if !cargo.status()?.success() {
                bail!("{program} does not build");
            }
        }
        let logs = folder.join("logs");
        fs::create_dir_all(&logs)?;
        Ok(Self { programs: folder.join(host).join(profile), logs })
    }

    /// The program of a target.
    pub(super) fn command(&self, target: &str) -> Command {
        let mut command = Command::new(self.programs.join(program(target)));
        command.env("SENSEDSL_FUZZ_TARGET", target);
        command
    }

    /// Runs a program to its end; what it says goes to a file.
    pub(super) fn logged(&self, mut command: Command, name: &str) -> Result<Log> {
        let path = self.logs.join(format!("{name}.log"));
        let file = File::create(&path)?;
        command.stdin(Stdio::null()).stdout(file.try_clone()?).stderr(file);
        let status = command.status()?;
        let text = String::from_utf8_lossy(&fs::read(&path)?).into_owned();
        Ok(Log { path, text, succeeded: status.success() })
    }
}
