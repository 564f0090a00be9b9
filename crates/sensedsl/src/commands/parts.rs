//! `sensedsl parts`: which MCU parts and boards can carry the devices of a file, or which there are.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use anyhow::{Result, bail};
use sensedsl_board::{catalog, profile};
use sensedsl_model::{Request, What, resolve};
use sensedsl_parts::{Part, Sheet};
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Solved, Wiring};
use serde_json::json;

use super::table::table;
use crate::Status;
use crate::cli::{PartsArgs, TableFormat};
use crate::files::{Disk, read_text, shown};
use crate::terminal::Terminal;

/// A part or a board that may carry the devices.
struct Carrier {
    name: String,
    /// The part number of the MCU.
    mcu: String,
    package: Option<String>,
    contacts: Option<u32>,
    is_board: bool,
}

/// How good a wiring is, the better before.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Worth {
    violated: u32,
    shared: u32,
    cost: u32,
}

/// What became of it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fit {
    /// The best wiring is that good.
    Wired(Worth),
    /// It cannot carry the devices.
    Not,
    /// The solver failed its own check.
    Failed,
}

pub(crate) fn run(args: &PartsArgs, terminal: &mut Terminal) -> Result<Status> {
    if let Some(name) = &args.table {
        let Some(found) = sensedsl_parts::find(name) else {
            let meant = sensedsl_parts::nearest_name(name);
            let meant = meant.map_or(String::new(), |meant| format!("; did you mean {meant}?"));
            bail!("there is no part {name}{meant} (`sensedsl parts --list` lists them)");
        };
        terminal.result(&found.csv())?;
        return Ok(Status::Done);
    }
    if let Some(name) = &args.profile {
        let target = args.target.as_deref().unwrap_or(profile::DEFAULT);
        let Some(text) = profile::text(target, name) else {
            bail!("there is no profile of {name} for the target {target}");
        };
        terminal.result(text)?;
        return Ok(Status::Done);
    }
    if let Some(search) = &args.list {
        terminal.result(&listing(args, search.as_deref().unwrap_or_default()))?;
        return Ok(Status::Done);
    }
    let Some(file) = &args.file else {
        bail!("which file? (`sensedsl parts --list` lists the parts)");
    };
    sweep(args, file, terminal)
}

/// The parts that the filters leave.
fn parts(args: &PartsArgs) -> impl Iterator<Item = Part> {
    let upper = |text: &Option<String>| text.as_ref().map(|text| text.to_uppercase());
    let (family, package) = (upper(&args.family), upper(&args.package));
    let pins_max = args.max_pins;
    sensedsl_parts::all().filter(move |part| {
        fits(part.base(), part.package(), part.contacts(), family.as_deref(), package.as_deref())
            && pins_max.is_none_or(|most| part.contacts().is_some_and(|pins| pins <= most))
    })
}

fn fits(
    base: &str,
    of: Option<&str>,
    contacts: Option<u32>,
    family: Option<&str>,
    package: Option<&str>,
) -> bool {
    let begins = |family: &str| {
        base.starts_with(family)
            || base.strip_prefix("STM32").is_some_and(|base| base.starts_with(family))
    };
    let packed = |package: &str| {
        of.is_some_and(|of| of.to_uppercase().starts_with(package))
            || contacts.is_some_and(|contacts| contacts.to_string() == package)
    };
    family.is_none_or(begins) && package.is_none_or(packed)
}

fn listing(args: &PartsArgs, search: &str) -> String {
    let search = search.to_uppercase();
    let words: Vec<&str> = search.split_whitespace().collect();
    let rows = parts(args).filter_map(|part| {
        let package = part.package().unwrap_or("-");
        let numbers: Vec<String> = part.numbers().collect();
        let text = format!("{} {}", numbers.join(" "), package.to_uppercase());
        let found = words.iter().all(|word| text.contains(word));
        let others = numbers.get(1..).unwrap_or_default().join(" ");
        found.then(|| [part.name(), package.to_owned(), others])
    });
    let rows: Vec<[String; 3]> = rows.collect();
    let count = match rows.len() {
        1 => "1 part".to_owned(),
        some => format!("{some} parts"),
    };
    let heads = [("Part", false), ("Package", false), ("Also", false)];
    format!(
        "{}\n{count}; `sensedsl parts --table PART` prints the pins of one{}\n",
        table(heads, &rows),
        spelled_in_a_file(&rows)
    )
}

