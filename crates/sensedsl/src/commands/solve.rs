//! `sensedsl solve`: the best wiring, all wirings, or their number.

use std::path::Path;

use anyhow::{Result, ensure};
use sensedsl_diagnostics::codes::e0405_too_many_moves;
use sensedsl_diagnostics::{SourceMap, render, visible_json};
use sensedsl_model::What;
use sensedsl_model::design::Design;
use sensedsl_report::{csv, human, json, markdown, svg};
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Cancel, Keep, Search, Solved, Wiring};

use super::deadline::Deadline;
use super::in_the_way;
use super::input::{self, Answer};
use super::subject;
use crate::Status;
use crate::cli::{SolveArgs, SolveFormat};
use crate::files::{begins_with, is_in_the_way, read_text, write_whole};
use crate::terminal::Terminal;

/// How every certificate begins: an earlier one is replaced.
const CERTIFICATE: &[u8] = b"{\n\"format\": \"SenseDSL certificate";

pub(crate) fn run(args: &SolveArgs, terminal: &mut Terminal) -> Result<Status> {
    let deadline = Deadline::after(args.timeout);
    let kept = args.keep.as_deref().map(|path| read_text(path, What::Answer)).transpose()?;
    let keep = args.keep.as_deref().zip(kept.as_deref());
    let keep = keep.map(|(path, text)| input::keep_in(path, text)).transpose()?;
    let resolved = input::load(&args.file, &args.on);
    let proved = resolved.design.as_ref().filter(|_| args.proof.is_some());
    let of = proved.map(|design| subject::of(args, &resolved, design, kept)).unwrap_or_default();
    let sources = resolved.sources;
    let Some(design) = &resolved.design else {
        terminal.diagnostics(&resolved.diagnostics, &sources)?;
        return Ok(input::status(&resolved.diagnostics, &args.on));
    };
    let late = || deadline.is_over();
    let cancel = Cancel::when(&late);
    if matches!(args.format, SolveFormat::Prolog | SolveFormat::Alloy) {
        ensure!(
            args.proof.is_none(),
            "--format {} asks for the problem alone: no --proof",
            if args.format == SolveFormat::Prolog { "prolog" } else { "alloy" }
        );
        terminal.diagnostics(&resolved.diagnostics, &sources)?;
        let wiring = Wiring::within(design, keep.as_ref(), cancel);
        return problem(args, terminal, &wiring, &sources);
    }
    // On the standard output the certificate is the result.
    let file = args.proof.as_deref().filter(|path| *path != Path::new("-"));
    if let Some(path) = file
        && !args.force
        && is_in_the_way(path, b"")?
        && !begins_with(path, CERTIFICATE)?
    {
        in_the_way::say(path, "the certificate", terminal)?;
        return Ok(Status::Misused);
    }
    let mut answer = if args.proof.is_some() {
        input::prove(design, resolved.diagnostics, keep.as_ref(), &of, cancel)
    } else {
        let search = Search { any: args.any };
        input::solve(design, resolved.diagnostics, keep.as_ref(), &search, cancel)
    };
    if let (Some(Solved::Wired(wiring)), Some(most)) = (&answer.solved, args.max_moves)
        && wiring.moved > most
    {
        let at = input::place(design);
        let report = e0405_too_many_moves::too_many_moves(at, wiring.moved, most);
        answer.diagnostics.push(report);
    }
    terminal.diagnostics(&answer.diagnostics, &sources)?;
    let status = if args.proof.is_some() && file.is_none() {
        status(&answer)
    } else {
        print_answer(args, terminal, design, &answer, keep.as_ref(), &sources)?
    };
    match (answer.certificate, file) {
        (Some(Ok(text)), Some(path)) => write_whole(path, text.as_bytes())?,
        (Some(Ok(text)), None) => terminal.result(&text)?,
        (Some(Err(report)), _) => {
            terminal.diagnostics(&[*report], &sources)?;
            return Ok(Status::Wrong);
        }
        (None, _) => {}
    }
    Ok(status)
}

fn status(answer: &Answer) -> Status {
    match &answer.solved {
        Some(Solved::Wired(_)) if !input::has_errors(&answer.diagnostics) => Status::Done,
        Some(_) | None => Status::Wrong,
    }
}

