//! The solver's numbers and their meanings.

use std::collections::BTreeMap;

use sensedsl_board::remap::Blocks;
use sensedsl_board::signal::{Function, Signal};
use sensedsl_board::table::Pin;
use sensedsl_model::design::{BoardIndex, PartIndex, Together};
use sensedsl_model::kind::{KindName, Role};
use sensedsl_solve::problem::{Claim, Holder, ResourceId};

/// A resource other than a pin.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Resource {
    /// A signal, used at most once.
    Signal(BoardIndex, String),
    /// A whole peripheral instance: a timer, a bus, a serial port.
    Unit(BoardIndex, String),
    /// One wire of a bus, which is on one pin.
    BusWire(BoardIndex, String, Role),
    /// An address on a bus.
    Address(BoardIndex, String, u8),
    /// An interrupt line.
    Exti(BoardIndex, u8),
    /// A contact that several pins share.
    Pad(BoardIndex, String),
    /// The choice between two sets of remap blocks for a peripheral's signals: no block is in both.
    Remap(BoardIndex, String, Blocks, Blocks),
    /// The one board that a part is on.
    Part(PartIndex),
    /// Something that the elements of an array have in common; the number is that of the wish for
    /// it.
    Tie(PartIndex, Option<u32>, Tied),
}

/// The meaning of a resource of a tie.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Tied {
    /// Whether a wish is kept.
    Kept,
    /// The unit, header or side.
    Same(Together),
    /// Whether a unit is among these, or among those: no unit is among both.
    Units(String, String),
    /// The units that serve all elements up to this one.
    Common(u16),
    /// A place of a header: claimed by this element if it is there or after, or by the next one if
    /// it is there or before.
    Place(u16, BoardIndex, String, usize),
}

impl Resource {
    /// The name in messages and JSON.
    #[must_use]
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Unit(_, name) | Self::BusWire(_, name, _) => name.clone(),
            Self::Signal(_, name) => bus(name).unwrap_or_else(|| name.clone()),
            Self::Address(_, unit, address) => format!("{unit} address 0x{address:02X}"),
            Self::Exti(_, line) => format!("EXTI{line}"),
            Self::Pad(_, name) => format!("contact {name}"),
            Self::Remap(_, unit, ..) => format!("{unit} remap block"),
            Self::Part(part) => format!("board of part {}", part.0 + 1),
            Self::Tie(part, wish, tied) => {
                let of = format!("of part {}", part.0 + 1);
                let wish = wish.map(|wish| format!(", wish {wish}")).unwrap_or_default();
                match tied {
                    Tied::Kept => format!("tie {of}{wish}"),
                    Tied::Same(what) => format!("{} {of}{wish}", what.name()),
                    Tied::Common(element) => format!("units up to element {element} {of}{wish}"),
                    Tied::Units(one, two) => format!("units {one} or {two} {of}{wish}"),
                    Tied::Place(element, _, header, place) => {
                        format!("place {place} of {header} behind element {element} {of}{wish}")
                    }
                }
            }
        }
    }

    /// Whether the pin's row in the table mentions the resource.
    #[must_use]
    pub(crate) fn is_shown_by(&self, pin: &Pin) -> bool {
        let of_unit = |unit: &str| {
            let mut functions = pin.usages.iter().map(|usage| usage.signal.function());
            functions.any(|function| function.units().iter().any(|of| of.as_str() == unit))
        };
        match self {
            Self::Unit(_, unit)
            | Self::BusWire(_, unit, _)
            | Self::Address(_, unit, _)
            | Self::Remap(_, unit, ..) => of_unit(unit),
            Self::Signal(_, name) => match bus(name) {
                Some(unit) => of_unit(&unit),
                None => pin.usages.iter().any(|usage| usage.signal.name() == name),
            },
            Self::Exti(..) | Self::Pad(..) | Self::Part(_) | Self::Tie(..) => false,
        }
    }

    /// The board it is on; `None` for a resource that ties a part.
    #[must_use]
    pub(crate) fn board(&self) -> Option<BoardIndex> {
        match self {
            Self::Signal(board, _)
            | Self::Unit(board, _)
            | Self::BusWire(board, ..)
            | Self::Address(board, ..)
            | Self::Exti(board, _)
            | Self::Pad(board, _)
            | Self::Remap(board, ..) => Some(*board),
            Self::Part(_) | Self::Tie(..) => None,
        }
    }
}

