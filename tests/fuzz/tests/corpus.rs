//! What the fuzzer found is run again, by the very code that the fuzzer runs.
//!
//! A file of `fuzz/corpus/TARGET` is an input; one that fails is printed by its path.
#![expect(clippy::disallowed_methods, reason = "a test of files reads files")]

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use sensedsl_fuzzed::{TARGETS, Target};

fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus")
}

fn inputs(target: Target) -> Vec<PathBuf> {
    let folder = corpus().join(target.name);
    let entries = fs::read_dir(&folder).unwrap_or_else(|why| panic!("{}: {why}", folder.display()));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

fn replay(targets: &[Target]) {
    let mut failures = Vec::new();
    for target in targets {
        let inputs = inputs(*target);
        assert!(!inputs.is_empty(), "{} has no corpus", target.name);
        for path in inputs {
            let bytes = fs::read(&path).unwrap();
            if catch_unwind(AssertUnwindSafe(|| (target.body)(&bytes))).is_err() {
                failures.push(path);
            }
        }
    }
    assert!(failures.is_empty(), "these fail: {failures:#?}");
}

fn of(names: &[&str]) -> Vec<Target> {
    TARGETS.iter().copied().filter(|target| names.contains(&target.name)).collect()
}

#[test]
fn pipeline() {
    replay(&of(&["pipeline"]));
}

#[test]
fn everything_else() {
    let rest = TARGETS.iter().copied().filter(|target| target.name != "pipeline");
    replay(&rest.collect::<Vec<_>>());
}

/// For people: the design that an input of `pipeline` stands for.
#[test]
fn shown() {
    let bytes = std::env::var_os("SENSEDSL_FUZZ_SHOW").map(|path| fs::read(path).unwrap());
    println!("{}", sensedsl_fuzzed::pipeline::shown(&bytes.unwrap_or_default()));
    assert!(
        sensedsl_fuzzed::pipeline::shown(&[]).contains("board "),
        "the plainest input is a board"
    );
}

#[test]
fn a_folder_without_a_target_is_told() {
    for entry in fs::read_dir(corpus()).unwrap() {
        let name = entry.unwrap().file_name();
        let known = TARGETS.iter().any(|target| target.name == name);
        assert!(known, "there is no target {}", name.display());
    }
}
