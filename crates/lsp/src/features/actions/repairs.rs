//! Repairs: the changes that `E0401` proposes, as edits of the text. Each is tried before it is offered: the text is
//! changed in a copy, and the design must have a wiring then.

use std::ops::Range as Bytes;

use sensedsl_board::table::release_name;
use sensedsl_diagnostics::codes::e0401_no_wiring;
use sensedsl_diagnostics::{Diagnostic, FileId};
use sensedsl_model::design::{BoardIndex, Design, PartIndex, Transport};
use sensedsl_model::written::shown_hz;
use sensedsl_session::{Ask, Goal};
use sensedsl_syntax::SyntaxNode;
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_syntax::edit::{indent, without};
use sensedsl_wiring::{NoWiring, Repair, Solved};

use super::changes::{Changes, node, token};
use super::offer::{QUICK_FIX, action, capital, property, touches, wired, written};
use super::pins::freed;
use crate::context::{Context, bytes};
use crate::edits::{Edit, added, removed};
use crate::features::diagnostics::Places;
use crate::protocol::CodeAction;

/// The properties besides pins that say where the wires of a part are.
const PLACES: [&str; 5] = ["unit", "side", "header", "together", "sequence"];

/// What is offered where a conflict is told.
pub(super) fn at(cx: &Context<'_>, range: &Bytes<usize>) -> Vec<CodeAction> {
    let Some(wired) = wired(cx) else { return Vec::new() };
    let (Some(design), Some(Solved::Infeasible(conflict))) =
        (wired.answer.design.as_deref(), wired.answer.solved.as_ref())
    else {
        return Vec::new();
    };
    let mut told = wired.diagnostics.iter().filter(|one| one.code == e0401_no_wiring::CODE);
    let here = |one: &&Diagnostic| {
        let labels = one.labels.iter().map(|label| label.span).chain([one.primary.span]);
        labels.filter(|span| span.file == cx.file).any(|span| touches(&span.range(), range))
    };
    let Some(told) = told.find(here) else { return Vec::new() };
    offered(cx, design, conflict, told)
}

fn offered(
    cx: &Context<'_>,
    design: &Design,
    conflict: &NoWiring,
    told: &Diagnostic,
) -> Vec<CodeAction> {
    let told = Places::new(&cx.analysis, cx.documents).told(told).map(|(_, told)| told);
    let mut actions = Vec::new();
    for repaired in &conflict.repairs {
        if cx.cancel.is_over() {
            break;
        }
        let Some(changes) = changed(cx, design, &repaired.repair) else { continue };
        if !helps(cx, &changes) {
            continue;
        }
        let title = capital(&repaired.repair.describe(design));
        let offered = action(cx, title, QUICK_FIX, &changes);
        let diagnostics: Vec<_> = told.clone().into_iter().collect();
        actions.extend(offered.map(|action| CodeAction { diagnostics, ..action }));
    }
    actions
}

/// Whether there is a wiring after the changes, and no new mistake.
fn helps(cx: &Context<'_>, changes: &Changes) -> bool {
    let ask = Ask { goal: Goal::Any, partly: true, cancel: cx.cancel, ..Ask::default() };
    changes.sound(cx).is_some_and(|after| after.solve(&ask).wired().is_some())
}

/// A repair as an edit.
fn changed(cx: &Context<'_>, design: &Design, repair: &Repair) -> Option<Changes> {
    match repair {
        Repair::Free(part) => {
            freed(cx, design, *part, |one| one.kind.roles(one.direction), &PLACES)
        }
        Repair::Share(parts) => {
            let mut changes = Changes::default();
            for part in parts {
                let (file, edit) = set(cx, design, *part, "exclusive", "false")?;
                changes.add(file, edit);
            }
            Some(changes)
        }
        Repair::Retune(part, hz) => {
            let (file, edit) = set(cx, design, *part, "frequency", &shown_hz(*hz))?;
            Some(Changes::of(file, edit))
        }
        Repair::Move(part, to) => moved(cx, design, *part, *to),
        Repair::Unreserve(on, name) => {
            let rule = design.board(*on)?.reserved.iter().find(|rule| rule.value == *name)?;
            let text = cx.analysis.snapshot.sources().text(rule.span.file);
            let edit = without(text, &token(cx, rule.span)?)?;
            Some(Changes::of(rule.span.file, edit))
        }
        Repair::Release(on, name) => {
            let (file, board) = board(cx, design, *on)?;
            let rule = format!("release {};", release_name(name));
            Some(Changes::of(file, added(board.syntax(), &rule)?))
        }
        Repair::Relink(on, to) => relinked(cx, design, *on, *to),
        Repair::Drop(part) => {
            let block = design.part(*part)?.block;
            let text = cx.analysis.snapshot.sources().text(block.file);
            Some(Changes::of(block.file, removed(text, &node(cx, block)?)))
        }
    }
}

/// Gives a property of a part a value, where it stands or at the end of the block.
fn set(
    cx: &Context<'_>,
    design: &Design,
    part: PartIndex,
    name: &str,
    value: &str,
) -> Option<(FileId, Edit)> {
    let span = design.part(part)?.block;
    let block = node(cx, span)?;
    let own = block.children().filter_map(ast::Property::cast);
    let of_connections = block.children().filter_map(ast::Connection::cast);
    let all = own.chain(of_connections.flat_map(|one| one.properties().collect::<Vec<_>>()));
    let edit = match property(all, name).and_then(|found| found.value()) {
        Some(found) => (bytes(found.range()), value.to_owned()),
        None => added(&block, &format!("{name} = {value};"))?,
    };
    Some((span.file, edit))
}

/// A board of the file, by the place of its name.
fn board(cx: &Context<'_>, design: &Design, on: BoardIndex) -> Option<(FileId, ast::Board)> {
    let at = design.board(on)?.name.span;
    let board = token(cx, at)?.parent()?.ancestors().find_map(ast::Board::cast)?;
    Some((at.file, board))
}

/// Takes a part out of its block, and adds it to another board.
fn moved(cx: &Context<'_>, design: &Design, part: PartIndex, to: BoardIndex) -> Option<Changes> {
    let block = design.part(part)?.block;
    let text = cx.analysis.snapshot.sources().text(block.file);
    let part = node(cx, block)?;
    let (file, board) = board(cx, design, to)?;
    let mut changes = Changes::of(block.file, removed(text, &part));
    let whole = outdented(&part);
    changes.add(file, added(board.syntax(), &whole)?).then_some(changes)
}

/// A block as it would be written at the beginning of a line.
fn outdented(block: &SyntaxNode) -> String {
    let indent = indent(block);
    let mut lines = Vec::new();
    for (number, line) in written(block).split('\n').enumerate() {
        let line = if number == 0 { line } else { line.strip_prefix(&*indent).unwrap_or(line) };
        lines.push(line.to_owned());
    }
    lines.join("\n")
}

/// Gives a board another link.
fn relinked(cx: &Context<'_>, design: &Design, on: BoardIndex, to: Transport) -> Option<Changes> {
    let (file, board) = board(cx, design, on)?;
    let link = format!("link {{ transport = {}; }}", to.name());
    let edit = match board.links().next() {
        // What else it says may be of the other transport.
        Some(stated) => (bytes(stated.range()), link),
        None => added(board.syntax(), &link)?,
    };
    Some(Changes::of(file, edit))
}
