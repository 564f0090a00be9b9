//! Input capture: a task for each wire that waits for edges, and a look by the reporter.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::icu::{Edge, Icu, Mode};
use sensedsl_model::kind::{KindName, Role};

use super::context::{Context, Wired, channel, scalar};
use super::filter;
use super::section::{Field, Section, Start};

/// After so long without an edge there is no frequency.
const SILENT_MS: u32 = 1_000;

pub(super) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    for wired in context.wired(KindName::Icu) {
        device(context, &wired, &mut section);
    }
    section
}

fn device(context: &Context<'_>, wired: &Wired<'_>, section: &mut Section) -> Option<()> {
    let wire = wired.wires.first()?;
    let (icu, unit, pad) = (wire.connection.kind.icu()?, wire.unit?, wire.pad(Role::In)?);
    let (channel, hal) = (channel(pad)?, context.peripheral(unit));
    let interrupt = context.names.interrupt(unit, "CC")?;
    section.bind(interrupt, format!("hal::timer::CaptureCompareInterruptHandler<{hal}>"));
    let (ident, pin) = (&wire.ident, &pad.pin.name);
    let (type_, make) = if icu.mode == Mode::Count {
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
                "hal::timer::input_capture::InputCapture::new(p.{hal}, {}, Irqs, hz({}), CountingMode::EdgeAlignedUp)",
                slots.join(", "),
                icu.tick_hz
            ),
        )
    } else {
        (
            format!("hal::timer::pwm_input::PwmInput<'static, {hal}>"),
            format!(
                "hal::timer::pwm_input::PwmInput::new_ch{channel}(p.{hal}, p.{pin}, Irqs, Pull::None, hz({}))",
                icu.tick_hz
            ),
        )
    };
    section.fields.push(Field {
        name: ident.clone(),
        comment: wire.place(),
        type_: type_.clone(),
        make,
    });
    let upper = ident.to_uppercase();
    section.items.push(format!(
        "static {upper}_SEEN: Seen = rt::capture::nothing();\n\n/// {}.\n#[embassy_executor::task]\n\
         async fn {ident}_edges(timer: {type_}) {{\n    {}.await;\n}}",
        wire.place(),
        run(icu, channel, &upper)
    ));
    let call = format!("{ident}_edges(wiring.{ident})");
    section.starts.push(Start::Task(wired.device.cycle.prio, call));
    section.runtime.insert("capture.rs");
    poll(context, wired, icu, &upper, section);
    Some(())
}

/// What the task does for ever.
fn run(icu: &Icu, channel: u8, upper: &str) -> String {
    let edges = match icu.edge {
        Edge::Rising => "Rising",
        Edge::Falling => "Falling",
        Edge::Both => "Both",
    };
    if icu.mode == Mode::Count {
        format!("rt::capture::count(timer, Channel::Ch{channel}, Edges::{edges}, &{upper}_SEEN)")
    } else {
        let is_width = icu.mode == Mode::Width;
        format!("rt::capture::measure(timer, {is_width}, {}, &{upper}_SEEN)", icu.tick_hz)
    }
}

fn poll(context: &Context<'_>, wired: &Wired<'_>, icu: &Icu, upper: &str, section: &mut Section) {
    let mut state = String::new();
    let filter = filter::pass(context, wired.index, section, &mut state);
    section.states.extend((!state.is_empty()).then(|| state.trim_end().to_owned()));
    let (ident, value) = (&wired.device.ident, wired.device.device.value.value);
    let mode = match icu.mode {
        Mode::Width => "Width",
        Mode::Period => "Period",
        Mode::Frequency => "Frequency",
        Mode::Duty => "Duty",
        Mode::Count | Mode::Ppm => "Count",
    };
    section.states.push(format!("let mut {ident} = Capture::NEW;"));
    section.polls.push(format!(
        "let seen = {upper}_SEEN.lock(core::cell::Cell::get);\n\
         let config = CaptureConfig {{ mode: CaptureMode::{mode}, tick_hz: {}, silent_ms: {SILENT_MS} }};\n\
         let mut value = [0; {}];\n\
         if {ident}.read(&config, &seen, false, now_ms(), {}, &mut value) {{\n    \
         BOARD.tell({filter}, tables::{}, Outcome::Fresh, &mut value);\n}}",
        icu.tick_hz,
        value.size_bytes(),
        scalar(value.scalar),
        ident.to_uppercase()
    ));
}
