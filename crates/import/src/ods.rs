//! A workbook of LibreOffice in, its sheets out, read as a stream. Empty cells are not kept, and
//! rows and cells marked as repeated are repeated only as far as the budgets allow.

use std::io::{BufReader, Cursor};

use calamine::{Data, Dimensions};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use crate::package::Refused;
use crate::workbook::Sheet;

/// Reads the sheets of a workbook that [`crate::package::check`] has accepted.
pub(crate) fn sheets(bytes: &[u8]) -> Result<Vec<Sheet>, Refused> {
    let mut archive =
        zip::ZipArchive::new(Cursor::new(bytes)).map_err(|error| Refused::why(&error))?;
    let content = archive.by_name("content.xml").map_err(|error| Refused::why(&error))?;
    let mut reader = Reader::from_reader(BufReader::new(content));
    let mut made = Maker::default();
    let mut buffer = Vec::new();
    loop {
        buffer.clear();
        match reader.read_event_into(&mut buffer).map_err(|error| Refused::why(&error))? {
            Event::Start(tag) => made.start(&tag)?,
            Event::Empty(tag) => {
                made.start(&tag)?;
                made.end(tag.name().0)?;
            }
            Event::End(tag) => made.end(tag.name().0)?,
            Event::Text(text) => made.text(&text.xml10_content()),
            Event::CData(text) => made.text(&text.xml10_content()),
            Event::GeneralRef(name) => {
                let known = quick_xml::escape::resolve_predefined_entity(&name);
                let character = name.resolve_char_ref().map_err(|error| Refused::why(&error))?;
                made.text(known.unwrap_or_default());
                made.text(&character.map(String::from).unwrap_or_default());
            }
            Event::Eof => return Ok(made.sheets),
            Event::Comment(_) | Event::Decl(_) | Event::PI(_) | Event::DocType(_) => {}
        }
    }
}

/// A cell that is being read.
#[derive(Debug, Default)]
struct Cell {
    value: Data,
    formula: String,
    /// How many times the cell is repeated.
    repeated: u32,
    /// The number of columns and rows that it covers.
    spanned: (u32, u32),
    /// True if its text is its value.
    is_text: bool,
    text: String,
    paragraphs: usize,
}

/// The result so far.
#[derive(Debug, Default)]
struct Maker {
    sheets: Vec<Sheet>,
    /// The nesting depth of tables; those in cells are not read.
    depth: usize,
    row: u32,
    row_repeated: u32,
    column: u32,
    /// The row's cells that are not empty, with their columns.
    cells: Vec<(u32, Cell)>,
    cell: Option<Cell>,
    /// The nesting depth of remarks, which are not content.
    remarks: usize,
}

/// The number in an attribute; 1 if there is none.
fn count(tag: &BytesStart<'_>, name: &str) -> u32 {
    let value = attribute(tag, name).and_then(|value| value.parse().ok());
    value.unwrap_or(1).max(1)
}

fn attribute(tag: &BytesStart<'_>, name: &str) -> Option<String> {
    let mut attributes = tag.attributes();
    let found = attributes.with_checks(false).flatten().find(|one| one.key.0 == name)?;
    Some(quick_xml::escape::unescape(&found.value).ok()?.into_owned())
}

impl Maker {
    fn start(&mut self, tag: &BytesStart<'_>) -> Result<(), Refused> {
        match tag.name().0 {
            "table:table" => {
                self.depth += 1;
                if self.depth == 1 {
                    let name = attribute(tag, "table:name").unwrap_or_default();
                    self.sheets.push(Sheet::new(name));
                    self.row = 0;
                }
            }
            _ if self.depth != 1 => {}
            "table:table-row" => {
                self.row_repeated = count(tag, "table:number-rows-repeated");
                self.column = 0;
                self.cells.clear();
            }
            "table:table-cell" | "table:covered-table-cell" => self.cell = Some(cell(tag)),
            "office:annotation" => self.remarks += 1,
            "text:p" => {
                if let Some(cell) = self.cell.as_mut().filter(|_| self.remarks == 0) {
                    cell.paragraphs += 1;
                    if cell.paragraphs > 1 {
                        cell.text.push('\n');
                    }
                }
            }
            "text:s" => self.text(" "),
            "text:tab" => self.text("\t"),
            "text:line-break" => self.text("\n"),
            _ => {}
        }
        Ok(())
    }

