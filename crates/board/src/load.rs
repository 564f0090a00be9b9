//! Reading a board table: cells in, pins and findings out.
//!
//! Every mistake costs as little as possible: a cell, a row or a column is left out and the rest is
//! read, so that one run reports all mistakes.

mod places;
mod usages;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use sensedsl_diagnostics::nearest;
use sensedsl_limits::{COLUMNS_MAX, DIAGNOSTICS_MAX, PINS_MAX, TABLE_PROPERTIES_MAX, USAGES_MAX};

use crate::cells::{self, Cell, Sheet, is_zero_width};
use crate::finding::{Finding, FindingKind};
use crate::form::{self, Form};
use crate::landmark::{self, LandmarkKind};
use crate::mcu;
use crate::pin::PinName;
use crate::place::Place;
use crate::table::{Column, Loaded, Pin, Property, Role, Table};

/// Implements [`crate::table::load`].
pub(crate) fn load(text: &str) -> Loaded {
    let mut loader = Loader::new(text);
    let sheet = cells::split(text);
    if let Some(cut) = sheet.cut {
        loader.too_large(cut.what, cut.most, &(cut.at..cut.at));
    }
    for range in &sheet.bad_quotes {
        loader.report(FindingKind::BadQuote, range, None);
    }
    let mut board = Table::default();
    loader.properties(&sheet, &mut board);
    loader.rows(&sheet, &mut board);
    let findings = loader.finish();
    Loaded { board, findings }
}

/// Where each line starts.
fn line_starts(text: &str) -> Vec<usize> {
    let bytes = text.as_bytes();
    let ends_line = |at: &usize| match (bytes.get(*at), bytes.get(at + 1)) {
        (Some(b'\n'), _) => true,
        (Some(b'\r'), next) => next != Some(&b'\n'),
        _ => false,
    };
    let starts = (0..bytes.len()).filter(ends_line).map(|at| at + 1);
    std::iter::once(0).chain(starts).collect()
}

/// A column of the sheet; `None` if its cells are not read.
type Slot = Option<Column>;

/// The usages of a row by the name of their signal, with index and place.
type Known = BTreeMap<String, (usize, Range<usize>)>;

struct Loader<'a> {
    text: &'a str,
    lines: Vec<usize>,
    findings: Vec<Finding>,
    /// The number of findings that are not listed.
    more: usize,
    /// How many more usages may be read.
    usages_left: usize,
    /// The shape of the board, if the table names it.
    form: Option<&'static Form>,
    /// What each contact of a connector carries, and whether that is a pin.
    carried: BTreeMap<String, (String, bool)>,
}

/// A piece of a cell, between white space.
struct Word {
    text: String,
    range: Range<usize>,
}

impl Word {
    fn is_filled(&self) -> bool {
        !cells::says_nothing(&self.text)
    }
}

impl<'a> Loader<'a> {
    fn new(text: &'a str) -> Self {
        let (lines, findings) = (line_starts(text), Vec::new());
        Self {
            text,
            lines,
            findings,
            more: 0,
            usages_left: USAGES_MAX,
            form: None,
            carried: BTreeMap::new(),
        }
    }

    /// The findings, in text order.
    fn finish(mut self) -> Vec<Finding> {
        self.findings.sort_by_key(|finding| finding.range.start);
        if self.more > 0 {
            let (listed, more, end) = (self.findings.len(), self.more, self.text.len());
            self.add(FindingKind::More { listed, more }, &(end..end), None);
        }
        self.findings
    }

    /// Reports once that there is more of something than is read.
    fn too_large(&mut self, what: &'static str, most: usize, range: &Range<usize>) {
        let kind = FindingKind::TooLarge { what, most };
        if self.findings.iter().all(|one| one.kind != kind) {
            self.add(kind, range, None);
        }
    }

    fn report(&mut self, kind: FindingKind, range: &Range<usize>, column: Option<&str>) {
        if self.findings.len() < DIAGNOSTICS_MAX {
            self.add(kind, range, column);
        } else {
            self.more += 1;
        }
    }