/// How a file spells a part whose name has a hyphen, where one is listed.
fn spelled_in_a_file(rows: &[[String; 3]]) -> String {
    let hyphened = rows.iter().find(|[name, ..]| name.contains('-'));
    hyphened.map_or_else(String::new, |[name, ..]| {
        format!("; in a file write `_` for `-`: `board Robot on {}`", name.replace('-', "_"))
    })
}

fn sweep(args: &PartsArgs, file: &Path, terminal: &mut Terminal) -> Result<Status> {
    let text = read_text(file, What::Sense)?;
    let disk = Disk::of(file, &args.reach.allow_outside);
    let path = shown(file);
    let request = Request { path: &path, text: &text, board: None, target: args.target.as_deref() };
    // What is wrong with the devices is told once; that the file's own board is unknown, or does not
    // suit, does not matter here.
    let resolved = resolve(&request, &disk);
    let carriers = carriers(args);
    if carriers.is_empty() {
        bail!("no part and no board fits the filters");
    }
    if resolved.design.is_none() {
        let board = carriers.first().map(|(carrier, _)| carrier.name.as_str());
        if resolve(&Request { board, ..request }, &disk).design.is_none() {
            terminal.diagnostics(&resolved.diagnostics, &resolved.sources)?;
            return Ok(Status::Wrong);
        }
    }
    let answers = solve_all(&request, &disk, &carriers, terminal);
    let mut found: Vec<(&Carrier, Worth)> = Vec::new();
    let mut failed = 0;
    for ((carrier, _), fit) in carriers.iter().zip(answers) {
        match fit {
            Fit::Wired(worth) => found.push((carrier, worth)),
            Fit::Not => {}
            Fit::Failed => failed += 1,
        }
    }
    found.sort_by_key(|(carrier, worth)| {
        let contacts = carrier.contacts.unwrap_or(u32::MAX);
        (*worth, contacts, carrier.package.clone(), carrier.name.clone())
    });
    terminal.result(&printed(args, &found, carriers.len()))?;
    if failed > 0 {
        bail!("the solver failed its own check on {failed} parts");
    }
    Ok(if found.is_empty() { Status::Wrong } else { Status::Done })
}

/// All carriers, with the key under which their wirings are equal.
fn carriers(args: &PartsArgs) -> Vec<(Carrier, String)> {
    let target = args.target.as_deref().unwrap_or(profile::DEFAULT);
    let of_part = |part: Part| {
        let name = part.name();
        let covered = profile::covered_by(target, &name).unwrap_or_default();
        let key = format!("{covered}\n{}", Sheet::of(part).key());
        let package = part.package().map(str::to_owned);
        let carrier = Carrier {
            mcu: name.clone(),
            name,
            package,
            contacts: part.contacts(),
            is_board: false,
        };
        (carrier, key)
    };
    let of_board = |entry: &catalog::Entry| {
        let found = sensedsl_parts::find(entry.mcu);
        let package = found.as_ref().and_then(sensedsl_parts::Found::package).map(str::to_owned);
        let contacts = found.and_then(|found| found.parts.first()?.contacts());
        let upper = |text: &Option<String>| text.as_ref().map(|text| text.to_uppercase());
        let (family, wanted) = (upper(&args.family), upper(&args.package));
        let suits =
            fits(entry.mcu, package.as_deref(), contacts, family.as_deref(), wanted.as_deref())
                && args.max_pins.is_none_or(|most| contacts.is_some_and(|pins| pins <= most));
        let carrier = Carrier {
            name: entry.name.to_owned(),
            mcu: entry.mcu.to_owned(),
            package,
            contacts,
            is_board: true,
        };
        suits.then(|| (carrier, format!("board {}", entry.name)))
    };
    let boards = catalog::all().iter().filter_map(of_board);
    parts(args).map(of_part).chain(boards).collect()
}

