//! The judge of a single sensor: its values and its silences against the world.

use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_model::design::Device;
use sensedsl_model::kind::icu::Mode;
use sensedsl_wire::{DeviceHealth, Scalar};

use super::age::{link_ns, measured_ns};
use super::counted::Counted;
use super::filtered::{Filtered, Shape};
use super::findings::{DeviceFindings, Disagreement, Finding, MS, SECOND};
use super::health::{Expected, wrong};
use super::pace::{Pace, ReportIntervals};
use super::pressed::ContactValues;
use super::silence::Reasons;
use super::tolerance::tolerance;
use crate::bench::Bench;
use crate::range::{is_counter, raw_range};
use crate::truth::{Subject, real};

/// The delay of a value after the device has measured it: two cycles of the reporter, and the way over a link.
const SLACK_NS: u64 = 40 * MS;
/// The longest time until a board that has started must report.
const START_NS: u64 = 2 * SECOND;
/// The longest time for which a bus is left alone after something held it, and which a chip takes to restart.
const RECOVERY_NS: u64 = 1_500 * MS;
/// A low-pass has practically settled after this many of its time constants.
const SETTLED: u64 = 8;

#[derive(Clone, Debug)]
pub(super) struct SensorJudge {
    pub(super) subject: Subject,
    pub(super) judged: DeviceFindings,
    /// The tolerance in raw numbers.
    tolerance: f64,
    /// How often it should report; `None` if the world gives it nothing to measure.
    pace: Option<Pace>,
    paced: ReportIntervals,
    /// How late its values are, for a device that is reported when it changes.
    counted: Option<Counted>,
    /// The values reported for a contact with a debounce time.
    pressed: Option<ContactValues>,
    reasons: Reasons,
    /// The time until which a board need not be up.
    start_ns: u64,
    /// The number of messages that the board may have received only in part.
    halves: u16,
    /// The last reported value, as far as it tells anything about the next one.
    last: Vec<f64>,
    /// Its filters, and how long they remember.
    shape: Shape,
    filtered: Vec<Filtered>,
    fed_since_ns: Option<u64>,
    memory_ns: u64,
    excuses: Vec<(u64, u64)>,
    is_relative: bool,
    /// The values that it may have whatever the world says, because it selects what else is in a frame.
    selections: Vec<f64>,
    /// Whether its position before the board was up is unknown.
    is_anywhere: bool,
    /// The range, from and to, of the count at the start minus that of the world.
    bases: Vec<Option<(f64, f64)>>,
    last_ns: Option<u64>,
    /// The earliest time at which a value may have been measured, because no host was there to take it before.
    waits_from_ns: Option<u64>,
}

/// The values that a CAN frame's selector can have: a selector determines what else is in the frame.
fn selections(job: &BoardJob<'_>, own: &Device) -> Vec<f64> {
    let selected = job.devices.iter().filter_map(|one| {
        let mux = one.device.kind.can()?.mux.as_ref()?;
        let is_of_part =
            one.device.part == own.part && own.coding.reading.as_ref() == Some(&mux.selector.value);
        let is_own =
            own.kind.can().is_some() && (own.name.value == mux.selector.value || is_of_part);
        is_own.then(|| crate::arith::number(mux.value.value))
    });
    selected.collect()
}

