//! One part of the sheet: its wires, with what is printed at both ends.

use std::collections::BTreeSet;

use sensedsl_model::design::{Board, Connection, Design, Level, PartIndex};
use sensedsl_model::facts::{self, PartFacts};
use sensedsl_model::kind::{KindName, Role};
use sensedsl_wiring::assignment::{BoardAssignment, ConnectionWiring, Wire};

use super::rail::Rails;
use super::{End, Line, PartSheet, destination};
use crate::contact;

/// The CAN units that have been met on a board: each needs a transceiver.
#[derive(Default)]
pub(super) struct CanBuses(BTreeSet<String>);

impl CanBuses {
    pub(super) fn needs(&self) -> Vec<String> {
        let need = |unit: &String| {
            format!(
                "a CAN transceiver for {unit} (3.3 V, such as an SN65HVD230), and 120 Ohm between CANH and CANL at both ends of the bus"
            )
        };
        self.0.iter().map(need).collect()
    }
}

/// The sheet of a part that is on this board.
pub(super) fn of_part(
    design: &Design,
    (on, board): (&BoardAssignment, &Board),
    index: PartIndex,
    (rails, buses): (&mut Rails<'_>, &mut CanBuses),
) -> PartSheet {
    let Some(part) = design.part(index) else { return PartSheet::default() };
    let facts = part.driver.as_deref().and_then(facts::find);
    let own: Vec<(&Connection, &ConnectionWiring)> = on
        .connections
        .iter()
        .filter_map(|wiring| Some((design.connection(wiring.connection)?, wiring)))
        .filter(|(connection, _)| connection.part == index)
        .collect();
    let mut signals = Vec::new();
    for (connection, wiring) in &own {
        if connection.kind.name() == KindName::Can {
            buses.0.extend(wiring.unit.clone());
        }
        let line = |wire: &Wire| signal(design, board, (connection, wiring, wire), facts.as_ref());
        signals.extend(wiring.wires.iter().filter_map(line));
    }
    let headers = headers(board, &own);
    let ground = facts.as_ref().and_then(contact::ground).unwrap_or("GND");
    let mut lines = vec![rails.ground(ground, &headers)];
    lines.append(&mut signals);
    if let Some(facts) = &facts {
        lines.extend(can_bus(facts));
    }
    if let Some(facts) = &facts
        && let (Some(contact), Some(range_mv)) = (contact::supply(facts), facts.supply_mv)
    {
        lines.push(rails.supply(contact, range_mv, &headers));
    }
    let about = facts.as_ref().map_or(String::new(), |facts| facts.part.clone());
    let notes = notes(facts.as_ref(), &own);
    PartSheet { name: part.name.value.clone(), about, lines, notes }
}

/// A wire that carries a signal.
fn signal(
    design: &Design,
    board: &Board,
    (connection, wiring, wire): (&Connection, &ConnectionWiring, &Wire),
    facts: Option<&PartFacts>,
) -> Option<Line> {
    let pin = wire.pin(board)?;
    let name = wire.name(design);
    let at_part = match facts {
        Some(facts) => printed(facts, connection, wire.role),
        None => crossed(wire.role).map(str::to_owned),
    };
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
    Some(Line { at_part, to, pin: pin.name.to_string(), purpose, end })
}

/// The wires from a transceiver to a part on a CAN bus.
fn can_bus(facts: &PartFacts) -> Vec<Line> {
    let line = |wire: &str| {
        let is_it = |entry: &&String| entry.replace('_', "").eq_ignore_ascii_case(wire);
        let at_part = facts.connector.iter().find(is_it)?.clone();
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

/// What is printed at the part's end of a wire.
fn printed(facts: &PartFacts, connection: &Connection, role: Role) -> Option<String> {
    let own = facts.connections.iter().find(|one| one.name == connection.name)?;
    contact::contact(facts, own, role).map(str::to_owned)
}

/// The connectors that the part's wires go to.
fn headers(board: &Board, own: &[(&Connection, &ConnectionWiring)]) -> Vec<String> {
    let wires = own.iter().flat_map(|(_, wiring)| &wiring.wires);
    let places = wires.filter_map(|wire| wire.pin(board)?.places.get(wire.place?));
    let headers: BTreeSet<String> = places.filter_map(|place| place.header.clone()).collect();
    headers.into_iter().collect()
}

/// What anyone who connects it must know: resistors first, then the library's notes.
fn notes(facts: Option<&PartFacts>, own: &[(&Connection, &ConnectionWiring)]) -> Vec<String> {
    let mut notes = Vec::new();
    for (connection, _) in own {
        if connection.element.is_none_or(|element| element == 0)
            && let Some(divided) = connection.level.as_ref().and_then(Level::divided)
        {
            notes.push(format!("A voltage divider is needed: {divided}."));
        }
    }
    let is_i2c = own.iter().any(|(connection, _)| connection.kind.name() == KindName::I2c);
    if facts.is_some_and(|facts| facts.needs_pull_up) && is_i2c {
        notes.push(
            "SDA and SCL need a resistor of 2.2 to 10 kOhm each to the supply, once a bus; most modules have them."
                .to_owned(),
        );
    }
    notes.extend(facts.into_iter().flat_map(|facts| facts.notes.clone()));
    notes
}
