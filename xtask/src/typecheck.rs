//! `cargo xtask typecheck`: the wiring of the same devices on every built-in board whose MCU has types in a HAL,
//! checked by the Rust compiler as in `sensedsl check --typecheck`.
//!
//! The wiring is for ChibiOS if that covers the board, so that tables of other people judge ours; otherwise for
//! Embassy.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, Result, bail, ensure};
use sensedsl_board::catalog;
use sensedsl_board::profile;
use sensedsl_firmware_embassy::is_judged;
use sensedsl_model::NoFiles;
use sensedsl_session::{Ask, On, Workspace};

use crate::firmware::drawn;
use crate::parts::metapac::between;
use crate::{head, say};

const USAGE: &str =
    "cargo xtask typecheck [--boards A,B] [--write] | typecheck --check BOARDS --seed HEX";

/// The page that a run writes; the rows of other boards stay.
const PAGE: &str = "docs/typecheck.md";

/// The devices that are required of every board, as far as it has them.
const DEMAND: &str = include_str!("typecheck.txt");

/// A board and its result.
struct Done {
    board: &'static str,
    mcu: &'static str,
    target: &'static str,
    left_out: Vec<&'static str>,
    outcome: Outcome,
}

enum Outcome {
    /// The number of lines that the compiler accepts, and the wires that it was not asked about.
    Taken(u32, Vec<String>),
    /// The message of the tool.
    Refused(String),
}

/// Runs the command.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let (mut boards, mut is_written, mut check, mut seed) = (None, false, None, None);
    let mut words = arguments.iter();
    while let Some(word) = words.next() {
        match word.as_str() {
            "--boards" => {
                let list = words.next().context(USAGE)?;
                boards = Some(list.split(',').map(str::to_owned).collect::<BTreeSet<String>>());
            }
            "--write" => is_written = true,
            "--check" => check = Some(words.next().context(USAGE)?.parse().context(USAGE)?),
            "--seed" => {
                let word = words.next().context(USAGE)?;
                seed = Some(u64::from_str_radix(word, 16).context(USAGE)?);
            }
            _ => bail!(USAGE),
        }
    }
    ensure!(check.is_some() == seed.is_some(), USAGE);
    if let (Some(count), Some(seed)) = (check, seed) {
        ensure!(boards.is_none() && !is_written, USAGE);
        let all = catalog::all().iter().filter(|entry| is_judged(entry.mcu));
        boards = Some(drawn(&all.map(|entry| entry.name).collect(), count, seed));
    }
    let wanted = |name: &str| boards.as_ref().is_none_or(|boards| boards.contains(name));
    let (tool, mut done) = (tool()?, Vec::new());
    for entry in catalog::all() {
        if wanted(entry.name) && is_judged(entry.mcu) {
            let one = judge(&tool, entry.name, entry.mcu)?;
            let state = match &one.outcome {
                Outcome::Taken(lines, _) => format!("{lines} lines"),
                Outcome::Refused(why) => why.clone(),
            };
            say(&format!("{} {}: {state}\n", one.board, one.target))?;
            done.push(one);
        }
    }
    ensure!(!done.is_empty(), "there is no such board whose MCU has types in a HAL");
    let page = page(&done, boards.is_some())?;
    if is_written {
        std::fs::write(PAGE, &page).context(PAGE)?;
    } else if check.is_none() {
        say(&page)?;
    } else {
        let is_same = page == std::fs::read_to_string(PAGE).context(PAGE)?;
        ensure!(
            is_same,
            "{PAGE} says something else of these boards: `cargo xtask typecheck --write`"
        );
    }
    let refused = done.iter().filter(|one| matches!(one.outcome, Outcome::Refused(_))).count();
    ensure!(refused == 0, "{refused} of {} boards are refused", done.len());
    Ok(())
}

fn judge(tool: &Path, board: &'static str, mcu: &'static str) -> Result<Done> {
    let target = profile::usual(mcu);
    let (mut taken, mut left_out) = (Vec::new(), Vec::new());
    for device in DEMAND.lines() {
        taken.push(device);
        if !has_wiring(&design(board, &taken), target) {
            let _ = taken.pop();
            left_out.extend(between(device, "type = ", ";"));
        }
    }
    let outcome = check(tool, &design(board, &taken), target)?;
    Ok(Done { board, mcu, target, left_out, outcome })
}

