//! Devices on I2C buses: a port for each bus, a thread's table for each bus, cycle time and priority.

use std::collections::BTreeMap;

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit;
use sensedsl_model::kind::i2c::{ByteOrder, I2c};
use sensedsl_model::kind::{Kind, Role};
use sensedsl_wire::Direction;

use super::context::{Context, Drive, PadPlan, Wired};
use super::tasks::Cycle;

/// From here on the fast mode's duty cycle is used.
const STANDARD_MODE_MAX_HZ: u32 = 100_000;
/// Time for a device to think, beside the bits.
const TIMEOUT_BASE_MS: u32 = 10;
/// Widest number the runtime takes from a device.
const ELEMENT_BYTES_MAX: usize = 8;

/// All buses.
#[derive(Clone, Debug)]
pub(super) struct I2cPlan {
    pub(super) ports: Vec<PortPlan>,
    pub(super) classes: Vec<ClassPlan>,
}

/// One bus.
#[derive(Clone, Debug)]
pub(super) struct PortPlan {
    pub(super) index: usize,
    pub(super) unit: String,
    pub(super) driver: String,
    pub(super) scl: PadPlan,
    pub(super) sda: PadPlan,
    pub(super) speed_hz: u32,
    pub(super) duty: &'static str,
    pub(super) timeout_ms: u32,
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
    let mut plan = I2cPlan { ports: Vec::new(), classes: Vec::new() };
    for (unit, bus) in buses(context, diagnostics) {
        let Some(facts) = context.profile.unit(unit.as_str()) else { continue };
        let port = PortPlan::new(context, plan.ports.len(), &unit, facts.driver.clone(), &bus);
        pads.extend([port.scl.clone(), port.sda.clone()]);
        let mut classes: BTreeMap<Cycle, Vec<ScriptPlan>> = BTreeMap::new();
        for (wired, i2c) in &bus.devices {
            diagnostics.extend(impossible_length(wired, i2c));
            let scripts = classes.entry(Cycle::of(unit.as_str(), wired.device)).or_default();
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

/// The bytes of a device must make whole elements that a value can hold.
fn impossible_length(wired: &Wired<'_>, i2c: &I2c) -> Option<Diagnostic> {
    let value = wired.device.value.value;
    let length = usize::from(i2c.length_bytes);
    let element = length.checked_div(value.count()).unwrap_or_default();
    let element_max = match wired.device.direction {
        Direction::Sensor => ELEMENT_BYTES_MAX,
        Direction::Actuator => value.scalar.size_bytes(),
    };
    if element > 0 && element <= element_max && element * value.count() == length {
        return None;
    }
    let name = &wired.device.name.value;
    let message = format!("{length} bytes of {name} do not make a {value}");
    let help = format!("each element takes 1 to {element_max} bytes: change `length` or the type");
    Some(e0506_hardware_limit::hardware_limit(wired.device.value.span, &message, &help))
}

impl PortPlan {
    fn new(
        context: &Context<'_>,
        index: usize,
        unit: &UnitName,
        driver: String,
        bus: &Bus<'_>,
    ) -> Self {
        // The slowest device sets the pace of the bus.
        let speeds = bus.devices.iter().map(|(_, i2c)| i2c.speed_hz);
        let speed_hz = speeds.min().unwrap_or(STANDARD_MODE_MAX_HZ);
        let speed_hz = speed_hz.min(context.profile.i2c.speed_max_hz);
        let bytes = bus.devices.iter().map(|(_, i2c)| {
            u32::from(i2c.length_bytes).max(u32::try_from(i2c.trigger.len()).unwrap_or(u32::MAX))
        });
        // Two addresses and a register go with them; nine clocks a byte, twice the time is patience.
        let clocks = bytes.max().unwrap_or(0).saturating_add(3).saturating_mul(9 * 2 * 1_000);
        let (scl, sda) = bus.pads.clone();
        Self {
            index,
            unit: unit.as_str().to_owned(),
            driver,
            scl,
            sda,
            speed_hz,
            duty: if speed_hz > STANDARD_MODE_MAX_HZ {
                "FAST_DUTY_CYCLE_2"
            } else {
                "STD_DUTY_CYCLE"
            },
            timeout_ms: TIMEOUT_BASE_MS + clocks.div_ceil(speed_hz.max(1)),
        }
    }
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
