//! One board's work, in words that name no system: what any target starts from, and a simulator.
//!
//! In: a design and its wiring. Out: for each board that carries a device a [`BoardJob`]: the devices in the
//! file's order with their units, pads, DMA streams, interrupt lines and cycles, the link, and the
//! schema whose items are the devices in the same order. How a system spells any of it is the target's.

use sensedsl_board::profile::TargetProfile;
use sensedsl_board::table::{Pin, Usage};
use sensedsl_model::design::{Board, Design, Device};
use sensedsl_model::kind::Role;
use sensedsl_timing::{Starts, starts};
use sensedsl_wire::Schema;
use sensedsl_wiring::assignment::{Assignment, BoardAssignment, DeviceWiring, Wire};

/// One board with everything that is to run on it.
#[derive(Clone, Debug)]
pub struct BoardJob<'a> {
    /// The design that it is of.
    pub design: &'a Design,
    /// The board.
    pub board: &'a Board,
    /// Its part of the answer.
    pub wiring: &'a BoardAssignment,
    /// What silicon and system can do; none without a system.
    pub profile: Option<&'a TargetProfile>,
    /// In the file's order.
    pub devices: Vec<JobDevice<'a>>,
    /// The port of a serial link.
    pub link: Option<SerialLink<'a>>,
    /// The wire; its items are `devices`, in the same order.
    pub schema: Schema,
}

/// A device with everything the wiring gave it.
#[derive(Clone, Debug)]
pub struct JobDevice<'a> {
    /// The device.
    pub device: &'a Device,
    /// The peripheral instance; none for a bare pin.
    pub unit: Option<&'a str>,
    /// In the order of the roles.
    pub pads: Vec<Pad<'a>>,
    /// The DMA streams of its unit.
    pub streams: Vec<JobStream<'a>>,
    /// When it is served.
    pub cycle: Cycle,
}

/// A pin that is put to use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pad<'a> {
    /// What it is to the device.
    pub role: Role,
    /// The pin.
    pub pin: &'a Pin,
    /// What it carries; none for a plain pin.
    pub usage: Option<&'a Usage>,
    /// The number by which the pad is switched to that. The table's comes first, then the profile's.
    pub alternate: Option<u8>,
    /// The interrupt line of its edges; none where every pin has its own.
    pub interrupt: Option<u8>,
}

/// A DMA stream that serves a request: `1,0` for `I2C1_RX`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JobStream<'a> {
    /// The request of the unit's driver.
    pub request: &'a str,
    /// Controller and stream.
    pub stream: &'a str,
}

/// The port of a serial link.
#[derive(Clone, Debug)]
pub struct SerialLink<'a> {
    /// The peripheral instance.
    pub unit: &'a str,
    /// TX and RX.
    pub pads: Vec<Pad<'a>>,
}

/// When a device is served. Devices of one unit and one cycle are a class: one thread.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cycle {
    /// From one reading to the next.
    pub delay_ms: u32,
    /// Priority of the thread.
    pub prio: i8,
    /// When the first cycle begins, so that devices of a group take turns.
    pub start_ms: u32,
}

/// The work of every board that carries a device, in the file's order.
pub fn jobs<'a>(
    design: &'a Design,
    wiring: &'a Assignment,
) -> impl Iterator<Item = BoardJob<'a>> + use<'a> {
    wiring.used(design).map(|(on, board)| BoardJob::new(design, board, on))
}

impl<'a> BoardJob<'a> {
    /// Gathers everything about one board.
    #[must_use]
    pub fn new(design: &'a Design, board: &'a Board, wiring: &'a BoardAssignment) -> Self {
        let starts = starts(design, wiring);
        let indices: Vec<_> = wiring.devices.iter().map(|wiring| wiring.device).collect();
        let job = Self {
            design,
            board,
            wiring,
            profile: board.profile(),
            devices: Vec::new(),
            link: None,
            schema: design.schema(wiring.board, &indices),
        };
        let devices = wiring.devices.iter().filter_map(|wiring| job.device(wiring, &starts));
        let link = wiring.link.as_ref();
        let link = link.map(|link| SerialLink { unit: &link.unit, pads: job.pads(&link.wires) });
        Self { devices: devices.collect(), link, ..job }
    }

    /// The system it is for: `chibios` of `chibios-21.11`.
    #[must_use]
    pub fn system(&self) -> Option<&'a str> {
        self.profile.map(TargetProfile::system)
    }

    /// The pads of all devices and of a serial link.
    pub fn all_pads(&self) -> impl Iterator<Item = &Pad<'a>> {
        let link = self.link.iter().flat_map(|link| &link.pads);
        self.devices.iter().flat_map(|device| &device.pads).chain(link)
    }

    fn device(&self, wiring: &'a DeviceWiring, starts: &Starts) -> Option<JobDevice<'a>> {
        let device = self.design.device(wiring.device)?;
        let unit = wiring.unit.as_deref();
        let streams = self.wiring.dma.iter().filter(|dma| Some(dma.unit.as_str()) == unit);
        Some(JobDevice {
            device,
            unit,
            pads: self.pads(&wiring.wires),
            streams: streams
                .map(|dma| JobStream { request: &dma.request, stream: &dma.stream })
                .collect(),
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

    /// Its name in the file.
    #[must_use]
    pub fn name(&self) -> &'a str {
        &self.device.name.value
    }
}

impl Cycle {
    /// For a comment and a thread's name.
    #[must_use]
    pub fn title(self, unit: &str) -> String {
        let Self { delay_ms, prio, start_ms } = self;
        sensedsl_timing::Cycle { delay_ms, prio, start_ms }.title(unit)
    }
}