/// The answers in the carriers' order: equal ones are asked once, all cores ask.
fn solve_all(
    request: &Request<'_>,
    disk: &Disk,
    carriers: &[(Carrier, String)],
    terminal: &Terminal,
) -> Vec<Fit> {
    let mut first: BTreeMap<&str, usize> = BTreeMap::new();
    for (index, (_, key)) in carriers.iter().enumerate() {
        first.entry(key).or_insert(index);
    }
    let questions: Vec<usize> = first.values().copied().collect();
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let work = || {
        let mut answers: Vec<(usize, Fit)> = Vec::new();
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(index) = questions.get(at) else { return answers };
            if let Some((carrier, _)) = carriers.get(*index) {
                answers.push((*index, solve(request, disk, &carrier.name)));
            }
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            terminal.progress("parts", done, questions.len());
        }
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let answers: BTreeMap<usize, Fit> = thread::scope(|scope| {
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        // A worker that panicked leaves its parts unanswered, which counts as failed.
        workers.into_iter().filter_map(|worker| worker.join().ok()).flatten().collect()
    });
    // Whoever was overtaken by the last one has drawn the bar again.
    terminal.progress("parts", questions.len(), questions.len());
    let answer = |(_, key): &(Carrier, String)| {
        let index = first.get(key.as_str())?;
        answers.get(index).copied()
    };
    carriers.iter().map(|carrier| answer(carrier).unwrap_or(Fit::Failed)).collect()
}

fn solve(request: &Request<'_>, disk: &Disk, board: &str) -> Fit {
    let resolved = resolve(&Request { board: Some(board), ..*request }, disk);
    let Some(design) = &resolved.design else { return Fit::Not };
    match Wiring::new(design, None).solve_only(false) {
        Solved::Wired(wiring) => {
            let Assignment { violated, shared, cost, .. } = *wiring;
            Fit::Wired(Worth { violated, shared, cost })
        }
        Solved::Infeasible(_) => Fit::Not,
        // The best wiring leaves the converters without a stream: nothing to build, and no fault.
        Solved::Failed(why) if why.code.name() == "E0506" => Fit::Not,
        Solved::Failed(_) => Fit::Failed,
    }
}

fn printed(args: &PartsArgs, found: &[(&Carrier, Worth)], asked: usize) -> String {
    match args.format {
        TableFormat::Json => {
            let line = |(carrier, worth): &(&Carrier, Worth)| {
                let mut value = json!({
                    "part": carrier.mcu,
                    "package": carrier.package,
                    "board": carrier.is_board.then_some(&carrier.name),
                    "status": "optimal",
                    "cost": worth.cost,
                });
                let beside = [("violated", worth.violated), ("shared", worth.shared)];
                for (name, number) in beside.into_iter().filter(|(_, number)| *number > 0) {
                    if let Some(object) = value.as_object_mut() {
                        object.insert(name.to_owned(), json!(number));
                    }
                }
                format!("{value}\n")
            };
            found.iter().map(line).collect()
        }
        TableFormat::Human => {
            let rows: Vec<[String; 4]> = found
                .iter()
                .map(|(carrier, worth)| {
                    let board = if carrier.is_board { carrier.name.as_str() } else { "" };
                    let package = carrier.package.clone().unwrap_or_else(|| "-".to_owned());
                    [worth.cost.to_string(), carrier.mcu.clone(), package, board.to_owned()]
                })
                .collect();
            let heads = [("Cost", true), ("Part", false), ("Package", false), ("Board", false)];
            format!(
                "{}\n{} of {asked} parts and boards can carry the devices\n",
                table(heads, &rows),
                found.len()
            )
        }
    }
}
