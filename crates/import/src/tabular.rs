//! A table as text in, a board table out. The table can be wide (a row for each pin), long (a row
//! for each pin and signal), or have a column for each alternate function.

use std::collections::BTreeMap;
use std::ops::Range;

use sensedsl_board::cells::{self, Cell};
use sensedsl_board::finding::FindingKind;
use sensedsl_board::pin::PinName;
use sensedsl_board::remap::Blocks;
use sensedsl_board::table::{self, Occupation, Onboard, ROUTED, Role};
use sensedsl_diagnostics::{FileId, Span};
use sensedsl_limits::{PIN_USAGES_MAX, USAGES_MAX};
use sensedsl_model::table_diagnostic;

use crate::assemble::{self, Row};
use crate::log::Log;
use crate::place::a1;
use crate::project::pads::pad;
use crate::source::Texts;

/// Headers of the pin column, in lower case, letters only.
const PIN_HEADS: [&str; 11] = [
    "pin", "pins", "pinname", "pinnames", "gpio", "gpiopin", "portpin", "pinport", "io", "ioname",
    "pad",
];
/// Headers of the signal column in a long table.
const SIGNAL_HEADS: [&str; 10] = [
    "signal",
    "signals",
    "signalname",
    "function",
    "functions",
    "functionname",
    "alternate",
    "alternatefunction",
    "usage",
    "usages",
];
/// Headers of the column of alternate-function numbers in a long table.
const NUMBER_HEADS: [&str; 6] = ["af", "afnumber", "afno", "mux", "afindex", "alternatenumber"];
/// The number of rows in which the header row is looked for.
const HEAD_ROWS: usize = 30;

/// Imports a table. `sheet` is the name of the workbook's sheet that the text comes from.
pub(crate) fn import(file: FileId, text: &str, sheet: Option<&str>, log: &mut Log) -> Texts {
    if log.has_errors() {
        return Texts::default();
    }
    let cut = cells::split(text);
    let reader = Reader { file, text, sheet, rows: &cut.rows, lines: line_starts(text) };
    let Some(head) = reader.head() else {
        let what = "no row names a column `Pin`";
        log.no_table(Span::new(file, 0..0), what);
        return Texts::default();
    };
    if let Some(cut) = cut.cut {
        log.table_too_large(Span::new(file, cut.at..cut.at), cut.what, cut.most);
        return Texts::default();
    }
    for row in cut.rows.iter().take(head.row) {
        if let Some(cell) = row.iter().find(|cell| !reader.content(cell).is_empty()) {
            let what = "the row is above the table and is left out";
            log.dropped(reader.span(cell), &reader.place(cell), what);
        }
    }
    let csv = match reader.layout(&head) {
        Layout::Wide => reader.wide(&head, log),
        Layout::Long { signal, number } => reader.long(&head, signal, number, log),
        Layout::Numbered(numbers) => reader.numbered(&head, &numbers, log),
    };
    Texts { table: csv, program: None }
}

/// Whether a text has the header row of a pin table.
pub(crate) fn has_head(text: &str) -> bool {
    let rows = cells::split(text).rows;
    find_head(text, &rows).is_some()
}

/// The place of the header row.
struct Head {
    row: usize,
    /// The index of the pin column.
    pin: usize,
}

enum Layout {
    Wide,
    Long {
        signal: usize,
        number: Option<usize>,
    },
    /// Columns with the numbers of their alternate functions.
    Numbered(BTreeMap<usize, u8>),
}

struct Reader<'a> {
    file: FileId,
    text: &'a str,
    sheet: Option<&'a str>,
    rows: &'a [Vec<Cell>],
    lines: Vec<usize>,
}

/// A header in lower case, only letters: `Pin name` and `PIN_NAME` are the same header.
fn plain(head: &str) -> String {
    head.chars().filter(|c| c.is_alphabetic()).flat_map(char::to_lowercase).collect()
}

