//! `sensedsl parts FILE`: the best wiring of a file's devices on every part and every board.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use anyhow::{Result, bail};
use sensedsl_board::{catalog, profile};
use sensedsl_model::FileUse;
use sensedsl_parts::{Part, Sheet};
use sensedsl_session::{Fit, On, Quality, Workspace};
use sensedsl_wiring::Cancel;
use serde_json::json;

use super::deadline::{Deadline, interruption};
use super::facts::{Facts, Filter, units};
use super::parts::{parts, rank};
use crate::cli::{PartsArgs, TableFormat};
use crate::files::{Disk, read_text, shown};
use crate::status::Status;
use crate::terminal::Terminal;
use sensedsl_report::columns::table;

/// A part or a board that may carry the devices.
struct Carrier {
    name: String,
    /// The part number of the MCU.
    mcu: String,
    facts: Facts,
    is_board: bool,
    /// Whether the target has a profile for it; otherwise only the pins are checked.
    has_profile: bool,
}

/// Solves the devices of a file on all carriers that pass the filters, and prints those that fit.
pub(super) fn sweep(args: &PartsArgs, file: &Path, terminal: &mut Terminal) -> Result<Status> {
    let deadline = Deadline::after(args.timeout);
    let interrupted = interruption()?;
    let text = read_text(file, FileUse::Sense)?;
    let disk = Disk::of(file, &args.reach.allow_outside);
    let path = shown(file);
    let mut workspace = Workspace::default();
    workspace.open(&path, text);
    let on = On { board: None, target: args.target.as_deref() };
    // Errors in the devices are reported once. It does not matter here whether the file's own board is unknown or
    // unsuitable.
    let snapshot = workspace.snapshot(&path, on, &disk);
    let carriers = carriers(args);
    if carriers.is_empty() {
        bail!("no part and no board fits the filters");
    }
    if snapshot.design().is_none() {
        let board = carriers.first().map(|(carrier, _)| carrier.name.as_str());
        if workspace.snapshot(&path, On { board, ..on }, &disk).design().is_none() {
            terminal.diagnostics(snapshot.diagnostics(), snapshot.sources())?;
            return Ok(Status::Wrong);
        }
    }
    // Ctrl-C prints the results so far.
    let over = || interrupted.load(Ordering::Relaxed) || deadline.is_over();
    let question = Question {
        workspace: &workspace,
        path: &path,
        target: on.target,
        disk: &disk,
        cancel: Cancel::when(&over),
    };
    // Without a requested order, the reader gets each row as soon as it is known.
    let in_turn = args.sort.is_none() && args.limit.is_none() && !terminal.is_watched();
    let answers = solve_all(&question, &carriers, args, (terminal, in_turn));
    let failed = answers.iter().filter(|fit| **fit == Fit::Failed).count();
    let open = answers.iter().filter(|fit| **fit == Fit::Open).count();
    let found = sorted(&carriers, &answers, args);
    let fitting = found.len();
    if in_turn && args.format == TableFormat::Human {
        let asked = carriers.len() - open;
        terminal.note(&format!("\n{}", sum(&found, fitting, asked, "")))?;
    }
    let shown = found.get(..args.limit.unwrap_or(fitting)).unwrap_or(&found);
    if !in_turn {
        terminal.result(&match args.format {
            TableFormat::Json => {
                shown.iter().map(|(carrier, worth)| value(carrier, *worth)).collect()
            }
            TableFormat::Human => human(shown, fitting, carriers.len() - open),
        })?;
    }
    if open > 0 && over() {
        terminal.aside(&format!("stopped: {open} of {} were not looked at", carriers.len()))?;
    } else if open > 0 {
        let all = carriers.len();
        terminal.aside(&format!("{open} of {all} are not decided: they take too many steps"))?;
    }
    if failed > 0 {
        bail!("the solver failed its own check on {failed} parts");
    }
    Ok(if found.is_empty() { Status::Wrong } else { Status::Done })
}

/// The carriers that can carry the devices, in the requested order.
fn sorted<'a>(
    carriers: &'a [(Carrier, String)],
    answers: &[Fit],
    args: &PartsArgs,
) -> Vec<(&'a Carrier, Quality)> {
    let fitting = carriers.iter().zip(answers).filter_map(|((carrier, _), fit)| match fit {
        Fit::Wired(worth) => Some((carrier, *worth)),
        Fit::Not | Fit::Failed | Fit::Open => None,
    });
    let mut found: Vec<(&Carrier, Quality)> = fitting.collect();
    found.sort_by_key(|(carrier, worth)| {
        let facts = &carrier.facts;
        let contacts = facts.contacts.unwrap_or(u32::MAX);
        let first = rank(args.sort, facts);
        (first, *worth, contacts, facts.package, carrier.name.clone())
    });
    found
}

