//! Parts on I2C and SPI: the bus, how its parts are selected, and which task serves which of them.

use std::collections::BTreeMap;

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit;
use sensedsl_files::{block, templates};
use sensedsl_job::part::BusPlan;
use sensedsl_job::{BoardJob, Cycle, JobConnection, by_unit, snake};
use sensedsl_model::design::PartIndex;
use sensedsl_model::kind::{KindName, Role};

use crate::context::Context;
use crate::section::{Apply, Cost, Section, Work};

/// What the unit's driver keeps, and an `up_chip_state_t` with its transfers.
const I2C_RAM_BYTES: u32 = 4;
const I2C_FLASH_BYTES: u32 = 1_200;
const CHIP_BYTES: u32 = 55;
const TRANSFER_BYTES: u32 = 8;
const ORDER_BYTES: u32 = 6;
/// The core's code for parts on buses.
const CHIPS_FLASH_BYTES: u32 = 2_900;
const SPI_FLASH_BYTES: u32 = 1_200;
/// What a table in the core takes for each reading or command of a part.
const TABLE_BYTES: u32 = 40;

templates! {
    s: Bus;
    Tables = "bus.c.txt";
}

struct Bus {
    /// `twi`
    ident: String,
    title: String,
    is_spi: bool,
    selects: Vec<Select>,
    threads: Vec<Thread>,
}

/// An `up_spi_select_t`.
struct Select {
    title: String,
    clock_hz: u32,
    mode: u8,
    pin: Option<u8>,
}

/// The parts that are served in one cycle.
struct Thread {
    ident: String,
    unit: String,
    cycle: Cycle,
    chips: Vec<Served>,
}

struct Served {
    name: String,
    prefix: String,
    commands: usize,
    field: String,
}

pub(crate) fn lacks(job: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str> {
    let plan = job.bus_of(connection);
    if plan.is_some_and(|plan| plan.clock_hz.is_some()) {
        return Some("strips of LEDs without a clock line on an AVR");
    }
    job.lacks_on_buses(connection)
}

pub(crate) fn i2c(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    for (unit, on_bus) in by_unit(context.job.connections(KindName::I2c)) {
        let speeds = on_bus.iter().filter_map(|one| Some(one.connection.kind.i2c()?.speed_hz));
        let fastest = context.profile.i2c.speed_max_hz;
        let speed_hz = speeds.fold(fastest, u32::min);
        section.starts.push(format!("up_i2c_start({speed_hz}U);"));
        section.headers.push("up_i2c.h");
        section.costs.push(Cost::new("I2C", I2C_RAM_BYTES, I2C_FLASH_BYTES));
        let threads = threads(context, &unit, &on_bus);
        let title = format!("{unit}: {speed_hz} Hz");
        let ident = snake(unit.as_str());
        add(
            context,
            &Bus { ident, title, is_spi: false, selects: Vec::new(), threads },
            &mut section,
        );
    }
    section
}

pub(crate) fn spi(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    for (unit, on_bus) in by_unit(context.job.connections(KindName::Spi)) {
        let selects = on_bus.iter().filter_map(|one| select(context, one)).collect();
        for wire in &on_bus {
            if let Some(number) = context.number(wire, Role::Cs) {
                section
                    .pads
                    .push(format!("digitalWrite({number}, HIGH);\n  pinMode({number}, OUTPUT);"));
            }
        }
        diagnostics.extend(slave(context, on_bus.first().copied()));
        section.starts.push("up_spi_start();".to_owned());
        section.headers.push("up_spi.h");
        section.costs.push(Cost::new("the framework's SPI", 4, SPI_FLASH_BYTES));
        let threads = threads(context, &unit, &on_bus);
        let (ident, title) = (snake(unit.as_str()), unit.to_string());
        add(context, &Bus { ident, title, is_spi: true, selects, threads }, &mut section);
    }
    section
}

fn select(context: &Context<'_>, wire: &JobConnection<'_>) -> Option<Select> {
    let spi = wire.connection.kind.spi()?;
    let pin = context.number(wire, Role::Cs);
    Some(Select { title: wire.place(), clock_hz: spi.clock_hz, mode: spi.mode, pin })
}

/// The number of a part on its SPI bus, which takes the place of an address.
pub(crate) fn number_of(job: &BoardJob<'_>, part: PartIndex) -> Option<u8> {
    let buses = by_unit(job.connections(KindName::Spi));
    let mut all = buses.values();
    let number =
        all.find_map(|on_bus| on_bus.iter().position(|one| one.connection.part == part))?;
    u8::try_from(number).ok()
}

/// An input at the pin that makes the unit a slave when it is low.
fn slave(context: &Context<'_>, on_bus: Option<&JobConnection<'_>>) -> Option<Diagnostic> {
    let select = context.names.select();
    let mut connections = context.job.connections.iter();
    let wire = connections.find(|one| {
        one.pads.iter().any(|pad| pad.pin.name.as_str() == select && pad.role.is_driven_by_device())
    })?;
    let message = format!(
        "{} is an input at {select}, which turns the SPI unit of {} off when it is low",
        wire.title, on_bus?.title
    );
    let help = format!(
        "give {} another `pin`, or say `forbid {select} for {};`",
        wire.title, wire.part.name.value
    );
    Some(e0506_hardware_limit::hardware_limit(wire.part.name.span, &message, &help))
}

/// The tasks of a bus, one for each cycle; each serves its parts in the design's order.
fn threads(context: &Context<'_>, unit: &UnitName, on_bus: &[&JobConnection<'_>]) -> Vec<Thread> {
    let mut cycles: BTreeMap<Cycle, Vec<Served>> = BTreeMap::new();
    for one in on_bus {
        let Some(plan) = context.job.bus_of(one) else { continue };
        let device = one.devices.first().and_then(|index| context.job.devices.get(*index));
        let of_part = || context.job.devices.iter().find(|d| d.device.part == one.connection.part);
        let Some(device) = device.or_else(of_part) else { continue };
        cycles.entry(one.cycle).or_default().push(Served {
            name: one.part.name.value.clone(),
            prefix: plan.prefix.clone(),
            commands: plan.commands.len(),
            field: device.name().to_owned(),
        });
    }
    let thread = |(cycle, chips): (Cycle, Vec<Served>)| Thread {
        ident: cycle.ident(unit.as_str()),
        unit: unit.to_string(),
        cycle,
        chips,
    };
    cycles.into_iter().map(thread).collect()
}

