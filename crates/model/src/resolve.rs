//! From the text of a file to a checked design: calls the readers and the checks in their order.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_diagnostics::codes::{
    e0117_more_mistakes, e0203_duplicate_identifier, e0206_missing_property, e0225_too_many_items,
    e0312_unknown_place, e0315_no_board, e0317_table_too_large, h0708_drivers_alone,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Severity, SourceMap, Span};
use sensedsl_limits::{DIAGNOSTICS_MAX, ITEMS_MAX, WIRES_MAX};
use sensedsl_syntax::{Parse, ast};

use crate::board::context::{Context, RemainingBudget};
use crate::board::{self, link, pins};
use crate::control;
use crate::design::{Board, BoardIndex, Design};
use crate::driver::Drivers;
use crate::driver::known::Known;
use crate::part::block::{Next, ReadPart, assemble};
use crate::part::{chip, device, frames, ids, registers, serial};
use crate::request::Request;
use crate::rule::{checks, names};
use crate::sound::{Partial, broken_drivers};
use crate::source::files::Files;
use crate::source::fixes::settle_fixes;
use crate::source::reader::{Items, Reader};
use crate::source::syntax_errors;
use crate::spanned::Spanned;
use crate::test;
use crate::value::constants::Constants;
use crate::value::definitions;

/// The result of resolving a file.
#[derive(Debug, Default)]
pub struct Resolved {
    /// The design; none if there are errors.
    pub design: Option<Design>,
    /// The sound part of a design with errors; none without errors, or if no board can be read.
    pub partial: Option<Partial>,
    /// The diagnostics, in the order of their places.
    pub diagnostics: Vec<Diagnostic>,
    /// All texts that were read, and those that are built in.
    pub sources: SourceMap,
    /// The sources that are files, each once: the requested one, those it uses, and tables.
    pub files: Vec<FileId>,
    /// The syntax trees of the texts in the language, in the order of reading.
    pub trees: Vec<(FileId, Parse)>,
    /// The constants of all texts.
    pub constants: Constants,
}

/// Reads a file, the files it uses and its tables. Never fails on user text.
#[must_use]
pub fn resolve(request: &Request<'_>, files: &dyn Files) -> Resolved {
    let mut sources = SourceMap::default();
    let mut diagnostics = Vec::new();
    let mut reader = Reader::new(files, &mut sources, &mut diagnostics);
    let file = reader.read(request.path, request.text.to_owned());
    let items = std::mem::take(&mut reader.items);
    let trees = std::mem::take(&mut reader.trees);
    let mut read: Vec<FileId> = trees.iter().map(|(file, _)| *file).collect();
    let constants = definitions::computed(&items.constants, &mut diagnostics);
    let drivers = Drivers::new(&items.drivers, &mut sources, &mut diagnostics);
    let (boards, tables) =
        read_boards(request, files, &items, &constants, &mut sources, &mut diagnostics);
    read.extend(tables);
    let known = Known { constants: &constants, drivers: &drivers };
    let (mut parts, unread) = read_parts(&items, known, &mut diagnostics);
    ids::complete(&mut parts, &mut diagnostics);
    chip::check::drivers(known, &mut diagnostics);
    let constant_names = definitions::names(&items.constants);
    names::check("constant", &constant_names.iter().collect::<Vec<_>>(), &mut diagnostics);
    let board_names = board_names(&items);
    check_names(&board_names, &parts, &drivers, &mut diagnostics);
    let has_drivers_alone =
        items.boards.is_empty() && items.parts.is_empty() && !items.drivers.is_empty();
    let is_wrong = |one: &Diagnostic| one.severity == Severity::Error;
    if has_drivers_alone && !diagnostics.iter().any(is_wrong) {
        let first = drivers.own_names().first().map(|name| name.span);
        let at = first.unwrap_or_else(|| Span::new(file, 0..0));
        diagnostics.push(h0708_drivers_alone::drivers_alone(at, drivers.own().len()));
    } else if items.boards.is_empty() && !items.broken && !has_drivers_alone {
        let first = parts.first().map(|read| read.part.name.span);
        let at = first.unwrap_or_else(|| Span::new(file, 0..0));
        diagnostics.push(e0315_no_board::no_board(at));
    }
    let (mut design, homeless, controllers) = assemble(file, boards, &board_names, parts);
    pins::bind(&mut design, &mut diagnostics);
    control::bind(&mut design, controllers, &mut diagnostics);
    check_places(&design, &mut diagnostics);
    frames::settle(&mut design, &mut diagnostics);
    registers::settle(&mut design, &mut diagnostics);
    serial::check(&design, &mut diagnostics);
    checks::run(&design, &mut diagnostics);
    link::settle_silence(&mut design, &mut diagnostics);
    if !items.broken {
        // What a test names may be in the text that could not be read.
        let absent = [unread.as_slice(), &homeless].concat();
        let known = (&constants, &mut diagnostics);
        design.tests = test::read(&design, &items.tests, &absent, known);
    }
    if items.broken {
        // An item that seems missing may be in the text that could not be read.
        let missing = e0206_missing_property::CODE;
        diagnostics.retain(|one| one.code != missing);
        syntax_errors::drop_consequences(&trees, &mut diagnostics);
    }
    sort(&mut diagnostics);
    once(&mut diagnostics);
    let is_wrong = diagnostics.iter().any(|one| one.severity == Severity::Error);
    let (design, partial) = if is_wrong {
        let left_out = [unread, homeless].concat();
        let partial = Partial { design, left_out };
        let broken = broken_drivers(&drivers, &diagnostics);
        let partial = partial.without(&diagnostics).without_drivers(&broken);
        let partial = partial.without_doubtful_tables(&diagnostics);
        (None, Some(partial).filter(|partial| !partial.design.boards.is_empty()))
    } else if has_drivers_alone {
        (None, None)
    } else {
        (Some(design), None)
    };
    limit(&mut diagnostics);
    settle_fixes(&mut diagnostics, &read, &trees, &sources);
    Resolved { design, partial, diagnostics, sources, files: read, trees, constants }
}

