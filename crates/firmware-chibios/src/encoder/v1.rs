//! `TIMv1`: a timer in encoder mode for each pair of tracks. ChibiOS has no driver for it, so the timer is withdrawn
//! from the drivers that it has.

use sensedsl_board::profile::Timer;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};

use crate::context::{Context, Drive};
use crate::names::Setting;
use crate::section::Section;
use crate::timers;
use sensedsl_files::{block, templates};
use sensedsl_job::{JobConnection, JobDevice};

templates! {
    s: Encoders;
    Tables = "encoder/v1.c.txt";
}

struct Encoders {
    sensors: Vec<Sensor>,
}

struct Sensor {
    ident: String,
    name: String,
    words: usize,
    counters: Vec<Counter>,
}

/// One timer.
struct Counter {
    /// `Wheel at PB6 (TIM4_CH1), PB7 (TIM4_CH2)`
    place: String,
    timer: String,
    is_wide: bool,
    filter: u8,
}

/// The longest disturbance that the input filter may suppress: edges of one track at the greatest speed of a 16-bit
/// counter are twice as far apart.
const FILTER_NS: u64 = 250;

/// The filter lengths, from setting 0 on: the timer clocks that a level must last.
const FILTERS: [u64; 16] = [0, 2, 4, 8, 12, 16, 24, 32, 48, 64, 80, 96, 128, 160, 192, 256];

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut encoders = Encoders { sensors: Vec::new() };
    for wired in context.connections(KindName::Encoder) {
        for pad in &wired.pads {
            section.pads.extend(context.alternate_pad(pad, Drive::Plain, diagnostics));
        }
    }
    for (device, wires) in timers::devices(context, KindName::Encoder) {
        encoders.sensors.push(Sensor::new(context, device, &wires, &mut section));
    }
    let poll = |one: &Sensor| format!("up_encoder_poll(&{}_encoder);", one.ident);
    section.polls = encoders.sensors.iter().map(poll).collect();
    if !encoders.sensors.is_empty() {
        section.tables = block(&Tables { s: &encoders });
    }
    section
}

impl Sensor {
    fn new(
        context: &Context<'_>,
        device: &JobDevice<'_>,
        wires: &[&JobConnection<'_>],
        section: &mut Section,
    ) -> Self {
        let ident = &device.ident;
        let mut counters = Vec::new();
        for wired in wires {
            let Some(channel) = wired.pad(Role::A).and_then(|pad| timers::channel(context, pad))
            else {
                continue;
            };
            let Timer { name, .. } = channel.timer;
            section.starts.extend([
                format!("rccEnable{name}(true);"),
                format!("rccReset{name}();"),
                format!("up_encoder_start(&{ident}_counters[{}]);", counters.len()),
            ]);
            // A driver that also claims the timer then fails to compile.
            section.mcu.push(Setting::new(&format!("STM32_{name}_IS_USED"), "TRUE"));
            section.clocks.insert(channel.timer.clock.clone());
            section.guards.push(timers::has_channels(channel.timer, 2));
            counters.push(Counter::new(context, wired, channel.timer));
        }
        Self {
            ident: ident.clone(),
            name: device.name().to_owned(),
            words: timers::words(device),
            counters,
        }
    }
}

impl Counter {
    fn new(context: &Context<'_>, wired: &JobConnection<'_>, timer: &Timer) -> Self {
        let clock_hz = context.chibios.clocks_hz.get(&timer.clock).copied().unwrap_or(0);
        Self {
            place: wired.place(),
            timer: timer.name.clone(),
            is_wide: timer.bits > 16,
            filter: filter(clock_hz),
        }
    }
}

/// The longest filter that passes edges at the greatest speed.
fn filter(clock_hz: u32) -> u8 {
    let clocks = u64::from(clock_hz) * FILTER_NS / 1_000_000_000;
    let lengths = (0_u8..).zip(FILTERS);
    lengths
        .take_while(|(_, length)| *length <= clocks)
        .map(|(number, _)| number)
        .last()
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::filter;

    #[test]
    fn the_filter_lasts_a_quarter_of_a_microsecond_at_most() {
        let cases = [(0, 0), (8_000_000, 1), (48_000_000, 4), (84_000_000, 5), (240_000_000, 8)];
        for (clock_hz, wanted) in cases {
            assert_eq!(filter(clock_hz), wanted, "{clock_hz}");
        }
    }
}
