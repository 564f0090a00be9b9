//! The three decoders of the wire, in Rust, C and C++, against the definition and each other.

mod agree;
mod damage;
mod naive;
mod program;
mod streams;

use std::path::{Path, PathBuf};

/// Those beside the one in Rust. The one in C knows neither stamps nor health yet.
const OTHERS: [&str; 2] = ["c", "cpp"];

/// A folder of a test's own.
fn scratch(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("decoders").join(name)
}

/// Whether all are here; otherwise says so, or fails where tools are required.
fn tools(names: &[&str]) -> bool {
    names.iter().all(|name| sensedsl_tests::has(name))
}
