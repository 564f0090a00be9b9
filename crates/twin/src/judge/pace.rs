//! How often a device should report, and how often it does.

use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_model::design::protocol::InitStep;
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::icu::Mode;

use super::findings::{Disagreement, Finding, MS, SECOND};
use crate::arith::number;
use crate::bench::Bench;
use crate::parts::pulses;
use crate::truth::Subject;

/// How often a board looks for values to report, unless its link sets the rate.
const REPORTER_NS: u64 = 10 * MS;
/// How often an unchanged count is reported again.
pub(super) const REPEAT_NS: u64 = SECOND;
/// The time that a measurement takes apart from its waiting.
const MEASURING_NS: u64 = 3 * MS;
/// An additional delay of the first value: other parts on its bus are set up and measure before it.
const FIRST_NS: u64 = SECOND;
/// The least number of intervals for a verdict on the pace.
const TIMES_MIN: u64 = 3;
/// The tolerance of a pace, in per cent.
const PERCENT: u64 = 10;
/// The tolerance of a pace that the board's own clock sets, in parts per thousand.
const REGULAR_PER_MILLE: u64 = 10;

/// The time from one report to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pace {
    /// The shortest average.
    pub(super) least_ns: u64,
    /// The longest average, while there is something to report.
    pub(super) most_ns: u64,
    /// By how much a single interval may be shorter or longer than that.
    pub(super) jitter_ns: u64,
    /// The delay of a report while the board answers its host.
    pub(super) turn_ns: u64,
    /// Whether the board's own clock sets the pace.
    pub(super) is_regular: bool,
    /// The longest time until the first value, if the board measures it as soon as it is up, however long its cycle is;
    /// `None` if something other than the board's clock determines when there is a value.
    pub(super) first_ns: Option<u64>,
    /// The pauses that the board's parts need while they are set up, which the first value may have to wait for.
    pub(super) pauses_ns: u64,
}

impl Pace {
    /// The pace of a sensor; `None` if the world sends nothing that could be measured.
    pub(super) fn of(
        job: &BoardJob<'_>,
        bench: &Bench,
        one: &JobDevice<'_>,
        subject: &Subject,
    ) -> Option<Self> {
        let device = one.device;
        let report_ms = job.board.link.report_ms();
        let reporter_ns = report_ms.map_or(REPORTER_NS, |ms| MS * u64::from(ms));
        let cycle_ns = (MS * u64::from(one.cycle.delay_ms.max(device.delay_ms))).max(MS);
        let (least_ns, most_ns, own_ns) = match device.kind.interface() {
            Interface::Encoder(_) | Interface::Stepper(_) => (0, REPEAT_NS, 0),
            Interface::Icu(icu) if icu.mode == Mode::Count => (0, REPEAT_NS, 0),
            Interface::Digital(own) if own.edge.is_some() => (0, cycle_ns, 0),
            Interface::Digital(_) | Interface::Analog(_) => (cycle_ns, cycle_ns, 0),
            Interface::I2c(_) | Interface::Spi(_) | Interface::OneWire(_) => {
                let (least_ns, most_ns) = of_chip(job, one, cycle_ns);
                (least_ns, most_ns, 0)
            }
            // The round of a line may begin with another part.
            Interface::Uart(own) if !own.exchange.request.is_empty() => {
                (cycle_ns, cycle_ns, bench.period_ns(device.part)?)
            }
            Interface::Uart(_) | Interface::Can(_) => {
                let period_ns = bench.period_ns(device.part)?;
                (cycle_ns.max(period_ns), cycle_ns.max(period_ns), 2 * period_ns + cycle_ns)
            }
            Interface::Icu(icu) => {
                let (shortest_ns, longest_ns) = pulses::apart(icu, subject, 0, u64::MAX / 2)?;
                let is_asked = icu.mode == Mode::Width && icu.pulse_us.is_some();
                let count = u64::try_from(subject.signals.len()).unwrap_or(1);
                let waits_ns = count * 1_000 * u64::from(icu.wait_us).max(1_000);
                // `wait` is the longest time that an echo can take: most come sooner.
                let (least_ns, most_ns) =
                    if is_asked { (cycle_ns, cycle_ns.max(waits_ns)) } else { (0, 0) };
                (shortest_ns.max(least_ns), longest_ns.max(most_ns), 2 * longest_ns)
            }
            Interface::Pwm(_) | Interface::Dac(_) | Interface::Code(_) => return None,
        };
        let is_regular = least_ns == most_ns && own_ns == 0;
        let most_ns = most_ns.max(reporter_ns);
        let jitter_ns = 2 * reporter_ns + own_ns;
        let least_ns = least_ns.min(most_ns);
        let first_ns = match device.kind.interface() {
            Interface::Analog(_) => Some(MEASURING_NS),
            Interface::I2c(_) | Interface::Spi(_) => Some(of_chip(job, one, MS).1),
            // Its parts need a pause once they have power.
            Interface::OneWire(_) => None,
            Interface::Icu(_)
            | Interface::Encoder(_)
            | Interface::Digital(_)
            | Interface::Uart(_)
            | Interface::Pwm(_)
            | Interface::Dac(_)
            | Interface::Can(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => None,
        };
        // A median may need several values before it has one.
        let first_ns = first_ns.filter(|_| device.filter.median < 2);
        let (turn_ns, pauses_ns) = (reporter_ns, pauses_ns(job));
        Some(Self { least_ns, most_ns, jitter_ns, turn_ns, is_regular, first_ns, pauses_ns })
    }

    /// The longest silence that is still normal.
    pub(super) const fn gap_ns(&self) -> u64 {
        3 * self.most_ns + self.jitter_ns
    }

    /// The longest silence before the first value that is still normal.
    pub(super) fn first_gap_ns(&self) -> u64 {
        let first_ns = self.first_ns.map(|ns| 3 * ns + self.jitter_ns + FIRST_NS);
        first_ns.map_or(self.gap_ns(), |ns| ns.min(self.gap_ns())) + self.pauses_ns
    }
}

/// The pauses of all parts of a board that are set up.
fn pauses_ns(job: &BoardJob<'_>) -> u64 {
    let steps =
        job.parts.iter().filter_map(|one| one.part.chip.as_ref()).flat_map(|chip| &chip.init);
    let pauses = steps.map(|step| match step {
        InitStep::Wait { ms } => MS * u64::from(*ms),
        InitStep::Write(_) => 0,
    });
    pauses.sum()
}

/// The shortest time from one report to the next: the shortest cycle of anything that can become due, or the one that
/// the link sets.
pub(super) fn reporter_ns(job: &BoardJob<'_>) -> u64 {
    if let Some(report_ms) = job.board.link.report_ms() {
        return MS * u64::from(report_ms);
    }
    let cycles = job.devices.iter().flat_map(|one| [one.cycle.delay_ms, one.device.delay_ms]);
    let cycles = cycles.chain(sensedsl_job::kinds::can::repeats_ms(job));
    cycles.filter(|ms| *ms > 0).map(|ms| MS * u64::from(ms)).fold(REPORTER_NS, u64::min)
}

/// The shortest and the longest cycle of a chip's device. A chip measures one thing after another, and misses whole
/// cycles if that takes longer than one.
fn of_chip(job: &BoardJob<'_>, one: &JobDevice<'_>, cycle_ns: u64) -> (u64, u64) {
    let of_part = job.devices.iter().filter(|of| of.device.part == one.device.part);
    let mut asked: Vec<(&[u8], u64)> = Vec::new();
    for of in of_part {
        let Some(own) = of.device.kind.register_access() else { continue };
        let (trigger, wait_us) = (own.trigger, own.wait_us);
        let wait_ns = 1_000 * u64::from(wait_us);
        if !trigger.is_empty() && !asked.contains(&(trigger, wait_ns)) {
            asked.push((trigger, wait_ns));
        }
    }
    let waits_ns: u64 = asked.iter().map(|(_, wait_ns)| wait_ns).sum();
    let longest_ns = asked.iter().map(|(_, wait_ns)| *wait_ns).max().unwrap_or(0);
    let count = u64::try_from(asked.len()).unwrap_or(0);
    let measuring_ns = waits_ns + (count + 1) * MEASURING_NS;
    let cycles = measuring_ns.div_ceil(cycle_ns).max(1);
    let most_ns = if waits_ns == 0 { cycle_ns } else { cycles * cycle_ns };
    (cycle_ns.max(longest_ns), most_ns.max(cycle_ns))
}

/// The time between reports so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ReportIntervals {
    sum_ns: u64,
    times: u64,
    /// The time of the last report, if the interval that starts there may count.
    last_ns: Option<u64>,
    /// How often the board has answered its host in that time.
    answers: u64,
}

