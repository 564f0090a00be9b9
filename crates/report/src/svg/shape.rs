//! Where the contacts of a board are in its picture: a table in, a shape in pixels out.
//!
//! A board with a form is drawn to scale, turned by a quarter if most of its rows run across it, so
//! that wires leave to the left and to the right. All others have two columns: see `columns.rs`.

use std::collections::BTreeMap;

use sensedsl_board::form::{Connector, Form};
use sensedsl_board::landmark::LandmarkKind;
use sensedsl_board::place::Place;
use sensedsl_board::table::{Pin, Table};

use super::area::{Area, Point, Side};

/// Pixels for a millimetre: 2.54 mm are enough for a line of text and a wire below it.
const SCALE: f64 = 8.0;
/// The distance between neighbours in a row, in pixels.
pub(super) const PITCH: f64 = 2.54 * SCALE;

/// What a contact carries.
#[derive(Clone, Copy, Debug)]
pub(super) enum Carries<'a> {
    Pin(&'a Pin),
    /// Supply, ground, reset, or nothing.
    Signal(&'a str),
    /// The table does not say.
    Unknown,
}

/// A contact in the picture.
#[derive(Clone, Debug)]
pub(super) struct Contact<'a> {
    pub(super) at: Point,
    /// Whether its row runs up and down the board.
    pub(super) is_vertical: bool,
    /// The straight row that it is in.
    pub(super) row: usize,
    pub(super) carries: Carries<'a>,
    /// Connector and number: `CN7.28`.
    pub(super) name: Option<String>,
    /// What is printed beside it, if that is not the name of its pin or signal.
    pub(super) label: Option<&'a str>,
    /// What keeps its pin from devices, in words.
    pub(super) kept_for: Option<String>,
}

impl Contact<'_> {
    /// The pin that it carries.
    pub(super) fn pin(&self) -> Option<&Pin> {
        match self.carries {
            Carries::Pin(pin) => Some(pin),
            Carries::Signal(_) | Carries::Unknown => None,
        }
    }
}

/// A button or LED in the picture.
#[derive(Clone, Debug)]
pub(super) struct Landmark<'a> {
    pub(super) kind: LandmarkKind,
    pub(super) name: String,
    pub(super) at: Point,
    /// The pin that it is connected to, as far as the table says.
    pub(super) pin: Option<&'a Pin>,
}

/// A board in the picture, in pixels from its upper left corner.
#[derive(Clone, Debug, Default)]
pub(super) struct Shape<'a> {
    pub(super) width: f64,
    pub(super) height: f64,
    /// The plug for power and programs.
    pub(super) usb: Option<Point>,
    /// Whether it is the board's own shape.
    pub(super) is_to_scale: bool,
    pub(super) contacts: Vec<Contact<'a>>,
    pub(super) landmarks: Vec<Landmark<'a>>,
    /// The names of connectors, each where it is best shown.
    pub(super) captions: Vec<(String, Point)>,
}

impl Shape<'_> {
    /// The edge that is nearer to a point.
    pub(super) fn side(&self, at: Point) -> Side {
        if at.0 * 2.0 < self.width { Side::Left } else { Side::Right }
    }

    /// The USB plug, which sticks out a little over the edge that it is at.
    pub(super) fn plug(&self) -> Option<Area> {
        const WIDTH: f64 = 52.0;
        const HEIGHT: f64 = 26.0;
        let (x, y) = self.usb?;
        let inward = if y * 2.0 < self.height { 1.0 } else { -1.0 };
        // Where forms give the far end of a plug that sticks out, all of it is drawn.
        let out = if y * 2.0 < self.height { y.min(-6.0) } else { y.max(self.height + 6.0) };
        let height = HEIGHT.max(if inward > 0.0 { -out } else { out - self.height } + 8.0);
        Some(Area::around((x, out + inward * height / 2.0), WIDTH, height))
    }
}

/// What is at a contact, and what is printed there.
type Occupant<'a> = (Carries<'a>, Option<&'a str>);

/// The shape of a board that has a form.
pub(super) fn of_form<'a>(
    form: &Form,
    table: &'a Table,
    is_used: &dyn Fn(&Pin) -> bool,
) -> Shape<'a> {
    let frame = Frame::of(form);
    let occupants = occupants(table, is_used);
    let (width, height) = frame.size();
    let usb = form.usb_mm.map(|[x, y]| frame.place(x, y));
    let landmarks = landmarks(table, &frame);
    let mut shape = Shape { width, height, usb, is_to_scale: true, landmarks, ..Shape::default() };
    let mut row = 0;
    for connector in &form.connector {
        let first = shape.contacts.len();
        for line in &connector.row {
            add_row(&mut shape, &frame, (connector, row), line, &occupants);
            row += 1;
        }
        let own = shape.contacts.get(first..).unwrap_or_default();
        let caption = caption(own).filter(|_| form.connector.len() > 1);
        shape.captions.extend(caption.map(|at| (connector.name.clone(), at)));
    }
    shape
}

