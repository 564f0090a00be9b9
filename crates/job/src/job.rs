//! One board's work, independent of any system: the starting point of every target and of the simulator.
//!
//! In: a design and its wiring. Out: a [`BoardJob`] for each board that carries a device. It has the devices in the
//! file's order; the connections with their units, pads, DMA streams, interrupt lines and cycles; the parts with their
//! tables; the link; and the schema, whose items are the devices in the same order. How a system spells any of it is up
//! to the target.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::profile::TargetProfile;
use sensedsl_board::signal::UnitName;
use sensedsl_board::table::{Pin, Usage};
use sensedsl_model::design::{
    Board, Connection, ConnectionIndex, Design, Device, DeviceIndex, Part, PartIndex,
};
use sensedsl_model::kind::{KindName, Role};
use sensedsl_timing::{Pulses, Starts, pulses_of, starts};
use sensedsl_wire::{Direction, Schema};
use sensedsl_wiring::assignment::{
    Assignment, BoardAssignment, ConnectionWiring, DeviceWiring, Wire,
};

use crate::control::JobController;
use crate::part::{BusPlan, PartPlan};
use crate::snake;

/// One board with everything that runs on it.
#[derive(Clone, Debug)]
pub struct BoardJob<'a> {
    /// The design that the board belongs to.
    pub design: &'a Design,
    /// The board.
    pub board: &'a Board,
    /// The board's part of the assignment.
    pub wiring: &'a BoardAssignment,
    /// The capabilities of silicon and system; `None` without a system.
    pub profile: Option<&'a TargetProfile>,
    /// The sensors that are reported and the actuators that are set, in the file's order.
    pub devices: Vec<JobDevice<'a>>,
    /// The connections, in the design's order: one for each single device, each element of an array and each connection
    /// of a chip.
    pub connections: Vec<JobConnection<'a>>,
    /// The parts that need tables of the runtime, in the design's order.
    pub parts: Vec<JobPart<'a>>,
    /// The user's code, in the file's order.
    pub controllers: Vec<JobController<'a>>,
    /// The port of a serial link.
    pub link: Option<SerialLink<'a>>,
    /// The schema of the link; its items are `devices`, in the same order.
    pub schema: Schema,
}

/// A part whose values the hardware alone cannot handle.
#[derive(Clone, Debug)]
pub struct JobPart<'a> {
    /// The part.
    pub part: &'a Part,
    /// The part's index in the design.
    pub index: PartIndex,
    /// The part's tables.
    pub plan: PartPlan,
}

/// A connection with everything that the wiring gave it.
#[derive(Clone, Debug)]
pub struct JobConnection<'a> {
    /// The connection.
    pub connection: &'a Connection,
    /// The connection's index in the design.
    pub index: ConnectionIndex,
    /// The part that the connection belongs to.
    pub part: &'a Part,
    /// The identifier in code, in snake case: `ir_front`, `line_3`, `left_in1`.
    pub ident: String,
    /// The name for people: `IRFront`, `Line[3]`, `Left.in1`.
    pub title: String,
    /// Indices into [`BoardJob::devices`] of the devices whose values go over it; empty if only the part itself needs
    /// it.
    pub devices: Vec<usize>,
    /// The peripheral instance; `None` for a plain pin.
    pub unit: Option<&'a str>,
    /// The pads, in the order of the roles.
    pub pads: Vec<Pad<'a>>,
    /// The DMA streams of its unit.
    pub streams: Vec<JobStream<'a>>,
    /// When the connection is served: as often as the fastest of its devices requires.
    pub cycle: Cycle,
}

/// A device with everything that the wiring gave it.
#[derive(Clone, Debug)]
pub struct JobDevice<'a> {
    /// The device.
    pub device: &'a Device,
    /// The device's index in the design.
    pub index: DeviceIndex,
    /// The identifier in code, in snake case: `ir_front`.
    pub ident: String,
    /// The peripheral instance; `None` for a plain pin.
    pub unit: Option<&'a str>,
    /// The pads, in the order of the roles.
    pub pads: Vec<Pad<'a>>,
    /// The DMA streams of its unit.
    pub streams: Vec<JobStream<'a>>,
    /// When the device is served.
    pub cycle: Cycle,
}

/// A pin in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pad<'a> {
    /// Its role for the device.
    pub role: Role,
    /// The pin.
    pub pin: &'a Pin,
    /// The signal that it carries; `None` for plain GPIO.
    pub usage: Option<&'a Usage>,
    /// The alternate function that selects the signal: the table's if it has one, otherwise the profile's.
    pub alternate: Option<u8>,
    /// The interrupt line of its edges; `None` if every pin has its own.
    pub interrupt: Option<u8>,
}

