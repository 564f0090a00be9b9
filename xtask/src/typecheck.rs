//! `cargo xtask typecheck`: the wiring of one demand on every built-in board with an MCU that Embassy knows, judged by
//! the Rust compiler as `sensedsl check --typecheck` has it judged.
//!
//! The wiring is ChibiOS's where it covers the board, so that tables of other people judge ours; elsewhere Embassy's.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, Result, bail, ensure};
use sensedsl_board::catalog;
use sensedsl_board::profile::{self, Target};
use sensedsl_codegen::firmware::embassy::profile_of;
use sensedsl_model::{Files, Unread, Wanted};
use sensedsl_session::{Ask, On, Workspace};

use crate::say;

const USAGE: &str = "cargo xtask typecheck [--boards A,B] [--write]";

/// The page that a complete run writes.
const PAGE: &str = "docs/typecheck.md";

/// What is asked of every board, as far as it has it: a name for people and the device.
const DEMAND: [(&str, &str); 11] = [
    ("analog", "sensor Light returns uint16 { id = 1; type = analog; }"),
    ("analog", "sensor Battery returns uint16 { id = 2; type = analog; }"),
    (
        "i2c",
        "sensor Range returns uint16 { id = 3; type = i2c; address = 0x70; register = 2; length = 2; }",
    ),
    ("icu", "sensor Wheel returns uint32 { id = 4; type = icu; }"),
    ("encoder", "sensor Turns returns int32 { id = 5; type = encoder; }"),
    ("uart", "sensor Place returns uint16 { id = 6; type = uart; length = 2; }"),
    ("spi", "sensor Gyro returns uint16 { id = 7; type = spi; read = [0]; length = 2; }"),
    ("pwm", "actuator Servo accepts uint16 { id = 8; type = pwm; frequency = 50 Hz; }"),
    ("pwm", "actuator Motor accepts uint16 { id = 9; type = pwm; frequency = 50 Hz; }"),
    ("digital", "sensor Touch returns bool { id = 10; type = digital; edge = both; }"),
    ("digital", "sensor Door returns bool { id = 11; type = digital; }"),
];

const HEAD: &str = "# Wirings judged by types

One demand on every built-in board with an MCU that Embassy knows: two `analog`, one `i2c`, `icu`, `encoder`, `uart` and
`spi`, two `pwm`, and two `digital`, one of them with an edge, and the board's link. It is wired for ChibiOS where that
covers the board and for Embassy elsewhere, and `sensedsl check --typecheck` puts the wiring into types, which the Rust
compiler takes or refuses. `cargo xtask typecheck --write` writes this page. *Left out* is what the board has no free
unit or pin for beside the rest.
";

/// A board with what came of it.
struct Done {
    board: &'static str,
    mcu: &'static str,
    target: &'static str,
    left_out: Vec<&'static str>,
    outcome: Outcome,
}

enum Outcome {
    /// The compiler takes so many lines.
    Taken(u32),
    /// What the tool says.
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
    ensure!(!(is_written && boards.is_some()), "--write is for all boards");
    let wanted = |name: &str| boards.as_ref().is_none_or(|boards| boards.contains(name));
    let (tool, mut done) = (tool()?, Vec::new());
    for entry in catalog::all() {
        if wanted(entry.name) && profile_of(entry.mcu).is_some() {
            let one = judge(&tool, entry.name, entry.mcu)?;
            let state = match &one.outcome {
                Outcome::Taken(lines) => format!("{lines} lines"),
                Outcome::Refused(why) => why.clone(),
            };
            say(&format!("{} {}: {state}\n", one.board, one.target))?;
            done.push(one);
        }
    }
    ensure!(!done.is_empty(), "there is no such board with an MCU that Embassy knows");
    let page = page(&done);
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
    let is_covered = matches!(profile::find(profile::DEFAULT, mcu), Ok(Target::Profile(_)));
    let target = if is_covered { profile::DEFAULT } else { "embassy" };
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

/// No design names another file.
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

/// What the command line tool says of a design.
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
    Ok(match lines.filter(|_| output.status.success()) {
        Some(lines) => Outcome::Taken(lines),
        None => {
            let errors = said.lines().filter(|line| line.starts_with("error"));
            Outcome::Refused(errors.collect::<Vec<_>>().join("; "))
        }
    })
}

fn page(done: &[Done]) -> String {
    let mut page = HEAD.to_owned();
    page.push_str(
        "\n| board | MCU | wired for | lines | left out |\n| --- | --- | --- | ---: | --- |\n",
    );
    for one in done {
        let lines = match &one.outcome {
            Outcome::Taken(lines) => lines.to_string(),
            Outcome::Refused(_) => "**refused**".to_owned(),
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            page,
            "| {} | {} | {} | {lines} | {} |",
            one.board,
            one.mcu,
            one.target,
            one.left_out.join(", ")
        );
    }
    let taken = done.iter().filter(|one| matches!(one.outcome, Outcome::Taken(_))).count();
    let _ = writeln!(page, "\n{taken} of {} boards are taken.", done.len());
    for one in done {
        if let Outcome::Refused(why) = &one.outcome {
            let _ = writeln!(page, "\n- {}: {}", one.board, why.replace('|', "/"));
        }
    }
    page
}
