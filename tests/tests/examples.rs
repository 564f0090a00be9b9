//! The examples: each is short, formatted canonically, and solved as it is. Everything is generated
//! for it, except firmware for kinds that have none.
#![expect(clippy::unwrap_used, reason = "a test reads its data, and a panic is its failure")]

use std::fs;

use sensedsl_tests::{TempDir, one_in, root, sensedsl};

/// The maximum number of lines of the examples that show how short a robot's description can be; no
/// limit for the others.
fn lines_max(name: &str) -> usize {
    match name {
        "line_follower.sense" => 20,
        "quadcopter.sense" => 30,
        _ => usize::MAX,
    }
}

#[test]
fn every_example_is_solved_and_generated() {
    let entries = fs::read_dir(root().join("examples")).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.retain(|name| name.ends_with(".sense"));
    names.sort();
    assert!(names.len() >= 7, "{names:?}");
    let scratch = TempDir::new("examples");
    for name in one_in(2, &names) {
        let path = format!("examples/{name}");
        let text = fs::read_to_string(root().join(&path)).unwrap();
        assert!(text.lines().count() <= lines_max(name), "{name} is too long");
        let _ = sensedsl(["fmt", "--check", &path]).run().exits(0);
        let output = sensedsl(["check", &path]).run().exits(0);
        assert!(!output.stdout.contains("error"), "{name}: {}", output.stdout);
        let solved = sensedsl(["solve", &path]).run().exits(0).stdout;
        assert!(solved.contains("proved optimal"), "{name}: {solved}");
        let out = scratch.path().join(name).display().to_string();
        let _ = sensedsl(["generate", &path, "--without", "firmware", "-o", &out]).run().exits(0);
    }
}