    fn add(&mut self, kind: FindingKind, range: &Range<usize>, column: Option<&str>) {
        self.findings.push(Finding {
            kind,
            range: range.clone(),
            row: self.line_of(range.start),
            column: column.map(str::to_owned),
        });
    }

    fn line_of(&self, at: usize) -> usize {
        self.lines.partition_point(|start| *start <= at)
    }

    fn raw(&self, range: &Range<usize>) -> &str {
        self.text.get(range.clone()).unwrap_or_default()
    }

    /// The content of a cell without invisible characters, and its place.
    fn content(&self, cell: &Cell) -> Word {
        let raw = self.raw(&cell.range);
        let blank = |c: char| c.is_whitespace() || is_zero_width(c);
        let start = cell.range.start + (raw.len() - raw.trim_start_matches(blank).len());
        let end = cell.range.end - (raw.len() - raw.trim_end_matches(blank).len());
        // A cell of only blanks has nothing to point at.
        let range = if start < end { start..end } else { cell.range.clone() };
        Word { text: cells::content(raw, cell.quoted), range }
    }

    /// The content, or nothing for an empty cell or a dash.
    fn value(&self, cell: &Cell) -> Option<Word> {
        Some(self.content(cell)).filter(Word::is_filled)
    }

    fn text(&self, cell: &Cell) -> Option<String> {
        self.value(cell).map(|word| word.text)
    }

    /// The pieces of a cell, separated by white space.
    fn words(&self, cell: &Cell) -> Vec<Word> {
        let raw = self.raw(&cell.range);
        let mut words = Vec::new();
        let mut rest = raw.get(cells::guard_bytes(raw, cell.quoted)..).unwrap_or_default();
        while let Some(at) = rest.find(|c: char| !c.is_whitespace() && !is_zero_width(c)) {
            let tail = rest.get(at..).unwrap_or_default();
            let end = tail.find(char::is_whitespace).unwrap_or(tail.len());
            let start = cell.range.start + (raw.len() - tail.len());
            let text = cells::inner(tail.get(..end).unwrap_or_default(), cell.quoted);
            let word = Word { text, range: start..start + end };
            words.extend(Some(word).filter(Word::is_filled));
            rest = tail.get(end..).unwrap_or_default();
        }
        words
    }

    /// Reports the first invisible character in a cell that is read.
    fn invisible(&mut self, cell: &Cell, column: &str) {
        let raw = self.raw(&cell.range);
        let odd = |c: &char| is_zero_width(*c) || (c.is_whitespace() && !c.is_ascii());
        if let Some((at, character)) = raw.char_indices().find(|(_, c)| odd(c)) {
            let start = cell.range.start + at;
            let range = start..start + character.len_utf8();
            self.report(FindingKind::InvisibleCharacter { character }, &range, Some(column));
        }
    }

    /// Reads the `# key = value` lines above the header.
    fn properties(&mut self, sheet: &Sheet, board: &mut Table) {
        let header = sheet.rows.first().and_then(|row| row.first());
        let end = header.map_or(self.text.len(), |cell| cell.range.start);
        let mut known = BTreeSet::new();
        for comment in sheet.comments.iter().filter(|comment| comment.start < end) {
            let Some(property) = property(self.raw(comment), comment.start) else { continue };
            if !known.insert(property.key.clone()) {
                let key = property.key;
                self.report(FindingKind::DuplicateProperty { key }, &property.range, None);
                continue;
            }
            match property.key.as_str() {
                "mcu" => {
                    self.mcu(&property);
                    board.mcu = Some(property.value.clone());
                }
                "form" => self.form(&property),
                key => self.landmarks(key, &property),
            }
            if board.properties.len() == TABLE_PROPERTIES_MAX {
                return self.too_large("lines `# key = value`", TABLE_PROPERTIES_MAX, comment);
            }
            board.properties.push(property);
        }
    }

