//! Mistakes put into the generated C of a rover, one at a time, with what notices them when the
//! program runs in its world.
//!
//! The table is in `docs/seeded-mistakes.md`. `SENSEDSL_THOROUGH=3 SENSEDSL_BLESS=1 cargo test
//! --workspace --test all --features sensedsl-tests/machine firmware::twin::seeded` writes it.
//! Otherwise some mistakes are tested, and must be noticed as the table says.

use std::path::Path;
use std::process::Command;

use sensedsl_tests::{Mistake, assert_rows, assert_section, is_drawn, is_whole, mistakes, read};

use super::bench::folder;
use super::trial::{System, Trial, rover, rover_world, run};
use crate::firmware::chibios::tree;

/// The length of each run: in this time the motor is commanded and abandoned, and everything in the
/// world moves.
pub(super) const SECONDS: u64 = 2;

/// The checks that noticed the mistake, in words; empty if none did.
fn noticed(tree: &Path, board: &Path) -> String {
    match made(tree, board) {
        None => "compiler".to_owned(),
        Some(image) => noticed_by(System::Chibios, &image),
    }
}

/// The image built from a board's folder; `None` if the compiler refuses it or warns.
pub(super) fn made(tree: &Path, board: &Path) -> Option<Vec<u8>> {
    let mut make = Command::new("make");
    make.current_dir(board).args(["-j2", "UP_MODE=production", "USE_LTO=no"]);
    let output = make.arg(format!("CHIBIOS={}", tree.display())).output().unwrap();
    let log = String::from_utf8_lossy(&output.stderr).into_owned();
    let is_made = output.status.success() && !log.contains("warning");
    is_made.then(|| super::trial::image(board))
}

/// The checks that noticed that a program is wrong, in words; empty if none did.
pub(super) fn noticed_by(system: System, image: &[u8]) -> String {
    noticed_in(&run(system, (&rover(), &rover_world()), image, SECONDS, &[]))
}

/// The checks that noticed a mistake in a run; empty if none did.
pub(super) fn noticed_in(trial: &Trial) -> String {
    if let Some(halt) = &trial.halt {
        return format!("the program stops: {}", halt.why);
    }
    let mut all = Vec::new();
    let mismatches: Vec<String> =
        trial.mismatches.iter().map(|one| format!("{} of {}", one.place, one.title)).collect();
    if !mismatches.is_empty() {
        all.push(format!("pads and ports ({})", mismatches.join(", ")));
    }
    for one in &trial.mismatches {
        eprintln!("    {} of {} is {}, not {}", one.place, one.title, one.found, one.expected);
    }
    trial.wrong().iter().chain(&trial.outputs).for_each(|one| eprintln!("    {one}"));
    let wrong = trial.judged.iter().filter(|one| one.wrong > 0 || one.reports == 0);
    let wrong: Vec<&str> = wrong.map(|one| one.name.as_str()).collect();
    if !wrong.is_empty() {
        all.push(format!("judge ({})", wrong.join(", ")));
    }
    if !trial.outputs.is_empty() {
        all.push("outputs (Motor)".to_owned());
    }
    all.join(", ")
}

/// The table of a section, and the mistakes in it that nothing notices.
pub(super) fn table(rows: &[(&Mistake, String)]) -> String {
    let mut table = "| mistake | noticed by |\n| --- | --- |\n".to_owned();
    for (Mistake { what, .. }, by) in rows {
        table.push_str(&format!("| {what} | {} |\n", if by.is_empty() { "nobody" } else { by }));
    }
    let of_all = rows.len();
    let survivors: Vec<_> = rows.iter().filter(|row| row.1.is_empty()).collect();
    table.push_str(&format!("\n{} of {of_all} are noticed.\n", of_all - survivors.len()));
    for (Mistake { what, why, .. }, _) in survivors {
        assert!(!why.is_empty(), "nobody notices {what}");
        table.push_str(&format!("\n- **{what}**: {why}"));
    }
    format!("{}\n", table.trim_end())
}

/// The page has what a whole run has found; the rows of any other run are some of these.
pub(super) fn assert_table(heading: &str, table: &str) {
    const PAGE: &str = "docs/seeded-mistakes.md";
    if is_whole() { assert_section(PAGE, heading, table) } else { assert_rows(PAGE, table) }
}

/// The mistakes of a list that this run tries: the first three always, so that no run tries none, and those that it draws.
pub(super) fn tried(all: &[Mistake]) -> impl Iterator<Item = &Mistake> {
    let placed = (0..).zip(all);
    placed.filter(|(place, one)| *place < 3 || is_drawn(&one.what)).map(|(_, one)| one)
}

const HEADING: &str = "In C, when it runs";

#[test]
fn mistakes_are_noticed() {
    let Some(tree) = tree() else { return };
    let board = folder("seeded", &rover());
    assert_eq!(noticed(&tree, &board), "", "the rover is wrong without a mistake");
    let (all, mut rows) = (mistakes("rover.txt"), Vec::new());
    for mistake in tried(&all) {
        let place = &mistake.places[0];
        let path = board.join(&place.name);
        let text = read(&path);
        std::fs::write(&path, place.once(&text)).unwrap();
        let by = noticed(&tree, &board);
        std::fs::write(&path, text).unwrap();
        eprintln!("{}: {by}", mistake.what);
        rows.push((mistake, by));
    }
    assert_table(HEADING, &table(&rows));
}

/// The text that each mistake replaces must exist, so that the list follows the templates.
#[test]
fn mistakes_are_of_texts_that_are_there() {
    let board = folder("seeded-texts", &rover());
    let all = mistakes("rover.txt");
    assert!(all.len() > 40 && all.iter().all(|mistake| mistake.places.len() == 1));
    for place in all.iter().flat_map(|mistake| &mistake.places) {
        let _ = place.once(&read(&board.join(&place.name)));
    }
}