/// A DMA stream that serves a request: `1,0` for `I2C1_RX`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JobStream<'a> {
    /// The request of the unit's driver.
    pub request: &'a str,
    /// The controller and the stream.
    pub stream: &'a str,
}

/// The port of a serial link.
#[derive(Clone, Debug)]
pub struct SerialLink<'a> {
    /// The peripheral instance.
    pub unit: &'a str,
    /// The pads of TX and RX.
    pub pads: Vec<Pad<'a>>,
}

/// When a device is served. Devices that share a unit and a cycle are a class: one thread.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cycle {
    /// The time from one reading to the next.
    pub delay_ms: u32,
    /// The priority of the thread.
    pub prio: i8,
    /// The start of the first cycle; it differs between the devices of a group, so that they take turns.
    pub start_ms: u32,
}

/// The work of every board that carries a device, in the file's order.
pub fn jobs<'a>(
    design: &'a Design,
    wiring: &'a Assignment,
) -> impl Iterator<Item = BoardJob<'a>> + use<'a> {
    wiring.used(design).map(|(on, board)| BoardJob::new(design, board, on))
}

/// Connections grouped by their unit; those without a unit are left out.
pub fn by_unit<'w, 'a>(
    connections: impl Iterator<Item = &'w JobConnection<'a>>,
) -> BTreeMap<UnitName, Vec<&'w JobConnection<'a>>> {
    let mut units: BTreeMap<UnitName, Vec<&JobConnection<'a>>> = BTreeMap::new();
    for one in connections {
        let Some(unit) = one.unit.map(UnitName::new) else { continue };
        units.entry(unit).or_default().push(one);
    }
    units
}

/// The second element of an array `Wheels` and a device `Wheels_1` would have the same identifier in code: the element
/// is renamed.
fn tell_apart(connections: &mut [JobConnection<'_>], devices: &[JobDevice<'_>]) {
    let mut taken: BTreeSet<String> = devices.iter().map(|one| one.ident.clone()).collect();
    for one in connections {
        // The connection of a single device is named after the device.
        let is_own = one.connection.name.is_none() && one.connection.element.is_none();
        while !is_own && !taken.insert(one.ident.clone()) {
            one.ident.push('_');
        }
    }
}

/// What a job is gathered from.
#[derive(Clone, Copy)]
struct Source<'a> {
    design: &'a Design,
    board: &'a Board,
    wiring: &'a BoardAssignment,
    profile: Option<&'a TargetProfile>,
}

impl<'a> BoardJob<'a> {
    /// Gathers everything about one board.
    #[must_use]
    pub fn new(design: &'a Design, board: &'a Board, wiring: &'a BoardAssignment) -> Self {
        let starts = starts(design, wiring);
        let indices: Vec<_> = wiring.devices.iter().map(|wiring| wiring.device).collect();
        let profile = board.profile();
        let source = Source { design, board, wiring, profile };
        let devices = wiring.devices.iter().filter_map(|wiring| source.device(wiring, &starts));
        let devices: Vec<JobDevice<'a>> = devices.collect();
        let connections = wiring.connections.iter();
        let connections = connections.filter_map(|one| source.connection(one, &devices));
        let mut connections: Vec<JobConnection<'a>> = connections.collect();
        tell_apart(&mut connections, &devices);
        let link = wiring.link.as_ref();
        let link = link.map(|link| SerialLink { unit: &link.unit, pads: source.pads(&link.wires) });
        Self {
            design,
            board,
            wiring,
            profile,
            parts: source.tables(&devices),
            controllers: source.controllers(&devices),
            devices,
            connections,
            link,
            schema: design.schema(wiring.board, &indices),
        }
    }

