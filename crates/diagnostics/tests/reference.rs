//! `docs/diagnostics.md` agrees with the registry, and every code is in a group of the page. `SENSEDSL_BLESS=1 cargo
//! test -p sensedsl-diagnostics --test reference` writes the page.
#![expect(clippy::disallowed_methods, reason = "a test of a page reads the page")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::fmt::Write as _;
use std::path::Path;

use sensedsl_diagnostics::codes::ALL;
use sensedsl_diagnostics::{CodeInfo, Severity};

/// The groups of codes, by their first two digits.
const GROUPS: &[(&str, &str)] = &[
    ("01", "The text"),
    ("02", "Names, properties and values"),
    ("03", "Boards, tables, pins and targets"),
    ("04", "The wiring"),
    ("05", "Generation"),
    ("06", "What the hardware will not do, or will do otherwise"),
    ("07", "Hints"),
    ("08", "Import"),
];

const HEAD: &str = "# Diagnostics

Every message carries a code that stays the same for good: tests and scripts may rely on it, its words may
change. The letter is the severity: **E** error (exit status 1, nothing is written), **W** warning, **H** hint.
`sensedsl explain CODE` prints the text below; `sensedsl explain` lists all codes.

`allow W0602 \"the reason\";` in a device or board accepts a warning or hint there; an error cannot be allowed.
`sensedsl check --format json|sarif|github` says the same for machines. In JSON, `fix` is a way out as edits: each
replaces the text from `start` to `end`, which are counted as in all messages. `fixes` are several to choose from.

This page is made from the registry in `crates/diagnostics/src/codes/`.
";

/// The page, made from the registry.
fn page() -> String {
    let mut text = String::from(HEAD);
    for (digits, title) in GROUPS {
        write!(text, "\n## {title}\n").unwrap();
        let of_group = ALL.iter().filter(|code| code.name().get(1..3) == Some(*digits));
        for info in of_group.map(|code| code.info()) {
            let CodeInfo { code, title, explanation } = info;
            write!(text, "\n### {code}: {title}\n\n{explanation}\n").unwrap();
        }
    }
    text
}

#[test]
fn the_page_is_fresh() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/diagnostics.md");
    let wanted = page();
    if std::env::var("SENSEDSL_BLESS").is_ok() {
        std::fs::write(&path, &wanted).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(found == wanted, "docs/diagnostics.md is not what the registry says: SENSEDSL_BLESS=1");
}

/// The sources of a folder, except those of this crate.
fn sources(folder: &Path, all: &mut String) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, all);
        } else if path.extension().is_some_and(|end| end == "rs") {
            all.push_str(&std::fs::read_to_string(&path).unwrap());
        }
    }
}

#[test]
fn every_code_is_given() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut all = String::new();
    for entry in std::fs::read_dir(&crates).unwrap() {
        let folder = entry.unwrap().path();
        if !folder.ends_with("diagnostics") && folder.join("src").exists() {
            sources(&folder.join("src"), &mut all);
        }
    }
    for code in ALL {
        let name = code.name().to_lowercase();
        assert!(all.contains(&format!("{name}_")), "nothing gives {code}");
    }
}

#[test]
fn every_code_is_in_a_group_of_its_severity() {
    for code in ALL {
        let digits = code.name().get(1..3).unwrap();
        assert!(GROUPS.iter().any(|(group, _)| *group == digits), "{code} is in no group");
        let expected = match digits {
            "07" => Severity::Hint,
            // Messages about hardware and about imports are together, whatever their severity.
            "06" | "08" => continue,
            _ => Severity::Error,
        };
        assert_eq!(code.severity(), expected, "{code}");
    }
}
