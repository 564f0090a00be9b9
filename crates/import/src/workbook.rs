//! A workbook in, a board table out.
//!
//! The sheet with the pins becomes a text of comma-separated cells, with a line for each row, which
//! is then read like any other table. Anything that only a spreadsheet has (formulas, merged cells,
//! dates, other sheets) is reported here, each at its cell.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Cursor;
use std::ops::Range;

use calamine::{Data, Dimensions, Reader as _, Xlsx, open_workbook_from_rs};
use sensedsl_board::table::Role;
use sensedsl_diagnostics::Span;
use sensedsl_limits::{CELL_TEXT_BYTES_MAX, CELLS_MAX, INFLATED_BYTES_MAX, MERGED_MAX, SHEETS_MAX};

use crate::detect::detect;
use crate::format::Format;
use crate::log::Log;
use crate::package::{self, Contents, Refused};
use crate::place::a1;
use crate::source::{Source, Texts};
use crate::{ods, tabular};

/// Sheets of pins are far smaller; cells beyond these limits are strays.
const ROWS_MAX: u32 = 20_000;
const SHEET_COLUMNS_MAX: u32 = 512;

/// How many times `INFLATED_BYTES_MAX` all sheets together may have, if several name the same file.
const SHARED: usize = 4;

/// A cell by row and column, from 0.
type At = (u32, u32);

/// The contents of a sheet.
#[derive(Debug, Default)]
pub(crate) struct Sheet {
    name: String,
    cells: BTreeMap<At, Data>,
    formulas: BTreeMap<At, String>,
    merged: Vec<Dimensions>,
    /// A cell that is beyond the limits.
    beyond: Option<At>,
    /// Bytes of texts and formulas.
    bytes: usize,
}

/// Imports the sheet that has a pin table.
pub(crate) fn import(source: &Source<'_>, log: &mut Log) -> Texts {
    let is_ods = match source.format {
        Some(Format::Ods) => true,
        Some(Format::Xlsx) => false,
        _ => detect(source.bytes) == Some(Format::Ods),
    };
    let read = package::check(source.bytes).and_then(|contents| {
        if is_ods { ods::sheets(source.bytes) } else { xlsx(source.bytes, &contents) }
    });
    let read = read.and_then(|sheets| {
        let texts = sheets.iter().map(Text::new).collect::<Result<Vec<_>, _>>()?;
        Ok((sheets, texts))
    });
    let (sheets, texts) = match read {
        Ok(read) => read,
        Err(refused) => {
            let file = log.sources.add(source.name, "");
            log.not_read(Span::new(file, 0..0), source.name, &refused);
            return Texts::default();
        }
    };
    let names: Vec<String> = sheets.iter().map(|sheet| sheet.name.clone()).collect();
    let chosen = match source.sheet {
        Some(wanted) => names.iter().position(|name| name == wanted),
        None => texts.iter().position(|text| tabular::has_head(&text.text)),
    };
    let Some(chosen) = chosen else {
        let file = log.sources.add(source.name, "");
        let span = Span::new(file, 0..0);
        match source.sheet {
            Some(wanted) => log.no_sheet(span, wanted, &names),
            None => log.no_table(span, "no sheet has a row with a column `Pin`"),
        }
        return Texts::default();
    };
    for (at, (sheet, text)) in sheets.iter().zip(&texts).enumerate() {
        if at != chosen && !sheet.cells.is_empty() {
            stray(source, sheet, text, log);
        }
    }
    match (sheets.get(chosen), texts.get(chosen)) {
        (Some(sheet), Some(text)) => table(source, sheet, text, log),
        _ => Texts::default(),
    }
}

/// Reports an ignored sheet, at its first cell.
fn stray(source: &Source<'_>, sheet: &Sheet, text: &Text, log: &mut Log) {
    let file = log.sources.add(format!("{} [{}]", source.name, sheet.name), text.text.as_str());
    let Some(at) = sheet.cells.keys().next() else { return };
    let (span, place) = (Span::new(file, text.range(*at)), place(sheet, *at));
    if tabular::has_head(&text.text) {
        let what = "the sheet has a pin table too and is not read; name it with `--sheet`";
        log.doubtful(span, &place, what);
    } else {
        log.dropped(span, &place, "the sheet has no pin table and is not read");
    }
}

/// Reads the chosen sheet.
fn table(source: &Source<'_>, sheet: &Sheet, text: &Text, log: &mut Log) -> Texts {
    let file = log.sources.add(format!("{} [{}]", source.name, sheet.name), text.text.as_str());
    let span = |at: At| Span::new(file, text.range(at));
    for (at, formula) in &sheet.formulas {
        let value = sheet.cells.get(at).map(shown).unwrap_or_default();
        let formula = formula.trim_start_matches("of:").trim_start_matches('=');
        let what = match value.as_str() {
            "" => format!("the formula `={formula}` has no value that was stored"),
            value => format!("the formula `={formula}` is read as its last value, `{value}`"),
        };
        log.doubtful(span(*at), &place(sheet, *at), &what);
    }
    for merged in &sheet.merged {
        let last = a1(merged.end.0 as usize, merged.end.1 as usize);
        let what = format!("the cell is merged up to {last}; its value counts for this cell alone");
        log.doubtful(span(merged.start), &place(sheet, merged.start), &what);
    }
    if let Some(at) = sheet.beyond {
        let what =
            format!("cells beyond row {ROWS_MAX} or column {SHEET_COLUMNS_MAX} are left out");
        log.dropped(Span::new(file, 0..0), &place(sheet, at), &what);
    }
    let heads = heads(sheet);
    for (at, value) in &sheet.cells {
        values(sheet, (*at, value), &heads, span(*at), log);
    }
    empty_rows(sheet, &span, log);
    tabular::import(file, &text.text, Some(&sheet.name), log)
}

