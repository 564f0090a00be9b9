//! `--timeout` of the commands that ask many questions: they end with the results so far.
#![allow(missing_docs, reason = "tests need none")]
#![cfg(test)]
#![allow(clippy::disallowed_methods, reason = "a test runs the program")]

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use sensedsl_model::kind::KindName;

/// A file with boards, and devices that may be on any of them.
fn file(name: &str, boards: usize, devices: usize) -> PathBuf {
    let mut text = String::new();
    for board in 0..boards {
        let _ =
            writeln!(text, "board Brd{board} on STM32F407VGT6 {{ link {{ transport = none; }} }}");
    }
    for id in 1..=devices {
        let _ = writeln!(text, "sensor Dev{id} returns uint16 {{ id = {id}; type = analog; }}");
    }
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, text).unwrap();
    path
}

fn run(arguments: &[&str], file: &PathBuf, more: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sensedsl"));
    command.args(arguments).arg(file).args(more).output().unwrap()
}

/// Runs the program like [`run`], within a time limit; in one of three tries, because the machine
/// may be busy.
fn run_within(most: Duration, arguments: &[&str], file: &PathBuf, more: &[&str]) -> Output {
    let mut tries = (0..3).map(|_| {
        let start = Instant::now();
        let output = run(arguments, file, more);
        (start.elapsed() < most).then_some(output)
    });
    tries.find_map(|output| output).unwrap()
}

fn json(output: &Output) -> serde_json::Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn capacity_ends_with_the_kinds_that_were_looked_at() {
    let boards = file("capacity.sense", 100, 1);
    // Far more than is needed on a quiet machine, far less than the whole takes.
    let most = Duration::from_secs(4);
    let more = ["--timeout", "1", "--format", "json"];
    let cut = run_within(most, &["capacity"], &boards, &more);
    let log = String::from_utf8_lossy(&cut.stderr).into_owned();
    // On a slow machine, not even the wiring is found.
    if cut.status.success() {
        let answer = json(&cut);
        assert_eq!(answer["complete"], false);
        let all = 100 * KindName::wired().count();
        assert!(answer["capacity"].as_array().unwrap().len() < all);
        assert!(log.contains("stopped: ") && log.contains(&format!(" of {all} were not")), "{log}");
    } else {
        assert!(log.contains("E0404"), "{log}");
    }

    let whole = run(&["capacity"], &file("whole.sense", 1, 1), &["--format", "json"]);
    assert_eq!(json(&whole)["complete"], true);
    assert_eq!(json(&whole)["capacity"].as_array().unwrap().len(), KindName::wired().count());
}

#[test]
fn explain_ends_with_the_pins_that_were_looked_at() {
    let boards = file("explain.sense", 60, 60);
    let more = ["Dev1", "--timeout", "2", "--format", "json"];
    let cut = run_within(Duration::from_secs(5), &["explain", "wiring"], &boards, &more);
    let log = String::from_utf8_lossy(&cut.stderr).into_owned();
    // On a slow machine, not even the wiring is found.
    if cut.status.success() {
        assert!(log.contains("stopped: there may be more pins"), "{log}");
        assert_eq!(json(&cut)["complete"], false);
    } else {
        assert!(log.contains("E0404"), "{log}");
    }
    let one = file("one.sense", 1, 1);
    let whole = run(&["explain", "wiring"], &one, &["Dev1", "--format", "json"]);
    assert_eq!(json(&whole)["complete"], true);
}

#[test]
fn no_time_at_all_is_said() {
    let one = file("none.sense", 1, 1);
    for (arguments, more) in [
        (vec!["capacity"], vec!["--timeout", "0"]),
        (vec!["explain", "wiring"], vec!["Dev1", "--timeout", "0"]),
        (vec!["explain", "timing"], vec!["--timeout", "0"]),
    ] {
        let output = run(&arguments, &one, &more);
        assert_eq!(output.status.code(), Some(1));
        assert!(String::from_utf8_lossy(&output.stderr).contains("E0404"), "{arguments:?}");
    }
}
