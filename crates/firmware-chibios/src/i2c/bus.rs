//! What all versions of the driver have in common: a port for each bus, and a thread's table for each bus and cycle.

use std::collections::BTreeMap;

use askama::Template;
use sensedsl_board::profile::Unit;
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit::hardware_limit;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_timing::i2c_clock::{self, BusClock};

use crate::chips;
use crate::context::{Context, Drive, PadPlan};
use crate::names::Setting;
use crate::section::{Counter, GuardPlan, Probe, Section, Size};
use sensedsl_files::block;
use sensedsl_job::snake;
use sensedsl_job::{JobConnection, by_unit};

/// The time that a device may need besides the bits.
const TIMEOUT_BASE_MS: u32 = 10;
/// Bus clocks at the end of a transfer: the last acknowledge, the stop condition, and the
/// time until the next start.
const STOP_CLOCKS: u32 = 4;

/// How a version of the driver is given its clock.
pub(super) struct Version {
    /// The members of `I2CConfig`, one per line.
    pub(super) config: fn(&BusClock) -> Vec<String>,
    /// A condition on the unit's clock, if the driver requires more than its frequency.
    pub(super) guard: fn(&Port) -> Option<GuardPlan>,
}

#[derive(Template)]
#[template(path = "i2c/bus.c.txt", escape = "none")]
struct Tables<'a> {
    p: &'a Port,
    config: Vec<String>,
    threads: String,
}

/// One bus.
pub(super) struct Port {
    ident: String,
    pub(super) unit: String,
    driver: String,
    scl: PadPlan,
    sda: PadPlan,
    /// The macro for the unit's clock.
    pub(super) unit_clock: String,
    /// The speed that the devices allow, if the driver cannot make exactly that.
    asked_hz: Option<u32>,
    pub(super) clock: BusClock,
    timeout_ms: u32,
    /// The longest duration of the end of a transfer.
    stop_ms: u32,
}

/// The connections of each bus.
type Buses<'a> = BTreeMap<UnitName, Vec<&'a JobConnection<'a>>>;

pub(super) fn plan(
    context: &Context<'_>,
    version: &Version,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    let mut ports = Vec::new();
    for (unit, on_bus) in buses(context) {
        let port = context.profile.unit(unit.as_str());
        let port = port.and_then(|facts| Port::new(context, facts, &on_bus, diagnostics));
        let Some(port) = port else { continue };
        section.pads.extend([port.scl.clone(), port.sda.clone()]);
        let threads = chips::threads(context, unit.as_str(), &on_bus);
        section.work.extend(threads.iter().map(chips::Thread::work));
        let config = (version.config)(&port.clock);
        let threads = chips::tables(&threads);
        let tables = block(&Tables { p: &port, config, threads });
        section.tables.push_str(if section.tables.is_empty() { "" } else { "\n\n" });
        section.tables.push_str(tables.trim_start());
        section.probes.push(probe(context, &port, &on_bus));
        section.units.insert(unit);
        ports.push(port);
    }
    let truth = if ports.is_empty() { "FALSE" } else { "TRUE" };
    section.switch = Some(Setting::new("HAL_USE_I2C", truth));
    section.hal = vec![Setting::new("I2C_USE_MUTUAL_EXCLUSION", "TRUE")];
    let read_bytes_min = context.profile.i2c.read_bytes_min.to_string();
    section.sizes = vec![Size {
        comment: "The shortest read the I2C driver accepts.",
        setting: Setting::new("UP_I2C_READ_BYTES_MIN", &read_bytes_min),
    }];
    section.mcu.extend(busy(context, &ports));
    section.guards.extend(ports.iter().filter_map(version.guard));
    section.guards.extend(ports.iter().filter_map(|port| port.source(context)));
    section.clocks = ports.iter().map(|port| port.unit_clock.clone()).collect();
    section.starts =
        ports.iter().map(|port| format!("up_i2c_start(&{}_port);", port.ident)).collect();
    section.counters = ports.iter().flat_map(Port::counters).collect();
    section
}

