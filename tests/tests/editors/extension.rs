//! The extension of VS Code, built and packed, in VS Code in a browser: with the language server as WebAssembly, and
//! with the program.
//!
//! Runs with `SENSEDSL_THOROUGH=2`; needs `npm ci --prefix editors/vscode`, `sh editors/vscode/test/code-server/install.sh`,
//! Chromium as `/usr/bin/chromium`, and the WebAssembly module, whose path `SENSEDSL_WASM` is.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{answered, binary, has, is_exhaustive, missing, root};

fn folder() -> PathBuf {
    root().join("editors/vscode")
}

fn is_possible() -> bool {
    if !is_exhaustive() || !has("node") || !has("npm") {
        return false;
    }
    let needs = [
        (folder().join("node_modules/esbuild"), "npm ci --prefix editors/vscode"),
        (
            folder().join("test/code-server/node_modules/node/bin/node"),
            "VS Code in a browser: sh editors/vscode/test/code-server/install.sh",
        ),
        (PathBuf::from("/usr/bin/chromium"), "Chromium"),
    ];
    for (path, what) in needs {
        if !path.exists() {
            missing(what);
            return false;
        }
    }
    if std::env::var_os("SENSEDSL_WASM").is_none() {
        missing("the WebAssembly module (SENSEDSL_WASM; `cargo xtask web` builds it)");
        return false;
    }
    true
}

fn npm(arguments: &[&str]) -> String {
    let mut npm = Command::new("npm");
    npm.args(arguments).current_dir(folder()).env("SENSEDSL", binary());
    answered(&mut npm, "")
}

fn packed() -> Vec<u8> {
    npm(&["run", "build"]);
    npm(&["run", "package"]);
    let is_packed = |path: &Path| path.extension().is_some_and(|end| end == "vsix");
    let mut paths = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    std::fs::read(paths.find(|path| is_packed(path)).unwrap()).unwrap()
}

#[test]
fn it_works_in_vs_code() {
    if !is_possible() {
        return;
    }
    npm(&["run", "check"]);
    let first = packed();
    assert!(first == packed(), "the same files are packed into other bytes");
    let told = npm(&["test"]);
    let none = |what: &str| {
        let mut counts = told.lines().filter(|line| line.starts_with(&format!("# {what} ")));
        counts.clone().count() == 2 && counts.all(|line| line.ends_with(" 0"))
    };
    assert!(none("fail") && none("skipped"), "{told}");
}