/// Something that is dealt out: each request gets one of those that can serve it for itself.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Stream {
    /// A DMA stream, as the target profile spells it (`1,0`).
    Dma(String),
    /// A timer, of which the kernel needs one for its clock: devices that use it take it from the kernel.
    Timer(String),
    /// A state machine of a block.
    Machine(String, u8),
}

impl Stream {
    /// The name in messages and JSON.
    #[must_use]
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Dma(stream) => format!("DMA{}", stream.replace(',', "_stream")),
            Self::Timer(timer) => timer.clone(),
            Self::Machine(block, number) => format!("{block} SM{number}"),
        }
    }
}

/// The unit of a bus signal: devices compete for the bus, whichever of its wires shows it.
fn bus(signal: &str) -> Option<String> {
    let (signal, _) = Signal::parse(signal);
    let unit = match signal.function() {
        Function::I2c { .. }
        | Function::Uart { .. }
        | Function::Spi { .. }
        | Function::Can { .. } => signal.function().units().into_iter().next()?,
        Function::Adc { .. }
        | Function::Timer { .. }
        | Function::Dac { .. }
        | Function::Pio { .. }
        | Function::Other => {
            return None;
        }
    };
    Some(unit.to_string())
}

/// `a`, `a and b`, `a, b and c`; the word before the last name is given.
pub(crate) fn list(names: &[&str], and: &str) -> String {
    match names {
        [] => "nothing".into(),
        [one] => (*one).into(),
        [first @ .., last] => format!("{} {and} {last}", first.join(", ")),
    }
}

/// A group on whose behalf several devices hold something together; pins and usages are given by
/// their index in the board's table.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Group {
    /// The devices on a bus of a kind that agree on a setting (0 if there is none to agree on).
    Bus(BoardIndex, String, KindName, u32),
    /// The outputs of a timer that run at one frequency.
    Frequency(BoardIndex, String, u32),
    /// The devices whose state machines run a program.
    Program(BoardIndex, String, &'static str),
    /// The devices that use a pin, with that signal, for one wire of their bus.
    Pin(BoardIndex, String, Role, usize, usize),
    /// The devices that use a pin, for the contact that it shares with other pins.
    Pad(BoardIndex, usize),
    /// The devices whose signals of a peripheral are in these remap blocks.
    Blocks(BoardIndex, String, Blocks),
    /// The connections of a part that have this in common.
    Tie(BoardIndex, String),
}

/// Numbers for things, given in the order in which they are first seen.
#[derive(Debug, Default)]
pub(crate) struct Names {
    resources: Vec<Resource>,
    resource_ids: BTreeMap<Resource, u32>,
    group_ids: BTreeMap<Group, u32>,
}

impl Names {
    pub(crate) fn resource(&mut self, resource: Resource) -> ResourceId {
        let next = u32::try_from(self.resources.len()).unwrap_or(u32::MAX);
        let id = *self.resource_ids.entry(resource.clone()).or_insert(next);
        if id == next {
            self.resources.push(resource);
        }
        ResourceId(id)
    }

    pub(crate) fn group(&mut self, group: Group) -> Holder {
        let next = u32::try_from(self.group_ids.len()).unwrap_or(u32::MAX);
        Holder::Group(*self.group_ids.entry(group).or_insert(next))
    }

    /// A claim that the device shares with no other.
    pub(crate) fn own(&mut self, resource: Resource) -> Claim {
        Claim { resource: self.resource(resource), holder: Holder::Own }
    }

    /// A claim shared with a group.
    pub(crate) fn shared(&mut self, resource: Resource, group: Group) -> Claim {
        Claim { resource: self.resource(resource), holder: self.group(group) }
    }

    /// All resources and all groups, each in the order of their numbers.
    pub(crate) fn all(self) -> (Vec<Resource>, Vec<Group>) {
        let mut groups: Vec<(Group, u32)> = self.group_ids.into_iter().collect();
        groups.sort_by_key(|(_, id)| *id);
        (self.resources, groups.into_iter().map(|(group, _)| group).collect())
    }
}