/// The number of a header such as `AF7`.
fn alternate(head: &str) -> Option<u8> {
    let digits = head.trim().strip_prefix("AF").or_else(|| head.trim().strip_prefix("af"))?;
    digits.parse().ok().filter(|number| *number < 16)
}

fn line_starts(text: &str) -> Vec<usize> {
    let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
    std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect()
}

fn content_of(text: &str, cell: &Cell) -> String {
    cells::content(text.get(cell.range.clone()).unwrap_or_default(), cell.quoted)
}

fn find_head(text: &str, rows: &[Vec<Cell>]) -> Option<Head> {
    let contents = |row: &Vec<Cell>| -> Vec<String> {
        row.iter().map(|cell| content_of(text, cell)).collect()
    };
    for (at, row) in rows.iter().enumerate().take(HEAD_ROWS) {
        let heads = contents(row);
        let filled = heads.iter().filter(|head| !head.is_empty()).count();
        // `Pin` itself comes before its synonyms: a table may have both `Pad` and `Pin`.
        let pin = PIN_HEADS.iter().find_map(|name| heads.iter().position(|h| plain(h) == *name));
        let numbered = heads.iter().filter(|head| alternate(head).is_some()).count() >= 3;
        if let Some(pin) = pin.filter(|_| filled >= 2) {
            return Some(Head { row: at, pin });
        }
        if numbered {
            let below = rows.get(at + 1..).unwrap_or_default();
            let names = |column: usize| {
                let cells = below.iter().filter_map(|row| row.get(column));
                cells.filter(|cell| PinName::parse(&content_of(text, cell)).is_some()).count()
            };
            let plain_columns = (0..row.len())
                .filter(|at| heads.get(*at).is_none_or(|head| alternate(head).is_none()));
            let pin = plain_columns.rev().max_by_key(|column| names(*column))?;
            return (names(pin) > 0).then_some(Head { row: at, pin });
        }
    }
    None
}

