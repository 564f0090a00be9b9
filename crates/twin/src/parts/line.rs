//! Levels and edges on single wires: switches, wheels, servo pulses, pulse trains.
//!
//! A line gives its present level and its next edge. For a quantity that moves slowly, the time at which it crosses the
//! next step is found by halving spans of time; for pulses, their times are known.

use sensedsl_model::kind::icu::{self, Icu};

use crate::arith::{nanoseconds, number};
use crate::truth::Subject;
use crate::world::Signal;

/// How far ahead an edge is searched for.
const HORIZON_NS: u64 = 3_600_000_000_000;
/// The precision of the times of edges.
const PRECISION_NS: u64 = 1_000;
/// The time from one pulse to the next if nothing else determines it: that of model receivers.
const PULSES_NS: u64 = 20_000_000;
/// The pause between the longest pulse and the next one.
const REST_NS: u64 = 5_000_000;
/// The period whose duty cycle is measured.
pub(crate) const DUTY_NS: u64 = 10_000_000;
/// The time from the end of a trigger to the echo.
const ECHO_NS: u64 = 450_000;
/// The length of the pulse between two channels of a train.
const MARK_NS: u64 = 300_000;
/// The longest channel of a train, and the pause after the last one.
const CHANNEL_NS: u64 = 2_100_000;
const TRAIN_REST_NS: u64 = 6_000_000;
/// Spikes on the wire of a contact: by how much they are shorter than the debounce time, as a time and in per cent;
/// their shortest length; the time between them.
const SPIKE_LESS_NS: u64 = 500_000;
const SPIKE_LESS_PERCENT: u64 = 10;
const SPIKE_MIN_NS: u64 = 500_000;
const SPIKES_NS: u64 = 171_000_000;
/// The time after which a signal without a frequency is evaluated again.
const IDLE_NS: u64 = 10_000_000;

/// The signal on a wire.
#[derive(Clone, Debug)]
pub(crate) enum Line {
    /// A level, on or off, with spikes that are too short to count.
    Level { subject: usize, element: usize, is_active_low: bool, spikes: Spikes },
    /// A number of edges since the start.
    Count { subject: usize, element: usize, edges: Edges },
    /// A track of an encoder.
    Track { subject: usize, element: usize, is_second: bool },
    /// Pulses of a measured width at a fixed pace.
    Width { subject: usize, element: usize, tick_ns: f64, period_ns: u64, is_low: bool },
    /// A pulse of a measured width that follows a trigger.
    Echo { subject: usize, element: usize, tick_ns: f64, is_low: bool, pulse: Option<(u64, u64)> },
    /// Pulses whose period or frequency is the measured quantity.
    Period {
        subject: usize,
        element: usize,
        unit: Unit,
        is_low: bool,
        began_ns: u64,
        period_ns: Option<u64>,
    },
    /// A fixed period whose duty cycle is measured.
    Duty { subject: usize, element: usize, is_low: bool },
    /// The pulse train with all channels of a model receiver.
    Train { subject: usize, tick_ns: f64, is_low: bool },
}

/// Interference on a contact's wire: now and then, the opposite level for a moment.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Spikes {
    every_ns: u64,
    for_ns: u64,
}

impl Spikes {
    /// The spikes that a contact with this debounce time must ignore; no spikes if the time is 0.
    pub(crate) const fn below(lasting_ns: u64) -> Self {
        let less_ns = lasting_ns / 100 * SPIKE_LESS_PERCENT;
        let less_ns = if less_ns > SPIKE_LESS_NS { less_ns } else { SPIKE_LESS_NS };
        let for_ns = lasting_ns.saturating_sub(less_ns);
        let often_ns = lasting_ns.saturating_mul(8);
        let every_ns = if often_ns > SPIKES_NS { often_ns } else { SPIKES_NS };
        Self { every_ns, for_ns: if for_ns < SPIKE_MIN_NS { 0 } else { for_ns } }
    }

    /// The time from one spike to the next.
    pub(crate) const fn every_ns(&self) -> u64 {
        self.every_ns
    }

    /// The phase of a moment in the spikes' period. A spike is at the end of the period, away from whole multiples, at
    /// which a world's events happen.
    const fn phase_ns(&self, now_ns: u64) -> u64 {
        now_ns.saturating_add(self.every_ns / 2)
    }

    /// Whether there is a spike in a span of time.
    pub(crate) fn is_within(&self, from_ns: u64, to_ns: u64) -> bool {
        self.is_there(from_ns) || self.next(from_ns).is_some_and(|at_ns| at_ns <= to_ns)
    }

