//! The sheet as a diagram of Wokwi: boards and parts with their places, and wires between their contacts.
//!
//! In: a design and its wiring. Out: a `diagram.json`, and what is not in it. The form is version 1 of Wokwi's
//! [format](https://docs.wokwi.com/diagram-format). Dividers, pull-ups and transceivers are not drawn: there, a pin
//! takes any voltage, and a bus needs no resistors.

mod boards;
mod draw;
mod route;
mod table;

use sensedsl_board::table::Pin;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{e0529_no_wokwi_board, w0617_not_in_wokwi};
use sensedsl_model::design::{Board, Connection, Design, Part};
use sensedsl_model::kind::{Kind, Role};
use sensedsl_wiring::assignment::{Assignment, BoardAssignment, ConnectionWiring};

use super::part::crossed;
use super::part_indices;
use boards::{BOARDS, Names, WokwiBoard};
use draw::Canvas;
use table::{USES, Use, Whom};

/// A diagram.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagram {
    /// The file `diagram.json`.
    pub text: String,
    /// The parts that are not in it.
    pub left_out: Vec<Diagnostic>,
}

/// The diagram of all boards that carry a part.
///
/// # Errors
///
/// If Wokwi does not have a board.
pub fn wokwi(design: &Design, assignment: &Assignment) -> Result<Diagram, Vec<Diagnostic>> {
    let (mut canvas, mut left_out, mut wrong) = (Canvas::default(), Vec::new(), Vec::new());
    for (on, board) in assignment.used(design) {
        let built_in = board.facts.as_ref().filter(|_| board.built_in);
        let Some(known) = built_in.and_then(|facts| boards::board(&facts.name)) else {
            let all: Vec<String> =
                BOARDS.iter().map(|board| board.name.replace('-', "_")).collect();
            let name = &board.name;
            wrong.push(e0529_no_wokwi_board::no_wokwi_board(name.span, &name.value, &all));
            continue;
        };
        canvas.begin(&board.name.value, known);
        of_board(design, (on, board, known), &mut canvas, &mut left_out);
        canvas.end();
    }
    if wrong.is_empty() { Ok(Diagram { text: canvas.print(), left_out }) } else { Err(wrong) }
}

