//! The three decoders of the wire, in Rust, C and C++, compared with the definition and each other.

mod agree;
mod damage;
mod naive;
mod program;
mod streams;

use std::path::{Path, PathBuf};

/// The decoders other than the one in Rust. The one in C does not support stamps or health yet.
const OTHERS: [&str; 2] = ["c", "cpp"];

/// The path of a folder for one test.
fn scratch(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("decoders").join(name)
}

/// Whether all tools are here; if not, reports it, or fails if tools are required.
fn tools(names: &[&str]) -> bool {
    names.iter().all(|name| sensedsl_tests::has(name))
}
