//! Lenses: what a board's wiring costs and how much room it leaves, what a part costs and why it is where it is.

use sensedsl_model::design::Design;
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::capacity;
use serde_json::{Value, json};

use crate::answer::Refusal;
use crate::context::Context;
use crate::protocol::{CodeLens, Command};
use crate::wires;

/// The command that tells why a part is on its pins.
pub(crate) const EXPLAIN: &str = "sensedsl.explain";
/// The command that tells what a board has room for.
pub(crate) const CAPACITY: &str = "sensedsl.capacity";

/// The lenses of a file.
pub(crate) fn of_file(cx: &Context<'_>) -> Vec<CodeLens> {
    let Some((design, wiring)) = cx.wired.as_ref().and_then(|wired| wired.wired()) else {
        return Vec::new();
    };
    let rows = wires::all((design, wiring));
    let uri = cx.documents.uri(&cx.path);
    let mut found = Vec::new();
    for board in cx.ast().boards() {
        let Some(name) = board.name() else { continue };
        let mut used = wiring.used(design);
        let Some((on, _)) = used.find(|(_, one)| one.name.value == name.text()) else { continue };
        let devices = on.devices.len();
        let plural = if devices == 1 { "" } else { "s" };
        let status = wiring.status.name();
        let title = format!("{devices} device{plural}, cost {}, {status}", on.cost);
        let range = cx.range_of(name.range());
        let arguments = vec![json!(uri), json!(name.text())];
        let command = |title: String| Command {
            title,
            command: CAPACITY.to_owned(),
            arguments: arguments.clone(),
        };
        found.push(CodeLens { range, command: command(title) });
        found.push(CodeLens { range, command: command("room left".to_owned()) });
    }
    let root = cx.root();
    let devices = root.descendants().filter_map(ast::Device::cast).map(|one| one.name());
    let chips = root.descendants().filter_map(ast::Chip::cast).map(|one| one.name());
    for name in devices.chain(chips).flatten() {
        let rows = wires::of_part(&rows, name.text());
        if rows.is_empty() {
            continue;
        }
        let title = format!("cost {}: explain", wires::cost(&rows));
        let arguments = vec![json!(uri), json!(name.text())];
        let command = Command { title, command: EXPLAIN.to_owned(), arguments };
        found.push(CodeLens { range: cx.range_of(name.range()), command });
    }
    found.sort_by_key(|one| (one.range.start, one.range.end));
    found
}

/// The answer to a command: a text for people.
///
/// # Errors
/// There is no wiring yet, the name is none of the design, or there was no time.
pub(crate) fn executed(cx: &Context<'_>, command: &str, name: &str) -> Result<Value, Refusal> {
    let known = cx.wired.as_ref().and_then(|wired| wired.wired());
    let Some((design, wiring)) = known else {
        return Err(Refusal::Impossible("no wiring has been found yet".to_owned()));
    };
    match command {
        EXPLAIN => match super::hover::explained(cx, (design, wiring), name) {
            Some(text) => Ok(json!(text)),
            None if cx.cancel.is_over() => Err(Refusal::Cancelled),
            None => Err(Refusal::Impossible(format!("{name} has no wires in this wiring"))),
        },
        CAPACITY => room(cx, (design, wiring), name),
        _ => Err(Refusal::Parameters(format!("there is no command {command}"))),
    }
}

/// What a board has room for, as a list.
fn room(
    cx: &Context<'_>,
    (design, wiring): (&Design, &Assignment),
    name: &str,
) -> Result<Value, Refusal> {
    let Some(board) = design.boards.iter().position(|one| one.name.value == name) else {
        return Err(Refusal::Impossible(format!("there is no board {name}")));
    };
    let found = capacity(design, wiring, false, cx.cancel);
    let of_board = found.all.iter().filter(|one| one.board.0 == board);
    let mut text = format!("Room left on {name}, for one kind alone:\n\n");
    for one in of_board {
        let blocked = if one.blocked_by.is_empty() {
            String::new()
        } else {
            format!(", then it lacks {}", one.blocked_by.join(", "))
        };
        text.push_str(&format!("- {} {}{blocked}\n", one.more, one.kind));
    }
    if !found.complete {
        text.push_str("- … there was no time for the others\n");
    }
    Ok(json!(text))
}
