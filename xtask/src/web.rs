//! `cargo xtask web`: the WebAssembly module.
//!
//! The standard library is compiled from its source, which Debian's packages `rustc-web` and `rust-web-src` provide in
//! equal versions, so nothing is needed that a registry does not have. The linker is that of the installed toolchain.
//! `SENSEDSL_WASM_RUSTC` names another compiler, which has the target itself.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};

use crate::say;

const TARGET: &str = "wasm32-unknown-unknown";
/// A panic ends the module, and a page cannot be told more: no text of one is in it.
const FLAGS: &str = "-Zunstable-options -Cpanic=immediate-abort -Zlocation-detail=none";
/// The path at which Debian installs the compiler.
const RUSTC: &str = "/usr/bin/rustc";

pub(crate) fn run() -> Result<()> {
    let module = build()?;
    let bytes = std::fs::metadata(&module).context("the module is not where it should be")?.len();
    say(&format!("{} ({bytes} bytes)\n", module.display()))
}

/// The repository.
pub(crate) fn root() -> Result<PathBuf> {
    Ok(Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize()?)
}

/// Builds the module, and says where it is.
pub(crate) fn build() -> Result<PathBuf> {
    let root = root()?;
    let own = std::env::var_os("SENSEDSL_WASM_RUSTC").map(PathBuf::from);
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(&root).args(["build", "--locked", "--profile", "web", "--target", TARGET]);
    cargo.args(["--package", "sensedsl-wasm", "--target-dir", "target/web"]);
    match &own {
        Some(rustc) => cargo.env("RUSTC", rustc),
        None if Path::new("/usr/lib/rustlib/src/rust/library").is_dir() => cargo
            .env("RUSTC", RUSTC)
            .env("RUSTC_BOOTSTRAP", "1")
            .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker()?)
            .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS", FLAGS)
            .args(["-Zbuild-std=std,panic_abort", "-Zbuild-std-features=optimize_for_size"]),
        None => bail!(
            "the standard library's source is missing: install Debian's rustc-web and \
             rust-web-src, or name a compiler with the target {TARGET} in SENSEDSL_WASM_RUSTC"
        ),
    };
    if !cargo.status()?.success() {
        bail!("the module was not built");
    }
    Ok(root.join("target/web").join(TARGET).join("web/sensedsl_wasm.wasm"))
}

/// The linker that the installed toolchain has for all targets.
fn linker() -> Result<PathBuf> {
    let output = Command::new("rustc").args(["--print", "target-libdir"]).output()?;
    let folder = String::from_utf8(output.stdout)?;
    let found = Path::new(folder.trim()).with_file_name("bin").join("rust-lld");
    if found.is_file() { Ok(found) } else { bail!("there is no linker at {}", found.display()) }
}
