//! Interrupts of captures: how many there are at the greatest value that a device states.

use sensedsl_model::design::Device;
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::icu::{Edge, Icu, Mode};

use crate::clocks::timer_hz;
use crate::context::Context;
use crate::rows::{Count, Part, Row};

/// Ticks of a timer from one overflow to the next.
const COUNTER: u32 = 65_536;

/// Interrupts per second of a capture, if the device states enough.
pub(crate) fn interrupts(device: &Device) -> Option<u64> {
    let icu = device.kind.icu()?;
    let edges = edges(device, icu)?;
    let both = icu.mode == Mode::Count && icu.edge == Edge::Both;
    let has_width = both || matches!(icu.mode, Mode::Width | Mode::Duty);
    let captures = edges * (1 + u64::from(has_width));
    if icu.mode == Mode::Count {
        return Some(captures);
    }
    Some(with_overflows(edges, captures, icu.tick_hz))
}

/// Captures and overflows per second, for a counter that each edge resets.
fn with_overflows(edges: u64, captures: u64, tick_hz: u32) -> u64 {
    let between = u64::from(tick_hz) / (edges.max(1) * u64::from(COUNTER));
    // Without any edges, the counter only overflows.
    (captures + edges * between).max(u64::from(tick_hz.div_ceil(COUNTER)))
}

/// Active edges per second.
fn edges(device: &Device, icu: &Icu) -> Option<u64> {
    if icu.pulse_us.is_some() {
        return Some(1_000_u64.div_ceil(u64::from(device.delay_ms.max(1))));
    }
    let raw = |shown: f64| {
        let raw = (shown - device.shown.offset.unwrap_or(0.0)) / device.shown.scale.unwrap_or(1.0);
        whole(raw.abs())
    };
    match icu.mode {
        Mode::Frequency => raw(device.shown.max?),
        // The shortest period has the most edges.
        Mode::Period => u64::from(icu.tick_hz).checked_div(raw(device.shown.min?)?),
        // The value does not show how often edges come.
        Mode::Count | Mode::Width | Mode::Duty | Mode::Ppm => None,
    }
}

/// Rounds up to a whole number.
fn whole(value: f64) -> Option<u64> {
    const MOST: f64 = 1e12;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "compared with what fits just before"
    )]
    (0.0..=MOST).contains(&value).then(|| value.ceil() as u64)
}

pub(crate) fn rows(context: &Context<'_>) -> Vec<Row> {
    let mut rows = Vec::new();
    for wired in &context.elements {
        let icu = match wired.device.kind.interface() {
            Interface::Icu(icu) => Some(icu),
            Interface::Digital(digital) if digital.edge.is_some() => None,
            Interface::Analog(_)
            | Interface::I2c(_)
            | Interface::Encoder(_)
            | Interface::Digital(_)
            | Interface::Uart(_)
            | Interface::Spi(_)
            | Interface::Pwm(_)
            | Interface::Dac(_)
            | Interface::Can(_)
            | Interface::OneWire(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => continue,
        };
        let name = wired.wiring.unit.clone().unwrap_or_else(|| "EXTI".to_owned());
        let mut row = Row::new(Part::Interrupts, name, vec![wired.index]);
        if let Some(icu) = icu {
            let timers = context.board.profile().map(|profile| &profile.timers);
            let timer = timers.into_iter().flatten().find(|timer| timer.name == row.name);
            let known = timer.and_then(|timer| timer_hz(context, timer)).is_some();
            row.clock_hz = known.then_some(icu.tick_hz);
        }
        row.a_second = interrupts(wired.device).map(Count::Interrupts);
        rows.push(row);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::with_overflows;

    #[test]
    fn overflows_are_those_between_the_edges() {
        // At 1 MHz there is an overflow every 65.5 ms: none in the millisecond between two edges.
        assert_eq!(with_overflows(1_000, 2_000, 1_000_000), 2_000);
        // Three overflows in each of five intervals of 200 ms.
        assert_eq!(with_overflows(5, 10, 1_000_000), 10 + 5 * 3);
        // A silent input is the worst case for a slow signal.
        assert_eq!(with_overflows(1, 1, 1_000_000), 16);
        assert_eq!(with_overflows(0, 0, 1_000_000), 16);
    }
}