impl ReportIntervals {
    /// A report has come. The interval since the one before counts unless something explains its length. A report that
    /// was delayed by an answer to the host says nothing about when the next one comes.
    pub(super) fn take(&mut self, now_ns: u64, counts: bool, has_waited: bool) {
        if let Some(last_ns) = self.last_ns.filter(|_| counts) {
            self.sum_ns += now_ns - last_ns;
            self.times += 1;
        }
        self.last_ns = (!has_waited).then_some(now_ns);
    }

    /// The board has answered its host, so a report that was due had to wait.
    pub(super) fn answered(&mut self) {
        self.answers += u64::from(self.last_ns.is_some());
    }

    /// The next interval says nothing about the pace.
    pub(super) fn interrupt(&mut self) {
        self.last_ns = None;
    }

    /// The average time from one report to the next.
    pub(super) fn mean_ns(&self) -> Option<u64> {
        (self.times >= TIMES_MIN).then(|| self.sum_ns / self.times.max(1))
    }

    /// The finding if the measured pace is not the expected one.
    pub(super) fn differs(
        &self,
        now_ns: u64,
        pace: &Pace,
        may_be_slow: bool,
    ) -> Option<Disagreement> {
        let got_ns = self.mean_ns()?;
        let jitter_ns = pace.jitter_ns / self.times.max(1);
        let answers_ns = self.answers * pace.turn_ns / self.times.max(1);
        let per_mille = if pace.is_regular { REGULAR_PER_MILLE } else { 10 * PERCENT };
        let off = |ns: u64| ns.saturating_mul(per_mille) / 1_000;
        let slowest_ns = pace.most_ns + off(pace.most_ns) + jitter_ns + answers_ns;
        let fastest_ns = pace.least_ns - off(pace.least_ns);
        let is_slow = got_ns > slowest_ns && !may_be_slow;
        let is_fast = got_ns + jitter_ns < fastest_ns;
        let ratio =
            number(got_ns.max(1)) / number(if is_slow { pace.most_ns } else { pace.least_ns });
        let expected_ns = (pace.least_ns, pace.most_ns);
        (is_slow || is_fast).then(|| Disagreement {
            at_ns: now_ns,
            finding: Finding::Pace { expected_ns, got_ns },
            // A wrong pace explains values that are too old, but not the other way round.
            off: 1_000.0 * ratio.max(1.0 / ratio),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_waited_for_its_host_says_nothing_of_the_pace() {
        let mut paced = ReportIntervals::default();
        for (at_ms, has_waited) in
            [(1_320, true), (2_000, false), (3_000, false), (4_000, false), (5_000, false)]
        {
            paced.take(at_ms * MS, true, has_waited);
        }
        assert_eq!(paced.mean_ns(), Some(SECOND));
    }
}
