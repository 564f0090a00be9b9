//! Where a name is described, where it is used, and the same as colours in one file.

use sensedsl_diagnostics::Span;
use sensedsl_model::design::BoardIndex;
use sensedsl_syntax::ast::{self, AstNode as _};
use serde_json::{Value, json};

use crate::context::{Context, bytes};
use crate::names::Names;
use crate::protocol::Location;

/// The number of a use for the client.
const READ: u8 = 2;
/// The number of a declaration.
const WRITE: u8 = 3;

/// Where what is named at an offset is described: the block of a device, a file that is used, a row of a table.
pub(crate) fn definition(cx: &Context<'_>, offset: usize) -> Vec<Location> {
    if let Some(found) = file_at(cx, offset).or_else(|| pin_at(cx, offset)) {
        return cx.location(found).into_iter().collect();
    }
    let names = Names::new(&cx.analysis.snapshot);
    let Some(thing) = names.at(cx.file, offset).map(|one| one.thing.clone()) else {
        return Vec::new();
    };
    let found = names.of(&thing).filter(|one| one.is_declaration);
    found.filter_map(|one| cx.location(one.span)).collect()
}

/// All places of what is named at an offset.
pub(crate) fn references(cx: &Context<'_>, offset: usize, with_declaration: bool) -> Vec<Location> {
    let names = Names::new(&cx.analysis.snapshot);
    let Some(thing) = names.at(cx.file, offset).map(|one| one.thing.clone()) else {
        return Vec::new();
    };
    let wanted = names.of(&thing).filter(|one| with_declaration || !one.is_declaration);
    wanted.filter_map(|one| cx.location(one.span)).collect()
}

/// The places of what is named at an offset, in its file.
pub(crate) fn highlights(cx: &Context<'_>, offset: usize) -> Vec<Value> {
    let names = Names::new(&cx.analysis.snapshot);
    let Some(thing) = names.at(cx.file, offset).map(|one| one.thing.clone()) else {
        return Vec::new();
    };
    let here = names.of(&thing).filter(|one| one.span.file == cx.file);
    let shown = here.map(|one| {
        let kind = if one.is_declaration { WRITE } else { READ };
        json!({ "range": cx.range(one.span.range()), "kind": kind })
    });
    shown.collect()
}

/// The start of the file whose path is at an offset: after `use`, or the table after `on`.
fn file_at(cx: &Context<'_>, offset: usize) -> Option<Span> {
    let token = cx.token(offset)?;
    let parent = token.parent()?;
    let text = ast::Use::cast(parent.clone()).and_then(|one| one.path());
    let text = text.or_else(|| match ast::Board::cast(parent.parent()?)?.on()? {
        ast::BoardSource::File(path) => Some(path),
        ast::BoardSource::Name(_) => None,
    });
    let text = text.filter(|text| bytes(text.range()).contains(&offset))?;
    let snapshot = &cx.analysis.snapshot;
    let folder = cx.path.rsplit_once('/').map_or("", |(folder, _)| folder);
    let wanted = sensedsl_model::normal_path(&format!("{folder}/{}", text.value()));
    let found = snapshot.files().iter().find(|file| snapshot.sources().name(**file) == wanted)?;
    Some(Span::new(*found, 0..0))
}

/// The row of a table for the pin that is fixed at an offset.
fn pin_at(cx: &Context<'_>, offset: usize) -> Option<Span> {
    let design = cx.analysis.snapshot.sound()?.design;
    let is_here = |span: Span| span.file == cx.file && span.range().contains(&offset);
    let pins = design.connections.iter().flat_map(|one| &one.placement.pins);
    let (_, pin) = pins.into_iter().find(|(_, pin)| is_here(pin.span))?;
    let boards = design.boards.iter().enumerate().filter(|(_, board)| !board.built_in);
    let mut rows = boards.filter_map(|(index, board)| {
        let row = board.table.pin(pin.value.on(BoardIndex(index))?)?;
        Some(board.table_span(row.range.clone()))
    });
    rows.next()
}