/// Keeps as many diagnostics as are listed, and adds the number of the rest.
pub(crate) fn limit(diagnostics: &mut Vec<Diagnostic>) {
    let more = diagnostics.len().saturating_sub(DIAGNOSTICS_MAX);
    if more > 0 {
        diagnostics.truncate(DIAGNOSTICS_MAX);
        let at = diagnostics.last().map(|last| last.primary.span);
        let report = |at| e0117_more_mistakes::more_mistakes(at, DIAGNOSTICS_MAX, more);
        diagnostics.extend(at.map(report));
    }
}

/// Sorts diagnostics by place, the most severe first where the place is the same. "Too much"
/// diagnostics come first, because people see only a few of the mistakes in such a file.
pub fn sort(diagnostics: &mut [Diagnostic]) {
    let is_too_much = |one: &Diagnostic| {
        [e0225_too_many_items::CODE, e0317_table_too_large::CODE].contains(&one.code)
    };
    diagnostics.sort_by_key(|one| (!is_too_much(one), one.primary.span, one.severity, one.code));
}

/// Removes duplicates: a driver's mistake shows up in each of its devices.
fn once(diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.dedup();
}

/// The boards, and the files of their tables.
fn read_boards(
    request: &Request<'_>,
    files: &dyn Files,
    items: &Items,
    constants: &Constants,
    sources: &mut SourceMap,
    diagnostics: &mut Vec<Diagnostic>,
) -> (Vec<Option<Board>>, Vec<FileId>) {
    let mut context = Context {
        request,
        files,
        sources,
        diagnostics,
        constants,
        completed: BTreeMap::new(),
        tables: BTreeMap::new(),
        built_in: BTreeMap::new(),
        left: RemainingBudget::default(),
    };
    let read = |(file, node): &(FileId, _)| board::read(&mut context, *file, node);
    let boards = items.boards.iter().map(read).collect();
    (boards, context.tables.into_keys().collect())
}

