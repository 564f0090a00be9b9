//! The shape of a board without a form: its contacts in two columns.
//!
//! They are in the order of their connectors and numbers if the table has these, in the natural
//! order of the pins otherwise. A column `Side` decides the column; without one, the first half is
//! on the left.

use std::cmp::Ordering;

use sensedsl_board::pin::natural;
use sensedsl_board::place::Place;
use sensedsl_board::table::{Pin, Table};

use super::area::{Point, Side};
use super::shape::{Carries, Contact, PITCH, Shape, printed};

const WIDTH: f64 = 560.0;
/// From the edge to the contacts.
const INSET: f64 = 14.0;
/// The room for the board's name.
const HEAD: f64 = 62.0;

/// A contact without its point.
struct Entry<'a> {
    carries: Carries<'a>,
    place: Option<&'a Place>,
    label: Option<&'a str>,
}

impl<'a> Entry<'a> {
    fn header(&self) -> Option<&'a str> {
        self.place?.header.as_deref()
    }

    /// The edge that the table gives it: by its column `Side`, or by the connector's name.
    fn side(&self) -> Option<&'a str> {
        let sides = ["left", "right", "top", "bottom"];
        let named =
            self.header().filter(|name| sides.iter().any(|side| name.eq_ignore_ascii_case(side)));
        self.place?.side.as_deref().or(named)
    }

    fn name(&self) -> &'a str {
        match self.carries {
            Carries::Pin(pin) => pin.name.as_str(),
            Carries::Signal(signal) => signal,
            Carries::Unknown => "",
        }
    }
}

/// The shape of a table without a form.
pub(super) fn of_table<'a>(table: &'a Table, is_used: &dyn Fn(&Pin) -> bool) -> Shape<'a> {
    let mut entries = entries(table, is_used);
    if table.has_places() {
        entries.sort_by(in_rows);
    }
    let (left, right) = edges(entries);
    let mut shape = Shape { width: WIDTH, ..Shape::default() };
    for (row, (entries, side)) in [(left, Side::Left), (right, Side::Right)].into_iter().enumerate()
    {
        let bottom = column(&mut shape, row, side, entries);
        shape.height = shape.height.max(bottom);
    }
    shape
}

/// The pins, once for each contact, and the contacts without a pin. Pins on no connector are shown
/// if they are used, or if the table has no connectors.
fn entries<'a>(table: &'a Table, is_used: &dyn Fn(&Pin) -> bool) -> Vec<Entry<'a>> {
    let has_places = table.has_places();
    let mut entries = Vec::new();
    for pin in &table.pins {
        let on_connectors = pin.places.iter().filter(|place| place.contact().is_some());
        let own = on_connectors.map(|place| {
            let label = printed(pin, place);
            Entry { carries: Carries::Pin(pin), place: Some(place), label }
        });
        let before = entries.len();
        entries.extend(own);
        if entries.len() == before && (!has_places || is_used(pin)) {
            let label = pin.labels().first().copied();
            entries.push(Entry { carries: Carries::Pin(pin), place: pin.places.first(), label });
        }
    }
    entries.extend(table.contacts.iter().map(|contact| Entry {
        carries: Carries::Signal(&contact.signal),
        place: Some(&contact.place),
        label: contact.place.label.as_deref(),
    }));
    entries
}

/// By connector and number on it; what is on no connector comes last.
fn in_rows(a: &Entry<'_>, b: &Entry<'_>) -> Ordering {
    let contact = |entry: &Entry<'_>| entry.place.and_then(Place::contact).unwrap_or_default();
    let (one, other) = (contact(a), contact(b));
    let order = one.is_empty().cmp(&other.is_empty());
    order.then_with(|| natural(&one, &other)).then_with(|| natural(a.name(), b.name()))
}

/// The contacts of the two columns.
fn edges(mut entries: Vec<Entry<'_>>) -> (Vec<Entry<'_>>, Vec<Entry<'_>>) {
    let first = entries.iter().find_map(Entry::side).map(str::to_lowercase);
    if first.is_some() {
        return entries.into_iter().partition(|entry| {
            let side = entry.side().map(str::to_lowercase);
            match side.as_deref() {
                Some("right" | "bottom") | None => false,
                Some("left" | "top") => true,
                Some(_) => side == first,
            }
        });
    }
    let right = entries.split_off(entries.len().div_ceil(2).min(entries.len()));
    (entries, right)
}

/// Adds a column and returns where it ends.
fn column<'a>(shape: &mut Shape<'a>, row: usize, side: Side, entries: Vec<Entry<'a>>) -> f64 {
    let x = match side {
        Side::Left => INSET,
        Side::Right => WIDTH - INSET,
    };
    let mut y = HEAD;
    let mut header: Option<&str> = None;
    for entry in entries {
        if entry.header().is_some() && entry.header() != header {
            header = entry.header();
            y += PITCH / 2.0;
            shape.captions.extend(header.map(|name| (name.to_owned(), beside(side, x, y))));
            y += PITCH;
        }
        shape.contacts.push(Contact {
            at: (x, y),
            is_vertical: true,
            row,
            carries: entry.carries,
            name: entry.place.and_then(Place::contact),
            label: entry.label,
            kept_for: None,
        });
        y += PITCH;
    }
    y
}

/// A point for a name inside of the board.
fn beside(side: Side, x: f64, y: f64) -> Point {
    (x - side.outward() * 40.0, y)
}
