//! `I2Cv1`: a port for each bus, a thread's table for each bus, cycle time and priority.

use std::collections::BTreeMap;

use askama::Template;
use sensedsl_board::profile::Unit;
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::i2c::{ByteOrder, I2c};
use sensedsl_model::kind::{Kind, KindName, Role};
use sensedsl_timing::i2c_clock::{self, BusClock};

use crate::firmware::chibios::context::{Context, Drive, PadPlan};
use crate::firmware::chibios::names::Setting;
use crate::firmware::chibios::section::{Counter, GuardPlan, STACK_BYTES, Section, Size, Work};
use crate::job::{Cycle, JobDevice};
use crate::print::block;

/// Time for a device to think, beside the bits.
const TIMEOUT_BASE_MS: u32 = 10;
/// Bus clocks that the end of a transfer takes: the last acknowledge, the stop condition, and the
/// time until the next start.
const STOP_CLOCKS: u32 = 4;

#[derive(Template)]
#[template(path = "firmware/chibios/i2c/v1.c.txt", escape = "none")]
struct Tables<'a> {
    s: &'a Buses,
}

/// All buses.
#[derive(Default)]
struct Buses {
    ports: Vec<Port>,
    classes: Vec<Class>,
}

/// One bus.
struct Port {
    index: usize,
    unit: String,
    driver: String,
    scl: PadPlan,
    sda: PadPlan,
    /// The macro of the unit's clock.
    unit_clock: String,
    /// What the devices asked for, where the driver cannot make it.
    asked_hz: Option<u32>,
    clock: BusClock,
    timeout_ms: u32,
    /// How long the end of a transfer can take.
    stop_ms: u32,
}

/// What one thread does on one bus.
struct Class {
    index: usize,
    port: usize,
    unit: String,
    cycle: Cycle,
    devices: Vec<Script>,
    work_bytes: u32,
    /// 64-bit words that hold the largest value.
    scratch_words: usize,
}

/// One device.
struct Script {
    index: usize,
    name: String,
    id: u8,
    /// `0x73U`
    address: String,
    /// Bytes as C literals; empty for none.
    trigger: Vec<String>,
    wait_ms: u32,
    register: Option<String>,
    length: u16,
    is_little_endian: bool,
    value_bytes: usize,
}

/// The devices of one bus.
struct Bus<'a> {
    pads: (PadPlan, PadPlan),
    devices: Vec<(&'a JobDevice<'a>, &'a I2c)>,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut plan = Buses::default();
    for (unit, bus) in buses(context, diagnostics) {
        let Some(facts) = context.profile.unit(unit.as_str()) else { continue };
        let Some(port) = Port::new(context, plan.ports.len(), facts, &bus) else { continue };
        section.pads.extend([port.scl.clone(), port.sda.clone()]);
        let mut classes: BTreeMap<Cycle, Vec<Script>> = BTreeMap::new();
        for (wired, i2c) in &bus.devices {
            let scripts = classes.entry(wired.cycle).or_default();
            scripts.push(Script::new(scripts.len(), wired, i2c));
        }
        for (cycle, devices) in classes {
            plan.classes.push(Class::new(plan.classes.len(), &port, cycle, devices));
        }
        plan.ports.push(port);
        section.units.insert(unit);
    }
    let has_any = context.devices(KindName::I2c).next().is_some();
    section.switch = Some(Setting::new("HAL_USE_I2C", if has_any { "TRUE" } else { "FALSE" }));
    section.hal = vec![Setting::new("I2C_USE_MUTUAL_EXCLUSION", "TRUE")];
    let read_bytes_min = context.profile.i2c.read_bytes_min.to_string();
    section.sizes = vec![Size {
        comment: "The shortest read the I2C driver accepts.",
        setting: Setting::new("UP_I2C_READ_BYTES_MIN", &read_bytes_min),
    }];
    section.mcu.extend(busy(context, &plan));
    section.guards = plan.ports.iter().map(Port::guard).collect();
    section.work = plan.classes.iter().map(Class::work).collect();
    if !plan.ports.is_empty() {
        section.starts = plan
            .ports
            .iter()
            .map(|port| format!("up_i2c_start(&ports[{}]);", port.index))
            .collect();
        section.counters = plan.ports.iter().map(Port::counter).collect();
        section.tables = block(&Tables { s: &plan });
    }
    section
}

