//! `TIMv1`: a driver for each captured sensor, served by callbacks.

use askama::Template;
use sensedsl_board::profile::Timer;
use sensedsl_board::signal::{Function, UnitName};
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::icu::{Edge, Icu, Mode};
use sensedsl_model::kind::{Kind, KindName, Role};

use crate::firmware::chibios::context::{Context, Drive};
use crate::firmware::chibios::names::Setting;
use crate::firmware::chibios::section::{GuardPlan, Section};
use crate::job::JobDevice;
use crate::print::block;

/// After that time without an edge a frequency is 0.
const SILENT_MS: u32 = 1_000;

#[derive(Template)]
#[template(path = "firmware/chibios/icu/v1.c.txt", escape = "none")]
struct Tables<'a> {
    s: &'a Captures,
}

struct Captures {
    icus: Vec<Capture>,
}

/// One capturing timer.
struct Capture {
    index: usize,
    name: String,
    timer: String,
    driver: String,
    /// The macro of the clock that drives the timer.
    clock: String,
    channel: u8,
    mode: &'static str,
    input: &'static str,
    tick_hz: u32,
    silent_ms: u32,
    counts_both_edges: bool,
    has_width: bool,
    has_period: bool,
    has_overflow: bool,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut icus = Vec::new();
    for wired in context.devices(KindName::Icu) {
        let Kind::Icu(icu) = &wired.device.kind else { continue };
        let Some(pad) = wired.pad(Role::In) else { continue };
        section.pads.extend(context.alternate_pad(pad, Drive::Plain, diagnostics));
        let Some(usage) = pad.usage else { continue };
        let Function::Timer { unit, channel, .. } = usage.signal.function() else { continue };
        let Some(timer) = context.profile.timer(unit.as_str()) else { continue };
        let capture = Capture::new(context, icus.len(), (wired, icu), timer, *channel);
        section.units.extend(capture.iter().map(|capture| UnitName::new(&capture.timer)));
        icus.extend(capture);
    }
    let truth = if icus.is_empty() { "FALSE" } else { "TRUE" };
    section.switch = Some(Setting::new("HAL_USE_ICU", truth));
    section.hal = vec![Setting::new("ICU_USE_OVERFLOW_SCALING", "FALSE")];
    section.clocks = icus.iter().map(|capture| capture.clock.clone()).collect();
    section.guards = icus.iter().flat_map(Capture::guards).collect();
    if !icus.is_empty() {
        let all = || 0..icus.len();
        section.starts = all().map(|index| format!("up_icu_start(&icus[{index}]);")).collect();
        section.polls = all().map(|index| format!("up_icu_poll(&icus[{index}]);")).collect();
        section.tables = block(&Tables { s: &Captures { icus } });
    }
    section
}

impl Capture {
    fn new(
        context: &Context<'_>,
        index: usize,
        (wired, icu): (&JobDevice<'_>, &Icu),
        timer: &Timer,
        channel: u8,
    ) -> Option<Self> {
        let counts_both_edges = icu.mode == Mode::Count && icu.edge == Edge::Both;
        Some(Self {
            index,
            name: wired.name().to_owned(),
            timer: timer.name.clone(),
            driver: timer.icu.as_ref().and_then(|_| context.names.driver(&timer.name))?,
            clock: timer.clock.clone(),
            channel,
            mode: match icu.mode {
                Mode::Count => "UP_CAPTURE_COUNT",
                Mode::Width => "UP_CAPTURE_WIDTH",
                Mode::Period => "UP_CAPTURE_PERIOD",
                Mode::Frequency => "UP_CAPTURE_FREQUENCY",
                Mode::Duty => "UP_CAPTURE_DUTY",
                Mode::Ppm => return None,
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

    fn guards(&self) -> [GuardPlan; 2] {
        let Self { timer, clock, tick_hz, channel, .. } = self;
        [
            GuardPlan {
                condition: format!("{clock} % {tick_hz}U == 0U && {clock} / {tick_hz}U <= 65536U"),
                message: format!("the clock of {timer} does not divide to {tick_hz} Hz"),
            },
            GuardPlan {
                condition: format!("STM32_{timer}_CHANNELS >= 2"),
                message: format!("{timer} cannot measure with channel {channel}"),
            },
        ]
    }
}
