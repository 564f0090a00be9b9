//! What all versions of the driver have in common: a port for each bus with its chip selects, and a thread's table for
//! each bus and cycle.

use std::collections::BTreeMap;

use askama::Template;
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit::hardware_limit;
use sensedsl_model::design::PartIndex;
use sensedsl_model::kind::spi::Spi;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_timing::{power_of_two, spi_divider};

use crate::chips;
use crate::context::{Context, Drive, PadPlan};
use crate::names::Setting;
use crate::section::Section;
use sensedsl_files::block;
use sensedsl_job::snake;
use sensedsl_job::{BoardJob, JobConnection, by_unit};

/// The time for interrupts and other threads, besides the bits.
const TIMEOUT_BASE_MS: u32 = 10;

/// The clock of a device.
pub(super) struct Clock {
    /// How often the unit's clock is halved, at least once.
    pub(super) halvings: u32,
    /// True if the clock is high between transfers.
    pub(super) is_idle_high: bool,
    /// True if data are sampled at the second edge.
    pub(super) is_second_edge: bool,
}

/// The members of `SPIConfig` for a clock, one per line.
pub(super) type Config = fn(&Clock) -> Vec<String>;

#[derive(Template)]
#[template(path = "spi/bus.c.txt", escape = "none")]
struct Tables<'a> {
    p: &'a Port,
    threads: String,
}

/// One bus.
struct Port {
    ident: String,
    unit: String,
    driver: String,
    unit_clock: String,
    /// SCK, MISO and MOSI, as far as they are wired.
    wires: Vec<String>,
    selects: Vec<Select>,
    timeout_ms: u32,
}

/// One chip select.
struct Select {
    /// `Imu: PA4, mode 3, 656250 Hz`
    title: String,
    line: String,
    config: Vec<String>,
}

/// The connections of each bus.
type Buses<'a> = BTreeMap<UnitName, Vec<&'a JobConnection<'a>>>;

pub(super) fn plan(
    context: &Context<'_>,
    config: Config,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    let mut ports = Vec::new();
    for (unit, on_bus) in buses(context.job) {
        let port = Port::new(context, &unit, &on_bus, config, diagnostics);
        let Some(port) = port else { continue };
        section.pads.extend(pads(context, &on_bus, diagnostics));
        let threads = chips::threads(context, unit.as_str(), &on_bus);
        section.work.extend(threads.iter().map(chips::Thread::work));
        let tables = block(&Tables { p: &port, threads: chips::tables(&threads) });
        section.tables.push_str(if section.tables.is_empty() { "" } else { "\n\n" });
        section.tables.push_str(&tables);
        section.units.insert(unit);
        ports.push(port);
    }
    let truth = if ports.is_empty() { "FALSE" } else { "TRUE" };
    section.switch = Some(Setting::new("HAL_USE_SPI", truth));
    section.hal = vec![
        Setting::new("SPI_USE_WAIT", "TRUE"),
        Setting::new("SPI_USE_MUTUAL_EXCLUSION", "TRUE"),
        Setting::new("SPI_SELECT_MODE", "SPI_SELECT_MODE_LINE"),
        // A failed transfer is reported for its device and must not halt the board.
        Setting::new("SPI_USE_ASSERT_ON_ERROR", "FALSE"),
    ];
    section.clocks = ports.iter().map(|port| port.unit_clock.clone()).collect();
    section.starts =
        ports.iter().map(|port| format!("up_spi_start(&{}_port);", port.ident)).collect();
    section
}

fn buses<'a>(job: &'a BoardJob<'a>) -> Buses<'a> {
    by_unit(job.connections(KindName::Spi))
}

/// The number of a part's chip select on its bus.
pub(crate) fn number_of(job: &BoardJob<'_>, part: PartIndex) -> Option<u8> {
    let buses = buses(job);
    let mut all = buses.values();
    let number =
        all.find_map(|on_bus| on_bus.iter().position(|one| one.connection.part == part))?;
    u8::try_from(number).ok()
}

