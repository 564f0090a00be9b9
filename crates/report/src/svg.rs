//! A picture of each board: its pins along two edges, the used ones labelled with their use.
//!
//! Pins are on the side that the table gives them (`left` or `right` by name, otherwise the first
//! half of the natural order on the left), in natural order, or in the order of their places on a
//! connector if the table gives these. The text that is printed beside a pin is shown beside its
//! name. Below a board are its chips, one box each.

mod chips;

use std::cmp::Ordering;
use std::fmt::Write as _;

use sensedsl_board::pin::natural;
use sensedsl_board::place::Place;
use sensedsl_board::table::Pin;
use sensedsl_diagnostics::visible;
use sensedsl_model::design::{Board, Design};
use sensedsl_model::kind::KindName;
use sensedsl_wiring::assignment::{Assignment, BoardAssignment};

use crate::rows::{Row, rows};

const ROW_HEIGHT: usize = 22;
const HEAD_HEIGHT: usize = 64;
const CHIP_WIDTH: usize = 220;
const LABEL_WIDTH: usize = 330;
/// Distance from the edge to the place of a pin, past the longest name.
const PLACE_INSET: usize = 54;
const MARGIN: usize = 20;
const LEGEND_HEIGHT: usize = 30;
const WIDTH: usize = 2 * LABEL_WIDTH + CHIP_WIDTH + 2 * MARGIN;

/// The picture of all boards that carry a device, one below the other.
#[must_use]
pub fn svg(design: &Design, assignment: &Assignment) -> String {
    let rows = rows(design, assignment);
    let mut body = String::new();
    let mut top = MARGIN;
    for (on, board) in assignment.used(design) {
        top = board_picture(&mut body, top, (on, board), &rows);
    }
    let kinds: Vec<&str> = KindName::ALL
        .into_iter()
        .map(KindName::name)
        .filter(|kind| rows.iter().any(|row| row.kind == *kind))
        .collect();
    legend(&mut body, top, &kinds);
    let height = top + LEGEND_HEIGHT + MARGIN;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" \
         height=\"{height}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\">\n\
         <title>Wiring</title>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#FFFFFF\"/>\n{body}</svg>\n"
    )
}

/// Draws one board and returns where the next one begins.
fn board_picture(
    out: &mut String,
    top: usize,
    (on, board): (&BoardAssignment, &Board),
    rows: &[Row],
) -> usize {
    let (left, right) = edges(board);
    let lines = left.len().max(right.len()).max(2);
    let height = HEAD_HEIGHT + lines * ROW_HEIGHT + ROW_HEIGHT / 2;
    let x = MARGIN + LABEL_WIDTH;
    // Writing to a String cannot fail.
    let _ = writeln!(
        out,
        "<rect x=\"{x}\" y=\"{top}\" width=\"{CHIP_WIDTH}\" height=\"{height}\" rx=\"8\" \
         fill=\"#F4F6F8\" stroke=\"#33475B\" stroke-width=\"1.5\"/>"
    );
    let centre = x + CHIP_WIDTH / 2;
    let mcu = board.mcu.as_deref().unwrap_or("MCU unknown");
    let subtitle = format!("{mcu}, cost {}", on.cost);
    let name = &board.name.value;
    let name_size = if name.len() <= 24 { 14 } else { 10 };
    let shown_name = cut(name, 34);
    for (text, y, size, weight) in [
        (shown_name.as_str(), top + 26, name_size, "bold"),
        (subtitle.as_str(), top + 46, 11, "normal"),
    ] {
        let text = escaped(text);
        let _ = writeln!(
            out,
            "<text x=\"{centre}\" y=\"{y}\" text-anchor=\"middle\" font-size=\"{size}\" \
             font-weight=\"{weight}\" fill=\"#1B2733\">{text}</text>"
        );
    }
    for (pins, on_left) in [(left, true), (right, false)] {
        for (at, pin) in pins.iter().enumerate() {
            let y = top + HEAD_HEIGHT + at * ROW_HEIGHT;
            let uses: Vec<&Row> = rows
                .iter()
                .filter(|row| row.board == *name && row.pin == pin.name.as_str())
                .collect();
            pin_picture(out, y, on_left, pin, &uses);
        }
    }
    let mine: Vec<&Row> = rows.iter().filter(|row| row.board == *name).collect();
    chips::boxes(out, top + height + MARGIN, &mine)
}

/// The pins of the two edges.
fn edges(board: &Board) -> (Vec<&Pin>, Vec<&Pin>) {
    let mut pins: Vec<&Pin> = board.table.pins.iter().collect();
    if pins.iter().any(|pin| first(pin).is_some()) {
        pins.sort_by(|a, b| in_rows(a, b));
    }
    let side = |pin: &Pin| pin.sides().first().map(|side| side.to_lowercase());
    if pins.iter().any(|pin| side(pin).is_some()) {
        let first = pins.iter().find_map(|pin| side(pin));
        return pins.into_iter().partition(|pin| match side(pin).as_deref() {
            Some("right" | "bottom") | None => false,
            Some("left" | "top") => true,
            Some(_) => side(pin) == first,
        });
    }
    let half = pins.len().div_ceil(2);
    let (left, right) = pins.split_at(half.min(pins.len()));
    (left.to_vec(), right.to_vec())
}

/// The first contact of a pin.
fn first(pin: &Pin) -> Option<String> {
    pin.places.iter().find_map(Place::contact)
}

