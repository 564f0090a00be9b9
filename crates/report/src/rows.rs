//! A wiring as rows: one wire each, ready to be printed.

use sensedsl_model::design::{Board, Design};
use sensedsl_wiring::assignment::{Assignment, BoardAssignment, Wire};

/// One wire.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// The board's name in the file.
    pub board: String,
    /// The device's name; `link` for the wires of a serial link.
    pub device: String,
    /// Its identifier; none for a link.
    pub id: Option<u8>,
    /// Its kind.
    pub kind: String,
    /// The role of the wire.
    pub role: String,
    /// The pin.
    pub pin: String,
    /// The signal as the table spells it.
    pub signal: String,
    /// The peripheral instance; empty for a bare GPIO.
    pub unit: String,
    /// Where on the board: side, header, position, label, as far as the table says.
    pub place: String,
    /// What else is on the pin; empty where nothing is.
    pub shared: String,
    /// Usages of the pin.
    pub usages: u32,
}

/// All wires: boards in file order, devices in file order, roles in their order.
#[must_use]
pub fn rows(design: &Design, assignment: &Assignment) -> Vec<Row> {
    let mut rows = Vec::new();
    for (on, board) in assignment.used(design) {
        for wiring in &on.devices {
            let Some(device) = design.device(wiring.device) else { continue };
            for wire in &wiring.wires {
                let shared = on.shared_with(wire).unwrap_or_default();
                rows.extend(row(
                    (design, board, wire, shared),
                    (&device.name.value, Some(device.id.value), device.kind.name().name()),
                    on.unit_of(wire).unwrap_or_default(),
                ));
            }
        }
        if let Some(link) = &on.link {
            for wire in &link.wires {
                let shared = on.shared_with(wire).unwrap_or_default();
                rows.extend(row((design, board, wire, shared), ("link", None, "uart"), &link.unit));
            }
        }
    }
    rows
}

/// The devices of a board that have resistors between them and their pins, and which.
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

fn row(
    (design, board, wire, shared): (&Design, &Board, &Wire, &str),
    (device, id, kind): (&str, Option<u8>, &str),
    unit: &str,
) -> Option<Row> {
    let pin = wire.pin(board)?;
    let mut place = Vec::new();
    if let Some(side) = &pin.side {
        place.push(side.clone());
    }
    match (&pin.header, &pin.position) {
        (Some(header), Some(position)) => place.push(format!("{header}.{position}")),
        (Some(header), None) => place.push(header.clone()),
        (None, Some(position)) => place.push(format!("pin {position}")),
        (None, None) => {}
    }
    if let Some(label) = &pin.label {
        place.push(format!("\"{label}\""));
    }
    Some(Row {
        board: board.name.value.clone(),
        device: device.to_owned(),
        id,
        kind: kind.to_owned(),
        role: wire.name(design),
        pin: pin.name.to_string(),
        signal: wire.signal(board).to_owned(),
        unit: unit.to_owned(),
        place: place.join(" "),
        shared: shared.to_owned(),
        usages: pin.cost(),
    })
}
