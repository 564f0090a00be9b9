//! `cargo xtask fuzz`: builds the fuzz targets with the compiler at hand, runs them, keeps new
//! inputs, and reports coverage and findings.
//!
//! Coverage comes from LLVM's pass, which a stable compiler also runs; the engine is libFuzzer,
//! from clang if that is installed, otherwise compiled from `libfuzzer-sys`.

mod engine;
mod options;
mod tally;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use anyhow::{Context as _, Result, bail};

use engine::Engine;
use options::{Effort, Options};
use tally::Tally;

use crate::say;

/// All targets, each with the longest input that is tried.
const TARGETS: &[(&str, usize)] = &[
    ("text", 2048),
    ("table", 2048),
    ("pipeline", 512),
    ("import_tabular", 2048),
    ("import_workbook", 2048),
    ("import_cubemx", 4096),
    ("import_ioc", 2048),
    ("import_hwdef", 2048),
    ("import_micropython", 2048),
    ("import_betaflight", 2048),
    ("import_zephyr", 2048),
    ("import_arduino", 2048),
    ("import_dbc", 2048),
    ("certificate", 128),
    ("decoders", 160),
];
/// The most inputs of a target that are kept in the repository, so that replaying them stays quick.
const KEPT_MAX: usize = 120;
/// A longer input is not kept, unless its file has a name of its own.
const KEPT_BYTES_MAX: u64 = 4096;
/// The options of a short run: the corpus, then the same inputs each time, as far as the time
/// allows.
const BRIEFLY: [&str; 3] = ["-runs=1000", "-seed=1", "-max_total_time=15"];
/// The time in seconds that minimising a finding may take.
const MINIMISE_S: u64 = 60;

/// The folders of the fuzzer.
#[derive(Debug)]
struct Folders {
    /// `fuzz`, with its own workspace.
    fuzz: PathBuf,
}

impl Folders {
    fn new() -> Result<Self> {
        let own = Path::new(env!("CARGO_MANIFEST_DIR"));
        let root = own.parent().context("xtask lies in no repository")?;
        Ok(Self { fuzz: root.join("fuzz") })
    }

    /// The corpus in the repository.
    fn kept(&self, target: &str) -> PathBuf {
        self.fuzz.join("corpus").join(target)
    }

    /// The inputs that runs on this machine have added.
    fn grown(&self, target: &str) -> PathBuf {
        self.fuzz.join("target/corpus").join(target)
    }
}

pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let options = Options::read(arguments)?;
    let targets: Vec<(&str, usize)> = match options.targets.as_slice() {
        [] => TARGETS.to_vec(),
        named => named.iter().map(|name| known(name)).collect::<Result<_>>()?,
    };
    let folders = Folders::new()?;
    let engine = Engine::build(
        &folders.fuzz,
        targets.iter().map(|(target, _)| *target),
        options.effort == Effort::Brief,
    )?;
    let count = u32::try_from(targets.len()).unwrap_or(u32::MAX);
    let mut found = 0;
    for (target, bytes_max) in targets {
        let tally = fuzz(&engine, &folders, target, bytes_max, options.effort.share(count))?;
        say(&tally.line(target))?;
        found += tally.findings.len();
        for finding in &tally.findings {
            let at = keep_finding(&engine, &folders, target, finding)?;
            say(&format!("    {} fails: mend it and give the file a name\n", at.display()))?;
        }
        if options.minimise {
            say(&minimise(&engine, &folders, target)?)?;
        }
    }
    if found > 0 {
        bail!("{found} findings");
    }
    Ok(())
}

fn known(name: &str) -> Result<(&'static str, usize)> {
    let known = TARGETS.iter().find(|(target, _)| *target == name).copied();
    known.with_context(|| {
        let all: Vec<&str> = TARGETS.iter().map(|(target, _)| *target).collect();
        format!("there is no target {name}; there are {}", all.join(", "))
    })
}

