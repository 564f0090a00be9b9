//! The way of a motor: the steps that a board has made, counted from the pulses and the level of the direction wire
//! alone, and what is wrong with them whatever they were for.
//!
//! In: pulses and levels, as they leave the board. Out: where the motor is at a moment, how fast it goes, and the first
//! step that a motor with its speed and acceleration could not follow, or that its driver would not have seen.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use sensedsl_host::Scale;
use sensedsl_model::kind::stepper::Stepper;

use crate::arith::number;

/// The steps that are kept: those of several seconds.
const KEPT: usize = 65_536;
/// The time from a change of the direction to the next pulse: the greatest of the data sheets of usual drivers.
const SETUP_NS: u64 = 650;
/// How much shorter an interval may be than that of the greatest speed: a tick of the timer.
const TICK_NS: u64 = 300;
/// How many steps of a ramp a mean speed is taken over.
const WINDOW: f64 = 100.0;
/// The steps that the present speed is the mean of.
const RECENT: usize = 16;
/// How far a speed may be below what was asked for: each step is late by its interrupt.
const LATE_NS: f64 = 3_000.0;
/// How far a speed may be off beside that.
const OFF: f64 = 0.005;

/// The way of one motor. Whoever holds a copy sees the same motor.
#[derive(Clone, Debug)]
pub struct Track(Arc<Mutex<Log>>);

impl PartialEq for Track {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

#[derive(Debug)]
struct Log {
    motor: Stepper,
    scale: Scale,
    position: i64,
    /// The times of the steps, and where the motor was after each.
    steps: VecDeque<(u64, i64)>,
    /// The level of the direction wire, and since when.
    dir: Option<(bool, u64)>,
    enable: Option<bool>,
    /// The end of the last pulse.
    pulse_end_ns: u64,
    /// The mean speed of the last whole window, and its middle.
    window: Option<(f64, f64)>,
    /// Where the present window began.
    began: Option<(u64, i64)>,
    /// The first step after the motor stood, and where it was then.
    rested: Option<(u64, i64)>,
    wrong: Option<String>,
}

/// What a motor must do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Motion {
    /// It stands at a step.
    At(i64),
    /// It goes at that many steps a second.
    Goes(f64),
    /// It stands, wherever.
    Stands,
}

impl Track {
    /// A motor at position 0, whose shown value has that scale.
    #[must_use]
    pub fn new(motor: Stepper, scale: Scale) -> Self {
        Self(Arc::new(Mutex::new(Log {
            motor,
            scale,
            position: 0,
            steps: VecDeque::new(),
            dir: None,
            enable: None,
            pulse_end_ns: 0,
            window: None,
            began: None,
            rested: None,
            wrong: None,
        })))
    }

    fn log(&self) -> MutexGuard<'_, Log> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The board has lost its supply: it counts from 0 again.
    pub(crate) fn reset(&self) {
        let mut log = self.log();
        *log = Log {
            position: 0,
            steps: VecDeque::new(),
            dir: None,
            enable: None,
            window: None,
            began: None,
            rested: None,
            motor: log.motor.clone(),
            scale: log.scale.clone(),
            wrong: log.wrong.take(),
            ..*log
        };
    }

    /// A pulse on the wire of the steps.
    pub(crate) fn pulse(&self, from_ns: u64, width_ns: u64) {
        self.log().pulse(from_ns, width_ns);
    }

    /// The board drives the wire of the direction.
    pub(crate) fn direct(&self, level: Option<bool>, now_ns: u64) {
        self.log().direct(level, now_ns);
    }

    /// The board drives the wire that lets current into the motor.
    pub(crate) fn enable(&self, level: Option<bool>) {
        self.log().enable = level;
    }

    /// The steps that were made up to a moment, as they are shown.
    pub(crate) fn at(&self, now_ns: u64) -> f64 {
        let log = self.log();
        log.scale.shown(whole(log.position_at(now_ns)))
    }