/// Adds a bus with its tasks to a section.
fn add(context: &Context<'_>, bus: &Bus, section: &mut Section) {
    section.headers.push("up_chips.h");
    section.costs.push(Cost::new("parts on buses", 0, CHIPS_FLASH_BYTES));
    for thread in &bus.threads {
        section.work.push(thread.work());
        for (index, served) in thread.chips.iter().enumerate() {
            let plan = context.job.parts.iter().flat_map(|part| &part.plan.buses);
            let Some(plan) = plan.into_iter().find(|plan| plan.prefix == served.prefix) else {
                continue;
            };
            section.costs.push(cost(&served.name, plan));
            section.applies.extend(plan.commands.iter().enumerate().map(|(number, one)| Apply {
                field: one.field.clone(),
                line: format!("up_chips_owe(&{}_chips[{index}], {number}U);", thread.ident),
            }));
        }
    }
    section.tables.push_str(if section.tables.is_empty() { "" } else { "\n\n" });
    section.tables.push_str(&block(&Tables { s: bus }));
}

fn cost(name: &str, plan: &BusPlan) -> Cost {
    let count = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
    let ram = CHIP_BYTES
        + TRANSFER_BYTES * count(plan.transfers.len())
        + ORDER_BYTES * count(plan.commands.len())
        + u32::from(plan.calibration_bytes)
        + count(plan.kept.len());
    let init: usize = plan.init.iter().map(|one| one.bytes.len() + 5).sum();
    let tables = plan.readings.len() + plan.commands.len() + plan.transfers.len();
    Cost::new(format!("the part {name}"), ram, count(init) + TABLE_BYTES * count(tables) + 60)
}

impl Thread {
    fn work(&self) -> Work {
        Work {
            title: self.cycle.title(&self.unit),
            function: "up_chips_cycle",
            table: self.ident.clone(),
            cycle: self.cycle,
            field: self.chips.first().map(|one| one.field.clone()).unwrap_or_default(),
        }
    }
}
