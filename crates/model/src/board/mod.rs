//! A board: its block in; its table, its MCU, its target, its link and its rules out.

pub(crate) mod context;
pub(crate) mod link;
pub(crate) mod pins;
pub(crate) mod table_findings;
pub(crate) mod target;

use sensedsl_board::catalog;
use sensedsl_board::table::{self, Table};
use sensedsl_diagnostics::codes::{
    e0225_too_many_items, e0301_unknown_board, e0302_table_unreadable, w0607_part_not_certain,
    w0608_usages_unknown,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Span};
use sensedsl_limits::{BOARDS_MAX, PLACES_MAX, TABLES_BYTES_MAX};
use sensedsl_parts::Completion;
use sensedsl_syntax::ast::{self, BoardSource};

use crate::design::Board;
use crate::rule;
use crate::source::files::{FileRequest, FileUse, ReadError};
use crate::source::reader::beside;
use crate::spanned::{Spanned, named, span};
use context::{Context, RemainingBudget};

/// The pins of a board, with their origin.
struct Pins {
    table: Table,
    file: FileId,
    /// The built-in board whose pins these are.
    entry: Option<&'static catalog::Entry>,
}

/// Reads the board `node` of `file`; none when its pins cannot be found.
pub(crate) fn read(context: &mut Context<'_>, file: FileId, node: &ast::Board) -> Option<Board> {
    let name = named(file, &node.name()?);
    let rules = rule::of_board(file, node, (context.constants, context.diagnostics));
    let asked = target::asked(context, file, node, name.span);
    let pins = pins(context, file, node, &name).and_then(|pins| afforded(context, pins, name.span));
    let entry = pins.as_ref().and_then(|pins| pins.entry);
    let like = entry.or_else(|| catalog::find(&name.value));
    let pins = pins.map(|pins| completed(context, pins, like));
    let mcu = pins.as_ref().and_then(|pins| pins.table.mcu.clone());
    let target = pins.as_ref().and_then(|pins| {
        let shown = context.sources.name(pins.file).to_owned();
        target::find(&asked, &shown, mcu.as_deref(), context.diagnostics)
    });
    let wired = entry.and_then(|entry| entry.board().ok()).map(|board| board.link);
    let mut link = link::read(
        file,
        node,
        target.as_ref(),
        &wired.unwrap_or_default(),
        (context.constants, context.diagnostics),
    );
    if let (Some(pins), Some(target)) = (&pins, &target) {
        link.vbus &= entry.is_none() || link::vbus_is_wired(&pins.table, target);
    }
    let (pins, target) = (pins?, target?);
    let same_mcu = || mcu.as_deref().and_then(catalog::of_mcu);
    let facts = like.filter(|entry| Some(entry.mcu) == mcu.as_deref()).or_else(same_mcu);
    Some(Board {
        spare: node.is_spare(),
        table: pins.table,
        table_file: pins.file,
        facts: facts.and_then(|entry| entry.board().ok()),
        built_in: pins.entry.is_some(),
        mcu,
        target,
        link,
        reserved: rules.reserved,
        released: rules.released,
        wishes: rules.wishes,
        allows: rules.allows,
        name,
    })
}

fn pins(
    context: &mut Context<'_>,
    file: FileId,
    node: &ast::Board,
    name: &Spanned<String>,
) -> Option<Pins> {
    if let Some(path) = context.request.board {
        let as_name = Spanned { value: path.to_owned(), span: name.span };
        let is_path = path.contains(['/', '\\', '.']) || path == "-";
        return if is_path {
            from_file(context, path, name.span, true)
        } else {
            let before = context.diagnostics.len();
            let pins = built_in(context, &as_name, false);
            // The name is not in the file.
            for one in context.diagnostics.iter_mut().skip(before) {
                one.fixes.clear();
            }
            pins
        };
    }
    match node.on() {
        Some(BoardSource::File(path)) => {
            let target = beside(context.sources.name(file), &path.value());
            from_file(context, &target, span(file, path.range()), false)
        }
        Some(BoardSource::Name(on)) => built_in(context, &whole(file, &on), false),
        None => {
            let own = node.name().map(|own| whole(file, &own));
            built_in(context, own.as_ref().unwrap_or(name), true)
        }
    }
}

/// A board's name, including what a hyphen cuts off. That error has already been reported, and it
/// is clear which board is meant.
fn whole(file: FileId, name: &ast::Name) -> Spanned<String> {
    let (value, range) = name.whole();
    Spanned { value, span: span(file, range) }
}

fn built_in(context: &mut Context<'_>, name: &Spanned<String>, is_own: bool) -> Option<Pins> {
    let Some(entry) = catalog::find(&name.value) else { return part(context, name, is_own) };
    let shown = format!("boards/{}/pins.csv", entry.name);
    let file = context.sources.find(&shown);
    let file = file.unwrap_or_else(|| context.sources.add(shown, entry.csv()));
    let table = context.built_in.entry(file).or_insert_with(|| entry.table()).clone();
    Some(Pins { table, file, entry: Some(entry) })
}