    /// The system that the board's firmware is for: `chibios` of `chibios-21.11`.
    #[must_use]
    pub fn system(&self) -> Option<&'a str> {
        self.profile.map(TargetProfile::system)
    }

    /// How often each device's value can be counted on, in milliseconds; 0 for one that cannot. It is stale when it has
    /// not come for three of these.
    ///
    /// A controller counts its steps in each of them, though what it counts is told to the host only when it has
    /// changed.
    #[must_use]
    pub fn cycles_ms(&self) -> Vec<u32> {
        let controller = |index| self.controllers.iter().find(|one| one.own == index);
        let all = self.devices.iter().enumerate().map(|(index, one)| match controller(index) {
            Some(own) => own.controller.every_ms,
            None => self.design.paced_ms(one.device).unwrap_or(0),
        });
        all.collect()
    }

    /// Whether the host sets any value.
    #[must_use]
    pub fn has_actuators(&self) -> bool {
        self.devices.iter().any(|one| one.device.direction == Direction::Actuator)
    }

    /// The pads of all devices and of a serial link.
    pub fn all_pads(&self) -> impl Iterator<Item = &Pad<'a>> {
        let link = self.link.iter().flat_map(|link| &link.pads);
        self.connections.iter().flat_map(|one| &one.pads).chain(link)
    }

    /// The connections of a kind, in the design's order.
    pub fn connections(&self, kind: KindName) -> impl Iterator<Item = &JobConnection<'a>> {
        self.connections.iter().filter(move |one| one.connection.kind.name() == kind)
    }

    /// The connection with that place in the design, if it is on the board.
    #[must_use]
    pub fn wire(&self, index: ConnectionIndex) -> Option<&JobConnection<'a>> {
        self.connections.iter().find(|wire| wire.index == index)
    }

    /// The connections of a device, in the order in which its value goes over them.
    #[must_use]
    pub fn wires_of(&self, device: &Device) -> Vec<&JobConnection<'a>> {
        device.connections.iter().filter_map(|index| self.wire(*index)).collect()
    }

    /// The tables of the part that a connection belongs to.
    #[must_use]
    pub fn tables_of(&self, connection: &JobConnection<'_>) -> Option<&PartPlan> {
        let mut parts = self.parts.iter();
        Some(&parts.find(|one| one.index == connection.connection.part)?.plan)
    }

    /// The table of a connection to a register bus.
    #[must_use]
    pub fn bus_of(&self, wire: &JobConnection<'_>) -> Option<&BusPlan> {
        self.tables_of(wire)?.buses.iter().find(|plan| plan.connection == wire.index)
    }

    /// What a part on several register buses needs and no table can express; `None` if nothing is missing. Whatever
    /// belongs to the part as a whole cannot be assigned to one of its buses.
    #[must_use]
    pub fn lacks_on_buses(&self, wire: &JobConnection<'_>) -> Option<&'static str> {
        let buses = &self.tables_of(wire)?.buses;
        let protocol = wire.part.chip.as_ref().filter(|_| buses.len() > 1)?;
        let kinds = buses.iter().filter_map(|bus| self.design.connection(bus.connection));
        let kinds: BTreeSet<&str> = kinds.map(|one| one.kind.name().name()).collect();
        let has_start = !protocol.init.is_empty() || protocol.identity.is_some();
        if has_start || !protocol.calibration.is_empty() || protocol.formula.is_some() {
            Some("the start or the formula of a part on two buses")
        } else if kinds.len() > 1 && protocol.read_mask != 0 {
            Some("a mark of what is read (`read_mask`) of a part on I2C and SPI")
        } else {
            None
        }
    }
}