/// The addresses of the devices, for the self test.
fn probe(context: &Context<'_>, port: &Port, on_bus: &[&JobConnection<'_>]) -> Probe {
    let plans = on_bus.iter().filter_map(|one| chips::plan_of(context.job, one));
    let mut expected: Vec<u8> = plans.map(|plan| plan.address).collect();
    expected.sort();
    expected.dedup();
    Probe {
        title: port.unit.clone(),
        function: "up_i2c_answers",
        table: format!("{}_port", port.ident),
        expected,
    }
}

/// While a bus is busy, the driver blocks the processor, and no thread of the same or a lower priority runs. The
/// runtime checks the bus before, so that this takes no longer than a stop condition. With a tick of a millisecond, one
/// more is added, because the first is cut short.
fn busy(context: &Context<'_>, ports: &[Port]) -> Option<Setting> {
    let option = context.names.i2cs.busy_option.as_deref()?;
    let stop_ms = ports.iter().map(|port| port.stop_ms).max()?;
    let is_systick = context.kernel_timer.is_none();
    Some(Setting::new(option, &(stop_ms + u32::from(is_systick)).to_string()))
}

fn buses<'a>(context: &Context<'a>) -> Buses<'a> {
    by_unit(context.connections(KindName::I2c))
}

impl Port {
    fn new(
        context: &Context<'_>,
        unit: &Unit,
        on_bus: &[&JobConnection<'_>],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let mut pad = |role| {
            let pad = on_bus.first()?.pad(role)?;
            context.alternate_pad(pad, Drive::OpenDrain, diagnostics)
        };
        let (scl, sda) = (pad(Role::Scl)?, pad(Role::Sda)?);
        let asked_hz = asked_hz(context, on_bus);
        let clock = bus_clock(context, unit, on_bus, asked_hz, diagnostics)?;
        let plans = on_bus.iter().filter_map(|one| chips::plan_of(context.job, one));
        let bytes = plans.map(|plan| u32::try_from(plan.work_bytes).unwrap_or(u32::MAX)).max();
        let time_ms = |clocks: u32| clocks.saturating_mul(1_000).div_ceil(clock.speed_hz.max(1));
        // Two addresses are added; nine clocks per byte, and twice the time as a margin.
        let clocks = bytes.unwrap_or(0).saturating_add(2).saturating_mul(9 * 2);
        Some(Self {
            ident: snake(&unit.name),
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

    fn counters(&self) -> [Counter; 2] {
        let counter = |what: &str, member: &str| Counter {
            title: format!("{} {what}", self.unit),
            variable: format!("{}_state.{member}", self.ident),
        };
        [counter("was freed", "freed"), counter("stayed stuck", "kept")]
    }

    /// If the tree has no constant for the unit's clock, the selection of its source is compared instead.
    fn source(&self, context: &Context<'_>) -> Option<GuardPlan> {
        let [option, value] = context.names.clock_source(&self.unit)?;
        Some(GuardPlan {
            condition: format!("{option} == {value}"),
            message: format!("the clock of {} is not what this wiring was made for", self.unit),
        })
    }
}

/// The slowest device sets the pace of the bus.
fn asked_hz(context: &Context<'_>, on_bus: &[&JobConnection<'_>]) -> u32 {
    let speeds = on_bus.iter().filter_map(|one| one.connection.kind.i2c()).map(|one| one.speed_hz);
    speeds.chain([context.profile.i2c.speed_max_hz]).min().unwrap_or(0)
}

/// The clock of a bus; `None` if there is none, which [`sensedsl_timing::refusals`] has reported, or if nothing is
/// known of the unit's clock.
fn bus_clock(
    context: &Context<'_>,
    unit: &Unit,
    on_bus: &[&JobConnection<'_>],
    asked_hz: u32,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<BusClock> {
    let clocks_hz = &context.chibios.clocks_hz;
    let unit_hz = unit.clock.as_deref().and_then(|clock| clocks_hz.get(clock));
    let Some(unit_hz) = unit_hz else {
        let span = on_bus.first()?.part.name.span;
        let message = format!("the clock of {} is not known on this board", unit.name);
        diagnostics.push(hardware_limit(span, &message, "take another unit: `avoid unit = …;`"));
        return None;
    };
    i2c_clock::fastest(&context.profile.i2c, *unit_hz, asked_hz)
}
