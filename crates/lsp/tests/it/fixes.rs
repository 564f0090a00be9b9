//! Ways out of diagnostics that are edits: each is applied to its text, which must not have the diagnostic then.
//!
//! The texts are those of the corpus of mistakes, and [`MORE`]. A code whose file gives it a fix must be in one of them.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_diagnostics::{Diagnostic, FileId, Fix, Scope, Severity};
use sensedsl_session::{Ask, Goal, On, Snapshot, Workspace};

use crate::corpus::{Disk, texts};

/// The devices on a board whose table is malformed.
const ON_TABLE: &str = "board Robot {\n    sensor A returns uint16 {\n        id = 1;\n        type = analog;\n    }\n}\n";

/// Mistakes with a fix that no file of the corpus shows.
const MORE: &[(&str, &str)] = &[
    (
        "a time in milliseconds that is in microseconds",
        "board B on STM32F407G_DISC1 {\n    sensor A returns uint16 { type = icu; pulse = 20; }\n}\n",
    ),
    (
        "a misspelled target",
        "board B on STM32F407G_DISC1 {\n    target = embasy;\n    sensor A returns uint16 { type = analog; }\n}\n",
    ),
    (
        "a misspelled word in UTF-8",
        "// größer 🤖\nboard B on STM32F407G_DISC1 { /* ß */ sensor A returns uint16 { type = analgo; } }",
    ),
    (
        "one sign where two compare",
        "board B on STM32F407G_DISC1 {\n    sensor Front returns uint16 { type = analog; delay = 5 ms; }\n    actuator Left accepts uint16 { type = pwm; }\n    }\ntest T {\n    for = 9 s;\n    always Front = 5;\n}\n",
    ),
    (
        "two signs where one gives a value",
        "board B on STM32F407G_DISC1 {\n    sensor Front returns uint16 { type = analog; delay = 5 ms; }\n    actuator Left accepts uint16 { type == pwm; }\n    }\n",
    ),
    (
        "a misspelled device of a controller",
        "board B on STM32F407G_DISC1 {\n    sensor Front returns uint16 { type = analog; delay = 5 ms; }\n    actuator Left accepts uint16 { type = pwm; }\n    controller Go every 5 ms { reads = [Frnt]; sets = [Left]; }\n}\n",
    ),
    (
        "a misspelled actuator of a test",
        "board B on STM32F407G_DISC1 {\n    sensor Front returns uint16 { type = analog; delay = 5 ms; }\n    actuator Left accepts uint16 { type = pwm; }\n    }\ntest T {\n    for = 9 s;\n    at 1 s set Lft = 1; always Front < 5;\n}\n",
    ),
    (
        "a misspelled fault",
        "board B on STM32F407G_DISC1 {\n    sensor Front returns uint16 { type = analog; delay = 5 ms; }\n    actuator Left accepts uint16 { type = pwm; }\n    }\ntest T {\n    for = 9 s;\n    fault tron of Front at 1 s for 1 s; always Front < 5;\n}\n",
    ),
];

/// Codes of texts that are no designs: worlds and settings of sinks.
const OF_OTHER_TEXTS: &[&str] = &["E0541", "E0560"];

/// A text, and what it is read for.
struct Case {
    name: String,
    workspace: Workspace,
    path: String,
    board: Option<String>,
}

impl Case {
    fn all() -> Vec<Self> {
        let sense = texts("tests/corpus/err", "sense").into_iter().map(|(path, text)| {
            let mut workspace = Workspace::default();
            workspace.open(&path, text);
            Self { name: path.clone(), workspace, path, board: None }
        });
        let tables = texts("tests/corpus/err", "csv").into_iter().map(|(path, text)| {
            let mut workspace = Workspace::default();
            workspace.open(&path, text);
            workspace.open("robot.sense", ON_TABLE);
            Self {
                name: path.clone(),
                workspace,
                path: "robot.sense".to_owned(),
                board: Some(path),
            }
        });
        let more = MORE.iter().map(|(name, text)| {
            let mut workspace = Workspace::default();
            workspace.open("more.sense", *text);
            let path = "more.sense".to_owned();
            Self { name: (*name).to_owned(), workspace, path, board: None }
        });
        sense.chain(tables).chain(more).collect()
    }

