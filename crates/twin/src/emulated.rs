//! A board's image on the emulated MCU, on the same bench as the board that this program imitates.
//!
//! In: a board's job, its bench, an image. Out: the bytes of the link, where the program is, and, for each start, the
//! settings of pads and ports that differ from the plan.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use sensedsl_job::BoardJob;
use sensedsl_model::design::Transport;

use crate::bench::{Bench, number_of};
use crate::commands::outputs::Outputs;
use crate::pads::{PadMismatch, Planned, mismatches, planned};
use crate::ports::{self, PlannedPort};
use crate::trial::{Culprit, Stopped, Tested};
use sensedsl_machine::{Event, ImageError, LinkPort, Lockup, Machine, Mcu, ResetCause, Settings};

/// The crystal frequency if the board's is not known.
const CRYSTAL_HZ: u64 = 8_000_000;
const MS_NS: u64 = 1_000_000;
const SECOND_NS: u64 = 1_000 * MS_NS;
/// A watchdog with a longer timeout than this counts as missing.
const WATCHDOG_NS: u64 = 10 * SECOND_NS;
/// The time after a start at which the watchdog is checked. A link over USB is plugged in before the watchdog is
/// started.
const WATCHED_NS: u64 = 2_500 * MS_NS;
/// The time after a start at which pads and ports are checked, the number of checks and the time between them. A bus
/// that is being freed takes its pads over for a moment.
const LOOK_NS: u64 = 1_000 * MS_NS;
const IDENTITY_ATTEMPTS: u32 = 4;
const LOOKS_APART_NS: u64 = 7 * MS_NS;
/// After this many resets that nobody asked for, the program counts as one that only ever starts.
const RESETS_MAX: u32 = 3;

/// The MCU with its surroundings.
pub struct EmulatedBoard {
    machine: Machine,
    bench: Arc<Mutex<Bench>>,
    /// Whether something follows what the board does.
    is_planted: bool,
    planned: Vec<Planned>,
    ports: Vec<PlannedPort>,
    garbage: Vec<u8>,
    garbage_ms: u64,
    is_off: bool,
    look: Option<NextCheck>,
    mismatches: Vec<PadMismatch>,
    /// The time of the next watchdog check.
    watchdog_at_ns: Option<u64>,
    /// The watchdog's fault, if it has one.
    unwatched: Option<String>,
    events: Vec<Event>,
    resets: u32,
    loops: Option<Lockup>,
    pc: u32,
}

/// The time of the next check of pads and ports, the number of checks left, and the mismatches that every check so far
/// has found.
struct NextCheck {
    at_ns: u64,
    left: u32,
    wrong: Option<Vec<PadMismatch>>,
}

impl NextCheck {
    fn after(start_ns: u64) -> Self {
        Self { at_ns: start_ns + LOOK_NS, left: IDENTITY_ATTEMPTS, wrong: None }
    }
}

impl EmulatedBoard {
    /// Puts an image into the MCU's flash.
    ///
    /// # Errors
    ///
    /// If the board's MCU cannot be emulated, or the image is not a program for it.
    pub fn new(job: &BoardJob<'_>, bench: Bench, image: &[u8]) -> Result<Self, ImageError> {
        let unit = job.link.as_ref().and_then(|link| number_of(link.unit));
        let link = match (job.board.link.transport, unit) {
            (Transport::Uart, Some(unit)) => LinkPort::Serial(unit),
            (Transport::Uart | Transport::Usb | Transport::None, _) => LinkPort::Usb,
        };
        let is_planted = bench.has_plants();
        let bench = Arc::new(Mutex::new(bench));
        let crystal_hz = job.board.facts.as_ref().and_then(|facts| facts.crystal.hse_hz);
        let part = job.board.mcu.as_deref().unwrap_or("MCU that nobody knows");
        let mcu = Mcu::find(part).ok_or_else(|| ImageError::NoModel(part.to_owned()))?;
        let settings = Settings { crystal_hz: crystal_hz.map_or(CRYSTAL_HZ, u64::from), link, mcu };
        let mut machine = Machine::new(settings, Arc::clone(&bench) as _);
        machine.load(image)?;
        Ok(Self {
            machine,
            bench,
            is_planted,
            planned: planned(job, mcu.numbers_functions()),
            ports: ports::planned(job),
            garbage: Vec::new(),
            garbage_ms: 0,
            is_off: false,
            look: Some(NextCheck::after(0)),
            mismatches: Vec::new(),
            watchdog_at_ns: Some(WATCHED_NS),
            unwatched: None,
            events: Vec::new(),
            resets: 0,
            loops: None,
            pc: 0,
        })
    }