impl SensorJudge {
    pub(super) fn new(
        job: &BoardJob<'_>,
        bench: &Bench,
        one: &JobDevice<'_>,
        subject: &Subject,
    ) -> Self {
        let device = one.device;
        let filter = &device.filter;
        let period_ns = bench.period_ns(device.part).unwrap_or(0);
        let delay_ns = MS * u64::from(device.delay_ms);
        let age_ns = SLACK_NS
            + link_ns(job)
            + measured_ns(one, subject, period_ns)
            + bench.held_ns(device.part);
        let smooth_ns = MS * u64::from(filter.smooth_ms);
        let memory_ns =
            age_ns + SETTLED * smooth_ns + u64::from(filter.median) * delay_ns.max(period_ns);
        let tolerance = tolerance(job, one, subject);
        let pace = Pace::of(job, bench, one, subject);
        let shape = Shape {
            median: filter.median,
            smooth_ns,
            age_ns,
            cycle_ns: pace.map_or(delay_ns, |pace| pace.most_ns).max(delay_ns).max(MS),
            is_regular: pace.is_some_and(|pace| pace.is_regular),
            bounds: raw_range(device),
        };
        let icu = device.kind.icu().filter(|icu| icu.mode != Mode::Count);
        let reasons =
            Reasons { filter: filter.clone(), icu: icu.cloned(), tolerance, age_ns: memory_ns };
        let quantity = device.shown.quantity.clone();
        let judged =
            DeviceFindings { age_ns, ..DeviceFindings::new(subject.name.clone(), quantity) };
        let is_encoder = device.kind.encoder().is_some();
        Self {
            judged,
            tolerance,
            pace,
            shape,
            filtered: vec![Filtered::default(); subject.signals.len()],
            fed_since_ns: None,
            memory_ns,
            paced: ReportIntervals::default(),
            counted: Counted::of(job, one, pace.as_ref()),
            pressed: ContactValues::of(job, one),
            reasons,
            start_ns: START_NS + MS * u64::from(one.cycle.start_ms),
            halves: u16::from(device.kind.uart().is_some()),
            last: Vec::new(),
            excuses: bench.excused(job, one.index),
            selections: selections(job, device),
            is_anywhere: is_encoder,
            is_relative: is_encoder || is_counter(&device.kind, device),
            bases: vec![None; subject.signals.len()],
            last_ns: None,
            waits_from_ns: Some(0),
            subject: subject.clone(),
        }
    }

    pub(super) fn answered(&mut self) {
        self.paced.answered();
    }

    /// A value has come; the board's first report came at `first_ns`.
    pub(super) fn take(&mut self, now_ns: u64, first_ns: u64, elements: &[Scalar]) {
        self.silence(now_ns);
        let before_ns = self.last_ns.replace(now_ns).unwrap_or(0);
        let raw: Vec<f64> = elements.iter().map(|one| real(*one)).collect();
        if self.is_excused(now_ns) {
            self.judged.excused += 1;
            // A board that has restarted counts from the beginning.
            self.bases.iter_mut().for_each(|base| *base = None);
            self.waits_from_ns = Some(now_ns);
            self.forget_filters(now_ns);
            self.paced.interrupt();
            self.last = raw;
            return;
        }
        self.judged.reports += 1;
        let is_mute = self.reasons.is_mute(&self.subject, (before_ns, now_ns));
        let has_waited = self.pace.is_some_and(|pace| now_ns <= first_ns + 2 * pace.turn_ns);
        self.paced.take(now_ns, !is_mute, has_waited);
        if let Some(counted) = self.counted.as_mut().filter(|_| before_ns > self.start_ns) {
            counted.take(&self.subject, before_ns, now_ns);
        }
        if is_mute {
            self.forget_filters(now_ns);
        }
        let _ = self.fed_since_ns.get_or_insert(now_ns);
        if let Some(pressed) = &mut self.pressed {
            pressed.take(now_ns, &raw);
        }
        let mut worst = self.unfiltered(now_ns, before_ns, &raw);
        for (element, got) in raw.iter().enumerate() {
            let wrong = if self.is_relative {
                self.compare_count(now_ns, element, *got)
            } else {
                self.compare(now_ns, element, *got)
            };
            let is_worse =
                |wrong: &Disagreement| worst.as_ref().is_none_or(|worst| worst.off < wrong.off);
            if let Some(wrong) = wrong.filter(is_worse) {
                worst = Some(wrong);
            }
        }
        self.waits_from_ns = None;
        self.last = raw;
        self.judged.note(worst);
    }

    /// The finding if a value should not have been reported at all.
    fn unfiltered(&self, now_ns: u64, before_ns: u64, raw: &[f64]) -> Option<Disagreement> {
        let filter = &self.reasons.filter;
        let is_raw = filter.median < 2 && filter.smooth_ms == 0;
        let is_invalid =
            |raw: &&f64| filter.invalid.iter().any(|(low, high)| (*low..=*high).contains(*raw));
        let wrong = |finding| Some(Disagreement { at_ns: now_ns, finding, off: 100.0 });
        if let Some(raw) = raw.iter().find(is_invalid).filter(|_| is_raw) {
            return wrong(Finding::Invalid(self.subject.scale.shown(*raw)));
        }
        // The first values that a host receives from a board need not be changes.
        let is_known = self.last.len() == raw.len() && before_ns > self.start_ns;
        let after_ns = now_ns - before_ns;
        if let Some(counted) = &self.counted
            && is_known
            && raw == self.last
            && counted.is_too_early(after_ns)
        {
            return wrong(Finding::Again(after_ns));
        }
        let change = filter.change?;
        let is_heartbeat =
            filter.heartbeat_ms > 0 && after_ns > MS * u64::from(filter.heartbeat_ms) / 2;
        let is_near = |(one, other): (&f64, &f64)| (one - other).abs() < change * (1.0 - 1e-9);
        if !is_known || is_heartbeat || !raw.iter().zip(&self.last).all(is_near) {
            return None;
        }
        let (got, before) = (*raw.first()?, *self.last.first()?);
        let [got, before] = [got, before].map(|raw| self.subject.scale.shown(raw));
        wrong(Finding::Unchanged { got, before })
    }

