//! What the user's own code gets and gives: declarations in C and in Rust, first files that the user goes on with, and
//! the program that runs the code on a computer.
//!
//! In: a board's job with controllers. Out: files, by their names in the folder that a system gives them.
//!
//! The program reads requests from its standard input and writes answers to its standard output, one for each step, so
//! that it runs in lockstep with a simulated board. Numbers are in network byte order:
//!
//! | request | bytes |
//! | --- | --- |
//! | the controller, from 0 | 1 |
//! | microseconds since its last step; 0 for the first | 4 |
//! | for each device that it reads: valid or not, microseconds of age, the value | 1 + 4 + n |
//!
//! The answer has, for each device that it sets, whether the step has set it, and the value: 1 + n bytes.

mod plan;
mod reserved;
mod words;

use askama::Template;
use sensedsl_files::{FileSet, print};
use sensedsl_job::BoardJob;

pub use plan::{ControllerPlan, FieldPlan, controllers};
pub use reserved::controller as controller_ident;

/// Declares templates that print one controller.
macro_rules! of_controller {
    ($($name:ident = $path:literal;)*) => {
        $(
            #[derive(Template)]
            #[template(path = $path, escape = "none")]
            struct $name<'a> {
                board: &'a str,
                one: &'a ControllerPlan,
            }
        )*
    };
}

of_controller! {
    Module = "templates/controller.rs.txt";
    FirstRust = "templates/user.rs.txt";
}

/// The declarations of a controller in C.
#[derive(Template)]
#[template(path = "templates/controller.h.txt", escape = "none")]
struct Header<'a> {
    board: &'a str,
    one: &'a ControllerPlan,
    headers: &'a Headers,
}

/// The first file in C of a controller.
#[derive(Template)]
#[template(path = "templates/controller.c.txt", escape = "none")]
struct FirstC<'a> {
    board: &'a str,
    one: &'a ControllerPlan,
    headers: &'a Headers,
}

/// Where the headers of controllers are, as the user's files name it and as people do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Headers {
    /// The path in front of a header's name in the user's files; empty if the compiler finds them.
    pub path: &'static str,
    /// The folder, below that of the firmware.
    pub folder: &'static str,
    /// The user's folder.
    pub user: &'static str,
}

/// A folder of headers that the compiler is told of.
pub const GENERATED: Headers = Headers { path: "", folder: "generated", user: "user" };

/// Declares templates that print all controllers of a board.
macro_rules! of_board {
    ($($name:ident = $path:literal;)*) => {
        $(
            #[derive(Template)]
            #[template(path = $path, escape = "none")]
            struct $name<'a> {
                board: &'a str,
                all: &'a [ControllerPlan],
            }
        )*
    };
}

of_board! {
    NativeC = "templates/native.c.txt";
    Modules = "templates/controls.rs.txt";
    NativeRust = "templates/native.rs.txt";
}

/// The declarations of a board's controllers in C, a header for each.
#[must_use]
pub fn headers(board: &str, all: &[ControllerPlan], headers: &Headers) -> FileSet {
    let mut files = FileSet::default();
    for one in all {
        files.add(format!("{}.h", one.ident), print(&Header { board, one, headers }));
    }
    files
}

/// The files in C that the user goes on with: they compile, and set nothing.
#[must_use]
pub fn first_c(board: &str, all: &[ControllerPlan], headers: &Headers) -> FileSet {
    let mut files = FileSet::default();
    for one in all {
        files.add_once(format!("{}.c", one.ident), print(&FirstC { board, one, headers }));
    }
    files
}

/// The program around the user's code in C that runs it on a computer.
#[must_use]
pub fn native_c(job: &BoardJob<'_>) -> String {
    print(&NativeC { board: &job.board.name.value, all: &controllers(job) })
}

/// The declarations of a board's controllers in Rust: the files of a module `controls`, beside the folder `user`.
#[must_use]
pub fn modules(board: &str, all: &[ControllerPlan]) -> FileSet {
    let mut files = FileSet::default();
    if !all.is_empty() {
        files.add("mod.rs", print(&Modules { board, all }));
    }
    for one in all {
        files.add(format!("{}.rs", one.ident), print(&Module { board, one }));
    }
    files
}

/// The files in Rust that the user goes on with: they compile, and set nothing.
#[must_use]
pub fn first_rust(board: &str, all: &[ControllerPlan]) -> FileSet {
    let mut files = FileSet::default();
    for one in all {
        files.add_once(format!("{}.rs", one.ident), print(&FirstRust { board, one }));
    }
    files
}

/// The program around the user's code in Rust that runs it on a computer: a `main.rs` beside `controls`.
#[must_use]
pub fn native_rust(job: &BoardJob<'_>) -> String {
    print(&NativeRust { board: &job.board.name.value, all: &controllers(job) })
}