    fn text(&mut self, text: &str) {
        let inside = self.depth == 1 && self.remarks == 0;
        if let Some(cell) = self.cell.as_mut().filter(|cell| inside && cell.paragraphs > 0) {
            cell.text.push_str(text);
        }
    }

    fn end(&mut self, name: &str) -> Result<(), Refused> {
        match name {
            "table:table" => self.depth = self.depth.saturating_sub(1),
            _ if self.depth != 1 => {}
            "office:annotation" => self.remarks = self.remarks.saturating_sub(1),
            "table:table-cell" | "table:covered-table-cell" => self.end_cell()?,
            "table:table-row" => self.end_row()?,
            _ => {}
        }
        Ok(())
    }

    fn end_cell(&mut self) -> Result<(), Refused> {
        let Some(mut cell) = self.cell.take() else { return Ok(()) };
        if cell.is_text {
            cell.value = Data::String(std::mem::take(&mut cell.text));
        }
        let (column, repeated) = (self.column, cell.repeated);
        self.column = column.saturating_add(repeated);
        let (wide, high) = cell.spanned;
        if wide > 1 || high > 1 {
            let start = (self.row, column);
            let end = (self.row.saturating_add(high - 1), column.saturating_add(wide - 1));
            if let Some(sheet) = self.sheets.last_mut() {
                sheet.put_merged(Dimensions { start, end })?;
            }
        }
        if cell.value != Data::Empty || !cell.formula.is_empty() {
            self.cells.push((column, cell));
        }
        Ok(())
    }

    /// Adds the cells of a row to the sheet, as often as they and the row are repeated.
    fn end_row(&mut self) -> Result<(), Refused> {
        let first = self.row;
        self.row = first.saturating_add(self.row_repeated);
        let Some(sheet) = self.sheets.last_mut() else { return Ok(()) };
        for row in first..self.row {
            for (column, cell) in &self.cells {
                for column in *column..column.saturating_add(cell.repeated) {
                    let inside = sheet.put((row, column), cell.value.clone())?;
                    sheet.put_formula((row, column), &cell.formula)?;
                    if !inside {
                        break;
                    }
                }
            }
            if self.cells.is_empty() || sheet.is_beyond_rows(row) {
                break;
            }
        }
        Ok(())
    }
}

/// A cell, from its attributes.
fn cell(tag: &BytesStart<'_>) -> Cell {
    let spans = |name: &str| count(tag, name);
    let formula = attribute(tag, "table:formula").unwrap_or_default();
    let text = |name: &str| attribute(tag, name);
    let number = || text("office:value")?.parse().ok().map(Data::Float);
    let truth = || {
        let value = text("office:boolean-value")?;
        Some(Data::Bool(value.eq_ignore_ascii_case("true")))
    };
    let value = number()
        .or_else(|| text("office:string-value").map(Data::String))
        .or_else(|| text("office:date-value").map(Data::DateTimeIso))
        .or_else(|| text("office:time-value").map(Data::DurationIso))
        .or_else(truth);
    let is_string = text("office:value-type").as_deref() == Some("string");
    let is_error = text("calcext:value-type").as_deref() == Some("error");
    let empty = matches!(&value, Some(Data::String(text)) if text.is_empty());
    Cell {
        is_text: (value.is_none() && is_string) || (is_error && empty),
        value: value.unwrap_or(Data::Empty),
        formula,
        repeated: spans("table:number-columns-repeated"),
        spanned: (spans("table:number-columns-spanned"), spans("table:number-rows-spanned")),
        ..Cell::default()
    }
}
