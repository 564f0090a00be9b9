//! A board's whole project: the sections of all kinds, joined, and what templates print of them.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::catalog::ActivePin;
use sensedsl_code::ControllerPlan;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_job::Owner;
use sensedsl_wire::{Checksum, Direction};

use super::cargo::Manifests;
use super::context::{Context, scalar};
use super::control::Guard;
use super::hal::contract::outputs::{Pins, Speed};
use super::hal::contract::{Begin, Drivers, Package};
use super::item::{Constant, Item};
use super::levels::{self, Level};
use super::section::{Field, Handlers, Keep, LinkPlan, Section, Start, Watched};
use super::{
    analog, can, cargo, contacts, control, fallback, i2c, icu, inputs, link, onewire, outputs,
    pulse, serial, spi, stepper,
};

/// What a kind adds to a project.
type Peripheral = fn(&Context<'_>, &dyn Drivers, &mut Vec<Diagnostic>) -> Section;

/// All kinds, in the order in which their tasks are started.
const PERIPHERALS: &[Peripheral] = &[
    link::plan,
    outputs::plan,
    analog::plan,
    i2c::plan,
    spi::plan,
    onewire::plan,
    serial::plan,
    can::plan,
    icu::plan,
    pulse::plan,
    contacts::plan,
    inputs::plan,
    stepper::plan,
    control::plan,
];

/// The cycle of the reporter if nothing asks for a shorter one.
const REPORT_MS: u32 = 10;

/// What the templates print.
pub(super) struct Plan {
    pub(super) board: String,
    pub(super) chip: String,
    /// What debug probes call the chip.
    pub(super) probe: String,
    /// The command that runs a program on a board.
    pub(super) runner: String,
    /// The triple of the core.
    pub(super) target: String,
    pub(super) manifests: Manifests,
    pub(super) lock: String,
    pub(super) hal: &'static Package,
    pub(super) begin: Begin,
    pub(super) schema: SchemaPlan,
    pub(super) fields: Vec<Field>,
    pub(super) handlers: Vec<(String, String)>,
    pub(super) outputs: Vec<Field>,
    pub(super) items: Vec<Item>,
    pub(super) tables: Vec<Constant>,
    pub(super) starts: Vec<String>,
    /// Priorities above the lowest.
    pub(super) levels: Vec<Level>,
    pub(super) keeps: Vec<Keep>,
    pub(super) states: Vec<String>,
    pub(super) polls: Vec<Vec<String>>,
    /// The statements that set an item, by its constant.
    pub(super) sets: Vec<(String, Vec<String>)>,
    /// Whether the host sets anything.
    pub(super) has_actuators: bool,
    /// Whether there are fields of `Outputs`.
    pub(super) has_outputs: bool,
    pub(super) hushes: Vec<String>,
    pub(super) fails: Vec<String>,
    /// The user's code that runs in cycles, and what each falls back to.
    pub(super) controllers: Vec<ControllerPlan>,
    pub(super) guards: Vec<Guard>,
    /// Statements of `main` before tasks are started.
    pub(super) begins: Vec<String>,
    /// The values that items get when the host is silent, by their constants.
    pub(super) fallbacks: Vec<(String, Vec<u8>)>,
    pub(super) watched: Vec<Watched>,
    pub(super) report_ms: u32,
    pub(super) silence_ms: u32,
    /// The pin of the light, whether it shines when high, and what it is made of.
    pub(super) led: Option<(String, bool, String)>,
    /// Whether queues lie between the reporter and the link's driver.
    pub(super) is_queued: bool,
    pub(super) is_otg: bool,
    pub(super) is_uart: bool,
    /// The size of a serial port's queue for what the host sends.
    pub(super) received_bytes: u32,
}

/// The schema in the runtime's words.
pub(super) struct SchemaPlan {
    pub(super) hash: u32,
    pub(super) stamp: bool,
    pub(super) checksum: &'static str,
    pub(super) items: Vec<ItemPlan>,
    pub(super) cycles_ms: Vec<u32>,
}

pub(super) struct ItemPlan {
    pub(super) constant: String,
    pub(super) name: String,
    pub(super) make: String,
}

/// Joins the sections of all kinds.
pub(super) fn plan(
    context: &Context<'_>,
    hal: &'static Package,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Plan {
    let mut section = Section::default();
    for peripheral in PERIPHERALS {
        section.append(peripheral(context, drivers, diagnostics));
    }
    let (board, project) = (context.job.board, drivers.project());
    let is_usb = matches!(section.link, LinkPlan::Usb | LinkPlan::Otg);
    let report_ms = report_ms(context);
    let taken = |pin: &str| context.job.all_pads().any(|pad| pad.pin.name.as_str() == pin);
    let led = board.facts.as_ref().and_then(|facts| facts.led.as_ref());
    let led = led.filter(|led| !taken(led.pin.as_str()));
    let mut call = "reporter(wiring.watchdog".to_owned();
    call.push_str(if led.is_some() { ", wiring.led" } else { "" });
    call.extend(section.keeps.iter().map(|keep| format!(", {}", keep.from)));
    section.starts.push(Start::Task(0, call + ")"));
    let levels = levels::levels(context, project, &section.starts, diagnostics);
    let fallbacks: BTreeMap<usize, Vec<u8>> = fallback::values(context).into_iter().collect();
    let hosts = |index: usize| context.job.owner(index) == Owner::Host;
    let fails = section.fails.iter().filter(|(index, _)| hosts(*index));
    Plan {
        board: board.name.value.clone(),
        chip: context.chip.feature.clone(),
        probe: context.chip.probe.clone(),
        runner: hal.core.runner.replace("{chip}", &context.chip.probe),
        target: context.names.target.clone(),
        manifests: Manifests::new(context, hal, project, &section.features),
        lock: cargo::firmware_lock(context, hal, project),
        hal,
        begin: project.begin(context, is_usb),
        schema: schema(context),
        handlers: handlers(&section.handlers),
        has_actuators: context.job.has_actuators(),
        has_outputs: !section.outputs.is_empty(),
        sets: by_item(context, |index| section.sets.get(&index).cloned()),
        watched: section.watched,
        begins: section.begins,
        fallbacks: by_item(context, |index| {
            fallbacks.get(&index).filter(|_| hosts(index)).cloned()
        }),
        fails: fails.map(|(_, line)| line.clone()).collect(),
        controllers: sensedsl_code::controllers(context.job),
        guards: control::guards(context, &section.fails),
        report_ms,
        silence_ms: board.link.silence_ms.unwrap_or(0),
        led: led.map(|led| light(drivers.pins(), led)),
        is_queued: section.link.is_queued(),
        is_otg: section.link == LinkPlan::Otg,
        is_uart: section.link == LinkPlan::Uart,
        received_bytes: link::received_bytes(board.link.baud, report_ms),
        fields: section.fields,
        outputs: section.outputs,
        items: section.items,
        tables: section.tables,
        starts: levels::statements(&section.starts, &levels),
        levels,
        keeps: section.keeps,
        states: section.states,
        polls: section.polls,
        hushes: section.hushes,
    }
}

/// The cycle of the reporter: as often as the link says, or as something can become due.
fn report_ms(context: &Context<'_>) -> u32 {
    if let Some(report_ms) = context.job.board.link.report_ms() {
        return report_ms;
    }
    let devices = context.job.devices.iter().map(|one| one.device);
    let served = devices.filter(|device| !device.kind.name().spec().triggers_itself);
    let repeats = sensedsl_job::kinds::can::repeats_ms(context.job);
    // What the reporter counts is as new as a step needs it.
    let steps = context.job.controllers.iter().map(|one| one.controller.every_ms);
    served
        .map(|device| device.delay_ms)
        .chain(repeats)
        .chain(steps)
        .fold(REPORT_MS, u32::min)
        .max(1)
}

/// The board's light, which is off at first.
fn light(pins: &dyn Pins, led: &ActivePin) -> (String, bool, String) {
    let off = if led.active_high { "Level::Low" } else { "Level::High" };
    (led.pin.to_string(), led.active_high, pins.output(&led.pin, off, Speed::Low))
}

fn handlers(all: &Handlers) -> Vec<(String, String)> {
    let joined = |handlers: &BTreeSet<String>| {
        handlers.iter().map(String::as_str).collect::<Vec<_>>().join(", ")
    };
    all.iter().map(|(interrupt, handlers)| (interrupt.clone(), joined(handlers))).collect()
}

/// What `of` gives for each item, with the item's constant.
fn by_item<T>(context: &Context<'_>, of: impl Fn(usize) -> Option<T>) -> Vec<(String, T)> {
    let devices = context.job.devices.iter().enumerate();
    devices.filter_map(|(at, one)| Some((one.ident.to_uppercase(), of(at)?))).collect()
}

fn schema(context: &Context<'_>) -> SchemaPlan {
    let schema = &context.job.schema;
    let items = context.job.devices.iter().map(|device| {
        let (own, value) = (device.device, device.device.value.value);
        let make = match own.direction {
            Direction::Sensor => "sensor",
            Direction::Actuator => "actuator",
        };
        ItemPlan {
            constant: device.ident.to_uppercase(),
            name: device.name().to_owned(),
            make: format!(
                "Item::{make}({}, {}, {})",
                own.id.value,
                scalar(value.scalar),
                value.count()
            ),
        }
    });
    SchemaPlan {
        hash: schema.hash(),
        stamp: schema.stamp,
        checksum: match schema.checksum {
            Checksum::None => "Checksum::None",
            Checksum::Crc16 => "Checksum::Crc16",
            Checksum::Crc32 => "Checksum::Crc32",
        },
        items: items.collect(),
        cycles_ms: context.job.cycles_ms(),
    }
}
