//! Cargo and the core library for a board's processor: whether they are installed.

use std::path::Path;

use sensedsl_diagnostics::codes::{e0523_no_core_library, e0531_no_cargo};
use sensedsl_diagnostics::{Diagnostic, Span};

use super::asked;

/// Cargo as it is called here.
#[derive(Clone, Debug)]
pub(crate) struct Cargo(pub(crate) String);

/// Cargo, once it is known that the core library for every target triple is installed or will be
/// built.
pub(crate) fn cargo(triples: &[&str], at: Span) -> Result<Cargo, Box<Diagnostic>> {
    let cargo = variable("CARGO").unwrap_or_else(|| "cargo".to_owned());
    if asked(&cargo, &["--version"]).is_none() {
        return Err(e0531_no_cargo::no_cargo(at, &cargo, "firmware for Embassy").into());
    }
    // With this setting, cargo builds the core library itself.
    if variable("CARGO_UNSTABLE_BUILD_STD").is_some() {
        return Ok(Cargo(cargo));
    }
    let rustc = variable("RUSTC").unwrap_or_else(|| "rustc".to_owned());
    for triple in triples {
        let folder = asked(&rustc, &["--print", "target-libdir", "--target", triple]);
        let folder = folder.unwrap_or_default();
        if !Path::new(folder.lines().next().unwrap_or_default()).is_dir() {
            return Err(e0523_no_core_library::no_core_library(at, triple).into());
        }
    }
    Ok(Cargo(cargo))
}

fn variable(name: &str) -> Option<String> {
    std::env::var(name).ok().filter(|value| !value.is_empty())
}