/// The wires of the bus, and the chip selects, which are high before they become outputs.
fn pads(
    context: &Context<'_>,
    on_bus: &[&JobConnection<'_>],
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<PadPlan> {
    let mut pads = Vec::new();
    for pad in on_bus.iter().flat_map(|one| &one.pads) {
        if pad.role == Role::Cs {
            let select = context.pad(pad, "PAL_MODE_OUTPUT_PUSHPULL", diagnostics);
            pads.extend(select.map(|select| PadPlan { is_high: true, ..select }));
        } else {
            pads.extend(context.alternate_pad(pad, Drive::Fast, diagnostics));
        }
    }
    pads
}

impl Port {
    fn new(
        context: &Context<'_>,
        unit: &UnitName,
        on_bus: &[&JobConnection<'_>],
        config: Config,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let unit = context.profile.unit(unit.as_str())?;
        let first = on_bus.first()?;
        let clocks_hz = &context.chibios.clocks_hz;
        let Some(unit_hz) = unit.clock.as_deref().and_then(|clock| clocks_hz.get(clock)) else {
            let message = format!("the clock of {} is not known on this board", unit.name);
            let help = "take another unit: `avoid unit = …;`";
            diagnostics.push(hardware_limit(first.part.name.span, &message, help));
            return None;
        };
        let mut timeout_ms = 0;
        let mut selects = Vec::new();
        for one in on_bus {
            let spi = one.connection.kind.spi()?;
            // A clock that is too slow for the unit has been reported with the timing.
            let plan = chips::plan_of(context.job, one);
            let clock_hz = plan.and_then(|plan| plan.clock_hz).unwrap_or(spi.clock_hz);
            let divider = spi_divider(context.profile, *unit_hz, clock_hz)?;
            let bytes = plan.map_or(0, |plan| plan.work_bytes);
            // Eight clocks per byte, and twice the time as a margin.
            let clocks = u32::try_from(bytes).unwrap_or(u32::MAX).saturating_mul(8 * 2);
            let time_ms = clocks.saturating_mul(1_000).div_ceil((unit_hz / divider).max(1));
            timeout_ms = time_ms.max(timeout_ms);
            selects.push(Select::new(context, one, spi, (*unit_hz, divider), config)?);
        }
        Some(Self {
            ident: snake(&unit.name),
            unit: unit.name.clone(),
            driver: context.names.driver(&unit.name)?,
            unit_clock: unit.clock.clone().unwrap_or_default(),
            wires: wires(first),
            selects,
            timeout_ms: TIMEOUT_BASE_MS.saturating_add(timeout_ms),
        })
    }
}

/// `SCK PA5`
fn wires(connection: &JobConnection<'_>) -> Vec<String> {
    let named = [(Role::Sck, "SCK"), (Role::Miso, "MISO"), (Role::Mosi, "MOSI")];
    let wire = |(role, name)| Some(format!("{name} {}", connection.pad(role)?.pin.name));
    named.into_iter().filter_map(wire).collect()
}

impl Select {
    fn new(
        context: &Context<'_>,
        connection: &JobConnection<'_>,
        spi: &Spi,
        (unit_hz, divider): (u32, u32),
        config: Config,
    ) -> Option<Self> {
        // Nothing selects a strip.
        let line = match connection.pad(Role::Cs) {
            Some(pad) => context.line(&pad.pin.name)?,
            None => "PAL_NOLINE".to_owned(),
        };
        let clock = Clock {
            halvings: power_of_two(divider),
            is_idle_high: spi.mode & 2 != 0,
            is_second_edge: spi.mode & 1 != 0,
        };
        Some(Self {
            title: format!("{}: mode {}, {} Hz", connection.title, spi.mode, unit_hz / divider),
            line,
            config: config(&clock),
        })
    }
}

/// Macros or-ed together; `0U` if there are none.
pub(super) fn sum(terms: &[&str]) -> String {
    if terms.is_empty() { "0U".to_owned() } else { terms.join(" | ") }
}