    fn form(&mut self, property: &Property) {
        self.form = form::find(&property.value);
        if self.form.is_none() {
            let nearest = form::nearest_name(&property.value).map(str::to_owned);
            let spelled = property.value.clone();
            self.report(FindingKind::UnknownForm { spelled, nearest }, &property.range, None);
        }
    }

    /// Reports the first button or LED that cannot be read.
    fn landmarks(&mut self, key: &str, property: &Property) {
        let Some(kind) = LandmarkKind::of_property(key) else { return };
        if let Err(entry) = landmark::parse(kind, &property.value) {
            let spelled = entry.to_owned();
            self.report(FindingKind::BadLandmark { kind, spelled }, &property.range, None);
        }
    }

    fn mcu(&mut self, property: &Property) {
        if !mcu::is_plausible(&property.value) {
            let known = crate::catalog::mcus();
            let nearest = nearest(&property.value, known).map(str::to_owned);
            let spelled = property.value.clone();
            self.report(FindingKind::UnknownMcu { spelled, nearest }, &property.range, None);
        }
    }

    /// Reads the header and the pins.
    fn rows(&mut self, sheet: &Sheet, board: &mut Table) {
        let end = self.text.len()..self.text.len();
        let Some((header, rows)) = sheet.rows.split_first() else {
            return self.report(FindingKind::EmptyTable, &end, None);
        };
        let slots = self.header(header, rows);
        board.columns = slots.iter().flatten().cloned().collect();
        let line = header_range(header);
        if !board.columns.iter().any(|column| column.role == Role::Pin) {
            let headers = board.columns.iter().map(|column| column.header.as_str());
            let nearest = headers
                .filter(|header| nearest(header, ["Pin", "Pins", "Pin name"]).is_some())
                .map(str::to_owned)
                .next();
            return self.report(FindingKind::NoPinColumn { nearest }, &line, None);
        }
        let mut pins: BTreeMap<PinName, Pin> = BTreeMap::new();
        let mut blank = true;
        for row in rows {
            if !row.iter().any(|cell| self.is_filled(cell)) {
                continue;
            }
            blank = false;
            if let Some(contacts) = self.contacts(row, &slots) {
                board.contacts.extend(contacts);
                continue;
            }
            let Some(pin) = self.row(row, &slots) else { continue };
            if pins.len() == PINS_MAX && !pins.contains_key(&pin.name) {
                self.too_large("pins", PINS_MAX, &pin.range);
                break;
            }
            if let Some(first) = pins.get(&pin.name) {
                let kind = FindingKind::DuplicatePin { pin: pin.name, first: first.range.clone() };
                self.report(kind, &pin.range, Some("Pin"));
            } else {
                pins.insert(pin.name.clone(), pin);
            }
        }
        if blank {
            self.report(FindingKind::EmptyTable, &line, None);
        }
        board.pins = pins.into_values().collect();
    }

    fn is_filled(&self, cell: &Cell) -> bool {
        !self.content(cell).text.is_empty()
    }

    /// Assigns the columns.
    fn header(&mut self, header: &[Cell], rows: &[Vec<Cell>]) -> Vec<Slot> {
        let mut slots: Vec<Slot> = Vec::new();
        let mut known: BTreeMap<String, Range<usize>> = BTreeMap::new();
        let filled = self.filled_columns(rows);
        for (index, cell) in header.iter().enumerate() {
            let Word { text, range } = self.content(cell);
            if index == COLUMNS_MAX {
                self.too_large("columns", COLUMNS_MAX, &range);
                break;
            }
            if text.is_empty() {
                if filled.get(index) == Some(&true) {
                    self.report(FindingKind::UnnamedColumn, &range, None);
                }
                slots.push(None);
                continue;
            }
            self.invisible(cell, &text);
            let folded = text.to_ascii_lowercase();
            if let Some(first) = known.get(&folded).cloned() {
                let kind = FindingKind::DuplicateColumn { header: text.clone(), first };
                self.report(kind, &range, Some(&text));
                slots.push(None);
                continue;
            }
            known.insert(folded, range.clone());
            let role = Role::of(&text);
            slots.push(Some(Column { header: text, role, range }));
        }
        slots
    }

