//! I²C: a bus for each unit, and a task for each bus and cycle that serves its chips.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::design::PartIndex;
use sensedsl_model::kind::{KindName, Role};

use super::context::{Context, late};
use super::section::{Field, Section, Start, Watched};
use super::{chip, filter};
use crate::job::{Cycle, JobConnection};
use crate::print::snake;

/// Time for a device to think, beside the bits.
const TIMEOUT_BASE_MS: u32 = 10;

pub(super) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut buses: BTreeMap<&str, Vec<&JobConnection<'_>>> = BTreeMap::new();
    for one in context.job.connections(KindName::I2c) {
        let Some(unit) = one.unit else { continue };
        buses.entry(unit).or_default().push(one);
    }
    for (unit, on_bus) in buses {
        let Some(field) = bus(context, unit, &on_bus, &mut section) else { continue };
        let name = field.name.clone();
        section.fields.push(field);
        section.items.push(format!("static {unit}_BUS: StaticCell<I2cBus> = StaticCell::new();"));
        section.starts.push(Start::Make(format!(
            "let {name}: &'static I2cBus = {unit}_BUS.init(Mutex::new(wiring.{name}));"
        )));
        section.runtime.insert("bus.rs");
        tasks(context, unit, &on_bus, &mut section);
    }
    section
}

/// The bus, in the words of the HAL.
fn bus(
    context: &Context<'_>,
    unit: &str,
    on_bus: &[&JobConnection<'_>],
    section: &mut Section,
) -> Option<Field> {
    let first = on_bus.first()?;
    let hal = context.peripheral(unit);
    let (scl, sda) = (first.pad(Role::Scl)?, first.pad(Role::Sda)?);
    let stream = |signal: &str| {
        let of = |one: &&crate::job::JobStream<'_>| one.request.ends_with(signal);
        context.names.channel(first.streams.iter().find(of)?.stream)
    };
    let (tx, rx) = (stream("_TX")?, stream("_RX")?);
    for channel in [&tx, &rx] {
        let interrupt = context.names.interrupt(channel, "GLOBAL")?;
        section.bind(interrupt, format!("hal::dma::InterruptHandler<{channel}>"));
    }
    for (signal, handler) in [("EV", "EventInterruptHandler"), ("ER", "ErrorInterruptHandler")] {
        // A unit with one interrupt for both has it under either name.
        let interrupt = context.names.interrupt(unit, signal)?;
        section.bind(interrupt, format!("hal::i2c::{handler}<{hal}>"));
    }
    let hz =
        on_bus.iter().filter_map(|one| one.connection.kind.i2c()).map(|i2c| i2c.speed_hz).min()?;
    let who: Vec<&str> = on_bus.iter().map(|one| one.title.as_str()).collect();
    Some(Field {
        name: snake(unit),
        comment: format!("{unit} at {} and {}: {}", scl.pin.name, sda.pin.name, who.join(", ")),
        type_: "hal::i2c::I2c<'static, hal::mode::Async, hal::i2c::Master>".to_owned(),
        make: format!(
            "hal::i2c::I2c::new(p.{hal}, p.{}, p.{}, p.{tx}, p.{rx}, Irqs, bus({hz}))",
            scl.pin.name, sda.pin.name
        ),
    })
}

fn tasks(context: &Context<'_>, unit: &str, on_bus: &[&JobConnection<'_>], section: &mut Section) {
    let mut cycles: BTreeMap<Cycle, Vec<PartIndex>> = BTreeMap::new();
    for one in on_bus {
        let parts = cycles.entry(one.cycle).or_default();
        if !parts.contains(&one.connection.part) {
            parts.push(one.connection.part);
        }
    }
    for (cycle, parts) in cycles {
        let ident = cycle.ident(unit);
        let constant = ident.to_uppercase();
        let plans = context.job.parts.iter().filter(|part| parts.contains(&part.index));
        let plans: Vec<_> = plans.filter_map(|part| part.plan.bus.as_ref()).collect();
        let hz = on_bus.iter().filter_map(|one| one.connection.kind.i2c()).map(|i2c| i2c.speed_hz);
        let hz = hz.min().unwrap_or(100_000).max(1);
        let bytes = plans.iter().map(|plan| plan.work_bytes + 4).max().unwrap_or(4);
        let bits_ms = u32::try_from(bytes).unwrap_or(u32::MAX).saturating_mul(2 * 9 * 1_000) / hz;
        let mut text = format!(
            "/// {}.\n#[embassy_executor::task]\nasync fn {ident}(bus: &'static I2cBus) {{\n{}",
            cycle.title(unit),
            late(cycle)
        );
        for plan in &plans {
            section.tables.push(chip::table(context, plan));
            let table = plan.prefix.to_uppercase();
            text.push_str(&format!(
                "    let mut {}: Chip<[u8; tables::{table}_CHIP.chip_bytes(&SCHEMA)]> = \
                 Chip::new(&tables::{table}_CHIP, &SCHEMA);\n",
                plan.prefix
            ));
        }
        let (state, pass) = filters(context, &parts, section);
        text.push_str(&state);
        text.push_str(&format!(
            "    let timeout = Duration::from_millis({});\n    loop {{\n        let mut idle_ms = {};\n        \
             let mut tell = |index: usize, outcome, value: &mut [u8]| BOARD.tell({pass}, index, outcome, value);\n",
            TIMEOUT_BASE_MS + bits_ms,
            cycle.delay_ms
        ));
        for plan in &plans {
            text.push_str(&format!(
                "        idle_ms = idle_ms.min(serve_i2c(bus, &mut {}, timeout, &mut tell).await);\n",
                plan.prefix
            ));
        }
        text.push_str(&format!(
            "        WATCH.beat(tables::{constant}, now_ms());\n        \
             Timer::after_millis(u64::from(idle_ms.max(1))).await;\n    }}\n}}"
        ));
        section.items.push(text);
        section.starts.push(Start::Task(cycle.prio, format!("{ident}({})", snake(unit))));
        section.watched.push(Watched { constant, cycle_ms: cycle.delay_ms });
    }
}

/// The filters of parts, and which of them is an item's.
fn filters(context: &Context<'_>, parts: &[PartIndex], section: &mut Section) -> (String, String) {
    let (mut state, mut arms) = (String::new(), String::new());
    for (index, device) in context.job.devices.iter().enumerate() {
        if !parts.contains(&device.device.part) {
            continue;
        }
        let mut own = String::new();
        let pass = filter::pass(context, index, section, &mut own);
        if !own.is_empty() {
            state.push_str(&format!("    {own}"));
            arms.push_str(&format!("{index} => {pass}, "));
        }
    }
    let pass = if arms.is_empty() {
        "None".to_owned()
    } else {
        format!("match index {{ {arms}_ => None }}")
    };
    (state, pass)
}
