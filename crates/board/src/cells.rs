//! Comma-separated text in, cells with their places out.
//!
//! The common CSV crates return texts without byte ranges, but a diagnostic must point at a cell.
//! So this reads the dialect of RFC 4180, plus what spreadsheets in all countries write: `,`, `;`
//! or tab between cells, any line ending, a byte order mark, Excel's `sep=` line. `#` starts a
//! comment line.

use std::ops::Range;

use sensedsl_diagnostics::is_hidden;
use sensedsl_limits::{CELLS_MAX, ROWS_MAX};

/// A text, split into cells.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Sheet {
    /// Comment lines without their `#`, in order.
    pub comments: Vec<Range<usize>>,
    /// All other lines that are not blank, in order.
    pub rows: Vec<Vec<Cell>>,
    /// Unterminated quotes, and text after a closing quote.
    pub bad_quotes: Vec<Range<usize>>,
    /// Why reading stopped before the end of the text.
    pub cut: Option<Cut>,
}

/// Reports that there is more of something than is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cut {
    /// Where reading stopped.
    pub at: usize,
    /// The name of the limit that was reached.
    pub what: &'static str,
    /// The value of that limit.
    pub most: usize,
}

/// One cell: the bytes between its separators, or between its quotes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// The range of its content.
    pub range: Range<usize>,
    /// True if `""` stands for one quote.
    pub quoted: bool,
}

/// Splits a text, up to [`ROWS_MAX`] rows and [`CELLS_MAX`] cells. Never fails.
#[must_use]
pub fn split(text: &str) -> Sheet {
    let mut cutter = Cutter { bytes: text.as_bytes(), at: 0, separator: b',' };
    if text.starts_with('\u{feff}') {
        cutter.at = '\u{feff}'.len_utf8();
    }
    let mut sheet = Sheet::default();
    let mut header_seen = false;
    let mut left = CELLS_MAX;
    while cutter.at < text.len() {
        let too_much = match (left, sheet.rows.len()) {
            (0, _) => Some(("cells", CELLS_MAX)),
            (_, ROWS_MAX) => Some(("rows", ROWS_MAX)),
            _ => None,
        };
        if let Some((what, most)) = too_much {
            sheet.cut = Some(Cut { at: cutter.at, what, most });
            break;
        }
        let line = cutter.line();
        if let Some(comment) = comment(text, &line) {
            sheet.comments.push(comment);
            left -= 1;
            cutter.at = cutter.line_end_after(line.end);
        } else if text.get(line.clone()).is_none_or(|line| line.trim().is_empty()) {
            cutter.at = cutter.line_end_after(line.end);
        } else if let Some(separator) = announced(text, &line).filter(|_| !header_seen) {
            cutter.separator = separator;
            header_seen = true;
            cutter.at = cutter.line_end_after(line.end);
        } else {
            if !header_seen {
                cutter.separator = guess(text.get(line.clone()).unwrap_or_default());
                header_seen = true;
            }
            let row = cutter.row(left, &mut sheet.bad_quotes);
            left -= row.len();
            sheet.rows.push(row);
        }
    }
    sheet
}

/// The content of a comment line. A spreadsheet may have quoted it.
fn comment(text: &str, line: &Range<usize>) -> Option<Range<usize>> {
    let content = text.get(line.clone())?;
    let start = content.trim_start().trim_start_matches('"').trim_start().strip_prefix('#')?;
    Some(line.end - start.len()..line.end)
}

/// The separator that a line `sep=;` states.
fn announced(text: &str, line: &Range<usize>) -> Option<u8> {
    let stated = text.get(line.clone())?.strip_prefix("sep=")?;
    match stated.as_bytes() {
        [separator] => Some(*separator).filter(|b| matches!(b, b',' | b';' | b'\t' | b'|')),
        _ => None,
    }
}

/// The separator that is most frequent in a header line; the comma if in doubt.
fn guess(header: &str) -> u8 {
    let mut quoted = false;
    let mut counts = [(b',', 0_usize), (b';', 0), (b'\t', 0)];
    for byte in header.bytes() {
        quoted ^= byte == b'"';
        for (_, count) in counts.iter_mut().filter(|(separator, _)| !quoted && *separator == byte) {
            *count += 1;
        }
    }
    // With several maxima the last one wins; reversing puts the comma last.
    counts.iter().rev().max_by_key(|(_, count)| *count).map_or(b',', |(separator, _)| *separator)
}

struct Cutter<'a> {
    bytes: &'a [u8],
    at: usize,
    separator: u8,
}