/// Prints the problem for another program.
fn problem(
    args: &SolveArgs,
    terminal: &mut Terminal,
    wiring: &Wiring<'_>,
    sources: &SourceMap,
) -> Result<Status> {
    if args.format == SolveFormat::Prolog {
        terminal.result(&wiring.prolog())?;
        return Ok(Status::Done);
    }
    match wiring.alloy() {
        Ok(model) => {
            terminal.result(&model)?;
            Ok(Status::Done)
        }
        Err(failure) => {
            terminal.diagnostics(&[*failure], sources)?;
            Ok(Status::Wrong)
        }
    }
}

fn print_answer(
    args: &SolveArgs,
    terminal: &mut Terminal,
    design: &Design,
    answer: &Answer,
    keep: Option<&Keep>,
    sources: &SourceMap,
) -> Result<Status> {
    match &answer.solved {
        _ if input::has_errors(&answer.diagnostics) => {
            if let Some(Solved::Infeasible(conflict)) = &answer.solved
                && args.format == SolveFormat::Json
            {
                let mut value = json::infeasible(design, conflict);
                if args.count {
                    value = json::with_count(value, "0");
                }
                terminal.result(&print(&value, args))?;
            }
            Ok(Status::Wrong)
        }
        Some(Solved::Wired(best)) if args.count => {
            count(args, terminal, design, best, keep, sources)
        }
        Some(Solved::Wired(_)) if args.all || args.limit.is_some() => {
            several(args, terminal, design, keep, sources)
        }
        Some(Solved::Wired(best)) => {
            terminal.result(&printed(args, terminal, design, best))?;
            Ok(Status::Done)
        }
        Some(Solved::Infeasible(_) | Solved::Failed(_)) | None => Ok(Status::Wrong),
    }
}

fn print(value: &serde_json::Value, args: &SolveArgs) -> String {
    if args.all || args.limit.is_some() {
        format!("{}\n", visible_json(&value.to_string()))
    } else {
        render::json_text(value)
    }
}

fn printed(args: &SolveArgs, terminal: &Terminal, design: &Design, wiring: &Assignment) -> String {
    match args.format {
        SolveFormat::Human => human::human(design, wiring, terminal.colour()),
        SolveFormat::Json => print(&json::wired(design, wiring), args),
        SolveFormat::Csv => csv::csv(design, wiring),
        SolveFormat::Markdown => markdown::markdown(design, wiring),
        SolveFormat::Svg => svg::svg(design, wiring),
        // Answered before solving: it needs no answer.
        SolveFormat::Prolog | SolveFormat::Alloy => String::new(),
    }
}

fn count(
    args: &SolveArgs,
    terminal: &Terminal,
    design: &Design,
    best: &Assignment,
    keep: Option<&Keep>,
    sources: &SourceMap,
) -> Result<Status> {
    match Wiring::new(design, keep).count() {
        Ok(count) if args.format == SolveFormat::Json => {
            let value = json::with_count(json::wired(design, best), &count.to_string());
            terminal.result(&render::json_text(&value))?;
            Ok(Status::Done)
        }
        Ok(count) => {
            terminal.result(&format!("{count}\n"))?;
            Ok(Status::Done)
        }
        Err(failure) => {
            terminal.diagnostics(&[*failure], sources)?;
            Ok(Status::Wrong)
        }
    }
}

fn several(
    args: &SolveArgs,
    terminal: &Terminal,
    design: &Design,
    keep: Option<&Keep>,
    sources: &SourceMap,
) -> Result<Status> {
    let wiring = Wiring::new(design, keep);
    let most = usize::try_from(args.limit.unwrap_or(u64::MAX)).unwrap_or(usize::MAX);
    for (number, solved) in wiring.enumerate().take(most).enumerate() {
        match solved {
            Solved::Wired(assignment) => {
                if args.format == SolveFormat::Human {
                    terminal.result(&format!("wiring {}\n", number + 1))?;
                }
                let mut text = printed(args, terminal, design, &assignment);
                if args.format == SolveFormat::Csv && number > 0 {
                    text = text.split_once('\n').map_or(String::new(), |(_, rows)| rows.into());
                }
                terminal.result(&text)?;
            }
            Solved::Infeasible(conflict) => {
                terminal.diagnostics(&[conflict.diagnostic(design)], sources)?;
                return Ok(Status::Wrong);
            }
            Solved::Failed(failure) => {
                terminal.diagnostics(&[*failure], sources)?;
                return Ok(Status::Wrong);
            }
        }
    }
    Ok(Status::Done)
}