/// By connector and place on it; pins without a place come last.
fn in_rows(a: &Pin, b: &Pin) -> Ordering {
    let text = |pin: &Pin| first(pin).unwrap_or_default();
    let (one, other) = (text(a), text(b));
    let order = one.is_empty().cmp(&other.is_empty());
    order.then_with(|| natural(&one, &other)).then_with(|| a.name.cmp(&b.name))
}

/// The text that is printed beside a pin, and its place on a connector.
fn place(pin: &Pin) -> String {
    let labels = pin.labels().into_iter().filter(|label| *label != pin.name.as_str());
    let words: Vec<String> = labels.map(str::to_owned).chain(first(pin)).collect();
    cut(&words.join("  "), 16)
}

fn pin_picture(out: &mut String, y: usize, on_left: bool, pin: &Pin, uses: &[&Row]) {
    let edge = if on_left { MARGIN + LABEL_WIDTH } else { MARGIN + LABEL_WIDTH + CHIP_WIDTH };
    let middle = y + ROW_HEIGHT / 2;
    let baseline = middle + 4;
    let kind = uses.first().map(|row| row.kind.as_str());
    let fill = kind.map_or("#FFFFFF", colour);
    let stroke = if uses.is_empty() { "#AAB4BE" } else { "#33475B" };
    let pad_x = edge - 9;
    let _ = writeln!(
        out,
        "<rect x=\"{pad_x}\" y=\"{}\" width=\"18\" height=\"12\" rx=\"2\" fill=\"{fill}\" \
         stroke=\"{stroke}\"/>",
        middle - 6
    );
    if let Some(kind) = kind {
        letter(out, (edge, middle + 3), kind);
    }
    let (name_x, name_anchor) = if on_left { (edge + 15, "start") } else { (edge - 15, "end") };
    let weight = if uses.is_empty() { "normal" } else { "bold" };
    let ink = if uses.is_empty() { "#8492A0" } else { "#1B2733" };
    let name = escaped(pin.name.as_str());
    let _ = writeln!(
        out,
        "<text x=\"{name_x}\" y=\"{baseline}\" text-anchor=\"{name_anchor}\" \
         font-weight=\"{weight}\" fill=\"{ink}\">{name}</text>"
    );
    let place = escaped(&place(pin));
    if !place.is_empty() {
        let place_x = if on_left { edge + PLACE_INSET } else { edge - PLACE_INSET };
        let _ = writeln!(
            out,
            "<text x=\"{place_x}\" y=\"{baseline}\" text-anchor=\"{name_anchor}\" \
             font-size=\"9\" fill=\"{ink}\">{place}</text>"
        );
    }
    let (label_x, anchor) = if on_left { (edge - 16, "end") } else { (edge + 16, "start") };
    let text = label(pin, uses);
    let size = if uses.is_empty() { 10 } else { 12 };
    let _ = writeln!(
        out,
        "<text x=\"{label_x}\" y=\"{baseline}\" text-anchor=\"{anchor}\" font-size=\"{size}\" \
         fill=\"{ink}\">{}</text>",
        escaped(&text)
    );
}

/// The use of a pin, or its possible uses.
fn label(pin: &Pin, uses: &[&Row]) -> String {
    const LETTERS_MAX: usize = 46;
    let text = match uses {
        [] => {
            let usages: Vec<&str> = pin.usages.iter().map(|usage| usage.spelled.as_str()).collect();
            match &pin.onboard {
                Some(part) => format!("[{}] {}", part.part, usages.join(" ")),
                None => usages.join(" "),
            }
        }
        [first, ..] => {
            let devices: Vec<&str> = uses.iter().map(|row| row.device.as_str()).collect();
            format!("{} {} ({})", devices.join(", "), first.role, first.signal)
        }
    };
    cut(&text, LETTERS_MAX)
}

/// The text, cut if it is too long for its place.
fn cut(text: &str, letters_max: usize) -> String {
    if text.chars().count() <= letters_max {
        return text.to_owned();
    }
    let start: String = text.chars().take(letters_max - 1).collect();
    format!("{start}…")
}

fn legend(out: &mut String, top: usize, kinds: &[&str]) {
    let mut x = MARGIN;
    for kind in kinds {
        let _ = writeln!(
            out,
            "<rect x=\"{x}\" y=\"{}\" width=\"18\" height=\"12\" rx=\"2\" fill=\"{}\" \
             stroke=\"#33475B\"/>\n<text x=\"{}\" y=\"{}\" fill=\"#1B2733\">{kind}</text>",
            top + 4,
            colour(kind),
            x + 24,
            top + 14
        );
        letter(out, (x + 9, top + 13), kind);
        x += 92;
    }
}

/// The sign of a kind in its colour, for those who cannot tell colours apart, and for prints.
fn letter(out: &mut String, (x, y): (usize, usize), kind: &str) {
    let Some(spec) = KindName::from_name(kind).map(KindName::spec) else { return };
    let ink = if is_dark(spec.colour) { "#FFFFFF" } else { "#1B2733" };
    let _ = writeln!(
        out,
        "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\" font-size=\"9\" fill=\"{ink}\">{}</text>",
        spec.letter
    );
}

/// Whether white is easier to read on a colour than black, by its luma (ITU-R BT.601).
fn is_dark(colour: &str) -> bool {
    const HALF: u32 = 140_000;
    let part = |at: usize| {
        let digits = colour.get(at..at + 2).unwrap_or_default();
        u32::from_str_radix(digits, 16).unwrap_or_default()
    };
    299 * part(1) + 587 * part(3) + 114 * part(5) < HALF
}

fn colour(kind: &str) -> &'static str {
    KindName::from_name(kind).map_or("#DDDDDD", |kind| kind.spec().colour)
}

/// Text for an XML document.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in visible(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
    out
}