fn design(board: &str, devices: &[&str]) -> String {
    let board = board.replace('-', "_");
    format!("board {board} {{\n    {}\n}}\n", devices.join("\n    "))
}

fn has_wiring(text: &str, target: &str) -> bool {
    const NAME: &str = "demand.sense";
    let mut workspace = Workspace::default();
    workspace.open(NAME, text);
    let on = On { board: None, target: Some(target) };
    let snapshot = workspace.snapshot(NAME, on, &NoFiles);
    snapshot.solve(&Ask::default()).wired().is_some()
}

/// Builds the command line tool beside this program, once for all boards.
fn tool() -> Result<PathBuf> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["build", "--quiet", "--profile", "test", "--package", "sensedsl"]);
    cargo.current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."));
    ensure!(cargo.status().context("cargo")?.success(), "sensedsl does not build");
    let own = std::env::current_exe().context("the path of this program")?;
    Ok(own.with_file_name(format!("sensedsl{}", std::env::consts::EXE_SUFFIX)))
}

/// The result of the command line tool for a design.
fn check(tool: &Path, text: &str, target: &str) -> Result<Outcome> {
    let mut command = Command::new(tool);
    command.args(["check", "--typecheck", "--target", target, "-"]);
    command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().with_context(|| tool.display().to_string())?;
    let mut stdin = child.stdin.take().context("the tool takes no input")?;
    stdin.write_all(text.as_bytes())?;
    drop(stdin);
    let output = child.wait_with_output()?;
    let log = String::from_utf8_lossy(&output.stderr).into_owned();
    let lines = log.split("the compiler takes all ").nth(1);
    let lines = lines.and_then(|rest| rest.split_whitespace().next()?.parse().ok());
    let unjudged = log.lines().filter_map(|line| line.split_once("not judged: "));
    let unjudged = unjudged.filter_map(|(_, wire)| Some(wire.split_once(", which")?.0.to_owned()));
    Ok(match lines.filter(|_| output.status.success()) {
        Some(lines) => Outcome::Taken(lines, unjudged.collect()),
        None => {
            let errors = log.lines().filter(|line| line.starts_with("error"));
            Outcome::Refused(errors.collect::<Vec<_>>().join("; "))
        }
    })
}

/// The page: a row for each board, from this run or from the page as it was.
fn page(done: &[Done], is_part: bool) -> Result<String> {
    let earlier = std::fs::read_to_string(PAGE).context(PAGE)?;
    let board_of = |row: &str| row.split(" | ").next().unwrap_or_default().to_owned();
    let rows = earlier.lines().filter(|line| line.starts_with("| ")).skip(2);
    let mut rows: BTreeMap<String, String> =
        rows.filter(|_| is_part).map(|row| (board_of(row), row.to_owned())).collect();
    for one in done {
        let (lines, unjudged) = match &one.outcome {
            Outcome::Taken(lines, unjudged) => (lines.to_string(), unjudged.join(", ")),
            Outcome::Refused(why) => {
                (format!("**refused**: {}", why.replace('|', "/")), String::new())
            }
        };
        let left_out = one.left_out.join(", ");
        let cells = [one.board, one.mcu, one.target, &lines, &left_out, &unjudged];
        let row = format!("| {} |", cells.join(" | "));
        let _ = rows.insert(board_of(&row), row);
    }
    let refused = rows.values().filter(|row| row.contains("**refused**")).count();
    let table: String = rows.values().map(|row| format!("{row}\n")).collect();
    let count = rows.len();
    let head = head(PAGE, "\n| board | ")?;
    let columns = "| board | MCU | wired for | lines | left out | not judged |";
    let line = "| --- | --- | --- | ---: | --- | --- |";
    let taken = count - refused;
    Ok(format!("{head}{columns}\n{line}\n{table}\n{taken} of {count} boards are taken.\n"))
}