fn landmarks<'a>(table: &'a Table, frame: &Frame) -> Vec<Landmark<'a>> {
    let pin_of = |one: &sensedsl_board::landmark::Landmark| {
        let mut pins = table.pins.iter();
        pins.find(|pin| pin.onboard.as_ref().is_some_and(|onboard| one.is_part(&onboard.part)))
    };
    let all = table.landmarks().into_iter().map(|one| {
        let [x, y] = one.at_mm;
        Landmark { kind: one.kind, at: frame.place(x, y), pin: pin_of(&one), name: one.name }
    });
    all.collect()
}

fn add_row<'a>(
    shape: &mut Shape<'a>,
    frame: &Frame,
    (connector, row): (&Connector, usize),
    line: &sensedsl_board::form::Row,
    occupants: &BTreeMap<(String, u32), Occupant<'a>>,
) {
    for number in (0..line.count).map(|index| line.first + index * line.step) {
        let Some(at) = connector.contact(number) else { continue };
        let key = (connector.name.to_uppercase(), number);
        let (carries, label) = occupants.get(&key).copied().unwrap_or((Carries::Unknown, None));
        shape.contacts.push(Contact {
            at: frame.place(at.x_mm, at.y_mm),
            is_vertical: at.is_vertical != frame.is_turned,
            row,
            carries,
            name: Some(format!("{}.{number}", connector.name)),
            label,
            kept_for: None,
        });
    }
}

/// Where the name of a connector is shown: before the first of its contacts.
fn caption(contacts: &[Contact<'_>]) -> Option<Point> {
    let top = contacts.iter().map(|one| one.at.1).reduce(f64::min)?;
    let highest: Vec<f64> =
        contacts.iter().filter(|one| one.at.1 <= top + 1.0).map(|one| one.at.0).collect();
    let left = highest.iter().copied().reduce(f64::min)?;
    let right = highest.iter().copied().reduce(f64::max)?;
    Some((f64::midpoint(left, right), top - 0.75 * PITCH))
}

/// What is at the contacts of a table, by connector in upper case and number. Of several pins at one
/// contact, which a bridge of solder selects, it is the one in use.
fn occupants<'a>(
    table: &'a Table,
    is_used: &dyn Fn(&Pin) -> bool,
) -> BTreeMap<(String, u32), Occupant<'a>> {
    let mut found: BTreeMap<(String, u32), Occupant<'a>> = BTreeMap::new();
    for contact in &table.contacts {
        let label = contact.place.label.as_deref();
        found.extend(
            key(&contact.place).map(|key| (key, (Carries::Signal(&contact.signal), label))),
        );
    }
    for pin in &table.pins {
        for place in &pin.places {
            let Some(key) = key(place) else { continue };
            let other = found.get(&key).map(|(carries, _)| *carries);
            if is_used(pin) || !matches!(other, Some(Carries::Pin(_))) {
                found.insert(key, (Carries::Pin(pin), printed(pin, place)));
            }
        }
    }
    found
}

/// What is printed beside a pin at a place.
pub(super) fn printed<'a>(pin: &'a Pin, place: &'a Place) -> Option<&'a str> {
    place.label.as_deref().or(pin.label.as_deref())
}

fn key(place: &Place) -> Option<(String, u32)> {
    let number = place.position.as_ref()?.parse().ok()?;
    Some((place.header.as_ref()?.to_uppercase(), number))
}

/// From millimetres on the board to pixels in the picture.
struct Frame {
    width_mm: f64,
    height_mm: f64,
    /// Turned clockwise by a quarter.
    is_turned: bool,
}

impl Frame {
    fn of(form: &Form) -> Self {
        let rows = || form.connector.iter().flat_map(|one| &one.row);
        let contacts = |is_across: bool| -> u32 {
            let across = |row: &sensedsl_board::form::Row| {
                let [x, y] = row.to_next_mm;
                x.abs() > y.abs()
            };
            rows().filter(|row| across(row) == is_across).map(|row| row.count).sum()
        };
        let is_turned = contacts(true) > contacts(false);
        Self { width_mm: form.width_mm, height_mm: form.height_mm, is_turned }
    }

    fn size(&self) -> Point {
        let (width, height) = (self.width_mm * SCALE, self.height_mm * SCALE);
        if self.is_turned { (height, width) } else { (width, height) }
    }

    fn place(&self, x_mm: f64, y_mm: f64) -> Point {
        if self.is_turned {
            ((self.height_mm - y_mm) * SCALE, x_mm * SCALE)
        } else {
            (x_mm * SCALE, y_mm * SCALE)
        }
    }
}