/// The pins of a bare MCU.
fn part(context: &mut Context<'_>, name: &Spanned<String>, is_own: bool) -> Option<Pins> {
    let Some(found) = sensedsl_parts::find(&name.value) else {
        if let Some(what) = catalog::not_yet(&name.value) {
            let not_yet = e0301_unknown_board::board_not_yet(name.span, &name.value, what);
            context.diagnostics.push(not_yet);
            return None;
        }
        let meant = catalog::nearest_name(&name.value).map(str::to_owned);
        let meant = meant.or_else(|| sensedsl_parts::nearest_name(&name.value));
        let unknown =
            e0301_unknown_board::unknown_board(name.span, &name.value, meant.as_deref(), is_own);
        context.diagnostics.push(unknown);
        return None;
    };
    if let Some(doubt) = found.doubt() {
        context.diagnostics.push(w0607_part_not_certain::part_not_certain(name.span, &doubt));
    }
    let shown = format!("parts/{}.csv", found.mcu);
    let file = context.sources.find(&shown);
    let file = file.unwrap_or_else(|| context.sources.add(shown, found.csv()));
    let sources = &context.sources;
    let read = || table::load(sources.text(file)).board;
    let table = context.built_in.entry(file).or_insert_with(read).clone();
    Some(Pins { table, file, entry: None })
}

/// The pins, unless all boards together then have too many.
fn afforded(context: &mut Context<'_>, pins: Pins, at: Span) -> Option<Pins> {
    let usages: usize = pins.table.pins.iter().map(|pin| 1 + pin.usages.len()).sum();
    let (left, bytes) = (&mut context.left, context.sources.text(pins.file).len());
    let taken = RemainingBudget::take(&mut left.boards, 1, "boards", BOARDS_MAX)
        .and_then(|()| {
            let what = "pins and usages on all boards";
            RemainingBudget::take(&mut left.places, usages, what, PLACES_MAX)
        })
        .and_then(|()| {
            let what = "bytes of tables for all boards";
            RemainingBudget::take(&mut left.bytes, bytes, what, TABLES_BYTES_MAX)
        });
    let Err((what, most)) = taken else { return Some(pins) };
    let report = e0225_too_many_items::too_many_items(at, what, most);
    if context.diagnostics.iter().all(|one| one.code != report.code) {
        context.diagnostics.push(report);
    }
    None
}

/// The pins, with their usages and their MCU. If the table names no MCU, it is that of the built-in
/// board that the file's board is `like`.
fn completed(
    context: &mut Context<'_>,
    mut pins: Pins,
    like: Option<&'static catalog::Entry>,
) -> Pins {
    let named = pins.table.properties.iter().find(|property| property.key == "mcu");
    let at = Span::new(pins.file, named.map_or(0..0, |property| property.range.clone()));
    let table = &mut pins.table;
    if table.mcu.is_none() {
        table.mcu = like.map(|entry| entry.mcu.to_owned());
    }
    let mcu = table.mcu.clone();
    // A table that several boards share is completed, and its mistakes reported, only once.
    let key = (pins.file, mcu.clone());
    if let Some(known) = context.completed.get(&key) {
        pins.table.clone_from(known);
        return pins;
    }
    let mut say = |diagnostic: Diagnostic| context.diagnostics.push(diagnostic);
    match sensedsl_parts::complete(table) {
        Completion::Own => {}
        Completion::Unknown if table.pins.is_empty() => {}
        Completion::Unknown => say(w0608_usages_unknown::no_part(at, mcu.as_deref())),
        Completion::Part { found, strangers } => {
            // For a part known in only one package, the table shows which pins there are.
            if found.ambiguous
                && let Some(doubt) = found.doubt()
            {
                say(w0607_part_not_certain::part_not_certain(at, &doubt));
            }
            for pin in strangers.iter().filter_map(|name| table.pin(name)) {
                let at = Span::new(pins.file, pin.range.clone());
                say(w0608_usages_unknown::no_pin(at, &pin.spelled, &found.mcu));
            }
        }
    }
    context.completed.insert(key, pins.table.clone());
    pins
}

fn from_file(context: &mut Context<'_>, path: &str, at: Span, by_user: bool) -> Option<Pins> {
    if let Some(file) = context.sources.find(path) {
        // A table that several boards share is read, and its mistakes reported, only once.
        let table = context.tables.get(&file).cloned();
        let table = table.unwrap_or_else(|| table::load(context.sources.text(file)).board);
        return Some(Pins { table, file, entry: None });
    }
    let wanted = FileRequest { path, what: FileUse::Table, by_user };
    let text = match context.files.read(&wanted) {
        Ok(text) => text,
        Err(unread) => {
            let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
            let known = catalog::find(name).is_some() || sensedsl_parts::find(name).is_some();
            let absent = matches!(unread, ReadError::Missing | ReadError::Why(_));
            context.diagnostics.push(if known && absent {
                e0302_table_unreadable::board_in_quotes(at, name)
            } else {
                unread.diagnostic(at, &wanted)
            });
            return None;
        }
    };
    let file = context.sources.add(path, text);
    let loaded = table::load(context.sources.text(file));
    for finding in &loaded.findings {
        let diagnostic = table_findings::diagnostic(finding, file, context.sources);
        context.diagnostics.push(diagnostic);
    }
    context.tables.insert(file, loaded.board.clone());
    Some(Pins { table: loaded.board, file, entry: None })
}
