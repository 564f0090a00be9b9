//! The runtime in Rust against the one in C, on random numbers: the same questions must get the
//! same answers.
//!
//! `core.c` and `reporter.c` are the C runtime as programs under sanitizers; `answer` asks the Rust
//! one in the same way, and `questions` generates the questions.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a test may panic")]

mod answer;
mod link;
mod moves;
mod questions;

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use sensedsl_tests::{Random, files, has, is_thorough, root};

use self::answer::Desk;

fn build(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).to_path_buf();
    let program = folder.join(format!("sense-rt-{name}-{}", std::process::id()));
    let (core, own) =
        (root().join("crates/firmware-c/runtime"), root().join("crates/sense-rt/tests/same"));
    let mut command = Command::new("gcc");
    command.args(["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"]);
    command.args(["-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]);
    command.arg("-I").arg(&core).args(files(&own, "c")).args(files(&core, "c"));
    let output = command.arg("-o").arg(&program).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    program
}

/// The answers of the C runtime, one line per question.
fn ask(program: &Path, questions: &[String]) -> Vec<String> {
    let mut child =
        Command::new(program).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let text = questions.join("\n") + "\n";
    let writer = std::thread::spawn(move || {
        // A program that a sanitizer ends stops reading; its status is checked below.
        let _ = stdin.write_all(text.as_bytes());
    });
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    let answers = String::from_utf8(output.stdout).unwrap();
    let all: Vec<String> = answers.lines().map(str::to_owned).collect();
    assert!(output.status.success(), "behind {:?}", questions.get(all.len().saturating_sub(1)));
    all
}

/// Asks one question after the other, so that the next one can depend on the answer.
#[test]
fn the_motor_in_c_moves_as_the_vectors_say() {
    if !has("gcc") {
        return;
    }
    let program = build("moves");
    let mut child =
        Command::new(&program).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let mut stdout = BufReader::new(child.stdout.take().unwrap());
    moves::hold(&mut |question| {
        writeln!(stdin, "{question}").unwrap();
        stdin.flush().unwrap();
        let mut answer = String::new();
        stdout.read_line(&mut answer).unwrap();
        answer.trim_end().to_owned()
    });
    drop(stdin);
    assert!(child.wait().unwrap().success());
    std::fs::remove_file(&program).unwrap();
}

/// The first question that the two answer differently.
fn difference(questions: &[String], of_c: &[String]) -> Option<String> {
    let mut desk = Desk::default();
    assert_eq!(questions.len(), of_c.len());
    for (index, (question, c)) in questions.iter().zip(of_c).enumerate() {
        let rust = desk.answer(question);
        if rust != *c {
            let before = &questions[index.saturating_sub(8)..index];
            return Some(format!("{question}\nC: {c}\nRust: {rust}\nbehind {before:#?}"));
        }
    }
    None
}

#[test]
fn rust_answers_as_c_does() {
    if !has("gcc") {
        return;
    }
    let program = build("core");
    let mut random = Random::new(11);
    let rounds = if is_thorough() { 200 } else { 2 };
    let questions: Vec<String> = (0..rounds).flat_map(|_| questions::round(&mut random)).collect();
    let of_c = ask(&program, &questions);
    std::fs::remove_file(&program).unwrap();
    if let Some(difference) = difference(&questions, &of_c) {
        panic!("{difference}");
    }
    // A wrong answer of each kind is reported.
    for word in questions::WORDS.split(' ') {
        let mut wrong = of_c.clone();
        let starts = |line: &&mut String| line.split(' ').next() == Some(word);
        let reported = wrong.iter_mut().find(|line| starts(line) && line.contains(' '));
        reported.unwrap_or_else(|| panic!("nothing is asked of {word}")).push('0');
        assert!(difference(&questions, &wrong).is_some(), "{word}");
    }
}