    fn bench(&self) -> MutexGuard<'_, Bench> {
        self.bench.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The virtual time.
    #[must_use]
    pub fn now_ns(&self) -> u64 {
        self.machine.now_ns()
    }

    /// The number of cycles that the core has worked, without those that it waited.
    #[must_use]
    pub fn cycles_worked(&self) -> u64 {
        self.machine.cycles_worked()
    }

    /// The number of instructions that the core has executed, without those of one-instruction loops in which it
    /// waited.
    #[must_use]
    pub fn instructions(&self) -> u64 {
        self.machine.instructions()
    }

    /// Runs until the given time, in steps of a millisecond: the supply may fail in each of them.
    pub fn run_until(&mut self, until_ns: u64) {
        while self.garbage_ms < until_ns / MS_NS {
            self.garbage_ms += 1;
            let now_ns = self.garbage_ms * MS_NS;
            self.supply(now_ns);
            if self.is_planted {
                self.bench().advance(now_ns);
                self.machine.surroundings_changed();
            }
            self.machine.run_until(now_ns);
            let garbage = self.bench().garbage(now_ns);
            self.garbage.extend(garbage);
            self.follow();
            self.look(now_ns);
            self.look_at_watchdog(now_ns);
        }
        self.machine.run_until(until_ns);
        self.follow();
    }

    /// What went wrong with a program of the world, said once.
    pub fn trouble(&self) -> Option<crate::plants::Trouble> {
        self.bench().trouble()
    }

    /// Takes the supply away and gives it back, as the world says.
    fn supply(&mut self, now_ns: u64) {
        let is_off = self.bench().is_off(now_ns);
        if is_off != self.is_off {
            self.is_off = is_off;
            self.machine.power(!is_off);
            self.look = None;
            self.watchdog_at_ns = None;
            if !is_off {
                self.bench().power_up(now_ns);
            }
        }
    }

    /// Handles the machine's new events.
    fn follow(&mut self) {
        for event in self.machine.events() {
            if let Event::Reset { at_ns, cause } = &event {
                self.look = Some(NextCheck::after(*at_ns));
                self.watchdog_at_ns = Some(at_ns + WATCHED_NS);
                self.resets = if *cause == ResetCause::Power { 0 } else { self.resets + 1 };
                if self.resets >= RESETS_MAX && self.loops.is_none() {
                    let whom = match cause {
                        ResetCause::Watchdog => "the watchdog",
                        ResetCause::Software => "the program itself",
                        ResetCause::Power => "its supply",
                    };
                    let why = format!("{whom} has reset it {} times", self.resets);
                    self.loops = Some(Lockup { pc: self.pc, why });
                }
            }
            self.events.push(event);
        }
        self.pc = self.machine.pc();
    }

    /// Compares pads and ports with the plan if it is time.
    fn look(&mut self, now_ns: u64) {
        let Some(look) = self.look.as_mut().filter(|look| look.at_ns <= now_ns) else { return };
        let mut now = mismatches(&self.planned, &self.machine.pads());
        now.extend(ports::mismatches(&self.ports, &self.machine.ports()));
        let still = match look.wrong.take() {
            None => now,
            Some(before) => before.into_iter().filter(|one| now.contains(one)).collect(),
        };
        look.left -= 1;
        look.at_ns = now_ns + LOOKS_APART_NS;
        if look.left > 0 && !still.is_empty() {
            look.wrong = Some(still);
            return;
        }
        self.look = None;
        self.mismatches.extend(still);
    }