    const fn is_there(&self, now_ns: u64) -> bool {
        self.for_ns > 0 && self.phase_ns(now_ns) % self.every_ns >= self.every_ns - self.for_ns
    }

    /// The first start or end of a spike after a moment.
    fn next(&self, after_ns: u64) -> Option<u64> {
        if self.for_ns == 0 {
            return None;
        }
        let periods = self.phase_ns(after_ns) / self.every_ns + 1;
        let end_ns = periods * self.every_ns - self.every_ns / 2;
        let start_ns = end_ns - self.for_ns;
        Some(if start_ns > after_ns { start_ns } else { end_ns })
    }
}

/// The edges that count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Edges {
    Rising,
    Falling,
    Both,
}

/// The unit in which the distance of pulses is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Unit {
    /// Ticks, each of this many nanoseconds.
    Ticks(f64),
    /// Pulses a second.
    Hertz,
}

impl Line {
    /// The line on a capture's wire.
    pub(crate) fn of_capture(icu: &Icu, subject: usize, element: usize, of: &Subject) -> Self {
        let tick_ns = 1e9 / f64::from(icu.tick_hz.max(1));
        let is_low = icu.edge == icu::Edge::Falling;
        match icu.mode {
            icu::Mode::Count => {
                let edges = match icu.edge {
                    icu::Edge::Rising => Edges::Rising,
                    icu::Edge::Falling => Edges::Falling,
                    icu::Edge::Both => Edges::Both,
                };
                Self::Count { subject, element, edges }
            }
            icu::Mode::Width if icu.pulse_us.is_some() => {
                Self::Echo { subject, element, tick_ns, is_low, pulse: None }
            }
            icu::Mode::Width => {
                let bounds = of.signals.get(element).and_then(Signal::bounds);
                let ends = bounds.map_or([0.0, 0.0], |(least, greatest)| [least, greatest]);
                let widest = ends.map(|end| of.scale.raw(end)).into_iter().fold(0.0, f64::max);
                let period_ns =
                    PULSES_NS.max(nanoseconds(widest * tick_ns).saturating_add(REST_NS));
                Self::Width { subject, element, tick_ns, period_ns, is_low }
            }
            icu::Mode::Period | icu::Mode::Frequency => Self::Period {
                subject,
                element,
                unit: if icu.mode == icu::Mode::Period {
                    Unit::Ticks(tick_ns)
                } else {
                    Unit::Hertz
                },
                is_low,
                began_ns: 0,
                period_ns: None,
            },
            icu::Mode::Duty => Self::Duty { subject, element, is_low },
            icu::Mode::Ppm => Self::Train { subject, tick_ns, is_low },
        }
    }

    /// The part's trigger was released.
    pub(crate) fn triggered(&mut self, subjects: &[Subject], now_ns: u64) {
        if let Self::Echo { subject, element, tick_ns, pulse, .. } = self
            && pulse.is_none_or(|(_, end)| end <= now_ns)
        {
            let width = nanoseconds(raw(subjects, *subject, *element, now_ns) * *tick_ns);
            let start = now_ns.saturating_add(ECHO_NS);
            *pulse = Some((start, start.saturating_add(width)));
        }
    }

    /// The level at a moment.
    pub(crate) fn level(&mut self, subjects: &[Subject], now_ns: u64) -> bool {
        self.follow(subjects, now_ns);
        match self {
            Self::Level { subject, element, is_active_low, spikes } => {
                let is_on = is_on(raw(subjects, *subject, *element, now_ns));
                is_on != (*is_active_low != spikes.is_there(now_ns))
            }
            Self::Count { subject, element, edges } => {
                counted(*edges, steps(*edges, raw(subjects, *subject, *element, now_ns)))
            }
            Self::Track { subject, element, is_second } => {
                track(*is_second, raw(subjects, *subject, *element, now_ns).floor())
            }
            Self::Width { .. }
            | Self::Echo { .. }
            | Self::Period { .. }
            | Self::Duty { .. }
            | Self::Train { .. } => {
                let (start, end, _) = self.pulse(subjects, now_ns);
                (now_ns >= start && now_ns < end) != self.is_low()
            }
        }
    }

