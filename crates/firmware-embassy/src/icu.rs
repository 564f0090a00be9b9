//! Input capture: a task for each wire that waits for edges, and a look by the reporter.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::icu::{Edge, Icu, Mode};
use sensedsl_model::kind::{KindName, Role};

use super::context::{Context, Wired, scalar};
use super::hal::Hal;
use super::item::{Item, Task};
use super::lack::{self, Printed};
use super::section::{Field, Section, Start};
use super::{filter, rp};
use sensedsl_job::JobConnection;
use sensedsl_job::part::TrainPlan;

/// After this time without an edge there is no frequency.
const SILENT_MS: u32 = 1_000;

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    for wired in context.wired(KindName::Icu) {
        let made = device(context, &wired, &mut section);
        context.tell(wired.first.part, made, diagnostics);
    }
    section
}

fn device(context: &Context<'_>, wired: &Wired<'_>, section: &mut Section) -> Printed<()> {
    let icu = lack::kind(wired.first.connection.kind.icu())?;
    match context.names.hal {
        Hal::Stm32 => captured(context, wired, icu, section),
        Hal::Rp => rp::icu::device(context, wired, icu, section),
    }
}

/// A device on timers that keep the count of an edge.
fn captured(
    context: &Context<'_>,
    wired: &Wired<'_>,
    icu: &Icu,
    section: &mut Section,
) -> Printed<()> {
    let train = train(context, wired);
    for wire in &wired.wires {
        input(context, wire, icu, (wired.device.cycle.prio, train), section)?;
    }
    match train {
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

/// A wire, with the task that waits for its edges.
fn input(
    context: &Context<'_>,
    wire: &JobConnection<'_>,
    icu: &Icu,
    (prio, train): (i8, Option<&TrainPlan>),
    section: &mut Section,
) -> Printed<()> {
    let (unit, pad) = (lack::unit(wire)?, lack::pad(wire, Role::In)?);
    let (channel, hal) = (lack::channel(pad)?, context.peripheral(unit));
    let interrupt = context.interrupt(unit, "CC")?;
    section.bind(interrupt, format!("hal::timer::CaptureCompareInterruptHandler<{hal}>"));
    let (ident, pin) = (&wire.ident, &pad.pin.name);
    let (type_, make) = if icu.mode == Mode::Count {
        counter(&context.generics(unit, &[]), &hal, pin.as_str(), channel, icu)
    } else {
        (
            format!("hal::timer::pwm_input::PwmInput<'static, {hal}>"),
            format!(
                "hal::timer::pwm_input::PwmInput::new_ch{channel}{}(p.{hal}, p.{pin}, Irqs, Pull::None, hz({}))",
                context.generics(unit, &[]),
                icu.tick_hz
            ),
        )
    };
    if icu.mode != Mode::Count && icu.edge == Edge::Falling {
        // The HAL measures from rising edges: the two channels of the wire change places.
        let (own, other) = if channel == 1 { (0, 1) } else { (1, 0) };
        section.begins.push(format!(
            "hal::pac::{hal}.ccer().modify(|edges| {{ edges.set_ccp({own}, true); edges.set_ccp({other}, false); }});"
        ));
    }
    section.fields.push(Field {
        name: ident.clone(),
        comment: wire.place(),
        type_: type_.clone(),
        make,
    });
    let upper = upper(wire);
    let (statics, runs) = match train {
        Some(plan) => (
            vec![
                format!(
                    "static {upper}_SEEN: rt::capture::SharedTrain = rt::capture::new_train();"
                ),
                format!(
                    "const {upper}_TRAIN: sense_rt::TrainConfig = sense_rt::TrainConfig {{ \
                     tick_hz: {}, gap_ticks: {}, min_ticks: {} }};",
                    plan.tick_hz, plan.gap_ticks, plan.min_ticks
                ),
            ],
            format!(
                "rt::timer::train(timer, hal::timer::Channel::Ch{channel}, &{upper}_TRAIN, &{upper}_SEEN)"
            ),
        ),
        None => (vec![seen(&upper)], run(icu, channel, &upper)),
    };
    section.items.extend(statics.into_iter().map(Item::Line));
    let mut task = Task::new(wire.place(), format!("{ident}_edges"));
    task.parameters.push(format!("timer: {type_}"));
    task.before.push(format!("{runs}.await;"));
    section.items.push(Item::Task(task));
    section.starts.push(Start::Task(prio, format!("{ident}_edges(wiring.{ident})")));
    Ok(())
}

/// The static for what was captured.
pub(super) fn seen(upper: &str) -> String {
    format!("static {upper}_SEEN: rt::capture::SharedCapture = rt::capture::new_capture();")
}

/// A timer that tells edges.
fn counter(moved: &str, hal: &str, pin: &str, channel: u8, icu: &Icu) -> (String, String) {
    let slots = (1..=4).map(|slot| {
        if slot == channel {
            format!("Some(hal::timer::input_capture::CapturePin::new(p.{pin}, Pull::None))")
        } else {
            "None".to_owned()
        }
    });
    let slots: Vec<String> = slots.collect();
    (
        format!("hal::timer::input_capture::InputCapture<'static, {hal}>"),
        format!(
            "hal::timer::input_capture::InputCapture::new{moved}(p.{hal}, {}, Irqs, hz({}), CountingMode::EdgeAlignedUp)",
            slots.join(", "),
            icu.tick_hz
        ),
    )
}

/// What the task does for ever.
fn run(icu: &Icu, channel: u8, upper: &str) -> String {
    let edges = match icu.edge {
        Edge::Rising => "Rising",
        Edge::Falling => "Falling",
        Edge::Both => "Both",
    };
    if icu.mode == Mode::Count {
        format!(
            "rt::timer::count(timer, Channel::Ch{channel}, rt::timer::Edges::{edges}, &{upper}_SEEN)"
        )
    } else {
        let is_width = icu.mode == Mode::Width;
        format!("rt::timer::measure(timer, {is_width}, {}, &{upper}_SEEN)", icu.tick_hz)
    }
}

/// What the reporter does with what was captured.
pub(super) fn poll(context: &Context<'_>, wired: &Wired<'_>, icu: &Icu, section: &mut Section) {
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
    // A pulse that comes no more must not look like one of now.
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
