//! Pins: the row of the board's table, and who is on it.

use sensedsl_board::table::Pin;
use sensedsl_diagnostics::Span;
use sensedsl_model::design::{Board, BoardIndex, Design, PinRef};
use sensedsl_syntax::SyntaxToken;

use crate::context::{Context, bytes};
use crate::wires::{self, escaped};

/// The pin that a property fixes, or that a rule is about.
pub(crate) fn pin(cx: &Context<'_>, token: &SyntaxToken) -> Option<String> {
    let design = cx.analysis.snapshot.sound()?.design;
    let range = bytes(token.text_range());
    let is_here = |span: Span| {
        let at = span.range();
        span.file == cx.file && at.start <= range.start && range.end <= at.end
    };
    let mut fixed = design.connections.iter().flat_map(|one| &one.placement.pins);
    let (_, fixed) = fixed.find(|(_, pin)| is_here(pin.span))?;
    let found: Vec<String> =
        rows(design, &fixed.value).map(|(board, pin)| row(cx, board, pin)).collect();
    (!found.is_empty()).then(|| found.join("\n\n"))
}

fn rows<'a>(design: &'a Design, pin: &'a PinRef) -> impl Iterator<Item = (&'a Board, &'a Pin)> {
    let boards = design.boards.iter().enumerate();
    boards.filter_map(|(index, board)| Some((board, board.table.pin(pin.on(BoardIndex(index))?)?)))
}

/// A row of a table.
fn row(cx: &Context<'_>, board: &Board, pin: &Pin) -> String {
    let labels = pin.labels();
    let labels =
        if labels.is_empty() { String::new() } else { format!(" ({})", labels.join(", ")) };
    let mut text =
        format!("**{}**{} of {}", pin.name, escaped(&labels), escaped(&board.name.value));
    let usages: Vec<String> = pin.usages.iter().map(|one| format!("`{}`", one.spelled)).collect();
    text.push_str(&format!("\n\n{} usages: {}", pin.cost(), usages.join(" ")));
    let places: Vec<&str> = pin.headers();
    if !places.is_empty() {
        text.push_str(&format!("\n\non {}", escaped(&places.join(", "))));
    }
    if let Some(onboard) = &pin.onboard {
        text.push_str(&format!("\n\nwired on the board to {}", escaped(&onboard.part)));
    }
    for (what, said) in [("stands", &pin.voltage), ("note:", &pin.note)] {
        if let Some(said) = said {
            text.push_str(&format!("\n\n{what} {}", escaped(said)));
        }
    }
    if let Some(known) = cx.wired.as_ref().and_then(|wired| wired.wired()) {
        let name = pin.name.to_string();
        let rows = wires::all(known);
        let mut users = rows.iter().filter(|row| row.board == board.name.value && row.pin == name);
        match users.next() {
            Some(row) => text
                .push_str(&format!("\n\ntaken by {} ({}, {})", row.device, row.role, row.signal)),
            None => text.push_str("\n\nfree in this wiring"),
        }
    }
    text
}
