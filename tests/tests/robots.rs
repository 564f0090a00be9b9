//! Ordinary robots on boards that people own: their sheets name every contact, and `docs/robots.md` says how neat the
//! wires are.

use std::fmt::Write as _;

use sensedsl_model::NoFiles;
use sensedsl_session::{Ask, On, Workspace};
use sensedsl_tests::{assert_page, files, read, root, sensedsl};

use crate::sheet::{lines, names_a_contact};

/// A row of the page.
fn row(name: &str, text: &str) -> String {
    let ran = sensedsl(["solve", "-", "-q", "--format", "markdown"]).stdin(text).run().exits(0);
    let lines = lines(&ran.stdout);
    for line in &lines {
        let (at_part, to) = (&line[0], &line[1]);
        let is_elsewhere = to.starts_with("transceiver ") || to.starts_with("a supply of its own");
        // No source says where this board's supply is.
        let is_unknown = text.contains("NRF52840_DK") && to.ends_with(" V of the board");
        assert!(is_elsewhere || is_unknown || names_a_contact(to), "{name}: {line:?}");
        assert!(!at_part.is_empty(), "{name}: {line:?}");
    }
    let mut workspace = Workspace::default();
    workspace.open("robot.sense", text.to_owned());
    let snapshot = workspace.snapshot("robot.sense", On { board: None, target: None }, &NoFiles);
    let answer = snapshot.solve(&Ask::default());
    let (design, assignment) = answer.wired().unwrap_or_else(|| panic!("{:?}", answer.diagnostics));
    let neat = assignment.neatness;
    let before = neat.before.unwrap_or_else(|| panic!("{name}: nothing neater was looked for"));
    assert_eq!(before.cost, assignment.cost, "{name}");
    assert!((neat.sides, neat.span) <= (before.sides, before.span), "{name}");
    let head = text.lines().find_map(|line| line.strip_prefix("board Robot on ")).unwrap();
    let board = head.trim_end_matches(" {");
    let title = text.lines().next().unwrap().trim_start_matches("// ").trim_end_matches('.');
    format!(
        "| [{title}](../tests/robots/{name}.sense) | {board} | {} | {} | {} → {} | {} → {} | {} |\n",
        design.devices.len(),
        lines.len(),
        before.sides,
        neat.sides,
        before.span,
        neat.span,
        if neat.is_proved { "yes" } else { "no" }
    )
}

#[test]
fn every_wire_can_be_plugged_and_few_connectors_are_in_use() {
    let mut page =
        "| robot | board | devices | wires | connector sides | span | proved |\n".to_owned();
    page.push_str("| --- | --- | --- | --- | --- | --- | --- |\n");
    let paths = files(&root().join("tests/robots"), "sense");
    assert!(paths.len() >= 17, "{}", paths.len());
    for path in paths {
        let _ = write!(page, "{}", row(path.file_stem().unwrap().to_str().unwrap(), &read(&path)));
    }
    assert_page("docs/robots.md", "| robot", &page);
}
