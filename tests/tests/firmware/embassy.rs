//! Projects for Embassy, built for the board as a user builds them: no warning may come from them.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

use sensedsl_tests::{Scratch, has, is_thorough, missing, root, sensedsl};

use super::tools::scratch;

/// All projects are built in one folder, one at a time.
static FOLDER: Mutex<()> = Mutex::new(());

/// A program of the only board of a design; none where the machine cannot build it, or has no time to.
pub(crate) fn program(name: &str, text: &str) -> Option<PathBuf> {
    if !is_thorough() {
        return None;
    }
    Some(build(&project(name, text)?))
}

/// The project of the only board of a design; none where the machine cannot build it.
pub(crate) fn project(name: &str, text: &str) -> Option<PathBuf> {
    if !Path::new("/usr/bin/rustc").exists() || !has("arm-none-eabi-ld") {
        missing("rustc-web with rust-web-src, and arm-none-eabi-ld");
        return None;
    }
    let designs = Scratch::new(name);
    let file = designs.write("design.sense", text).display().to_string();
    let folder = scratch(name);
    let out = folder.display().to_string();
    let call = ["generate", &file, "--target", "embassy", "--without", "host", "-q", "-o", &out];
    let _ = sensedsl(call).run().exits(0);
    let mut boards = std::fs::read_dir(folder.join("firmware")).unwrap();
    Some(boards.next().unwrap().unwrap().path())
}

/// Builds a project without optimisation at link time, which takes long and changes nothing here.
pub(crate) fn build(board: &Path) -> PathBuf {
    let target = root().join("target/embassy-build");
    let _alone = FOLDER.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let mut cargo = Command::new("cargo");
    cargo.args(["build", "--release", "-Zbuild-std=core", "--locked", "--target-dir"]).arg(&target);
    let settings = [
        "target.thumbv7em-none-eabihf.linker=\"arm-none-eabi-ld\"",
        "profile.release.lto=false",
        "profile.release.codegen-units=16",
    ];
    for setting in settings {
        cargo.args(["--config", setting]);
    }
    cargo.env("RUSTC_BOOTSTRAP", "1").env("RUSTC", "/usr/bin/rustc").env_remove("RUSTFLAGS");
    let output = cargo.current_dir(board).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && !said.contains("warning"), "{said}");
    let program = board.join("firmware.elf");
    let built = target.join("thumbv7em-none-eabihf/release/firmware");
    let _ = std::fs::copy(built, &program).unwrap();
    program
}