/// Draws what is on a board.
fn of_board(
    design: &Design,
    (on, board, known): (&BoardAssignment, &Board, &'static WokwiBoard),
    canvas: &mut Canvas,
    left_out: &mut Vec<Diagnostic>,
) {
    for index in part_indices(design, on) {
        let Some(part) = design.part(index) else { continue };
        let own = on.connections.iter().filter_map(|wiring| {
            let connection = design.connection(wiring.connection)?;
            (connection.part == index).then_some((connection, wiring))
        });
        let found: Result<Vec<_>, String> =
            own.clone().map(|one| drawn(part, one, (board, known))).collect();
        match found {
            Ok(all) => all.iter().flatten().for_each(|one| canvas.add(one)),
            Err(why) => {
                let name = &part.name;
                left_out.push(w0617_not_in_wokwi::not_in_wokwi(name.span, &name.value, &why));
                canvas.note(&noted(design, board, part, own.map(|(_, wiring)| wiring)));
            }
        }
    }
    let link = on.link.iter().flat_map(|link| &link.wires);
    for wire in link {
        let contact = wire.pin(board).and_then(|pin| contact(known, pin));
        if let Some(end) = crossed(wire.role) {
            canvas.host(contact.as_deref(), end);
        }
    }
}

/// A part of Wokwi's with its wires.
pub(super) struct Drawn {
    /// Its identifier.
    id: String,
    /// What is written above it.
    label: String,
    how: &'static Use,
    /// Contacts of the part and of the board.
    wires: Vec<(&'static str, String)>,
    /// A contact of the part that an address wants at its supply.
    high: Option<&'static str>,
}

/// How one connection of a part is drawn; none if it is on the board itself. The error says why it cannot be.
fn drawn(
    part: &Part,
    (connection, wiring): (&Connection, &ConnectionWiring),
    (board, known): (&Board, &'static WokwiBoard),
) -> Result<Option<Drawn>, String> {
    let how = USES.iter().find(|one| fits(one, part, connection, wiring));
    let how = how.ok_or_else(|| "Wokwi has no such part".to_owned())?;
    let mut wires = Vec::new();
    for wire in &wiring.wires {
        let Some(pin) = wire.pin(board) else { continue };
        let Some(at_part) = at_part(how, wire.role).filter(|contact| !contact.is_empty()) else {
            continue;
        };
        match contact(known, pin) {
            Some(of_board) => wires.push((at_part, of_board)),
            None if pin.onboard.is_some() && wiring.wires.len() == 1 => return Ok(None),
            None => return Err(format!("Wokwi's board has no contact for {}", pin.name)),
        }
    }
    let element = connection.element.map_or(String::new(), |element| format!("-{element}"));
    let name = &part.name.value;
    let shown = connection.element.map_or(String::new(), |element| format!("[{element}]"));
    let driver = part.driver.as_deref().filter(|_| !matches!(how.whom, Whom::Driver(_)));
    let stands = driver.map_or(String::new(), |driver| format!(" (for {driver})"));
    let label = format!("{name}{shown}{stands}");
    let high = match (&connection.kind, how.address) {
        (Kind::I2c(i2c), Some((address, contact))) if i2c.address == address => Some(contact),
        _ => None,
    };
    Ok(Some(Drawn { id: format!("{name}{element}"), label, how, wires, high }))
}

/// Whether a line of the table is about this connection, and has a contact for each of its wires.
fn fits(one: &Use, part: &Part, connection: &Connection, wiring: &ConnectionWiring) -> bool {
    let is_kind =
        |kind, direction| connection.kind.name() == kind && connection.direction == direction;
    let is_whose = match one.whom {
        Whom::Driver(name) => part.driver.as_deref() == Some(name),
        Whom::Any(kind, direction) => is_kind(kind, direction),
        Whom::Plain(kind, direction) => part.driver.is_none() && is_kind(kind, direction),
    };
    is_whose
        && connection.name.is_none()
        && wiring.wires.iter().all(|wire| at_part(one, wire.role).is_some())
}

/// The contact of the part for a wire.
fn at_part(one: &Use, role: Role) -> Option<&'static str> {
    one.wires.iter().find(|(wire, _)| *wire == role.name()).map(|(_, contact)| *contact)
}

/// The contact of Wokwi's board for a pin.
fn contact(known: &WokwiBoard, pin: &Pin) -> Option<String> {
    let printed = || {
        let own = pin.places.iter().filter_map(|place| place.label.as_deref());
        own.chain(pin.label.as_deref())
    };
    let number = |label: &str| match label.strip_prefix('D') {
        Some(digits) if digits.starts_with(|letter: char| letter.is_ascii_digit()) => {
            digits.to_owned()
        }
        _ => label.to_owned(),
    };
    let name = pin.name.as_str();
    let names: Vec<String> = match known.names {
        Names::Numbers => printed().map(number).collect(),
        Names::Printed => printed().map(str::to_owned).collect(),
        Names::Pins => vec![name.to_owned(), format!("{name}.1")],
        Names::Short => name.strip_prefix('P').map(str::to_owned).into_iter().collect(),
    };
    let other =
        known.others.iter().find(|(pin, _)| *pin == name).map(|(_, contact)| (*contact).to_owned());
    other.or_else(|| names.into_iter().find(|name| table::has(known.contacts, name)))
}

/// What a person has to know of a part that is not drawn: `Gyro (MPU-9250): scl GP5, sda GP4`.
fn noted<'a>(
    design: &Design,
    board: &Board,
    part: &Part,
    wirings: impl Iterator<Item = &'a ConnectionWiring>,
) -> String {
    let wire = |wire: &sensedsl_wiring::assignment::Wire| {
        Some(format!("{} {}", wire.name(design), wire.pin(board)?.name))
    };
    let wires: Vec<String> = wirings.flat_map(|wiring| &wiring.wires).filter_map(wire).collect();
    let title = part.module.as_ref().map_or("", |module| module.title.as_str());
    let title = if title.is_empty() { String::new() } else { format!(" ({title})") };
    format!("{}{title}: {}", part.name.value, wires.join(", "))
}
