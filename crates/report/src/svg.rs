//! A picture of each board: its contacts where they are on the board, its parts in boxes beside it,
//! and the wires between them.
//!
//! `shape.rs` says where contacts are, `labels.rs` what is written beside them, `parts.rs` what a box
//! says, `board.rs` where everything is; `draw.rs` writes it. What is used, free or taken is told by
//! marks (`marks.rs`) and by colours (`palette.rs`), for light and dark pages.

mod area;
mod board;
mod boxes;
mod columns;
mod draw;
mod exits;
mod labels;
mod landmarks;
mod lanes;
mod legend;
mod marks;
mod nets;
mod palette;
mod parts;
mod shape;
mod text;
mod usages;

use std::fmt::Write as _;

use sensedsl_board::catalog;
use sensedsl_model::design::{Board, BoardIndex, Design};
use sensedsl_model::kind::KindName;
use sensedsl_model::{NoFiles, Request, resolve};
use sensedsl_wiring::assignment::{Assignment, BoardAssignment};
use sensedsl_wiring::kept_back;

use crate::markup::escaped;
use crate::rows::{Row, dividers, pull_ups, rows};
use crate::sheet;
use area::Area;
use draw::Use;
use legend::Legend;
use text::{Text, cut, number};

/// Around the picture, and between boards.
const MARGIN: f64 = 20.0;
/// The room for the heading of a board.
const HEADING: f64 = 30.0;
/// The font size of headings.
const HEADING_SIZE: f64 = 16.0;
/// The least width, for the heading and the legend.
const WIDTH_MIN: f64 = 760.0;

/// The picture of all boards that carry a device, one below the other.
#[must_use]
pub fn svg(design: &Design, assignment: &Assignment) -> String {
    let rows = rows(design, assignment);
    let mut boards: Vec<Drawn> = Vec::new();
    let mut legend = Legend::default();
    for (on, board) in assignment.used(design) {
        let mut heading = vec![board.name.value.clone()];
        heading.extend(names(board));
        heading.dedup();
        let heading = format!("{}, cost {}", heading.join(", "), on.cost);
        let (elements, area) = board_picture(design, (on, board), &rows, &mut legend);
        boards.push(Drawn { heading, elements, area });
    }
    let kinds: Vec<&str> = KindName::ALL
        .into_iter()
        .map(KindName::name)
        .filter(|kind| rows.iter().any(|row| row.kind == *kind))
        .collect();
    page("Wiring", &boards, &legend, &kinds)
}

/// The picture of a board of a design without any device: its contacts, with what is printed beside them, and what is
/// free. Nothing if the design has no such board.
#[must_use]
pub fn of_board(design: &Design, on: BoardIndex) -> Option<String> {
    let board = design.board(on)?;
    let nothing = BoardAssignment::empty(on);
    let mut legend = Legend::default();
    let (elements, area) = board_picture(design, (&nothing, board), &[], &mut legend);
    let names = names(board);
    let drawn = Drawn { heading: names.join(", "), elements, area };
    Some(page(names.first().map_or("Board", String::as_str), &[drawn], &legend, &[]))
}

/// The picture of a built-in board that nothing is wired to; nothing if its table cannot be read.
#[must_use]
pub fn of_built_in(board: &catalog::Entry) -> Option<String> {
    let text = format!("board Board on {} {{}}\n", board.name.replace('-', "_"));
    let request = Request { path: "board.sense", text: &text, board: None, target: None };
    of_board(&resolve(&request, &NoFiles).design?, BoardIndex(0))
}

/// The whole page: the boards one below the other, and the legend.
fn page(title: &str, boards: &[Drawn], legend: &Legend, kinds: &[&str]) -> String {
    let widths = boards.iter().map(|one| one.area.right - one.area.left);
    let width = widths.fold(WIDTH_MIN, f64::max) + 2.0 * MARGIN;
    let mut body = String::new();
    let mut top = MARGIN;
    for one in boards {
        top = place(&mut body, one, (width, top));
    }
    let height = legend.draw(&mut body, kinds, (MARGIN, top), width - MARGIN) + MARGIN;
    let (width, height) = (number(width.ceil()), number(height.ceil()));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"Helvetica, Arial, Liberation Sans, sans-serif\" role=\"img\">\n\
         <title>{}</title>\n{}<rect width=\"100%\" height=\"100%\" class=\"sd-page\"/>\n\
         {body}</svg>\n",
        escaped(title),
        palette::sheet(kinds)
    )
}

