//! One actuator: its commands and their times, the time by which each must have taken effect, and
//! the findings.

use sensedsl_host::Scale;
use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_model::design::Transport;
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::stepper::{Mode, Stepper};
use sensedsl_wire::{Direction, Scalar};

use super::command::Command;
use super::expect::{self, Expectation, Expected};
use super::outputs::Outputs;
use super::{MS, compare, script};
use crate::arith::number;
use crate::bench::Bench;
use crate::truth::{real, scale_of};

/// The time that every command takes: a few cycles of the reporter.
const SETTLE_NS: u64 = 60 * MS;
/// The longest time for which a bus is left alone after something held it, and which a chip takes
/// to restart.
const RECOVERY_NS: u64 = 1_500 * MS;

/// A wire that does not carry what it must.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WireMismatch {
    /// The time of the check.
    pub at_ns: u64,
    /// The element of the value.
    pub element: usize,
    /// The wire and its pins: `Left.in1 at PB4`.
    pub wire: String,
    /// The host's last action: `after -100 %`.
    pub after: String,
    /// The expected output.
    pub expected: String,
    /// The output found.
    pub got: String,
}

/// The findings about an actuator, or about a level that never changes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ActuatorFindings {
    /// Its name, or the wire.
    pub name: String,
    /// Whether the host sets it.
    pub is_set: bool,
    /// The number of values that it was set to.
    pub commands: u64,
    /// The number of values that there was no time for.
    pub left: u64,
    /// Whether there was no time to try the silence that it has a failsafe for.
    pub is_silence_left: bool,
    /// The number of times that its wires were compared.
    pub looks: u64,
    /// The number of comparisons left out because of a fault of the world.
    pub excused: u64,
    /// The number of comparisons that failed.
    pub wrong: u64,
    /// The first failure.
    pub first: Option<WireMismatch>,
}

impl ActuatorFindings {
    pub(super) fn of(name: String) -> Self {
        Self { name, ..Self::default() }
    }

    /// Compares wires with the outputs since a given time.
    pub(super) fn compare(
        &mut self,
        all: &[Expected],
        outputs: &Outputs,
        (since_ns, at_ns): (u64, u64),
        after: &str,
    ) {
        if all.is_empty() {
            return;
        }
        self.looks += 1;
        let wrong = all.iter().find_map(|one| {
            let got = compare::differs(one, outputs, (since_ns, at_ns))?;
            let (element, wire) = (one.element, one.wire.clone());
            let (after, expected) = (after.to_owned(), compare::shown(one));
            Some(WireMismatch { at_ns, element, wire, after, expected, got })
        });
        self.wrong += u64::from(wrong.is_some());
        self.first = self.first.take().or(wrong);
    }
}

/// An actuator with its script.
#[derive(Clone, Debug)]
pub(super) struct Actor {
    /// Its place in the job.
    index: usize,
    pub(super) id: u8,
    scale: Scale,
    quantity: String,
    /// The time that it takes to follow a command.
    pub(super) settle_ns: u64,
    /// The values, and the earliest time at which each may be sent.
    steps: Vec<(u64, Vec<Scalar>)>,
    /// Whether the world gave the steps.
    is_of_world: bool,
    next: usize,
    /// The earliest time of its next command.
    pub(super) due_ns: u64,
    /// The time by which the last command must have taken effect.
    settles_ns: Option<u64>,
    /// The last command and its time.
    reported: Option<(u64, Vec<Scalar>)>,
    excuses: Vec<(u64, u64)>,
    tried: ActuatorFindings,
}

