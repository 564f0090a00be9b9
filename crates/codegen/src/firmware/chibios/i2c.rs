//! Devices on I2C buses: a port for each bus, a thread's table for each bus, cycle time and priority.

use std::collections::BTreeMap;

use sensedsl_board::profile::Unit;
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::i2c::{ByteOrder, I2c};
use sensedsl_model::kind::{Kind, Role};
use sensedsl_timing::i2c_clock::{self, BusClock};

use super::context::{Context, Drive, PadPlan, Wired};
use super::tasks::Cycle;

/// Time for a device to think, beside the bits.
const TIMEOUT_BASE_MS: u32 = 10;
/// Bus clocks that the end of a transfer takes: the last acknowledge, the stop condition, and the
/// time until the next start.
const STOP_CLOCKS: u32 = 4;

/// All buses.
#[derive(Clone, Debug)]
pub(super) struct I2cPlan {
    pub(super) ports: Vec<PortPlan>,
    pub(super) classes: Vec<ClassPlan>,
    /// The shortest read the driver accepts.
    pub(super) read_bytes_min: u8,
}

/// One bus.
#[derive(Clone, Debug)]
pub(super) struct PortPlan {
    pub(super) index: usize,
    pub(super) unit: String,
    pub(super) driver: String,
    pub(super) scl: PadPlan,
    pub(super) sda: PadPlan,
    /// The macro of the unit's clock.
    pub(super) unit_clock: String,
    /// What the devices asked for, where the driver cannot make it.
    pub(super) asked_hz: Option<u32>,
    pub(super) clock: BusClock,
    pub(super) timeout_ms: u32,
    /// How long the end of a transfer can take.
    pub(super) stop_ms: u32,
}

/// What one thread does on one bus.
#[derive(Clone, Debug)]
pub(super) struct ClassPlan {
    pub(super) index: usize,
    pub(super) port: usize,
    pub(super) cycle: Cycle,
    pub(super) devices: Vec<ScriptPlan>,
    pub(super) work_bytes: u32,
    /// 64-bit words that hold the largest value.
    pub(super) scratch_words: usize,
}

/// One device.
#[derive(Clone, Debug)]
pub(super) struct ScriptPlan {
    pub(super) index: usize,
    pub(super) name: String,
    /// `0x73U`
    pub(super) address: String,
    /// Bytes as C literals; empty for none.
    pub(super) trigger: Vec<String>,
    pub(super) wait_ms: u32,
    pub(super) register: Option<String>,
    pub(super) length: u16,
    pub(super) is_little_endian: bool,
    value_bytes: usize,
}

/// The devices of one bus.
struct Bus<'a> {
    pads: (PadPlan, PadPlan),
    devices: Vec<(Wired<'a>, &'a I2c)>,
}

pub(super) fn plan(
    context: &Context<'_>,
    pads: &mut Vec<PadPlan>,
    diagnostics: &mut Vec<Diagnostic>,
) -> I2cPlan {
    let read_bytes_min = context.profile.i2c.read_bytes_min;
    let mut plan = I2cPlan { ports: Vec::new(), classes: Vec::new(), read_bytes_min };
    for (unit, bus) in buses(context, diagnostics) {
        let Some(facts) = context.profile.unit(unit.as_str()) else { continue };
        let Some(port) = PortPlan::new(context, plan.ports.len(), facts, &bus) else { continue };
        pads.extend([port.scl.clone(), port.sda.clone()]);
        let mut classes: BTreeMap<Cycle, Vec<ScriptPlan>> = BTreeMap::new();
        for (wired, i2c) in &bus.devices {
            let scripts = classes.entry(context.cycle(unit.as_str(), wired)).or_default();
            scripts.push(ScriptPlan::new(scripts.len(), wired, i2c));
        }
        for (cycle, devices) in classes {
            plan.classes.push(ClassPlan::new(plan.classes.len(), port.index, cycle, devices));
        }
        plan.ports.push(port);
    }
    plan
}