impl Cutter<'_> {
    fn byte(&self, at: usize) -> Option<u8> {
        self.bytes.get(at).copied()
    }

    /// The first position from `at` on where `stop` holds, or the end.
    fn find(&self, at: usize, stop: impl Fn(u8) -> bool) -> usize {
        let rest = self.bytes.get(at..).unwrap_or_default();
        rest.iter().position(|&byte| stop(byte)).map_or(self.bytes.len(), |offset| at + offset)
    }

    /// The line that starts here, without its line ending.
    fn line(&self) -> Range<usize> {
        self.at..self.find(self.at, |byte| matches!(byte, b'\n' | b'\r'))
    }

    /// The position after the line ending at `at`.
    fn line_end_after(&self, at: usize) -> usize {
        match (self.byte(at), self.byte(at + 1)) {
            (Some(b'\r'), Some(b'\n')) => at + 2,
            (Some(_), _) => at + 1,
            (None, _) => at,
        }
    }

    fn ends_cell(&self, byte: u8) -> bool {
        byte == self.separator || matches!(byte, b'\n' | b'\r')
    }

    /// Reads one row and its line ending, or `most` cells of it.
    fn row(&mut self, most: usize, bad_quotes: &mut Vec<Range<usize>>) -> Vec<Cell> {
        let mut cells = Vec::new();
        loop {
            cells.push(self.cell(bad_quotes));
            if cells.len() == most {
                return cells;
            }
            if self.byte(self.at) != Some(self.separator) {
                self.at = self.line_end_after(self.at);
                return cells;
            }
            self.at += 1;
        }
    }

    /// Reads one cell up to its separator or line ending.
    fn cell(&mut self, bad_quotes: &mut Vec<Range<usize>>) -> Cell {
        let start = self.at;
        if self.byte(start) == Some(b'"') {
            if let Some(close) = self.closing_quote(start + 1) {
                self.at = self.find(close + 1, |byte| self.ends_cell(byte));
                let rest = self.bytes.get(close + 1..self.at).unwrap_or_default();
                if !rest.trim_ascii().is_empty() {
                    bad_quotes.push(start..self.at);
                }
                return Cell { range: start + 1..close, quoted: true };
            }
            // Without a closing quote, the rest of the file would be one cell. Reading continues as
            // if the quote were not there, so that one mistake costs one cell.
            bad_quotes.push(start..start + 1);
            self.at = self.find(start + 1, |byte| self.ends_cell(byte));
            return Cell { range: start + 1..self.at, quoted: false };
        }
        self.at = self.find(start, |byte| self.ends_cell(byte));
        Cell { range: start..self.at, quoted: false }
    }

    /// The quote that ends the cell whose content starts at `at`.
    fn closing_quote(&self, mut at: usize) -> Option<usize> {
        loop {
            at = self.find(at, |byte| byte == b'"');
            self.byte(at)?;
            if self.byte(at + 1) != Some(b'"') {
                return Some(at);
            }
            at += 2;
        }
    }
}

/// The content of a cell, without surrounding blanks, invisible characters, quotes and guard.
#[must_use]
pub fn content(raw: &str, quoted: bool) -> String {
    let text = inner(raw, quoted);
    match text.strip_prefix('\'') {
        Some(rest) if is_guarded(rest) => rest.to_owned(),
        _ => text,
    }
}

/// Whether a cell is empty or a dash, which means the same.
pub(crate) fn says_nothing(content: &str) -> bool {
    matches!(content, "" | "-" | "–" | "—")
}

/// Where a cell's content begins after its guard; 0 if it has no guard.
pub(crate) fn guard_bytes(raw: &str, quoted: bool) -> usize {
    let text = inner(raw, quoted);
    let has_guard = text.strip_prefix('\'').is_some_and(is_guarded);
    raw.find('\'').filter(|_| has_guard).map_or(0, |at| at + 1)
}

/// The content of a part of a cell that is not at its beginning, and so has no guard.
pub(crate) fn inner(raw: &str, quoted: bool) -> String {
    let blank = |c: char| c.is_whitespace() || is_zero_width(c);
    let seen = raw.trim_matches(blank).chars().filter(|c| !is_zero_width(*c));
    let text: String = seen.map(|c| if c.is_whitespace() { ' ' } else { c }).collect();
    if quoted { text.replace("\"\"", "\"") } else { text }
}

/// The value of a property, without the separators and quote of the empty cells that a spreadsheet
/// adds after it.
pub(crate) fn bare(value: &str) -> &str {
    bare_start(value).trim_end_matches(is_empty_cell)
}

/// The value from its first character on.
pub(crate) fn bare_start(value: &str) -> &str {
    value.trim_start_matches(is_empty_cell)
}

fn is_empty_cell(c: char) -> bool {
    c.is_whitespace() || matches!(c, ',' | ';' | '"')
}

