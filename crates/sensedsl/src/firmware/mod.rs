//! The requirements for building generated firmware, checked before anything is built.
//!
//! `program` finds the firmware in a generated folder and determines what builds it: make or cargo. `tree` compares the
//! requirements of a Makefile with the user's tree of ChibiOS, `tools` checks for make and the compiler, `cargo` for
//! cargo and the processor's core library, `arduino` for what builds sketches, `probe` for tools that write to a board,
//! `drive` for drives that take programs; `raw` makes the bytes that some of these take, and `uf2` the files that
//! others do. Anything missing is returned as a diagnostic; nothing here prints.

pub(crate) mod arduino;
pub(crate) mod cargo;
pub(crate) mod drive;
pub(crate) mod probe;
mod program;
pub(crate) mod raw;
mod tools;
mod tree;
pub(crate) mod uf2;

use std::process::{Command, ExitStatus, Stdio};

pub(crate) use program::{Build, Program, Wants, in_folder};
pub(crate) use tools::{Make, tools};
pub(crate) use tree::{release, tree, tree_of};

/// The output of a program, both streams; `None` if there is no such program.
fn asked(program: &str, arguments: &[&str]) -> Option<String> {
    let mut command = Command::new(program);
    let output = command.args(arguments).stdin(Stdio::null()).output().ok()?;
    let text = [output.stdout, output.stderr].map(|one| String::from_utf8_lossy(&one).into_owned());
    Some(text.join("\n"))
}

/// The end of a program in words: `status 2`.
pub(crate) fn ending(status: ExitStatus) -> String {
    status.code().map_or_else(|| "a signal".to_owned(), |code| format!("status {code}"))
}