impl Reader<'_> {
    fn content(&self, cell: &Cell) -> String {
        content_of(self.text, cell)
    }

    fn span(&self, cell: &Cell) -> Span {
        Span::new(self.file, cell.range.clone())
    }

    /// `Sheet1!C3`, or `C3` if there is no sheet.
    fn place(&self, cell: &Cell) -> String {
        self.place_at(cell.range.start)
    }

    fn place_at(&self, offset: usize) -> String {
        let row = self.lines.partition_point(|start| *start <= offset).saturating_sub(1);
        let ends = |cells: &Vec<Cell>| cells.last().map_or(0, |cell| cell.range.end);
        let cells = self.rows.get(self.rows.partition_point(|cells| ends(cells) < offset));
        let starts =
            |cells: &&Vec<Cell>| cells.first().is_some_and(|cell| cell.range.start <= offset + 1);
        let cells = cells.filter(starts);
        let column = cells.and_then(|cells| {
            cells.iter().position(|cell| {
                cell.range.start.saturating_sub(1) <= offset && offset <= cell.range.end
            })
        });
        let cell = column.map_or(format!("row {}", row + 1), |column| a1(row, column));
        self.sheet.map_or(cell.clone(), |sheet| format!("{sheet}!{cell}"))
    }

    fn head(&self) -> Option<Head> {
        find_head(self.text, self.rows)
    }

    fn below(&self, head: &Head) -> &[Vec<Cell>] {
        self.rows.get(head.row + 1..).unwrap_or_default()
    }

    fn heads(&self, head: &Head) -> Vec<String> {
        let row = self.rows.get(head.row).map(Vec::as_slice).unwrap_or_default();
        row.iter().map(|cell| self.content(cell)).collect()
    }

    fn layout(&self, head: &Head) -> Layout {
        let heads = self.heads(head);
        let numbers: BTreeMap<usize, u8> = heads
            .iter()
            .enumerate()
            .filter_map(|(at, head)| Some((at, alternate(head)?)))
            .collect();
        if numbers.len() >= 2 {
            return Layout::Numbered(numbers);
        }
        let position =
            |names: &[&str]| heads.iter().position(|head| names.contains(&plain(head).as_str()));
        let signal = position(&SIGNAL_HEADS);
        match signal {
            Some(signal) if self.repeats(head) => {
                let number = position(&NUMBER_HEADS).filter(|number| *number != signal);
                Layout::Long { signal, number }
            }
            Some(_) | None => Layout::Wide,
        }
    }

    /// Whether a pin has several rows.
    fn repeats(&self, head: &Head) -> bool {
        let cells = self.below(head).iter().filter_map(|row| row.get(head.pin));
        let mut pins: Vec<PinName> =
            cells.filter_map(|cell| PinName::parse(&self.content(cell))).collect();
        pins.sort();
        pins.windows(2).any(|pair| pair.first() == pair.last())
    }

    /// The board crate reads wide tables. This only blanks the rows above the header row and
    /// renames the pin column to `Pin`, without moving anything.
    fn wide(&self, head: &Head, log: &mut Log) -> Option<String> {
        let mut text = self.text.to_owned();
        for row in self.rows.iter().take(head.row) {
            let (Some(first), Some(last)) = (row.first(), row.last()) else { continue };
            // The range does not include the quotes around a cell.
            let start = first.range.start - usize::from(first.quoted);
            blank(&mut text, start..last.range.end + usize::from(last.quoted), "");
        }
        let pin = self.rows.get(head.row).and_then(|row| row.get(head.pin))?;
        if !self.content(pin).eq_ignore_ascii_case("Pin") {
            let what = format!("`{}` is taken for the column of the pins", self.content(pin));
            log.doubtful(self.span(pin), &self.place(pin), &what);
            let name = if pin.range.len() < 3 { "" } else { "Pin" };
            blank(&mut text, pin.range.clone(), name);
        }
        let loaded = table::load(&text);
        for finding in &loaded.findings {
            let as_table = table_diagnostic(finding, self.file, &log.sources);
            let (span, place) = (as_table.primary.span, self.place_at(finding.range.start));
            match finding.kind {
                FindingKind::EmptyTable | FindingKind::NoPinColumn { .. } => {
                    log.no_table(span, &as_table.message);
                    return None;
                }
                FindingKind::TooLarge { .. } | FindingKind::More { .. } => {
                    log.say(as_table);
                }
                FindingKind::UnnamedColumn
                | FindingKind::MissingPin
                | FindingKind::BadPinName { .. }
                | FindingKind::DuplicatePin { .. }
                | FindingKind::DuplicateColumn { .. }
                | FindingKind::DuplicateUsage { .. }
                | FindingKind::BadAlternate { .. }
                | FindingKind::UnknownAlternate { .. }
                | FindingKind::AlternateCount { .. }
                | FindingKind::AlternateConflict { .. }
                | FindingKind::BadPlace { .. }
                | FindingKind::UnknownForm { .. }
                | FindingKind::BadLandmark { .. }
                | FindingKind::DuplicateProperty { .. } => {
                    log.dropped(span, &place, &as_table.message);
                }
                FindingKind::RaggedRow { .. }
                | FindingKind::BadQuote
                | FindingKind::MalformedSignal { .. }
                | FindingKind::BadOccupation { .. }
                | FindingKind::UnknownMcu { .. }
                | FindingKind::NoContact { .. }
                | FindingKind::ContactTwice { .. }
                | FindingKind::InvisibleCharacter { .. } => {
                    log.doubtful(span, &place, &as_table.message);
                }
            }
        }
        if loaded.board.pins.is_empty() {
            log.no_table(self.span(pin), "no row below the head names a pin");
            return None;
        }
        Some(loaded.board.to_csv())
    }

    /// The pin of a row; if there is none, reports why.
    fn pin(&self, row: &[Cell], head: &Head, log: &mut Log) -> Option<PinName> {
        let cell = row.get(head.pin).or(row.first())?;
        let spelled = self.content(cell);
        let filled = row.iter().any(|cell| !self.content(cell).is_empty());
        let pin = PinName::parse(&spelled);
        if pin.is_none() && filled {
            let what = format!("`{spelled}` is not a pin; the row is left out");
            log.dropped(self.span(cell), &self.place(cell), &what);
        }
        pin
    }

    fn long(
        &self,
        head: &Head,
        signal: usize,
        number: Option<usize>,
        log: &mut Log,
    ) -> Option<String> {
        let heads = self.heads(head);
        let (mut rows, mut usages) = (Vec::new(), 0);
        let mut ignored: Vec<usize> = Vec::new();
        for cells in self.below(head) {
            let Some(pin) = self.pin(cells, head, log) else { continue };
            let mut row = Row::new(pin);
            for (at, cell) in cells.iter().enumerate() {
                let value = self.content(cell);
                let role = heads.get(at).map_or(Role::Usages, |head| Role::of(head));
                if at == signal || at == head.pin || Some(at) == number || is_empty(&value) {
                    continue;
                }
                if role == Role::Onboard {
                    row.pin.onboard = Some(onboard(&value));
                } else if let Some(text) = row.pin.text_mut(role) {
                    *text = Some(value);
                } else if !ignored.contains(&at) {
                    ignored.push(at);
                    let head = heads.get(at).cloned().unwrap_or_default();
                    let what = format!(
                        "the column `{head}` is left out: a long table has one column of signals"
                    );
                    log.dropped(self.span(cell), &self.place(cell), &what);
                }
            }
            let alternate =
                number.and_then(|at| cells.get(at)).and_then(|cell| self.number(cell, log));
            if let Some(cell) = cells.get(signal) {
                let value = self.content(cell);
                let names = value.split(|c: char| c.is_whitespace() || c == '/' || c == ',');
                for name in names.filter(|name| !is_empty(name)).take(PIN_USAGES_MAX + 1) {
                    row.usages.extend(self.usage(name, alternate, cell, log));
                }
            }
            self.keep(row, &mut rows, &mut usages, log)?;
        }
        self.finish(head, rows, log)
    }

    fn numbered(
        &self,
        head: &Head,
        numbers: &BTreeMap<usize, u8>,
        log: &mut Log,
    ) -> Option<String> {
        let heads = self.heads(head);
        let (mut rows, mut usages) = (Vec::new(), 0);
        for (index, cells) in self.below(head).iter().enumerate() {
            let spelled = cells.get(head.pin).map(|cell| self.content(cell)).unwrap_or_default();
            // The second line of such headers names the peripherals.
            if index == 0 && PinName::parse(&spelled).is_none() {
                continue;
            }
            let Some(pin) = self.pin(cells, head, log) else { continue };
            // MicroPython's tables of RP chips have other names for pins: `GPIO25` is GP25.
            let of_rp = Some(&spelled).filter(|name| name.starts_with("GPIO"));
            let mut row = Row::new(of_rp.and_then(|name| pad(name)).unwrap_or(pin));
            for (at, cell) in cells.iter().enumerate() {
                let value = self.content(cell);
                let header = heads.get(at).map_or("", String::as_str);
                let port = plain(header) == "port";
                if at == head.pin || port || is_empty(&value) {
                    continue;
                }
                let role = Role::of(header);
                if role == Role::Onboard {
                    row.pin.onboard = Some(onboard(&value));
                    continue;
                }
                if let Some(text) = row.pin.text_mut(role) {
                    *text = Some(value);
                    continue;
                }
                let names =
                    value.split(|c: char| c.is_whitespace() || matches!(c, '/' | ',' | ';'));
                for name in names.take(PIN_USAGES_MAX + 1) {
                    if !is_empty(name) && !matches!(name, "EVENTOUT" | "SIO") {
                        let number = numbers.get(&at).copied();
                        row.usages.extend(self.usage(name, number, cell, log));
                    }
                }
            }
            self.keep(row, &mut rows, &mut usages, log)?;
        }
        self.finish(head, rows, log)
    }

    /// A signal; reports anything odd about it. None if only its number is there.
    fn usage(
        &self,
        name: &str,
        alternate: Option<u8>,
        cell: &Cell,
        log: &mut Log,
    ) -> Option<(String, Option<u8>)> {
        let whole = name;
        let (name, own) = name.split_once('@').map_or((name, None), |(n, own)| (n, Some(own)));
        let bare = name.strip_prefix(ROUTED).unwrap_or(name);
        if is_empty(Blocks::split(bare).0) {
            let what = format!("`{whole}` names no signal and is left out");
            log.dropped(self.span(cell), &self.place(cell), &what);
            return None;
        }
        let own = own.and_then(|own| own.parse().ok()).filter(|own| *own < 16);
        let (_, malformed) = sensedsl_board::signal::Signal::parse(bare);
        if let Some(malformed) = malformed {
            let meant = malformed
                .nearest
                .map_or(String::new(), |meant| format!(", did you mean `{meant}`?"));
            let what = format!("`{name}` looks like a signal and is none{meant}");
            log.doubtful(self.span(cell), &self.place(cell), &what);
        }
        Some((name.to_owned(), own.or(alternate)))
    }

    /// Adds a row; none if there are more usages than a table may have.
    fn keep(&self, row: Row, rows: &mut Vec<Row>, usages: &mut usize, log: &mut Log) -> Option<()> {
        *usages += row.usages.len();
        if *usages > USAGES_MAX {
            log.table_too_large(Span::new(self.file, 0..0), "usages", USAGES_MAX);
            return None;
        }
        rows.push(row);
        Some(())
    }

    fn number(&self, cell: &Cell, log: &mut Log) -> Option<u8> {
        let value = self.content(cell);
        let digits = value.strip_prefix("AF").unwrap_or(&value);
        let digits = digits.strip_suffix(".0").unwrap_or(digits);
        let number = digits.parse().ok().filter(|number| *number < 16);
        if number.is_none() && !is_empty(&value) {
            let what =
                format!("`{value}` is not an alternate function from 0 to 15 and is left out");
            log.dropped(self.span(cell), &self.place(cell), &what);
        }
        number
    }

    fn finish(&self, head: &Head, rows: Vec<Row>, log: &mut Log) -> Option<String> {
        if rows.is_empty() {
            let at = self.rows.get(head.row).and_then(|row| row.get(head.pin));
            let span = at.map_or(Span::new(self.file, 0..0), |cell| self.span(cell));
            log.no_table(span, "no row below the head names a pin");
            return None;
        }
        let properties = table::load(self.text).board.properties;
        let properties: Vec<(&str, String)> =
            properties.iter().map(|one| (one.key.as_str(), one.value.clone())).collect();
        let whole = Span::new(self.file, 0..0);
        Some(assemble::table(&properties, rows, whole, log)?.to_csv())
    }
}

fn is_empty(value: &str) -> bool {
    matches!(value, "" | "-" | "–" | "—")
}

fn onboard(value: &str) -> Onboard {
    let (part, word) = value.rsplit_once(':').unwrap_or((value, "taken"));
    let how = Occupation::WORDS.iter().find(|(name, _)| name.eq_ignore_ascii_case(word.trim()));
    match how {
        Some((_, how)) => Onboard { part: part.trim().into(), how: *how },
        None => Onboard { part: value.into(), how: Occupation::Taken },
    }
}

/// Overwrites a range with a text and spaces after it; line endings stay.
fn blank(text: &mut String, range: Range<usize>, with: &str) {
    let Some(old) = text.get(range.clone()) else { return };
    let mut new = String::with_capacity(old.len());
    let ends = old
        .bytes()
        .skip(with.len())
        .map(|b| if matches!(b, b'\n' | b'\r') { char::from(b) } else { ' ' });
    new.push_str(with);
    new.extend(ends);
    text.replace_range(range, &new);
}