    /// The first edge after a moment, and the level after it.
    pub(crate) fn next_edge(&mut self, subjects: &[Subject], after_ns: u64) -> Option<(u64, bool)> {
        match self {
            Self::Level { subject, element, spikes, .. } => {
                let of = |raw: f64| f64::from(u8::from(is_on(raw)));
                let own = crossing(subjects, *subject, *element, after_ns, of).map(|one| one.0);
                let at = own.into_iter().chain(spikes.next(after_ns)).min()?;
                Some((at, self.level(subjects, at)))
            }
            Self::Count { subject, element, edges } => {
                let edges = *edges;
                let of = |raw: f64| steps(edges, raw);
                let (at, step) = crossing(subjects, *subject, *element, after_ns, of)?;
                Some((at, counted(edges, step)))
            }
            Self::Track { subject, element, is_second } => {
                let is_second = *is_second;
                // Each track changes at every second step.
                let half = |raw: f64| {
                    let step = raw.floor() + if is_second { 0.0 } else { 1.0 };
                    (step / 2.0).floor()
                };
                let (at, _) = crossing(subjects, *subject, *element, after_ns, half)?;
                Some((at, track(is_second, raw(subjects, *subject, *element, at).floor())))
            }
            Self::Width { .. }
            | Self::Echo { .. }
            | Self::Period { .. }
            | Self::Duty { .. }
            | Self::Train { .. } => {
                self.follow(subjects, after_ns);
                let is_low = self.is_low();
                let (start, end, next) = self.pulse(subjects, after_ns);
                if after_ns < start {
                    Some((start, !is_low))
                } else if after_ns < end {
                    Some((end, is_low))
                } else {
                    next.map(|next| (next, !is_low))
                }
            }
        }
    }

    const fn is_low(&self) -> bool {
        match self {
            Self::Level { .. } | Self::Count { .. } | Self::Track { .. } => false,
            Self::Width { is_low, .. }
            | Self::Echo { is_low, .. }
            | Self::Period { is_low, .. }
            | Self::Duty { is_low, .. }
            | Self::Train { is_low, .. } => *is_low,
        }
    }

    /// Goes on to the pulse at a moment; each pulse starts where the one before ends.
    fn follow(&mut self, subjects: &[Subject], now_ns: u64) {
        let Self::Period { subject, element, unit, began_ns, period_ns, .. } = self else { return };
        loop {
            let length = period_ns.unwrap_or(IDLE_NS);
            if *began_ns != 0 || period_ns.is_some() {
                let next = began_ns.saturating_add(length);
                if next > now_ns {
                    return;
                }
                *began_ns = next;
            } else {
                *began_ns = 1;
            }
            *period_ns = distance(*unit, raw(subjects, *subject, *element, *began_ns));
        }
    }

    /// The pulse at a moment: its start and end, and the start of the next one.
    fn pulse(&self, subjects: &[Subject], now_ns: u64) -> (u64, u64, Option<u64>) {
        match self {
            Self::Level { .. } | Self::Count { .. } | Self::Track { .. } => (0, 0, None),
            Self::Width { subject, element, tick_ns, period_ns, .. } => {
                let start = now_ns / period_ns * period_ns;
                let width = nanoseconds(raw(subjects, *subject, *element, start) * tick_ns);
                let end = start.saturating_add(width.min(period_ns - 1_000));
                (start, end, Some(start.saturating_add(*period_ns)))
            }
            Self::Echo { pulse, .. } => {
                pulse.map_or((0, 0, None), |(start, end)| (start, end, None))
            }
            Self::Period { began_ns, period_ns, .. } => match period_ns {
                Some(length) => {
                    let next = began_ns.saturating_add(*length);
                    (*began_ns, began_ns.saturating_add(length / 2), Some(next))
                }
                // The signal may have a frequency again by then.
                None => (0, 0, None),
            },
            Self::Duty { subject, element, .. } => {
                let start = now_ns / DUTY_NS * DUTY_NS;
                let share = raw(subjects, *subject, *element, start).clamp(1.0, 9_999.0) / 10_000.0;
                let end = start.saturating_add(nanoseconds(share * number(DUTY_NS)));
                (start, end, Some(start.saturating_add(DUTY_NS)))
            }
            Self::Train { subject, tick_ns, .. } => train(subjects, *subject, *tick_ns, now_ns),
        }
    }
}

/// The time from one train with this many channels to the next.
pub(crate) fn frame_ns(channels: usize) -> u64 {
    let count = u64::try_from(channels).unwrap_or(0);
    PULSES_NS.max(count * CHANNEL_NS + TRAIN_REST_NS)
}

/// The last mark of a train that starts before a moment.
fn train(
    subjects: &[Subject],
    subject: usize,
    tick_ns: f64,
    now_ns: u64,
) -> (u64, u64, Option<u64>) {
    let channels = subjects.get(subject).map_or(0, |one| one.signals.len());
    let frame_ns = frame_ns(channels);
    let frame = now_ns / frame_ns * frame_ns;
    let (mut mark, mut next) = (frame, None);
    for channel in 0..channels {
        let width = nanoseconds(raw(subjects, subject, channel, frame) * tick_ns);
        let after = next.unwrap_or(frame).saturating_add(width.clamp(2 * MARK_NS, CHANNEL_NS));
        if after > now_ns {
            return (mark, mark + MARK_NS, Some(after));
        }
        (mark, next) = (after, Some(after));
    }
    (mark, mark + MARK_NS, Some(frame + frame_ns))
}

