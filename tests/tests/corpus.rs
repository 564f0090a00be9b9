//! The corpus: inputs that must be accepted, and malformed ones that must be refused with the code
//! in the name of the file, at the place that `tests/corpus/err/expected.txt` gives.
//!
//! If messages change their places: run `SENSEDSL_BLESS=1 cargo test -p sensedsl-tests corpus::`,
//! and read the difference.
#![expect(
    clippy::indexing_slicing,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test reads its data, and a panic is its failure"
)]

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use sensedsl_tests::{files, one_in, root, sensedsl};
use serde_json::Value;

/// The devices on a board whose table is malformed.
const ON_TABLE: &str = "board Robot {\n    sensor A returns uint16 {\n        id = 1;\n        type = analog;\n    }\n}\n";

/// The codes and places of all diagnostics for a file, and the exit status of `check`.
fn reported(folder: &Path, file: &str) -> (Vec<(String, String)>, i32) {
    let call = sensedsl(["check", "--format", "json"]).within(folder);
    let ran = if file.ends_with(".csv") {
        call.arg("--board").arg(file).arg("-").stdin(ON_TABLE).run()
    } else {
        call.arg(file).run()
    };
    let value: Value = serde_json::from_str(&ran.stdout)
        .unwrap_or_else(|error| panic!("{file}: {error}\n{}\n{}", ran.stdout, ran.stderr));
    let text = |one: &Value, key: &str| one[key].as_str().unwrap().to_owned();
    let diagnostics = value["diagnostics"].as_array().unwrap();
    let reported = diagnostics.iter().map(|one| {
        assert!(one["help"].is_string(), "{file}: {} gives no way out", one["code"]);
        let (line, column) = (&one["start"]["line"], &one["start"]["column"]);
        (text(one, "code"), format!("{}:{line}:{column}", text(one, "file")))
    });
    (reported.collect(), ran.status)
}

#[test]
fn malformed_input_gets_the_code_that_names_it() {
    let folder = root().join("tests/corpus/err");
    let list = folder.join("expected.txt");
    let mut files = [files(&folder, "sense"), files(&folder, "csv")].concat();
    files.sort();
    assert!(files.len() >= 60, "only {} files", files.len());
    let mut found = String::new();
    let mut unnamed = Vec::new();
    let is_blessed = std::env::var_os("SENSEDSL_BLESS").is_some();
    for path in one_in(if is_blessed { 1 } else { 4 }, &files) {
        let file = path.file_name().unwrap().to_string_lossy().into_owned();
        let code = file.split('_').next().unwrap().to_owned();
        let (reported, status) = reported(&folder, &file);
        if !reported.iter().any(|(one, _)| *one == code) {
            unnamed.push(format!("{file}: {reported:?}"));
        }
        let wrong = reported.iter().any(|(code, _)| code.starts_with('E'));
        assert_eq!(status != 0, wrong, "{file}: status {status}");
        let all: Vec<String> =
            reported.iter().map(|(code, place)| format!("{code} {place}")).collect();
        writeln!(found, "{file}: {}", all.join(", ")).unwrap();
    }
    assert!(unnamed.is_empty(), "not said where the file names it:\n{}", unnamed.join("\n"));
    if is_blessed {
        fs::write(&list, &found).unwrap();
    }
    let expected = fs::read_to_string(&list).unwrap();
    let by_file = |text: &str| -> BTreeMap<String, String> {
        let lines = text.lines().filter_map(|line| line.split_once(": "));
        lines.map(|(file, reported)| (file.to_owned(), reported.to_owned())).collect()
    };
    let (expected, found) = (by_file(&expected), by_file(&found));
    for (file, reported) in &found {
        assert_eq!(expected.get(file), Some(reported), "{file}");
    }
    assert_eq!(expected.len(), files.len(), "expected.txt names files that are gone");
}

#[test]
fn good_input_is_accepted() {
    let folders = ["tests/corpus/ok", "examples"];
    let files: Vec<PathBuf> =
        folders.iter().flat_map(|folder| files(&root().join(folder), "sense")).collect();
    assert!(files.len() >= 4, "only {} files", files.len());
    for path in files {
        let ran = sensedsl(["check"]).arg(&path).run();
        assert_eq!(ran.status, 0, "{}:\n{}", path.display(), ran.stderr);
        let formatted = sensedsl(["fmt", "--check"]).arg(&path).run();
        assert_eq!(formatted.status, 0, "{} is not laid out canonically", path.display());
    }
}
