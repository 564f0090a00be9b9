//! `cargo xtask fleet [--boards N] [--rate HZ,HZ…] [--seconds N] [--seed N] [--write]`: the values of many boards
//! through one Zenoh router to one subscriber.
//!
//! Boards are simulated, some sixty in a monitor each; the router and the subscriber are the Zenoh library for Python,
//! which knows nothing of this project. All values that arrive are compared with the worlds that the boards measure, and
//! those that do not arrive are counted. One monitor is killed. `--write` writes the figures to `docs/fleet.md`.

mod design;
mod judge;
mod run;

use std::path::Path;
use std::process::Command;

use anyhow::{Context as _, Result, bail, ensure};

use crate::{head, say};
use design::{LASTS_S, VALUES};
use judge::Verdict;
use run::{Ran, Share};

const USAGE: &str =
    "cargo xtask fleet [--boards N] [--rate HZ,HZ…] [--seconds N] [--seed N] [--write]";
const PAGE: &str = "docs/fleet.md";
/// What is measured is what is handed out.
const PROFILE: &str = "dist";
const TABLE: &str = "|  | ";
const MEBIBYTE: f64 = 1_048_576.0;

/// What is asked for.
struct Asked {
    boards: usize,
    rates_hz: Vec<u32>,
    seconds: u64,
    seed: u64,
    is_written: bool,
}

impl Asked {
    fn of(arguments: &[String]) -> Result<Self> {
        let mut asked =
            Self { boards: 1_000, rates_hz: vec![1], seconds: 20, seed: 1, is_written: false };
        let mut words = arguments.iter();
        while let Some(word) = words.next() {
            let mut next = || words.next().context(USAGE);
            match word.as_str() {
                "--boards" => asked.boards = next()?.parse()?,
                "--rate" => {
                    let rates = next()?.split(',').map(str::parse);
                    asked.rates_hz = rates.collect::<Result<_, _>>().context(USAGE)?;
                }
                "--seconds" => asked.seconds = next()?.parse()?,
                "--seed" => asked.seed = next()?.parse()?,
                "--write" => asked.is_written = true,
                _ => bail!(USAGE),
            }
        }
        let fits = |rate_hz: &u32| (1..=100).contains(rate_hz) && 1_000 % rate_hz == 0;
        ensure!(asked.rates_hz.iter().all(fits), "a rate divides 1000 and is at most 100");
        ensure!(asked.boards > 1, "a fleet has at least two boards");
        ensure!(asked.seconds <= LASTS_S / 2, "at most {} seconds", LASTS_S / 2);
        Ok(asked)
    }
}

/// A run and what came of it.
struct Done {
    rate_hz: u32,
    seconds: u64,
    monitors: usize,
    last: usize,
    ran: Ran,
    verdict: Verdict,
}

pub(super) fn run(arguments: &[String]) -> Result<()> {
    let asked = Asked::of(arguments)?;
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["build", "--quiet", "--profile", PROFILE, "--package", "sensedsl"]);
    ensure!(cargo.args(["--features", "zenoh"]).status()?.success(), "it does not build");
    let program = Path::new("target").join(PROFILE).join("sensedsl");
    let mut all = Vec::new();
    for rate_hz in &asked.rates_hz {
        let done = fleet(&program, &asked, *rate_hz)?;
        say(&format!("{}\n", text(&done)))?;
        all.push(done);
    }
    if asked.is_written {
        let page = format!("{}\n\n{}", head(PAGE, TABLE)?.trim_end(), table(&all));
        std::fs::write(PAGE, page).context(PAGE)?;
    }
    for done in &all {
        judged(done, asked.boards).with_context(|| format!("at {} Hz", done.rate_hz))?;
    }
    Ok(())
}