/// All carriers, each with a key that is the same for equal wirings.
fn carriers(args: &PartsArgs) -> Vec<(Carrier, String)> {
    let target = |mcu: &str| match args.target.as_deref() {
        Some(target) => target.to_owned(),
        None => profile::usual(mcu).to_owned(),
    };
    let of_part = |(part, facts): (Part, Facts)| {
        let name = part.name();
        let target = target(&name);
        let covered = profile::covered_by(&target, &name).unwrap_or_default();
        let key = format!("{target} {covered}\n{}", Sheet::of(part).key());
        let carrier = Carrier {
            mcu: name.clone(),
            name,
            facts,
            is_board: false,
            has_profile: !covered.is_empty(),
        };
        (carrier, key)
    };
    let filter = Filter::of(args);
    let of_board = |entry: &catalog::Entry| {
        let facts = Facts::of_mcu(entry.mcu);
        let suits = filter.leaves(entry.mcu, &facts);
        let carrier = Carrier {
            name: entry.name.to_owned(),
            mcu: entry.mcu.to_owned(),
            facts,
            is_board: true,
            has_profile: profile::covered_by(&target(entry.mcu), entry.mcu).is_some(),
        };
        suits.then(|| (carrier, format!("board {}", entry.name)))
    };
    let boards = catalog::all().iter().filter_map(of_board);
    parts(args).map(of_part).chain(boards).collect()
}

/// The question put to every carrier.
struct Question<'a> {
    workspace: &'a Workspace,
    path: &'a str,
    target: Option<&'a str>,
    disk: &'a Disk,
    cancel: Cancel<'a>,
}

/// The number of search steps spent on a carrier: a hard one does not block the others, and the same ones are decided
/// on every machine.
const STEPS_MAX: u64 = 20_000;

/// The answers in the order of the carriers: equal ones are solved once, on all cores. On a terminal, carriers are
/// shown as they are found; with `in_turn` they are printed as soon as all carriers before them are known.
fn solve_all(
    question: &Question<'_>,
    carriers: &[(Carrier, String)],
    args: &PartsArgs,
    (terminal, in_turn): (&Terminal, bool),
) -> Vec<Fit> {
    let mut numbers: BTreeMap<&str, usize> = BTreeMap::new();
    let mut questions: Vec<Vec<&Carrier>> = Vec::new();
    for (carrier, key) in carriers {
        let number = *numbers.entry(key).or_insert(questions.len());
        match questions.get_mut(number) {
            Some(alike) => alike.push(carrier),
            None => questions.push(vec![carrier]),
        }
    }
    let next = AtomicUsize::new(0);
    let is_human = args.format == TableFormat::Human;
    let is_shown = is_human && terminal.is_watched();
    let all = questions.len();
    let turn = Mutex::new(Turn { known: BTreeMap::new(), next: 0 });
    // Set when nobody reads any longer.
    let is_closed = AtomicBool::new(false);
    let say = |line: &str| {
        is_closed.fetch_or(terminal.passing(line.trim_end()).is_err(), Ordering::Relaxed);
    };
    if in_turn && is_human {
        say(&heads());
    }
    let print = |carriers: &[&Carrier], worth: Quality| {
        let line = |carrier| if is_human { line(carrier, worth) } else { value(carrier, worth) };
        carriers.iter().for_each(|carrier| say(&line(carrier)));
    };
    let work = || {
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(carriers) = questions.get(at) else { return };
            if is_closed.load(Ordering::Relaxed) {
                return;
            }
            let fit = carriers.first().map_or(Fit::Failed, |first| question.ask(&first.name));
            // One line at a time; a thread that panicked while it wrote has not left half a line.
            let mut turn = turn.lock().unwrap_or_else(PoisonError::into_inner);
            turn.known.insert(at, fit);
            if let (Fit::Wired(worth), true) = (fit, is_shown) {
                terminal.progress("parts", all, all);
                print(carriers, worth);
            }
            while let Some(fit) = turn.known.get(&turn.next).copied().filter(|_| in_turn) {
                if let (Fit::Wired(worth), Some(carriers)) = (fit, questions.get(turn.next)) {
                    print(carriers, worth);
                }
                turn.next += 1;
            }
            terminal.progress("parts", turn.known.len(), all);
        }
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        (0..cores).for_each(|_| drop(scope.spawn(work)));
    });
    terminal.progress("parts", all, all);
    let turn = turn.into_inner().unwrap_or_else(PoisonError::into_inner);
    let answer = |(_, key): &(Carrier, String)| turn.known.get(numbers.get(key.as_str())?).copied();
    // A worker that panicked leaves its part unanswered, which counts as failed.
    let unanswered = if is_closed.into_inner() { Fit::Open } else { Fit::Failed };
    carriers.iter().map(|carrier| answer(carrier).unwrap_or(unanswered)).collect()
}

