//! The user's code: a task for each controller, and a guard above them.

use std::collections::BTreeMap;

use sensedsl_code::{ControllerPlan, FieldPlan, controllers};
use sensedsl_diagnostics::Diagnostic;
use sensedsl_job::{JobController, JobDevice, Owner};
use sensedsl_wire::Direction;

use super::context::Context;
use super::hal::contract::Drivers;
use super::item::{Item, Task};
use super::section::{Section, Start, Watched};
use super::{fallback, filter};

/// What is set when a controller hangs.
pub(super) struct Guard {
    /// The controller, in the file and in code.
    pub(super) name: String,
    pub(super) ident: String,
    /// The values of items, by their constants.
    pub(super) fallbacks: Vec<(String, Vec<u8>)>,
    /// Statements with the outputs.
    pub(super) fails: Vec<String>,
}

/// The tasks of the controllers.
pub(super) fn plan(context: &Context<'_>, _: &dyn Drivers, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let job = context.job;
    if job.controllers.is_empty() {
        return section;
    }
    section.items.push(Item::Static {
        doc: "The actuators of controllers that the host has taken".to_owned(),
        line: format!(
            "static TAKEN: rt::control::Taken<ITEMS> = rt::control::Taken::new([{}]);",
            owners(context)
        ),
    });
    for one in &job.devices {
        if let Some(code) = one.device.kind.code() {
            let bytes = fallback::value(one, code.default);
            let constant = one.ident.to_uppercase();
            section.begins.push(format!(
                "BOARD.report(None, tables::{constant}, Outcome::Fresh, &mut {bytes:?});"
            ));
        }
    }
    for (plan, own) in controllers(job).iter().zip(&job.controllers) {
        task(context, plan, own, &mut section);
    }
    guard(context, &mut section);
    section
}

/// Whom each item obeys.
fn owners(context: &Context<'_>) -> String {
    let owner = |index| match context.job.owner(index) {
        Owner::Host => "rt::control::Owner::Host",
        Owner::Code => "rt::control::Owner::Code",
        Owner::CodeOrHost => "rt::control::Owner::CodeOrHost",
    };
    let all: Vec<&str> = (0..context.job.devices.len()).map(owner).collect();
    all.join(", ")
}

fn task(
    context: &Context<'_>,
    plan: &ControllerPlan,
    own: &JobController<'_>,
    section: &mut Section,
) {
    let Some(device) = context.job.devices.get(own.own) else { return };
    let (ident, module, cycle) = (&own.ident, &plan.ident, device.cycle);
    let upper = ident.to_uppercase();
    let takes_us = own.controller.takes_us.unwrap_or(plan.every_ms.saturating_mul(1_000));
    section.items.push(Item::Static {
        doc: format!("The steps of {}", plan.name),
        line: format!(
            "static {upper}_CONTROL: rt::control::Control = \
             rt::control::Control::new(tables::{upper}, {}, {takes_us});",
            plan.every_ms
        ),
    });
    let doc = format!("{}: the user's code", cycle.title(&plan.name));
    let mut task = Task::in_turn(doc, format!("{ident}_control"), cycle);
    task.before.push(format!("let mut code = controls::{module}_code::{}::new();", plan.type_name));
    let mut cycle_of = vec![
        format!("let dt_us = {upper}_CONTROL.begin(Instant::now().as_micros());"),
        format!("let input = controls::{module}::In {{ {} }};", inputs(context, plan)),
        format!("let mut output = controls::{module}::Out::default();"),
        "code.step(&input, &mut output, dt_us);".to_owned(),
    ];
    for field in &plan.sets {
        cycle_of.push(set(context, field, section, &mut task.before));
    }
    cycle_of.push(format!("{upper}_CONTROL.end(&BOARD, dt_us, Instant::now().as_micros());"));
    let watched = format!("{upper}_STEPS");
    task.ticks(cycle.delay_ms, cycle_of, &watched);
    section.watched.push(Watched::new(watched, cycle, device.device.id.value));
    section.starts.push(Start::Task(cycle.prio, format!("{ident}_control()")));
    section.items.push(Item::Task(task));
}

