//! The processor: the load of threads, interrupts and reports, from the counted instructions.

use std::collections::BTreeMap;

use sensedsl_board::profile::Costs;
use sensedsl_board::signal::UnitName;
use sensedsl_model::design::{Controller, DeviceIndex, Transport};
use sensedsl_model::kind::analog::Analog;
use sensedsl_model::kind::onewire::OneWire;
use sensedsl_model::kind::{Interface, Kind};

use crate::buses::script;
use crate::captures::interrupts;
use crate::context::{Context, Wired};
use crate::link::reports;
use crate::onewire;
use crate::rows::{Count, Cycle, Part, Row, clocks_ns};
use crate::units::MILLISECOND_NS;

/// For pulses of at least this length, the thread sleeps.
const SLEEP_US: u32 = 1_000;

/// Transfers on a bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Transfers {
    /// Transfers, each from a start condition to the stop condition.
    pub(crate) count: u64,
    /// Start conditions; a transfer that writes and then reads has two.
    pub(crate) phases: u64,
    /// Bytes on the bus.
    pub(crate) bytes: u64,
    /// Elements of the value.
    pub(crate) elements: u64,
    /// Bytes of the value.
    pub(crate) value_bytes: u64,
}

/// The cost of work on one board; nothing if it is unknown.
pub(crate) struct Work {
    costs: Option<(Costs, u32)>,
}

pub(crate) fn core_hz(context: &Context<'_>) -> Option<u32> {
    context.clock_hz(&context.board.profile()?.costs.as_ref()?.clock)
}

impl Work {
    pub(crate) fn of(context: &Context<'_>) -> Self {
        let costs = context.board.profile().and_then(|profile| profile.costs.clone());
        Self { costs: costs.zip(core_hz(context)) }
    }

    fn ns(&self, instructions: impl FnOnce(&Costs) -> u64) -> u64 {
        self.costs.as_ref().map_or(0, |(costs, hz)| time_ns(costs, *hz, instructions(costs)))
    }

    /// The processor time of one step of a motor.
    pub(crate) fn of_step(&self) -> u64 {
        self.ns(|costs| u64::from(costs.step))
    }

    /// The processor time that a thread needs for a group of analog sensors.
    pub(crate) fn of_converter(&self, sensors: &[Analog]) -> u64 {
        self.ns(|costs| converter(costs, sensors.iter().map(|sensor| sensor.samples)))
    }

    /// The processor time that a thread needs for devices on a bus.
    pub(crate) fn of_bus(&self, devices: impl Iterator<Item = Transfers>) -> u64 {
        self.ns(|costs| u64::from(costs.wake) + bus(costs, devices))
    }
}

fn time_ns(costs: &Costs, hz: u32, instructions: u64) -> u64 {
    let cycles = instructions.saturating_mul(u64::from(costs.cycles_per_hundred)).div_ceil(100);
    clocks_ns(cycles, hz)
}

fn converter(costs: &Costs, samples: impl Iterator<Item = u16>) -> u64 {
    let of_sensors: u64 = samples
        .map(|samples| {
            u64::from(costs.convert_value) + u64::from(samples) * u64::from(costs.convert_sample)
        })
        .sum();
    u64::from(costs.wake) + u64::from(costs.convert) + of_sensors
}

fn bus(costs: &Costs, devices: impl Iterator<Item = Transfers>) -> u64 {
    devices
        .map(|transfers| {
            u64::from(costs.bus_device)
                + transfers.count * u64::from(costs.bus_transfer)
                + transfers.phases * u64::from(costs.bus_phase)
                + transfers.elements * u64::from(costs.bus_element)
                + transfers.value_bytes * u64::from(costs.bus_byte)
        })
        .sum()
}

/// A thread: its name, its cycle, the devices it serves, and its instructions per second.
struct Thread {
    name: String,
    cycle: Cycle,
    devices: Vec<DeviceIndex>,
    /// Most instructions of one cycle, if known.
    cycle_instructions: Option<u64>,
    instructions: Option<u64>,
    /// Time per cycle in which it waits without releasing the processor.
    held_ns: u64,
    /// Time per cycle in which it sleeps.
    slept_ns: u64,
    has_pulses: bool,
}

/// The work of one class.
#[derive(Default)]
struct Load {
    devices: Vec<DeviceIndex>,
    samples: Vec<u16>,
    /// Transfers, each with the milliseconds between two of them.
    transfers: Vec<(Transfers, u32)>,
    /// The lengths of the pulses.
    pulses_us: Vec<u32>,
    /// The time in which the bits of wires are made.
    bits_ns: u64,
    /// True if the runtime has no thread for some of the work.
    is_unknown: bool,
}