/// While a bus is busy the driver holds the processor, and no thread of its priority or a lower one runs.
/// Between two transfers that is the time of a stop condition; all else is a bus that hangs, and will be
/// clocked free. A tick of a millisecond is one more, for the first of them is cut short.
fn busy(context: &Context<'_>, plan: &Buses) -> Option<Setting> {
    let option = context.names.i2cs.busy_option.as_deref()?;
    let stop_ms = plan.ports.iter().map(|port| port.stop_ms).max()?;
    let is_systick = context.kernel_timer.is_none();
    Some(Setting::new(option, &(stop_ms + u32::from(is_systick)).to_string()))
}

fn buses<'a>(
    context: &Context<'a>,
    diagnostics: &mut Vec<Diagnostic>,
) -> BTreeMap<UnitName, Bus<'a>> {
    let mut buses: BTreeMap<UnitName, Bus<'a>> = BTreeMap::new();
    for wired in context.devices(KindName::I2c) {
        let Kind::I2c(i2c) = &wired.device.kind else { continue };
        let Some(unit) = wired.unit.map(UnitName::new) else { continue };
        if let Some(bus) = buses.get_mut(&unit) {
            bus.devices.push((wired, i2c));
            continue;
        }
        let mut pad = |role| context.alternate_pad(wired.pad(role)?, Drive::OpenDrain, diagnostics);
        let (Some(scl), Some(sda)) = (pad(Role::Scl), pad(Role::Sda)) else { continue };
        buses.insert(unit, Bus { pads: (scl, sda), devices: vec![(wired, i2c)] });
    }
    buses
}

impl Port {
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
            driver: context.names.driver(&unit.name)?,
            scl,
            sda,
            unit_clock: unit.clock.clone().unwrap_or_default(),
            asked_hz: (clock.speed_hz != asked_hz).then_some(asked_hz),
            timeout_ms: TIMEOUT_BASE_MS + time_ms(clocks),
            stop_ms: time_ms(STOP_CLOCKS),
            clock,
        })
    }

    fn counter(&self) -> Counter {
        Counter {
            title: format!("{} was freed", self.unit),
            variable: format!("i2c_recoveries[{}]", self.index),
        }
    }

    /// The driver halts the board where its clock leaves something over.
    fn guard(&self) -> GuardPlan {
        let Self { unit, unit_clock, clock, .. } = self;
        let BusClock { speed_hz, clocks, dividers, .. } = clock;
        let steps = format!("({clocks}U * {speed_hz}U)");
        let (least, greatest) = (dividers.start(), dividers.end());
        GuardPlan {
            condition: format!(
                "{unit_clock} % {steps} == 0U && {unit_clock} / {steps} >= {least}U &&\n                   \
                 {unit_clock} / {steps} <= {greatest}U"
            ),
            message: format!("the clock of {unit} does not divide to {speed_hz} Hz"),
        }
    }
}

impl<'a> Bus<'a> {
    /// The slowest device sets the pace of the bus.
    fn slowest(&self) -> Option<&(&'a JobDevice<'a>, &'a I2c)> {
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

impl Class {
    fn new(index: usize, port: &Port, cycle: Cycle, devices: Vec<Script>) -> Self {
        let work = devices.iter().map(|device| u32::from(device.length) + 1);
        let value = devices.iter().map(|device| device.value_bytes.div_ceil(8));
        Self {
            index,
            port: port.index,
            unit: port.unit.clone(),
            cycle,
            work_bytes: work.max().unwrap_or(1),
            scratch_words: value.max().unwrap_or(1),
            devices,
        }
    }

    fn work(&self) -> Work {
        Work {
            unit: self.unit.clone(),
            cycle: self.cycle,
            function: "up_i2c_cycle",
            table: format!("i2c_{}", self.index),
            device: self.devices.first().map_or(0, |one| one.id),
            stack_bytes: STACK_BYTES,
        }
    }

    /// For a comment.
    fn title(&self) -> String {
        self.cycle.title(&self.unit)
    }

    /// For a comment.
    fn names(&self) -> String {
        let names: Vec<&str> = self.devices.iter().map(|device| device.name.as_str()).collect();
        names.join(", ")
    }
}

impl Script {
    fn new(index: usize, wired: &JobDevice<'_>, i2c: &I2c) -> Self {
        let byte = |byte: u8| format!("0x{byte:02x}U");
        Self {
            index,
            name: wired.name().to_owned(),
            id: wired.device.id.value,
            address: byte(i2c.address),
            trigger: i2c.trigger.iter().map(|&value| byte(value)).collect(),
            wait_ms: i2c.wait_us.div_ceil(1_000),
            register: i2c.register.map(|register| format!("0x{register:02x}U")),
            length: i2c.length_bytes,
            is_little_endian: i2c.order == ByteOrder::Little,
            value_bytes: wired.device.value.value.size_bytes(),
        }
    }
}
