//! The texts beside contacts: a shape in, lines of text that touch nothing out.
//!
//! The texts of a row are all on the same side of it: towards the middle of the board if there is
//! room, otherwise outward, otherwise outside of the outline. Rows in the middle choose first.

use super::area::{Area, Point, Side};
use super::shape::{Carries, Contact, PITCH, Shape};
use super::text::{Anchor, Text, cut};

/// The font size of what is beside a contact.
const SIZE: f64 = 9.0;
/// The font size where there is little room.
const SIZE_MIN: f64 = 8.0;
/// The room for it.
const ROOM: f64 = 112.0;
/// From the middle of a contact to its text.
const GAP: f64 = 8.0;
/// From the outline to the texts outside of it, and between these.
const OUTSIDE_GAP: f64 = 7.0;
/// The width of the mark of a contact in use, and of another one.
const PAD_USED: f64 = 13.0;
const PAD_UNUSED: f64 = 9.0;

/// Where the texts of a row are.
#[derive(Clone, Copy, Debug)]
enum Spot {
    Inward,
    Outward,
    Outside,
}

/// How much is said, and how large.
#[derive(Clone, Copy, Debug)]
enum Words {
    Both,
    Short,
    Small,
}

/// The ways to write a row, the best first: where, and how each of its texts may be, in turn.
const WAYS: [(Spot, &[Words]); 8] = [
    (Spot::Inward, &[Words::Both]),
    (Spot::Inward, &[Words::Short]),
    (Spot::Inward, &[Words::Short, Words::Small]),
    (Spot::Outward, &[Words::Both]),
    (Spot::Outward, &[Words::Short]),
    (Spot::Outward, &[Words::Short, Words::Small]),
    (Spot::Outside, &[Words::Both]),
    (Spot::Outside, &[Words::Short]),
];

/// The areas of the marks of contacts.
pub(super) fn pads(shape: &Shape<'_>, is_used: &dyn Fn(&Contact<'_>) -> bool) -> Vec<Area> {
    let size = |one: &Contact<'_>| if is_used(one) { PAD_USED } else { PAD_UNUSED };
    shape.contacts.iter().map(|one| Area::around(one.at, size(one), size(one))).collect()
}

/// The text of each contact, empty where there is no room for one.
pub(super) fn labels(shape: &Shape<'_>, is_used: &dyn Fn(&Contact<'_>) -> bool) -> Vec<Text> {
    let mut taken = pads(shape, is_used);
    let mut texts: Vec<Text> = Vec::new();
    for row in rows(shape) {
        let members = || shape.contacts.iter().filter(move |one| one.row == row);
        let one = |contact: &Contact<'_>, (spot, words): (Spot, &[Words])| {
            let start = outside(shape, shape.side(contact.at), &texts);
            let mut all = words.iter();
            let found =
                all.find_map(|words| text(shape, contact, (spot, *words, start), &taken))?;
            let is_used = is_used(contact);
            let class = class(contact, is_used);
            Some(found.map(|text| Text { class: class.into(), is_bold: is_used, ..text }))
        };
        let whole = WAYS.iter().find_map(|way| {
            members().map(|contact| one(contact, *way)).collect::<Option<Vec<_>>>()
        });
        let each = || members().map(|contact| WAYS.iter().find_map(|way| one(contact, *way)?));
        let found: Vec<Text> = match whole {
            Some(row) => row.into_iter().flatten().collect(),
            None => each().flatten().collect(),
        };
        taken.extend(found.iter().map(Text::area));
        texts.extend(found);
    }
    texts
}

/// The rows of a shape, those in the middle first.
fn rows(shape: &Shape<'_>) -> Vec<usize> {
    let mut rows: Vec<(usize, f64)> = Vec::new();
    for contact in &shape.contacts {
        if rows.last().is_none_or(|(row, _)| *row != contact.row) {
            rows.push((contact.row, depth(shape, contact)));
        }
    }
    rows.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    rows.into_iter().map(|(row, _)| row).collect()
}

/// How far a contact is from the edge that it is nearest to.
fn depth(shape: &Shape<'_>, contact: &Contact<'_>) -> f64 {
    let (x, y) = contact.at;
    if contact.is_vertical { x.min(shape.width - x) } else { y.min(shape.height - y) }
}

