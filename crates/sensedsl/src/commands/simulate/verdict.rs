//! The judge's verdict on a run: tables and the worst finding for people, cases for build servers.

use anyhow::Result;
use sensedsl_diagnostics::Severity;
use sensedsl_diagnostics::codes::e0549_judged_wrong as judged_wrong;
use sensedsl_diagnostics::codes::e0552_command_not_done as not_done;
use sensedsl_diagnostics::codes::e0555_identity_not_asked::not_asked;
use sensedsl_report::columns::table;
use sensedsl_report::junit::{Case, Failure, Suite, junit};
use sensedsl_twin::bench::{UncheckedIdentity, seconds};
use sensedsl_twin::commands::Commands;
use sensedsl_twin::judge::DeviceFindings;

use super::commands;
use super::run::{MS, Session};
use super::simulation::Simulation;
use crate::files::write_whole;
use crate::status::Status;

/// Prints the findings, and notes a case for each device.
pub(super) fn verdict(session: Session<'_>, now_ns: u64) -> Result<Status> {
    let Session { scenery, board, mut judge, commands, reports, is_wrong, .. } = session;
    judge.transfers(now_ns, &board.odd_transfers());
    let judged = judge.finish(now_ns);
    let rows: Vec<[String; 6]> = judged.iter().map(cells).collect();
    let heads = ["Device", ">Reports", ">Excused", ">Wrong", ">Every", ">May be old"];
    let mut text = table(heads, &rows);
    for one in judged.iter().filter(|one| one.wrong > 0) {
        text.push_str(&format!("  {}: {}\n", one.name, one.words()));
    }
    scenery.terminal.result(&text)?;
    for one in &judged {
        let failure = (one.wrong > 0).then(|| (judged_wrong::CODE.name(), one.words()));
        scenery.case(&one.name, failure);
    }
    let tried = commands.map(Commands::finish).unwrap_or_default();
    let is_done = commands::verdict(scenery, &tried)?;
    let is_asked = identities(scenery, &board.unasked())?;
    let all: u64 = judged.iter().map(|one| one.reports).sum();
    let wrong: u64 = judged.iter().map(|one| one.wrong).sum();
    let off = |one: &&DeviceFindings| one.worst.as_ref().map_or(0.0, |worst| worst.off);
    let worst = judged.iter().filter(|one| one.wrong > 0);
    let worst = worst.max_by(|one, other| off(one).total_cmp(&off(other)));
    if let Some(worst) = worst {
        let what = worst.words();
        scenery.say(judged_wrong::disagrees(scenery.at, &worst.name, &what, wrong, all))?;
        return Ok(Status::Wrong);
    }
    if all == 0 && !judged.is_empty() {
        scenery.say(judged_wrong::silent(scenery.at))?;
        return Ok(Status::Wrong);
    }
    if !judged.is_empty() {
        let span = seconds(now_ns);
        let text = format!("\nall {all} values of {span:.1} s agree with the world\n");
        scenery.terminal.note(&text)?;
    }
    if let Some(instructions) = board.instructions() {
        let each = instructions / reports.max(1);
        let text =
            format!("{reports} reports, {each} instructions for each, with all that is measured\n");
        scenery.terminal.note(&text)?;
    }
    Ok(if is_wrong || !is_done || !is_asked { Status::Wrong } else { Status::Done })
}

/// Names the parts whose identity the board has not read; returns false if it should have read one.
fn identities(scenery: &Simulation<'_>, unasked: &[UncheckedIdentity]) -> Result<bool> {
    let names = |is_known: bool| -> Vec<&str> {
        let own = unasked.iter().filter(|one| one.is_known == is_known);
        own.map(|one| one.name.as_str()).collect()
    };
    let unknown = names(false);
    if !unknown.is_empty() {
        let all = unknown.join(", ");
        let why = "another part at the same address would not be noticed";
        scenery.terminal.aside(&format!("no driver reads the identity of {all}: {why}"))?;
    }
    for name in names(true) {
        scenery.say(not_asked(scenery.at, name))?;
    }
    Ok(names(true).is_empty())
}

fn cells(one: &DeviceFindings) -> [String; 6] {
    let age = format!("{} ms", one.age_ns / MS);
    let every = one.every_ns.map_or_else(|| "-".to_owned(), |every| format!("{} ms", every / MS));
    let counts = [one.reports, one.excused, one.wrong].map(|count| count.to_string());
    let [reports, excused, wrong] = counts;
    [one.name.clone(), reports, excused, wrong, every, age]
}

/// Writes what the run came to as `JUnit`, where that is asked for. What no device is to blame for is a case of its own.
pub(super) fn write_junit(scenery: &Simulation<'_>, status: Status) -> Result<()> {
    let Some(path) = &scenery.args.junit else { return Ok(()) };
    let mut cases = scenery.cases.borrow_mut().split_off(0);
    let said = scenery.said.borrow();
    let of_devices = [judged_wrong::CODE.name(), not_done::CODE.name()];
    let mut others = said
        .iter()
        .filter(|one| one.severity == Severity::Error && !of_devices.contains(&one.code.name()));
    let failure = match others.next() {
        Some(first) => Some(Failure {
            code: first.code.name().to_owned(),
            message: first.message.clone(),
            text: others.map(|one| format!("{}\n", one.message)).collect(),
        }),
        None if status != Status::Done && cases.iter().all(|one| one.failure.is_none()) => {
            let first = said.first();
            Some(Failure {
                code: first.map_or("", |one| one.code.name()).to_owned(),
                message: first.map_or("the run failed", |one| one.message.as_str()).to_owned(),
                text: String::new(),
            })
        }
        None => None,
    };
    let file = scenery.file();
    cases.insert(0, Case { name: "run".into(), file, failure, output: String::new() });
    let name = format!("simulate {}", scenery.job.board.name.value);
    write_whole(path, junit(&[Suite { name, cases }]).as_bytes())
}
