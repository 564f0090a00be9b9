//! One board with everything that its sections are planned from, and the spelling of pads and modes.

use std::collections::BTreeSet;

use sensedsl_board::pin::PinName;
use sensedsl_board::profile::{Fallback, TargetProfile};
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{e0506_hardware_limit, e0511_unknown_port};
use sensedsl_model::kind::{KindName, Role};

use super::facts::Facts;
use super::names::Names;
use sensedsl_job::{BoardJob, JobConnection, JobDevice, Pad};

/// One board and what its plan is made from.
pub(super) struct Context<'a> {
    pub(super) job: &'a BoardJob<'a>,
    pub(super) profile: &'a TargetProfile,
    pub(super) chibios: Facts,
    pub(super) names: Names,
    /// The timer that the kernel uses; `None` for the core's own tick.
    pub(super) kernel_timer: Option<String>,
}

/// How one pad is set up. The order is the natural order of the pins.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct PadPlan {
    pub(super) pin: PinName,
    pub(super) line: String,
    pub(super) mode: String,
    /// True if an output must be high before it becomes one.
    pub(super) is_high: bool,
}

/// How a pad with an alternate function drives its wire.
#[derive(Clone, Copy)]
pub(super) enum Drive {
    /// An input, or an output of a slow peripheral.
    Plain,
    /// Pulled low or released: a bus.
    OpenDrain,
    /// Fast edges: USB.
    Fast,
    /// An input that rests high, or low, while nothing is connected.
    Resting(bool),
}

impl<'a> Context<'a> {
    /// `None` if [`super::Chibios`] refuses the board.
    pub(super) fn new(job: &'a BoardJob<'a>) -> Option<Self> {
        let profile = job.profile?;
        let chibios = Facts::of(job.board.facts.as_ref()?).ok()??;
        let names = Names::of(profile).ok()?;
        let kernel_timer = kernel_timer(job, profile);
        Some(Self { job, profile, chibios, names, kernel_timer })
    }

    /// The connections of a kind, in the design's order.
    pub(super) fn connections(
        &self,
        kind: KindName,
    ) -> impl Iterator<Item = &'a JobConnection<'a>> {
        self.job.connections(kind)
    }

    /// The devices whose values go over a connection.
    pub(super) fn devices_of(
        &self,
        connection: &JobConnection<'_>,
    ) -> impl Iterator<Item = &'a JobDevice<'a>> {
        connection.devices.iter().filter_map(|field| self.job.devices.get(*field))
    }

    /// The device of a connection that carries one value.
    pub(super) fn device_of(&self, connection: &JobConnection<'_>) -> Option<&'a JobDevice<'a>> {
        self.job.devices.get(*connection.devices.first()?)
    }

    /// The identifier of the first device of a connection; 0 if it carries no value.
    pub(super) fn id_of(&self, connection: &JobConnection<'_>) -> u8 {
        self.device_of(connection).map_or(0, |one| one.device.id.value)
    }

