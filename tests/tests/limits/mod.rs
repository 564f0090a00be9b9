//! Hostile input in, a coded refusal out: for each class of input that once took the program's
//! time or memory, a file is made, the real program runs on it, and its status and code are those
//! that `docs/limits.md` promises.
//!
//! Nothing is timed and then judged, but for ratios within one run (`scaling`). The kernel holds the limits: a run that takes more than
//! [`CPU_S_MAX`] of the processor is ended by a signal, one that takes more than
//! [`MEMORY_KIB_MAX`] of memory gets no more and aborts, and both are another status than the
//! expected one. [`WALL`] ends what waits for ever.
#![cfg(target_os = "linux")]

mod answers;
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

use sensedsl_tests::{Scratch, binary};

/// The head of a board with an MCU.
const BOARD: &str = "board STM32F4DiscoveryBoard {\n";
/// Seconds of the processor in a build that is hardly optimised, on a machine that does other
/// things too; a release build takes less than one.
const CPU_S_MAX: u32 = 5;
/// Memory for data: 200 MB.
const MEMORY_KIB_MAX: u32 = 200_000;
/// How long a run may wait.
const WALL: Duration = Duration::from_secs(60);

/// Runs the program in a folder and holds it to its limits. It must exit with that status and say
/// that code; an empty code is for input that is accepted.
#[track_caller]
fn expect(folder: &Scratch, arguments: &[&str], status: i32, code: &str) {
    expect_of(binary(), folder, arguments, status, code);
}

/// It must be wrong, and say that code and no other error.
#[track_caller]
fn expect_alone(folder: &Scratch, arguments: &[&str], code: &str) {
    let said = expect_of(binary(), folder, arguments, 1, code);
    let errors: Vec<&str> = said.lines().filter(|line| line.starts_with("error[")).collect();
    assert!(matches!(errors.as_slice(), [one] if one.contains(code)), "{arguments:?}: {errors:?}");
}

#[track_caller]
fn expect_of(
    program: &Path,
    folder: &Scratch,
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
    let said = [fs::read(err).unwrap(), fs::read(out).unwrap()].concat();
    let said = String::from_utf8_lossy(&said);
    let start: String = said.chars().take(600).collect();
    assert_eq!(ended.code(), Some(status), "{arguments:?}: {ended}\n{start}");
    assert!(said.contains(code), "{arguments:?} does not say {code}\n{start}");
    said.into_owned()
}

/// `check` on one text refuses it with that code.
#[track_caller]
fn refuses(name: &str, text: impl AsRef<[u8]>, code: &str) {
    let folder = Scratch::new("limits");
    folder.write(name, text);
    let command = if name.ends_with(".sense") { "check" } else { "import" };
    expect(&folder, &[command, name], 1, code);
}

/// `n` pieces, each made of its number.
fn repeat(n: usize, piece: impl Fn(usize) -> String) -> String {
    (0..n).map(piece).collect()
}

/// A file of that size with nothing in it, which takes no place on the disk.
fn sparse(folder: &Scratch, name: &str, bytes: u64) {
    File::create(folder.join(name)).unwrap().set_len(bytes).unwrap();
}
