//! The judge of actuators: a host that sets each of them to a script of values, falls silent and speaks again. The
//! board's outputs are compared with an independent reading of the design.
//!
//! In: a board's job, the world's commands, and the length of the run. Out, each millisecond: the bytes that the host
//! sends; at the end, the findings about each actuator and about levels that never change.

mod command;
mod compare;
mod expect;
pub mod outputs;
mod script;
pub(crate) mod track;
mod tried;
mod written;

use sensedsl_job::{BoardJob, Owner};
use sensedsl_wire::{Direction, Scalar, encode_hello_request, encode_report};

use crate::bench::Bench;
pub use command::Command;
use expect::Expected;
use outputs::Outputs;
use tried::Actor;
pub use tried::{ActuatorFindings, WireMismatch};

const MS: u64 = 1_000_000;
/// The latest time at which outputs that nobody has set yet are checked.
const UNTOLD_NS: u64 = 450 * MS;
/// The shortest silence that is tried: after a shorter one, outputs fall back before they can be checked.
const SILENCE_MIN_NS: u64 = 100 * MS;
/// The time from the first command of one actuator to that of the next.
const APART_NS: u64 = 7 * MS;

/// The host's current activity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// It only asks for the board's identity.
    Listening,
    /// It sets actuators.
    Speaking,
    /// It is silent, and actuators hold their values or have only just fallen back.
    Holding,
    /// It is still silent, and actuators have fallen back.
    FallenBack,
    /// It speaks again.
    SpeakingAgain,
    Over,
}

/// The host and the judge of what its commands do.
pub struct Commands<'a> {
    job: &'a BoardJob<'a>,
    actors: Vec<Actor>,
    constants: Vec<(Expected, ActuatorFindings)>,
    /// `None` if no actuator falls back.
    silence_ns: Option<u64>,
    end_ns: u64,
    phase: Phase,
    /// The time of the next check of all actuators.
    look_ns: Option<u64>,
    sent_ns: u64,
    is_silence_tried: bool,
}

impl<'a> Commands<'a> {
    /// A host for a board that runs until the given time.
    #[must_use]
    pub fn new(job: &'a BoardJob<'a>, bench: &Bench, end_ns: u64) -> Self {
        let usual = script::usual(job).into_iter().enumerate();
        let mut actors = Vec::new();
        for (place, (index, values)) in usual {
            let Some(one) = job.devices.get(index) else { continue };
            let own: Vec<&Command> =
                bench.commands().iter().filter(|command| command.device == one.index).collect();
            // Code sets what it owns, and a parameter is only changed where the world says so.
            let is_codes = one.device.kind.code().is_some() && own.is_empty();
            if is_codes || job.owner(index) != Owner::Host {
                continue;
            }
            let mut actor = Actor::new(job, bench, index, values);
            actor.due_ns = APART_NS * u64::try_from(place).unwrap_or(0);
            if !own.is_empty() {
                actor.follow(&own);
            }
            actors.push(actor);
        }
        let constants = expect::constants(job).into_iter();
        let constants = constants.map(|one| (ActuatorFindings::of(one.wire.clone()), one));
        let silence = job.board.link.silence_ms.filter(|_| job.has_actuators());
        let silence_ns = silence.map(|ms| MS * u64::from(ms));
        let is_soon = |ns: &u64| *ns >= SILENCE_MIN_NS;
        let unreported_ns = silence_ns.map_or(UNTOLD_NS, |ns| UNTOLD_NS.min(ns / 2));
        let look_ns = silence_ns.is_none_or(|ns| is_soon(&ns)).then_some(unreported_ns);
        Self {
            job,
            actors,
            constants: constants.map(|(tried, one)| (one, tried)).collect(),
            silence_ns,
            end_ns,
            phase: Phase::Listening,
            look_ns,
            sent_ns: 0,
            is_silence_tried: false,
        }
    }

    /// The bytes that the host sends in this millisecond.
    pub fn host(&mut self, now_ns: u64, is_known: bool) -> Vec<u8> {
        match self.phase {
            Phase::Listening if is_known && self.look_ns.is_none_or(|look| look < now_ns) => {
                self.begin(now_ns);
                self.speak(now_ns)
            }
            Phase::Speaking | Phase::SpeakingAgain => {
                if self.actors.iter().all(|one| one.is_done(now_ns)) {
                    self.fall_silent(now_ns);
                    return Vec::new();
                }
                self.speak(now_ns)
            }
            Phase::Listening | Phase::Holding | Phase::FallenBack | Phase::Over => Vec::new(),
        }
    }