    /// The least and the greatest of these in a span of time.
    pub(crate) fn range(&self, from_ns: u64, to_ns: u64) -> (f64, f64) {
        let log = self.log();
        let first = log.position_at(from_ns);
        let all = log.steps.iter().filter(|(at, _)| (from_ns..=to_ns).contains(at));
        let ends =
            |(least, most): (i64, i64), (_, one): &(u64, i64)| (least.min(*one), most.max(*one));
        let (least, most) = all.fold((first, first), ends);
        let (one, other) = (log.scale.shown(whole(least)), log.scale.shown(whole(most)));
        (one.min(other), one.max(other))
    }

    /// What the motor does instead; none if it does as it must, and every step so far was one that it could follow.
    pub(super) fn differs(&self, wanted: Motion, now_ns: u64) -> Option<String> {
        let log = self.log();
        log.wrong.clone().or_else(|| log.does_not(wanted, now_ns))
    }
}

fn whole(position: i64) -> f64 {
    crate::arith::signed_number(position)
}

impl Log {
    fn position_at(&self, now_ns: u64) -> i64 {
        let later = self.steps.iter().rev().find(|(at, _)| *at <= now_ns);
        later.map_or_else(|| self.steps.front().map_or(0, |(_, first)| *first), |(_, one)| *one)
    }

    fn complain(&mut self, now_ns: u64, what: &str) {
        let position = self.position;
        let seconds = number(now_ns) / 1e9;
        let _ =
            self.wrong.get_or_insert_with(|| format!("at step {position}, {seconds:.6} s: {what}"));
    }

    fn direct(&mut self, level: Option<bool>, now_ns: u64) {
        let Some(level) = level else {
            self.dir = None;
            return;
        };
        if self.dir.is_none_or(|(before, _)| before != level) {
            if now_ns < self.pulse_end_ns {
                self.complain(now_ns, "the direction changes within a pulse");
            }
            self.dir = Some((level, now_ns));
        }
    }

    fn pulse(&mut self, from_ns: u64, width_ns: u64) {
        let Some((level, since_ns)) = self.dir else {
            self.complain(from_ns, "a pulse comes, and nothing drives the direction");
            return;
        };
        if from_ns < since_ns + SETUP_NS {
            self.complain(from_ns, "the direction has changed less than 650 ns before");
        }
        if self.motor.enabled.is_some() && self.enable != self.motor.enabled {
            self.complain(from_ns, "a pulse comes while the driver is off");
        }
        let least_ns = 1_000 * u64::from(self.motor.pulse_us);
        if width_ns + TICK_NS < least_ns {
            self.complain(from_ns, &format!("a pulse of {width_ns} ns, not of {least_ns}"));
        }
        self.hurries(from_ns);
        self.rests(from_ns);
        self.pulse_end_ns = from_ns + width_ns;
        self.position += if level == self.motor.is_forward_high { 1 } else { -1 };
        if self.steps.len() >= KEPT {
            self.steps.pop_front();
        }
        self.steps.push_back((from_ns, self.position));
        self.leaps(from_ns);
        self.bolts(from_ns);
    }

    /// A step that comes sooner after the last one than at the greatest speed.
    fn hurries(&mut self, now_ns: u64) {
        let Some((last_ns, _)) = self.steps.back().copied() else { return };
        let least_ns = 1_000_000_000 / u64::from(self.motor.speed.max(1));
        let after_ns = now_ns - last_ns;
        if after_ns + TICK_NS + least_ns / 1_000 < least_ns {
            self.complain(now_ns, &format!("{after_ns} ns after the last step, not {least_ns}"));
        }
    }

    /// Notes a step that comes as late as the first one from rest, or later.
    fn rests(&mut self, now_ns: u64) {
        let first = (2.0 / f64::from(self.motor.acceleration)).sqrt();
        let last = self.steps.back().map(|(at, _)| number(now_ns - at) / 1e9);
        if last.is_none_or(|after| after >= 0.99 * first) {
            self.rested = Some((now_ns, self.position));
        }
    }