    /// For each column, whether any row has something in it.
    fn filled_columns(&self, rows: &[Vec<Cell>]) -> Vec<bool> {
        let mut filled = vec![false; COLUMNS_MAX];
        for row in rows {
            for (filled, cell) in filled.iter_mut().zip(row) {
                *filled = *filled || self.is_filled(cell);
            }
        }
        filled
    }

    /// Reads one row; `None` if it names no pin.
    fn row(&mut self, row: &[Cell], slots: &[Slot]) -> Option<Pin> {
        let beyond = row.get(slots.len()..).unwrap_or_default();
        if row.len() < slots.len() || beyond.iter().any(|cell| self.is_filled(cell)) {
            let kind = FindingKind::RaggedRow { expected: slots.len(), found: row.len() };
            self.report(kind, &header_range(row), None);
        }
        let mut pin = self.pin(row, slots)?;
        let (mut alternates, mut described) = (None, Place::default());
        let mut known = Known::new();
        for (cell, column) in row.iter().zip(slots) {
            let Some(column) = column else { continue };
            self.invisible(cell, &column.header);
            match column.role {
                Role::Usages => self.usages(cell, column, &mut pin, &mut known),
                Role::Onboard => pin.onboard = self.onboard(cell, column),
                Role::Alternate => alternates = Some((cell, column)),
                Role::Label => pin.label = self.text(cell),
                Role::Voltage => pin.voltage = self.text(cell),
                Role::Note => pin.note = self.text(cell),
                Role::Position => described.position = self.text(cell),
                Role::Side => described.side = self.text(cell),
                Role::Header => described.header = self.text(cell),
                Role::Places => {
                    pin.places = self.places(cell, column, (pin.name.as_str(), true));
                }
                Role::Pin => {}
            }
        }
        if described != Place::default() {
            pin.places.insert(0, described);
        }
        for place in &mut pin.places {
            if let Some(form) = self.form {
                place.look_up(form);
            }
        }
        if let Some((cell, column)) = alternates {
            self.alternates(cell, column, &mut pin, &known);
        }
        Some(pin)
    }

    /// Reads the pin cell of a row.
    fn pin(&mut self, row: &[Cell], slots: &[Slot]) -> Option<Pin> {
        let at = |slot: &Slot| slot.as_ref().is_some_and(|column| column.role == Role::Pin);
        let index = slots.iter().position(at)?;
        let cell = row.get(index).and_then(|cell| self.value(cell));
        let Some(Word { text, range }) = cell else {
            self.report(FindingKind::MissingPin, &header_range(row), Some("Pin"));
            return None;
        };
        let Some(name) = PinName::parse(&text) else {
            self.report(FindingKind::BadPinName { spelled: text }, &range, Some("Pin"));
            return None;
        };
        Some(Pin { row: self.line_of(range.start), range, ..Pin::new(name, text) })
    }
}

/// The range from the first cell to the last.
fn header_range(row: &[Cell]) -> Range<usize> {
    let start = row.first().map_or(0, |cell| cell.range.start);
    start..row.last().map_or(start, |cell| cell.range.end)
}

/// Reads ` key = value`; any other comment is only a comment.
fn property(comment: &str, start: usize) -> Option<Property> {
    let (key, value) = comment.split_once('=')?;
    let key = key.trim();
    let word = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    if key.is_empty() || !key.chars().all(word) {
        return None;
    }
    let start = start + (comment.len() - cells::bare_start(value).len());
    let value = cells::bare(value).to_owned();
    Some(Property { key: key.to_ascii_lowercase(), range: start..start + value.len(), value })
}