    /// A pad in a mode. A pin whose port is unknown is reported.
    pub(super) fn pad(
        &self,
        pad: &Pad<'_>,
        mode: &str,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<PadPlan> {
        let name = &pad.pin.name;
        let Some(line) = self.line(name) else {
            let ports: String = self.profile.gpio_ports.iter().collect();
            let span = self.job.board.table_span(pad.pin.range.clone());
            let report = e0511_unknown_port::unknown_port(span, name.as_str(), &ports);
            diagnostics.push(report);
            return None;
        };
        Some(PadPlan { pin: name.clone(), line, mode: mode.to_owned(), is_high: false })
    }

    /// A pad with the alternate function of its wire. If none is known, that is reported.
    pub(super) fn alternate_pad(
        &self,
        pad: &Pad<'_>,
        drive: Drive,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<PadPlan> {
        let (name, usage) = (&pad.pin.name, pad.usage?);
        if self.names.drivers.gpio == "GPIOv1" {
            return self.pad(pad, unnumbered_mode(pad.role, drive), diagnostics);
        }
        let Some(number) = pad.alternate else {
            let span = self.job.board.table_span(usage.range.clone());
            let message =
                format!("the alternate function of {} at {name} is unknown", usage.signal);
            let help = format!("write it into the table: `{}@5` for number 5", usage.spelled);
            diagnostics.push(e0506_hardware_limit::hardware_limit(span, &message, &help));
            return None;
        };
        self.pad(pad, &alternate_mode(number, drive), diagnostics)
    }

    /// The line of a pin, if the MCU has its port.
    pub(super) fn line(&self, pin: &PinName) -> Option<String> {
        let (port, number) = (pin.port()?, pin.number()?);
        let is_known = self.profile.gpio_ports.contains(&port) && number < PADS_OF_PORT;
        is_known.then(|| format!("PAL_LINE(GPIO{port}, {number}U)"))
    }
}

/// The number of pads of a port.
const PADS_OF_PORT: u8 = 16;

/// The kernel's time steps per second with its own timer: the most that a 16-bit one can derive from any clock.
pub(super) const KERNEL_HZ: u32 = 10_000;

/// The kernel's time steps per second with the core's tick.
pub(super) const TICK_HZ: u32 = 1_000;

/// The first timer that no device uses and that does not wrap within a cycle; `None` for the core's tick.
fn kernel_timer(job: &BoardJob<'_>, profile: &TargetProfile) -> Option<String> {
    let taken = job.connections.iter().filter_map(|one| one.unit);
    let units: BTreeSet<UnitName> = taken.map(UnitName::new).collect();
    let cycles = job.connections.iter().map(|one| one.cycle.delay_ms.max(one.cycle.start_ms));
    let longest_ms = u64::from(cycles.max().unwrap_or(0));
    let kernel = &profile.kernel;
    let is_free = |timer: &&String| units.iter().all(|unit| unit.as_str() != timer.as_str());
    // Half of its range is left for a thread that runs late.
    let lasts = |timer: &&String| {
        let bits = profile.timer(timer).map_or(0, |timer| timer.bits.min(32));
        longest_ms * u64::from(KERNEL_HZ) / 1_000 < (1 << bits) / 2
    };
    let free = kernel.timers.iter().filter(is_free).find(lasts);
    match kernel.fallback {
        Some(Fallback::Systick) => free.cloned(),
        // Without a fallback, the wiring has kept one free.
        None => free.or(kernel.timers.first()).cloned(),
    }
}

/// The mode of a pad with an alternate function.
pub(super) fn alternate_mode(number: u8, drive: Drive) -> String {
    let extra = match drive {
        Drive::Plain => "",
        Drive::OpenDrain => " | PAL_STM32_OTYPE_OPENDRAIN | PAL_STM32_PUPDR_PULLUP",
        Drive::Fast => " | PAL_STM32_OSPEED_HIGHEST",
        Drive::Resting(true) => " | PAL_STM32_PUPDR_PULLUP",
        Drive::Resting(false) => " | PAL_STM32_PUPDR_PULLDOWN",
    };
    format!("PAL_MODE_ALTERNATE({number}){extra}")
}

/// The mode of a pad without alternate function numbers: an output belongs to the peripheral, an input is a plain
/// input, which the peripheral reads as well.
fn unnumbered_mode(role: Role, drive: Drive) -> &'static str {
    match drive {
        Drive::OpenDrain => "PAL_MODE_STM32_ALTERNATE_OPENDRAIN",
        Drive::Resting(true) => "PAL_MODE_INPUT_PULLUP",
        Drive::Resting(false) => "PAL_MODE_INPUT_PULLDOWN",
        Drive::Plain | Drive::Fast if role.is_driven_by_device() => "PAL_MODE_INPUT",
        Drive::Plain | Drive::Fast => "PAL_MODE_STM32_ALTERNATE_PUSHPULL",
    }
}