/// Protects a cell with an apostrophe, so that a spreadsheet takes it for text.
pub(crate) fn guarded(cell: String) -> String {
    if is_guarded(&cell) { format!("'{cell}") } else { cell }
}

/// Whether a cell gets an apostrophe: a spreadsheet would compute it, or take its own apostrophe
/// for the guard.
fn is_guarded(cell: &str) -> bool {
    is_formula(cell.trim_start_matches('\''))
}

/// Whether a spreadsheet would compute a cell. `+5V` and `-` are labels.
fn is_formula(cell: &str) -> bool {
    let rest = cell.strip_prefix(['+', '-']);
    cell.starts_with(['=', '@']) || rest.is_some_and(|rest| rest.contains(['|', '(', '!']))
}

/// Whether a character is one without width that spreadsheets and web pages leave in texts, a
/// control character, or a direction mark.
pub(crate) fn is_zero_width(c: char) -> bool {
    is_hidden(c) && !c.is_whitespace()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> Vec<Vec<String>> {
        let content = |cell: &Cell| {
            let raw = &text[cell.range.clone()];
            if cell.quoted { raw.replace("\"\"", "\"") } else { raw.to_owned() }
        };
        split(text).rows.iter().map(|row| row.iter().map(content).collect()).collect()
    }

    fn trim(cell: &str) -> String {
        cell.trim_matches(' ').to_owned()
    }

    #[test]
    fn every_dialect_gives_the_same_cells() {
        let expected = vec![vec!["Pin", "ADC"], vec!["PA1", "a b"]];
        for text in [
            "Pin,ADC\nPA1,a b\n",
            "Pin,ADC\r\nPA1,a b",
            "Pin,ADC\rPA1,a b\r",
            "Pin;ADC\nPA1;a b\n",
            "Pin\tADC\nPA1\ta b\n",
            "\u{feff}Pin,ADC\n\n# no row, ever\nPA1,\"a b\"\n",
            "sep=;\nPin;ADC\nPA1;a b\n",
            "sep=|\nPin|ADC\nPA1|a b\n",
        ] {
            assert_eq!(texts(text), expected, "{text:?}");
        }
    }

    #[test]
    fn comments_are_kept_without_their_sign() {
        let text = "# mcu = X\r\n  #b\n\"# c\",,\nPin\n# d";
        let comments: Vec<&str> =
            split(text).comments.iter().map(|range| &text[range.clone()]).collect();
        assert_eq!(comments, [" mcu = X", "b", " c\",,", " d"]);
    }

    #[test]
    fn formulas_and_hidden_characters_are_text() {
        for cell in ["=cmd|x", "@SUM(1)", "+1+cmd|x", "-2+f(1)", "'=x", "''@1"] {
            assert_eq!(guarded(cell.to_owned()), format!("'{cell}"));
            assert_eq!(content(&guarded(cell.to_owned()), false), cell);
        }
        for cell in ["+5V", "-", "-12V", "'a'", "PA1"] {
            assert_eq!(guarded(cell.to_owned()), cell);
            assert_eq!(content(cell, false), cell);
        }
        assert_eq!(content("\u{1b}[1m\u{202e}a\u{0}\u{9b}b", false), "[1mab");
    }

    #[test]
    fn an_open_quote_costs_one_cell() {
        let text = "Pin,ADC\nPA1,\"x\nPA2,y\n";
        let sheet = split(text);
        assert_eq!(sheet.bad_quotes, vec![12..13]);
        assert_eq!(texts(text), [["Pin", "ADC"], ["PA1", "x"], ["PA2", "y"]]);
    }

    proptest::proptest! {
        /// If no quote is bad, the cells are those of the crate `csv`, which keeps blanks after a
        /// closing quote.
        #[test]
        fn cells_agree_with_the_csv_crate(text in "[ab,\"\n\r; ]{0,40}") {
            let sheet = split(&text);
            proptest::prop_assume!(sheet.bad_quotes.is_empty());
            let lines: Vec<&str> = text.split(['\n', '\r']).collect();
            proptest::prop_assume!(!lines.iter().any(|line| !line.is_empty() && line.trim().is_empty()));
            let header = lines.iter().find(|line| !line.is_empty()).copied().unwrap_or_default();
            let mut reader = csv::ReaderBuilder::new()
                .has_headers(false)
                .flexible(true)
                .delimiter(guess(header))
                .from_reader(text.as_bytes());
            let expected: Vec<Vec<String>> = reader
                .records()
                .map(|record| record.unwrap().iter().map(trim).collect())
                .collect();
            let found: Vec<Vec<String>> =
                texts(&text).iter().map(|row| row.iter().map(|cell| trim(cell)).collect()).collect();
            proptest::prop_assert_eq!(found, expected);
        }
    }
}