    /// Whether outputs must be checked now.
    #[must_use]
    pub fn looks(&self, now_ns: u64) -> bool {
        self.look_ns.is_some_and(|look| look <= now_ns)
            || self.actors.iter().any(|one| one.is_due(now_ns))
    }

    /// Checks the outputs.
    pub fn look(&mut self, now_ns: u64, outputs: &Outputs) {
        for actor in &mut self.actors {
            actor.look(self.job, now_ns, outputs);
        }
        for (expected, tried) in &mut self.constants {
            tried.compare(std::slice::from_ref(expected), outputs, (0, now_ns), "at all times");
        }
        if self.look_ns.is_none_or(|look| look > now_ns) {
            return;
        }
        self.look_ns = None;
        match self.phase {
            Phase::Listening => {
                for actor in &mut self.actors {
                    actor.look_unreported(self.job, now_ns, outputs);
                }
            }
            Phase::Holding => {
                for actor in &mut self.actors {
                    actor.look_held(self.job, now_ns, outputs);
                }
                self.phase = Phase::FallenBack;
                let settles_ns = self.settles_ns();
                self.look_ns = self.silence_ns.map(|ns| self.sent_ns + ns + settles_ns);
            }
            Phase::FallenBack => {
                let silence_ns = self.silence_ns.unwrap_or(0);
                for actor in &mut self.actors {
                    actor.look_silent(self.job, (self.sent_ns, now_ns, silence_ns), outputs);
                }
                self.actors.iter_mut().for_each(|one| one.again(now_ns));
                self.phase = Phase::SpeakingAgain;
            }
            Phase::Speaking | Phase::SpeakingAgain | Phase::Over => {}
        }
    }

    /// The identifiers of the actuators that the host has set so far, and the time of the last command to each.
    #[must_use]
    pub fn reported(&self) -> Vec<(u8, u64)> {
        self.actors.iter().filter_map(Actor::reported).collect()
    }

    /// Ends the run and returns the findings.
    #[must_use]
    pub fn finish(self) -> Vec<ActuatorFindings> {
        let is_silence_left = self.silence_ns.is_some() && !self.is_silence_tried;
        let actors = self.actors.into_iter().map(|actor| actor.finish(is_silence_left));
        actors.chain(self.constants.into_iter().map(|(_, tried)| tried)).collect()
    }

    /// The longest time that any actuator takes to follow a command.
    fn settles_ns(&self) -> u64 {
        self.actors.iter().map(|one| one.settle_ns).max().unwrap_or(0)
    }

    /// The time that a silence and speaking again take; `None` if the rest of the run is too short for it.
    fn silence_takes_ns(&self, left_ns: u64) -> Option<u64> {
        let takes_ns = self.silence_ns? + 2 * self.settles_ns() + 100 * MS;
        (takes_ns <= left_ns / 2).then_some(takes_ns)
    }

    /// The board has answered: works out how many values of each script there is time for.
    fn begin(&mut self, now_ns: u64) {
        self.phase = Phase::Speaking;
        let left_ns = self.end_ns.saturating_sub(now_ns);
        let silence_ns = self.silence_takes_ns(left_ns);
        self.is_silence_tried = silence_ns.is_some();
        let left_ns = left_ns.saturating_sub(silence_ns.unwrap_or(0));
        self.actors.iter_mut().for_each(|one| one.begin(now_ns, left_ns));
    }

    fn speak(&mut self, now_ns: u64) -> Vec<u8> {
        // Values that are sent at the same time share a frame.
        let next = |actor: &mut Actor| actor.next(now_ns).map(|value| (actor.id, value));
        let values: Vec<(u8, Vec<Scalar>)> = self.actors.iter_mut().filter_map(next).collect();
        let mut bytes = Vec::new();
        if !values.is_empty() {
            let frame = encode_report(&self.job.schema, Direction::Actuator, &values);
            bytes.extend(frame.unwrap_or_default());
        }
        let keeps_ns = self.silence_ns.map_or(u64::MAX, |ns| (ns / 3).min(100 * MS));
        if bytes.is_empty() && now_ns - self.sent_ns >= keeps_ns {
            bytes = encode_hello_request(&self.job.schema);
        }
        if !bytes.is_empty() {
            self.sent_ns = now_ns;
        }
        bytes
    }

    fn fall_silent(&mut self, now_ns: u64) {
        let is_over = self.phase == Phase::SpeakingAgain || !self.is_silence_tried;
        self.phase = if is_over { Phase::Over } else { Phase::Holding };
        let held_ns = self.silence_ns.map(|ns| (self.sent_ns + ns / 10 * 7).max(now_ns));
        self.look_ns = held_ns.filter(|_| !is_over);
    }
}
