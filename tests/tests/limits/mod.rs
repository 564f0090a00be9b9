//! Hostile input goes in, a coded refusal comes out. For each class of input that once exhausted
//! the program's time or memory, a test makes a file and runs the real program on it. Exit status
//! and code must be those that `docs/limits.md` promises.
//!
//! No test judges absolute times, only ratios within one run (`scaling`). The kernel enforces the
//! limits: a signal ends a run that takes more than [`CPU_S_MAX`] of processor time; a run that
//! takes more than [`MEMORY_KIB_MAX`] gets no more memory and aborts. In both cases the status
//! differs from the expected one. [`WALL`] ends a run that waits for ever.
#![cfg(target_os = "linux")]

mod answers;
mod configurations;
mod files;
mod scaling;
mod sources;
mod tables;
mod texts;
mod workbooks;
mod worlds;

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use sensedsl_tests::{TempDir, binary};

/// The head of a board that has an MCU.
const BOARD: &str = "board STM32F4DiscoveryBoard {\n";
/// Processor time in seconds for a build with little optimisation, on a machine that does other
/// things too; a release build takes less than one second.
const CPU_S_MAX: u32 = 5;
/// Memory for data: 200 MB.
const MEMORY_KIB_MAX: u32 = 200_000;
/// The maximum wall time of a run.
const WALL: Duration = Duration::from_secs(60);

/// Runs the program in a folder under the limits. It must exit with this status and report this
/// code; the code is empty for input that is accepted.
#[track_caller]
fn expect(folder: &TempDir, arguments: &[&str], status: i32, code: &str) {
    expect_of(binary(), folder, arguments, status, code);
}

/// Like `expect` for a refusal: the program must report this code and no other error.
#[track_caller]
fn expect_alone(folder: &TempDir, arguments: &[&str], code: &str) {
    let output = expect_of(binary(), folder, arguments, 1, code);
    let errors: Vec<&str> = output.lines().filter(|line| line.starts_with("error[")).collect();
    assert!(matches!(errors.as_slice(), [one] if one.contains(code)), "{arguments:?}: {errors:?}");
}

#[track_caller]
fn expect_of(
    program: &Path,
    folder: &TempDir,
    arguments: &[&str],
    status: i32,
    code: &str,
) -> String {
    let limits =
        format!("ulimit -c 0; ulimit -t {CPU_S_MAX}; ulimit -d {MEMORY_KIB_MAX}; exec \"$@\"");
    let (out, err) = (folder.join(".out"), folder.join(".err"));
    let mut command = Command::new("sh");
    command.args(["-c", &limits, "sh"]).arg(program);
    command.args(arguments).current_dir(folder.path()).env("NO_COLOR", "1");
    command.stdin(Stdio::null());
    command.stdout(File::create(&out).unwrap()).stderr(File::create(&err).unwrap());
    let mut child = command.spawn().unwrap();
    let start = Instant::now();
    let ended = loop {
        if let Some(ended) = child.try_wait().unwrap() {
            break ended;
        }
        if start.elapsed() > WALL {
            child.kill().unwrap();
            child.wait().unwrap();
            panic!("{arguments:?} waits for ever");
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let output = [fs::read(err).unwrap(), fs::read(out).unwrap()].concat();
    let output = String::from_utf8_lossy(&output);
    let start: String = output.chars().take(600).collect();
    assert_eq!(ended.code(), Some(status), "{arguments:?}: {ended}\n{start}");
    assert!(output.contains(code), "{arguments:?} does not say {code}\n{start}");
    output.into_owned()
}

/// `check` or `import` must refuse the text with this code.
#[track_caller]
fn refuses(name: &str, text: impl AsRef<[u8]>, code: &str) {
    let folder = TempDir::new("limits");
    folder.write(name, text);
    let command = if name.ends_with(".sense") { "check" } else { "import" };
    expect(&folder, &[command, name], 1, code);
}

/// `n` pieces, each made from its index.
fn repeat(n: usize, piece: impl Fn(usize) -> String) -> String {
    (0..n).map(piece).collect()
}

/// A file of this size without content, which takes no space on the disk.
fn sparse(folder: &TempDir, name: &str, bytes: u64) {
    File::create(folder.join(name)).unwrap().set_len(bytes).unwrap();
}