fn threads(context: &Context<'_>, costs: Option<&Costs>) -> Vec<Thread> {
    let mut loads: BTreeMap<(UnitName, Cycle), Load> = BTreeMap::new();
    for wired in &context.elements {
        let kind = &wired.device.kind;
        if kind.measures_itself() {
            continue;
        }
        let of_kind = || wired.wiring.unit.as_deref().unwrap_or(kind.name().name());
        let pin = onewire::wire(context, wired);
        let of_kind = || pin.as_ref().map_or_else(of_kind, UnitName::as_str);
        let unit = if kind.pulse_us().is_some() { "pulse" } else { of_kind() };
        let load = loads.entry((UnitName::new(unit), context.cycle(wired))).or_default();
        load.devices.push(wired.index);
        load.devices.dedup();
        match kind.interface() {
            Interface::Analog(analog) => load.samples.push(analog.samples),
            Interface::Icu(icu) => load.pulses_us.extend(icu.pulse_us),
            Interface::I2c(_) => {
                let script = script(context, wired);
                load.transfers.extend(script.map(|script| (script.transfers, script.every_ms)));
            }
            Interface::Encoder(_)
            | Interface::Digital(_)
            | Interface::Uart(_)
            | Interface::Spi(_)
            | Interface::Pwm(_)
            | Interface::Dac(_)
            | Interface::Can(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => load.is_unknown = true,
            Interface::OneWire(own) => {
                load.transfers.push((of_wire(wired, own), wired.device.delay_ms));
                let is_read = onewire::read(context).any(|other| other.index == wired.index);
                load.bits_ns += if is_read { onewire::held_ns(own) } else { 0 };
            }
        }
    }
    loads.into_iter().map(|((unit, cycle), load)| load.thread(&unit, cycle, costs)).collect()
}

/// What a part on one wire costs besides its bits: as much as one on a bus.
fn of_wire(wired: &Wired<'_>, own: &OneWire) -> Transfers {
    let count = 1 + u64::from(!own.trigger.is_empty());
    let elements = wired.device.value.value.count() as u64;
    let bytes = u64::from(own.answer_bytes());
    Transfers { count, phases: count + 1, bytes, elements, value_bytes: own.length_bytes.into() }
}

impl Load {
    fn thread(self, unit: &UnitName, cycle: Cycle, costs: Option<&Costs>) -> Thread {
        let costs = costs.filter(|_| !self.is_unknown);
        let instructions = costs.map(|costs| {
            let pulses = self.pulses_us.len() as u64 * u64::from(costs.pulse);
            let transfers = || self.transfers.iter().map(|(transfers, _)| *transfers);
            let each = if self.samples.is_empty() {
                u64::from(costs.wake) + pulses
            } else {
                converter(costs, self.samples.iter().copied())
            };
            // A device is checked each cycle, and communicated with when it is ready.
            let looked = self.transfers.len() as u64 * u64::from(costs.bus_device);
            let talked: u64 = self
                .transfers
                .iter()
                .map(|(transfers, every_ms)| {
                    let once =
                        bus(costs, std::iter::once(*transfers)) - u64::from(costs.bus_device);
                    once * 1_000 / u64::from((*every_ms).max(1))
                })
                .sum();
            let cycles = 1_000.0_f64 / f64::from(cycle.delay_ms.max(1));
            let often = |instructions: u64| times(instructions, cycles);
            (each + bus(costs, transfers()), often(each + looked) + talked)
        });
        let (held_us, slept_us): (Vec<u32>, Vec<u32>) =
            self.pulses_us.iter().partition(|us| **us < SLEEP_US);
        let ns = |us: &[u32]| us.iter().map(|us| u64::from(*us) * 1_000).sum();
        Thread {
            name: name(unit.as_str(), cycle),
            cycle,
            devices: self.devices,
            cycle_instructions: instructions.map(|(cycle, _)| cycle),
            instructions: instructions.map(|(_, second)| second),
            held_ns: ns(&held_us) + self.bits_ns,
            slept_ns: ns(&slept_us),
            has_pulses: !self.pulses_us.is_empty(),
        }
    }
}

/// The name of a thread, without its cycle: its unit, its priority, and its start if that is not 0.
/// Without a unit, it has the name of its work.
fn name(unit: &str, cycle: Cycle) -> String {
    let has_number = unit.ends_with(|c: char| c.is_ascii_digit());
    let unit = if has_number { unit.to_owned() } else { unit.to_lowercase() };
    cycle.named(&unit)
}

fn times(instructions: u64, cycles: f64) -> u64 {
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "instructions of a second are far below 2^53"
    )]
    let all = (instructions as f64 * cycles).ceil() as u64;
    all
}

