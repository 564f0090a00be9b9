//! The robot that `sensedsl new` starts with: those of a few devices that the board can carry.
//!
//! The template has a sensor of each common kind. They are put on the board one by one, and one
//! stays if there is a wiring with it, and firmware if the board has any; the last one
//! replaces another that could not stay.

use std::path::Path;

use sensedsl_board::{catalog, profile};
use sensedsl_generate::{Selection, project};
use sensedsl_session::{Ask, Goal, On, Workspace, has_errors};

use crate::files::Disk;

const TEMPLATE: &str = include_str!("../../templates/starter.sense");

/// The number of devices of a small robot.
const ENOUGH: usize = 3;

/// The text of the robot, with firmware of that system; `None` if it cannot have any device.
pub(crate) fn robot(board: &catalog::Entry, system: Option<&str>) -> Option<String> {
    let template = TEMPLATE.replace("BOARD", &board.name.replace('-', "_"));
    let template = template.trim_end().trim_end_matches('}').trim_end();
    let mut sections = template.split("\n\n");
    let (head, first) = sections.next()?.split_once("{\n")?;
    let mut text = format!("{head}{{\n");
    text.push_str(&system.map_or(String::new(), |system| target_line(board, system)));
    let mut count = 0;
    for device in [first].into_iter().chain(sections) {
        let more = format!("{text}{device}\n");
        if count < ENOUGH && is_made(&format!("{more}}}\n"), system.is_some()) {
            text = more;
            count += 1;
        }
    }
    (count > 0).then(|| text + "}\n")
}

/// The line that asks for a system, where the board would take another one without it.
pub(crate) fn target_line(board: &catalog::Entry, system: &str) -> String {
    let is_usual = profile::full_name(profile::usual(board.mcu)) == Some(system);
    match system.rsplit_once('-').filter(|_| !is_usual) {
        Some((name, _)) => format!("    target = {name};\n"),
        None => String::new(),
    }
}

/// Whether a file has a wiring, and firmware if that is required.
pub(crate) fn is_made(text: &str, has_firmware: bool) -> bool {
    const NAME: &str = "robot.sense";
    let mut workspace = Workspace::default();
    workspace.open(NAME, text);
    let snapshot = workspace.snapshot(NAME, On::default(), &Disk::of(Path::new("-"), &[]));
    let goal = if has_firmware { Goal::Best } else { Goal::Any };
    let answer = snapshot.solve(&Ask { goal, ..Ask::default() });
    let Some((design, wiring)) = answer.wired().filter(|_| !has_errors(&answer.diagnostics)) else {
        return false;
    };
    let wanted = Selection { firmware: has_firmware, hosts: &[] };
    project("robot", design, wiring, &wanted).gaps.is_empty()
}