fn buses<'a>(
    context: &Context<'a>,
    diagnostics: &mut Vec<Diagnostic>,
) -> BTreeMap<UnitName, Bus<'a>> {
    let mut buses: BTreeMap<UnitName, Bus<'a>> = BTreeMap::new();
    for &wired in &context.devices {
        let Kind::I2c(i2c) = &wired.device.kind else { continue };
        let Some(unit) = wired.wiring.unit.as_deref() else { continue };
        let unit = UnitName::new(unit);
        if let Some(bus) = buses.get_mut(&unit) {
            bus.devices.push((wired, i2c));
            continue;
        }
        let mut pad = |role| {
            let wire = context.wire(&wired, role)?;
            context.alternate_pad(wire, Drive::OpenDrain, diagnostics)
        };
        let (Some(scl), Some(sda)) = (pad(Role::Scl), pad(Role::Sda)) else { continue };
        let devices = vec![(wired, i2c)];
        buses.insert(unit, Bus { pads: (scl, sda), devices });
    }
    buses
}

impl PortPlan {
    fn new(context: &Context<'_>, index: usize, unit: &Unit, bus: &Bus<'_>) -> Option<Self> {
        let asked_hz = bus.asked_hz(context);
        let clock = bus_clock(context, unit, asked_hz)?;
        let bytes = bus.devices.iter().map(|(_, i2c)| {
            u32::from(i2c.length_bytes).max(u32::try_from(i2c.trigger.len()).unwrap_or(u32::MAX))
        });
        let time_ms = |clocks: u32| clocks.saturating_mul(1_000).div_ceil(clock.speed_hz.max(1));
        // Two addresses and a register go with them; nine clocks a byte, twice the time is patience.
        let clocks = bytes.max().unwrap_or(0).saturating_add(3).saturating_mul(9 * 2);
        let (scl, sda) = bus.pads.clone();
        Some(Self {
            index,
            unit: unit.name.clone(),
            driver: unit.driver.clone(),
            scl,
            sda,
            unit_clock: unit.clock.clone().unwrap_or_default(),
            asked_hz: (clock.speed_hz != asked_hz).then_some(asked_hz),
            timeout_ms: TIMEOUT_BASE_MS + time_ms(clocks),
            stop_ms: time_ms(STOP_CLOCKS),
            clock,
        })
    }
}

impl<'a> Bus<'a> {
    /// The slowest device sets the pace of the bus.
    fn slowest(&self) -> Option<&(Wired<'a>, &'a I2c)> {
        self.devices.iter().min_by_key(|(_, i2c)| i2c.speed_hz)
    }

    fn asked_hz(&self, context: &Context<'_>) -> u32 {
        let speed_max_hz = context.profile.i2c.speed_max_hz;
        self.slowest().map_or(speed_max_hz, |(_, i2c)| i2c.speed_hz.min(speed_max_hz))
    }
}

/// The clock that a bus gets; none where there is none, which [`sensedsl_timing::refusals`] has told.
fn bus_clock(context: &Context<'_>, unit: &Unit, asked_hz: u32) -> Option<BusClock> {
    let unit_hz = *context.chibios.clocks_hz.get(unit.clock.as_deref()?)?;
    i2c_clock::fastest(&context.profile.i2c, unit_hz, asked_hz)
}

impl ClassPlan {
    fn new(index: usize, port: usize, cycle: Cycle, devices: Vec<ScriptPlan>) -> Self {
        let work = devices.iter().map(|device| u32::from(device.length) + 1);
        let value = devices.iter().map(|device| device.value_bytes.div_ceil(8));
        Self {
            index,
            port,
            cycle,
            work_bytes: work.max().unwrap_or(1),
            scratch_words: value.max().unwrap_or(1),
            devices,
        }
    }

    /// For a comment.
    pub(super) fn names(&self) -> String {
        let names: Vec<&str> = self.devices.iter().map(|device| device.name.as_str()).collect();
        names.join(", ")
    }
}

impl ScriptPlan {
    fn new(index: usize, wired: &Wired<'_>, i2c: &I2c) -> Self {
        let byte = |byte: u8| format!("0x{byte:02x}U");
        Self {
            index,
            name: wired.device.name.value.clone(),
            address: byte(i2c.address),
            trigger: i2c.trigger.iter().map(|&value| byte(value)).collect(),
            wait_ms: i2c.wait_us.div_ceil(1_000),
            register: i2c.register.map(byte),
            length: i2c.length_bytes,
            is_little_endian: i2c.order == ByteOrder::Little,
            value_bytes: wired.device.value.value.size_bytes(),
        }
    }
}
