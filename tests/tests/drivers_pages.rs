//! `docs/drivers/` agrees with the library of drivers, and each part's example can be wired.
//! `SENSEDSL_BLESS=1 cargo test -p sensedsl-tests drivers_pages::` rewrites the pages.
#![expect(
    clippy::indexing_slicing,
    clippy::unwrap_used,
    reason = "a test reads its data, and a panic is its failure"
)]

use std::collections::BTreeMap;

use sensedsl_diagnostics::Severity;
use sensedsl_model::facts::{self, EXAMPLE_BOARD};
use sensedsl_report::drivers;
use sensedsl_tests::{TempDir, assert_tree, sensedsl, text};

/// All pages as the library gives them, by name.
fn pages() -> BTreeMap<String, Vec<u8>> {
    let parts = facts::all();
    // What is above the first table belongs to the page alone.
    let readme = text("docs/drivers/README.md");
    let intro = &readme[..=readme.find("\n\n## ").unwrap()];
    let index = ("README.md".to_owned(), drivers::index(&parts, intro));
    let pages = parts.iter().map(|part| (format!("{}.md", part.name), drivers::page(part)));
    pages.chain([index]).map(|(name, text)| (name, text.into_bytes())).collect()
}

#[test]
fn the_pages_are_fresh() {
    assert_tree("docs/drivers", &pages());
}

/// Each example is wired on a common board, with no diagnostics except hints.
#[test]
fn every_example_is_wired() {
    let mut reported = Vec::new();
    for part in facts::all() {
        let text = facts::example(&part);
        let on = sensedsl_session::On::default();
        let mut workspace = sensedsl_session::Workspace::default();
        workspace.open("example.sense", text);
        let snapshot = workspace.snapshot("example.sense", on, &sensedsl_model::NoFiles);
        let answer = snapshot.solve(&sensedsl_session::Ask::default());
        if answer.wired().is_none() {
            reported.push(format!("{EXAMPLE_BOARD} does not carry {}", part.name));
        }
        let beyond = answer.diagnostics.iter().filter(|one| one.severity != Severity::Hint);
        reported.extend(beyond.map(|one| format!("{}: {} {}", part.name, one.code, one.message)));
    }
    assert_eq!(reported, [] as [&str; 0]);
}

#[test]
fn the_list_fits_a_terminal() {
    let all = sensedsl(["drivers"]).run().exits(0);
    for part in facts::all() {
        let line = format!("\n  {} ", part.name);
        assert!(all.stdout.contains(&line), "{}", part.name);
    }
    for line in all.stdout.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
}

/// The description of a part fits a terminal, except for a single value that is too long by itself.
#[test]
fn what_is_told_fits_a_terminal() {
    let mut wide = Vec::new();
    for part in facts::all() {
        let text = drivers::one(&part);
        let long = text.lines().filter(|line| line.chars().count() > 80);
        wide.extend(long.map(|line| format!("{}: {line}", part.name)));
    }
    assert_eq!(wide, [] as [&str; 0]);
}

#[test]
fn programs_read_the_same() {
    let all = sensedsl(["drivers", "--format", "json"]).run().exits(0).json();
    assert_eq!(all["version"], 1);
    assert_eq!(all["drivers"].as_array().unwrap().len(), facts::all().len());
    let one = sensedsl(["drivers", "gy521", "--format", "json"]).run().exits(0).json();
    let part = &one["drivers"][0];
    // The example is a complete file that can be solved.
    let folder = TempDir::new("driver_example");
    let file = folder.write("example.sense", part["example"].as_str().unwrap());
    let _ = sensedsl(["solve"]).arg(file).run().exits(0);
}