impl Actor {
    pub(super) fn new(
        job: &BoardJob<'_>,
        bench: &Bench,
        index: usize,
        values: Vec<Vec<Scalar>>,
    ) -> Self {
        let one = job.devices.get(index);
        let name = one.map(|one| one.name().to_owned()).unwrap_or_default();
        let shown = one.map(|one| one.device.shown.clone()).unwrap_or_default();
        Self {
            index,
            id: one.map_or(0, |one| one.device.id.value),
            scale: scale_of(&shown),
            quantity: shown.quantity.map(|unit| format!(" {unit}")).unwrap_or_default(),
            settle_ns: one.map_or(0, |one| settles_ns(job, one)),
            steps: values.into_iter().map(|value| (0, value)).collect(),
            is_of_world: false,
            next: 0,
            due_ns: 0,
            settles_ns: None,
            reported: None,
            excuses: one.map(|one| bench.excused(job, one.index)).unwrap_or_default(),
            tried: ActuatorFindings { is_set: true, ..ActuatorFindings::of(name) },
        }
    }

    /// Takes the world's script instead of the usual one.
    pub(super) fn follow(&mut self, commands: &[&Command]) {
        let mut steps: Vec<(u64, Vec<Scalar>)> =
            commands.iter().map(|one| (one.at_ns, one.value.clone())).collect();
        steps.sort_by_key(|one| one.0);
        self.steps = steps;
        self.is_of_world = true;
    }

    /// Starts the commands; that much time is left for them.
    pub(super) fn begin(&mut self, now_ns: u64, left_ns: u64) {
        let offset_ns = self.due_ns;
        self.due_ns += now_ns;
        if self.is_of_world {
            let left = self.steps.iter().filter(|one| one.0 + self.settle_ns > now_ns + left_ns);
            let left = left.count();
            self.steps.truncate(self.steps.len() - left);
            self.tried.left = u64::try_from(left).unwrap_or(0);
            return;
        }
        let fits = left_ns.saturating_sub(offset_ns) / self.settle_ns.max(1);
        let fits = usize::try_from(fits).unwrap_or(usize::MAX).min(self.steps.len());
        self.tried.left = u64::try_from(self.steps.len() - fits).unwrap_or(0);
        self.steps.truncate(fits);
    }

    /// The host speaks again after a silence.
    pub(super) fn again(&mut self, now_ns: u64) {
        let value = if self.is_of_world { self.steps.last() } else { self.steps.first() };
        if let Some((_, value)) = value.cloned() {
            self.steps.push((now_ns, value));
            self.due_ns = now_ns;
        }
    }

    /// The value to send now.
    pub(super) fn next(&mut self, now_ns: u64) -> Option<Vec<Scalar>> {
        let (at_ns, value) = self.steps.get(self.next)?;
        // Commands of a world are sent at their time; otherwise each waits for the one before it.
        let is_settled = self.settles_ns.is_none() || self.is_of_world;
        if now_ns < (*at_ns).max(self.due_ns) || !is_settled {
            return None;
        }
        self.next += 1;
        self.tried.commands += 1;
        self.settles_ns = Some(now_ns + self.settle_ns);
        self.reported = Some((now_ns, value.clone()));
        Some(value.clone())
    }

    /// Its identifier, and the time of its last command.
    pub(super) fn reported(&self) -> Option<(u8, u64)> {
        self.reported.as_ref().map(|(at_ns, _)| (self.id, *at_ns))
    }

    /// Whether all commands have been sent and checked.
    pub(super) fn is_done(&self, now_ns: u64) -> bool {
        self.next >= self.steps.len() && self.settles_ns.is_none_or(|at| at < now_ns)
    }

    /// Whether the last command must have taken effect by now.
    pub(super) fn is_due(&self, now_ns: u64) -> bool {
        self.settles_ns.is_some_and(|at| at <= now_ns)
    }

    pub(super) fn look(&mut self, job: &BoardJob<'_>, now_ns: u64, outputs: &Outputs) {
        if !self.is_due(now_ns) {
            return;
        }
        self.settles_ns = None;
        self.due_ns = now_ns;
        let Some((since_ns, value)) = self.reported.clone() else { return };
        let after = format!("after {}", self.shown(&value));
        self.compare(job, (&raw(&value), outputs), (since_ns, now_ns), &after, |_| true);
    }