    /// Forgets what the filters have seen.
    fn forget_filters(&mut self, now_ns: u64) {
        self.filtered.iter_mut().for_each(Filtered::forget);
        self.fed_since_ns = Some(now_ns);
    }

    /// The range of raw numbers that an element can have had when the value that arrives now was measured, and the
    /// tolerance.
    fn expected(&mut self, now_ns: u64, element: usize) -> (f64, f64, f64) {
        let shape = &self.shape;
        if !shape.is_plain()
            && let Some(filtered) = self.filtered.get_mut(element)
        {
            let fed_since_ns = self.waits_from_ns.or(self.fed_since_ns).unwrap_or(0);
            let span = (fed_since_ns, now_ns);
            let (least, greatest, more) = filtered.expected(shape, &self.subject, element, span);
            return (least, greatest, self.tolerance + more);
        }
        let from_ns = now_ns.saturating_sub(self.judged.age_ns);
        let from_ns = self.waits_from_ns.map_or(from_ns, |first_ns| from_ns.min(first_ns));
        let (least, greatest) = shape.range(&self.subject, element, from_ns, now_ns);
        (least, greatest, self.tolerance)
    }

    fn compare(&mut self, now_ns: u64, element: usize, got: f64) -> Option<Disagreement> {
        if self.selections.contains(&got) {
            return None;
        }
        let (least, greatest, tolerance) = self.expected(now_ns, element);
        let below = (least - tolerance) - got;
        let above = got - (greatest + tolerance);
        let off = below.max(above);
        (off > 1e-9 * got.abs().max(1.0) || got.is_nan())
            .then(|| self.wrong(now_ns, element, (least, greatest), (got, off)))
    }

    /// The start of a count is unknown, but it must be the same for all reports.
    fn compare_count(&mut self, now_ns: u64, element: usize, got: f64) -> Option<Disagreement> {
        let (least, greatest, tolerance) = self.expected(now_ns, element);
        let found = (got - greatest - tolerance, got - least + tolerance);
        let known = self.bases.get(element).copied().flatten();
        let (from, to) = match known {
            Some(known) => known,
            None if self.is_anywhere => found,
            None => {
                let (early, late) = self.lost(now_ns, element);
                (early - 3.0, late + 3.0)
            }
        };
        let both = (from.max(found.0), to.min(found.1));
        if both.0 <= both.1 {
            if let Some(base) = self.bases.get_mut(element) {
                *base = Some(both);
            }
            return None;
        }
        let expected = (least + from, greatest + to);
        Some(self.wrong(now_ns, element, expected, (got, both.0 - both.1)))
    }

    /// A finding, in the device's own unit.
    fn wrong(
        &self,
        at_ns: u64,
        element: usize,
        (least, greatest): (f64, f64),
        (got, off): (f64, f64),
    ) -> Disagreement {
        let [one, other, got] = [least, greatest, got].map(|raw| self.subject.scale.shown(raw));
        let expected = (one.min(other), one.max(other));
        let finding = Finding::Value { element, expected, got };
        Disagreement { at_ns, finding, off: off / self.tolerance.max(0.5) }
    }

    /// By how much a count may be off, down and up, because the board was not up.
    fn lost(&self, now_ns: u64, element: usize) -> (f64, f64) {
        let Some(signal) = self.subject.signals.get(element) else { return (0.0, 0.0) };
        let before = now_ns.min(START_NS + self.judged.age_ns);
        let (least, greatest) = signal.range(now_ns - before, now_ns);
        let width = (self.subject.scale.raw(greatest) - self.subject.scale.raw(least)).abs();
        let whole = self.subject.raw(element, now_ns).abs();
        (-width.max(whole), width.max(whole))
    }