/// A board that is drawn around the upper left corner of its outline.
struct Drawn {
    heading: String,
    elements: String,
    area: Area,
}

/// Puts a board below what is there, in the middle, and returns where the next one begins.
fn place(out: &mut String, board: &Drawn, (width, top): (f64, f64)) -> f64 {
    let room = width - 2.0 * MARGIN;
    let heading = cut(&board.heading, HEADING_SIZE, room);
    let at = (MARGIN, top + HEADING_SIZE / 2.0);
    Text::new(at, HEADING_SIZE, "sd-ink", &heading).bold(true).write(out);
    let Area { left, top: upper, right, bottom } = board.area;
    let across = ((width - (right - left)) / 2.0 - left).round();
    let down = (top + HEADING - upper).round();
    // Writing to a String cannot fail.
    let _ = writeln!(
        out,
        "<g transform=\"translate({} {})\">\n{}</g>",
        number(across),
        number(down),
        board.elements
    );
    down + bottom + MARGIN
}

fn board_picture(
    design: &Design,
    (on, board): (&BoardAssignment, &Board),
    rows: &[Row],
    legend: &mut Legend,
) -> (String, Area) {
    let name = &board.name.value;
    let mine: Vec<&Row> = rows.iter().filter(|row| row.board == *name).collect();
    let use_of = |pin: &str| use_of(&mine, pin);
    let is_used = |pin: &sensedsl_board::table::Pin| use_of(pin.name.as_str()).is_some();
    let mut shape = match board.table.form() {
        Some(form) => shape::of_form(form, &board.table, &is_used),
        None => columns::of_table(&board.table, &is_used),
    };
    let kept_back = kept_back(design, on.board);
    for contact in &mut shape.contacts {
        contact.kept_for = contact.pin().and_then(|pin| kept_back.get(&pin.name)).cloned();
    }
    let resistors: Vec<(&str, String)> = dividers(design, on).chain(pull_ups(design, on)).collect();
    let resistors_of =
        |name: &str| resistors.iter().find(|(part, _)| *part == name).map(|(_, text)| text.clone());
    let sheet = sheet::sheet(design, on, board);
    let mut parts = parts::parts(&mine, &sheet, resistors_of);
    nets::label(&mut parts, &shape);
    let is_in_use = |contact: &shape::Contact<'_>| contact.pin().is_some_and(is_used);
    let picture = board::picture(&shape, &parts, &is_in_use);
    legend.add(&picture, &use_of);
    let mut elements = String::new();
    let names = names(board);
    let area = draw::draw(&mut elements, &picture, &use_of, &names);
    (elements, area)
}

/// What a board is labelled with: its maker's name, or the user's, and its MCU.
fn names(board: &Board) -> Vec<String> {
    let facts = board.facts.as_ref().filter(|_| board.built_in);
    let name = facts.map_or(&board.name.value, |facts| &facts.name);
    let mcu = board.mcu.as_deref().unwrap_or("MCU unknown");
    vec![cut(name, 10.0, 240.0), cut(mcu, 10.0, 240.0)]
}

/// What a pin is used for.
fn use_of(rows: &[&Row], pin: &str) -> Option<Use> {
    let mine = || rows.iter().filter(|row| row.pin == pin);
    let first = mine().next()?;
    let devices: Vec<&str> = mine().map(|row| row.device.as_str()).collect();
    Some(Use {
        kind: first.kind.clone(),
        words: format!("{} of {} ({})", first.role, devices.join(", "), first.signal),
        is_shared: mine().any(|row| !row.shared.is_empty()),
    })
}
