//! Counts are reported when they change, and once a second while they do not. Checked here: how late they are reported,
//! and how often they are repeated.
//!
//! In: the time of a value and of the one before it. Out: how long, on average, the world had already counted on by
//! then.

use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::icu::Mode;

use super::age::link_ns;
use super::findings::{Disagreement, Finding, MS};
use super::pace::{Pace, REPEAT_NS};
use crate::arith::number;
use crate::truth::Subject;

/// The interval at which a 16-bit timer that counts the steps of an encoder is read.
const READ_NS: u64 = 10 * MS;
/// The least number of values for a verdict on how late they are.
const TIMES_MIN: u64 = 10;
/// By how much the average may exceed the longest delay of a single value, in per cent.
const PERCENT: u64 = 10;
/// By how much a count may be repeated too early, in per cent: samples are not taken at exact times.
const EARLY_PERCENT: u64 = 10;

/// How late the values of a count have been so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counted {
    /// The longest delay that a value may have.
    most_ns: u64,
    /// Whether an unchanged count is repeated only once a second.
    is_repeated: bool,
    sum_ns: u64,
    times: u64,
}

impl Counted {
    /// The state for a sensor that is reported when it changes; `None` for any other.
    pub(super) fn of(job: &BoardJob<'_>, one: &JobDevice<'_>, pace: Option<&Pace>) -> Option<Self> {
        let filter = &one.device.filter;
        let is_plain = filter.change.is_none() && filter.median < 2 && filter.smooth_ms == 0;
        let (read_ns, is_repeated) = match one.device.kind.interface() {
            Interface::Icu(icu) if icu.mode == Mode::Count => (0, true),
            Interface::Encoder(_) | Interface::Stepper(_) => (READ_NS, true),
            Interface::Digital(own) if own.edge.is_some() && own.debounce_us == 0 => (0, false),
            Interface::Icu(_)
            | Interface::Digital(_)
            | Interface::Analog(_)
            | Interface::I2c(_)
            | Interface::Spi(_)
            | Interface::OneWire(_)
            | Interface::Uart(_)
            | Interface::Pwm(_)
            | Interface::Dac(_)
            | Interface::Can(_)
            | Interface::Code(_) => return None,
        };
        let most_ns = pace?.turn_ns + read_ns + link_ns(job);
        is_plain.then_some(Self { most_ns, is_repeated, sum_ns: 0, times: 0 })
    }

    /// Takes a value that has come after another one.
    pub(super) fn take(&mut self, subject: &Subject, last_ns: u64, now_ns: u64) {
        if let Some(late_ns) = late_ns(subject, last_ns, now_ns) {
            self.sum_ns += late_ns;
            self.times += 1;
        }
    }

    /// Whether an unchanged value is repeated too early, so long after the last report.
    pub(super) fn is_too_early(&self, after_ns: u64) -> bool {
        self.is_repeated && after_ns < REPEAT_NS - REPEAT_NS / 100 * EARLY_PERCENT
    }

    /// Whether values come later than the board has to report them.
    pub(super) fn differs(&self, now_ns: u64) -> Option<Disagreement> {
        let got_ns = self.sum_ns.checked_div(self.times)?;
        let most_ns = self.most_ns + self.most_ns * PERCENT / 100 + MS;
        let is_late = self.times >= TIMES_MIN && got_ns > most_ns;
        is_late.then(|| Disagreement {
            at_ns: now_ns,
            finding: Finding::Late { most_ns: self.most_ns, got_ns },
            off: 1_000.0 * number(got_ns) / number(self.most_ns.max(1)),
        })
    }
}

/// For how long, at the time of a value, the world has already differed from the value before; `None` if it does not
/// differ.
fn late_ns(subject: &Subject, last_ns: u64, now_ns: u64) -> Option<u64> {
    let elements = 0..subject.signals.len();
    let counts = |at_ns: u64| elements.clone().map(move |one| subject.raw(one, at_ns).floor());
    let before: Vec<f64> = counts(last_ns).collect();
    let is_same = |at_ns: &u64| counts(*at_ns).zip(&before).all(|(one, other)| one == *other);
    let steps = (0..).map(|step: u64| now_ns.saturating_sub(step * MS));
    let since_ns = steps.take_while(|at_ns| *at_ns > last_ns).find(is_same).unwrap_or(last_ns);
    (since_ns < now_ns).then(|| now_ns - since_ns)
}
