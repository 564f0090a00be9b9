//! The WebAssembly module answers in Node exactly as the same code does here, byte for byte, for
//! every example and the whole corpus.
//!
//! `SENSEDSL_WASM` is the path of the module, which `cargo xtask web` builds.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{TempDir, answered, files, has, missing, one_in, read, root, sensedsl};
use serde_json::json;

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

/// What the module says to texts that are given to its functions; none if it is not there.
fn said(requests: &[(&str, String)]) -> Option<Vec<String>> {
    let Some(module) = std::env::var_os("SENSEDSL_WASM") else {
        missing("the WebAssembly module (SENSEDSL_WASM; `cargo xtask web` builds it)");
        return None;
    };
    if !has("node") {
        return None;
    }
    let mut node = Command::new("node");
    node.arg(root().join("tests/tests/web/answers.mjs")).arg(&module);
    let all = serde_json::to_vec(requests).unwrap();
    let answers: Vec<String> = serde_json::from_str(&answered(&mut node, all)).unwrap();
    assert_eq!(answers.len(), requests.len());
    Some(answers)
}

/// The examples and the corpus.
fn corpus() -> Vec<PathBuf> {
    let folders = ["examples", "tests/corpus/ok", "tests/corpus/err"];
    folders.iter().flat_map(|folder| files(&root().join(folder), "sense")).collect()
}

#[test]
fn the_module_says_what_the_program_says() {
    let requests: Vec<(&str, String)> =
        corpus().iter().map(|file| ("answer", request(file))).collect();
    let Some(answers) = said(&requests) else { return };
    for ((file, (_, request)), answer) in corpus().iter().zip(&requests).zip(answers) {
        assert_eq!(answer, sensedsl_web::ask(request), "{}", file.display());
    }
}

/// The language server of the module answers as the same code does here.
#[test]
fn the_modules_language_server_answers_as_the_programs_does() {
    let message = |value: &serde_json::Value| ("message", value.to_string());
    let mut requests = vec![message(&json!({ "jsonrpc": "2.0", "id": 0, "method": "initialize",
        "params": { "capabilities": {} } }))];
    for (number, file) in corpus().iter().enumerate() {
        let (uri, text) = (format!("file:///corpus/{number}.sense"), read_lossy(file));
        let document = json!({ "uri": uri });
        let whole = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 9_999, "character": 0 } });
        let place = json!({ "line": text.lines().count() / 2, "character": 8 });
        let item = json!({ "uri": uri, "languageId": "sensedsl", "version": 1, "text": text });
        let told = |method: &str, params| {
            message(&json!({ "jsonrpc": "2.0", "method": method, "params": params }))
        };
        let asked = |method: &str, params| {
            message(
                &json!({ "jsonrpc": "2.0", "id": number + 1, "method": method, "params": params }),
            )
        };
        requests.push(told("textDocument/didOpen", json!({ "textDocument": item })));
        requests.push(("settle", String::new()));
        for (method, more) in [
            ("textDocument/semanticTokens/full", json!({})),
            ("textDocument/documentSymbol", json!({})),
            ("textDocument/foldingRange", json!({})),
            ("textDocument/codeLens", json!({})),
            (
                "textDocument/formatting",
                json!({ "options": { "tabSize": 4, "insertSpaces": true } }),
            ),
            ("textDocument/inlayHint", json!({ "range": whole })),
            (
                "textDocument/codeAction",
                json!({ "range": whole, "context": { "diagnostics": [] } }),
            ),
            ("textDocument/hover", json!({ "position": place })),
            ("textDocument/completion", json!({ "position": place })),
            ("sensedsl/wiring", json!({})),
        ] {
            let mut params = more;
            params["textDocument"] = document.clone();
            requests.push(asked(method, params));
        }
        requests.push(told("textDocument/didClose", json!({ "textDocument": document })));
    }
    let Some(answers) = said(&requests) else { return };
    let mut editor = sensedsl_web::Editor::default();
    for ((function, text), answer) in requests.iter().zip(answers) {
        let own = if *function == "settle" { editor.settle() } else { editor.message(text) };
        assert_eq!(answer, own, "{text}");
    }
}

fn read_lossy(file: &Path) -> String {
    String::from_utf8_lossy(&fs::read(file).unwrap()).into_owned()
}

/// Files, reports and a simulated second are the same from the module.
#[test]
fn the_modules_calls_answer_as_the_programs_do() {
    let mut requests = Vec::new();
    for file in one_in(4, files(&root().join("examples"), "sense")) {
        let of: serde_json::Value = serde_json::from_str(&request(&file)).unwrap();
        for call in [
            json!({ "do": "project", "of": of }),
            json!({ "do": "report", "of": of, "report": "sheet" }),
            json!({ "do": "report", "of": of, "report": "capacity" }),
            json!({ "do": "report", "of": of, "report": "timing" }),
            json!({ "do": "robot", "of": of }),
            json!({ "do": "run", "until_ms": 1_000 }),
        ] {
            requests.push(("call", call.to_string()));
        }
    }
    requests.push(("call", json!({ "do": "boards" }).to_string()));
    requests.push(("call", json!({ "do": "parts" }).to_string()));
    let Some(answers) = said(&requests) else { return };
    let mut studio = sensedsl_web::Studio::default();
    for ((_, call), answer) in requests.iter().zip(answers) {
        // A difference of thousands of characters says less than its beginning.
        let own = studio.call(call);
        let at = own.bytes().zip(answer.bytes()).take_while(|(one, other)| one == other).count();
        let near = own.get(at.saturating_sub(80)..(at + 80).min(own.len()));
        assert!(answer == own, "{}: {near:?}", &call[..call.len().min(80)]);
    }
}

/// A page's project has the very files that `generate` writes.
#[test]
fn the_project_is_what_generate_writes() {
    let mut written = 0;
    for file in one_in(4, files(&root().join("examples"), "sense")) {
        let of: serde_json::Value = serde_json::from_str(&request(&file)).unwrap();
        let answer =
            sensedsl_web::Studio::default().call(&json!({ "do": "project", "of": of }).to_string());
        let answer: serde_json::Value = serde_json::from_str(&answer).unwrap();
        let folder = TempDir::new("project-of-a-page");
        let generate = sensedsl(["generate", "-q", "-o"]).arg(folder.join("out")).arg(&file);
        let run = generate.run();
        if answer["files"].is_null() {
            assert_ne!(run.status, 0, "{}", file.display());
            continue;
        }
        let mut all = answer["files"].as_object().unwrap().clone();
        for (path, text) in &mut all {
            let written = fs::read(folder.join("out").join(path)).unwrap();
            assert_eq!(String::from_utf8(written).unwrap(), text.as_str().unwrap(), "{path}");
        }
        assert!(all.len() > 100, "{}", all.len());
        written += 1;
    }
    assert!(written > 0, "no example was generated");
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
