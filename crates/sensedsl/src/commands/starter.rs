//! The robot that `sensedsl new` begins with: of a few devices those that the board can carry.
//!
//! The template has a sensor of each common kind. They are put on the board one by one, and one
//! stays where there is a wiring with it; the last stands in where another could not stay.

use std::path::Path;

use sensedsl_board::catalog;
use sensedsl_session::{Ask, Goal, On, Workspace, has_errors};

use crate::files::Disk;

const TEMPLATE: &str = include_str!("../../templates/starter.sense");

/// Devices of a small robot.
const ENOUGH: usize = 3;

/// The text of the robot.
pub(crate) fn robot(board: &catalog::Entry) -> String {
    let template = TEMPLATE.replace("BOARD", &board.name.replace('-', "_"));
    let template = template.trim_end().trim_end_matches('}').trim_end();
    let mut sections = template.split("\n\n");
    let mut text = String::new();
    let mut count = 0;
    if let Some((head, first)) = sections.next().and_then(|first| first.split_once("{\n")) {
        text = format!("{head}{{\n");
        for device in [first].into_iter().chain(sections) {
            let more = format!("{text}{device}\n");
            if count < ENOUGH && is_wired(&format!("{more}}}\n")) {
                text = more;
                count += 1;
            }
        }
    }
    text.push_str("}\n");
    text
}

/// Whether a file has a wiring.
fn is_wired(text: &str) -> bool {
    const NAME: &str = "robot.sense";
    let mut workspace = Workspace::default();
    workspace.open(NAME, text);
    let snapshot = workspace.snapshot(NAME, On::default(), &Disk::of(Path::new("-"), &[]));
    let answer = snapshot.solve(&Ask { goal: Goal::Any, ..Ask::default() });
    answer.wired().is_some() && !has_errors(&answer.diagnostics)
}
