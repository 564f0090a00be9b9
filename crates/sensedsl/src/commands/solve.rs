//! `sensedsl solve`: the best wiring, all wirings, or their number.

use std::path::Path;

use anyhow::{Result, ensure};
use sensedsl_diagnostics::codes::e0405_too_many_moves;
use sensedsl_diagnostics::{Diagnostic, SourceMap, render, visible_json};
use sensedsl_export::{alloy, prolog};
use sensedsl_model::FileUse;
use sensedsl_model::design::Design;
use sensedsl_report::{csv, human, json, sheet, svg};
use sensedsl_session::{Answer, Ask, Goal, Origin, has_errors};
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Cancel, Keep, Solved, Wiring};

use super::deadline::Deadline;
use super::in_the_way;
use super::input;
use crate::cli::{On, SolveArgs, SolveFormat};
use crate::files::{begins_with, is_in_the_way, read_text, shown, write_whole};
use crate::status::Status;
use crate::terminal::Terminal;

/// The program with its version.
const TOOL: &str = concat!("sensedsl ", env!("CARGO_PKG_VERSION"));

/// The start of every certificate, which tells an earlier one that may be replaced.
const CERTIFICATE: &[u8] = b"{\n\"format\": \"SenseDSL certificate";

pub(crate) fn run(args: &SolveArgs, terminal: &mut Terminal) -> Result<Status> {
    let deadline = Deadline::after(args.timeout);
    let kept = args.keep.as_deref().map(|path| read_text(path, FileUse::Answer)).transpose()?;
    let keep = args.keep.as_deref().zip(kept.as_deref());
    let keep = keep.map(|(path, text)| input::keep_in(path, text)).transpose()?;
    let snapshot = input::load(&args.file, &args.on);
    let sources = snapshot.sources();
    let late = || deadline.is_over();
    let cancel = Cancel::when(&late);
    if let (Some(design), SolveFormat::Prolog | SolveFormat::Alloy) =
        (snapshot.design(), args.format)
    {
        ensure!(
            args.proof.is_none(),
            "--format {} asks for the problem alone: no --proof",
            if args.format == SolveFormat::Prolog { "prolog" } else { "alloy" }
        );
        terminal.diagnostics(snapshot.diagnostics(), sources)?;
        let wiring = Wiring::within(design, keep.as_ref(), cancel);
        return Printer { args, terminal, sources }.problem(&wiring);
    }
    // A certificate for the standard output is the result.
    let file = args.proof.as_deref().filter(|path| *path != Path::new("-"));
    if let (Some(path), Some(_)) = (file, snapshot.design())
        && !args.force
        && is_in_the_way(path, b"")?
        && !begins_with(path, CERTIFICATE)?
    {
        in_the_way::say(path, "the certificate", terminal)?;
        return Ok(Status::Misused);
    }
    let (path, keep_path) = (shown(&args.file), args.keep.as_deref().map(shown));
    let origin = Origin {
        tool: TOOL,
        path: &path,
        on: args.on.asked(),
        keep: keep_path.as_deref().zip(kept.as_deref()),
    };
    let of = args.proof.is_some().then(|| snapshot.subject(&origin));
    let goal = match &of {
        Some(of) => Goal::Proved(of),
        None if args.any => Goal::Any,
        None => Goal::Best,
    };
    let keep = keep.as_ref();
    let mut answer =
        snapshot.solve(&Ask { goal, keep, rise: args.neat, partly: args.partial, cancel });
    let found = answer.wired().map(|(design, wiring)| reports(args, design, wiring));
    answer.diagnostics.extend(found.unwrap_or_default());
    terminal.diagnostics(&answer.diagnostics, sources)?;
    let status = if args.proof.is_some() && file.is_none() {
        status(&answer, &args.on)
    } else {
        Printer { args, terminal, sources }.answer(&answer, keep)?
    };
    match (answer.certificate, file) {
        (Some(Ok(text)), Some(path)) => write_whole(path, text.as_bytes())?,
        (Some(Ok(text)), None) => terminal.result(&text)?,
        (Some(Err(report)), _) => {
            terminal.diagnostics(&[*report], sources)?;
            return Ok(Status::Wrong);
        }
        (None, _) => {}
    }
    Ok(status)
}

/// What the arguments ask to be said of a wiring: that it moves too much, and what a diagram leaves out.
fn reports(args: &SolveArgs, design: &Design, wiring: &Assignment) -> Vec<Diagnostic> {
    let mut reports = Vec::new();
    if let Some(most) = args.max_moves.filter(|most| wiring.moved > *most) {
        let at = input::place(design);
        reports.push(e0405_too_many_moves::too_many_moves(at, wiring.moved, most));
    }
    if args.format == SolveFormat::Wokwi {
        let drawn = sheet::wokwi::wokwi(design, wiring);
        reports.extend(drawn.map_or_else(|wrong| wrong, |diagram| diagram.left_out));
    }
    reports
}

/// The exit status: success if there is a wiring without errors.
fn status(answer: &Answer<'_>, on: &On) -> Status {
    let least = if answer.wired().is_some() { Status::Done } else { Status::Wrong };
    input::status(&answer.diagnostics, on).max(least)
}

/// How an answer is printed.
struct Printer<'a> {
    args: &'a SolveArgs,
    terminal: &'a mut Terminal,
    sources: &'a SourceMap,
}