    /// A motor that has stood goes no farther than its acceleration takes it, from the speed that it has at its first
    /// step.
    fn bolts(&mut self, now_ns: u64) {
        let Some((at_ns, from)) = self.rested else { return };
        let (acceleration, after) =
            (f64::from(self.motor.acceleration), number(now_ns - at_ns) / 1e9);
        let most = 2.0 + (2.0 * acceleration).sqrt() * after + 0.51 * acceleration * after * after;
        let far = whole(self.position - from).abs();
        if far > most {
            let what = format!("{far} steps from where it stood {after:.6} s ago, not {most:.1}");
            self.complain(now_ns, &what);
        }
    }

    /// Compares the mean speeds of windows that follow each other: they differ by no more than the acceleration makes
    /// between their middles, and by the speed of the first step, at which a motor may stand at once.
    fn leaps(&mut self, now_ns: u64) {
        let acceleration = f64::from(self.motor.acceleration);
        let (at_ns, from) = *self.began.get_or_insert((now_ns, self.position));
        let seconds = number(now_ns - at_ns) / 1e9;
        if seconds < (2.0 * WINDOW / acceleration).sqrt() {
            return;
        }
        self.began = Some((now_ns, self.position));
        let speed = whole(self.position - from) / seconds;
        let middle = (number(at_ns) / 1e9).midpoint(number(now_ns) / 1e9);
        let before = self.window.replace((speed, middle));
        let Some((slower, earlier)) = before else { return };
        let most = acceleration * (middle - earlier) * 1.05 + (2.0 * acceleration).sqrt();
        if (speed - slower).abs() > most {
            let what = format!(
                "its speed goes from {slower:.0} to {speed:.0} steps/s, by more than {most:.0}"
            );
            self.complain(now_ns, &what);
        }
    }

    fn does_not(&self, wanted: Motion, now_ns: u64) -> Option<String> {
        let speed = self.speed(now_ns);
        match wanted {
            Motion::At(step) if speed != 0.0 => {
                Some(format!("it is under way to step {step}, at {}", self.position))
            }
            Motion::At(step) => (self.position != step).then(|| format!("step {}", self.position)),
            Motion::Stands => (speed != 0.0).then(|| format!("{speed:.1} steps/s")),
            Motion::Goes(asked) => {
                // Late steps make it slower, never faster.
                let slowest = 1.0 / (1.0 / asked.abs().max(0.001) + LATE_NS / 1e9) * (1.0 - OFF);
                let fits = (slowest..=asked.abs() * (1.0 + OFF)).contains(&speed.abs());
                let is_right =
                    if asked == 0.0 { speed == 0.0 } else { fits && speed * asked > 0.0 };
                (!is_right).then(|| format!("{speed:.1} steps/s"))
            }
        }
    }

    /// The mean speed of the last steps; 0 once the next one of that speed is missing.
    fn speed(&self, now_ns: u64) -> f64 {
        let recent: Vec<&(u64, i64)> = self.steps.iter().rev().take(RECENT + 1).collect();
        let ([(last_ns, last), ..], [.., (first_ns, first)]) =
            (recent.as_slice(), recent.as_slice())
        else {
            return 0.0;
        };
        let span_ns = last_ns - first_ns;
        if span_ns == 0 {
            return 0.0;
        }
        let each_ns = number(span_ns) / whole((last - first).abs().max(1));
        if number(now_ns.saturating_sub(*last_ns)) > 1.5 * each_ns + 1e6 {
            return 0.0;
        }
        whole(last - first) / (number(span_ns) / 1e9)
    }
}

/// What must be, for people.
pub(super) fn shown(wanted: Motion) -> String {
    match wanted {
        Motion::At(step) => format!("step {step}"),
        Motion::Goes(speed) => format!("{speed:.1} steps/s"),
        Motion::Stands => "no steps".to_owned(),
    }
}