    /// Checks whether the watchdog runs if it is time.
    fn look_at_watchdog(&mut self, now_ns: u64) {
        if self.watchdog_at_ns.is_none_or(|at_ns| now_ns < at_ns) {
            return;
        }
        self.watchdog_at_ns = None;
        self.unwatched = match self.machine.watchdog_ns() {
            None => Some("does not run".to_owned()),
            Some(ns) if ns > WATCHDOG_NS => Some(format!("bites after {} s only", ns / SECOND_NS)),
            Some(_) => None,
        };
    }

    /// The pads and ports found not to be as planned since the last call.
    pub fn mismatches(&mut self) -> Vec<PadMismatch> {
        std::mem::take(&mut self.mismatches)
    }

    /// The watchdog's fault, if one was found since the last call.
    pub fn unwatched(&mut self) -> Option<String> {
        self.unwatched.take()
    }

    /// The outputs of the board.
    #[must_use]
    pub fn outputs(&self) -> Outputs {
        self.bench().outputs().clone()
    }

    /// The parts on buses that the board has read without asking for their identity.
    #[must_use]
    pub fn unasked(&self) -> Vec<crate::bench::UncheckedIdentity> {
        self.bench().unasked()
    }

    /// The parts on buses that the board has treated in a way that their drivers do not describe, each with what
    /// happened.
    #[must_use]
    pub fn odd_transfers(&self) -> Vec<(String, String)> {
        self.bench().odd_transfers()
    }

    /// The time that the core has worked so far.
    #[must_use]
    pub fn worked_ns(&self) -> u64 {
        let hz = self.machine.core_hz().max(1);
        let (whole, rest) = (self.cycles_worked() / hz, self.cycles_worked() % hz);
        whole.saturating_mul(SECOND_NS).saturating_add(rest * SECOND_NS / hz)
    }

    /// The log of everything that has left the MCU, if the bench keeps one.
    #[must_use]
    pub fn take_log(&self) -> Option<String> {
        self.bench().take_log()
    }

    /// Period and width, in nanoseconds, of the pulses that the board sends, by timer and channel.
    #[must_use]
    pub fn waves(
        &self,
    ) -> std::collections::BTreeMap<sensedsl_surroundings::TimerOutput, (u64, u64)> {
        self.bench().waves().clone()
    }

    /// The host sends bytes.
    pub fn link_write(&mut self, bytes: &[u8]) {
        if !self.is_off {
            self.machine.link_write(bytes);
        }
    }

    /// The host opens or closes its port.
    pub fn link_open(&mut self, is_open: bool) {
        self.machine.link_open(is_open);
    }

    /// The bytes that have arrived at the host since the last call.
    pub fn link_read(&mut self) -> Vec<u8> {
        let mut bytes = std::mem::take(&mut self.garbage);
        bytes.extend(self.machine.link_read().into_iter().map(|(_, byte)| byte));
        bytes
    }

    /// The place where the program is stuck, and the reason.
    #[must_use]
    pub fn halt(&self) -> Option<Lockup> {
        self.loops.clone().or_else(|| self.machine.halt())
    }

    /// The events since the last call that matter to a user.
    pub fn events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }
}

impl Tested for EmulatedBoard {
    fn now_ns(&self) -> u64 {
        self.now_ns()
    }

    fn run_until(&mut self, until_ns: u64) {
        self.run_until(until_ns);
    }

    fn link_open(&mut self) {
        self.link_open(true);
    }

    fn link_write(&mut self, bytes: &[u8]) {
        self.link_write(bytes);
    }

    fn link_read(&mut self) -> Vec<u8> {
        self.link_read()
    }

    fn outputs(&self) -> Option<Outputs> {
        Some(self.outputs())
    }

    fn stopped(&mut self) -> Option<Stopped> {
        let at_ns = self.now_ns();
        let of_program = self.halt().map(|halt| Stopped {
            at_ns,
            culprit: Culprit::Board,
            why: halt.to_string(),
        });
        of_program.or_else(|| self.trouble().map(Stopped::of_plant))
    }
}