/// The fields of what a step gets.
fn inputs(context: &Context<'_>, plan: &ControllerPlan) -> String {
    let field = |field: &FieldPlan| {
        let device = context.job.devices.get(field.index);
        let is_given = device.is_some_and(is_given);
        let constant = constant(context, field);
        let reading =
            "controls::Reading { value: controls::Bytes::from_bytes(bytes), age_us, is_valid }";
        format!(
            "{}: rt::control::newest(&BOARD, (tables::{constant}, {is_given}), |bytes, age_us, is_valid| {reading})",
            field.ident
        )
    };
    plan.reads.iter().map(field).collect::<Vec<_>>().join(", ")
}

/// A value that nobody measures is good as soon as it is there.
fn is_given(one: &JobDevice<'_>) -> bool {
    one.device.kind.code().is_some() || one.device.direction == Direction::Actuator
}

/// The device's index, as the tables call it.
fn constant(context: &Context<'_>, field: &FieldPlan) -> String {
    context.job.devices.get(field.index).map_or_else(String::new, |one| one.ident.to_uppercase())
}

/// What is done with a value that a step may have set.
fn set(
    context: &Context<'_>,
    field: &FieldPlan,
    section: &mut Section,
    state: &mut Vec<String>,
) -> String {
    let (ident, constant, bytes) = (&field.ident, constant(context, field), field.bytes());
    let direction = context.job.devices.get(field.index).map(|one| one.device.direction);
    let done = match direction {
        Some(Direction::Actuator) => {
            format!("if !TAKEN.is_hosts(tables::{constant}) {{ set(tables::{constant}, &bytes); }}")
        }
        Some(Direction::Sensor) | None => {
            let filter = filter::pass(context, field.index, section, state);
            format!("BOARD.report({filter}, tables::{constant}, Outcome::Fresh, &mut bytes);")
        }
    };
    format!(
        "if let Some(value) = output.{ident} {{ let mut bytes = [0; {bytes}]; \
         controls::Bytes::put(value, &mut bytes); {done} }}"
    )
}

/// The guard looks once in the shortest cycle, above all controllers. Where nothing falls back there is none.
fn guard(context: &Context<'_>, section: &mut Section) {
    let job = context.job;
    let every_ms = job.controllers.iter().map(|one| one.controller.every_ms).min().unwrap_or(1);
    let prios = job.controllers.iter().filter_map(|one| job.devices.get(one.own));
    let above = prios.map(|own| own.cycle.prio).max().unwrap_or(0).saturating_add(1);
    let mut task =
        Task::new("Looks whether the controllers still run".to_owned(), "guard".to_owned());
    task.before.push(format!("let mut ticker = Ticker::every(Duration::from_millis({every_ms}));"));
    for one in &job.controllers {
        let upper = one.ident.to_uppercase();
        let falls_back = format!("{}_falls_back();", one.ident);
        task.cycle
            .push(format!("if {upper}_CONTROL.has_hung(&BOARD, now_ms()) {{ {falls_back} }}"));
    }
    task.cycle.push("ticker.next().await;".to_owned());
    section.items.push(Item::Task(task));
    section.starts.push(Start::Task(above, "guard()".to_owned()));
}

/// What is set when each controller hangs. `fails`: the statements of all outputs, by item.
pub(super) fn guards(context: &Context<'_>, fails: &[(usize, String)]) -> Vec<Guard> {
    let values: BTreeMap<usize, Vec<u8>> = fallback::values(context).into_iter().collect();
    let constant = |index: &usize| {
        let one = context.job.devices.get(*index)?;
        Some((one.ident.to_uppercase(), values.get(index)?.clone()))
    };
    let guard = |one: &JobController<'_>| Guard {
        name: context.job.devices.get(one.own).map_or("", JobDevice::name).to_owned(),
        ident: one.ident.clone(),
        fallbacks: one.sets.iter().filter_map(constant).collect(),
        fails: fails
            .iter()
            .filter(|(index, _)| one.sets.contains(index))
            .map(|(_, line)| line.clone())
            .collect(),
    };
    context.job.controllers.iter().map(guard).collect()
}
