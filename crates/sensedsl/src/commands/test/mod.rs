//! `sensedsl test`: the tests of a file, each a run of its boards in a simulated world that is held to rules.

mod bed;
mod one;
mod output;
mod place;

use anyhow::Result;
use sensedsl_diagnostics::codes::e0537_no_tests;
use sensedsl_diagnostics::{Diagnostic, nearest};
use sensedsl_job::{BoardJob, jobs};
use sensedsl_model::design::{Design, Test};
use sensedsl_report::trial_picture::picture;
use sensedsl_session::{Ask, has_errors};

use super::input;
use crate::cli::{On, TestArgs};
use crate::files::write_whole;
use crate::status::Status;
use crate::terminal::Terminal;
use bed::Bed;
use bed::Place;
use one::{Programs, Ran};

pub(crate) fn run(args: &TestArgs, terminal: &Terminal) -> Result<Status> {
    let on = On { board: None, target: args.target.clone(), reach: args.reach.clone() };
    let snapshot = input::load(&args.file, &on);
    let answer = snapshot.solve(&Ask::default());
    let (design, wiring) = input::wired(&answer, &snapshot, &on, terminal)?;
    let diagnostics = &answer.diagnostics;
    terminal.diagnostics(diagnostics, snapshot.sources())?;
    if has_errors(diagnostics) {
        return Ok(Status::Wrong);
    }
    let wanted = match wanted(design, &args.names) {
        Ok(wanted) => wanted,
        Err((why, status)) => {
            terminal.diagnostics(&[*why], snapshot.sources())?;
            return Ok(status);
        }
    };
    let jobs: Vec<BoardJob<'_>> = jobs(design, wiring).collect();
    let sources = snapshot.sources();
    let place = Place::of(&args.on);
    let bed = Bed { args, terminal, design, sources, jobs: &jobs, place };
    let mut programs = Programs::default();
    let mut all = Vec::new();
    for test in wanted {
        let Some(ran) = one::run(&bed, test, &mut programs)? else { return Ok(Status::Wrong) };
        terminal.diagnostics(&ran.failures(), sources)?;
        all.push(ran);
    }
    terminal.result(&output::text(&bed, &all))?;
    if let Some(path) = &args.picture {
        draw(&bed, &all, path)?;
    }
    Ok(if all.iter().all(Ran::is_passed) { Status::Done } else { Status::Wrong })
}

/// The tests with these names, or all of them.
fn wanted<'a>(
    design: &'a Design,
    names: &[String],
) -> Result<Vec<&'a Test>, (Box<Diagnostic>, Status)> {
    let at = input::place(design);
    if design.tests.is_empty() {
        return Err((e0537_no_tests::no_tests(at).into(), Status::Wrong));
    }
    let known: Vec<&str> = design.tests.iter().map(|test| test.name.value.as_str()).collect();
    if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
        let near = nearest(name, known.iter().copied());
        let why = e0537_no_tests::unknown(at, name, near, &known.join(", "));
        return Err((why.into(), Status::Misused));
    }
    let is_wanted = |test: &&Test| names.is_empty() || names.contains(&test.name.value);
    Ok(design.tests.iter().filter(is_wanted).collect())
}

/// Draws the first rule that did not hold, or else the first rule.
fn draw(bed: &Bed<'_>, all: &[Ran<'_>], path: &std::path::Path) -> Result<()> {
    let failed = all.iter().find(|ran| ran.judged.iter().any(|one| !one.is_held()));
    let Some(ran) = failed.or(all.first()) else { return Ok(()) };
    let number = ran.judged.iter().position(|one| !one.is_held()).unwrap_or(0);
    let Some(scene) = ran.scene(number) else { return Ok(()) };
    write_whole(path, picture(&scene).as_bytes())?;
    let what = format!("{}: {}", scene.title, scene.rule);
    Ok(bed.terminal.aside(&format!("{} shows {what}", crate::files::shown(path)))?)
}
