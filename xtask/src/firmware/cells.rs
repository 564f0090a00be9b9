//! The cells to build. In: a board and a kind. Out: the files of its firmware.

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use sensedsl_board::catalog;
use sensedsl_board::profile::{self, Target, TargetProfile};
use sensedsl_board::table::release_name;
use sensedsl_diagnostics::{Diagnostic, Severity};
use sensedsl_files::FileSet;
use sensedsl_generate::target;
use sensedsl_model::NoFiles;
use sensedsl_model::design::Transport;
use sensedsl_session::{Ask, On, Workspace};
use sensedsl_wiring::{Repair, Solved};

/// The folder of the designs, with one for each kind.
const DESIGNS: &str = "tests/firmware/kinds";
/// The name of the design with all kinds.
pub(super) const ALL: &str = "all";
/// The paper's example, and its car.
const EXAMPLES: [(&str, &str); 2] =
    [("fig2", "examples/fig2.sense"), ("car", "examples/miniature_car.sense")];

/// The columns of the table, in the order of the language's page.
pub(super) const KINDS: [&str; 12] = [
    "analog", "i2c", "icu", "encoder", "digital", "uart", "spi", "pwm", "dac", "can", "onewire",
    "stepper",
];

/// A board, and the kind that is built for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Cell {
    pub(super) board: String,
    /// The family of its MCU, for people.
    pub(super) family: String,
    pub(super) kind: String,
    mcu: &'static str,
}

/// The result for a cell before anything is built.
pub(super) enum Made {
    NotOffered,
    /// The reason, and the rules for a board that would help.
    NoWiring(String, Vec<String>),
    Refused(String),
    /// The firmware of one board.
    Files(FileSet, Notes),
}

/// The notes on a cell beside its sizes.
#[derive(Clone, Debug, Default)]
pub(super) struct Notes {
    /// The kinds of a design with several.
    pub(super) taken: Vec<&'static str>,
    /// The kinds that did not fit.
    pub(super) left_out: Vec<&'static str>,
    /// The kinds that the target has no code for, and why.
    pub(super) refused: Vec<(&'static str, String)>,
    /// The rules that were added because the board's free pins were not enough.
    pub(super) rules: Vec<String>,
}

/// The most rules that are tried.
const RULES_MAX: usize = 2;
/// A rule that helps on MCUs whose USB excludes another unit.
const SERIAL_LINK: &str = "link { transport = uart; }";

/// The boards that a profile covers and the tree knows, each with all kinds.
pub(super) fn all(
    boards: Option<&BTreeSet<String>>,
    kinds: Option<&BTreeSet<String>>,
) -> Result<Vec<Cell>> {
    let columns = KINDS.into_iter().chain([ALL]).chain(EXAMPLES.map(|(name, _)| name));
    let columns: Vec<&str> =
        columns.filter(|kind| kinds.is_none_or(|wanted| wanted.contains(*kind))).collect();
    let mut cells = Vec::new();
    for entry in catalog::all() {
        let wanted = boards.is_none_or(|wanted| wanted.contains(entry.name));
        let in_tree = entry.board().is_ok_and(|board| board.system.contains_key("chibios"));
        if let (true, true, Some(profile)) = (wanted, in_tree, profile_of(None, entry.mcu)) {
            cells.extend(columns.iter().map(|kind| Cell {
                board: entry.name.to_owned(),
                family: profile.family.clone(),
                kind: (*kind).to_owned(),
                mcu: entry.mcu,
            }));
        }
    }
    ensure!(!cells.is_empty(), "there is no such board with a profile, or no such kind");
    Ok(cells)
}

fn profile_of(target: Option<&str>, mcu: &str) -> Option<std::sync::Arc<TargetProfile>> {
    match profile::find(target.unwrap_or(profile::DEFAULT), mcu) {
        Ok(Target::Profile(profile)) => Some(profile.into()),
        Ok(Target::None) | Err(_) => None,
    }
}

/// The firmware of a cell.
pub(super) fn make(cell: &Cell) -> Made {
    let Some(profile) = profile_of(None, cell.mcu) else { return Made::NotOffered };
    let board = cell.board.replace('-', "_");
    if let Some((_, path)) = EXAMPLES.iter().find(|(name, _)| *name == cell.kind) {
        return match read(path) {
            Ok(text) => firmware(&text, On { board: Some(&cell.board), target: None }),
            Err(error) => Made::Refused(format!("{error:#}")),
        };
    }
    let offered = |kind: &&&str| has(&profile, kind);
    if cell.kind == ALL {
        return together(&board, None, &[], KINDS.iter().filter(offered));
    }
    if !has(&profile, &cell.kind) {
        return Made::NotOffered;
    }
    alone(&board, &cell.kind)
}

/// All kinds that a board's MCU has under another target, as far as they fit together; `None` if the target does not
/// cover the MCU.
pub(super) fn all_on(board: &str, mcu: &str, target: &str) -> Option<Made> {
    let profile = profile_of(Some(target), mcu)?;
    let offered = || KINDS.iter().filter(|kind| has(&profile, kind));
    let board = board.replace('-', "_");
    let made = together(&board, Some(target), &[], offered());
    let is_refused = matches!(made, Made::Refused(_));
    let serial = || together(&board, Some(target), &[SERIAL_LINK.to_owned()], offered());
    Some(if is_refused { serial() } else { made })
}

/// A design with one kind; if the pins that it needs are taken, with the rules that the tool suggests.
fn alone(board: &str, kind: &str) -> Made {
    let mut rules = Vec::new();
    let mut first = None;
    loop {
        let text = match design(board, &[kind], &rules) {
            Ok(text) => text,
            Err(error) => return Made::Refused(format!("{error:#}")),
        };
        let (why, helps) = match firmware(&text, On::default()) {
            Made::Files(files, notes) => return Made::Files(files, Notes { rules, ..notes }),
            Made::NoWiring(why, helps) => (why, helps),
            other @ (Made::Refused(_) | Made::NotOffered) => return other,
        };
        let why = first.get_or_insert(why);
        let is_new = |rule: &String| !rules.contains(rule);
        let mut helps = helps.into_iter().chain([SERIAL_LINK.to_owned()]).filter(is_new);
        match helps.next().filter(|_| rules.len() < RULES_MAX) {
            Some(rule) => rules.push(rule),
            None => return Made::NoWiring(why.clone(), Vec::new()),
        }
    }
}

/// As many kinds as have a wiring together, the first ones first; kinds for which the target has no code are left out,
/// with the reason.
fn together<'a>(
    board: &str,
    target: Option<&str>,
    rules: &[String],
    kinds: impl Iterator<Item = &'a &'static str>,
) -> Made {
    let mut notes = Notes { rules: rules.to_vec(), ..Notes::default() };
    let mut made = Made::NotOffered;
    for kind in kinds {
        notes.taken.push(kind);
        let text = match design(board, &notes.taken, rules) {
            Ok(text) => text,
            Err(error) => return Made::Refused(format!("{error:#}")),
        };
        match firmware(&text, On { board: None, target }) {
            // The kind that was added last is dropped, because the others still fit.
            Made::NoWiring(..) => {
                let _ = notes.taken.pop();
                notes.left_out.push(kind);
            }
            Made::Refused(why) if target.is_some() => {
                let _ = notes.taken.pop();
                notes.refused.push((kind, why));
            }
            other @ (Made::Files(..) | Made::Refused(_) | Made::NotOffered) => made = other,
        }
    }
    match (made, notes.refused.first()) {
        (Made::Files(files, _), _) => Made::Files(files, notes),
        (Made::NotOffered, Some((_, why))) => Made::Refused(why.clone()),
        (other @ (Made::NotOffered | Made::NoWiring(..) | Made::Refused(_)), _) => other,
    }
}