fn fleet(program: &Path, asked: &Asked, rate_hz: u32) -> Result<Done> {
    let groups = design::groups(asked.boards, rate_hz, asked.seed);
    let folder = std::env::temp_dir().join(format!("sensedsl-fleet-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let ran = run::run(program, &folder, &groups, asked.seconds)?;
    let verdict = judge::verdict(&ran, &groups, rate_hz)?;
    std::fs::remove_dir_all(&folder)?;
    let (monitors, last) = (groups.len(), groups.last().map_or(0, |group| group.boards));
    Ok(Done { rate_hz, seconds: asked.seconds, monitors, last, ran, verdict })
}

/// What must be so, at whatever rate.
fn judged(done: &Done, boards: usize) -> Result<()> {
    let (verdict, ran) = (&done.verdict, &done.ran);
    ensure!(verdict.boards == boards, "{} of {boards} boards were seen", verdict.boards);
    let first = verdict.first.as_deref().unwrap_or_default();
    ensure!(verdict.wrong == 0, "{} values are wrong: {first}", verdict.wrong);
    ensure!(verdict.missing == 0, "{} values are missing", verdict.missing);
    ensure!(verdict.not_taken == 0, "monitors lost {} reports", verdict.not_taken);
    ensure!(verdict.silent == 0, "{} devices fell silent", verdict.silent);
    ensure!(ran.gone_after.is_some(), "the tokens of the killed monitor stay");
    ensure!(ran.other_gone == 0, "{} tokens of other monitors went", ran.other_gone);
    let expected = boards * VALUES * done.seconds as usize * done.rate_hz as usize;
    let least = expected - expected / 50;
    ensure!(verdict.values >= least, "{} of {expected} values came in time", verdict.values);
    Ok(())
}

fn gone(done: &Done) -> String {
    match done.ran.gone_after {
        Some(after) => format!("{:.0} ms", after.as_secs_f64() * 1e3),
        None => "never".to_owned(),
    }
}

fn memory(share: Share) -> f64 {
    share.memory_bytes as f64 / MEBIBYTE
}

/// A run in words.
fn text(done: &Done) -> String {
    let (verdict, ran) = (&done.verdict, &done.ran);
    let [median, most, last] = [0.5, 0.99, 1.0].map(|share| verdict.latency_ms(share));
    let of = |share: Share| {
        format!("{:.1} % of a core, {:.0} MiB", share.processor * 100.0, memory(share))
    };
    format!(
        "{} Hz: {} boards, {} values in {} s; {} missing, {} wrong, {} not taken, {} devices silent\n  \
         latency: median {median:.1} ms, 99 % within {most:.1} ms, all within {last:.1} ms\n  \
         router {}; {} monitors {}; subscriber {}; other work on this machine {:.0} %\n  \
         a monitor with {} boards was killed: their tokens were gone after {}, and {} others",
        done.rate_hz,
        verdict.boards,
        verdict.values,
        done.seconds,
        verdict.missing,
        verdict.wrong,
        verdict.not_taken,
        verdict.silent,
        of(ran.router),
        done.monitors,
        of(ran.monitors),
        of(ran.subscriber),
        ran.others * 100.0,
        done.last,
        gone(done),
        ran.other_gone,
    )
}

/// The runs as a table, a column each.
fn table(all: &[Done]) -> String {
    let row = |what: &str, cell: &dyn Fn(&Done) -> String| {
        let cells: Vec<String> = all.iter().map(cell).collect();
        format!("| {what} | {} |\n", cells.join(" | "))
    };
    let used = |share: Share| format!("{:.0} %, {:.0} MiB", share.processor * 100.0, memory(share));
    let late = |done: &Done, share| format!("{:.1} ms", done.verdict.latency_ms(share));
    let head = row("", &|done| format!("{} Hz", done.rate_hz));
    let rule = format!("| --- |{}\n", " ---: |".repeat(all.len()));
    let rows = [
        row("boards", &|done| done.verdict.boards.to_string()),
        row("values a second", &|done| {
            format!("{:.0}", done.verdict.values as f64 / done.seconds as f64)
        }),
        row("values that came", &|done| done.verdict.values.to_string()),
        row("missing, wrong", &|done| {
            format!("{}, {}", done.verdict.missing + done.verdict.not_taken, done.verdict.wrong)
        }),
        row("latency, median", &|done| late(done, 0.5)),
        row("99 % within", &|done| late(done, 0.99)),
        row("all within", &|done| late(done, 1.0)),
        row("router", &|done| used(done.ran.router)),
        row("monitors with their boards", &|done| used(done.ran.monitors)),
        row("subscriber", &|done| used(done.ran.subscriber)),
        row("other work", &|done| format!("{:.0} %", done.ran.others * 100.0)),
        row("tokens of a killed monitor gone", &gone),
    ];
    format!("{head}{rule}{}", rows.concat())
}
