//! A picture of what is on a terminal, for the documentation: as true as the test that writes it.
//!
//! In: a buffer of cells. Out: SVG. Dots, bars and lines are drawn as shapes, because fonts disagree about them.

use std::fmt::Write as _;

use ratatui_core::buffer::{Buffer, Cell};
use ratatui_core::style::{Color, Modifier};

const WIDE: f64 = 8.0;
const HIGH: f64 = 17.0;
const BORDER: f64 = 10.0;
const PAPER: &str = "#16191d";
const INK: &str = "#d7dade";
/// The dots of Braille, by bit: column and row.
const DOTS: [(u8, u8); 8] = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (0, 3), (1, 3)];

/// The look of some cells: colour, background, whether bold, whether faint.
type Ink = (&'static str, Option<&'static str>, bool, bool);

/// What a terminal makes of its colours.
const COLOURS: [(Color, &str); 6] = [
    (Color::Red, "#f47067"),
    (Color::Green, "#6bc46d"),
    (Color::Yellow, "#daaa3f"),
    (Color::Blue, "#6cb6ff"),
    (Color::Magenta, "#dcbdfb"),
    (Color::Cyan, "#56d4dd"),
];

fn colour(colour: Color) -> &'static str {
    COLOURS.iter().find(|(one, _)| *one == colour).map_or(INK, |(_, value)| value)
}

fn ink(cell: &Cell) -> Ink {
    let has = |modifier| cell.modifier.contains(modifier);
    let (bold, faint) = (has(Modifier::BOLD), has(Modifier::DIM));
    let front = colour(cell.fg);
    if has(Modifier::REVERSED) {
        (PAPER, Some(front), bold, false)
    } else {
        (front, None, bold, faint)
    }
}

/// Draws the whole terminal.
pub(super) fn svg(buffer: &Buffer, title: &str) -> String {
    let area = buffer.area;
    let wide = f64::from(area.width) * WIDE + 2.0 * BORDER;
    let high = f64::from(area.height) * HIGH + 2.0 * BORDER;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {wide} {high}\" width=\"{wide}\" height=\"{high}\" \
         font-family=\"ui-monospace, Menlo, Consolas, 'DejaVu Sans Mono', monospace\" font-size=\"13\">\n\
         <title>{title}</title>\n<rect width=\"{wide}\" height=\"{high}\" rx=\"8\" fill=\"{PAPER}\"/>\n"
    );
    for row in area.y..area.bottom() {
        let cells: Vec<&Cell> =
            (area.x..area.right()).map(|column| &buffer[(column, row)]).collect();
        let top = BORDER + f64::from(row) * HIGH;
        let mut first = 0;
        while first < cells.len() {
            let look = ink(cells[first]);
            let count = cells[first..].iter().take_while(|cell| ink(cell) == look).count();
            run(&mut svg, &cells[first..first + count], (BORDER + first as f64 * WIDE, top), look);
            first += count;
        }
    }
    svg.push_str("</svg>\n");
    svg
}

/// Draws cells of one look.
fn run(svg: &mut String, cells: &[&Cell], (left, top): (f64, f64), look: Ink) {
    let (front, back, bold, faint) = look;
    if let Some(back) = back {
        let wide = cells.len() as f64 * WIDE;
        let _ = writeln!(
            svg,
            "<rect x=\"{left}\" y=\"{top}\" width=\"{wide}\" height=\"{HIGH}\" fill=\"{back}\"/>"
        );
    }
    let opacity = if faint { " opacity=\"0.65\"" } else { "" };
    let mut shapes = String::new();
    let mut words: Vec<(f64, String)> = Vec::new();
    let mut is_word = false;
    for (place, cell) in cells.iter().enumerate() {
        let letter = cell.symbol().chars().next().unwrap_or(' ');
        let at = left + place as f64 * WIDE;
        if shape(&mut shapes, letter, (at, top)) || letter == ' ' {
            is_word = false;
            continue;
        }
        match words.last_mut().filter(|_| is_word) {
            Some((_, word)) => word.push_str(cell.symbol()),
            None => words.push((at, cell.symbol().to_owned())),
        }
        is_word = true;
    }
    if !shapes.is_empty() {
        let _ = writeln!(svg, "<path d=\"{}\" fill=\"{front}\"{opacity}/>", shapes.trim_end());
    }
    let weight = if bold { " font-weight=\"bold\"" } else { "" };
    for (at, word) in words {
        let long = word.chars().count() as f64 * WIDE;
        let base = top + 12.5;
        let word = word.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
        let _ = writeln!(
            svg,
            "<text x=\"{at}\" y=\"{base}\" textLength=\"{long}\" lengthAdjust=\"spacingAndGlyphs\" fill=\"{front}\"\
             {weight}{opacity}>{word}</text>"
        );
    }
}

/// Draws a letter that is a shape; false if it is another one.
fn shape(path: &mut String, letter: char, (left, top): (f64, f64)) -> bool {
    match letter {
        '\u{2800}'..='\u{28ff}' => {
            let dots = letter as u32 - 0x2800;
            for (bit, (column, row)) in
                DOTS.iter().enumerate().filter(|(bit, _)| dots >> bit & 1 == 1)
            {
                let _ = bit;
                let x = left + 1.0 + f64::from(*column) * WIDE / 2.0;
                let y = top + 1.0 + f64::from(*row) * HIGH / 4.0;
                let _ = write!(path, "M{x} {y}h2v2h-2z ");
            }
        }
        '▁'..='█' => {
            let high = f64::from(letter as u32 - '▁' as u32 + 1) * (HIGH - 3.0) / 8.0;
            let y = top + HIGH - 1.0 - high;
            let _ = write!(path, "M{left} {y}h{}v{high}h-{}z ", WIDE - 1.0, WIDE - 1.0);
        }
        '│' => {
            let _ = write!(path, "M{} {top}h1v{HIGH}h-1z ", left + WIDE / 2.0);
        }
        '┊' => {
            for part in 0..3 {
                let y = top + f64::from(part) * HIGH / 3.0;
                let _ = write!(path, "M{} {y}h1v3h-1z ", left + WIDE / 2.0);
            }
        }
        _ => return false,
    }
    true
}