/// The parts, and the names of those too little of which is understood.
fn read_parts(
    items: &Items,
    known: Known<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> (Vec<ReadPart>, Vec<Spanned<String>>) {
    let (mut parts, mut unread) = (Vec::new(), Vec::new());
    let (mut room, mut next) = (Room::default(), Next::FIRST);
    for (file, node, board) in &items.parts {
        let at = (*file, next);
        let board = board.map(BoardIndex);
        let (read, name) = match node {
            ast::Item::Device(node) => {
                (device::read(at, node, board, known, diagnostics), node.name())
            }
            ast::Item::Chip(node) => (chip::read(at, node, board, known, diagnostics), node.name()),
            ast::Item::Controller(node) => {
                (control::read(at, node, board, known, diagnostics), node.name())
            }
        };
        match read {
            Some(part) => {
                if let Some((what, most)) = room.lacks(&part) {
                    let at = part.part.name.span;
                    diagnostics.push(e0225_too_many_items::too_many_items(at, what, most));
                    break;
                }
                next = next.after(&part);
                parts.push(part);
            }
            None => unread.extend(name.map(|name| Spanned {
                value: name.text().to_owned(),
                span: crate::spanned::span(*file, name.range()),
            })),
        }
    }
    (parts, unread)
}

/// Counts of what chips and arrays create many of.
#[derive(Default)]
struct Room {
    devices: usize,
    wires: usize,
}

impl Room {
    /// Counts a part. If there is too much of something, returns its name and limit.
    fn lacks(&mut self, read: &ReadPart) -> Option<(&'static str, usize)> {
        self.devices += read.devices.len();
        self.wires += read.connections.iter().map(|one| 1 + one.wishes.len()).sum::<usize>();
        if self.devices > ITEMS_MAX {
            return Some(("devices, those that chips have by themselves included", ITEMS_MAX));
        }
        let full = self.wires > WIRES_MAX;
        full.then_some(("sets of wires with their rules", WIRES_MAX))
    }
}

/// The names of the boards; none for a board without a name.
fn board_names(items: &Items) -> Vec<Option<Spanned<String>>> {
    let name = |(file, node): &(FileId, ast::Board)| {
        let name = node.name()?;
        let span = crate::spanned::span(*file, name.range());
        Some(Spanned { value: name.text().to_owned(), span })
    };
    items.boards.iter().map(name).collect()
}

fn check_names(
    boards: &[Option<Spanned<String>>],
    parts: &[ReadPart],
    drivers: &Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) {
    names::check("board", &boards.iter().flatten().collect::<Vec<_>>(), diagnostics);
    names::check("driver", &drivers.own_names(), diagnostics);
    let devices = || parts.iter().flat_map(|read| &read.devices);
    // The names of chips and of their devices name different things, and are in different places in
    // the code.
    let device_names: Vec<_> = devices().map(|device| &device.name).collect();
    names::check("device", &device_names, diagnostics);
    let chips = parts.iter().filter(|read| read.part.chip.is_some());
    let stands_alone = |read: &&ReadPart| read.devices.iter().all(|one| one.name != read.part.name);
    let chips: Vec<_> = chips.filter(stands_alone).map(|read| &read.part.name).collect();
    names::check("chip", &chips, diagnostics);
    let mut seen: BTreeMap<u8, Span> = BTreeMap::new();
    let used: BTreeSet<u8> = devices().map(|device| device.id.value).collect();
    let free = (1..=254_u8).find(|id| !used.contains(id));
    let names = |read: &ReadPart| -> BTreeSet<Span> {
        let of_devices = read.devices.iter().map(|device| device.name.span);
        of_devices.chain([read.part.name.span]).collect()
    };
    let ids = parts.iter().flat_map(|read| {
        let names = names(read);
        read.devices.iter().map(move |device| (device.id, !names.contains(&device.id.span)))
    });
    for (Spanned { value, span }, is_written) in ids.filter(|(id, _)| id.value > 0) {
        match seen.get(&value) {
            Some(first) => {
                let report = e0203_duplicate_identifier::duplicate_identifier;
                diagnostics.push(report((span, is_written), value, *first, free));
            }
            None => {
                seen.insert(value, span);
            }
        }
    }
}

/// Checks that fixed pins, sides and headers are in the tables of the boards that a device may go
/// to.
fn check_places(design: &Design, diagnostics: &mut Vec<Diagnostic>) {
    for wires in &design.connections {
        let boards: Vec<&Board> = match wires.board {
            Some(index) => design.board(index).into_iter().collect(),
            None => design.boards.iter().collect(),
        };
        let side = (&wires.placement.side, "side");
        let header = (&wires.placement.header, "header");
        for (wanted, what) in [side, header] {
            let Some(wanted) = wanted else { continue };
            let known = places(&boards, what);
            if !known.iter().any(|name| name.eq_ignore_ascii_case(&wanted.value)) {
                diagnostics.push(e0312_unknown_place::unknown_place(
                    wanted.span,
                    what,
                    &wanted.value,
                    &known,
                ));
            }
        }
    }
}

fn places(boards: &[&Board], what: &str) -> Vec<String> {
    let pins = boards.iter().flat_map(|board| &board.table.pins);
    let names = pins.flat_map(|pin| if what == "side" { pin.sides() } else { pin.headers() });
    let mut names: Vec<String> = names.map(str::to_owned).collect();
    names.sort();
    names.dedup();
    names
}
