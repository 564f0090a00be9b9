//! Input capture: hardware counts edges and the reporter reads it, or a task for each wire waits for edges and the
//! reporter takes what it has seen.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::KindName;
use sensedsl_model::kind::icu::{Icu, Mode};

use super::context::{Context, Wired, scalar};
use super::hal::contract::Drivers;
use super::hal::contract::inputs::{Capture, CaptureInput};
use super::item::{Item, Task};
use super::missing::{self, Printed};
use super::section::{Field, Section, Start};
use super::{counters, filter};
use sensedsl_job::JobConnection;
use sensedsl_job::part::TrainPlan;

/// The time without an edge after which there is no frequency.
const SILENT_MS: u32 = 1_000;

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    let Some(capture) = drivers.capture() else { return section };
    for wired in context.wired(KindName::Icu) {
        let made = device(context, capture, &wired, &mut section);
        context.report(wired.first.part, made, diagnostics);
    }
    section
}

/// A device with its wires, and what the reporter does with them.
fn device(
    context: &Context<'_>,
    capture: &dyn Capture,
    wired: &Wired<'_>,
    section: &mut Section,
) -> Printed<()> {
    let icu = missing::kind(wired.first.connection.kind.icu())?;
    let train = train(context, wired);
    let mut counts = Vec::new();
    for wire in &wired.wires {
        let input = CaptureInput { wire, icu, statics: upper(wire), is_train: train.is_some() };
        match capture.counter(context, &input)? {
            Some(counter) => counts.push(counters::keep(wire, counter, section)),
            None => {
                wait(context, capture, &input, (wired.device.cycle.prio, train), section)?;
            }
        }
    }
    match train {
        _ if !counts.is_empty() => counters::poll(context, wired, &counts, section),
        Some(train) => poll_train(context, wired, train, section),
        None => poll(context, wired, icu, section),
    }
    Ok(())
}

/// How the pulse train of a device is read; `None` if it has none.
fn train<'a>(context: &Context<'a>, wired: &Wired<'_>) -> Option<&'a TrainPlan> {
    let name = wired.device.name();
    let mut all = context.job.parts.iter().flat_map(|part| &part.plan.trains);
    all.find(|plan| plan.field == name)
}

/// What the statics of a wire begin with.
fn upper(wire: &JobConnection<'_>) -> String {
    wire.ident.to_uppercase()
}

/// A wire with the task that waits for its edges.
fn wait(
    context: &Context<'_>,
    capture: &dyn Capture,
    input: &CaptureInput<'_>,
    (prio, train): (i8, Option<&TrainPlan>),
    section: &mut Section,
) -> Printed<()> {
    let CaptureInput { wire, statics, .. } = input;
    let waiting = capture.waiting(context, input, section)?;
    let ident = &wire.ident;
    section.fields.push(Field::of(ident.clone(), wire.place(), waiting.made));
    let lines = match train {
        Some(plan) => vec![
            format!("static {statics}_SEEN: rt::capture::SharedTrain = rt::capture::new_train();"),
            format!(
                "const {statics}_TRAIN: sense_rt::TrainConfig = sense_rt::TrainConfig {{ \
                 tick_hz: {}, gap_ticks: {}, min_ticks: {} }};",
                plan.tick_hz, plan.gap_ticks, plan.min_ticks
            ),
        ],
        None => vec![format!(
            "static {statics}_SEEN: rt::capture::SharedCapture = rt::capture::new_capture();"
        )],
    };
    section.items.extend(lines.into_iter().map(Item::Line));
    let mut task = Task::new(wire.place(), format!("{ident}_edges"));
    task.parameters.push(format!("{}: {}", waiting.parameter, waiting.type_));
    task.before.push(format!("{}.await;", waiting.runs));
    section.items.push(Item::Task(task));
    section.starts.push(Start::Task(prio, format!("{ident}_edges(wiring.{ident})")));
    Ok(())
}

/// What the reporter does with what was captured.
fn poll(context: &Context<'_>, wired: &Wired<'_>, icu: &Icu, section: &mut Section) {
    let filter = filter::polled(context, wired.index, section);
    let (ident, value) = (&wired.device.ident, wired.device.device.value.value);
    let mode = match icu.mode {
        Mode::Width => "Width",
        Mode::Period => "Period",
        Mode::Frequency => "Frequency",
        Mode::Duty => "Duty",
        Mode::Count | Mode::Ppm => "Count",
    };
    let count = wired.wires.len();
    let config = format!(
        "let config = CaptureConfig {{ mode: CaptureMode::{mode}, tick_hz: {}, silent_ms: {SILENT_MS} }};",
        icu.tick_hz
    );
    let (bytes, scalar) = (value.size_bytes(), scalar(value.scalar));
    let constant = ident.to_uppercase();
    let is_array = wired.wires.iter().any(|one| one.connection.element.is_some());
    if !is_array {
        let seen = upper(wired.first);
        section.states.push(format!("let mut {ident} = Capture::NEW;"));
        section.polls.push(vec![
            format!("let seen = {seen}_SEEN.lock(core::cell::Cell::get);"),
            config,
            format!("let mut value = [0; {bytes}];"),
            format!(
                "if {ident}.read(&config, &seen, false, now_ms(), {scalar}, &mut value) {{ \
                 BOARD.report({filter}, tables::{constant}, Outcome::Fresh, &mut value); }}"
            ),
        ]);
        return;
    }
    let size = value.scalar.size_bytes();
    // A pulse that no longer comes must not look like a present one.
    let is_complete = matches!(icu.mode, Mode::Width | Mode::Period);
    section.states.push(format!("let mut {ident} = [Capture::NEW; {count}];"));
    section.states.push(format!("let mut {ident}_elements = sense_rt::Elements::NEW;"));
    section.states.push(format!("let mut {ident}_latest = [0; {bytes}];"));
    let mut poll = vec![config];
    for (at, wire) in wired.wires.iter().enumerate() {
        poll.push(format!("let seen = {}_SEEN.lock(core::cell::Cell::get);", upper(wire)));
        poll.push(format!(
            "if {ident}[{at}].read(&config, &seen, false, now_ms(), {scalar}, &mut {ident}_latest[{}..]) {{ \
             {ident}_elements.note({at}); }}",
            at * size
        ));
    }
    poll.push(format!(
        "if {ident}_elements.are_due({count}, {is_complete}) {{ let mut value = {ident}_latest; \
         BOARD.report({filter}, tables::{constant}, Outcome::Fresh, &mut value); }}"
    ));
    section.polls.push(poll);
}

/// What the reporter does with a pulse train.
fn poll_train(context: &Context<'_>, wired: &Wired<'_>, plan: &TrainPlan, section: &mut Section) {
    let filter = filter::polled(context, wired.index, section);
    let seen = upper(wired.first);
    section.states.push(format!("let mut {}_trains = 0;", plan.ident));
    let bytes = wired.device.device.value.value.size_bytes();
    section.polls.push(vec![
        format!("let seen = {seen}_SEEN.lock(core::cell::Cell::get);"),
        format!("let mut value = [0; {bytes}];"),
        format!(
            "let outcome = seen.read(&{seen}_TRAIN, &mut {}_trains, &SCHEMA.items[{}], &mut value);",
            plan.ident, wired.index
        ),
        format!(
            "BOARD.report({filter}, tables::{}, outcome, &mut value);",
            wired.device.ident.to_uppercase()
        ),
    ]);
}