/// Whether the MCU has units of a kind that the system serves.
fn has(profile: &TargetProfile, kind: &str) -> bool {
    match kind {
        "analog" => !profile.adcs.is_empty(),
        "i2c" => !profile.i2cs.is_empty(),
        "icu" => profile.timers.iter().any(|timer| timer.icu.is_some()),
        "pwm" => profile.timers.iter().any(|timer| timer.pwm.is_some()),
        "uart" => !profile.serials.is_empty(),
        "spi" => !profile.spis.is_empty(),
        "dac" => !profile.dacs.is_empty(),
        "can" => !profile.cans.is_empty(),
        // Every MCU has pins, and timers that count by themselves.
        _ => true,
    }
}

/// A design with several kinds.
fn design(board: &str, kinds: &[&str], rules: &[String]) -> Result<String> {
    let mut devices: String = rules.iter().map(|rule| format!("    {rule}\n")).collect();
    for kind in kinds {
        let text = read(&format!("{DESIGNS}/{kind}.sense"))?;
        let inside = text.split_once("{\n").and_then(|(_, rest)| rest.rsplit_once('}'));
        devices.push_str(inside.with_context(|| kind.to_string())?.0);
    }
    Ok(format!("board {board} {{\n{devices}}}\n"))
}

fn read(path: &str) -> Result<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    std::fs::read_to_string(root.join(path)).with_context(|| path.to_owned())
}

/// Solves a design and generates its firmware.
fn firmware(text: &str, on: On<'_>) -> Made {
    const NAME: &str = "cell.sense";
    let mut workspace = Workspace::default();
    workspace.open(NAME, text);
    let snapshot = workspace.snapshot(NAME, on, &NoFiles);
    let answer = snapshot.solve(&Ask::default());
    let Some((design, wiring)) = answer.wired() else {
        return Made::NoWiring(first(&answer.diagnostics), helps(answer.solved.as_ref()));
    };
    match target::firmware(design, wiring) {
        Ok(files) => Made::Files(files, Notes::default()),
        Err(diagnostics) => Made::Refused(first(&diagnostics)),
    }
}

/// The repairs of the board that keep its link, the gentlest first.
fn helps(solved: Option<&Solved>) -> Vec<String> {
    let Some(Solved::Infeasible(why)) = solved else { return Vec::new() };
    let rule = |repair: &Repair| match repair {
        Repair::Release(_, name) => Some(format!("release {};", release_name(name))),
        Repair::Relink(_, Transport::Uart) => Some(SERIAL_LINK.to_owned()),
        Repair::Relink(_, Transport::Usb | Transport::None)
        | Repair::Free(_)
        | Repair::Share(_)
        | Repair::Retune(..)
        | Repair::Move(..)
        | Repair::Unreserve(..)
        | Repair::Drop(_) => None,
    };
    why.repairs.iter().filter_map(|one| rule(&one.repair)).collect()
}

/// The first error, from which the others result.
fn first(diagnostics: &[Diagnostic]) -> String {
    let is_error = |one: &&Diagnostic| one.severity == Severity::Error;
    let first = diagnostics.iter().find(is_error);
    first.map_or_else(String::new, |one| format!("{}: {}", one.code.info().code, one.message))
}
