//! Built for small cores, nothing in the crate can panic: no symbol of `core::panicking` is left.
//!
//! This takes a toolchain with the sources of `core`, which Debian has as `rustc-web` and
//! `rust-web-src`, and a minute, so it runs only if everything is asked for
//! (`SENSEDSL_THOROUGH=2`).
#![expect(clippy::disallowed_methods, reason = "a test builds and runs programs")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

use std::path::Path;
use std::process::Command;

use sensedsl_tests::{has, is_exhaustive, root};

#[test]
fn no_core_is_given_a_panic() {
    let rustc = Path::new("/usr/bin/rustc");
    let sources = Path::new("/usr/lib/rustlib/src/rust/library/core/src/lib.rs");
    if !is_exhaustive() || !rustc.exists() || !sources.exists() || !has("arm-none-eabi-nm") {
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("thumb");
    for target in ["thumbv6m-none-eabi", "thumbv7em-none-eabihf"] {
        let mut command = Command::new(std::env::var_os("CARGO").unwrap());
        command.current_dir(root()).env("RUSTC", rustc).env("RUSTC_BOOTSTRAP", "1");
        command.env_remove("RUSTFLAGS").env("CARGO_TARGET_DIR", &folder);
        command
            .env("CARGO_PROFILE_RELEASE_PANIC", "abort")
            .env("CARGO_PROFILE_RELEASE_LTO", "false");
        command.env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "s");
        command.args([
            "build",
            "--release",
            "-Zbuild-std=core",
            "-p",
            "sense-rt",
            "--target",
            target,
        ]);
        let output = command.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let library = folder.join(target).join("release/libsense_rt.rlib");
        let output = Command::new("arm-none-eabi-nm").arg("-C").arg(&library).output().unwrap();
        let symbols = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(symbols.contains("Reporter"), "{target}: nothing is in it");
        let panics: Vec<&str> = symbols.lines().filter(|line| line.contains("panic")).collect();
        assert!(panics.is_empty(), "{target}: {panics:#?}");
    }
}
