//! Letters as they are drawn in `letters.txt`: columns of dots in, the code of the letter out.
//!
//! The runtimes have tables of columns, which nothing here looks at.

/// Columns that a letter has with the empty one behind it.
pub(crate) const COLUMNS: usize = 6;
/// What stands for dots that are no letter.
pub(crate) const NONE: u8 = 0xFF;

/// The drawing: a line of codes, then seven rows for the letters below them.
const DRAWING: &str = include_str!("letters.txt");
const WIDTH: usize = 5;
const HEIGHT: usize = 7;

/// All letters, with their columns.
#[derive(Clone, Debug)]
pub(crate) struct Letters(Vec<(u8, Vec<u8>)>);

impl Letters {
    pub(crate) fn drawn() -> Self {
        let mut all = Vec::new();
        for block in DRAWING.split("\n\n") {
            let mut lines = block.lines();
            let Some(codes) = lines.next() else { continue };
            let rows: Vec<&str> = lines.take(HEIGHT).collect();
            for (place, code) in codes.split_whitespace().enumerate() {
                let Ok(code) = u8::from_str_radix(code, 16) else { continue };
                let column = |x: usize| {
                    let dots = rows.iter().zip(0..);
                    let is_set =
                        |row: &str| row.as_bytes().get((WIDTH + 1) * place + x) == Some(&b'#');
                    dots.fold(0, |dots, (row, y): (_, u32)| dots | u8::from(is_set(row)) << y)
                };
                all.push((code, (0..WIDTH).map(column).chain([0]).collect()));
            }
        }
        Self(all)
    }

    /// The letter that has these columns.
    pub(crate) fn read(&self, columns: &[u8]) -> u8 {
        let found = self.0.iter().find(|(_, own)| own == columns);
        found.map_or(NONE, |(code, _)| *code)
    }
}

/// The letters that a display shows for these codes: what has no letter is blank.
pub(crate) fn shown(raw: &[f64]) -> Vec<u8> {
    let letter = |raw: &f64| {
        let code = u8::try_from(crate::arith::rounded(raw.clamp(0.0, 255.0))).unwrap_or(0);
        if (0x20..=0x7E).contains(&code) { code } else { b' ' }
    };
    raw.iter().map(letter).collect()
}

#[cfg(test)]
mod tests {
    use sense_rt::{Code, Coding, Item, Scalar};

    use super::*;

    /// The table of the runtime is what was drawn.
    #[test]
    fn every_letter_is_drawn_and_comes_out_as_it_was_drawn() {
        let letters = Letters::drawn();
        assert_eq!(letters.0.len(), 95);
        let coding = Coding { code: Code::Text, ..Coding::NEW };
        let item = Item::actuator(1, Scalar::Uint8, 1);
        for code in 0..=255 {
            let mut columns = [0xAA; COLUMNS];
            assert_eq!(coding.encode(&item, &[code], &mut columns), COLUMNS);
            let wanted = if (0x20..=0x7E).contains(&code) { code } else { b' ' };
            assert_eq!(letters.read(&columns), wanted, "{code:#04X}");
        }
    }
}