    fn is_excused(&self, now_ns: u64) -> bool {
        let from_ns = now_ns.saturating_sub(self.memory_ns);
        let hits = |&(at, until): &(u64, u64)| now_ns >= at && from_ns <= until + RECOVERY_NS;
        self.excuses.iter().any(hits)
    }

    /// Reports a silence that lasts too long.
    fn silence(&mut self, now_ns: u64) {
        let Some(pace) = self.pace else { return };
        let gap_ns = self.last_ns.map_or(pace.first_gap_ns(), |_| pace.gap_ns());
        let gap_ns = gap_ns + self.judged.age_ns;
        let from_ns = self.last_ns.unwrap_or(self.start_ns);
        if now_ns <= from_ns.saturating_add(gap_ns) {
            return;
        }
        let excuses = &self.excuses;
        let faults = |from_ns: u64, to_ns: u64| {
            excuses.iter().any(|&(at, until)| at <= to_ns && until + RECOVERY_NS >= from_ns)
        };
        let span = (from_ns, now_ns);
        let since_ns =
            self.reasons.unexplained_since(&self.subject, span, gap_ns, &self.last, &faults);
        let silent_ns = now_ns - since_ns;
        if silent_ns > gap_ns {
            let off = 10.0 * crate::arith::number(silent_ns) / crate::arith::number(gap_ns);
            let since_ns = if since_ns == self.start_ns { 0 } else { since_ns };
            let finding = Finding::Silence(crate::bench::seconds(now_ns - since_ns));
            self.judged.note(Some(Disagreement { at_ns: now_ns, finding, off }));
        }
    }

    /// The board has reported the health of the device.
    pub(super) fn health(&mut self, now_ns: u64, row: &DeviceHealth) {
        let reasons = &self.reasons;
        let is_over = |&(at, until): &(u64, u64)| now_ns < at || until + 2 * RECOVERY_NS < now_ns;
        let gap_ns = self.pace.map(|pace| pace.gap_ns() + self.judged.age_ns);
        let is_mute = reasons.is_mute(&self.subject, (self.start_ns, now_ns));
        let is_up = |gap_ns: &u64| now_ns > self.start_ns + gap_ns;
        let expected = Expected {
            is_well: self.excuses.iter().all(is_over),
            was_well: self.excuses.is_empty(),
            may_be_invalid: reasons.may_be_invalid(&self.subject, 0, now_ns),
            age_ns: gap_ns.filter(is_up).filter(|_| !is_mute),
            halves: self.halves,
        };
        self.judged.note(expected.differs(row).map(|what| wrong(now_ns, what)));
    }

    /// Judges a device that has never reported: each silence by itself may have a reason, but not all of them together.
    fn mute(&mut self, now_ns: u64) {
        let has_reported = self.judged.reports + self.judged.excused + self.judged.wrong > 0;
        let Some(pace) = self.pace.filter(|_| !has_reported) else { return };
        let excuses = &self.excuses;
        let faults = |from_ns: u64, to_ns: u64| {
            excuses.iter().any(|&(at, until)| at <= to_ns && until + RECOVERY_NS >= from_ns)
        };
        let span = (self.start_ns, now_ns);
        let silent_ns = self.reasons.reportable_ns(&self.subject, span, &faults);
        // A median may need several values before it has one.
        let cycles = 2 + u64::from(self.reasons.filter.median);
        if silent_ns > cycles * pace.most_ns + self.judged.age_ns {
            let finding = Finding::Silence(crate::bench::seconds(now_ns));
            self.judged.note(Some(Disagreement { at_ns: now_ns, finding, off: 10.0 }));
        }
    }

    /// Ends the run.
    pub(super) fn finish(&mut self, now_ns: u64) {
        self.silence(now_ns);
        self.mute(now_ns);
        self.judged.every_ns = self.paced.mean_ns();
        let may_be_slow = self.reasons.filter.change.is_some();
        let differs = self.pace.and_then(|pace| self.paced.differs(now_ns, &pace, may_be_slow));
        self.judged.note(differs);
        self.judged.note(self.counted.and_then(|counted| counted.differs(now_ns)));
        let span = (self.start_ns, now_ns);
        let age_ns = self.judged.age_ns;
        let pressed = self.pressed.as_ref().filter(|_| self.excuses.is_empty());
        let unseen = pressed.and_then(|one| one.differs(&self.subject, span, age_ns));
        self.judged.note(unseen);
    }
}
