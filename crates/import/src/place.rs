//! Places in tables as spreadsheets show them: a row and a column in, `C3` out.

use sensedsl_board::cells;

/// The name of a cell, with row and column counted from 0: `A1` is the first cell.
pub(crate) fn a1(row: usize, column: usize) -> String {
    let mut letters = Vec::new();
    let mut rest = column + 1;
    while rest > 0 {
        rest -= 1;
        letters.push(char::from(b'A' + u8::try_from(rest % 26).unwrap_or_default()));
        rest /= 26;
    }
    let letters: String = letters.iter().rev().collect();
    format!("{letters}{}", row + 1)
}

/// The cells of a text, searchable by place.
#[derive(Debug)]
pub(crate) struct Places {
    rows: Vec<Vec<cells::Cell>>,
    /// Where each line starts.
    lines: Vec<usize>,
}

impl Places {
    pub(crate) fn new(text: &str) -> Self {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let lines = std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect();
        Self { rows: cells::split(text).rows, lines }
    }

    /// The name of the cell at an offset, with lines taken for rows; empty if there is no cell.
    pub(crate) fn of(&self, offset: usize) -> String {
        let ends = |row: &Vec<cells::Cell>| row.last().map_or(0, |cell| cell.range.end);
        let row = self.rows.get(self.rows.partition_point(|row| ends(row) < offset));
        let at = |cell: &cells::Cell| cell.range.start <= offset && offset <= cell.range.end;
        let column = row.and_then(|row| row.iter().position(at));
        let line = self.lines.partition_point(|start| *start <= offset).saturating_sub(1);
        column.map_or(String::new(), |column| a1(line, column))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_named_as_spreadsheets_do() {
        let names = [(0, 0), (2, 2), (9, 25), (0, 26), (99, 27), (0, 701), (0, 702)];
        let names: Vec<String> = names.iter().map(|(row, column)| a1(*row, *column)).collect();
        assert_eq!(names, ["A1", "C3", "Z10", "AA1", "AB100", "ZZ1", "AAA1"]);
    }

    #[test]
    fn offsets_are_in_cells() {
        let text = "# x\nPin;ADC\nPA1;\"a;b\";c\n";
        assert_eq!(Places::new(text).of(text.find(";b").unwrap()), "B3");
        assert_eq!(Places::new(text).of(text.find("c\n").unwrap()), "C3");
        assert_eq!(Places::new(text).of(0), "");
    }
}