    /// Checks the outputs before any command.
    pub(super) fn look_unreported(&mut self, job: &BoardJob<'_>, now_ns: u64, outputs: &Outputs) {
        let Some(one) = job.devices.get(self.index) else { return };
        let expected = expect::unreported(job, one, now_ns);
        if self.is_excused(0, now_ns) {
            self.tried.excused += 1;
        } else {
            self.tried.compare(&expected, outputs, (0, now_ns), "before any command");
        }
    }

    /// Checks the outputs while the host is silent, but not yet for long enough to count.
    pub(super) fn look_held(&mut self, job: &BoardJob<'_>, now_ns: u64, outputs: &Outputs) {
        let Some((since_ns, value)) = self.reported.clone() else { return };
        let after = format!("after {}, and before the silence counts", self.shown(&value));
        let counts = |one: &Expected| is_lasting(one) || is_repeated(one);
        self.compare(job, (&raw(&value), outputs), (since_ns, now_ns), &after, counts);
    }

    /// Checks the outputs after the host has been silent for too long.
    pub(super) fn look_silent(
        &mut self,
        job: &BoardJob<'_>,
        (since_ns, now_ns, silence_ns): (u64, u64, u64),
        outputs: &Outputs,
    ) {
        let Some(one) = job.devices.get(self.index) else { return };
        let after = format!("after {} ms of silence", silence_ns / MS);
        let safe = expect::failsafe(one).map(|safe| vec![safe; one.device.value.value.count()]);
        match (safe, self.reported.clone()) {
            (Some(safe), _) => {
                let with = (safe.as_slice(), outputs);
                self.compare(job, with, (since_ns, now_ns), &after, |_| true);
            }
            (None, Some(_)) if one.device.kind.stepper().is_some() => {
                let stopped = expect::stopped(job, one);
                self.tried.compare(&stopped, outputs, (since_ns, now_ns), &after);
            }
            (None, Some((reported_ns, value))) => {
                self.compare(
                    job,
                    (&raw(&value), outputs),
                    (reported_ns, now_ns),
                    &after,
                    is_lasting,
                );
            }
            (None, None) => {}
        }
    }

    fn compare(
        &mut self,
        job: &BoardJob<'_>,
        (raw, outputs): (&[f64], &Outputs),
        (since_ns, now_ns): (u64, u64),
        after: &str,
        counts: impl Fn(&Expected) -> bool,
    ) {
        let Some(one) = job.devices.get(self.index) else { return };
        let mut expected = expect::reported(job, one, raw);
        expected.retain(counts);
        if self.is_excused(since_ns, now_ns) {
            self.tried.excused += 1;
        } else {
            self.tried.compare(&expected, outputs, (since_ns, now_ns), after);
        }
    }

    fn is_excused(&self, since_ns: u64, now_ns: u64) -> bool {
        let hits = |&(at, until): &(u64, u64)| at <= now_ns && until + RECOVERY_NS >= since_ns;
        self.excuses.iter().any(hits)
    }

    pub(super) fn finish(mut self, is_silence_left: bool) -> ActuatorFindings {
        let left = self.steps.len().saturating_sub(self.next);
        self.tried.left += u64::try_from(left).unwrap_or(0);
        self.tried.is_silence_left = is_silence_left;
        self.tried
    }

    /// A value as a host shows it, with the raw value if that differs.
    fn shown(&self, value: &[Scalar]) -> String {
        let raw = raw(value);
        let texts: Vec<String> =
            raw.iter().map(|one| short(self.scale.shown(*one)) + &self.quantity).collect();
        let wire: Vec<String> = raw.iter().map(|one| short(*one)).collect();
        let text = listed(&texts);
        let is_same = raw.iter().all(|one| (self.scale.shown(*one) - one).abs() < 1e-9);
        if is_same { text } else { format!("{text} (raw {})", listed(&wire)) }
    }
}

