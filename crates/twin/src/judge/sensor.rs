//! The judge of one sensor: its values against the world, and its silences.

use sensedsl_codegen::job::{BoardJob, JobDevice};
use sensedsl_model::kind::Kind;
use sensedsl_model::kind::icu::Mode;
use sensedsl_wire::Scalar;

use super::age::{link_ns, measured_ns};
use super::tolerance::tolerance;
use super::{Judged, MS, SECOND, Wrong};
use crate::bench::Bench;
use crate::range::{is_counter, raw_range};
use crate::truth::{Subject, real};

/// What a value waits for beside its device: two cycles of the reporter and its way over a link.
const SLACK_NS: u64 = 40 * MS;
/// How long a board may take to start before it must report.
const START_NS: u64 = 2 * SECOND;
/// How long a bus is left alone at most after something held it, and a chip takes to start again.
const RECOVERY_NS: u64 = 1_500 * MS;
/// A low-pass is as good as there after so many of its time constants, and this is what is left.
const SETTLED: u64 = 8;
const UNSETTLED: f64 = 0.000_34;

#[derive(Clone, Debug)]
pub(super) struct SensorJudge {
    pub(super) subject: Subject,
    pub(super) judged: Judged,
    /// In raw numbers.
    tolerance: f64,
    /// No longer silence is possible; none where silence says nothing.
    gap_ns: Option<u64>,
    bounds: Option<(f64, f64)>,
    excuses: Vec<(u64, u64)>,
    is_relative: bool,
    /// Where it was before the board was up is unknown.
    is_anywhere: bool,
    /// What a count may have begun with, less what the world had: from, to.
    bases: Vec<Option<(f64, f64)>>,
    last_ns: Option<u64>,
    /// When a value may have been measured at the earliest, because no host was there to take it before.
    waits_from_ns: Option<u64>,
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
        let mut age_ns = SLACK_NS + link_ns(job) + measured_ns(one, subject, period_ns);
        age_ns += SETTLED * MS * u64::from(filter.smooth_ms);
        age_ns += u64::from(filter.median) * delay_ns.max(period_ns);
        let mut tolerance = tolerance(job, one, subject);
        if let Some((least, greatest)) = raw_range(device).filter(|_| filter.smooth_ms > 0) {
            tolerance += 1.0 + UNSETTLED * (greatest - least).min(1e6);
        }
        let is_told_always = filter.change.is_none() && filter.invalid.is_empty();
        let silent_ns = 3 * delay_ns.max(period_ns).max(SECOND) + age_ns;
        let has_pulses = device.kind.icu().is_none_or(|icu| icu.mode == Mode::Count);
        let gap_ns = (is_told_always && has_pulses).then_some(silent_ns);
        let quantity = device.shown.quantity.clone().unwrap_or_default();
        let judged = Judged {
            name: subject.name.clone(),
            quantity,
            reports: 0,
            excused: 0,
            wrong: 0,
            worst: None,
            age_ns,
        };
        let is_encoder = matches!(device.kind, Kind::Encoder(_));
        Self {
            judged,
            tolerance,
            gap_ns,
            bounds: raw_range(device),
            excuses: bench.excused(job, one.index),
            is_anywhere: is_encoder,
            is_relative: is_encoder || is_counter(&device.kind, device),
            bases: vec![None; subject.signals.len()],
            last_ns: None,
            waits_from_ns: Some(0),
            subject: subject.clone(),
        }
    }

    pub(super) fn take(&mut self, now_ns: u64, elements: &[Scalar]) {
        self.silence(now_ns);
        self.last_ns = Some(now_ns);
        if self.is_excused(now_ns) {
            self.judged.excused += 1;
            // A board that has started again counts anew.
            self.bases.iter_mut().for_each(|base| *base = None);
            self.waits_from_ns = Some(now_ns);
            return;
        }
        self.judged.reports += 1;
        let mut worst: Option<Wrong> = None;
        for (element, scalar) in elements.iter().enumerate() {
            let got = real(*scalar);
            let wrong = if self.is_relative {
                self.compare_count(now_ns, element, got)
            } else {
                self.compare(now_ns, element, got)
            };
            let is_worse = |wrong: &Wrong| worst.as_ref().is_none_or(|worst| worst.off < wrong.off);
            if let Some(wrong) = wrong.filter(is_worse) {
                worst = Some(wrong);
            }
        }
        self.waits_from_ns = None;
        self.note(worst);
    }

    fn note(&mut self, wrong: Option<Wrong>) {
        let Some(wrong) = wrong else { return };
        self.judged.wrong += 1;
        if self.judged.worst.as_ref().is_none_or(|worst| worst.off < wrong.off) {
            self.judged.worst = Some(wrong);
        }
    }

    /// The raw numbers that an element can have had when what arrives now was measured.
    fn expected(&self, now_ns: u64, element: usize) -> (f64, f64) {
        let from_ns = now_ns.saturating_sub(self.judged.age_ns);
        let from_ns = self.waits_from_ns.map_or(from_ns, |first_ns| from_ns.min(first_ns));
        let signal = self.subject.signals.get(element);
        let (least, greatest) = signal.map_or((0.0, 0.0), |signal| signal.range(from_ns, now_ns));
        let ends = [least, greatest].map(|end| self.subject.scale.raw(end));
        let [one, other] =
            ends.map(|end| self.bounds.map_or(end, |(low, high)| end.clamp(low, high.max(low))));
        (one.min(other), one.max(other))
    }

    fn compare(&self, now_ns: u64, element: usize, got: f64) -> Option<Wrong> {
        let (least, greatest) = self.expected(now_ns, element);
        let below = (least - self.tolerance) - got;
        let above = got - (greatest + self.tolerance);
        let off = below.max(above);
        (off > 1e-9 * got.abs().max(1.0) || got.is_nan())
            .then(|| self.wrong(now_ns, element, (least, greatest), (got, off)))
    }

    /// What a counter counted before is unknown, but it must be the same for all reports.
    fn compare_count(&mut self, now_ns: u64, element: usize, got: f64) -> Option<Wrong> {
        let (least, greatest) = self.expected(now_ns, element);
        let found = (got - greatest - self.tolerance, got - least + self.tolerance);
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

    /// In the device's own unit.
    fn wrong(
        &self,
        at_ns: u64,
        element: usize,
        (least, greatest): (f64, f64),
        (got, off): (f64, f64),
    ) -> Wrong {
        let [one, other, got] = [least, greatest, got].map(|raw| self.subject.scale.shown(raw));
        let expected = Some((one.min(other), one.max(other)));
        Wrong { at_ns, element, expected, got, off: off / self.tolerance.max(0.5) }
    }

    /// By how much a count may be off because the board was not up: less or more.
    fn lost(&self, now_ns: u64, element: usize) -> (f64, f64) {
        let Some(signal) = self.subject.signals.get(element) else { return (0.0, 0.0) };
        let before = now_ns.min(START_NS + self.judged.age_ns);
        let (least, greatest) = signal.range(now_ns - before, now_ns);
        let width = (self.subject.scale.raw(greatest) - self.subject.scale.raw(least)).abs();
        let whole = self.subject.raw(element, now_ns).abs();
        (-width.max(whole), width.max(whole))
    }

    fn is_excused(&self, now_ns: u64) -> bool {
        let from_ns = now_ns.saturating_sub(self.judged.age_ns);
        let hits = |&(at, until): &(u64, u64)| now_ns >= at && from_ns <= until + RECOVERY_NS;
        self.excuses.iter().any(hits)
    }

    /// Whether nothing came for too long.
    pub(super) fn silence(&mut self, now_ns: u64) {
        let Some(gap_ns) = self.gap_ns else { return };
        let since_ns = self.last_ns.unwrap_or(0);
        let most_ns = gap_ns + if self.last_ns.is_none() { START_NS } else { 0 };
        let silent_ns = now_ns - since_ns;
        let is_explained =
            |&(at, until): &(u64, u64)| at <= now_ns && until + RECOVERY_NS + gap_ns >= since_ns;
        if silent_ns > most_ns && !self.excuses.iter().any(is_explained) {
            let off = crate::arith::number(silent_ns) / crate::arith::number(most_ns);
            let got = crate::bench::seconds(silent_ns);
            self.note(Some(Wrong { at_ns: now_ns, element: 0, expected: None, got, off }));
        }
    }
}
