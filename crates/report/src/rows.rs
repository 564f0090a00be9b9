//! A wiring as rows: one wire each, ready to be printed.

use std::collections::BTreeSet;

use sensedsl_board::table::Pin;
use sensedsl_model::design::{Board, Design};
use sensedsl_wiring::assignment::{Assignment, BoardAssignment, Wire};

/// One wire.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// The board's name in the file.
    pub board: String,
    /// The name of the device, or of the chip; `link` for the wires of a serial link.
    pub device: String,
    /// Its identifiers: several for a chip, none for a link.
    pub ids: Vec<u8>,
    /// The names of a chip's values; empty for a device by itself.
    pub values: Vec<String>,
    /// Its kind.
    pub kind: String,
    /// The role of the wire.
    pub role: String,
    /// The pin.
    pub pin: String,
    /// What the board is labelled with there, if that is not the name of the pin.
    pub label: Option<String>,
    /// The signal as the table spells it.
    pub signal: String,
    /// The peripheral instance; empty for a bare GPIO.
    pub unit: String,
    /// Its place on the board: side, header, position, label, as far as the table gives them.
    pub place: String,
    /// The other thing that is on the pin; empty if there is none.
    pub shared: String,
    /// Number of usages of the pin.
    pub usages: u32,
}

impl Row {
    /// The identifiers as words: `30 31`.
    #[must_use]
    pub fn ids(&self) -> String {
        self.ids.iter().map(u8::to_string).collect::<Vec<_>>().join(" ")
    }
}

/// All wires: boards in file order, devices and chips in file order, roles in their order.
#[must_use]
pub fn rows(design: &Design, assignment: &Assignment) -> Vec<Row> {
    let mut rows = Vec::new();
    for (on, board) in assignment.used(design) {
        for wiring in &on.connections {
            let Some(connection) = design.connection(wiring.connection) else { continue };
            let Some(part) = design.part(connection.part) else { continue };
            let devices = || design.devices.iter().filter(|one| one.part == connection.part);
            let who = Who {
                name: &part.name.value,
                ids: devices().map(|one| one.id.value).collect(),
                values: if devices().any(|one| one.name.value != part.name.value) {
                    devices().map(|one| one.name.value.clone()).collect()
                } else {
                    Vec::new()
                },
                kind: connection.kind.name().name(),
                unit: wiring.unit.as_deref().unwrap_or_default(),
            };
            for wire in &wiring.wires {
                rows.extend(row(design, (on, board), wire, &who));
            }
        }
        if let Some(link) = &on.link {
            let (ids, values) = (Vec::new(), Vec::new());
            let who = Who { name: "link", ids, values, kind: "uart", unit: &link.unit };
            for wire in &link.wires {
                rows.extend(row(design, (on, board), wire, &who));
            }
        }
    }
    rows
}

/// The devices of a board that have resistors between them and their pins, with these resistors.
pub(super) fn dividers<'a>(
    design: &'a Design,
    on: &'a BoardAssignment,
) -> impl Iterator<Item = (&'a str, String)> {
    on.connections.iter().filter_map(|wiring| {
        let wires = design.connection(wiring.connection)?;
        let once = wires.element.is_none_or(|element| element == 0);
        once.then_some((design.part_name(wires.part), wires.level.as_ref()?.divided()?))
    })
}

/// The parts of a board whose wire needs a resistor to the supply, with that resistor: the first on each wire.
pub(super) fn pull_ups<'a>(
    design: &'a Design,
    on: &'a BoardAssignment,
) -> impl Iterator<Item = (&'a str, String)> {
    let mut pins = BTreeSet::new();
    on.connections.iter().filter_map(move |wiring| {
        let wires = design.connection(wiring.connection)?;
        wires.kind.onewire()?;
        let pin = wiring.wires.first()?.pin;
        pins.insert(pin).then(|| (design.part_name(wires.part), "4.7 kOhm to supply".to_owned()))
    })
}

/// The owner of wires.
struct Who<'a> {
    name: &'a str,
    ids: Vec<u8>,
    values: Vec<String>,
    kind: &'a str,
    unit: &'a str,
}

fn label(pin: &Pin, wire: &Wire) -> Option<String> {
    let place = wire.place.and_then(|number| pin.places.get(number));
    let own = place.and_then(|place| place.label.as_deref());
    let found = own.or_else(|| pin.labels().first().copied())?;
    (!found.eq_ignore_ascii_case(pin.name.as_str())).then(|| found.to_owned())
}

fn row(
    design: &Design,
    (on, board): (&BoardAssignment, &Board),
    wire: &Wire,
    who: &Who<'_>,
) -> Option<Row> {
    let pin = wire.pin(board)?;
    Some(Row {
        board: board.name.value.clone(),
        device: who.name.to_owned(),
        ids: who.ids.clone(),
        values: who.values.clone(),
        kind: who.kind.to_owned(),
        role: wire.name(design),
        pin: pin.name.to_string(),
        label: label(pin, wire),
        signal: wire.signal(board).to_owned(),
        unit: who.unit.to_owned(),
        place: crate::place::text(pin, wire.place),
        shared: on.shared_with(wire).unwrap_or_default().to_owned(),
        usages: pin.cost(),
    })
}
