//! The compiled fuzzer: how it is built and called, and how its output is read.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, Result, bail};

use super::output_of;

/// The option for calls that report the operands of comparisons to the fuzzer.
const COMPARES: &str = "-Cllvm-args=-sanitizer-coverage-trace-compares";
/// LLVM's coverage, enabled by flags that a stable compiler accepts.
const COVERAGE: &[&str] = &[
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=4",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
    // With one unit, each function is counted once.
    "-Ccodegen-units=1",
    "--cfg",
    "fuzzing",
    "-Clinker=clang",
];

/// The build of a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Build {
    package: &'static str,
    /// Whether the operands of comparisons are reported to the fuzzer.
    compares: bool,
}

impl Build {
    /// The build for a target. If the bytes are choices from which a design, a certificate or a
    /// stream is made, they do not contain the values that the program compares with, and reporting
    /// comparisons would take more than half of the time. A brief run does without a separate build
    /// for that.
    fn of(target: &str, is_brief: bool) -> Self {
        match target {
            "decoders" => Self { package: "sensedsl-fuzz-decoders", compares: false },
            "pipeline" | "certificate" => Self { package: "sensedsl-fuzz", compares: is_brief },
            _ => Self { package: "sensedsl-fuzz", compares: true },
        }
    }

    /// The folder in which it is built, within `target`.
    fn folder(self, target: &Path) -> PathBuf {
        if self.compares { target.to_owned() } else { target.join("choices") }
    }
}

/// The programs that have been built.
#[derive(Debug)]
pub(super) struct Engine {
    target: PathBuf,
    /// The path below the folder of a build.
    programs: PathBuf,
    is_brief: bool,
    logs: PathBuf,
}

/// The output of a program.
#[derive(Debug)]
pub(super) struct Log {
    pub(super) path: PathBuf,
    pub(super) text: String,
    pub(super) succeeded: bool,
}

impl Engine {
    /// Builds the programs of these targets: in a short time for a brief run, otherwise to run
    /// fast.
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
        let target = fuzz.join("target");
        let builds: BTreeSet<Build> = targets.map(|target| Build::of(target, is_brief)).collect();
        for build in builds {
            let more = build.compares.then_some(COMPARES);
            let flags: Vec<&str> = COVERAGE.iter().copied().chain(more).collect();
            let mut cargo = Command::new(env!("CARGO"));
            cargo.current_dir(fuzz).args(["build", "--quiet", "--locked"]);
            // An explicit target keeps the flags away from build scripts and macros.
            cargo.args(["--package", build.package, "--profile", profile, "--target", host]);
            cargo.arg("--target-dir").arg(build.folder(&target));
            cargo.env_remove("RUSTFLAGS").env("CARGO_ENCODED_RUSTFLAGS", flags.join("\x1f"));
            let library = format!("libclang_rt.fuzzer-{}.a", std::env::consts::ARCH);
            let library = output_of("clang", &[&format!("--print-file-name={library}")]);
            if let Some(library) = library.filter(|path| Path::new(path).is_absolute()) {
                cargo.env("CUSTOM_LIBFUZZER_PATH", library);
            }
            if !cargo.status()?.success() {
                bail!("{} does not build", build.package);
            }
        }
        let logs = target.join("logs");
        fs::create_dir_all(&logs)?;
        Ok(Self { target, programs: Path::new(host).join(profile), is_brief, logs })
    }

    /// The program of a target.
    pub(super) fn command(&self, target: &str) -> Command {
        let build = Build::of(target, self.is_brief);
        let folder = build.folder(&self.target).join(&self.programs);
        let mut command = Command::new(folder.join(build.package));
        command.env("SENSEDSL_FUZZ_TARGET", target);
        command
    }

    /// Runs a program to its end, with its output in a file.
    pub(super) fn logged(&self, mut command: Command, name: &str) -> Result<Log> {
        let path = self.logs.join(format!("{name}.log"));
        let file = File::create(&path)?;
        command.stdin(Stdio::null()).stdout(file.try_clone()?).stderr(file);
        let status = command.status()?;
        let text = String::from_utf8_lossy(&fs::read(&path)?).into_owned();
        Ok(Log { path, text, succeeded: status.success() })
    }
}
