//! One part of the sheet: its wires, with what is printed at both ends.

use std::collections::BTreeSet;

use sensedsl_model::design::{Board, Connection, Design, Level, Module, PartIndex};
use sensedsl_model::kind::{KindName, Role};
use sensedsl_wiring::assignment::{BoardAssignment, ConnectionWiring, Wire};

use super::rail::Rails;
use super::{End, Line, PartSheet, destination};
use crate::contact::{self, Wires};

/// The units that have been met on a board.
#[derive(Default)]
pub(super) struct Buses {
    /// Each needs a transceiver.
    can: BTreeSet<String>,
    /// Each needs its resistors, which are noted at the first part.
    i2c: BTreeSet<String>,
    /// So does each pin that is a part's only wire.
    wires: BTreeSet<String>,
}

impl Buses {
    pub(super) fn needs(&self) -> Vec<String> {
        let need = |unit: &String| {
            format!(
                "a CAN transceiver for {unit} (3.3 V, such as an SN65HVD230), and 120 Ohm between CANH and CANL at both ends of the bus"
            )
        };
        self.can.iter().map(need).collect()
    }

    /// Notes a connection's bus, and says whether it is an I2C bus that was not met before.
    fn meet(&mut self, kind: KindName, unit: Option<&String>) -> bool {
        let Some(unit) = unit.cloned() else { return false };
        if kind == KindName::Can {
            self.can.insert(unit);
            return false;
        }
        kind == KindName::I2c && self.i2c.insert(unit)
    }
}

/// The sheet of a part that is on this board.
pub(super) fn of_part(
    design: &Design,
    (on, board): (&BoardAssignment, &Board),
    index: PartIndex,
    (rails, buses): (&mut Rails<'_>, &mut Buses),
) -> PartSheet {
    let Some(part) = design.part(index) else { return PartSheet::default() };
    let module = part.module.as_ref();
    let own: Vec<(&Connection, &ConnectionWiring)> = on
        .connections
        .iter()
        .filter_map(|wiring| Some((design.connection(wiring.connection)?, wiring)))
        .filter(|(connection, _)| connection.part == index)
        .collect();
    let (mut signals, mut needs_pulls) = (Vec::new(), false);
    for (connection, wiring) in &own {
        needs_pulls |= buses.meet(connection.kind.name(), wiring.unit.as_ref());
        let line = |wire: &Wire| signal(design, board, (connection, wiring, wire), module);
        signals.extend(wiring.wires.iter().filter_map(line));
    }
    let headers = headers(board, &own);
    let ground = module.and_then(contact::ground).unwrap_or("GND");
    let mut lines = vec![rails.ground(ground, &headers)];
    lines.append(&mut signals);
    lines.extend(module.into_iter().flat_map(can_bus));
    if let (Some(contact), Some(range_mv)) =
        (module.and_then(contact::supply), part.bounds.supply_mv)
    {
        lines.push(rails.supply(contact, range_mv, &headers));
    }
    let about = module.map_or(String::new(), |module| module.title.clone());
    let wire = own.iter().find(|(connection, _)| connection.kind.onewire().is_some());
    let pin = wire.and_then(|(_, wiring)| Some(wiring.wires.first()?.pin(board)?.name.to_string()));
    let pulled = pin.filter(|pin| buses.wires.insert(pin.clone()));
    let notes = notes(module, &own, needs_pulls, pulled);
    PartSheet { name: part.name.value.clone(), about, lines, notes }
}

/// A wire that carries a signal.
fn signal(
    design: &Design,
    board: &Board,
    (connection, wiring, wire): (&Connection, &ConnectionWiring, &Wire),
    module: Option<&Module>,
) -> Option<Line> {
    let pin = wire.pin(board)?;
    let name = wire.name(design);
    let wires = Wires::of_design(connection);
    let at_part = match module {
        Some(module) => wires.contact(module, wire.role),
        None => crossed(wire.role),
    };
    let at_part = at_part.map(str::to_owned);
    let at_part = if connection.kind.name() == KindName::Can {
        Some(format!("transceiver {}", if wire.role == Role::Tx { "TXD" } else { "RXD" }))
    } else {
        at_part
    };
    let element = connection.element.map_or(String::new(), |element| format!("[{element}]"));
    let unit = wiring.unit.as_deref().unwrap_or_default();
    let signal = wire.signal(board);
    let purpose = match crossed(wire.role) {
        Some(_) if connection.kind.name() == KindName::Uart => {
            format!("{name} of {unit}: what one end sends, the other receives")
        }
        _ if signal.is_empty() || signal == "GPIO" => name.clone(),
        _ => format!("{name}, {signal}"),
    };
    let at_part = at_part.map_or_else(|| name.clone(), |contact| format!("{contact}{element}"));
    let (to, end) = (destination(pin, wire), Some(End::at(pin, wire)));
    Some(Line { at_part, wire: name, to, pin: pin.name.to_string(), purpose, end })
}

/// The wires from a transceiver to a part on a CAN bus.
fn can_bus(module: &Module) -> Vec<Line> {
    let line = |wire: &str| {
        let is_it = |entry: &&String| entry.replace('_', "").eq_ignore_ascii_case(wire);
        let at_part = module.connector.iter().find(is_it)?.clone();
        let to = format!("transceiver {wire}");
        Some(Line { at_part, to, purpose: "the bus".to_owned(), ..Line::default() })
    };
    ["CANH", "CANL"].into_iter().filter_map(line).collect()
}

/// What the other end of a serial wire is called.
pub(super) fn crossed(role: Role) -> Option<&'static str> {
    if role == Role::Tx {
        return Some("RX");
    }
    (role == Role::Rx).then_some("TX")
}

/// The connectors that the part's wires go to.
fn headers(board: &Board, own: &[(&Connection, &ConnectionWiring)]) -> Vec<String> {
    let wires = own.iter().flat_map(|(_, wiring)| &wiring.wires);
    let places = wires.filter_map(|wire| wire.pin(board)?.places.get(wire.place?));
    let headers: BTreeSet<String> = places.filter_map(|place| place.header.clone()).collect();
    headers.into_iter().collect()
}

/// What anyone who connects it must know: resistors first, then the driver's notes.
fn notes(
    module: Option<&Module>,
    own: &[(&Connection, &ConnectionWiring)],
    needs_pulls: bool,
    pulled: Option<String>,
) -> Vec<String> {
    let mut notes = Vec::new();
    for (connection, _) in own {
        if connection.element.is_none_or(|element| element == 0)
            && let Some(divided) = connection.level.as_ref().and_then(Level::divided)
        {
            notes.push(format!("A voltage divider is needed: {divided}."));
        }
    }
    if let Some(pin) = pulled {
        notes.push(format!(
            "The wire at {pin} needs a resistor of 4.7 kOhm to the supply, one for all parts on it; most modules have one."
        ));
    }
    if needs_pulls {
        notes.push(
            "SDA and SCL of this bus need a resistor of 2.2 to 10 kOhm each to the supply; most modules have them."
                .to_owned(),
        );
    }
    notes.extend(module.into_iter().flat_map(|module| module.notes.clone()));
    notes
}