impl<'a> Source<'a> {
    /// The tables of all parts on the board that have any.
    fn tables(&self, devices: &[JobDevice<'a>]) -> Vec<JobPart<'a>> {
        let mut parts: Vec<JobPart<'a>> = Vec::new();
        for index in devices.iter().map(|one| one.device.part) {
            let is_known = parts.iter().any(|one| one.index == index);
            let Some(part) = self.design.part(index).filter(|_| !is_known) else { continue };
            let Some(mut plan) = PartPlan::new(self.design, index) else { continue };
            for bus in &mut plan.buses {
                if let Some(pulses) = self.pulses(bus.connection) {
                    bus.pulse(pulses);
                }
            }
            parts.push(JobPart { part, index, plan });
        }
        parts
    }

    /// The user's code on the board.
    fn controllers(&self, devices: &[JobDevice<'a>]) -> Vec<JobController<'a>> {
        let place = |device: DeviceIndex| devices.iter().position(|one| one.index == device);
        let all = self.design.controllers.iter().filter_map(|controller| {
            let own = place(controller.device)?;
            Some(JobController {
                controller,
                ident: devices.get(own)?.ident.clone(),
                own,
                reads: controller.reads.iter().filter_map(|one| place(one.value)).collect(),
                sets: controller.sets.iter().filter_map(|one| place(one.value)).collect(),
            })
        });
        all.collect()
    }

    /// The pulses that the unit of a connection makes for a strip.
    fn pulses(&self, index: ConnectionIndex) -> Option<Pulses> {
        let spi = self.design.connection(index)?.kind.spi()?;
        let unit = self.wiring.connection(index)?.unit.as_deref()?;
        pulses_of(self.design, self.board, self.wiring, (unit, spi))
    }

    fn connection(
        &self,
        wiring: &'a ConnectionWiring,
        devices: &[JobDevice<'a>],
    ) -> Option<JobConnection<'a>> {
        let index = wiring.connection;
        let connection = self.design.connection(index)?;
        let part = self.design.part(connection.part)?;
        let own = devices.iter().enumerate();
        let own: Vec<usize> = own
            .filter(|(_, one)| one.device.connections.contains(&index))
            .map(|(field, _)| field)
            .collect();
        let all = own.iter().filter_map(|field| devices.get(*field));
        let of_part = devices.iter().find(|one| one.device.part == connection.part);
        let cycle = all.min_by_key(|one| one.cycle.delay_ms).or(of_part)?.cycle;
        let (unit, name) = (wiring.unit.as_deref(), &part.name.value);
        let (mut ident, mut title) = (snake(name), name.clone());
        if let Some(own) = &connection.name {
            ident.push_str(&format!("_{}", snake(own)));
            title.push_str(&format!(".{own}"));
        }
        if let Some(element) = connection.element {
            ident.push_str(&format!("_{element}"));
            title.push_str(&format!("[{element}]"));
        }
        Some(JobConnection {
            connection,
            index,
            part,
            ident,
            title,
            devices: own,
            unit,
            pads: self.pads(&wiring.wires),
            streams: self.streams(unit),
            cycle,
        })
    }

    fn streams(&self, unit: Option<&str>) -> Vec<JobStream<'a>> {
        let streams = self.wiring.dma.iter().filter(|dma| Some(dma.unit.as_str()) == unit);
        streams.map(|dma| JobStream { request: &dma.request, stream: &dma.stream }).collect()
    }

    fn device(&self, wiring: &'a DeviceWiring, starts: &Starts) -> Option<JobDevice<'a>> {
        let device = self.design.device(wiring.device)?;
        let unit = wiring.unit.as_deref();
        Some(JobDevice {
            device,
            index: wiring.device,
            ident: snake(&device.name.value),
            unit,
            pads: self.pads(&wiring.wires),
            streams: self.streams(unit),
            cycle: Cycle {
                delay_ms: device.delay_ms,
                prio: device.prio,
                start_ms: starts.get(&wiring.device).copied().unwrap_or_default(),
            },
        })
    }

    fn pads(&self, wires: &[Wire]) -> Vec<Pad<'a>> {
        let pad = |wire: &Wire| {
            let (pin, usage) = (wire.pin(self.board)?, wire.usage(self.board));
            let usual = || self.profile?.alternate(&usage?.signal, &pin.name);
            Some(Pad {
                role: wire.role,
                pin,
                usage,
                alternate: usage.and_then(|usage| usage.alternate).or_else(usual),
                interrupt: self.profile.and_then(|profile| profile.exti_group(&pin.name)),
            })
        };
        wires.iter().filter_map(pad).collect()
    }
}

impl<'a> JobDevice<'a> {
    /// The pad of a role.
    #[must_use]
    pub fn pad(&self, role: Role) -> Option<&Pad<'a>> {
        self.pads.iter().find(|pad| pad.role == role)
    }

    /// The device's name in the file.
    #[must_use]
    pub fn name(&self) -> &'a str {
        &self.device.name.value
    }
}

impl<'a> JobConnection<'a> {
    /// The pad of a role.
    #[must_use]
    pub fn pad(&self, role: Role) -> Option<&Pad<'a>> {
        self.pads.iter().find(|pad| pad.role == role)
    }

    /// The element of an array that the connection carries, from 0; 0 if it is not of an array.
    #[must_use]
    pub fn element(&self) -> u16 {
        self.connection.element.unwrap_or(0)
    }

    /// The title with the rows of the board's table, for a comment: `IRFront at PB0 (ADC12-IN8)`.
    #[must_use]
    pub fn place(&self) -> String {
        let pad = |pad: &Pad<'_>| {
            let signal = pad.usage.map_or("GPIO", |usage| usage.spelled.as_str());
            format!("{} ({signal})", pad.pin.name)
        };
        let pads: Vec<String> = self.pads.iter().map(pad).collect();
        format!("{} at {}", self.title, pads.join(", "))
    }
}

impl Cycle {
    /// The identifier of a unit's thread in code: `adc1_60ms`, `i2c1_250ms_prio_minus_2_at_66`.
    #[must_use]
    pub fn ident(self, unit: &str) -> String {
        let mut ident = format!("{}_{}ms", snake(unit), self.delay_ms);
        if self.prio != 0 {
            let sign = if self.prio < 0 { "minus_" } else { "" };
            ident.push_str(&format!("_prio_{sign}{}", self.prio.unsigned_abs()));
        }
        if self.start_ms > 0 {
            ident.push_str(&format!("_at_{}", self.start_ms));
        }
        ident
    }

    /// The title of the thread, for a comment and for its name.
    #[must_use]
    pub fn title(self, unit: &str) -> String {
        let Self { delay_ms, prio, start_ms } = self;
        sensedsl_timing::Cycle { delay_ms, prio, start_ms }.title(unit)
    }
}
