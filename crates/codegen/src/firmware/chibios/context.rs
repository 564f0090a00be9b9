//! One board with everything its parts are planned from, and the words for pins and modes.

use sensedsl_board::catalog;
use sensedsl_board::pin::PinName;
use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit;
use sensedsl_model::design::{Board, Design, Device};
use sensedsl_model::kind::Kind;
use sensedsl_model::kind::Role;
use sensedsl_timing::{Starts, starts};
use sensedsl_wire::Schema;
use sensedsl_wiring::assignment::{BoardAssignment, DeviceWiring, Wire};

use super::tasks::Cycle;

/// One board on its way to a plan.
pub(super) struct Context<'a> {
    pub(super) board: &'a Board,
    pub(super) profile: &'a TargetProfile,
    pub(super) chibios: &'a catalog::Chibios,
    pub(super) wiring: &'a BoardAssignment,
    /// In file order; the order of the schema.
    pub(super) devices: Vec<Wired<'a>>,
    pub(super) schema: Schema,
    starts: Starts,
}

/// A device with its wires.
#[derive(Clone, Copy)]
pub(super) struct Wired<'a> {
    pub(super) device: &'a Device,
    pub(super) wiring: &'a DeviceWiring,
}

/// How one pad is set up. The order is the natural one of the pins.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct PadPlan {
    pub(super) pin: PinName,
    pub(super) line: String,
    pub(super) mode: String,
}

/// How a pad with an alternate function drives its wire.
#[derive(Clone, Copy)]
pub(super) enum Drive {
    /// An input, or an output of a slow peripheral.
    Plain,
    /// Pulled low or left alone: a bus.
    OpenDrain,
    /// Fast edges: USB.
    Fast,
}

impl<'a> Context<'a> {
    /// What is missing for firmware, in words, where something is.
    pub(super) fn new(
        design: &'a Design,
        board: &'a Board,
        wiring: &'a BoardAssignment,
    ) -> Result<Self, &'static str> {
        let profile = board.profile().ok_or("its target is `none`")?;
        let facts = board.facts.as_ref();
        let chibios = facts
            .and_then(|facts| facts.chibios.as_ref())
            .ok_or("no ChibiOS board is known for its MCU")?;
        let indices: Vec<_> = wiring.devices.iter().map(|wiring| wiring.device).collect();
        let devices = wiring
            .devices
            .iter()
            .filter_map(|wiring| Some(Wired { device: design.device(wiring.device)?, wiring }));
        Ok(Self {
            board,
            profile,
            chibios,
            wiring,
            devices: devices.collect(),
            schema: design.schema(wiring.board, &indices),
            starts: starts(design, wiring),
        })
    }

    /// What the device has in common with others of one thread.
    pub(super) fn cycle(&self, unit: &str, wired: &Wired<'_>) -> Cycle {
        let Wired { device, wiring } = wired;
        let start_ms = self.starts.get(&wiring.device).copied().unwrap_or_default();
        let (delay_ms, prio) = (device.delay_ms, device.prio);
        Cycle { unit: unit.to_owned(), delay_ms, prio, start_ms }
    }

    /// The macros of clocks that the computed times are true for.
    pub(super) fn clocks(&self) -> impl Iterator<Item = &str> {
        let has_analog =
            self.devices.iter().any(|wired| matches!(wired.device.kind, Kind::Analog(_)));
        let adc = self.profile.adc.clock.as_deref().filter(|_| has_analog);
        let core = self.profile.costs.as_ref().map(|costs| costs.clock.as_str());
        let link = self.wiring.link.as_ref().and_then(|link| self.profile.unit(&link.unit));
        adc.into_iter().chain(core).chain(link.and_then(|unit| unit.clock.as_deref()))
    }

    /// The pin of a role.
    pub(super) fn pin(&self, wired: &Wired<'_>, role: Role) -> Option<&'a PinName> {
        let wire = wired.wiring.wires.iter().find(|wire| wire.role == role)?;
        Some(&wire.pin(self.board)?.name)
    }

    /// The wire of a role.
    pub(super) fn wire(&self, wired: &Wired<'a>, role: Role) -> Option<&'a Wire> {
        wired.wiring.wires.iter().find(|wire| wire.role == role)
    }

    /// A pad with the alternate function of its wire. The table's number comes first, then the
    /// profile's; none is a mistake that is reported.
    pub(super) fn alternate_pad(
        &self,
        wire: &Wire,
        drive: Drive,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<PadPlan> {
        let pin = &wire.pin(self.board)?.name;
        let usage = wire.usage(self.board)?;
        let number = usage.alternate.or_else(|| self.profile.alternate(&usage.signal, pin));
        let Some(number) = number else {
            let span = self.board.table_span(usage.range.clone());
            let message = format!("the alternate function of {} at {pin} is unknown", usage.signal);
            let help = format!("write it into the table: `{}@5` for number 5", usage.spelled);
            diagnostics.push(e0506_hardware_limit::hardware_limit(span, &message, &help));
            return None;
        };
        Some(pad(pin, &alternate_mode(number, drive)))
    }

    /// The stream that the wiring gives to a DMA request.
    pub(super) fn stream(&self, unit: &str, request: &str) -> Option<&'a str> {
        let mut dma = self.wiring.dma.iter();
        dma.find(|dma| dma.unit == unit && dma.request == request).map(|dma| dma.stream.as_str())
    }
}

/// The mode of a pad with an alternate function.
pub(super) fn alternate_mode(number: u8, drive: Drive) -> String {
    let extra = match drive {
        Drive::Plain => "",
        Drive::OpenDrain => " | PAL_STM32_OTYPE_OPENDRAIN",
        Drive::Fast => " | PAL_STM32_OSPEED_HIGHEST",
    };
    format!("PAL_MODE_ALTERNATE({number}){extra}")
}

/// A pad in a mode.
pub(super) fn pad(pin: &PinName, mode: &str) -> PadPlan {
    PadPlan { pin: pin.clone(), line: line(pin), mode: mode.to_owned() }
}

/// The line of a pin. Pins of these MCUs are all of a port and a number.
pub(super) fn line(pin: &PinName) -> String {
    let (port, number) = (pin.port().unwrap_or('A'), pin.number().unwrap_or(0));
    format!("PAL_LINE(GPIO{port}, {number}U)")
}
