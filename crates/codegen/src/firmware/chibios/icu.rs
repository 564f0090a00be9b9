//! Input capture: a driver for each sensor, served by callbacks; and the pulses that some devices want.

use std::collections::BTreeMap;

use sensedsl_board::profile::Timer;
use sensedsl_board::signal::Function;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::icu::{Edge, Icu, Mode};
use sensedsl_model::kind::{Kind, Role};

use super::context::{Context, Drive, PadPlan, Wired, line, pad};
use super::tasks::Cycle;

/// After that time without an edge a frequency is 0.
const SILENT_MS: u32 = 1_000;

/// One capturing timer.
#[derive(Clone, Debug)]
pub(super) struct IcuPlan {
    pub(super) index: usize,
    pub(super) name: String,
    pub(super) timer: String,
    pub(super) driver: String,
    /// The macro of the clock that drives the timer.
    pub(super) clock: String,
    pub(super) channel: u8,
    pub(super) mode: &'static str,
    pub(super) input: &'static str,
    pub(super) tick_hz: u32,
    pub(super) silent_ms: u32,
    pub(super) counts_both_edges: bool,
    pub(super) has_width: bool,
    pub(super) has_period: bool,
    pub(super) has_overflow: bool,
}

/// Lines that get a pulse each cycle.
#[derive(Clone, Debug)]
pub(super) struct PulsePlan {
    pub(super) index: usize,
    pub(super) cycle: Cycle,
    pub(super) pulse_us: u32,
    pub(super) lines: Vec<String>,
    pub(super) names: Vec<String>,
}

pub(super) fn plan(
    context: &Context<'_>,
    pads: &mut Vec<PadPlan>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<IcuPlan> {
    let mut plans = Vec::new();
    for wired in &context.devices {
        let Kind::Icu(icu) = &wired.device.kind else { continue };
        let Some(wire) = context.wire(wired, Role::In) else { continue };
        pads.extend(context.alternate_pad(wire, Drive::Plain, diagnostics));
        let Some(usage) = wire.usage(context.board) else { continue };
        let Function::Timer { unit, channel, .. } = usage.signal.function() else { continue };
        let Some(timer) = context.profile.timer(unit.as_str()) else { continue };
        plans.extend(IcuPlan::new(plans.len(), wired, icu, timer, *channel));
    }
    plans
}

impl IcuPlan {
    fn new(index: usize, wired: &Wired<'_>, icu: &Icu, timer: &Timer, channel: u8) -> Option<Self> {
        let counts_both_edges = icu.mode == Mode::Count && icu.edge == Edge::Both;
        Some(Self {
            index,
            name: wired.device.name.value.clone(),
            timer: timer.name.clone(),
            driver: timer.icu.as_ref()?.driver.clone(),
            clock: timer.clock.clone(),
            channel,
            mode: match icu.mode {
                Mode::Count => "UP_CAPTURE_COUNT",
                Mode::Width => "UP_CAPTURE_WIDTH",
                Mode::Period => "UP_CAPTURE_PERIOD",
                Mode::Frequency => "UP_CAPTURE_FREQUENCY",
                Mode::Duty => "UP_CAPTURE_DUTY",
            },
            input: match icu.edge {
                Edge::Rising | Edge::Both => "ICU_INPUT_ACTIVE_HIGH",
                Edge::Falling => "ICU_INPUT_ACTIVE_LOW",
            },
            tick_hz: icu.tick_hz,
            silent_ms: SILENT_MS,
            counts_both_edges,
            has_width: counts_both_edges || matches!(icu.mode, Mode::Width | Mode::Duty),
            has_period: icu.mode != Mode::Width,
            // A counter has none: with it, the driver would keep an edge after each wrap to itself.
            has_overflow: icu.mode != Mode::Count,
        })
    }
}

pub(super) fn plan_pulses(context: &Context<'_>, pads: &mut Vec<PadPlan>) -> Vec<PulsePlan> {
    let mut classes: BTreeMap<(Cycle, u32), (Vec<String>, Vec<String>)> = BTreeMap::new();
    for wired in &context.devices {
        let Kind::Icu(Icu { pulse_us: Some(pulse_us), .. }) = wired.device.kind else { continue };
        let Some(pin) = context.pin(wired, Role::Trigger) else { continue };
        pads.push(pad(pin, "PAL_MODE_OUTPUT_PUSHPULL"));
        let cycle = context.cycle("pulse", wired);
        let (lines, names) = classes.entry((cycle, pulse_us)).or_default();
        lines.push(line(pin));
        names.push(wired.device.name.value.clone());
    }
    let classes = classes.into_iter().enumerate();
    classes
        .map(|(index, ((cycle, pulse_us), (lines, names)))| PulsePlan {
            index,
            cycle,
            pulse_us,
            lines,
            names,
        })
        .collect()
}
