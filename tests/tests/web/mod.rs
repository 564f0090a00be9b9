//! The WebAssembly module answers in Node exactly as the same code does here, byte for byte, for
//! every example and the whole corpus.
//!
//! `SENSEDSL_WASM` is the path of the module, which `cargo xtask web` builds.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{answered, files, has, missing, one_in, read, root};

/// A request for a file, together with the text files beside it.
fn request(file: &Path) -> String {
    let entries = fs::read_dir(file.parent().unwrap()).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
    let is_near = |path: &PathBuf| {
        // The corpus has many files; they use none of the others except tables.
        path == file || path.extension().is_some_and(|end| end == "csv")
    };
    let files = paths.filter(is_near).filter_map(|path| {
        let text = String::from_utf8(fs::read(&path).unwrap()).ok()?;
        Some((name(&path), text))
    });
    let files: BTreeMap<String, String> = files.collect();
    serde_json::json!({ "path": name(file), "files": files }).to_string()
}

#[test]
fn the_module_says_what_the_program_says() {
    let Some(module) = std::env::var_os("SENSEDSL_WASM") else {
        missing("the WebAssembly module (SENSEDSL_WASM; `cargo xtask web` builds it)");
        return;
    };
    if !has("node") {
        return;
    }
    let folders = ["examples", "tests/corpus/ok", "tests/corpus/err"];
    let paths: Vec<PathBuf> =
        folders.iter().flat_map(|folder| files(&root().join(folder), "sense")).collect();
    let requests: Vec<String> = paths.iter().map(|file| request(file)).collect();
    let mut node = Command::new("node");
    node.arg(root().join("tests/tests/web/answers.mjs")).arg(&module);
    let all = serde_json::to_vec(&requests).unwrap();
    let answers: Vec<String> = serde_json::from_str(&answered(&mut node, all)).unwrap();
    assert_eq!(answers.len(), requests.len());
    for ((file, request), answer) in paths.iter().zip(&requests).zip(answers) {
        assert_eq!(answer, sensedsl_web::ask(request), "{}", file.display());
    }
}

/// The page's function returns what the commands print.
#[test]
fn the_answer_is_that_of_the_commands() {
    for file in one_in(3, files(&root().join("examples"), "sense")) {
        let asked: serde_json::Value =
            serde_json::from_str(&sensedsl_web::ask(&request(&file))).unwrap();
        let solved = sensedsl_tests::sensedsl(["solve", "-q", "--format"]);
        let svg = sensedsl_tests::sensedsl(["solve", "-q", "--format", "svg"]).arg(&file);
        assert_eq!(asked["answer"], solved.arg("json").arg(&file).run().json());
        assert_eq!(asked["svg"], svg.run().stdout, "{}", read(&file));
    }
}

/// The page's function reports the same diagnostics as `check`, including those about missing
/// firmware.
#[test]
fn the_diagnostics_are_those_of_check() {
    let folders = ["examples", "tests/corpus/ok", "tests/firmware/kinds"];
    let all = folders.iter().flat_map(|folder| files(&root().join(folder), "sense"));
    for file in one_in(5, all) {
        let asked: serde_json::Value =
            serde_json::from_str(&sensedsl_web::ask(&request(&file))).unwrap();
        let check = sensedsl_tests::sensedsl(["check", "-q", "--format", "json"]);
        let name = file.file_name().unwrap();
        let check = check.arg(name).within(file.parent().unwrap()).run().json();
        assert_eq!(asked["diagnostics"], check["diagnostics"], "{}", file.display());
    }
}
