//! The time between the pulses that a world sends to a capture.

use sensedsl_model::kind::icu::{Icu, Mode};

use super::line::{DUTY_NS, Line, Unit, distance, frame_ns};
use crate::arith::nanoseconds;
use crate::truth::Subject;

/// The length of the shortest pulse that counts.
const SHORTEST_NS: u64 = 2_000;
/// The timers that capture have at least 16 bits, and nothing longer is measured.
const TICKS_MAX: f64 = 65_535.0;

/// The shortest and the longest time from one measurement to the next in a span of time; `None` if there may be no
/// pulses that a timer can measure. With a trigger both are 0: the board decides when to measure.
pub(crate) fn apart(icu: &Icu, subject: &Subject, from_ns: u64, to_ns: u64) -> Option<(u64, u64)> {
    let mut all: Option<(u64, u64)> = None;
    for element in 0..subject.signals.len() {
        let (least, greatest) = of_element(icu, subject, element, (from_ns, to_ns))?;
        all = Some(all.map_or((least, greatest), |(l, g)| (l.min(least), g.max(greatest))));
    }
    all
}

fn of_element(
    icu: &Icu,
    subject: &Subject,
    element: usize,
    span: (u64, u64),
) -> Option<(u64, u64)> {
    let signal = subject.signals.get(element)?;
    let (one, other) = signal.range(span.0, span.1);
    let ends = [one, other].map(|end| subject.scale.raw(end));
    let (least, greatest) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    let tick_ns = 1e9 / f64::from(icu.tick_hz.max(1));
    let has_pulse = nanoseconds(least * tick_ns) >= SHORTEST_NS && greatest <= TICKS_MAX;
    match icu.mode {
        Mode::Count => None,
        Mode::Width if icu.pulse_us.is_some() => {
            let wait_ns = 1_000 * u64::from(icu.wait_us);
            let has_echo = nanoseconds(greatest * tick_ns) + 2_000_000 < wait_ns || wait_ns == 0;
            (has_pulse && has_echo).then_some((0, 0))
        }
        Mode::Width => match Line::of_capture(icu, 0, element, subject) {
            Line::Width { period_ns, .. } if has_pulse => Some((period_ns, period_ns)),
            Line::Level { .. }
            | Line::Count { .. }
            | Line::Track { .. }
            | Line::Width { .. }
            | Line::Echo { .. }
            | Line::Period { .. }
            | Line::Duty { .. }
            | Line::Train { .. } => None,
        },
        Mode::Period | Mode::Frequency => {
            let unit = if icu.mode == Mode::Period { Unit::Ticks(tick_ns) } else { Unit::Hertz };
            let (one, other) = (distance(unit, least)?, distance(unit, greatest)?);
            let (shortest, longest) = (one.min(other), one.max(other));
            (crate::arith::number(longest) <= TICKS_MAX * tick_ns).then_some((shortest, longest))
        }
        Mode::Duty => Some((DUTY_NS, DUTY_NS)),
        Mode::Ppm => {
            let frame_ns = frame_ns(subject.signals.len());
            Some((frame_ns, frame_ns))
        }
    }
}