/// The reporter's instructions per second.
fn reporter(context: &Context<'_>, costs: &Costs) -> u64 {
    let reports = reports(context);
    let cycles = 1_000_u64.div_ceil(u64::from(reports.cycle_ms.max(1)));
    let is_capture = |kind: &Kind| kind.name().spec().triggers_itself;
    let captures = context.elements.iter().filter(|wired| is_capture(&wired.device.kind)).count();
    let mut instructions = cycles
        * (u64::from(costs.report) + captures as u64 * u64::from(costs.capture_look))
        + reports.count * u64::from(costs.report_frame)
        + reports.values * u64::from(costs.report_value)
        + reports.bytes * u64::from(costs.report_byte);
    if context.board.link.transport == Transport::Uart {
        instructions += reports.count * u64::from(costs.serial_frame)
            + reports.bytes * u64::from(costs.serial_byte);
    }
    instructions
}

pub(crate) fn rows(context: &Context<'_>, work: &Work) -> Vec<Row> {
    let costs = work.costs.as_ref();
    let ns = |instructions: u64| costs.map(|(costs, hz)| time_ns(costs, *hz, instructions));
    let mut rows = Vec::new();
    for thread in threads(context, costs.map(|(costs, _)| costs)) {
        let mut row = Row::new(Part::Thread, thread.name, thread.devices);
        let held_ns = crate::rows::per_second(thread.held_ns, thread.cycle.delay_ms);
        row.cycle = Some(thread.cycle);
        row.a_second = thread.instructions.map(Count::Instructions);
        row.cycle_ns = thread.cycle_instructions.and_then(ns).map(|ns| ns + thread.held_ns);
        row.busy_ns = thread.instructions.and_then(ns).map(|ns| ns + held_ns);
        let waits_ns =
            row.cycle_ns.map(|ns| (ns + thread.slept_ns).div_ceil(MILLISECOND_NS).max(1));
        row.shortest_ms =
            waits_ns.filter(|_| thread.has_pulses).and_then(|ms| u32::try_from(ms).ok());
        rows.push(row);
    }
    let mut row = Row::new(Part::Thread, "reporter", Vec::new());
    let report_ms = reports(context).cycle_ms;
    row.cycle = Some(Cycle { delay_ms: report_ms, prio: 0, start_ms: 0 });
    let instructions = costs.map(|(costs, _)| reporter(context, costs));
    row.a_second = instructions.map(Count::Instructions);
    row.busy_ns = instructions.and_then(ns);
    rows.push(row);
    rows.extend(of_controllers(context));
    rows.extend(of_captures(context, costs));
    rows.extend(crate::steps::thread(context, costs.map(|(costs, _)| costs), &ns));
    // The sum is unknown if the busy time of any row is. Captures with an unknown rate have no row.
    let busy = rows.iter().map(|row| row.busy_ns).collect::<Option<Vec<u64>>>();
    let mut row = Row::new(Part::Processor, "all of it", Vec::new());
    row.clock_hz = core_hz(context);
    row.busy_ns = busy.map(|busy| busy.into_iter().fold(0, u64::saturating_add));
    rows.push(row);
    rows
}

/// The user's code: how long a step may take, as far as the file says.
fn of_controllers(context: &Context<'_>) -> Vec<Row> {
    let design = context.design;
    let own = design.controllers.iter().filter(|one| {
        design.board(one.board).is_some_and(|board| board.name.span == context.board.name.span)
    });
    let row = |one: &Controller| {
        let device = design.device(one.device)?;
        let mut row = Row::new(Part::Thread, device.name.value.as_str(), vec![one.device]);
        row.cycle = Some(Cycle { delay_ms: one.every_ms, prio: device.prio, start_ms: 0 });
        row.cycle_ns = one.takes_us.map(|us| u64::from(us) * 1_000);
        row.busy_ns = row.cycle_ns.map(|ns| crate::rows::per_second(ns, one.every_ms));
        Some(row)
    };
    own.filter_map(row).collect()
}

/// All captures whose rate is known.
fn of_captures(context: &Context<'_>, costs: Option<&(Costs, u32)>) -> Option<Row> {
    let known: Vec<(DeviceIndex, u64)> = context
        .elements
        .iter()
        .filter_map(|wired| Some((wired.index, interrupts(wired.device)?)))
        .collect();
    if known.is_empty() {
        return None;
    }
    let mut devices: Vec<DeviceIndex> = known.iter().map(|(index, _)| *index).collect();
    devices.dedup();
    let all: u64 = known.iter().map(|(_, count)| count).sum();
    let mut row = Row::new(Part::Thread, "captures", devices);
    row.a_second = costs.map(|(costs, _)| Count::Instructions(all * u64::from(costs.capture)));
    row.busy_ns = costs.map(|(costs, hz)| time_ns(costs, *hz, all * u64::from(costs.capture)));
    Some(row)
}
