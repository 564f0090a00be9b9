//! `cargo xtask typecheck`: the wiring of the same devices on every built-in board with an MCU that Embassy knows,
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
use sensedsl_firmware_embassy::profile_of;
use sensedsl_model::{Files, Unread, Wanted};
use sensedsl_session::{Ask, On, Workspace};

use crate::say;

const USAGE: &str = "cargo xtask typecheck [--boards A,B] [--write]";

/// The page that a run writes; the rows of other boards stay.
const PAGE: &str = "docs/typecheck.md";

/// The devices that are required of every board, as far as it has them: the kind and the device.
const DEMAND: [(&str, &str); 13] = [
    ("analog", "sensor Light returns uint16 { id = 1; type = analog; }"),
    ("analog", "sensor Battery returns uint16 { id = 2; type = analog; }"),
    (
        "i2c",
        "sensor Range returns uint16 { id = 3; type = i2c; address = 0x70; register = 2; length = 2; }",
    ),
    ("icu", "sensor Wheel returns uint32 { id = 4; type = icu; }"),
    ("encoder", "sensor Turns returns int32 { id = 5; type = encoder; }"),
    ("uart", "sensor Place returns uint16 { id = 6; type = uart; length = 2; }"),
    (
        "spi",
        "sensor Gyro returns uint16 { id = 7; type = spi; clock = 2 MHz; read = [0]; length = 2; }",
    ),
    ("pwm", "actuator Servo accepts uint16 { id = 8; type = pwm; frequency = 50 Hz; }"),
    ("pwm", "actuator Motor accepts uint16 { id = 9; type = pwm; frequency = 50 Hz; }"),
    ("digital", "sensor Touch returns bool { id = 10; type = digital; edge = both; }"),
    ("digital", "sensor Door returns bool { id = 11; type = digital; }"),
    ("can", "sensor Speed returns uint16 { id = 12; type = can; frame = 1; }"),
    ("dac", "actuator Level accepts uint16 { id = 13; type = dac; }"),
];

const HEAD: &str = "# Wirings judged by types

One demand on every built-in board with an MCU that Embassy knows: two `analog`, one `i2c`, `icu`, `encoder`, `uart`,
`spi`, `can` and `dac`, two `pwm`, and two `digital`, one of them with an edge, and the board's link. It is wired for
ChibiOS where that covers the board and for Embassy elsewhere. [`sensedsl check
--typecheck`](firmware.md#in-rust-on-embassy) puts the wiring into types, and the Rust compiler takes or refuses it: the
types are made from ST's data by other people. [seeded-mistakes.md](seeded-mistakes.md) says which mistakes they notice.

`cargo xtask typecheck --write` writes this page, with `--boards A,B` the rows of these boards. A chip takes some ten
seconds of a processor the first time, and a second or two after that. *Lines* is how many lines of wiring the compiler
takes. *Left out* is what the board has no free unit or pin for beside the rest, or its system no driver. *Not judged*
is what the HAL has no types for.
";

const COLUMNS: &str = "
| board | MCU | wired for | lines | left out | not judged |
| --- | --- | --- | ---: | --- | --- |
";

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
    let (mut boards, mut is_written) = (None, false);
    let mut words = arguments.iter();
    while let Some(word) = words.next() {
        match word.as_str() {
            "--boards" => {
                let list = words.next().context(USAGE)?;
                boards = Some(list.split(',').map(str::to_owned).collect::<BTreeSet<String>>());
            }
            "--write" => is_written = true,
            _ => bail!(USAGE),
        }
    }
    let wanted = |name: &str| boards.as_ref().is_none_or(|boards| boards.contains(name));
    let (tool, mut done) = (tool()?, Vec::new());
    for entry in catalog::all() {
        if wanted(entry.name) && profile_of(entry.mcu).is_some() {
            let one = judge(&tool, entry.name, entry.mcu)?;
            let state = match &one.outcome {
                Outcome::Taken(lines, _) => format!("{lines} lines"),
                Outcome::Refused(why) => why.clone(),
            };
            say(&format!("{} {}: {state}\n", one.board, one.target))?;
            done.push(one);
        }
    }
    ensure!(!done.is_empty(), "there is no such board with an MCU that Embassy knows");
    let earlier = boards.is_some().then(|| std::fs::read_to_string(PAGE)).transpose();
    let page = page(&done, &earlier.context(PAGE)?.unwrap_or_default());
    if is_written {
        std::fs::write(PAGE, &page).context(PAGE)?;
    } else {
        say(&page)?;
    }
    let refused = done.iter().filter(|one| matches!(one.outcome, Outcome::Refused(_))).count();
    ensure!(refused == 0, "{refused} of {} boards are refused", done.len());
    Ok(())
}

fn judge(tool: &Path, board: &'static str, mcu: &'static str) -> Result<Done> {
    let target = profile::usual(mcu);
    let (mut taken, mut left_out) = (Vec::new(), Vec::new());
    for (name, device) in DEMAND {
        taken.push(device);
        if !has_wiring(&design(board, &taken), target) {
            let _ = taken.pop();
            left_out.push(name);
        }
    }
    let outcome = check(tool, &design(board, &taken), target)?;
    Ok(Done { board, mcu, target, left_out, outcome })
}

fn design(board: &str, devices: &[&str]) -> String {
    let board = board.replace('-', "_");
    format!("board {board} {{\n    {}\n}}\n", devices.join("\n    "))
}

/// The files of a design, which names no others.
struct Alone;

impl Files for Alone {
    fn read(&self, _: &Wanted<'_>) -> Result<String, Unread> {
        Err(Unread::Missing)
    }
}

fn has_wiring(text: &str, target: &str) -> bool {
    const NAME: &str = "demand.sense";
    let mut workspace = Workspace::default();
    workspace.open(NAME, text);
    let on = On { board: None, target: Some(target) };
    let snapshot = workspace.snapshot(NAME, on, &Alone);
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
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let lines = said.split("the compiler takes all ").nth(1);
    let lines = lines.and_then(|rest| rest.split_whitespace().next()?.parse().ok());
    let unjudged = said.lines().filter_map(|line| line.split_once("not judged: "));
    let unjudged = unjudged.filter_map(|(_, wire)| Some(wire.split_once(", which")?.0.to_owned()));
    Ok(match lines.filter(|_| output.status.success()) {
        Some(lines) => Outcome::Taken(lines, unjudged.collect()),
        None => {
            let errors = said.lines().filter(|line| line.starts_with("error"));
            Outcome::Refused(errors.collect::<Vec<_>>().join("; "))
        }
    })
}

/// The page: a row for each board, from this run or from the page as it was.
fn page(done: &[Done], earlier: &str) -> String {
    let board_of = |row: &str| row.split(" | ").next().unwrap_or_default().to_owned();
    let rows = earlier.lines().filter(|line| line.starts_with("| ") && !COLUMNS.contains(line));
    let mut rows: BTreeMap<String, String> =
        rows.map(|row| (board_of(row), row.to_owned())).collect();
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
    format!("{HEAD}{COLUMNS}{table}\n{} of {count} boards are taken.\n", count - refused)
}
