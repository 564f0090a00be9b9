//! `cargo xtask studio` and `cargo xtask npm`: what is made of the WebAssembly module, with npm.
//!
//! The studio is a static site in `target/web/studio`: a server of files can offer it, `sensedsl studio --site` does, and
//! a program that is built with `SENSEDSL_STUDIO=target/web/studio` has it inside. The npm package is a `.tgz` in
//! `target/web`; it is not published.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, ensure};

use crate::{say, web};

/// What the package has beside the module.
const PACKAGE: [&str; 4] = ["README.md", "package.json", "sensedsl.d.mts", "sensedsl.mjs"];

/// Builds the module and the site.
pub(crate) fn run() -> Result<()> {
    let module = web::build()?;
    let folder = web::root()?.join("web");
    npm(&folder, &["ci", "--no-audit", "--no-fund"])?;
    let mut node = Command::new("node");
    node.current_dir(&folder).args(["build.mjs", "--wasm"]).arg(&module);
    let is_built = node.status().context("Node is missing: install Node 20 or later")?.success();
    ensure!(is_built, "the studio was not built");
    Ok(())
}

/// Builds the module and the package.
pub(crate) fn pack() -> Result<()> {
    let (module, root) = (web::build()?, web::root()?);
    let folder = root.join("target/web/npm");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    for name in PACKAGE {
        fs::copy(root.join("crates/wasm").join(name), folder.join(name)).context(name)?;
    }
    for name in ["LICENSE-APACHE", "LICENSE-MIT"] {
        fs::copy(root.join(name), folder.join(name)).context(name)?;
    }
    fs::copy(module, folder.join("sensedsl_wasm.wasm"))?;
    npm(&folder, &["pack", "--pack-destination", ".."])?;
    let packed = packages(&root.join("target/web"))?;
    say(&packed.iter().map(|path| format!("{}\n", path.display())).collect::<String>())
}

fn packages(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|end| end == "tgz") {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// Has npm do something in a folder.
pub(crate) fn npm(folder: &Path, arguments: &[&str]) -> Result<()> {
    let mut npm = Command::new("npm");
    npm.current_dir(folder).args(arguments);
    let is_done = npm.status().context("npm is missing: install Node 20 or later")?.success();
    ensure!(is_done, "npm {} failed", arguments.join(" "));
    Ok(())
}