/// The texts of the first row with several texts, by column: enough to distinguish descriptions
/// from usages.
fn heads(sheet: &Sheet) -> BTreeMap<u32, String> {
    let mut rows: BTreeMap<u32, BTreeMap<u32, String>> = BTreeMap::new();
    for ((row, column), value) in &sheet.cells {
        if let Data::String(text) = value {
            rows.entry(*row).or_default().insert(*column, text.clone());
        }
    }
    rows.into_values().find(|row| row.len() >= 2).unwrap_or_default()
}

/// Reports a value that is not a text where a text is expected.
fn values(
    sheet: &Sheet,
    (at, value): (At, &Data),
    heads: &BTreeMap<u32, String>,
    span: Span,
    log: &mut Log,
) {
    let role = heads.get(&at.1).map_or(Role::Usages, |head| Role::of(head));
    let place = place(sheet, at);
    match value {
        Data::DateTime(_) | Data::DateTimeIso(_) | Data::DurationIso(_) => {
            let what =
                "a date or time is left out; what was typed is lost, format the cell as text";
            log.dropped(span, &place, what);
        }
        Data::Bool(value) => {
            log.dropped(span, &place, &format!("the truth value {value} is left out"));
        }
        Data::Error(error) => {
            log.dropped(span, &place, &format!("the error value {error} is left out"));
        }
        Data::Int(_) | Data::Float(_) if matches!(role, Role::Usages | Role::Pin) => {
            let what = format!("the number {} is where a name is expected", shown(value));
            log.doubtful(span, &place, &what);
        }
        Data::Int(_) | Data::Float(_) | Data::String(_) | Data::Empty => {}
    }
}

/// Reports empty rows between rows with content.
fn empty_rows(sheet: &Sheet, span: &dyn Fn(At) -> Span, log: &mut Log) {
    let mut rows: Vec<u32> = sheet.cells.keys().map(|(row, _)| *row).collect();
    rows.dedup();
    for pair in rows.windows(2) {
        let (Some(before), Some(after)) = (pair.first(), pair.last()) else { continue };
        if before + 1 < *after {
            let first = (before + 1, 0);
            let what = match after - before - 1 {
                1 => "an empty row in the table is skipped".to_owned(),
                count => format!("{count} empty rows in the table are skipped"),
            };
            log.dropped(span(first), &place(sheet, first), &what);
        }
    }
}

fn place(sheet: &Sheet, (row, column): At) -> String {
    format!("{}!{}", sheet.name, a1(row as usize, column as usize))
}

/// A value as the cell of a table; empty if it cannot be one.
fn shown(value: &Data) -> String {
    match value {
        Data::Int(number) => number.to_string(),
        // Spreadsheets do not have integers: 23.0 is 23, which is how `{}` shows it.
        Data::Float(number) => number.to_string(),
        Data::String(text) => text.split_whitespace().collect::<Vec<_>>().join(" "),
        Data::Bool(_)
        | Data::DateTime(_)
        | Data::DateTimeIso(_)
        | Data::DurationIso(_)
        | Data::Error(_)
        | Data::Empty => String::new(),
    }
}

/// A sheet as text.
struct Text {
    text: String,
    ranges: BTreeMap<At, Range<usize>>,
    /// Where each row starts.
    rows: Vec<usize>,
}

impl Text {
    fn new(sheet: &Sheet) -> Result<Self, Refused> {
        let mut made = Self { text: String::new(), ranges: BTreeMap::new(), rows: Vec::new() };
        let rows = sheet.cells.keys().map(|(row, _)| row + 1).max().unwrap_or_default();
        let columns = sheet.cells.keys().map(|(_, column)| column + 1).max().unwrap_or_default();
        let filled: BTreeSet<u32> = sheet.cells.keys().map(|(row, _)| *row).collect();
        // A row has as many cells as the widest one.
        if filled.len().saturating_mul(columns as usize) > CELLS_MAX {
            return Err(Refused::TooMuch("cells in a sheet, rows times columns", CELLS_MAX));
        }
        for row in 0..rows {
            made.rows.push(made.text.len());
            for column in 0..if filled.contains(&row) { columns } else { 0 } {
                if column > 0 {
                    made.text.push(',');
                }
                let value = sheet.cells.get(&(row, column)).map(shown).unwrap_or_default();
                let start = made.text.len();
                // Anything that is not plain is quoted, because the separator is guessed from the
                // header row.
                if value.contains([',', '"', ';', '\t']) {
                    made.text.push_str(&format!("\"{}\"", value.replace('"', "\"\"")));
                } else {
                    made.text.push_str(&value);
                }
                made.ranges.insert((row, column), start..made.text.len());
            }
            made.text.push('\n');
        }
        Ok(made)
    }

