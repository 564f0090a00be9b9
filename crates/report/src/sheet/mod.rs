//! The sheet to build from: wire by wire from the module's contact to the board's, supply and ground
//! included, in the order in which one plugs. [`markdown`] and [`html`] print it.

pub mod html;
pub mod kicad;
pub mod markdown;
mod part;
mod rail;
pub mod wokwi;

use std::collections::BTreeSet;

use sensedsl_board::place::Place;
use sensedsl_board::table::Pin;
use sensedsl_model::design::{Board, Design, PartIndex};
use sensedsl_wiring::assignment::{Assignment, BoardAssignment, ConnectionWiring, Wire};

use crate::place;

use part::{Buses, of_part};
use rail::Rails;

/// The title of the wires to the host.
const LINK: &str = "Link to the host";

/// What is built on one board.
#[derive(Clone, Debug)]
pub(crate) struct BoardSheet<'a> {
    /// The board of the design.
    pub(crate) board: &'a Board,
    /// Its wiring.
    pub(crate) wiring: &'a BoardAssignment,
    /// Its parts, in the order of the file.
    pub(crate) parts: Vec<PartSheet>,
    /// What has to be at hand, besides the parts.
    pub(crate) needs: Vec<String>,
}

impl BoardSheet<'_> {
    /// The make of the board and its MCU, to stand behind its name.
    fn what(&self) -> String {
        let name = &self.board.name.value;
        let make = self.board.facts.as_ref().filter(|_| self.board.built_in);
        let make = make.filter(|facts| !facts.name.eq_ignore_ascii_case(&name.replace('_', "-")));
        let make = make.map_or(String::new(), |facts| format!(", {}", facts.name));
        let mcu = self.board.mcu.as_deref().map_or(String::new(), |mcu| format!(" ({mcu})"));
        format!("{make}{mcu}")
    }
}

/// How one part is connected.
#[derive(Clone, Debug, Default)]
pub(crate) struct PartSheet {
    /// The name in the design.
    pub(crate) name: String,
    /// What it is, by its driver; empty if that does not say.
    pub(crate) about: String,
    /// Its wires, in the order in which they are plugged: ground, signals, supply.
    pub(crate) lines: Vec<Line>,
    /// What anyone who connects it must know.
    pub(crate) notes: Vec<String>,
}

/// A wire from a part to the board.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Line {
    /// What is printed at the part's end, or the name of the wire.
    pub(crate) at_part: String,
    /// The name of the wire in the design; empty for supply and ground.
    pub(crate) wire: String,
    /// The contact of the board, or what else the wire goes to.
    pub(crate) to: String,
    /// The pin of the MCU; empty for supply and ground.
    pub(crate) pin: String,
    /// What the wire is for.
    pub(crate) purpose: String,
    /// What the board has at its end; none where the wire does not go to the board.
    pub(crate) end: Option<End>,
}

/// The board's end of a wire.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct End {
    /// What all wires that are connected there carry: the pin, or the supply.
    pub(crate) net: String,
    /// A contact that carries it, if one is known: `CN7.28`.
    pub(crate) contact: Option<String>,
}

impl End {
    /// The end of a wire at its pin: the contact that is nearest to the part's other wires.
    fn at(pin: &Pin, wire: &Wire) -> Self {
        let nearest = wire.place.and_then(|number| pin.places.get(number));
        let contact = nearest.into_iter().chain(&pin.places).find_map(Place::contact);
        Self { net: pin.name.to_string(), contact }
    }
}

/// The sheets of all boards that carry a part.
pub(crate) fn sheets<'a>(design: &'a Design, assignment: &'a Assignment) -> Vec<BoardSheet<'a>> {
    assignment.used(design).map(|(on, board)| sheet(design, on, board)).collect()
}

pub(crate) fn sheet<'a>(
    design: &'a Design,
    on: &'a BoardAssignment,
    board: &'a Board,
) -> BoardSheet<'a> {
    let (mut rails, mut buses) = (Rails::of(board), Buses::default());
    let mut parts: Vec<PartSheet> = part_indices(design, on)
        .into_iter()
        .map(|index| of_part(design, (on, board), index, (&mut rails, &mut buses)))
        .collect();
    parts.extend(of_link(on, board, &mut rails));
    let jumpers = parts.iter().map(|part| part.lines.len()).sum::<usize>();
    let mut needs = vec![format!("{jumpers} jumper wires")];
    needs.extend(buses.needs());
    needs.extend(rails.needs());
    BoardSheet { board, wiring: on, parts, needs }
}

/// The parts on a board, each once, in the order of the file.
fn part_indices(design: &Design, on: &BoardAssignment) -> Vec<PartIndex> {
    let of = |wiring: &ConnectionWiring| Some(design.connection(wiring.connection)?.part);
    let parts: BTreeSet<PartIndex> = on.connections.iter().filter_map(of).collect();
    parts.into_iter().collect()
}

/// Where a wire to a pin goes: its places, or the pin of the MCU where these are not known.
fn destination(pin: &Pin, wire: &Wire) -> String {
    let places = place::text(pin, wire.place);
    if places.is_empty() { format!("pin {}", pin.name) } else { places }
}

/// The wires of a serial link to the host.
fn of_link(on: &BoardAssignment, board: &Board, rails: &mut Rails<'_>) -> Option<PartSheet> {
    let link = on.link.as_ref()?;
    let pins = || link.wires.iter().filter_map(|wire| wire.pin(board));
    if let Some(bridge) = pins().find_map(|pin| pin.onboard.as_ref()) {
        let about = format!("over {} on the board, nothing to plug", bridge.part);
        return Some(PartSheet { name: LINK.to_owned(), about, ..PartSheet::default() });
    }
    let mut lines = vec![rails.ground("GND", &[])];
    for wire in &link.wires {
        let pin = wire.pin(board)?;
        lines.push(Line {
            at_part: part::crossed(wire.role).unwrap_or(wire.role.name()).to_owned(),
            wire: wire.role.name().to_owned(),
            to: destination(pin, wire),
            pin: pin.name.to_string(),
            purpose: format!("{} of {}", wire.role.name(), link.unit),
            end: Some(End::at(pin, wire)),
        });
    }
    Some(PartSheet {
        name: LINK.to_owned(),
        about: "a USB-to-serial adapter with the levels of the board".to_owned(),
        lines,
        notes: Vec::new(),
    })
}
