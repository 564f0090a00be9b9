//! Building generated firmware: what it needs of the machine, looked at before anything is built.
//!
//! `program` finds the firmware in a generated folder and reads what builds it: make or cargo. `tree` holds what a
//! Makefile wants against the user's tree of ChibiOS, `tools` looks for make and the compiler, `cargo` for cargo and
//! the processor's core library, `probe` for what writes to a board, and `raw` makes the bytes that some of those take.
//! What is missing comes back as a diagnostic; nothing here says anything.

pub(crate) mod cargo;
pub(crate) mod probe;
mod program;
pub(crate) mod raw;
mod tools;
mod tree;

use std::process::{Command, ExitStatus, Stdio};

pub(crate) use program::{Build, Program, Wants, in_folder};
pub(crate) use tools::{Make, tools};
pub(crate) use tree::tree;

/// What a program says when it is asked something: both streams. None where there is no such program.
fn asked(program: &str, arguments: &[&str]) -> Option<String> {
    let mut command = Command::new(program);
    let output = command.args(arguments).stdin(Stdio::null()).output().ok()?;
    let said = [output.stdout, output.stderr].map(|one| String::from_utf8_lossy(&one).into_owned());
    Some(said.join("\n"))
}

/// How a program ended, in words: `status 2`.
pub(crate) fn ending(status: ExitStatus) -> String {
    status.code().map_or_else(|| "a signal".to_owned(), |code| format!("status {code}"))
}