/// The text of a contact in a spot: `None` if there is no room, `Some(None)` if there is nothing to
/// say.
#[expect(clippy::option_option, reason = "no room is not the same as no text")]
fn text(
    shape: &Shape<'_>,
    contact: &Contact<'_>,
    (spot, words, outside): (Spot, Words, f64),
    taken: &[Area],
) -> Option<Option<Text>> {
    let size = if matches!(words, Words::Small) { SIZE_MIN } else { SIZE };
    let content = cut(&content(shape, contact, words), size, ROOM);
    if content.is_empty() {
        return Some(None);
    }
    let text = Text::new((0.0, 0.0), size, "sd-ink", &content);
    let text = if contact.is_vertical {
        beside(shape, contact.at, text, (spot, outside))
    } else {
        above_or_below(shape, contact.at, text.turned(true), spot)
    };
    let area = text.area();
    let crosses_middle = match spot {
        Spot::Inward if contact.is_vertical => {
            area.left * 2.0 < shape.width && area.right * 2.0 > shape.width
        }
        Spot::Inward | Spot::Outward | Spot::Outside => false,
    };
    let leaves_board = matches!(spot, Spot::Outward) && !is_inside(shape, &area);
    let is_free = !taken.iter().any(|other| other.meets(&area.grown(0.5)));
    (is_free && !crosses_middle && !leaves_board).then_some(Some(text))
}

fn is_inside(shape: &Shape<'_>, area: &Area) -> bool {
    area.left > 2.0
        && area.top > 2.0
        && area.right < shape.width - 2.0
        && area.bottom < shape.height - 2.0
}

/// The text of a contact whose row runs up and down.
fn beside(shape: &Shape<'_>, (x, y): Point, text: Text, (spot, outside): (Spot, f64)) -> Text {
    let side = shape.side((x, y));
    let outward = side.outward();
    let start = match spot {
        Spot::Inward => x - outward * GAP,
        Spot::Outward => x + outward * GAP,
        Spot::Outside => outside,
    };
    let grows_right = matches!(spot, Spot::Inward) == (side == Side::Left);
    let anchor = if grows_right { Anchor::Start } else { Anchor::End };
    Text { at: (start, y), ..text.anchored(anchor) }
}

/// Where a column of texts outside of the outline starts: behind the column that is there.
fn outside(shape: &Shape<'_>, side: Side, texts: &[Text]) -> f64 {
    let columns = texts.iter().filter(|text| !text.is_turned).map(Text::area);
    match side {
        Side::Left => {
            let edge = columns.map(|area| area.left).filter(|left| *left < 0.0);
            edge.fold(0.0, f64::min) - OUTSIDE_GAP
        }
        Side::Right => {
            let edge = columns.map(|area| area.right).filter(|right| *right > shape.width);
            edge.fold(shape.width, f64::max) + OUTSIDE_GAP
        }
    }
}

/// The text of a contact whose row runs across the board; it runs up the page.
fn above_or_below(shape: &Shape<'_>, (x, y): Point, text: Text, spot: Spot) -> Text {
    let is_upper = y * 2.0 < shape.height;
    let long = text.area().bottom - text.area().top;
    // The anchor is the lower end of the text.
    let goes_up = matches!(spot, Spot::Inward) != is_upper;
    let lower_end = match (spot, goes_up) {
        (Spot::Outside, true) => -OUTSIDE_GAP,
        (Spot::Outside, false) => shape.height + OUTSIDE_GAP + long,
        (_, true) => y - GAP,
        (_, false) => y + GAP + long,
    };
    Text { at: (x, lower_end), ..text }
}

/// What is said beside a contact.
fn content(shape: &Shape<'_>, contact: &Contact<'_>, words: Words) -> String {
    let name = match contact.carries {
        Carries::Pin(pin) => pin.name.as_str(),
        // Nothing is connected: the mark says it.
        Carries::Signal("NC") | Carries::Unknown => "",
        Carries::Signal(signal) => signal,
    };
    let label = contact.label.filter(|label| !label.eq_ignore_ascii_case(name));
    match (label, words) {
        (Some(label), Words::Both) if contact.pin().is_none() => label.to_owned(),
        (Some(label), Words::Both) if !is_said_further_in(shape, contact) => {
            format!("{label} {name}")
        }
        // Where there is room for one, it is what people see on the board.
        (Some(label), Words::Short | Words::Small) if !is_said_further_in(shape, contact) => {
            label.to_owned()
        }
        (Some(_) | None, _) => name.to_owned(),
    }
}

/// Whether the label of a contact is at another contact of the same pin, further in: on a Nucleo, the
/// labels are those of the inner connectors.
fn is_said_further_in(shape: &Shape<'_>, contact: &Contact<'_>) -> bool {
    let name = contact.pin().map(|pin| &pin.name);
    let own = depth(shape, contact);
    let mut others = shape.contacts.iter().filter(|one| one.pin().map(|pin| &pin.name) == name);
    others.any(|one| one.label == contact.label && depth(shape, one) > own + PITCH)
}

/// The class of a contact's text: what can be used and what is used stands out.
fn class(contact: &Contact<'_>, is_used: bool) -> &'static str {
    let is_free = contact.pin().is_some_and(|pin| pin.onboard.is_none());
    let is_free = is_free && contact.kept_for.is_none();
    if is_free || is_used { "sd-ink" } else { "sd-soft" }
}
