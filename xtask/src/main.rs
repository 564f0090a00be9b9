//! Developer tasks: `cargo xtask TASK`.
//!
//! `bless` updates everything that tests compare with: golden trees, snapshots, the corpus' list, embedded tables.
//! `fuzz` searches for inputs that break something. `mutants` puts mistakes into generated firmware and reports which
//! of them `simulate --judge` notices. `firmware` builds the firmware of every board and kind. `parts` writes the table
//! of known parts, or compares it; `mcus` writes the facts that the emulated machine needs about each MCU, `packages`
//! the table of Embassy's lock files. `profiles` compares the target profiles with a tree of ChibiOS, and writes those
//! for Embassy. `release` makes a release. `soak` has a monitor watch a busy board for a long time, `fleet` a subscriber
//! of Zenoh many boards. `web` builds the WebAssembly module, `studio` the page and `npm` the package that are made of
//! it, `site` the documentation.
#![expect(clippy::disallowed_methods, reason = "a developer's tool works with files")]

mod embassy;
mod firmware;
mod fleet;
mod fuzz;
mod mcus;
mod mutants;
mod packages;
mod parts;
mod profiles;
mod programs;
mod release;
mod site;
mod soak;
mod studio;
mod typecheck;
mod web;

use std::io::Write as _;
use std::process::{Command, ExitCode};

use anyhow::{Context as _, Result, bail};

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // There is nowhere to report a failure to report.
            let _ = writeln!(std::io::stderr(), "error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.split_first() {
        Some((task, [])) if task == "bless" => bless(),
        Some((task, rest)) if task == "firmware" => firmware::run(rest),
        Some((task, rest)) if task == "fleet" => fleet::run(rest),
        Some((task, rest)) if task == "fuzz" => fuzz::run(rest),
        Some((task, rest)) if task == "mcus" => mcus::run(rest),
        Some((task, rest)) if task == "mutants" => mutants::run(rest),
        Some((task, [])) if task == "npm" => studio::pack(),
        Some((task, rest)) if task == "packages" => packages::run(rest),
        Some((task, rest)) if task == "parts" => parts::run(rest),
        Some((task, rest)) if task == "profiles" => match rest.split_first() {
            Some((target, rest)) if target == "embassy" => embassy::run(rest),
            _ => profiles::run(rest),
        },
        Some((task, rest)) if task == "release" => release::run(rest),
        Some((task, rest)) if task == "site" => site::run(rest),
        Some((task, rest)) if task == "soak" => soak::run(rest),
        Some((task, [])) if task == "studio" => studio::run(),
        Some((task, rest)) if task == "typecheck" => typecheck::run(rest),
        Some((task, [])) if task == "web" => web::run(),
        _ => bail!(
            "tasks: web, studio, npm, site [--studio FOLDER] [--twice], bless, firmware --matrix or --embassy, fleet [--boards N] [--rate HZ], fuzz [TARGET…], mcus [--check], mutants, packages FOLDER, parts [--check | --compare FOLDER], profiles --check, profiles embassy [--check], release VERSION, soak [--seconds N] [--limits], typecheck [--check BOARDS --seed HEX]"
        ),
    }
}

/// The tests that write what they compare with: the package, the program, and the prefixes of their names.
const BLESSED: &[(&str, &str, &[&str])] = &[
    ("sensedsl-board", "registry", &[]),
    ("sensedsl-diagnostics", "reference", &[]),
    ("sensedsl-diagnostics", "render", &[]),
    (
        "sensedsl-tests",
        "all",
        &["boards_page::", "corpus::", "golden::", "limits_page::", "messages::"],
    ),
];

fn bless() -> Result<()> {
    for (package, program, tests) in BLESSED {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args(["test", "--quiet", "--package", package, "--test", program, "--"]).args(*tests);
        let status = cargo.env("SENSEDSL_BLESS", "1").env("INSTA_UPDATE", "always").status()?;
        if !status.success() {
            bail!("the tests of {package} failed");
        }
    }
    say("blessed; now read the difference\n")
}

/// A page up to this mark, with its line end: what is above a table belongs to the page alone.
fn head(page: &str, mark: &str) -> Result<String> {
    let text = std::fs::read_to_string(page).with_context(|| page.to_owned())?;
    let (head, _) = text.split_once(mark).with_context(|| format!("{page} has no table"))?;
    Ok(format!("{head}\n"))
}

/// Prints a task's output.
fn say(text: &str) -> Result<()> {
    Ok(std::io::stdout().write_all(text.as_bytes())?)
}