    fn read(&self, workspace: &Workspace) -> (Snapshot, Vec<Diagnostic>) {
        let on = On { board: self.board.as_deref(), target: None };
        let snapshot = workspace.snapshot(&self.path, on, &Disk);
        let ask = Ask { goal: Goal::Any, partly: true, ..Ask::default() };
        let diagnostics = snapshot.solve(&ask).diagnostics;
        (snapshot, diagnostics)
    }

    /// The diagnostics after a fix.
    fn after(&self, before: &Snapshot, fix: &Fix) -> Vec<Diagnostic> {
        let mut edits: BTreeMap<FileId, Vec<_>> = BTreeMap::new();
        for edit in &fix.edits {
            assert_eq!(edit.scope, Scope::Text, "{}: {}", self.name, fix.title);
            edits.entry(edit.span.file).or_default().push((edit.span.range(), edit.text.clone()));
        }
        let mut workspace = self.workspace.clone();
        for (file, edits) in edits {
            let text = before.sources().text(file);
            let new = sensedsl_syntax::edit::applied(text, edits);
            workspace.open(before.sources().name(file), new);
        }
        self.read(&workspace).1
    }
}

fn alike(all: &[Diagnostic], wanted: &Diagnostic) -> usize {
    all.iter().filter(|one| (one.code, &one.message) == (wanted.code, &wanted.message)).count()
}

fn errors(all: &[Diagnostic]) -> BTreeSet<String> {
    let wrong = all.iter().filter(|one| one.severity == Severity::Error);
    wrong.map(|one| format!("{} {}", one.code, one.message)).collect()
}

#[test]
fn each_fix_is_a_way_out() {
    let mut fixed = BTreeSet::new();
    let mut wrong = Vec::new();
    for case in Case::all() {
        let (snapshot, before) = case.read(&case.workspace);
        for one in &before {
            for fix in &one.fixes {
                let after = case.after(&snapshot, fix);
                fixed.insert(one.code.name());
                if alike(&after, one) >= alike(&before, one) {
                    wrong.push(format!(
                        "{}: {} is still there after: {}",
                        case.name, one.code, fix.title
                    ));
                }
                let mut new: Vec<String> =
                    errors(&after).difference(&errors(&before)).cloned().collect();
                // With every device read, there may be no wiring.
                new.retain(|one| !one.starts_with("E0401"));
                if !hides(one.code.name()) && !new.is_empty() {
                    wrong
                        .push(format!("{}: {}: {} brings {new:?}", case.name, one.code, fix.title));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let given = codes_with_fixes();
    let untried: Vec<&String> = given
        .iter()
        .filter(|code| !fixed.contains(code.as_str()))
        .filter(|code| !OF_OTHER_TEXTS.contains(&code.as_str()))
        .collect();
    assert!(untried.is_empty(), "no text has {untried:?}");
    assert!(given.len() >= 30, "{given:?}");
}

/// Whether so little is understood with such a mistake that others are seen only without it.
fn hides(code: &str) -> bool {
    code.starts_with("E01") || ["E0206", "E0216", "E0217", "E0221"].contains(&code)
}

/// The codes whose builder adds a fix.
fn codes_with_fixes() -> BTreeSet<String> {
    let ways = [".replace(", ".meant(", ".one_of(", ".remove(", ".add(", ".change(", "fixes.push("];
    let all = texts("crates/diagnostics/src/codes", "rs").into_iter();
    let with = all.filter(|(_, text)| ways.iter().any(|way| text.contains(way)));
    let names = with.filter_map(|(path, _)| {
        let name = path.rsplit('/').next()?.split('_').next()?.to_uppercase();
        (name.len() == 5).then_some(name)
    });
    names.collect()
}
