//! The three decoders of the wire, in Rust, C and C++, against the definition and each other.
#![expect(clippy::disallowed_methods, reason = "tests run compilers on files")]

#[cfg(test)]
mod agree;
#[cfg(test)]
mod damage;
#[cfg(test)]
mod naive;
#[cfg(test)]
mod program;
#[cfg(test)]
mod streams;

#[cfg(test)]
use std::path::{Path, PathBuf};

/// A folder of a test's own.
#[cfg(test)]
fn scratch(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("decoders").join(name)
}

/// Whether all are here; otherwise says so, or fails where tools are required.
#[cfg(test)]
fn tools(names: &[&str]) -> bool {
    names.iter().all(|name| sensedsl_tests::has(name))
}