fn listed(all: &[String]) -> String {
    match all {
        [one] => one.clone(),
        _ => format!("[{}]", all.join(", ")),
    }
}

fn short(number: f64) -> String {
    let text = format!("{number:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn raw(value: &[Scalar]) -> Vec<f64> {
    value.iter().map(|one| real(*one)).collect()
}

/// Whether an output stays without being sent again.
fn is_lasting(one: &Expected) -> bool {
    match &one.what {
        Expectation::Level(..) | Expectation::Pulses(_) | Expectation::Millivolts(_) => true,
        Expectation::Write(written) => written.is_shared(),
        Expectation::Motion(_) => true,
        Expectation::Message(..) | Expectation::Frame(_) => false,
    }
}

/// Whether an output is sent again and again while the host speaks.
fn is_repeated(one: &Expected) -> bool {
    matches!(&one.what, Expectation::Frame(sent) if sent.resend_ns > 0)
}

/// The longest time that a device takes to follow a command.
fn settles_ns(job: &BoardJob<'_>, one: &JobDevice<'_>) -> u64 {
    let cycle_ms = job.wires_of(one.device).into_iter().map(|wire| wire.cycle.delay_ms).max();
    let cycle_ns = MS * u64::from(cycle_ms.unwrap_or(0));
    let own_ns = match one.device.kind.interface() {
        // A new width takes effect at the next period.
        Interface::Pwm(own) => 2 * 1_000_000_000 / u64::from(own.frequency_hz.max(1)),
        // A bus serves its chips in turn, and waits for those that measure.
        Interface::I2c(_) | Interface::Spi(_) | Interface::OneWire(_) => {
            cycle_ns + cycle_ns / 2 + measuring_ns(job, one)
        }
        Interface::Stepper(own) => moves_ns(one, own),
        Interface::Uart(own) => 20_000_000_000 * 64 / u64::from(own.baud.max(1)),
        Interface::Analog(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Digital(_)
        | Interface::Dac(_)
        | Interface::Can(_)
        | Interface::Code(_) => 0,
    };
    SETTLE_NS + link_ns(job) + own_ns
}

/// The longest time that a motor needs for one step of its script.
fn moves_ns(one: &JobDevice<'_>, own: &Stepper) -> u64 {
    let (speed, acceleration) = (f64::from(own.speed), f64::from(own.acceleration));
    let seconds = match own.mode {
        Mode::Position => {
            let (low, high) = script::range(one);
            // The script goes beyond its ends by a quarter.
            let steps = 1.5 * (high - low);
            let ramp = speed / acceleration;
            let peak = (steps / acceleration).sqrt();
            if peak < ramp { 2.0 * peak } else { steps / speed + ramp }
        }
        // Some steps at the lowest speed of the script, to measure it by.
        Mode::Velocity => 2.0 * speed / acceleration + 100.0 / speed,
    };
    crate::arith::nanoseconds(1.05e9 * seconds)
}

/// The time that the chips on a device's bus take to measure.
fn measuring_ns(job: &BoardJob<'_>, one: &JobDevice<'_>) -> u64 {
    let on_bus = job.devices.iter().filter(|other| other.unit == one.unit);
    let wait_us =
        |other: &JobDevice<'_>| other.device.kind.register_access().map_or(0, |own| own.wait_us);
    on_bus.map(|other| 1_000 * u64::from(wait_us(other))).sum::<u64>() + 40 * MS
}

/// The time that all commands take on a serial link.
fn link_ns(job: &BoardJob<'_>) -> u64 {
    if job.board.link.transport != Transport::Uart {
        return 0;
    }
    let bytes = job.schema.frame_bytes_max(Direction::Actuator) + 16 * job.devices.len();
    let bits = number(u64::try_from(10 * bytes).unwrap_or(0));
    crate::arith::nanoseconds(1e9 * bits / f64::from(job.board.link.baud.max(1)))
}