impl Printer<'_> {
    /// Reports why there is no answer.
    fn wrong(&self, why: Diagnostic) -> Result<Status> {
        self.terminal.diagnostics(&[why], self.sources)?;
        Ok(Status::Wrong)
    }

    /// Prints the problem for another program.
    fn problem(&mut self, wiring: &Wiring<'_>) -> Result<Status> {
        if self.args.format == SolveFormat::Prolog {
            self.terminal.result(&prolog(wiring.problem(), &wiring.labels()))?;
            return Ok(Status::Done);
        }
        match wiring.posed() {
            Ok(posed) => {
                self.terminal.result(&alloy(&posed.problem, &posed.labels, &posed.outcome))?;
                Ok(Status::Done)
            }
            Err(failure) => self.wrong(*failure),
        }
    }

    fn answer(&mut self, answer: &Answer<'_>, keep: Option<&Keep>) -> Result<Status> {
        let Some(design) = &answer.design else { return Ok(status(answer, &self.args.on)) };
        match &answer.solved {
            Some(Solved::Wired(best)) if self.args.partial && has_errors(&answer.diagnostics) => {
                let left_out: Vec<&str> =
                    answer.left_out.iter().map(|one| one.value.as_str()).collect();
                if self.args.format == SolveFormat::Json {
                    let value = json::with_left_out(json::wired(design, best), &left_out);
                    self.terminal.result(&render::json_text(&value))?;
                } else {
                    self.terminal.result(&self.printed(design, best))?;
                }
                self.terminal
                    .aside(&format!("left out for their errors: {}", left_out.join(", ")))?;
                Ok(Status::Wrong)
            }
            solved if has_errors(&answer.diagnostics) => {
                if let Some(Solved::Infeasible(conflict)) = solved
                    && self.args.format == SolveFormat::Json
                {
                    let mut value = json::infeasible(design, conflict);
                    if self.args.count {
                        value = json::with_count(value, "0");
                    }
                    self.terminal.result(&self.json(&value))?;
                }
                Ok(Status::Wrong)
            }
            Some(Solved::Wired(best)) if self.args.count => self.count(design, best, keep),
            Some(Solved::Wired(_)) if self.args.all || self.args.limit.is_some() => {
                self.several(design, keep)
            }
            Some(Solved::Wired(best)) => {
                self.terminal.result(&self.printed(design, best))?;
                Ok(Status::Done)
            }
            Some(Solved::Infeasible(_) | Solved::Failed(_)) | None => Ok(Status::Wrong),
        }
    }

    fn json(&self, value: &serde_json::Value) -> String {
        if self.args.all || self.args.limit.is_some() {
            format!("{}\n", visible_json(&value.to_string()))
        } else {
            render::json_text(value)
        }
    }

    fn printed(&self, design: &Design, wiring: &Assignment) -> String {
        match self.args.format {
            SolveFormat::Human => human::human(design, wiring, self.terminal.colour()),
            SolveFormat::Json => self.json(&json::wired(design, wiring)),
            SolveFormat::Csv => csv::csv(design, wiring),
            SolveFormat::Markdown => sheet::markdown::markdown(design, wiring),
            SolveFormat::Html => sheet::html::html(design, wiring),
            SolveFormat::Svg => svg::svg(design, wiring),
            SolveFormat::Kicad => sheet::kicad::kicad(design, wiring),
            // What is wrong or missing has been told.
            SolveFormat::Wokwi => sheet::wokwi::wokwi(design, wiring).unwrap_or_default().text,
            // These are answered before solving: they need no answer.
            SolveFormat::Prolog | SolveFormat::Alloy => String::new(),
        }
    }

    fn count(&mut self, design: &Design, best: &Assignment, keep: Option<&Keep>) -> Result<Status> {
        match Wiring::new(design, keep).count() {
            Ok(count) if self.args.format == SolveFormat::Json => {
                let value = json::with_count(json::wired(design, best), &count.to_string());
                self.terminal.result(&render::json_text(&value))?;
                Ok(Status::Done)
            }
            Ok(count) => {
                self.terminal.result(&format!("{count}\n"))?;
                Ok(Status::Done)
            }
            Err(failure) => self.wrong(*failure),
        }
    }

    fn several(&mut self, design: &Design, keep: Option<&Keep>) -> Result<Status> {
        let wiring = Wiring::new(design, keep);
        let most = usize::try_from(self.args.limit.unwrap_or(u64::MAX)).unwrap_or(usize::MAX);
        for (number, solved) in wiring.enumerate().take(most).enumerate() {
            match solved {
                Solved::Wired(assignment) => {
                    if self.args.format == SolveFormat::Human {
                        self.terminal.result(&format!("wiring {}\n", number + 1))?;
                    }
                    let mut text = self.printed(design, &assignment);
                    if self.args.format == SolveFormat::Csv && number > 0 {
                        text = text.split_once('\n').map_or(String::new(), |(_, rows)| rows.into());
                    }
                    self.terminal.result(&text)?;
                }
                Solved::Infeasible(conflict) => {
                    return self.wrong(conflict.diagnostic(design));
                }
                Solved::Failed(failure) => return self.wrong(*failure),
            }
        }
        Ok(Status::Done)
    }
}