/// The answers so far, by the number of the question, and the number of the next one to print.
struct Turn {
    known: BTreeMap<usize, Fit>,
    next: usize,
}

impl Question<'_> {
    fn ask(&self, board: &str) -> Fit {
        if self.cancel.is_over() {
            return Fit::Open;
        }
        let on = On { board: Some(board), target: self.target };
        let snapshot = self.workspace.snapshot(self.path, on, self.disk);
        let steps = AtomicU64::new(0);
        let over = || steps.fetch_add(1, Ordering::Relaxed) >= STEPS_MAX || self.cancel.is_over();
        snapshot.fit(Cancel::when(&over))
    }
}

/// The target's knowledge of a carrier: drivers, or only pins.
const fn known(carrier: &Carrier) -> &'static str {
    if carrier.has_profile { "drivers" } else { "pins only" }
}

/// The columns of a table for a carrier apart from its cost: the part, its package or the board that it is on, core,
/// flash, RAM, and what is known. The part number also tells the package.
fn cells(carrier: &Carrier) -> [String; 6] {
    let [package, core, flash, ram] = carrier.facts.cells();
    let place = if carrier.is_board { carrier.name.clone() } else { package };
    [carrier.mcu.clone(), place, core, flash, ram, known(carrier).to_owned()]
}

/// The line of a carrier that is shown as soon as it is found.
fn line(carrier: &Carrier, worth: Quality) -> String {
    let [part, place, core, flash, ram, known] = cells(carrier);
    let Quality { cost, .. } = worth;
    format!("{cost:>6}  {part:<15}  {place:<23}  {core:<6}  {flash:>5}  {ram:>4}  {known}")
}

/// The heads above these lines.
fn heads() -> String {
    let [cost, part, place] = ["Cost", "Part", "Package or board"];
    format!("{cost:>6}  {part:<15}  {place:<23}  Core    Flash   RAM  Known")
}

/// The number of carriers that can carry the devices, and the unit of their memory sizes.
fn sum(shown: &[(&Carrier, Quality)], fitting: usize, asked: usize, cut: &str) -> String {
    let units = match shown {
        [] => String::new(),
        some => format!("{}\n", units(some.iter().map(|(carrier, _)| &carrier.facts))),
    };
    format!("{fitting} of {asked} parts and boards can carry the devices{cut}\n{units}")
}

/// The table of the carriers shown, and how many of those checked can carry the devices.
fn human(shown: &[(&Carrier, Quality)], fitting: usize, asked: usize) -> String {
    let row = |(carrier, worth): &(&Carrier, Quality)| {
        let [part, place, core, flash, ram, known] = cells(carrier);
        [worth.cost.to_string(), part, place, core, flash, ram, known]
    };
    let rows: Vec<[String; 7]> = shown.iter().map(row).collect();
    let heads = [">Cost", "Part", "Package or board", "Core", ">Flash", ">RAM", "Known"];
    let cut = match shown.len() {
        all if all == fitting => String::new(),
        some => format!("; the first {some} are shown"),
    };
    format!("{}\n{}", table(heads, &rows), sum(shown, fitting, asked, &cut))
}

/// A line of JSON.
fn value(carrier: &Carrier, worth: Quality) -> String {
    let own = [
        ("board", json!(carrier.is_board.then_some(&carrier.name))),
        ("status", json!("optimal")),
        ("cost", json!(worth.cost)),
        ("profile", json!(carrier.has_profile)),
    ];
    let beside = [("violated", worth.violated), ("shared", worth.shared)];
    let beside = beside.into_iter().filter(|(_, number)| *number > 0);
    let beside = beside.map(|(name, number)| (name, json!(number)));
    carrier.facts.json_line(&carrier.mcu, own.into_iter().chain(beside))
}