fn raw(subjects: &[Subject], subject: usize, element: usize, now_ns: u64) -> f64 {
    subjects.get(subject).map_or(0.0, |one| one.raw(element, now_ns))
}

/// The levels of a contact's element in a span of time, each with its start; the first one starts with the span.
pub(crate) fn levels(
    subject: &Subject,
    element: usize,
    from_ns: u64,
    to_ns: u64,
) -> Vec<(u64, bool)> {
    let of = |raw: f64| f64::from(u8::from(is_on(raw)));
    let mut all = vec![(from_ns, is_on(subject.raw(element, from_ns)))];
    let mut at_ns = from_ns;
    while let Some((next_ns, level)) =
        crossing(std::slice::from_ref(subject), 0, element, at_ns, of)
        && next_ns <= to_ns
    {
        all.push((next_ns, level >= 0.5));
        at_ns = next_ns;
    }
    all
}

fn is_on(raw: f64) -> bool {
    raw >= 0.5
}

/// The number of level changes so far: two for each edge if only one kind of edge counts.
fn steps(edges: Edges, raw: f64) -> f64 {
    match edges {
        Edges::Both => raw.floor(),
        Edges::Rising | Edges::Falling => (2.0 * raw).floor(),
    }
}

/// The level after that many changes.
fn counted(edges: Edges, steps: f64) -> bool {
    let is_odd = steps.rem_euclid(2.0) == 1.0;
    match edges {
        Edges::Both => is_odd,
        // The edge that counts comes with each whole number, the other one halfway to the next.
        Edges::Rising => !is_odd && steps >= 2.0,
        Edges::Falling => is_odd || steps < 2.0,
    }
}

/// The level of a track. As the position rises, the first track leads.
fn track(is_second: bool, position: f64) -> bool {
    let phase = position.rem_euclid(4.0);
    if is_second { phase >= 2.0 } else { (1.0..3.0).contains(&phase) }
}

pub(crate) fn distance(unit: Unit, raw: f64) -> Option<u64> {
    let length = match unit {
        Unit::Ticks(tick_ns) => raw * tick_ns,
        Unit::Hertz if raw > 0.0 => 1e9 / raw,
        Unit::Hertz => return None,
    };
    let length = nanoseconds(length);
    (2 * PRECISION_NS..HORIZON_NS).contains(&length).then_some(length)
}

/// The first moment after another one at which a function of a quantity has a new value, and that value.
fn crossing(
    subjects: &[Subject],
    subject: usize,
    element: usize,
    after_ns: u64,
    of: impl Fn(f64) -> f64,
) -> Option<(u64, f64)> {
    let subject = subjects.get(subject)?;
    let signal = subject.signals.get(element)?;
    let now = of(subject.raw(element, after_ns));
    let may_differ = |from: u64, to: u64| {
        let (least, greatest) = signal.range(from, to);
        of(subject.scale.raw(least)) != now || of(subject.scale.raw(greatest)) != now
    };
    let (mut from, mut span) = (after_ns, 1_000_000);
    while from < after_ns.saturating_add(HORIZON_NS) {
        let to = from.saturating_add(span);
        if may_differ(from, to)
            && let Some(at) =
                search(from, to, &may_differ, &|at| of(subject.raw(element, at)) != now)
        {
            return Some((at, of(subject.raw(element, at))));
        }
        from = to;
        span = span.saturating_mul(2);
    }
    None
}

/// The first moment in a span at which something differs.
fn search(
    from: u64,
    to: u64,
    may_differ: &impl Fn(u64, u64) -> bool,
    differs: &impl Fn(u64) -> bool,
) -> Option<u64> {
    if !may_differ(from, to) {
        return None;
    }
    if to - from <= PRECISION_NS {
        return differs(to).then(|| first(from, to, differs));
    }
    let middle = from + (to - from) / 2;
    search(from, middle, may_differ, differs).or_else(|| search(middle, to, may_differ, differs))
}

/// The first moment, to the nanosecond: a search from just before it must find it again.
fn first(from: u64, to: u64, differs: &impl Fn(u64) -> bool) -> u64 {
    let (mut from, mut to) = (from, to);
    while to - from > 1 {
        let middle = from + (to - from) / 2;
        if differs(middle) {
            to = middle;
        } else {
            from = middle;
        }
    }
    to
}
