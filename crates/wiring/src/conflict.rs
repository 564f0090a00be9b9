//! Why there is no wiring, in names, with repairs that were tried.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0401_no_wiring;
use sensedsl_model::design::{Board, BoardIndex, Design, DeviceIndex};
use sensedsl_solve::Conflict;

use crate::formulate::{Asker, Formulation};
use crate::repairs::{self, Repaired};

/// Repairs in one message; all are in the JSON output.
const REPAIRS_NAMED_MAX: usize = 4;

/// A minimal set of devices that cannot be connected together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoWiring {
    /// Without any one of them the others can be connected. In file order; empty when the serial
    /// links of the boards alone have no wires.
    pub devices: Vec<DeviceIndex>,
    /// Boards whose serial link is part of the conflict.
    pub links: Vec<BoardIndex>,
    /// Pins and other resources that they fight for, by name.
    pub resources: Vec<String>,
    /// What would help; each was checked by solving.
    pub repairs: Vec<Repaired>,
}

fn name(design: &Design, device: DeviceIndex) -> &str {
    design.device(device).map_or("", |device| device.name.value.as_str())
}

/// The solver's conflict in names, with repairs.
pub(crate) fn read(
    design: &Design,
    formulation: &Formulation<'_>,
    conflict: &Conflict,
) -> NoWiring {
    let mut named = named(formulation, conflict);
    named.repairs = repairs::find(design, &named.devices);
    named
}

/// The solver's conflict in names, without repairs.
pub(crate) fn named(formulation: &Formulation<'_>, conflict: &Conflict) -> NoWiring {
    let askers = conflict.devices.iter().filter_map(|id| formulation.askers.get(id.0 as usize));
    let (mut devices, mut links) = (Vec::new(), Vec::new());
    for asker in askers {
        match asker {
            Asker::Device(device) => devices.push(*device),
            Asker::Link(board) => links.push(*board),
        }
    }
    let resources = resources(formulation, conflict);
    NoWiring { devices, links, resources, repairs: Vec::new() }
}

fn resources(formulation: &Formulation<'_>, conflict: &Conflict) -> Vec<String> {
    let several = formulation.offers.len() > 1;
    let on = |board: BoardIndex, name: String| {
        let offer = formulation.offers.get(board.0).filter(|_| several);
        offer.map_or(name.clone(), |offer| format!("{}.{name}", offer.board.name.value))
    };
    let of_chip = conflict.resources.iter().filter_map(|id| {
        let resource = formulation.resources.get(id.0 as usize)?;
        Some(on(resource.board(), resource.name()))
    });
    let streams = conflict.streams.iter().filter_map(|id| {
        let (board, stream) = formulation.streams.get(id.0 as usize)?;
        Some(on(*board, format!("DMA{}", stream.replace(',', "_stream"))))
    });
    let pins = conflict.pins.iter().filter_map(|id| {
        let (board, pin) = formulation.pins.get(id.0 as usize)?;
        let pin = formulation.offers.get(board.0)?.board.table.pins.get(*pin)?;
        Some(on(*board, pin.name.to_string()))
    });
    let mut all: Vec<String> = Vec::new();
    for name in of_chip.chain(streams).chain(pins) {
        if !all.contains(&name) {
            all.push(name);
        }
    }
    all
}

impl NoWiring {
    /// The diagnostic: all devices of the conflict, each at its place.
    #[must_use]
    pub fn diagnostic(&self, design: &Design) -> Diagnostic {
        let mut names: Vec<&str> = self.devices.iter().map(|one| name(design, *one)).collect();
        let link_names: Vec<String> = self
            .links
            .iter()
            .filter_map(|board| design.board(*board))
            .map(|board| format!("the link of {}", board.name.value))
            .collect();
        names.extend(link_names.iter().map(String::as_str));
        let mut places = self
            .devices
            .iter()
            .filter_map(|device| design.device(*device))
            .map(|device| device.name.span)
            .chain(self.links.iter().filter_map(|b| design.board(*b)).map(|b| b.name.span));
        let first = places.next().or_else(|| design.boards.first().map(|board| board.name.span));
        let Some(first) = first else {
            return e0401_no_wiring::no_wiring(
                sensedsl_diagnostics::Span::new(design.file, 0..0),
                &list(&names),
                &self.resources.join(", "),
            );
        };
        let resources = self.resources.join(", ");
        let mut diagnostic = match names.as_slice() {
            [alone] => e0401_no_wiring::nothing_serves(first, alone, &resources),
            _ => e0401_no_wiring::no_wiring(first, &list(&names), &resources),
        };
        for place in places {
            diagnostic = diagnostic.label(place, "and this");
        }
        diagnostic.help(self.help(design))
    }

    fn help(&self, design: &Design) -> String {
        let repairs: Vec<String> = self
            .repairs
            .iter()
            .take(REPAIRS_NAMED_MAX)
            .map(|one| one.repair.describe(design))
            .collect();
        let mut help = match repairs.as_slice() {
            [] if names_one(self) => "take another board, or another kind of device".to_owned(),
            [] => "without any one of them the others can be connected, but more stands in the way"
                .to_owned(),
            [one] => format!("it works if you {one}"),
            _ => format!("it works if you {}", repairs.join(", or ")),
        };
        if design.boards.iter().any(|board: &Board| board.profile().is_some()) {
            help.push_str("; `--target none` looks at the pins alone");
        }
        help
    }
}

fn names_one(conflict: &NoWiring) -> bool {
    conflict.devices.len() + conflict.links.len() == 1
}

/// `a`, `a and b`, `a, b and c`.
fn list(names: &[&str]) -> String {
    match names {
        [] => "nothing".into(),
        [one] => (*one).into(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}