    /// The range of a cell; the start of its row if it is outside all cells.
    fn range(&self, at: At) -> Range<usize> {
        let row = || {
            let start = self.rows.get(at.0 as usize).copied().unwrap_or(self.text.len());
            start..start
        };
        self.ranges.get(&at).cloned().unwrap_or_else(row)
    }
}

impl Sheet {
    pub(crate) fn new(name: String) -> Self {
        Self { name, ..Self::default() }
    }

    /// Puts a value into a cell; returns false if the cell is beyond the limits.
    pub(crate) fn put(&mut self, at: At, value: Data) -> Result<bool, Refused> {
        if value == Data::Empty || matches!(&value, Data::String(text) if text.trim().is_empty()) {
            return Ok(!is_beyond(at));
        }
        if is_beyond(at) {
            self.beyond.get_or_insert(at);
            return Ok(false);
        }
        if let Data::String(text) = &value {
            self.spend(text.len())?;
        }
        self.cells.insert(at, value);
        if self.cells.len() > CELLS_MAX {
            return Err(Refused::TooMuch("cells in a sheet", CELLS_MAX));
        }
        Ok(true)
    }

    pub(crate) fn put_formula(&mut self, at: At, formula: &str) -> Result<(), Refused> {
        if !formula.is_empty() && !is_beyond(at) {
            self.spend(formula.len())?;
            self.formulas.insert(at, formula.to_owned());
        }
        Ok(())
    }

    pub(crate) fn put_merged(&mut self, range: Dimensions) -> Result<(), Refused> {
        if self.merged.len() == MERGED_MAX {
            return Err(Refused::TooMuch("merged ranges in a sheet", MERGED_MAX));
        }
        self.merged.push(range);
        Ok(())
    }

    /// Whether a row is beyond the limits.
    pub(crate) fn is_beyond_rows(&self, row: u32) -> bool {
        is_beyond((row, 0))
    }

    /// Counts bytes of text: a text that is in the file once can be in any number of cells.
    fn spend(&mut self, bytes: usize) -> Result<(), Refused> {
        self.bytes += bytes;
        if self.bytes > CELL_TEXT_BYTES_MAX {
            let what = "bytes of text in the cells of a sheet";
            return Err(Refused::TooMuch(what, CELL_TEXT_BYTES_MAX));
        }
        Ok(())
    }
}

fn is_beyond((row, column): At) -> bool {
    row >= ROWS_MAX || column >= SHEET_COLUMNS_MAX
}

fn xlsx(bytes: &[u8], contents: &Contents) -> Result<Vec<Sheet>, Refused> {
    let book: Result<Xlsx<_>, _> = open_workbook_from_rs(Cursor::new(bytes));
    let mut book = book.map_err(|error| Refused::why(&error))?;
    let mut sheets = Vec::new();
    // Several sheets may name the same file, so their contents are counted together.
    let (mut cells_left, mut bytes_left) = (CELLS_MAX, CELL_TEXT_BYTES_MAX);
    let names = book.sheet_names();
    if names.len() > SHEETS_MAX {
        return Err(Refused::TooMuch("sheets", SHEETS_MAX));
    }
    // Each sheet has its own file, unless the workbook was crafted to be read many times.
    if names.len() > contents.files {
        return Err(Refused::TooMuch(
            "sheets, and no more files that could hold them",
            contents.files,
        ));
    }
    if names.len().saturating_mul(contents.largest) > SHARED * INFLATED_BYTES_MAX {
        return Err(Refused::TooMuch("bytes in all its sheets", SHARED * INFLATED_BYTES_MAX));
    }
    for name in names {
        let mut sheet = Sheet::new(name.clone());
        // A sheet of another type, such as a chart, has no cells.
        let Ok(mut cells) = book.worksheet_cells_reader(&name) else { continue };
        while let Some(cell) =
            cells.next_cell_with_formula().map_err(|error| Refused::why(&error))?
        {
            sheet.put(cell.pos, Data::from(cell.value))?;
            sheet.put_formula(cell.pos, &cell.formula.unwrap_or_default())?;
            if sheet.cells.len() > cells_left {
                return Err(Refused::TooMuch("cells in all sheets", CELLS_MAX));
            }
            if sheet.bytes > bytes_left {
                let what = "bytes of text in the cells of all sheets";
                return Err(Refused::TooMuch(what, CELL_TEXT_BYTES_MAX));
            }
        }
        drop(cells);
        (cells_left, bytes_left) = (cells_left - sheet.cells.len(), bytes_left - sheet.bytes);
        let merged = book.merge_cells_by_sheet_name(&name);
        for range in merged.map_err(|error| Refused::why(&error))? {
            sheet.put_merged(range)?;
        }
        sheets.push(sheet);
    }
    Ok(sheets)
}