/// Runs one target.
fn fuzz(
    engine: &Engine,
    folders: &Folders,
    target: &str,
    bytes_max: usize,
    effort: Effort,
) -> Result<Tally> {
    let findings = folders.fuzz.join("target/findings").join(target);
    for folder in [&folders.grown(target), &folders.kept(target), &findings] {
        fs::create_dir_all(folder)?;
    }
    let mut command = engine.command(target);
    command.args(["-print_final_stats=1", "-rss_limit_mb=2048", "-timeout=30", "-entropic=0"]);
    command.arg(format!("-max_len={bytes_max}"));
    command.arg(format!("-artifact_prefix={}/", findings.display()));
    match effort {
        Effort::Runs(runs) => {
            command.arg(format!("-runs={runs}"));
        }
        Effort::Time(time) => {
            command.arg(format!("-max_total_time={}", time.as_secs().max(1)));
        }
        Effort::Brief => {
            command.args(BRIEFLY);
        }
    }
    let words = folders.fuzz.join("dictionaries").join(format!("{target}.dict"));
    if words.exists() {
        command.arg(format!("-dict={}", words.display()));
    }
    command.arg(folders.grown(target)).arg(folders.kept(target));
    let before = files(&findings)?;
    let log = engine.logged(command, target)?;
    let new = files(&findings)?.into_iter().filter(|file| !before.contains(file));
    let tally = Tally::read(&log.text, new.collect());
    if !log.succeeded && tally.findings.is_empty() {
        bail!("{target} ended with an error: see {}", log.path.display());
    }
    Ok(tally)
}

/// Minimises a finding and puts it into the corpus, where the tests see it.
fn keep_finding(
    engine: &Engine,
    folders: &Folders,
    target: &str,
    finding: &Path,
) -> Result<PathBuf> {
    let name = finding.file_name().map(|name| name.to_string_lossy().into_owned());
    let kept = folders.kept(target).join(format!("finding-{}", name.unwrap_or_default()));
    fs::copy(finding, &kept)?;
    // A timeout or an out-of-memory finding is left as it is: trying it often is not a way to make
    // it small.
    if kept.to_string_lossy().contains("finding-crash") {
        let mut command = engine.command(target);
        command.args(["-minimize_crash=1", "-timeout=30", "-rss_limit_mb=2048"]);
        command.arg(format!("-max_total_time={MINIMISE_S}"));
        command.arg(format!("-exact_artifact_path={}", kept.display())).arg(finding);
        engine.logged(command, &format!("{target}-minimise"))?;
    }
    Ok(kept)
}

/// Replaces the corpus in the repository by the fewest inputs with the same coverage. Files with a
/// name of their own stay.
fn minimise(engine: &Engine, folders: &Folders, target: &str) -> Result<String> {
    let (kept, grown) = (folders.kept(target), folders.grown(target));
    let fresh = folders.fuzz.join("target/minimised").join(target);
    if fresh.exists() {
        fs::remove_dir_all(&fresh)?;
    }
    fs::create_dir_all(&fresh)?;
    let mut command = engine.command(target);
    command.args(["-set_cover_merge=1", "-timeout=30", "-rss_limit_mb=2048"]);
    command.arg(&fresh).arg(&grown).arg(&kept);
    let log = engine.logged(command, &format!("{target}-merge"))?;
    if !log.succeeded {
        bail!("{target} cannot be minimised: see {}", log.path.display());
    }
    let mut inputs = Vec::new();
    for file in files(&fresh)? {
        let size = fs::metadata(&file)?.len();
        if size <= KEPT_BYTES_MAX {
            inputs.push((size, file));
        }
    }
    inputs.sort();
    inputs.truncate(KEPT_MAX);
    for old in files(&kept)?.iter().filter(|file| is_hash(file)) {
        fs::remove_file(old)?;
    }
    let (mut count, mut total) = (0, 0);
    for (size, file) in inputs {
        if let Some(name) = file.file_name().filter(|_| is_hash(&file)) {
            fs::copy(&file, kept.join(name))?;
            (count, total) = (count + 1, total + size);
        }
    }
    Ok(format!("    {count} inputs of {total} bytes are kept in {}\n", kept.display()))
}

/// Whether the fuzzer has named the file.
fn is_hash(file: &Path) -> bool {
    let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    name.len() == 40 && name.bytes().all(|byte| byte.is_ascii_hexdigit())
}

fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        files.push(entry?.path());
    }
    files.sort();
    Ok(files)
}

/// The standard output of a program; `None` if it cannot be run or fails.
fn output_of(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// The share of a time for each of several targets.
fn divided(time: Duration, by: u32) -> Duration {
    time / by.max(1)
}
